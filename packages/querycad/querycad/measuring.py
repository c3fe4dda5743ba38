"""Measuring parts by their ids: the program that does it, and what it gives."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from math import inf
from typing import Any

from querycad_answering.programs import Grounds, Unwritable, Written, write
from querycad_contracts import AnswerType, Measure, Part, PartKind, PartQuery, RunOutcome, RunStatus
from querycad_language.forms import Get
from querycad_language.measures import answer_type, of_several

UNITS = {Measure.MASS: "kg", Measure.INERTIA: "kg m2"}
"""What takes a density, and its unit, which no `Unit` of an answer is."""


class NoValue(ValueError):
    """A part has no such measure, or a measurement could not be made; `str()` says why."""


def measuring(get: Get, parts: Sequence[Part], whole: Part, *, several: bool) -> tuple[str, AnswerType]:
    """The program that measures, and the type of its value.

    Raises NoValue where it makes no sense of these parts, ValueError for a density that nothing has.
    """
    (measure,) = get.measures
    if measure in (Measure.FACE_COUNT, Measure.EDGE_COUNT):
        if parts and (several or parts[0].kind is not PartKind.MODEL):
            raise NoValue("faces and edges are counted of the whole model; a part's `faces` are listed")
        return f"solution = shape.{measure.value}", AnswerType.COUNT
    if get.density is not None and not 0 < get.density < inf:
        raise ValueError(f"a density is more than 0 kg/m3, not {get.density:g}")
    if several and not parts:
        raise NoValue("no part is given to be measured")
    if measure in UNITS and get.density is None:
        raise NoValue(f"a file holds no density: give one in kg/m3 for the {measure.value}, such as density=7850")
    scalar = answer_type(measure)
    queries = [PartQuery(ids=(part.id,)) for part in parts]
    programs = [
        _written(replace(get, target=query), {query: ((part,), 0)}, whole)
        for query, part in zip(queries, parts, strict=True)
    ]
    if not several:
        (written,) = programs or [_written(get, {}, whole)]
        return written.code, scalar if written.expects is of_several(written.expects) else written.expects
    lines = ["of_each = []"]
    for written in programs:
        one = "of_each += solution if isinstance(solution, list) and len(solution) == 1 else [solution]"
        lines += [written.code, one]
    return "\n".join([*lines, "solution = of_each"]), of_several(scalar)


def _written(get: Get, grounds: Grounds, whole: Part) -> Written:
    """The program, where the measure is one that a part of this kind has.

    Its own, or derived where no part has it as its own. What a question may stretch, such as the width across flats of
    what has no flats, is refused: here nobody weighs what is meant.
    """
    ((parts, _),) = grounds.values() or (((whole,), 0),)
    measure, part = get.measures[0], parts[0]
    own = getattr(part, measure.value.replace("centre", "center"), "derived") is not None
    try:
        written = write(get, grounds, whole)
    except Unwritable:
        written = None
    if written is None or any(read.grade != "own" and not (own and read.grade == "derived") for read in written.reads):
        raise NoValue(f"{measure.value.replace('_', ' ')} is not a measure of {part.id}, a {part.kind}")
    return written


def value_of(outcome: RunOutcome, model: str) -> Any:
    """What a program gave that measures the model of this name. Raises NoValue where it gave nothing."""
    missing = outcome.missing_attribute
    if missing is not None:
        raise NoValue(f"{missing.part or model} has no {missing.attribute}")
    if outcome.status is not RunStatus.OK:
        raise NoValue(outcome.message)
    return outcome.value
