"""What is different between two models? Their parts are matched by what a drawing would call them, and by place."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Callable, Sequence
from itertools import groupby

from querycad_contracts import Bottom, Change, ChangeKind, Comparison, LengthUnit, ModelSummary, Part, Vector
from querycad_contracts.vectors import ORIGIN, sub

from .callouts import callout, carried_sections, ids_text
from .describing import featured
from .numbers import length, significant, sizes, unit_name

SAME_PLACE_M = 5e-6
"""Of two files of one part: STEP has six decimals of a millimetre, or fewer; a drawing has two."""
SAME_VOLUME = 1e-5
"""Relative: integration over freeform faces is not finer."""

Side = tuple[ModelSummary, Sequence[Part]]
"""A model: its summary and all its parts."""


def compare(before: Side, after: Side, unit: LengthUnit = LengthUnit.MM) -> Comparison:
    """What became of the features and bodies of `before` in `after`?

    Parts with the same callout in the same place are the same. Of the rest, what has the same kind and place was
    changed, what has the same callout was moved, the nearest first; all else was removed or added. A model that was
    moved as a whole, without turning, is compared where it was.
    """
    (summary_a, parts_a), (summary_b, parts_b) = before, after
    shift = _shift(summary_a, summary_b)
    told_a = [_Told(part, parts_a, unit, ORIGIN) for part in _compared(parts_a)]
    told_b = [_Told(part, parts_b, unit, shift or ORIGIN) for part in _compared(parts_b)]
    pairs = _matched(told_a, told_b, _text, SAME_PLACE_M)
    same = len(pairs)
    left_a, left_b = _left(told_a, told_b, pairs)
    changed = _matched(left_a, left_b, _kind, SAME_PLACE_M)
    left_a, left_b = _left(left_a, left_b, changed)
    moved = _matched(left_a, left_b, _text, math.inf)
    left_a, left_b = _left(left_a, left_b, moved)
    changes = [
        *_changes(ChangeKind.ADDED, [(None, each) for each in left_b]),
        *_changes(ChangeKind.REMOVED, [(each, None) for each in left_a]),
        *_changes(ChangeKind.CHANGED, changed),
        *_changes(ChangeKind.MOVED, moved),
    ]
    found = Comparison(
        unit=unit,
        same=same,
        changes=tuple(changes),
        shift=shift,
        size_before=summary_a.shape.extents,
        size_after=summary_b.shape.extents,
        volume_before=summary_a.shape.volume,
        volume_after=summary_b.shape.volume,
        warnings=tuple(
            f"{which}: {warning}"
            for which, summary in (("before", summary_a), ("after", summary_b))
            for warning in summary.warnings
        ),
        text="",
    )
    return found.model_copy(update={"text": "\n".join(_lines(found))})


class _Told:
    """A part, what it is called, and where it is after `shift` is taken back."""

    def __init__(self, part: Part, parts: Sequence[Part], unit: LengthUnit, shift: Vector) -> None:
        self.part = part
        self.text = callout(part, unit, {each.id: each for each in parts})
        self.place = sub(
            part.center if part.bottom is Bottom.THROUGH else part.opening or part.tip or part.center, shift
        )


def _text(told: _Told) -> str:
    return told.text


def _kind(told: _Told) -> str:
    return told.part.kind


_Pair = tuple["_Told | None", "_Told | None"]


def _compared(parts: Sequence[Part]) -> list[Part]:
    """Features that a drawing would call out, and the bodies of an assembly."""
    bodies = [part for part in parts if part.kind == "body"]
    carried = carried_sections(parts)
    features = [part for part in featured(parts) if part.id not in carried]
    return features + (bodies if len(bodies) > 1 else [])


def _shift(before: ModelSummary, after: ModelSummary) -> Vector | None:
    """By how much was the whole moved? None where it was not, or is not the same size any more."""
    a, b = before.shape, after.shape
    if any(abs(p - q) > SAME_PLACE_M for p, q in zip(a.extents, b.extents, strict=True)):
        return None
    shift = sub(b.center, a.center)
    return shift if math.hypot(*shift) > SAME_PLACE_M else None


def _matched(left: Sequence[_Told], right: Sequence[_Told], key: Callable[[_Told], str], within: float) -> list[_Pair]:
    """Pairs with the same key and at most so far apart, the nearest first, each part once."""
    alike = defaultdict[str, list[int]](list)
    for j, b in enumerate(right):
        alike[key(b)].append(j)
    near = sorted((math.dist(a.place, right[j].place), i, j) for i, a in enumerate(left) for j in alike.get(key(a), ()))
    pairs: list[_Pair] = []
    taken_a, taken_b = set[int](), set[int]()
    for distance, i, j in near:
        if distance <= within and i not in taken_a and j not in taken_b:
            taken_a.add(i)
            taken_b.add(j)
            pairs.append((left[i], right[j]))
    return pairs


def _left(left: list[_Told], right: list[_Told], pairs: Sequence[_Pair]) -> tuple[list[_Told], list[_Told]]:
    """Those that no pair has."""
    taken = {id(each) for pair in pairs for each in pair}
    return [a for a in left if id(a) not in taken], [b for b in right if id(b) not in taken]


def _changes(kind: ChangeKind, pairs: Sequence[_Pair]) -> list[Change]:
    """One change for all that changed alike; what moved is told one by one."""

    def texts(pair: _Pair) -> tuple[str, str]:
        return tuple(each.text if each is not None else "" for each in pair)  # type: ignore[return-value]

    changes = []
    for (before, after), alike in groupby(sorted(pairs, key=texts), key=texts):
        members = list(alike)
        for some in [[each] for each in members] if kind is ChangeKind.MOVED else [members]:
            by = None
            if kind is ChangeKind.MOVED and (a := some[0][0]) is not None and (b := some[0][1]) is not None:
                by = sub(b.place, a.place)
            changes.append(
                Change(
                    kind=kind,
                    before=before,
                    after=after,
                    ids_before=tuple(a.part.id for a, _ in some if a is not None),
                    ids_after=tuple(b.part.id for _, b in some if b is not None),
                    by=by,
                )
            )
    return changes


def _lines(found: Comparison) -> list[str]:
    unit = found.unit
    lines = []
    if any(abs(p - q) > SAME_PLACE_M for p, q in zip(found.size_before, found.size_after, strict=True)):
        lines.append(f"size {sizes(found.size_before, unit)} -> {sizes(found.size_after, unit)} {unit}")
    if abs(found.volume_after - found.volume_before) > SAME_VOLUME * max(found.volume_before, found.volume_after):
        before, after = (significant(each / unit.metres**3) for each in (found.volume_before, found.volume_after))
        lines.append(f"volume {before} -> {after} {unit}³")
    if found.shift is not None:
        lines.append(f"the whole is moved by ({', '.join(length(each, unit) for each in found.shift)}) {unit}")
    for kind, changes in groupby(found.changes, key=lambda each: each.kind):
        lines.append(f"{kind}, in {unit_name(unit)}")
        lines += [f"  {_line(change, unit)}" for change in changes]
    same = "1 part is the same" if found.same == 1 else f"{found.same} parts are the same"
    notes = [f"note: {warning}" for warning in found.warnings]
    return [*lines, same, *notes] if lines else [f"no difference: {same}", *notes]


def _line(change: Change, unit: LengthUnit) -> str:
    count = max(len(change.ids_before), len(change.ids_after))
    many = f"{count}x " if count > 1 else ""
    if change.kind is ChangeKind.MOVED and change.by is not None:
        by = ", ".join(length(each, unit) for each in change.by)
        return f"{change.before} by ({by})  {change.ids_before[0]} -> {change.ids_after[0]}"
    if change.kind is ChangeKind.CHANGED:
        ids = f"{ids_text(change.ids_before)} -> {ids_text(change.ids_after)}"
        return f"{many}{change.before} -> {change.after}  {ids}"
    return f"{many}{change.before or change.after}  {ids_text(change.ids_before or change.ids_after)}"
