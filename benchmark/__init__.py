"""What does the benchmark share with the examples? Their helper for STEP files, which is made importable here."""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.append(str(Path(__file__).parents[1] / "examples"))
