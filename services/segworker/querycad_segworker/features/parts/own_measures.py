"""Measures that some families have beyond their size: across flats, centre to centre, draft, inner diameters."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence, Set
from itertools import combinations
from typing import Final

from querycad_contracts import Bottom, Part, PartKind, SurfaceKind, Vector
from querycad_segworker.features.shared.part_measures import faces_area, inclination
from querycad_segworker.features.shared.reach import edges_span, reach_along
from querycad_segworker.features.shared.regular import across_flats_and_corners, flats_on_round
from querycad_segworker.features.shared.tapers import draft_of, mouth_and_bottom
from querycad_segworker.topology import Brep, FaceRecord
from querycad_segworker.vectors import cross, dist, dot, line_key, parallel

Measured = dict[str, object]
"""Fields of `Part` -> values."""
WHOLE_TUBE = 0.75
"""A torus with more than this share of its surface is a ring or bent bar; less of it is a rounded edge."""
MOSTLY = 0.5
"""A body with more than this share of its surface in one ring is that ring, with what is joined to it; an opening with
more than this share of its surface in leaning walls narrows."""
LEANING = (SurfaceKind.CONE, SurfaceKind.FREEFORM)
"""Walls of what narrows without one draft: lofts, and square holes that get round."""
UNDERCUT = (math.sin(math.radians(10.0)), math.sin(math.radians(46.0)))
"""So far the flanks of a dovetail lean over the face it stands on: cutters have 45 to 60 degrees (DIN 1833)."""
ROUND_ENDS = frozenset(("obround", "curved"))
OPENINGS = frozenset((PartKind.POCKET, PartKind.CUTOUT))
MOUTHS = OPENINGS | {PartKind.HOLE}
SQUARE_RAD = 1e-3
"""Bends about directions that differ by less are about one."""
SAME = 0.01
"""Thicknesses that differ by less than this share are one sheet's."""


def with_own_measures(parts: Sequence[Part], brep: Brep) -> list[Part]:
    """The same parts, each with the measures that its family has beyond its size."""
    breaks = {face for part in parts if part.kind.breaks_edge for face in part.faces}
    tori = [part for part in parts if part.kind == "torus"]
    result = []
    for part in parts:
        measures: Measured = {}
        for measure in _OF_PART.get(part.kind, ()):
            measures |= measure(part)
        for look in _OF_FACES.get(part.kind, ()):
            measures |= look(part, brep)
        if part.kind == "torus":
            measures |= _torus(part, tori)
        elif part.kind in OPENINGS:
            measures |= _tapered(part, brep, breaks)
        part = part.model_copy(update=measures) if measures else part
        mouth = _mouth(part) if part.kind in MOUTHS else {}
        result.append(part.model_copy(update=mouth) if mouth else part)
    rings = [
        part for part in result if part.kind == "torus" and part.tube_diameter is not None and "outer" in part.tags
    ]
    wrenched = [p for p in result if p.across_flats and (p.kind.stands_out or "hexagonal" in p.tags)]
    bends = [part for part in result if part.kind == "bend" and part.thickness and part.axis]
    if not rings and not wrenched and not bends:
        return result
    return [
        _laid_flat(_of_wrenched(_of_ring(part, rings), wrenched), bends, brep) if part.kind.is_whole else part
        for part in result
    ]


def _of_wrenched(body: Part, wrenched: Sequence[Part]) -> Part:
    """The same body; one with a single hexagon, as a nut, or pair of flats or square, as a shaft, has its width.

    A hexagon outside comes before what else a spanner takes hold of, and that before a socket.
    """
    own = set(body.faces)
    inside = [part for part in wrenched if own.issuperset(part.faces)]
    hexagons = [part for part in inside if part.kind == "prism" and "hexagonal" in part.tags]
    flats = (
        [part for part in inside if part.kind.stands_out and part.kind != "protrusion"]
        if "circular" in body.tags
        else []
    )
    found = hexagons or flats or [part for part in inside if part.kind in OPENINGS]
    if len(found) != 1:
        return body
    return body.model_copy(update={"across_flats": found[0].across_flats, "across_corners": found[0].across_corners})


def _laid_flat(body: Part, bends: Sequence[Part], brep: Brep) -> Part:
    """The same body; of sheet that is bent about one direction, how long it is across its bends when laid flat.

    Along the middle of the material: its flat panels, each as far as it reaches, and the arcs of its bends. What a bend
    stretches beyond that (the k-factor of DIN 6935) is not known to a shape.
    """
    own = set(body.faces)
    inside = [bend for bend in bends if own.issuperset(bend.faces)]
    axis = inside[0].axis if inside else None
    if axis is None or any(one.axis is None or not parallel(one.axis, axis, SQUARE_RAD) for one in inside):
        return body
    thickness = inside[0].thickness or 0.0
    if any(abs((one.thickness or 0.0) - thickness) > SAME * thickness for one in inside):
        return body
    arcs = [(one.bend_angle or 0.0) * ((one.bend_radius or 0.0) + thickness / 2) for one in inside]
    reaches = [
        reach_along(brep, brep.edges_of(faces), cross(axis, normal)) for normal, faces in _panels(inside, axis, brep)
    ]
    flats = [reach[1] - reach[0] for reach in reaches if reach is not None]
    if not all(arcs) or len(flats) != len(inside) + 1:  # no strip whose panels follow one another
        return body
    return body.model_copy(update={"developed_length": sum(arcs) + sum(flats)})


def _panels(bends: Sequence[Part], axis: Vector, brep: Brep) -> list[tuple[Vector, list[int]]]:
    """The planes of one side of the sheet that run on into its bends, each by its normal and faces."""
    bent = {face for bend in bends for face in bend.faces}
    side = [bends[0].faces[0]]
    for face in side:
        near = {i for _, i in brep.neighbours(face)}
        planes = {i for i in near if brep.faces[i].kind is SurfaceKind.PLANE} if face in bent else set()
        along = {i for i in planes if abs(dot(brep.faces[i].axis, axis)) < SQUARE_RAD}
        side += sorted(((near & bent) | along) - {*side})
    found: dict[tuple[float, ...], tuple[Vector, list[int]]] = {}
    for record in (brep.faces[face] for face in side if face not in bent):
        key = (*(round(x, 6) for x in record.axis), round(dot(record.axis, record.origin), 8))
        found.setdefault(key, (record.axis, []))[1].append(record.id)
    return list(found.values())


def _mouth(part: Part) -> Measured:
    """Of a hole, round; of what has upright walls, its volume by its depth."""
    if part.kind == "hole":
        return {} if part.width is None else {"opening_area": math.pi * part.width**2 / 4}
    standing = part.draft is None and part.mouth_length is None and part.bottom in (Bottom.FLAT, Bottom.THROUGH)
    return {"opening_area": part.volume / part.depth} if standing and part.volume and part.depth else {}


def _inclined(part: Part) -> Measured:
    """Of a plane face, wall, floor or plate, to the horizontal plane."""
    if part.normal is None or (part.kind == "prism" and "plate" not in part.tags):
        return {}
    return {"inclination": inclination(part.normal)}


def _of_ring(body: Part, rings: Sequence[Part]) -> Part:
    """The same body; one whose surface mostly is one ring has that ring's diameters."""
    for ring in rings:
        mostly = ring.area is not None and body.area is not None and ring.area > MOSTLY * body.area
        if mostly and set(ring.faces) <= set(body.faces):
            names = ("outer_diameter", "inner_diameter", "tube_diameter")
            return body.model_copy(update={"tags": (*body.tags, "ring")} | {n: getattr(ring, n) for n in names})
    return body


def _regular(part: Part, brep: Brep) -> Measured:
    """Of prisms, hexagon sockets and other hollows of a regular outline."""
    if part.normal is None:
        return {}
    found = across_flats_and_corners(brep, part.faces, part.normal)
    return {} if found is None else {"across_flats": found[0], "across_corners": found[1]}


def _square_bar(part: Part, brep: Brep) -> Measured:
    """Of a block whose section across its length is square, not its outline."""
    if part.normal is None or "rectangular" not in part.tags or _regular(part, brep):
        return {}
    planes = (brep.faces[i].axis for i in part.faces if brep.faces[i].kind is SurfaceKind.PLANE)
    for axis in {line_key(plane): plane for plane in planes}.values():
        found = across_flats_and_corners(brep, part.faces, axis)
        if found is not None:
            return {"across_flats": found[0], "across_corners": found[1]}
    return {}


def _flats(part: Part, brep: Brep) -> Measured:
    found = None if part.axis is None else flats_on_round(brep, part.faces, part.axis)
    return {} if found is None else {"across_flats": found}


def _round_ends(part: Part) -> Measured:
    """From centre to centre: the length less the width, whose half both ends are round with."""
    if part.length is None or part.width is None or ROUND_ENDS.isdisjoint(part.tags):
        return {}
    if "open" in part.tags or part.length <= part.width:
        return {}
    return {"center_length": part.length - part.width}


def _chamfer(part: Part) -> Measured:
    """Along the axis of a turned one, whose draft is to that axis; else the smaller of what it takes off both faces."""
    if part.depth is not None:
        return {"chamfer_size": part.depth, "draft": None if part.angle is None else math.pi / 2 - part.angle}
    if part.width is None or part.angle is None:
        return {}
    return {"chamfer_size": part.width * min(math.cos(part.angle), math.sin(part.angle))}


def _drafted(part: Part, brep: Brep) -> Measured:
    found = None if part.normal is None else draft_of(brep, part.faces, part.normal)
    return {} if found is None else {"draft": found}


def _dovetail(part: Part, brep: Brep) -> Measured:
    """Of what stands on a face with two opposite flanks that lean over it: their angle to it, the widths at both ends.

    Where a fillet hides the foot of a flank, up to where the flank meets the face.
    """
    normal = part.normal
    if normal is None or part.height is None:
        return {}
    planes = [brep.faces[face] for face in part.faces if brep.faces[face].kind is SurfaceKind.PLANE]
    flanks = [plane for plane in planes if UNDERCUT[0] < -dot(plane.axis, normal) < UNDERCUT[1]]
    pairs = combinations(flanks, 2)
    opposed = next(((a, b) for a, b in pairs if dot(a.axis, b.axis) < 0), None)
    if opposed is None:
        return {}
    _, top = edges_span(brep, brep.edges_of(part.faces), normal)
    mouth, bottom = (_over_flanks(opposed, normal, level) for level in (top, top - part.height))
    if not mouth > bottom > 0:
        return {}  # sides of what is cut into it
    return {
        "angle": math.acos(-max(dot(plane.axis, normal) for plane in flanks)),
        "tags": (*part.tags, "dovetail"),
        "mouth_width": mouth,
        "bottom_width": bottom,
    }


def _over_flanks(flanks: tuple[FaceRecord, FaceRecord], normal: Vector, level: float) -> float:
    """How far is it from one leaning plane to the opposite one at this level along `normal`, in metres?"""
    width = 0.0
    for flank in flanks:
        lean = dot(flank.axis, normal)
        width += (dot(flank.point, flank.axis) - lean * level) / math.sqrt(1 - lean * lean)
    return width


def _tapered(part: Part, brep: Brep, breaks: Set[int]) -> Measured:
    """Of pockets and cutouts with leaning walls; `breaks`: faces of chamfers and rounds, which do not count."""
    own = set(part.faces) - breaks
    if part.normal is None or "open" in part.tags or not own:
        return {}
    draft = draft_of(brep, own, part.normal)
    measures: Measured = {} if draft is None else {"draft": draft}
    leaning = [i for i in own if brep.faces[i].kind in LEANING]
    if draft is None and faces_area(brep, leaning) <= MOSTLY * faces_area(brep, own):
        return measures  # its walls stand; cones among them break the edges of round ends
    found = mouth_and_bottom(brep, own, part.normal, draft)
    if found is None:
        return measures
    (mouth_length, mouth_width), (bottom_length, bottom_width) = found
    return measures | {
        "mouth_length": mouth_length,
        "mouth_width": mouth_width,
        "bottom_length": bottom_length,
        "bottom_width": bottom_width,
    }


def _cone(part: Part) -> Measured:
    """A cone leans by half of its angle."""
    return {} if part.angle is None else {"draft": part.angle / 2}


def _tapered_hole(part: Part) -> Measured:
    """A conical hole has the diameters of both ends as lengths and widths."""
    if "conical" not in part.tags or part.width is None or part.diameter is None or part.width == part.diameter:
        return {}
    mouth, bottom = dict.fromkeys(("mouth_length", "mouth_width"), part.width), part.diameter
    return {**mouth, "bottom_length": bottom, "bottom_width": bottom}


def _round_part(part: Part) -> Measured:
    """Of a boss, ring, standoff, pipe or bearing: over all, and free inside."""
    if not part.radii:
        return {}
    measures: Measured = {"outer_diameter": 2 * part.radii[0]}
    return {**measures, "inner_diameter": 2 * part.radii[1]} if len(part.radii) == 2 else measures


def _ring_groove(part: Part) -> Measured:
    """Of a groove in a face around an island: its outer and inner wall."""
    return _round_part(part) if "annular" in part.tags and "turned" not in part.tags else {}


def _torus(part: Part, tori: Sequence[Part]) -> Measured:
    """Over all, free inside, and across its tube; where another one lies in it, its wall."""
    if len(part.radii) != 2 or part.area is None:
        return {}
    around, tube = part.radii
    if part.area < WHOLE_TUBE * 4 * math.pi**2 * around * tube or tube >= around:
        return {}
    measures: Measured = {
        "outer_diameter": 2 * (around + tube),
        "inner_diameter": 2 * (around - tube),
        "tube_diameter": 2 * tube,
        "tags": (*part.tags, "ring"),
    }
    if "outer" in part.tags:
        near = 1e-3 * around
        inner = [t.radii[1] for t in tori if "inner" in t.tags and _is_within(t, part, near)]
        if inner:
            measures["thickness"] = tube - max(inner)
    return measures


def _is_within(inner: Part, outer: Part, near: float) -> bool:
    alike = dist(inner.center, outer.center) <= near and abs(inner.radii[0] - outer.radii[0]) <= near
    return alike and inner.radii[1] < outer.radii[1]


_OF_PART: Final[dict[PartKind, tuple[Callable[[Part], Measured], ...]]] = {
    PartKind.PRISM: (_round_ends, _inclined),
    PartKind.WALL: (_inclined,),
    PartKind.FLOOR: (_inclined,),
    PartKind.POCKET: (_round_ends,),
    PartKind.CUTOUT: (_round_ends,),
    PartKind.SLOT: (_round_ends,),
    PartKind.PROTRUSION: (_round_ends,),
    PartKind.BOSS: (_round_part,),
    PartKind.CHAMFER: (_chamfer,),
    PartKind.CONE: (_cone,),
    PartKind.HOLE: (_tapered_hole,),
    PartKind.PIPE: (_round_part,),
    PartKind.BEARING: (_round_part,),
    PartKind.GROOVE: (_ring_groove,),
}
_OF_FACES: Final[dict[PartKind, tuple[Callable[[Part, Brep], Measured], ...]]] = {
    PartKind.PRISM: (_regular, _square_bar),
    PartKind.POCKET: (_regular,),
    PartKind.CUTOUT: (_regular,),
    PartKind.PROTRUSION: (_regular, _drafted, _dovetail),
    PartKind.ELEVATION: (_drafted, _dovetail),
    PartKind.RIB: (_drafted,),
    PartKind.BOSS: (_flats,),
    PartKind.HOLE: (_flats,),
}
