"""How did a program end, and what is there to say about it? The interpreter's errors, which are texts, as data."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Final

from pydantic_monty import MontyCrashedError, MontyError, MontyRuntimeError, MontySyntaxError

from querycad_contracts import MissingAttribute, RunStatus

from .guest import Absence, Guest

TEXT_CHARS: Final = 1500
"""Of an exception's text, which is the program's to choose; the line follows it."""
PROGRAM_FILE: Final = "<python-input-1>"
"""The interpreter's name for the second text fed to a session: the program, after the prelude."""

_NO_ATTRIBUTE: Final = re.compile(r"'(\w+)' object has no attribute '(\w+)'")
_EMPTY: Final[dict[type[BaseException], tuple[str, ...]]] = {
    ValueError: ("min() iterable argument is empty", "max() iterable argument is empty"),
    IndexError: ("list index out of range",),
}
"""What the interpreter says where a program chooses among too few: the largest of none, the second of one."""
_NO_CALLBACK: Final = re.compile(r"(?:method|function) call .* cannot suspend in this synchronous context")
_SEEN: Final = "(?:Part|Face|Body|Shape|Frame|Opening)"
_WAYS: Final = {
    re.compile(rf"unhashable type: '{_SEEN}'"): "; use its .id, or a list",
    re.compile(rf"'[<>]=?' not supported between instances of '{_SEEN}' and '{_SEEN}'"): (
        "; compare a measure: key=lambda one: one.diameter"
    ),
}
"""What to do instead where objects of the guest API are used as none of them can be."""


@dataclass(frozen=True, slots=True)
class Ending:
    """How a program ended, with what there is to say to the user and to a repair; see `RunOutcome`."""

    status: RunStatus
    message: str
    missing_attribute: MissingAttribute | None = None
    empty_selection: bool = False


def ending_of(error: MontyError, guest: Guest) -> Ending:
    """How did the program end that the interpreter's `error` comes from?"""
    if isinstance(error, MontyCrashedError):
        if error.timed_out:
            return Ending(RunStatus.TIMED_OUT, "the program ran out of time")
        return Ending(RunStatus.CRASHED, "the interpreter crashed")
    if isinstance(error, MontySyntaxError):
        return Ending(RunStatus.REFUSED, f"invalid syntax: {error}")
    cause, text = error.exception(), str(error.exception())
    if isinstance(cause, TimeoutError) and "time limit exceeded" in text:
        return Ending(RunStatus.TIMED_OUT, "the program ran out of time")
    if isinstance(cause, MemoryError):
        return Ending(RunStatus.OUT_OF_MEMORY, "the program ran out of memory")
    absence = _absence(cause, text, guest)
    said = _explained(cause, absence.text if absence is not None else text) + _where(error)
    missing = absence.missing if absence is not None else None
    return Ending(RunStatus.RAISED, said, missing, text in _EMPTY.get(type(cause), ()))


def _absence(cause: BaseException, text: str, guest: Guest) -> Absence | None:
    """The measure for want of which the program ended; None where it ended for another reason.

    That is also where it reckoned with None after it had read a measure that the object does not have.
    """
    if isinstance(cause, TypeError | AttributeError) and "NoneType" in text:
        return guest.absence
    if not isinstance(cause, AttributeError):
        return None
    if match := _NO_ATTRIBUTE.fullmatch(text):  # as the interpreter says it, whatever the host has said
        return guest.explain(*match.groups())
    return guest.absence if guest.absence is not None and guest.absence.text == text else None


def _explained(cause: BaseException, text: str) -> str:
    told = next((way for pattern, way in _WAYS.items() if pattern.search(text)), "")
    if isinstance(cause, NotImplementedError) and _NO_CALLBACK.fullmatch(text):
        told = ": measure first, in a list, then sort"
    text = f"{text}{told}"
    return f"{type(cause).__name__}: {text[:TEXT_CHARS]}"


def _where(error: MontyError) -> str:
    """The line of the program that the error came from, as ' (line 3: source)'."""
    frames = error.traceback() if isinstance(error, MontyRuntimeError) else []
    frame = next((frame for frame in reversed(frames) if frame.filename == PROGRAM_FILE), None)
    if frame is None:
        return ""
    source = f": {frame.source_line.strip()[:200]}" if frame.source_line else ""
    return f" (line {frame.line}{source})"
