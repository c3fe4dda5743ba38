"""The lines of a program that select parts: find_parts, filters, superlatives."""

from __future__ import annotations

import json
from dataclasses import dataclass, replace

from querycad_contracts import AnswerType

from .expressions import FOUND, answer_type, compared, guard, literal, of_part, of_shape
from .meaning import (
    AnyOf,
    Bottom,
    Bound,
    ByDistance,
    ByMeasure,
    ByPlace,
    Centered,
    Described,
    Filter,
    Get,
    Holding,
    Measure,
    NounClass,
    Order,
    Origin,
    Phrase,
    Placed,
    Rank,
    Relation,
    Seen,
    Selection,
    Whole,
)

_LINE = 90
_FEW = 1e-3
"""Below this, in metres, 'exactly' is within 5 percent: drawing accuracy of 0.05 mm would be too coarse."""


@dataclass(frozen=True, slots=True)
class Chosen:
    """A variable of the program: one part when `single`, else a list of parts."""

    name: str
    single: bool
    plural: bool

    @property
    def first(self) -> str:
        """The expression of its only part."""
        return self.name if self.single else f"{self.name}[0]"

    @property
    def listed(self) -> str:
        """The expression of all its parts as a list."""
        return f"[{self.name}]" if self.single else self.name


class Selecting:
    """Writes selections into the lines of a program; the same selection only once."""

    def __init__(self) -> None:
        self.lines: list[str] = []
        self._names: set[str] = set()
        self._chosen: dict[Selection, Chosen] = {}

    def name(self, *wanted: str) -> str:
        """A name not taken yet: the first of `wanted` that is free, else the last with a number."""
        numbered = (f"{wanted[-1]}_{i}" for i in range(2, 100))
        name = next(name for name in (*wanted, *numbered) if name not in self._names)
        self._names.add(name)
        return name

    def choose(self, target: Selection) -> Chosen:
        """Write the selection into 'parts', or 'part' when a superlative picks one."""
        if target not in self._chosen:
            self._chosen[target] = self._selected(target)
        return self._chosen[target]

    def every(self, target: Selection) -> Chosen:
        """Write the selection as a list, superlatives with all that tie."""
        return self.choose(Selection(tuple(replace(phrase, plural=True) for phrase in target.phrases)))

    def condition(self, condition: Filter, noun: NounClass) -> str:
        """Which condition on the part 'p' is the filter? Preceded by 'hasattr' where it may lack the measure."""
        measured = condition.bounds[0] if isinstance(condition, AnyOf) else condition
        has = guard(measured.measure, noun) if isinstance(measured, Bound) else ""
        written = self._condition(condition)
        return f"{has} and {written}" if has else written

    def bound(self, left: str, measure: Measure, relation: Relation, low: float, high: float | None) -> str:
        """Which condition says that `left`, a value of `measure`, compares so with a stated value?"""
        length = answer_type(measure, False) is AnswerType.LENGTH
        if relation is Relation.ABOUT:
            return f"close({left}, {literal(low)}, {literal(abs(low) * 0.1)})"
        if relation is Relation.EQUAL and (not length or abs(low) < _FEW):
            return f"close({left}, {literal(low)}, {literal(abs(low) * (0.05 if length else 0.01))})"
        slack = FOUND if length else abs(low) * 1e-4
        return compared(left, relation, literal(low), None if high is None else literal(high), slack)

    def _selected(self, target: Selection) -> Chosen:
        name = self.name("parts", "others")
        if len(target.phrases) == 1:
            return self._phrase(target.phrases[0], name)
        if any(phrase.filters or phrase.ranks for phrase in target.phrases):
            terms = [self._phrase(phrase, self.name("found")).listed for phrase in target.phrases]
        else:
            terms = [_find(phrase) for phrase in target.phrases]
        self.lines.append(f"{name} = {' + '.join(terms)}")
        return Chosen(name, False, True)

    def _phrase(self, phrase: Phrase, name: str) -> Chosen:
        self.lines.append(f"{name} = {_find(phrase)}")
        beside = [one for one in phrase.filters if _is_beside(one) and not phrase.plural]
        filters = [one for one in phrase.filters if one not in beside]
        for line in _packed([self.condition(condition, phrase.noun_class) for condition in filters]):
            self.lines.append(f"{name} = [p for p in {name} if {line}]")
        for condition in beside:  # 'the shank below the head': the only one, wherever it lies
            line = self.condition(condition, phrase.noun_class)
            self.lines.append(f"{name} = [p for p in {name} if {line}] or {name}")
        self._exclude_references(name, phrase)
        for i, rank in enumerate(phrase.ranks):
            if i + 1 < len(phrase.ranks) or rank.count > 1 or rank.nth > 1 or phrase.plural:
                self._rank_list(name, rank)
                continue
            single = self.name("part" if name == "parts" else "other")
            pick = "max" if rank.largest else "min"
            self.lines.append(f"{single} = {pick}({name}, key=lambda p: {self._key(rank.order)})")
            return Chosen(single, True, False)
        return Chosen(name, False, phrase.plural)

    def _exclude_references(self, name: str, phrase: Phrase) -> None:
        """The hole closest to the M5 hole is not the M5 hole itself."""
        for rank in phrase.ranks:
            reference = rank.order.reference if isinstance(rank.order, ByDistance) else None
            if not isinstance(reference, Selection):
                continue
            if reference.phrases[0].noun == phrase.noun:
                ids = self.name("ids")
                self.lines.append(f"{ids} = [q.id for q in {self.choose(reference).listed}]")
                self.lines.append(f"{name} = [p for p in {name} if p.id not in {ids}]")

    def _rank_list(self, name: str, rank: Rank) -> None:
        """The first `count` parts of an order, or all that tie for the `nth` place."""
        key = self._key(rank.order)
        if rank.count > 1:
            reverse = ", reverse=True" if rank.largest else ""
            self.lines.append(f"{name} = sorted({name}, key=lambda p: {key}{reverse})[:{rank.count}]")
            return
        sizes = self.name("sizes")
        index = -rank.nth if rank.largest else rank.nth - 1
        self.lines.append(f"{sizes} = different([{key} for p in {name}])")
        self.lines.append(f"{name} = [p for p in {name} if close({key}, {sizes}[{index}], {FOUND:g})]")

    def _key(self, order: Order) -> str:
        match order:
            case ByMeasure(measure):
                return of_part(measure, "p")
            case ByPlace(axis):
                return f"p.center[{axis}]"
            case ByDistance(None):
                return "p.edge_distance()"
            case ByDistance(Selection() as reference):
                return f"min(p.distance_to(q) for q in {self.choose(reference).listed})"
            case ByDistance(Origin()):
                return "distance(p.center, (0.0, 0.0, 0.0))"
            case _:
                return "distance(p.center, shape.center)"

    def _condition(self, condition: Filter) -> str:  # noqa: PLR0911 - one case a kind of filter
        match condition:
            case Bound(measure, relation, float(low), high):
                return self.bound(of_part(measure, "p"), measure, relation, low, high)
            case Bound(measure, relation, low, _):
                return compared(of_part(measure, "p"), relation, self._reference(low))
            case AnyOf(bounds):
                return f"({' or '.join(self._condition(one) for one in bounds)})"
            case Placed(axis, relation, reference):
                center = "shape.center" if isinstance(reference, Whole) else f"{self.choose(reference).first}.center"
                symbol, sign = (">", "+") if relation is Relation.MORE else ("<", "-")
                return f"p.center[{axis}] {symbol} {center}[{axis}] {sign} 5e-05"
            case Centered(()):
                return "sum(close(p.center[i], shape.center[i]) for i in range(3)) >= 2"
            case Centered(axes):
                return " and ".join(f"close(p.center[{axis}], shape.center[{axis}])" for axis in axes)
            case Seen(side, visible):
                return f'"{side.value}" {"in" if visible else "not in"} p.sides'
            case Holding(members):
                return f"any(q.is_in(p) for q in {self.choose(members).listed})"
            case Bottom(form, holds):
                return f'hasattr(p, "bottom") and p.bottom {"==" if holds else "!="} "{form}"'
            case Described(description, holds):
                ids = self.name("ids")
                self.lines.append(f"{ids} = [q.id for q in find_parts({_quoted(description)})]")
                return f"p.id {'in' if holds else 'not in'} {ids}"
            case _:
                return f"any(p.is_in(q) for q in {self.choose(condition.reference).listed})"

    def _reference(self, value: object) -> str:
        """The measure of the one part, or of the model, that others are compared with."""
        assert isinstance(value, Get)
        measure = value.measures[0]
        if isinstance(value.target, Whole):
            return of_shape(measure) or "shape.height"
        return of_part(measure, self.choose(value.target).first)


def _is_beside(condition: Filter) -> bool:
    """Does a filter say where a part lies as seen from another one?"""
    return isinstance(condition, Placed) and isinstance(condition.reference, Selection)


def _find(phrase: Phrase) -> str:
    """'The hole' where one is meant and nothing else picks it: of several SegCAD takes the one that stands out."""
    several = phrase.plural or phrase.filters or phrase.ranks or phrase.sample
    description = phrase.description if several else f"the {phrase.description}"
    if not phrase.sides:
        return f"find_parts({_quoted(description)})"
    description = f"{description} on {phrase.sides[0].value}" if phrase.stands else description
    return f"find_parts({_quoted(description)}, sides={json.dumps([side.value for side in phrase.sides])})"


def _quoted(text: str) -> str:
    return json.dumps(text, ensure_ascii=False)


def _packed(conditions: list[str]) -> list[str]:
    """Conditions joined by 'and' into lines that stay readable."""
    lines: list[str] = []
    for condition in conditions:
        if lines and len(lines[-1]) + len(condition) < _LINE:
            lines[-1] = f"{lines[-1]} and {condition}"
        else:
            lines.append(condition)
    return lines
