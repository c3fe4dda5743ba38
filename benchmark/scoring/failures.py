"""Why is an answer wrong? The four classes of the QueryCAD paper, each decided by a rule from the run's record.

The first rule that holds decides:

1. interface: the file could not be read, the runtime failed, or the program asked a part for a measure that it does
   not have. A capability is missing.
2. syntax: the program was refused before it ran (grammar, unknown names or attributes), raised, ran into a limit, or
   its result was of no known type.
3. reasoning: no program was written, since the question was not understood.
4. masks: a description found no part.
5. masks: a count is wrong, or there are more or fewer values than in the label. Parts are missing or too many.
6. reasoning: the answer has another form than the label (a number for a point, say), or a measure of a part that was
   found agrees with the label: the right parts, the wrong measure.
7. masks where the program looked for parts, reasoning where it did not.

A person may overrule this in a file of overrides, also with `label`: the label itself is believed wrong. No rule gives
that class, and it leaves the score as it is.
"""

from __future__ import annotations

import json
from enum import StrEnum
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ConfigDict, TypeAdapter, ValidationError

from querycad_contracts import AnswerType, Part

from .items import BadBenchmark, Item
from .rules import expression, meant, within_tolerance
from .systems import Reply


class FailureClass(StrEnum):
    """Where did a wrong answer come from?"""

    SYNTAX = "syntax"
    REASONING = "reasoning"
    MASKS = "masks"
    INTERFACE = "interface"
    LABEL = "label"


class Override(BaseModel):
    """A person's judgement of one wrong answer."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    failure: FailureClass
    note: str
    """What was measured or read that shows it."""


_OVERRIDES = TypeAdapter(dict[str, Override])
_BY_CATEGORY = {
    "bad_input": FailureClass.INTERFACE,
    "internal": FailureClass.INTERFACE,
    "limit": FailureClass.SYNTAX,
    "program": FailureClass.SYNTAX,
    "not_understood": FailureClass.REASONING,
    "not_grounded": FailureClass.MASKS,
    "unexpected": FailureClass.REASONING,
}
_MEASURES = ("radius", "diameter", "depth", "height", "width", "length", "thickness", "edge_distance")
_VECTORS = ("center", "extents", "opening", "tip", "local_size")


def failure_class(item: Item, reply: Reply) -> FailureClass:
    """Which class does the record of a wrong answer fall into?"""
    if reply.failure is not None:
        if reply.missing_attribute is not None:
            return FailureClass.INTERFACE
        return _BY_CATEGORY.get(reply.failure, FailureClass.INTERFACE)
    if reply.value is None:
        return FailureClass.REASONING
    if expression(item.label) is not None:
        return _by_search(reply) if not _is_count(reply.value) else FailureClass.MASKS
    label = meant(item.label)
    if _is_count(label) and _is_count(reply.value):
        return FailureClass.MASKS
    if not _is_triple(reply) and _differ_in_number(label, reply.value):
        return FailureClass.MASKS
    if _form(label) != _form(reply.value) or _is_other_measure(label, reply.parts, item):
        return FailureClass.REASONING
    return _by_search(reply)


def _by_search(reply: Reply) -> FailureClass:
    return FailureClass.MASKS if "find_parts(" in (reply.code or "") else FailureClass.REASONING


def _is_count(value: Any) -> bool:
    return isinstance(value, int) and not isinstance(value, bool)


def _is_triple(reply: Reply) -> bool:
    return reply.type in (AnswerType.POINT, AnswerType.DIRECTION, AnswerType.SIZE)


def _differ_in_number(label: Any, value: Any) -> bool:
    """Are both lists of the same kind of thing, or one a list of the other, in different numbers?"""
    if isinstance(label, set | frozenset):
        label = list(label)
    labels = label if isinstance(label, list) else [label]
    values = value if isinstance(value, list) else [value]
    return len(labels) != len(values) and {_form(v) for v in labels} == {_form(v) for v in values}


def _form(value: Any) -> str:
    """What kind of thing is a value, how many aside?"""
    if isinstance(value, set | frozenset):
        value = list(value)
    if isinstance(value, list):
        inner = {_form(entry) for entry in value}
        return f"list of {inner.pop()}" if len(inner) == 1 else "list"
    if isinstance(value, bool):
        return "boolean"
    return "number" if isinstance(value, int | float) else type(value).__name__


def _is_other_measure(label: Any, parts: tuple[Part, ...], item: Item) -> bool:
    """Does some measure of the parts found agree with the label?"""
    if not parts or isinstance(label, str):
        return False
    for name in _MEASURES:
        values = [getattr(part, name) for part in parts]
        if None not in values and within_tolerance(values, label, item):
            return True
    steps = [max(part.radii) for part in parts if part.radii]  # a stepped hole's radius is that of its narrowest bore
    return within_tolerance(steps, label, item) or any(
        within_tolerance([list(value) for part in parts if (value := getattr(part, name)) is not None], label, item)
        for name in _VECTORS
    )


def read_overrides(path: Path) -> dict[str, Override]:
    """What did a person overrule, by the question's key? Nothing when there is no such file. Raises BadBenchmark."""
    if not path.is_file():
        return {}
    try:
        return _OVERRIDES.validate_json(path.read_bytes())
    except (ValidationError, json.JSONDecodeError) as error:
        raise BadBenchmark(f"{path}: {error}") from error
