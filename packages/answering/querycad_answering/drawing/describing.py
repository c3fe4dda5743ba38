"""What is this model? Size, bodies, likely unit, features as on a drawing, standard parts, and what can be asked."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence

from querycad_contracts import Answer, Callout, Description, LengthUnit, ModelSummary, Part, PartKind, TableKind

from .callouts import callouts, carried_sections, ids_text
from .numbers import direction, length, significant, sizes, unit_name
from .tables import alike_bodies, distinct, is_fastener, product_name

FEATURES_SHOWN = 20
"""Lines of features in the text; `features` has them all."""
QUESTIONS_SHOWN = 8
IDS_SHOWN = 6
BODIES_SHOWN = 15
ROUND_SHARE = 0.6
"""A unit is the likely one where this share of the sizes, or more, are round numbers in it, and fewer in the other."""
_GRIDS = {"mm": (0.05e-3,), "in": (0.0254 / 64, 0.0254 / 100)}
"""Round numbers: twentieths of a millimetre; 64ths and hundredths of an inch."""
_EXACT = 2e-7
"""How near to a round number, metres: files have six decimals of a millimetre, or fewer."""

SURFACES = tuple(kind for kind in PartKind if kind.is_surface)
"""Surfaces by their shape alone, each part of some feature."""
_IN_FEATURES = frozenset(kind for kind in PartKind if not kind.is_feature) | {PartKind.TOOTH, PartKind.CROSSBAR}
"""Kinds that a description leaves out: blocks and plates of the body, walls between features, and the wholes."""

Ask = Callable[[str], Answer | None]
"""The answer to a question on the model; None where there is none, or it is unsure."""


def is_bare_surface(part: Part) -> bool:
    """Is it a surface by its shape alone, part of some feature? Not so a ball or dome, which is one itself."""
    return part.kind in SURFACES and not _is_ball(part)


def _is_ball(part: Part) -> bool:
    return part.kind is PartKind.SPHERE and "outer" in part.tags


def featured(parts: Sequence[Part]) -> list[Part]:
    """The features that a drawing would call out: no bare surfaces, walls or wholes."""
    return [part for part in parts if part.kind not in _IN_FEATURES or _is_ball(part)]


def describe(
    summary: ModelSummary, parts: Sequence[Part], unit: LengthUnit = LengthUnit.MM, ask: Ask | None = None
) -> Description:
    """The description. Suggested are only questions that `ask` answers, and with the true value; none without it."""
    known = {part.id: part for part in parts}
    carried = carried_sections(parts)
    told = [part for part in featured(parts) if part.id not in carried]
    features = callouts(distinct(told), unit, known)
    patterns = callouts((part for part in parts if part.kind is PartKind.PATTERN), unit, known)
    shape = summary.shape
    found = Description(
        name=shape.name,
        unit=unit,
        size=shape.extents,
        volume=shape.volume,
        area=shape.area,
        bodies=summary.body_count,
        faces=shape.face_count,
        declared_units=summary.units,
        drawn_in=_drawn_in(parts),
        stands_along=stands_along(parts),
        material_thickness=shape.thickness,
        features=features,
        patterns=patterns,
        standard_parts=tuple(_standard(parts)),
        warnings=summary.warnings,
        questions=tuple(_suggested(parts, ask)) if ask is not None else (),
        text="",
    )
    return found.model_copy(update={"text": "\n".join(_lines(found, parts))})


def listing(found: Iterable[Callout], most: int | None = None) -> list[str]:
    """Callouts with the ids of their parts, in two columns; after `most` the rest is counted."""
    rows = list(found)
    shown = rows[:most]
    width = max((len(row.text) for row in shown), default=0)
    lines = [f"  {row.text.ljust(width)}  {ids_text(row.ids, IDS_SHOWN)}" for row in shown]
    return [*lines, f"  and {len(rows) - len(shown)} more"] if len(rows) > len(shown) else lines


def _lines(found: Description, parts: Sequence[Part]) -> Iterator[str]:
    unit = found.unit
    bodies = "one body" if found.bodies == 1 else f"{found.bodies} bodies"
    size = f"{sizes(found.size, unit)} {unit.value} (x, y, z)"
    yield f"{found.name or 'a model without a name'}: {bodies}, {found.faces} faces, {size}"
    volume = significant(found.volume / unit.metres**3)
    area = significant(found.area / unit.metres**2)
    yield f"volume {volume} {unit.value}³, surface {area} {unit.value}²"
    yield "; ".join(_facts(found))
    if found.bodies > 1:
        yield f"bodies, in {unit_name(unit)}"
        yield from listing(_bodies(parts, unit), BODIES_SHOWN)
    if found.standard_parts:
        yield "standard parts"
        yield from (f"  {one}" for one in found.standard_parts)
    if found.features:
        yield f"features, in {unit_name(unit)}"
        yield from listing(found.features, FEATURES_SHOWN)
    if found.patterns:
        yield f"patterns, in {unit_name(unit)}"
        yield from listing(found.patterns, FEATURES_SHOWN)
    if found.warnings:
        yield "notes"
        yield from (f"  {warning}" for warning in found.warnings)
    if found.questions:
        yield "you may ask"
        yield from (f"  {question}" for question in found.questions)


def _facts(found: Description) -> Iterator[str]:
    declared = ", ".join(found.declared_units) or "no unit"
    likely = f", its sizes are round numbers in {found.drawn_in}" if found.drawn_in else ""
    yield f"the file declares {declared}{likely}"
    if found.stands_along:
        yield f"it likely stands along {found.stands_along}"
    if found.material_thickness:
        yield f"material {length(found.material_thickness, found.unit)} {found.unit.value} thick"


def _bodies(parts: Sequence[Part], unit: LengthUnit) -> Iterator[Callout]:
    for group in alike_bodies(TableKind.BODIES, parts):
        count = f"{len(group)}x " if len(group) > 1 else ""
        text = f"{count}{product_name(group) or 'body'} ({sizes(group[0].extents, unit)})"
        yield Callout(text=text, kind=PartKind.BODY, ids=tuple(part.id for part in group))


def _standard(parts: Sequence[Part]) -> Iterator[str]:
    """Fasteners by form or name, and what is named after a standard; bearings."""
    for group in alike_bodies(TableKind.BODIES, parts):
        name = product_name(group)
        words = name.upper().replace("-", " ").split()
        named = len(words) > 1 and words[0] in ("ISO", "DIN", "EN", "ANSI", "ASME", "JIS", "GB", "BS")
        if named or is_fastener(group[0]):
            yield (f"{len(group)}x " if len(group) > 1 else "") + (name or "fastener")
    yield from (one.text for one in callouts(part for part in parts if part.kind is PartKind.BEARING))


def _drawn_in(parts: Sequence[Part]) -> str:
    """In which unit are most sizes round numbers?"""
    sizes = {
        round(size, 8)
        for part in parts
        if part.kind not in _IN_FEATURES or part.kind is PartKind.BODY
        for size in (part.diameter, part.depth, part.thickness, part.height, part.chamfer_size, *part.extents)
        if size and size > _GRIDS["mm"][0]
    }
    if not sizes:
        return ""
    shares = {
        unit: sum(any(abs(size - round(size / grid) * grid) < _EXACT for grid in grids) for size in sizes) / len(sizes)
        for unit, grids in _GRIDS.items()
    }
    best, other = sorted(shares, key=lambda unit: shares[unit], reverse=True)
    return best if shares[best] >= ROUND_SHARE and shares[best] > shares[other] else ""


def stands_along(parts: Sequence[Part]) -> str:
    """Along which axis of the file does it likely stand? Its axis of rotation, else square to its largest flat face."""
    whole = next((part for part in parts if part.kind is PartKind.MODEL), None)
    faces = [part for part in parts if part.kind is PartKind.FACE and part.normal and part.local_size]
    largest = max(faces, key=lambda face: math.prod((face.local_size or (0.0,))[:2]), default=None)
    way = (whole.axis if whole else None) or (largest.normal if largest else None)
    said = direction(way) if way else ""
    return said[1:] if len(said) == 2 else ""


def _suggested(parts: Sequence[Part], ask: Ask) -> Iterator[str]:
    count = 0
    for question, truth in dict(_candidates(parts)).items():
        if count < QUESTIONS_SHOWN and _is_true(ask(question), truth):
            count += 1
            yield question


def _is_true(answer: Answer | None, truth: _Truth) -> bool:
    """Is the answer what the parts say that the question was made of?"""
    if answer is None:
        return False
    values = answer.value if isinstance(answer.value, list) else [answer.value]
    same = all(any(_is_same(value, true) for true in truth) for value in values)
    return same and all(any(_is_same(value, true) for value in values) for true in truth)


def _is_same(value: object, true: float) -> bool:
    return isinstance(value, int | float) and math.isclose(value, true, rel_tol=1e-6)


_Truth = tuple[float, ...]
"""The different values that answer a question, SI."""


def _candidates(parts: Sequence[Part]) -> Iterator[tuple[str, _Truth]]:
    """Questions about what the model has with their answers, the most telling first."""
    by_kind: dict[PartKind, list[Part]] = {}
    for part in parts:
        by_kind.setdefault(part.kind, []).append(part)
    whole = next(iter(by_kind.get(PartKind.MODEL, [])), None)
    if whole is not None:
        yield "What are the overall dimensions?", whole.extents
    holes = by_kind.get(PartKind.HOLE, [])
    if len(holes) > 1:
        yield "How many holes are there?", (len(holes),)
    for kind, (question, measure) in _OF_KIND.items():
        values = [measure(part) for part in by_kind.get(kind, [])]
        if values and None not in values:
            truth = tuple({round(value, 9) for value in values if value is not None})
            yield question.format(*(("s", "are") if len(values) > 1 else ("", "is"))), truth
    circles = [part for part in by_kind.get(PartKind.PATTERN, []) if "bolt_circle" in part.tags]
    if len(circles) == 1 and circles[0].diameter:
        yield "What is the diameter of the bolt circle?", (circles[0].diameter,)
    gears = by_kind.get(PartKind.GEAR, [])
    if len(gears) == 1 and gears[0].count:
        yield "How many teeth does the gear have?", (gears[0].count,)
    yield from _of_bodies(parts)
    if holes and (deep := holes[-1].depth):
        yield f"How deep is {holes[-1].id.replace('-', ' ')}?", (deep,)
    if whole is not None and whole.volume and whole.area:
        yield "What is the volume of the part?", (whole.volume,)
        yield "What is the surface area of the part?", (whole.area,)


def _of_bodies(parts: Sequence[Part]) -> Iterator[tuple[str, _Truth]]:
    groups = alike_bodies(TableKind.BODIES, parts)
    for group in groups if len(groups) > 1 else ():
        name, volume = product_name(group), group[0].volume
        if name and len(group) > 1:
            yield f"How many {name} are there?", (len(group),)
        elif name and volume:
            yield f"What is the volume of the {name}?", (volume,)


_OF_KIND: dict[PartKind, tuple[str, Callable[[Part], float | None]]] = {
    PartKind.COUNTERBORE: ("How deep {1} the counterbore{0}?", lambda part: part.depth),
    PartKind.COUNTERSINK: ("What is the diameter of the countersink{0}?", lambda part: part.diameter),
    PartKind.BEND: ("What is the inside radius of the bend{0}?", lambda part: part.bend_radius),
    PartKind.RIB: ("How thick {1} the rib{0}?", lambda part: part.thickness),
    PartKind.SLOT: ("How wide {1} the slot{0}?", lambda part: part.width),
    PartKind.POCKET: ("How deep {1} the pocket{0}?", lambda part: part.depth),
    PartKind.FILLET: ("What is the radius of the fillet{0}?", lambda part: part.radius),
}
"""A question on the measure that each kind is known by; {0} is the plural's s, {1} the verb."""
