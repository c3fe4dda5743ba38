"""How a command ends: its exit code, and one line on standard error that says what went wrong."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pydantic import ValidationError

EXIT_DONE, EXIT_FAILED, EXIT_BAD_INPUT = 0, 1, 2


def complain(message: str, code: int = EXIT_BAD_INPUT) -> int:
    """Says what is wrong; returns the exit code."""
    from querycad_contracts.infrastructure.logs import printable  # here: what succeeds does not need it

    print(f"querycad: {printable(message)}", file=sys.stderr)
    return code


def first_of(error: ValidationError) -> str:
    """The first thing that is wrong with options or environment variables, for a person."""
    first = error.errors()[0]
    return f"{'.'.join(map(str, first['loc']))}: {first['msg']}"


def complain_of(file: str, problem: Exception) -> int:
    """Says what is wrong with a file, which is named once; returns the exit code."""
    said = str(problem)
    return complain(said if file in said else f"{file}: {said}")
