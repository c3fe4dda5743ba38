"""What a measure means of a part of a kind, as an expression of the guest API. docs/measures.md tells it in words."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Literal

from querycad_contracts import AnswerType, Measure, Part, Side

Grade = Literal["own", "derived", "foreign", "missing"]
"""Is a measure the part's own, derived from its own, one that nobody would ask of it, or not there?"""

ROUND = frozenset([
    "hole", "boss", "cylinder", "cone", "sphere", "pipe", "ring", "torus", "counterbore", "countersink", "spotface",
    "gear", "groove", "dimple", "bearing", "screw", "arc", "pattern", "ring_sector", "crossbar",
])  # fmt: skip
STANDING = frozenset(
    ("boss", "crossbar", "cylinder", "cone", "elevation", "pipe", "protrusion", "prism", "rib", "screw", "tooth")
)
CUT = frozenset([
    "hole", "pocket", "slot", "cutout", "channel", "groove", "notch", "step", "counterbore", "countersink",
    "spotface", "depression", "dimple", "cavity",
])  # fmt: skip
FLAT = 0.5
"""What is lower than this share of its diameter is a disc, a flange or a plate, as in docs/measures.md."""
WHOLE = frozenset(("model", "body"))
BLENDS = frozenset(("fillet", "round", "chamfer", "bend"))

_BOX = "({0}.extents[0] * {0}.extents[1] * {0}.extents[2])"
_OF_WHOLE = {
    Measure.FILL: f"100 * {{0}}.volume / {_BOX}",
    Measure.REMOVED: f"{_BOX} - {{0}}.volume",
    Measure.STANDING_AREA: 'sum(f.area for f in faces(facing="bottom") if f.center[2] - {0}.min_corner[2] < 5e-05)',
    Measure.LONG_AXIS: '"xyz"[list({0}.extents).index(max({0}.extents))]',
}
"""Measures that only the whole model has."""
_ENDS = {
    Measure.TOP_END: Side.TOP, Measure.BOTTOM_END: Side.BOTTOM, Measure.LEFT_END: Side.LEFT,
    Measure.RIGHT_END: Side.RIGHT, Measure.FRONT_END: Side.FRONT, Measure.BACK_END: Side.BACK,
}  # fmt: skip
_TYPES = {
    Measure.SIZE: AnswerType.SIZE, Measure.HALF_SIZE: AnswerType.SIZE, Measure.VOLUME: AnswerType.VOLUME,
    Measure.REMOVED: AnswerType.VOLUME, Measure.FILL: AnswerType.NUMBER, Measure.LONG_AXIS: AnswerType.TEXT,
    Measure.MASS: AnswerType.NUMBER, Measure.COUNT: AnswerType.COUNT,
    Measure.FACE_COUNT: AnswerType.COUNT, Measure.EDGE_COUNT: AnswerType.COUNT, Measure.SIDES: AnswerType.TEXTS,
    Measure.MIRROR_PLANES: AnswerType.DIRECTIONS, Measure.INERTIA: AnswerType.NUMBERS,
    **dict.fromkeys((Measure.ANGLE, Measure.DRAFT, Measure.INCLINATION), AnswerType.ANGLE),
    **dict.fromkeys((Measure.AREA, Measure.OPENING_AREA, Measure.STANDING_AREA), AnswerType.AREA),
    **dict.fromkeys((Measure.POSITION, Measure.CENTER_OF_MASS, Measure.OPENING, Measure.TIP, *_ENDS), AnswerType.POINT),
    **dict.fromkeys((Measure.AXIS, Measure.NORMAL, Measure.DIRECTION, Measure.APPROACH), AnswerType.DIRECTION),
    **dict.fromkeys((Measure.NAME, Measure.KIND, Measure.COLOR, Measure.BOTTOM), AnswerType.TEXT),
}  # fmt: skip
"""Of what is no single length."""
_MANY = {
    AnswerType.SIZE: AnswerType.SIZES, AnswerType.AREA: AnswerType.AREAS, AnswerType.VOLUME: AnswerType.VOLUMES,
    AnswerType.POINT: AnswerType.POINTS, AnswerType.DIRECTION: AnswerType.DIRECTIONS, AnswerType.TEXT: AnswerType.TEXTS,
    AnswerType.LENGTH: AnswerType.LENGTHS, AnswerType.ANGLE: AnswerType.ANGLES, AnswerType.COUNT: AnswerType.NUMBERS,
    AnswerType.NUMBER: AnswerType.NUMBERS,
}  # fmt: skip


def answer_type(measure: Measure, several: bool = False) -> AnswerType:
    """Which type have values of a measure?"""
    kind = _TYPES.get(measure, AnswerType.LENGTH)
    return of_several(kind) if several else kind


def of_several(kind: AnswerType) -> AnswerType:
    """Which type has a list of such values?"""
    return _MANY.get(kind, kind)


def is_length(measure: Measure) -> bool:
    """Is it a single length?"""
    return measure not in _TYPES


def options(measure: Measure, part: Part, overall: bool = False) -> list[tuple[str, Grade]]:
    """The expressions, '{0}' for the part, that a measure can mean of a part like this one, the usual one first.

    `overall`: of a screw the length with its head, which is none of its standard.
    """
    if measure is Measure.LENGTH and part.nominal_length is not None and not overall:
        return [("{0}.nominal_length", "own"), ("{0}.length", "derived")]
    found = [(expression, grade) for expression, grade in _options(measure, part) if _has(part, expression)]
    unique: list[tuple[str, Grade]] = []
    for expression, grade in found:
        if all(expression != known for known, _ in unique):
            unique.append((expression, grade))
    return unique[:4] or [("{0}." + measure.value, "missing")]


def _options(measure: Measure, part: Part) -> Sequence[tuple[str, Grade]]:  # noqa: C901, PLR0911, PLR0912, PLR0915 - a case each
    kind = part.kind
    round_part = kind in ROUND or part.diameter is not None
    stepped = len(part.radii) > 1
    match measure:
        case Measure.RADIUS:
            if kind in ("bend", "pipe"):
                return [
                    ("{0}.bend_radius", "own"),
                    ("{0}.inner_diameter / 2", "derived"),
                    ("{0}.outer_diameter / 2", "derived"),
                    ("{0}.radius", "own"),
                ]
            return (
                [("{0}.radius", "own"), ("max({0}.radii)", "derived")]
                if stepped
                else [("{0}.radius", "own"), ("{0}.width / 2", "foreign")]
            )
        case Measure.DIAMETER:
            if kind == "torus":
                return [("{0}.outer_diameter", "own"), ("{0}.tube_diameter", "derived"), ("{0}.diameter", "own")]
            base: list[tuple[str, Grade]] = [("{0}.diameter", "own"), ("{0}.outer_diameter", "own")]
            if stepped:
                base += [("2 * max({0}.radii)", "derived"), ("2 * min({0}.radii)", "derived")]
            return [*base, *_round_extent(part), ("{0}.width", "foreign")]
        case Measure.INNER_RADIUS | Measure.INNER_DIAMETER:
            scale = "" if measure is Measure.INNER_RADIUS else "2 * "
            own: Grade = "own" if stepped or kind in CUT else "foreign"
            half = " / 2" if measure is Measure.INNER_RADIUS else ""
            return [
                (f"{{0}}.inner_diameter{half}", "own"),
                (f"{scale}min({{0}}.radii)", own),
                (f"{scale}{{0}}.radius", own),
            ]
        case Measure.OUTER_RADIUS | Measure.OUTER_DIAMETER:
            scale = "" if measure is Measure.OUTER_RADIUS else "2 * "
            half = " / 2" if measure is Measure.OUTER_RADIUS else ""
            outside: list[tuple[str, Grade]] = [(expression + half, grade) for expression, grade in _round_extent(part)]
            widest: list[tuple[str, Grade]] = [(f"{scale}max({{0}}.radii)", "own")] if part.radii else []
            return [(f"{{0}}.outer_diameter{half}", "own"), *widest, (f"{scale}{{0}}.radius", "own"), *outside]
        case Measure.CIRCUMFERENCE:
            return [("3.141592653589793 * {0}.diameter", "derived")]
        case Measure.DEPTH:
            if kind in WHOLE:
                return [("{0}.extents[1]", "own")]
            return [
                ("{0}.depth", "own" if kind in CUT or "hollow" in part.tags else "foreign"),
                ("{0}.height", "derived"),
                ("{0}.extents[1]", "foreign"),
            ]
        case Measure.HEIGHT:
            if kind in WHOLE:
                return [("{0}.extents[2]", "own"), ("{0}.height", "own"), ("max({0}.extents)", "derived")]
            if kind in CUT and kind != "hole":  # of a window in a wall how far it reaches upwards
                return [("{0}.extents[2]", "own"), ("{0}.depth", "derived"), ("{0}.length", "derived")]
            return [
                ("{0}.height", "own" if kind in STANDING else "derived"),
                ("{0}.depth", "derived"),
                ("{0}.extents[2]", "derived"),
            ]
        case Measure.WIDTH:
            if kind in WHOLE:
                return [
                    ("{0}.extents[0]", "own"),
                    *((expression, "derived") for expression, _ in _axial(part)),  # of a roller
                    ("sorted({0}.extents)[1]", "derived"),
                    ("{0}.extents[1]", "derived"),
                ]
            if kind == "hole" and part.radii:
                return [("2 * max({0}.radii)", "own")]
            if kind == "chamfer":
                return _chamfer()
            local = part.local_size is not None and part.width != min(part.local_size[:2])
            own_frame: list[tuple[str, Grade]] = [("min({0}.local_size[:2])", "derived")] if local else []
            return [
                ("{0}.width", "own"),
                *own_frame,
                ("{0}.diameter", "derived"),
                ("{0}.height", "derived"),
                ("{0}.extents[0]", "foreign"),
            ]
        case Measure.LENGTH:
            if kind in WHOLE:
                return [
                    ("max({0}.extents)", "own"),
                    *_axial(part),
                    ("{0}.length", "own"),
                    ("{0}.extents[0]", "derived"),
                ]
            if kind in ("hole", "counterbore", "spotface"):
                return [("{0}.depth", "own"), ("{0}.length", "own")]
            if round_part and kind in STANDING:
                return [("{0}.height", "own"), ("{0}.length", "own")]
            return (
                [("{0}.length", "own"), ("{0}.height", "derived"), ("max({0}.extents)", "derived")]
                if kind != "chamfer"
                else _chamfer()
            )
        case Measure.THICKNESS:
            return _thickness(part, stepped)
        case Measure.WALL_THICKNESS if kind in CUT:  # what is left around it
            return [("{0}.wall_distance", "own"), ("{0}.edge_distance()", "derived"), ("{0}.thickness", "foreign")]
        case Measure.WALL_THICKNESS:
            if stepped and not (kind in WHOLE and not _is_plain_tube(part)):
                return [("max({0}.radii) - min({0}.radii)", "own"), ("{0}.thickness", "own")]
            return [("{0}.thickness", "own")]
        case Measure.MAGNITUDE:
            return _magnitude(part, round_part)
        case Measure.SIZE:
            if kind == "hole":
                return [("{0}.diameter", "own"), ("{0}.extents", "derived"), ("[*{0}.local_size[:2]]", "derived")]
            return _magnitude(part, round_part) if kind in BLENDS | CUT else [("{0}.extents", "own")]
        case Measure.SHORT_SIDE:
            return [
                ("min({0}.local_size[:2])", "own"),
                ("min({0}.length, {0}.width)", "own"),
                ("min({0}.extents)", "derived"),
            ]
        case Measure.LONG_SIDE:
            return [
                ("max({0}.local_size[:2])", "own"),
                ("max({0}.length, {0}.width)", "own"),
                ("max({0}.extents)", "derived"),
            ]
        case Measure.ACROSS_FLATS:
            return [("{0}.across_flats", "own"), ("{0}.width", "derived"), ("min({0}.extents)", "foreign")]
        case Measure.ACROSS_CORNERS:
            return [("{0}.across_corners", "own"), ("{0}.diameter", "derived"), ("max({0}.extents)", "foreign")]
        case Measure.CENTRE_LENGTH:
            return [("{0}.center_length", "own"), ("{0}.length - {0}.width", "derived")]
        case Measure.DIAGONAL:
            return [("distance((0.0, 0.0, 0.0), {0}.extents)", "derived")]
        case Measure.HALF_SIZE:
            return [("{0}.half_extents", "own")]
        case Measure.X_EXTENT | Measure.Y_EXTENT | Measure.Z_EXTENT:
            return [(f"{{0}}.extents[{'xyz'.index(measure.value[0])}]", "own")]
        case Measure.X | Measure.Y | Measure.Z:
            return [(f"{{0}}.center[{'xyz'.index(measure.value)}]", "own")]
        case Measure.POSITION:
            return [("{0}.center", "own")]
        case Measure.OPENING:
            return [("{0}.opening", "own"), ("{0}.center", "derived")]
        case Measure.TIP:
            return [("{0}.tip", "own"), ("{0}.center", "foreign")]
        case Measure.DIRECTION:
            return (
                [("{0}.normal", "own"), ("{0}.axis", "own")]
                if kind in CUT
                else [("{0}.axis", "own"), ("{0}.normal", "own")]
            )
        case Measure.APPROACH:
            return [("{0}.approach[0]", "own")]
        case Measure.EDGE_DISTANCE:
            return [("{0}.edge_distance()", "own")]
        case Measure.KIND:
            return [("{0}.label", "own")]
        case Measure.NAME:
            return [("{0}.name", "own"), ("{0}.label", "foreign")]
        case Measure.COLOR:
            return [("{0}.color", "own")]
        case Measure.ANGLE:
            return [
                ("{0}.angle", "own"),
                ("{0}.bend_angle", "own"),
                ("{0}.draft", "derived"),
                ("2 * {0}.draft", "derived"),
                ("1.5707963267948966 - {0}.angle", "derived"),
                ("{0}.inclination", "derived"),
                ("1.5707963267948966 - {0}.inclination", "derived"),
            ]
        case Measure.DRAFT:
            return [
                ("{0}.draft", "own"),
                ("abs(1.5707963267948966 - {0}.inclination)", "derived"),
                ("{0}.inclination", "derived"),
            ]
        case Measure.MASS:
            return [("{0}.volume", "own")]
        case Measure.AREA:  # of a window the opening may be meant, of a hole its wall
            return [("{0}.area", "own"), ("{0}.opening_area", "derived")]
        case Measure.INERTIA:
            return [("[{0}.inertia[i][i] for i in range(3)]", "own")]
        case _ if measure in _OF_WHOLE:
            return [(_OF_WHOLE[measure], "own")] if kind == "model" else []
        case _ if measure in _ENDS:
            return [(_end(_ENDS[measure]), "own")]
        case _:
            return [("{0}." + measure.value, "own")]


def _is_plain_tube(part: Part) -> bool:
    """Is a body a tube and nothing else, by its volume? A flange with a hub is none."""
    axis = part.axis
    if axis is None or part.volume is None:
        return True
    along = max(range(3), key=lambda i: abs(axis[i]))
    tube = math.pi * (max(part.radii) ** 2 - min(part.radii) ** 2) * part.extents[along]
    return abs(part.volume - tube) <= 0.05 * tube


def _axial(part: Part) -> list[tuple[str, Grade]]:
    """The extent along the axis of what is round: a short gland is wider than it is long; a disc has no own length."""
    if part.axis is None:
        return []
    along = max(range(3), key=[abs(x) for x in part.axis].__getitem__)
    flat = part.extents[along] < FLAT * max(part.extents)
    return [(f"{{0}}.extents[{along}]", "derived" if flat else "own")]


def _chamfer() -> list[tuple[str, Grade]]:
    """A chamfer is as wide as what it takes off the edge (ISO 13715); across its face is another reading."""
    return [("{0}.chamfer_size", "own"), ("min({0}.extents)", "own"), ("{0}.width", "derived")]


def _round_extent(part: Part) -> list[tuple[str, Grade]]:
    """The diameter of what is round as a whole: the extent that two of its directions share."""
    if part.kind not in WHOLE:
        return []
    x, y, z = part.extents
    for i, j in ((0, 1), (0, 2), (1, 2)):
        if abs(part.extents[i] - part.extents[j]) < 1e-4 * max(x, y, z):
            return [(f"{{0}}.extents[{i}]", "derived")]
    return []


def _thickness(part: Part, stepped: bool) -> list[tuple[str, Grade]]:
    kind = part.kind
    if kind in WHOLE:
        return [("{0}.thickness", "own"), ("min({0}.extents)", "derived"), ("{0}.extents[2]", "foreign")]
    if kind in ("boss", "pipe") and stepped and "flat" not in part.tags:
        return [
            ("max({0}.radii) - min({0}.radii)", "own"),
            ("{0}.height", "derived"),
            ("2 * max({0}.radii)", "derived"),
        ]
    if kind == "boss":
        if "flat" in part.tags:
            return [("{0}.height", "own"), ("{0}.thickness", "own"), ("{0}.diameter", "foreign")]
        return [("{0}.diameter", "own"), ("{0}.thickness", "own"), ("{0}.height", "derived")]
    return [
        ("{0}.thickness", "own"),
        ("{0}.width", "derived"),
        ("min({0}.extents)", "derived"),
        ("{0}.height", "derived"),
    ]


def _magnitude(part: Part, round_part: bool) -> list[tuple[str, Grade]]:
    if part.kind in WHOLE:
        return [("{0}.extents", "own"), ("max({0}.extents)", "derived")]
    if part.kind in ("fillet", "round", "bend"):
        return [("{0}.radius", "own")]
    if part.kind == "chamfer":
        return _chamfer()
    if part.diameter is not None and (round_part or part.kind in CUT or part.kind == "pattern"):
        return [("{0}.diameter", "own"), ("{0}.extents", "derived")]
    flat: list[tuple[str, Grade]] = [("[*{0}.local_size[:2]]", "own")] if part.kind in CUT else []  # of a window
    return [("{0}.extents", "own"), *flat, ("max({0}.extents)", "derived")]


def _end(side: Side) -> str:
    axes = [
        f"{{0}}.center[{i}]" + (f" {'+' if o > 0 else '-'} {{0}}.half_extents[{i}]" if o else "")
        for i, o in enumerate(side.outward)
    ]
    return f"({', '.join(axes)})"


_ALWAYS = ("min_corner", "center", "extents", "half_extents", "label", "kind", "tags", "sides", "id", "edge_distance")


def _has(part: Part, expression: str) -> bool:
    """Does the part have everything that the expression reads?"""
    pieces = expression.split("{0}.")[1:]
    for piece in pieces:
        name = piece
        for stop in "[]()+-*/ ,:":
            name = name.split(stop)[0]
        if name in _ALWAYS:
            continue
        if getattr(part, name, None) in (None, (), ""):
            return False
    return True
