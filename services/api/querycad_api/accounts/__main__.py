"""Runs the command: `python -m querycad_api.accounts`"""

import sys

from .commands import main

sys.exit(main())
