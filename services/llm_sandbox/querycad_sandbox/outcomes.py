"""How did a program end, and what is there to say about it? The interpreter's errors as a status and one message."""

from __future__ import annotations

import re
from typing import Final

from pydantic_monty import MontyCrashedError, MontyError, MontyRuntimeError, MontySyntaxError

from querycad_contracts import RunStatus

from .guest import Guest

TEXT_CHARS: Final = 1500
"""Of an exception's text, which is the program's to choose; the line follows it."""
PROGRAM_FILE: Final = "<python-input-1>"
"""The interpreter's name for the second text fed to a session: the program, after the prelude."""

_NO_ATTRIBUTE: Final = re.compile(r"'(\w+)' object has no attribute '(\w+)'")
_NO_CALLBACK: Final = re.compile(r"(?:method|function) call .* cannot suspend in this synchronous context")


def outcome_of(error: MontyError, guest: Guest) -> tuple[RunStatus, str]:
    """Which status does the interpreter's `error` mean, with which message for the user and for a repair?"""
    if isinstance(error, MontyCrashedError):
        if error.timed_out:
            return RunStatus.TIMED_OUT, "the program ran out of time"
        return RunStatus.CRASHED, "the interpreter crashed"
    if isinstance(error, MontySyntaxError):
        return RunStatus.REFUSED, f"invalid syntax: {error}"
    cause, text = error.exception(), str(error.exception())
    if isinstance(cause, TimeoutError) and "time limit exceeded" in text:
        return RunStatus.TIMED_OUT, "the program ran out of time"
    if isinstance(cause, MemoryError):
        return RunStatus.OUT_OF_MEMORY, "the program ran out of memory"
    return RunStatus.RAISED, _explained(cause, text, guest) + _where(error)


def _explained(cause: BaseException, text: str, guest: Guest) -> str:
    if isinstance(cause, AttributeError) and (match := _NO_ATTRIBUTE.fullmatch(text)):
        text = guest.explain(*match.groups()) or text
    if isinstance(cause, NotImplementedError) and _NO_CALLBACK.fullmatch(text):
        text = f"{text}: measure first, in a list, then sort"
    return f"{type(cause).__name__}: {text[:TEXT_CHARS]}"


def _where(error: MontyError) -> str:
    """The line of the program that the error came from, as ' (line 3: source)'."""
    frames = error.traceback() if isinstance(error, MontyRuntimeError) else []
    frame = next((frame for frame in reversed(frames) if frame.filename == PROGRAM_FILE), None)
    if frame is None:
        return ""
    source = f": {frame.source_line.strip()[:200]}" if frame.source_line else ""
    return f" (line {frame.line}{source})"
