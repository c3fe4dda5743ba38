"""What leaves the sandbox: plain data, of a size that a person could read, and nothing that a program made up."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from typing import Any, Final

from pydantic_monty import MontyClassProxy, MontyStdTypeProxy

from querycad_contracts import Face, Part

MAX_ITEMS: Final = 10_000
"""Values in all; the largest honest answer lists a measure of every part of a large assembly."""
MAX_TEXT_CHARS: Final = 2**20
MAX_DEPTH: Final = 8
"""Lists in lists; points in groups of parts need three."""
MAX_INT: Final = 2**63 - 1

_STAND_IN: Final = re.compile(
    r"""<(?:function|class|module|bound\ method|coroutine|[\w.]+\ object|deeply\ nested)\b.*>
    | range\(.*\) | slice\(.*\) | dict_(?:keys|values|items)\(.*\) | re\.compile\(.*\) | functools\.partial\(.*\)
    | find_parts | \[\.\.\.\] | \{\.\.\.\} | \(\.\.\.\) | \.\.\.""",
    re.VERBOSE | re.DOTALL,
)
"""What the interpreter hands out in place of what cannot leave it, and of the inside of a cycle: its printed form;
of a function of the host, its name."""


class UnfitError(Exception):
    """A value cannot be an answer; the message completes 'the result ...'."""


def _itself(value: Any) -> Any:
    return value


def plain(value: object, original: Callable[[Any], Any] = _itself) -> Any:
    """What is `value` as plain data: None, bool, int, float, str, or lists of these?

    `original` gives the model's own object for what stands for it.

    A tuple becomes a list, a set a sorted list, a part {'part': id}, a face {'face': id}. Raises UnfitError for
    anything else: dictionaries, objects of the program's own classes, functions, NaN and infinities, integers over
    64 bit, cycles, and whatever is too large.
    """
    return _Converter(original).convert(value, 0)


class _Converter:
    """Counts what it converts, so that a list that holds one list a thousand times is as large as it reads."""

    def __init__(self, original: Callable[[Any], Any]) -> None:
        self.original = original
        self.items = 0
        self.chars = 0

    def convert(self, value: object, depth: int) -> Any:
        self.items += 1
        if self.items > MAX_ITEMS:
            raise UnfitError(f"has more than {MAX_ITEMS:,} values")
        match value := self.original(value):
            case None | bool():
                return value
            case int():
                return _integer(value)
            case float():
                return _number(value)
            case str():
                return self._text(value)
            case Part():
                return {"part": value.id}
            case Face():
                return {"face": value.id}
            case list() | tuple():
                return self._list(list(value), depth)
            case set() | frozenset():
                return self._set(list(value), depth)
            case dict():
                raise UnfitError("is a dict: assign a list, for one value a group")
        raise _no_value(_named(value))

    def _list(self, values: list[object], depth: int) -> list[Any]:
        if depth >= MAX_DEPTH:
            raise UnfitError(f"is nested deeper than {MAX_DEPTH} lists")
        return [self.convert(value, depth + 1) for value in values]

    def _set(self, values: list[object], depth: int) -> list[Any]:
        converted = self._list(values, depth)
        try:
            return sorted(converted)
        except TypeError:
            raise UnfitError("is a set of values that have no order: assign a list") from None

    def _text(self, value: str) -> str:
        self.chars += len(value)
        if self.chars > MAX_TEXT_CHARS:
            raise UnfitError(f"has more than {MAX_TEXT_CHARS:,} characters")
        if _STAND_IN.fullmatch(value):
            raise _no_value(value)
        return value


def _no_value(what: str) -> UnfitError:
    return UnfitError(f"holds {what[:60]!r}, which is no value: assign a number, a text, a part, or a list of these")


def _integer(value: int) -> int:
    if abs(value) > MAX_INT:
        raise UnfitError("has an integer of more than 64 bit")
    return value


def _number(value: float) -> float:
    if not math.isfinite(value):
        raise UnfitError("is not a finite number")
    return value


def _named(value: object) -> str:
    """A class or builtin by its own name, an object by its class's, be that the host's or the program's own."""
    if isinstance(value, MontyClassProxy | MontyStdTypeProxy):
        return value.name
    return value.__name__ if isinstance(value, type) else type(value).__name__
