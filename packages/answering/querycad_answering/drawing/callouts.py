"""What would a drawing say of a part? Like parts are called out once: '8x Ø16 THRU, counterbore Ø26 depth 8'."""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence

from querycad_contracts import Bottom, Callout, LengthUnit, Part, PartKind

from .numbers import degrees, length, sizes, unit_name
from .threads import thread_name

AT_45_DEGREES = math.radians(0.5)
"""A chamfer within this of 45 degrees is called 'C1'; others need their angle (ISO 2768-1 allows it half a degree)."""
SAME = 1e-6
"""Two radii are one step's where they differ by less, metres."""
_SYMBOLS = (("counterbore ", "⌴"), ("spotface ", "⌴SF "), ("countersink ", "⌵"), ("depth ", "↧"))
"""ISO 1101 and ASME Y14.5 write these for the words."""
MOST_IDS = 10_000
"""In a run of ids: more than any model has of one kind."""
_RUN = re.compile(r"([\w-]{1,80})-(\d{1,9})\.\.(\d{1,9})")
_SECTIONS = (PartKind.COUNTERBORE, PartKind.SPOTFACE, PartKind.COUNTERSINK, PartKind.CHAMFER)

Known = Mapping[str, Part]
"""Parts of the model by id, where a callout needs those that a part carries."""


def callouts(
    parts: Iterable[Part], unit: LengthUnit = LengthUnit.MM, known: Known | None = None, *, symbols: bool = False
) -> tuple[Callout, ...]:
    """The callouts of the parts, like ones together, in the order in which they come first. Lengths are in `unit`."""
    groups: dict[tuple[PartKind, str], list[str]] = {}
    for part in parts:
        groups.setdefault((part.kind, callout(part, unit, known, symbols=symbols)), []).append(part.id)
    return tuple(
        Callout(text=text if len(ids) == 1 else f"{len(ids)}x {text}", kind=kind, ids=tuple(ids))
        for (kind, text), ids in groups.items()
    )


def callout(part: Part, unit: LengthUnit = LengthUnit.MM, known: Known | None = None, *, symbols: bool = False) -> str:
    """What a drawing says of this one part; lengths are in `unit`, which is not named."""
    text = _WRITERS.get(part.kind, _by_measures)(part, unit, known or {})
    return with_symbols(text) if symbols else text


def with_symbols(text: str) -> str:
    """The same with the symbols of drawings for their words."""
    for word, symbol in _SYMBOLS:
        text = text.replace(word, symbol)
    return text


def ids_text(ids: Sequence[str], most: int = 8) -> str:
    """The ids in short, runs of numbers joined: 'hole-1..3, hole-5'; after `most` of these the rest is counted."""
    runs: list[tuple[str, int, int]] = []
    for part_id in ids:
        stem, _, tail = part_id.rpartition("-")
        at = int(tail) if stem and tail.isdecimal() else -1
        if runs and at > 0 and runs[-1][0] == stem and runs[-1][2] == at - 1:
            runs[-1] = (stem, runs[-1][1], at)
        else:
            runs.append((stem, at, at) if at >= 0 else (part_id, -1, -1))
    texts = [
        stem if first < 0 else f"{stem}-{first}" + (f"..{last}" if last > first else "") for stem, first, last in runs
    ]
    shown = sum(last - first + 1 if first >= 0 else 1 for _, first, last in runs[:most])
    more = f" and {len(ids) - shown} more" if len(runs) > most else ""
    return ", ".join(texts[:most]) + more


def ids_in(text: str) -> list[str]:
    """The ids that `ids_text` has told in short, of which it counted none: 'hole-1..3, hole-5' are four."""
    found: list[str] = []
    for each in filter(None, (one.strip() for one in text.split(","))):
        run = _RUN.fullmatch(each)
        first, last = (int(run[2]), int(run[3])) if run is not None else (1, 0)
        if run is not None and first <= last < first + MOST_IDS:
            found += [f"{run[1]}-{number}" for number in range(first, last + 1)]
        else:
            found.append(each)
    return found


def carried_sections(parts: Sequence[Part]) -> frozenset[str]:
    """Ids of counterbores, countersinks, spot faces and chamfers that the callout of their hole tells of."""
    sections = {part.id for part in parts if part.kind in _SECTIONS}
    return frozenset(child for part in parts if part.kind is PartKind.HOLE for child in part.children) & sections


def _hole(part: Part, unit: LengthUnit, known: Known) -> str:
    if part.diameter is None:
        return _by_measures(part, unit, known)
    thread = thread_name(part)
    first = thread or f"Ø{length(part.diameter, unit)}"
    if "threaded" in part.tags and thread is None:
        first += " threaded"
    if "conical" in part.tags and len(part.radii) > 1:
        first = "taper " + "/".join(f"Ø{length(2 * radius, unit)}" for radius in part.radii)
    sections = [known[child] for child in part.children if child in known and known[child].kind in _SECTIONS]
    told = [_section(section, unit) for section in sections]
    radii = [part.radius or 0.0, *(radius for section in sections for radius in section.radii)]
    steps = [r for r in part.radii if not any(abs(r - other) < SAME for other in radii)]
    if "conical" not in part.tags:
        name = "step" if sections or "counterbored" not in part.tags else "counterbore"
        told += [f"{name} Ø{length(2 * radius, unit)}" for radius in steps]
    if not sections and "countersunk" in part.tags:
        told.append("countersink" + (f" Ø{length(part.width, unit)}" if part.width else ""))
    if not sections and "spotfaced" in part.tags and not steps:
        told.append("spotface")
    drawn_for = [said for said in (part.label.partition("; ")[2],) if said]
    return ", ".join([_joined(first, _reach(part, unit)), *_counted(told), *drawn_for])


def _reach(part: Part, unit: LengthUnit) -> str:
    if part.bottom is Bottom.THROUGH:
        return "THRU"
    deep = f"depth {length(part.depth, unit)}" if part.depth else ""
    return f"{deep} into a bore" if part.bottom is Bottom.BORE and deep else deep


def _section(part: Part, unit: LengthUnit) -> str:
    """The counterbore, seat, countersink, spot face or chamfer of a hole."""
    if part.kind is PartKind.CHAMFER:
        return _chamfer(part, unit, {})
    wide = f"{'seat' if 'seat' in part.tags else part.kind.value} Ø{length(part.diameter or 0.0, unit)}"
    if part.kind is PartKind.COUNTERSINK:
        return wide + (f" x {degrees(part.angle)}" if part.angle else "")
    return wide + (f" depth {length(part.depth, unit)}" if part.depth else "")


def _chamfer(part: Part, unit: LengthUnit, _known: Known) -> str:
    if part.chamfer_size is None or part.angle is None:
        return "chamfer" + (f" {length(part.width, unit)} wide" if part.width else "")
    size = length(part.chamfer_size, unit)
    if abs(part.angle - math.pi / 4) < AT_45_DEGREES:
        return f"C{size}"
    return f"chamfer {size} x {degrees(part.angle)}"


def _fillet(part: Part, unit: LengthUnit, _known: Known) -> str:
    if not part.radius:
        return _noun(part)
    radius = f"R{length(part.radius, unit)}"
    return f"{_noun(part)} {radius}" if part.kind is PartKind.ARC else radius


def _opening(part: Part, unit: LengthUnit, _known: Known) -> str:
    """A slot, pocket, cutout, channel, step or notch: 'slot 12 x 40 THRU', width before length.

    The width of a dovetail or T slot is that of its mouth and that of its bottom: 'dovetail slot 18/27.2 x 115'.
    """
    if part.across_flats is not None and "rectangular" not in part.tags:
        size = f"{length(part.across_flats, unit)} across flats,"
    elif part.mouth_width and part.bottom_width and part.length and "through" not in part.tags:
        size = f"{length(part.mouth_width, unit)}/{length(part.bottom_width, unit)} x {length(part.length, unit)}"
    elif (sides := _sides(part)) is not None:
        size = sizes(sides, unit)
    elif part.diameter:
        size = f"Ø{length(part.diameter, unit)}"
    else:
        return _by_measures(part, unit, {})
    kind = "slot" if "obround" in part.tags else _noun(part)
    if "keyway" in part.tags:
        kind = "keyway"
    return _joined(kind, size, _reach(part, unit)).removesuffix(",")


def _bent(part: Part, unit: LengthUnit, known: Known) -> str:
    """A bent pipe, bar or bore: 'bent pipe Ø20/Ø16, length 300'."""
    if part.length is None or not part.radii:
        return _by_measures(part, unit, known)
    across = "/".join(f"Ø{length(2 * radius, unit)}" for radius in part.radii)
    return f"{_noun(part)} {across}, length {length(part.length, unit)}"


def _sides(part: Part) -> tuple[float, float] | None:
    """The shorter and the longer side of an outline, in the part's own frame where it has one."""
    first, second = part.local_size[:2] if part.local_size else (part.width, part.length)
    return (min(first, second), max(first, second)) if first and second else None


def _groove(part: Part, unit: LengthUnit, known: Known) -> str:
    if part.diameter is None or part.width is None:
        return _opening(part, unit, known)
    across = f"Ø{length(part.diameter, unit)}"
    if "ring" in part.tags and part.inner_diameter:
        across = f"Ø{length(part.inner_diameter, unit)}/Ø{length(part.diameter, unit)}"
    told = [across, f"{length(part.width, unit)} wide"]
    if part.depth:
        told.append(f"depth {length(part.depth, unit)}")
    return _joined(_noun(part), ", ".join(told))


def _round_piece(part: Part, unit: LengthUnit, known: Known) -> str:
    """A boss, shaft, ring or cone: 'ring Ø52/Ø30, height 8'."""
    if part.diameter is None:
        return _by_measures(part, unit, known)
    thread = thread_name(part)
    across = thread or f"Ø{length(part.diameter, unit)}"
    if thread is None and part.inner_diameter and part.outer_diameter:
        across = f"Ø{length(part.outer_diameter, unit)}/Ø{length(part.inner_diameter, unit)}"
    high = f", height {length(part.height, unit)}" if part.height else ""
    return f"{_noun(part)} {across}{high}"


def _bend(part: Part, unit: LengthUnit, known: Known) -> str:
    if part.bend_radius is None:
        return _by_measures(part, unit, known)
    turn = f", {degrees(part.bend_angle)}" if part.bend_angle else ""
    return f"bend R{length(part.bend_radius, unit)}{turn}"


def _gear(part: Part, unit: LengthUnit, _known: Known) -> str:
    told = (
        f"{part.count} teeth" if part.count else "",
        f"tip Ø{length(part.diameter, unit)}" if part.diameter else "",
        f"width {length(part.width, unit)}" if part.width else "",
    )
    return _joined("gear", ", ".join(each for each in told if each))


def _pattern(part: Part, unit: LengthUnit, known: Known) -> str:
    name, _, rest = part.label.partition(" of ")
    members = [known[child] for child in part.children if child in known]
    told = callouts(members, unit, known)
    what = told[0].text if len(told) == 1 else rest.partition(",")[0] or f"{part.count or 'several'} parts"
    size = ""
    if part.diameter:
        size = f"Ø{length(part.diameter, unit)}"
    elif part.length and part.width:
        size = sizes((min(part.width, part.length), max(part.width, part.length)), unit)
    elif part.pitch:
        size = f"pitch {length(part.pitch, unit)}"
    return f"{_joined(name, size)}: {what}"


def _body(part: Part, unit: LengthUnit, _known: Known) -> str:
    told = [sizes(part.extents, unit)]
    if (long := part.nominal_length) and part.length and long < part.length - SAME:
        told = [f"length {length(long, unit)}", f"overall {length(part.length, unit)}"]
    return f"{part.name or part.label} ({', '.join(told)})"


def _face(part: Part, unit: LengthUnit, _known: Known) -> str:
    outline = part.label.split(",")[1].removesuffix(" outline").strip() if part.label.count(",") > 1 else ""
    sides = _sides(part)
    return _joined(outline, "plane", sizes(sides, unit) if sides else "")


def _plate(part: Part, unit: LengthUnit, known: Known) -> str:
    """A plate, wall or floor: 'floor 12 thick, 72 x 120'."""
    sides = _sides(part)
    if not part.thickness or sides is None:
        return _rib(part, unit, known)
    return f"{_noun(part)} {length(part.thickness, unit)} thick, {sizes(sides, unit)}"


def _rib(part: Part, unit: LengthUnit, _known: Known) -> str:
    """A rib, pad or tooth: 'fin 4 thick, length 176, height 12'."""
    told = []
    if part.thickness and part.kind is PartKind.RIB:
        told.append(f"{length(part.thickness, unit)} thick")
        told += [f"length {length(part.length, unit)}"] if part.length else []
    elif (sides := _sides(part)) is not None:
        told.append(sizes(sides, unit))
    told += [f"height {length(part.height, unit)}"] if part.height else []
    return _joined(_noun(part), ", ".join(told))


def _by_measures(part: Part, unit: LengthUnit, _known: Known) -> str:
    """Any other part: what it is, and the measures of its own that tell its size."""
    told = []
    across = part.diameter or (2 * part.radius if part.radius else None)
    if across:
        told.append(f"Ø{length(across, unit)}")
        along = part.depth if part.kind.cuts_in else part.height or part.length
        name = "depth" if part.kind.cuts_in else "length" if part.kind is PartKind.CYLINDER else "height"
        told += [f"{name} {length(along, unit)}"] if along else []
    elif (sides := _sides(part)) is not None:
        told.append(sizes(sides, unit))
        told += [f"depth {length(part.depth, unit)}"] if part.depth and part.kind.cuts_in else []
    return _joined(_noun(part), ", ".join(told))


def _noun(part: Part) -> str:
    """What recognition calls it: 'standoff', 'rectangular pocket', 'fin'; 'cross hole' has its number in no name."""
    said = part.label.partition(",")[0].partition(" of ")[0]
    return part.kind.value.replace("_", " ") if not said or any(map(str.isdigit, said)) else said


def _joined(*words: str) -> str:
    return " ".join(word for word in words if word)


def _counted(texts: Iterable[str]) -> list[str]:
    return [text if count == 1 else f"{count}x {text}" for text, count in Counter(texts).items()]


_WRITERS: dict[PartKind, Callable[[Part, LengthUnit, Known], str]] = {
    PartKind.HOLE: _hole,
    PartKind.COUNTERBORE: lambda part, unit, _known: _section(part, unit),
    PartKind.COUNTERSINK: lambda part, unit, _known: _section(part, unit),
    PartKind.SPOTFACE: lambda part, unit, _known: _section(part, unit),
    PartKind.CHAMFER: _chamfer,
    PartKind.FILLET: _fillet,
    PartKind.ROUND: _fillet,
    PartKind.ARC: _fillet,
    PartKind.SLOT: _opening,
    PartKind.POCKET: _opening,
    PartKind.CUTOUT: _opening,
    PartKind.CHANNEL: _opening,
    PartKind.STEP: _opening,
    PartKind.NOTCH: _opening,
    PartKind.GROOVE: _groove,
    PartKind.BOSS: _round_piece,
    PartKind.PRISM: lambda part, unit, known: (_plate if "plate" in part.tags else _rib)(part, unit, known),
    PartKind.PROTRUSION: _rib,
    PartKind.RIB: _rib,
    PartKind.TOOTH: _rib,
    PartKind.WALL: _plate,
    PartKind.FLOOR: _plate,
    PartKind.BEND: _bend,
    PartKind.PIPE: _bent,
    PartKind.GEAR: _gear,
    PartKind.PATTERN: _pattern,
    PartKind.BODY: _body,
    PartKind.MODEL: _body,
    PartKind.FACE: _face,
}


def told_parts(told: Sequence[Part], parts: Sequence[Part], unit: LengthUnit) -> str:
    """What a drawing would say of some of all parts, like ones together; lengths are in `unit`."""
    found = callouts(told, unit, {part.id: part for part in parts})
    return "; ".join(f"{one.text} ({ids_text(one.ids)})" for one in found) + f", in {unit_name(unit)}"
