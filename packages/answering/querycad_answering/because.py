"""Why is it yes or no? The values that a program compared, as a second program that gives them."""

from __future__ import annotations

import re
from typing import NamedTuple

from querycad_contracts import AnswerType, Measure
from querycad_language.describe import describe
from querycad_language.forms import Check, Count, Distance, Get, Parallel, Uniform, Within
from querycad_language.measures import answer_type

from .candidates import Candidate

_COMPARED = re.compile(r"all\(.* for v in (?P<what>values)\)")
_OTHER = re.compile(r"all\(v [<>]=? (?P<what>.+) [-+] [\d.e+-]+ for v in values\)")
_ANGLES = re.compile(r"all\(.*? for angle in (?P<what>.+)\)")
_SAME = re.compile(r"len\((?P<what>different\(.+\))\) == 1")
_FITS = re.compile(r"all\(all\(.*\) for p in (?P<what>.+)\)")


class Ground(NamedTuple):
    """What an answer of yes or no rests on: what it is called, and what gives it."""

    called: str
    code: str
    expects: AnswerType


def grounds_of(candidate: Candidate) -> tuple[Ground, ...]:
    """Programs that give the values which this one compared, if it compared any."""
    form = candidate.reading.form
    if isinstance(form, Check):
        left = form.left
        if isinstance(left, Count):
            return _made(candidate, _COMPARED, left, AnswerType.COUNT, "{0}[0]")
        measure = Measure.LENGTH if isinstance(left, Distance) else left.measures[0]
        other = form.low if isinstance(form.low, Get) else None
        found = _made(candidate, _COMPARED, left, answer_type(measure))
        return found + (_made(candidate, _OTHER, other, answer_type(other.measures[0])) if other is not None else ())
    if isinstance(form, Uniform):
        return _made(candidate, _SAME, form.get, answer_type(form.get.measures[0]))
    if isinstance(form, Parallel):
        return _made(candidate, _ANGLES, None, AnswerType.ANGLE)
    if isinstance(form, Within):
        size = Get((Measure.SIZE,), form.target)
        return _made(candidate, _FITS, size, AnswerType.SIZE, "{0}[0].extents if len({0}) == 1 else None")
    return ()


def _made(
    candidate: Candidate,
    pattern: re.Pattern[str],
    form: Get | Count | Distance | None,
    kind: AnswerType,
    of: str = "{0}",
) -> tuple[Ground, ...]:
    before, _, result = candidate.written.code.rpartition("solution = ")
    found = pattern.fullmatch(result)
    if found is None:
        return ()
    called = "angles" if form is None else describe(form)
    return (Ground(called, f"{before}solution = {of.format(found['what'])}", kind),)
