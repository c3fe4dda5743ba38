"""What a measure means of a part of a kind, as an expression of the guest API. docs/measures.md tells it in words."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from functools import cache
from typing import Literal

from querycad_contracts import DRAWING_M, Measure, Part, PartKind, Side
from querycad_language.measures import ENDS, EXTENTS, WHOLE

Grade = Literal["own", "derived", "foreign", "missing"]
"""Is a measure the part's own, derived from its own, one that nobody would ask of it, or not there?"""

STANDING = frozenset(kind for kind in PartKind if kind.stands_out) | {
    PartKind.CROSSBAR, PartKind.CYLINDER, PartKind.CONE, PartKind.PIPE, PartKind.TOOTH, PartKind.WALL,
}  # fmt: skip
CUT = frozenset(kind for kind in PartKind if kind.cuts_in) | {PartKind.SPOTFACE, PartKind.CAVITY}
FLAT = 0.5
"""What is lower than this share of its diameter is a disc, a flange or a plate, as in docs/measures.md."""
COORDINATES = (Measure.X, Measure.Y, Measure.Z)


def _end(side: Side) -> str:
    """The middle of a part's box on a side."""
    to_side = {1.0: " + {0}.half_extents", -1.0: " - {0}.half_extents"}
    axes = [f"{{0}}.center[{i}]" + (f"{to_side[o]}[{i}]" if o else "") for i, o in enumerate(side.outward)]
    return f"({', '.join(axes)})"


_CHAMFER = "chamfer_size; min(extents); ~width"
"""A chamfer is as wide as what it takes off the edge (ISO 13715); across its face is another reading."""
_FLOOR = f"({', '.join(f'{{0}}.opening[{i}] - {{0}}.depth * {{0}}.normal[{i}]' for i in range(3))})"
_WINDOW = "extents; [*local_size[:2]]; ~max(extents)"
_ALONG = '"xyz"[max(range(3), key=lambda i: abs({0}.axis[i]))]'
_LEAN, _RISE = "math.acos(min(1.0, abs({0}.axis[2])))", "math.asin(min(1.0, abs({0}.axis[2])))"
"""Of an axis: to the z axis, and to the horizontal plane."""
_LEVEL = 'find_parts("hole") if abs(p.axis[2]) < 0.5'
"""Holes within 60 degrees of level."""
_SHOULDER = "min({0}.radius - q.radius for q in find_parts('section') if {0}.radius - q.radius > 1e-06)"
"""By how much is a step wider than the next narrower one?"""
_BOX = "({0}.extents[0] * {0}.extents[1] * {0}.extents[2])"

_MEANINGS: Mapping[Measure, str | Mapping[str, str]] = {
    Measure.RADIUS: {
        "bend+STEPPED": "radius; ~max(radii)",  # of sheet: inside and outside
        "bend pipe": "bend_radius; ~inner_diameter / 2; ~outer_diameter / 2; radius",
        "STEPPED": "radius; ~max(radii)",
        "pattern": "radius",
        "": "radius; ?width / 2",
    },
    Measure.DIAMETER: {
        "torus": "outer_diameter; ~tube_diameter; diameter",
        "pattern": "diameter",
        "STEPPED": "diameter; outer_diameter; ~2 * max(radii); ~2 * min(radii); ~extents[across]; ?width",
        "": "diameter; outer_diameter; ~extents[across]; ?width",
    },
    Measure.INNER_RADIUS: {
        "STEPPED CUT bend": "inner_diameter / 2; min(radii); radius",
        "": "inner_diameter / 2; ?min(radii); ?radius",
    },
    Measure.INNER_DIAMETER: {
        "STEPPED CUT": "inner_diameter; 2 * min(radii); 2 * radius",
        "": "inner_diameter; ?2 * min(radii); ?2 * radius",
    },
    Measure.OUTER_RADIUS: "outer_diameter / 2; max(radii); radius; ~extents[across] / 2",
    Measure.OUTER_DIAMETER: "outer_diameter; 2 * max(radii); 2 * radius; ~extents[across]",
    Measure.PITCH_DIAMETER: {"gear": "count * (max(radii) - min(radii)) / 2.25", "pattern": "diameter"},
    Measure.MODULE: "(max(radii) - min(radii)) / 2.25",
    Measure.ROOT_DIAMETER: {"gear groove": "2 * min(radii)", "": "inner_diameter; ?2 * min(radii); ?2 * radius"},
    Measure.CENTRELINE_RADIUS: "bend_radius; ~center_length / angle; ~(min(radii) + max(radii)) / 2",
    Measure.CIRCUMFERENCE: "~3.141592653589793 * diameter",
    Measure.DEPTH: {
        "WHOLE": "extents[1]",
        "CUT HOLLOW": "depth; ~height; ?extents[1]",
        "": "?depth; ~height; ?extents[1]",
    },
    Measure.HEIGHT: {
        "WHOLE": "extents[2]; height; ~max(extents)",
        "STANDING": "height; ~depth; ~extents[2]",
        "hole": "~height; ~depth; ~extents[2]",
        "cutout+LYING": "extents[1]; extents[2]; ~length",  # of a window in a plate that lies
        "CUT": "extents[2]; ~depth; ~length",  # of a window in a wall how far it reaches upwards
        "": "~height; ~depth; ~extents[2]",
    },
    Measure.WIDTH: {
        "WHOLE": "extents[0]; ~extents[along]; ~min(extents[:2]); ~extents[1]",  # along the axis: of a roller
        "BORE": "2 * max(radii)",
        "chamfer": _CHAMFER,
        "pocket+ASKEW+SLIM cutout+ASKEW+SLIM": "min(local_size[:2]); ~width",
        "ASKEW": "width; ~min(local_size[:2]); ~diameter; ~height; ?extents[0]",
        "": "width; ~diameter; ~height; ?extents[0]",
    },
    Measure.LENGTH: {
        "TILTED": "length; ~max(extents)",
        "DISC": "max(extents); ~extents[along]; length; ~extents[0]",
        "WHOLE": "max(extents); extents[along]; length; ~extents[0]",  # a short gland is wider than it is long
        "hole counterbore spotface": "depth; length",
        "ROUND+STANDING": "height; length",
        "chamfer": _CHAMFER,
        "ARM": "length",
        "": "length; ~height; ~max(extents)",
    },
    Measure.THICKNESS: {
        "WHOLE+OVERALL": "extents[along]; min(extents)",  # with what stands on it
        "WHOLE": "thickness; ~min(extents); ?extents[2]",
        "torus": "tube_diameter",
        "boss+FLAT": "height; thickness; ?diameter",
        "boss+STEPPED pipe+STEPPED": "max(radii) - min(radii); height; ~2 * max(radii)",  # of an eye its height
        "boss": "diameter; thickness; ~height",
        "": "thickness; ~width; ~min(extents); ~height",
    },
    Measure.WALL_THICKNESS: {
        "CUT": "wall_distance; ~edge_distance(); ?thickness",  # what is left around it
        "TUBE": "max(radii) - min(radii); thickness",
        "": "thickness",
    },
    Measure.RADIAL_WIDTH: {
        "STEPPED TUBE": f"max(radii) - min(radii); ~{_SHOULDER}; ~wall_distance",
        "ROUND+STANDING": f"{_SHOULDER}; ~thickness",
        "CUT": "wall_distance; ~width",
        "face": "(outer_diameter - inner_diameter) / 2; ~width",
        "tooth groove": "depth; height",
        "": "thickness; ~width",
    },
    Measure.MINIMUM_THICKNESS: "minimum_thickness; ~thickness",
    Measure.MAGNITUDE: {
        "WHOLE": "extents; ~max(extents)",
        "fillet round bend": "radius",
        "chamfer": _CHAMFER,
        "ROUND": "diameter; ~extents",
        "CUT": _WINDOW,
        "": "extents; ~max(extents)",
    },
    Measure.SIZE: {
        "hole": "diameter; ~extents; ~[*local_size[:2]]",
        "fillet round bend": "radius",
        "chamfer": _CHAMFER,
        "ROUND+CUT": "diameter; ~extents",
        "CUT": _WINDOW,
        "": "extents",
    },
    Measure.SHORT_SIDE: "min(local_size[:2]); min(length, width); ~min(extents)",
    Measure.LONG_SIDE: "max(local_size[:2]); max(length, width); ~max(extents)",
    Measure.ACROSS_FLATS: "across_flats; ~width; ?min(extents)",
    Measure.ACROSS_CORNERS: "across_corners; ~diameter; ?max(extents)",
    Measure.CENTRE_LENGTH: "center_length; ~length - width",
    Measure.DIAGONAL: "distance((0.0, 0.0, 0.0), extents)",
    Measure.HALF_SIZE: "half_extents",
    Measure.AXIAL_EXTENT: {
        "WHOLE": "extents[along]; height",
        "hole counterbore spotface": "depth",
        "groove tooth gear": "width",
        "": "height; ~extents[along]; ~length",
    },
    **{measure: f"extents[{i}]" for i, measure in enumerate(EXTENTS)},
    **{measure: f"center[{i}]" for i, measure in enumerate(COORDINATES)},
    Measure.POSITION: "center",
    Measure.OPENING: "opening; ~center",
    Measure.FLOOR_CENTER: {"CUT": f"{_FLOOR}; ~center", "": _end(Side.BOTTOM)},
    Measure.TIP: "tip",
    Measure.DIRECTION: {"CUT": "normal; axis", "": "axis; normal"},
    Measure.APPROACH: "approach[0]",
    Measure.EDGE_DISTANCE: "edge_distance()",
    Measure.CENTER_HEIGHT: {  # of the whole that of its largest level bore
        "WHOLE": f"~max((p.diameter, p.center[2]) for p in {_LEVEL})[1] - {{0}}.min_corner[2]",
        "": "{0}.center[2] - shape.min_corner[2]",
    },
    Measure.KIND: "label",
    Measure.NAME: "name; ?label",
    Measure.ANGLE: (
        "angle; bend_angle; ~draft; ~2 * draft; ~1.5707963267948966 - angle; ~inclination; "
        f"~1.5707963267948966 - inclination; ?{_LEAN}; ?{_RISE}"
    ),
    Measure.ANGULAR_PITCH: {"gear": "6.283185307179586 / count"},
    Measure.INCLUDED_ANGLE: "angle; ~2 * draft; bend_angle",
    Measure.DRAFT: f"draft; ~abs(1.5707963267948966 - inclination); ~{_LEAN}; ~inclination",
    Measure.INCLINATION: f"inclination; ~{_RISE}",
    Measure.MASS: "volume",
    Measure.AREA: "area; ~opening_area",  # of a window the opening may be meant, of a hole its wall
    Measure.CROSS_SECTION_AREA: {
        "hole": "math.pi * {0}.radius**2; ~opening_area",
        "CUT": "opening_area",
        "": "{0}.volume / max({0}.extents); ~{0}.area",
    },
    Measure.INERTIA: "[{0}.inertia[i][i] for i in range(3)]",
    Measure.FILL: {"model": f"100 * {{0}}.volume / {_BOX}"},
    Measure.LONG_AXIS: {
        "model": '"xyz"[list({0}.extents).index(max({0}.extents))]',
        "ROUND hole boss": _ALONG,
        "": f'"xyz"[list({{0}}.extents).index(max({{0}}.extents))]; ~{_ALONG}',
    },
    Measure.REMOVED: {"model": f"{_BOX} - {{0}}.volume"},
    Measure.STANDING_AREA: {
        "model": 'sum(f.area for f in faces(facing="bottom") if f.center[2] - {0}.min_corner[2] < 5e-05)',
        "": "area",
    },
    **{measure: _end(side) for measure, side in ENDS.items()},
}
"""The expressions of each measure, the usual one first; '~' is before what is derived, '?' before what is foreign.

Where they differ by the part, the first line holds that names its kind or a group of `_groups`; 'a+b' is both. What is
in no line has the attribute of the measure's own name.
"""


def options(measure: Measure, part: Part, overall: bool = False, slim: bool = False) -> list[tuple[str, Grade]]:
    """The expressions, '{0}' for the part, that a measure can mean of a part like this one, the usual one first.

    `overall`: of a screw the length with its head, which is none of its standard; of a flange with its raised face.
    `slim`: it is called by what is narrower than long, as a long pocket is a slot.
    """
    if measure is Measure.LENGTH and part.nominal_length is not None and not overall:
        return [("{0}.nominal_length", "own"), ("{0}.length", "derived")]
    groups = frozenset((*_groups(part), *["OVERALL"] * overall, *["SLIM"] * slim))
    lines = (meanings for needed, meanings in _lines(measure) if any(map(groups.issuperset, needed)))
    found: dict[str, Grade] = {}
    for expression, grade in next(lines, ()):
        for index, axis in (("[along]", along_axis(part)), ("[across]", _across(part))):
            if index in expression:
                expression = "" if axis is None else expression.replace(index, f"[{axis}]")
        if expression and _has(part, expression):
            found.setdefault(expression, grade)
    return list(found.items())[:4] or [("{0}." + measure.value, "missing")]


_ATTRIBUTE = re.compile(r"\b(?!(?:max|min|sorted|abs|distance|along|across)\b)[a-z]\w*")
_GRADES: Mapping[str, Grade] = {"~": "derived", "?": "foreign"}


@cache
def _lines(measure: Measure) -> list[tuple[list[set[str]], list[tuple[str, Grade]]]]:
    """The lines of the table for a measure: the groups that each is for, any of them, and its expressions."""
    lines = _MEANINGS.get(measure, measure.value)
    return [
        ([set(one.split("+")) for one in of.split()] or [set()], [_meaning(text) for text in meanings.split("; ")])
        for of, meanings in ({"": lines} if isinstance(lines, str) else lines).items()
    ]


def _meaning(text: str) -> tuple[str, Grade]:
    grade = _GRADES.get(text[0], "own")
    text = text.lstrip("~?")
    return text if "{0}" in text else _ATTRIBUTE.sub(r"{0}.\g<0>", text), grade


UPRIGHT = 0.9998
"""The cosine of a degree: an axis further from x, y and z is along none of them."""


def _groups(part: Part) -> Iterator[str]:
    """What the lines of the table may be for: the kind of the part, and in capitals what else tells parts apart."""
    yield part.kind
    stepped, whole, along = len(part.radii) > 1, part.kind in WHOLE, along_axis(part)
    local = part.local_size
    named = {
        "WHOLE": whole,
        "CUT": part.kind in CUT,
        "STANDING": part.kind in STANDING,
        "STEPPED": stepped,
        "ARM": "arm" in part.tags,
        "ROUND": part.diameter is not None,
        "HOLLOW": "hollow" in part.tags,
        "FLAT": "flat" in part.tags,
        "BORE": part.kind == "hole" and bool(part.radii),
        "TUBE": stepped and (not whole or _is_plain_tube(part)),
        "DISC": whole and along is not None and part.extents[along] < FLAT * max(part.extents),
        "TILTED": whole and along is not None and part.axis is not None and abs(part.axis[along]) < UPRIGHT,
        "LYING": {"through", "vertical"} <= set(part.tags),
        "ASKEW": local is not None and part.width != min(local[:2]),
    }
    yield from (name for name, holds in named.items() if holds)


def _is_plain_tube(part: Part) -> bool:
    """Is a body a tube and nothing else, by its volume? A flange with a hub is none."""
    along = along_axis(part)
    if along is None or part.volume is None:
        return True
    tube = math.pi * (max(part.radii) ** 2 - min(part.radii) ** 2) * part.extents[along]
    return abs(part.volume - tube) <= 0.05 * tube


def along_axis(part: Part) -> int | None:
    """Which of x, y, z is nearest to the axis of a part?"""
    return None if part.axis is None else max(range(3), key=[abs(x) for x in part.axis].__getitem__)


def level_width(part: Part) -> int | None:
    """Along x (0) or y (1): how wide is what stands upright, where its `width` is how high it is; else none."""
    facing = part.normal or part.axis
    through = None if facing is None else max(range(3), key=[abs(x) for x in facing].__getitem__)
    if through in (None, 2) or part.width is None or abs(part.width - part.extents[2]) > DRAWING_M:
        return None
    return 1 - through


def _across(part: Part) -> int | None:
    """Along which of x, y, z is what is round as a whole as wide as along another one?"""
    if part.kind not in WHOLE or not (part.axis or part.rotation_axes):
        return None
    alike = 1e-4 * max(part.extents)
    return next((i for i, j in ((0, 1), (0, 2), (1, 2)) if abs(part.extents[i] - part.extents[j]) < alike), None)


_ALWAYS = ("min_corner", "max_corner", "half_extents", "edge_distance", "sides")
"""What the guest API gives of every part."""


def _has(part: Part, expression: str) -> bool:
    """Does the part have everything that the expression reads?"""
    names = re.findall(r"\{0\}\.(\w+)", expression)
    return all(name in _ALWAYS or getattr(part, name, None) not in (None, (), "") for name in names)
