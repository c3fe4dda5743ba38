"""A program while it is written: its lines, the parts that it finds, and how natural its measures are."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

from querycad_contracts import AnswerType, Measure, Part, PartKind, PartQuery
from querycad_language.forms import Form
from querycad_language.lexicon import lexicon
from querycad_language.measures import WHOLE

from .meanings import CUT, Grade, level_width, options

_VECTORS = (".extents", ".center", ".half_extents", ".tip", ".opening", ".axis", ".normal")

_ROUND = frozenset((Measure.DIAMETER, Measure.OUTER_DIAMETER, Measure.INNER_DIAMETER))
_SLIM = frozenset((PartKind.SLOT, PartKind.CHANNEL, PartKind.GROOVE))
"""Kinds whose width is across their length."""


class Read(NamedTuple):
    """A measure that a program reads of parts of a kind: what it means there, and how natural that is."""

    measure: str
    kind: str
    expression: str
    grade: Grade


class Compared(NamedTuple):
    """What a yes or no rests on: the form of what is compared, None for angles, and the expression that gives it."""

    form: Form | None
    expression: str
    expects: AnswerType


@dataclass(frozen=True, slots=True)
class Written:
    """A program, the type of its result, the measures that it reads, and what its yes or no compares."""

    code: str
    expects: AnswerType
    reads: tuple[Read, ...] = ()
    option: int = 0
    compared: tuple[Compared, ...] = ()


Grounds = Mapping[PartQuery, tuple[Sequence[Part], int]]
"""The parts that each query of a form was grounded on, and which of its groundings that is."""


class Unwritable(Exception):
    """The form makes no sense of these parts: a distance with one part only, say."""


class Builder:
    """One program. `option`: which meaning of a measure is taken for these parts."""

    def __init__(self, grounds: Grounds, whole: Part, option: int, overall: bool) -> None:
        self.grounds = grounds
        self.whole = whole
        self.option = option
        self.overall = overall
        self.lines: list[str] = []
        self.names: dict[PartQuery, str] = {}
        self.reads: list[Read] = []
        self.compared: list[Compared] = []

    def parts(self, query: PartQuery) -> str:
        """The variable with the parts of a query."""
        if query not in self.names:
            name = "parts" if not self.names else f"others{len(self.names) if len(self.names) > 1 else ''}"
            self.names[query] = name
            _, sense = self.grounds[query]
            self.lines.append(f"{name} = find_parts({_call(query, sense)})")
        return self.names[query]

    def of(self, query: PartQuery) -> Sequence[Part]:
        """The parts that a query was grounded on."""
        return self.grounds[query][0]

    def all_of(self, *queries: object) -> list[Part]:
        """The parts of all that are queries."""
        return [part for query in queries if isinstance(query, PartQuery) for part in self.of(query)]

    def read(self, measure: Measure, parts: Sequence[Part], scalar: bool = False) -> str:
        """The expression of a measure for parts of these kinds, '{0}' for the part; one number of each if `scalar`."""
        if not parts:
            return "{0}." + measure.value
        usual, _ = Counter(part.kind for part in parts).most_common(1)[0]
        sample = next(part for part in parts if part.kind == usual)
        called = [query.noun for query, (found, _) in self.grounds.items() if found is parts]
        slim = any(noun.senses[0].kind[0] in _SLIM for name in called if (noun := lexicon().nouns.get(name)))
        known = options(measure, sample, self.overall, slim)
        if scalar:
            known = [one for one in known if not (one[0].startswith("[") or one[0].endswith(_VECTORS))]
        if self.option >= len(known):
            raise Unwritable
        expression, grade = known[self.option]
        self.reads.append(Read(measure.value, usual, expression, grade))
        if "math." in expression:
            self.lines.insert(0, "import math")
        return expression

    def beside(self, measure: Measure, others: Sequence[Measure], parts: Sequence[Part]) -> str:
        """The same where length and width are asked together: the longer side and the other one."""
        box = (Measure.WIDTH, Measure.DEPTH, Measure.HEIGHT)  # along x, y, z, where all three are asked
        if set(box) == set(others) and not any(part.kind in CUT for part in parts):
            return f"{{0}}.extents[{box.index(measure)}]"
        if measure is Measure.LENGTH and _ROUND.intersection(others) and all(p.kind in WHOLE and p.axis for p in parts):
            return self.read(Measure.AXIAL_EXTENT, parts)  # of what is turned, beside its diameter
        sides = {Measure.LENGTH: "max({0}.extents[:2])", Measure.WIDTH: "min({0}.extents[:2])"}
        if {*sides, Measure.HEIGHT} == set(others) and all(part.kind in WHOLE for part in parts):
            upright = self.read(measure, parts) if measure is Measure.HEIGHT else ""
            return sides.get(measure, upright and "{0}.extents[2]")
        if measure is Measure.WIDTH and Measure.HEIGHT in others and Measure.LENGTH not in others:
            level = {level_width(part) for part in parts}
            if len(level) == 1 and None not in level:  # both are not read in one direction
                return f"{{0}}.extents[{level.pop()}]"
        if {Measure.LENGTH, Measure.WIDTH} <= set(others) and measure in (Measure.LENGTH, Measure.WIDTH):
            if all(part.kind in WHOLE for part in parts):
                return "max({0}.extents)" if measure is Measure.LENGTH else "sorted({0}.extents)[1]"
            if all(part.local_size is not None for part in parts):
                return f"{'max' if measure is Measure.LENGTH else 'min'}({{0}}.local_size[:2])"
        return self.read(measure, parts)

    def chosen(self, modes: Mapping[str, str], kind: str, measure: str = "distance") -> str:
        """The one of several named meanings of a distance, or a side, that it takes. Raises Unwritable: fewer."""
        if self.option >= len(modes):
            raise Unwritable
        name = list(modes)[self.option]
        self.reads.append(Read(measure, kind, name, "own" if self.option == 0 else "derived"))
        return modes[name]


@lru_cache(maxsize=512)
def _call(query: PartQuery, sense: int) -> str:
    """The argument of find_parts: the query as a dictionary, without what is empty."""
    implied = {"words", "known"} if query.known and query.words == tuple(query.noun.split()) else set()
    fields = query.model_dump(mode="json", exclude_defaults=True, exclude=implied) | ({"sense": sense} if sense else {})
    text = json.dumps(fields, ensure_ascii=False)
    return text.replace(": true", ": True").replace(": false", ": False").replace(": null", ": None")
