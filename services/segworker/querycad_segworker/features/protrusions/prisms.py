"""Prisms: closed rings of plane side faces around the material, such as hexagon heads, octagonal plates and blocks."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Sequence
from dataclasses import dataclass

from querycad_contracts import SurfaceKind, Vector
from querycad_segworker.features.shared.adjacency import is_blend
from querycad_segworker.features.shared.frames import face_points, frame_of_edges, polygon_name
from querycad_segworker.features.shared.part_measures import faces_box
from querycad_segworker.features.shared.reach import edges_box, faces_span
from querycad_segworker.features.shared.refusals import refuse
from querycad_segworker.features.shared.regular import BROKEN, across_flats_and_corners
from querycad_segworker.features.shared.shaft_steps import ALIKE
from querycad_segworker.tolerances import significant
from querycad_segworker.topology import Brep, EdgeConvexity, EdgeKind, EdgeRecord, FaceRecord, parted
from querycad_segworker.vectors import (
    add,
    box_center,
    box_extents,
    box_of,
    cross,
    dot,
    mean,
    norm,
    parallel,
    scale,
    span,
    sub,
    upwards,
)

MAX_SIDES = 12
"""More sides than this are a faceted circle."""
OUTREACH = 1 / 3
"""Sides that meet along less than this share of their reach are the flanks of a profile, as of a Z or a saddle, and its
ends; those of a lug with a round end meet along more."""
ONE_WAY = 1e-3
"""Sine of the angle below which two sides look the same way, as for the edges between them."""


@dataclass(frozen=True, slots=True)
class Prism:
    """One prism. Metres, frame of the file. `normal` is its axis, from its lower to its upper end."""

    sides: int
    normal: Vector
    direction: Vector
    length: float
    width: float
    height: float
    center: Vector
    """Of its box along the axes of the file, which has `extents`."""
    extents: Vector
    tip: Vector
    faces: tuple[int, ...]
    body: int
    outline: str
    """What its cross-section is called."""


def recognise_prisms(brep: Brep, chamfers: Collection[int] = ()) -> list[Prism]:
    """Which prisms does the model have? Sorted by lowest face id. `chamfers`: faces that break edges.

    The side faces of a prism are planes parallel to one direction, of which each meets the next in a convex edge (or
    a rounding) along that direction, all the way around. A cuboid has three such rings; the one around its shortest
    direction is kept, as for a plate; a regular hexagon or octagon comes before the rings of two of its sides and the
    ends.
    """
    found: list[Prism] = []
    open_ended: list[Prism] = []
    profiles: list[set[int]] = []
    for direction, links in _links_by_direction(brep).items():
        for ring in parted(sorted(links), links.__getitem__):
            if len(ring) < 3 or not all(len(links[face]) == 2 for face in ring):
                continue
            if not _faces_out(brep, ring, direction):
                refuse("prism", ring, "its sides face each other: the walls of a cut")
            elif _turns_back(brep, ring):
                refuse("prism", ring, "two of its sides look the same way: they go around no material")
            elif len(ring) > MAX_SIDES:
                refuse("prism", ring, f"its {len(ring)} sides are those of a faceted circle")
            elif _meets_in_chamfers(brep, ring, direction, chamfers):
                refuse("prism", ring, "its sides meet at broken corners only")
            elif _outreach_corners(brep, ring, direction, chamfers):
                refuse("prism", ring, "its sides reach further than they meet: those of a profile")
                profiles.append(ring)
            else:
                found.append(_prism(brep, ring, direction, chamfers))
                if any(_runs_on(brep, side, _corners(brep, ring, direction), direction) for side in ring):
                    open_ended.append(found[-1])
    # What has flanks of a profile that run on past it is a stretch of that profile.
    stretches = [prism for prism in open_ended if any(len(ring.intersection(prism.faces)) > 1 for ring in profiles)]
    found = [prism for prism in found if prism not in stretches]
    kept: list[Prism] = []
    for prism in sorted(
        found, key=lambda p: (not (p.sides > 4 and _is_regular(brep, p)), significant(p.height), p.faces)
    ):
        if not any(len(set(prism.faces) & set(other.faces)) >= 2 for other in kept):
            kept.append(prism)
    return sorted(kept, key=lambda p: p.faces[0])


def _is_regular(brep: Brep, prism: Prism) -> bool:
    return across_flats_and_corners(brep, prism.faces, prism.normal) is not None


def _links_by_direction(brep: Brep) -> dict[Vector, dict[int, set[int]]]:
    """Pairs of plane faces that meet in a straight convex edge or over a rounding, by the direction of that edge."""
    links: dict[Vector, dict[int, set[int]]] = defaultdict(lambda: defaultdict(set))
    cut_in = {e for face in brep.faces for loop in face.loops if not loop.outer for e in loop.edges}
    for edge in brep.edges:
        if len(edge.faces) != 2 or edge.kind is not EdgeKind.LINE or edge.convexity is not EdgeConvexity.CONVEX:
            continue
        if edge.id in cut_in:  # where a window or keyway opens
            continue
        a, b = (brep.faces[i] for i in edge.faces)
        if a.kind is SurfaceKind.PLANE and b.kind is SurfaceKind.PLANE:
            _link(links, edge.direction, a, b)
    for face in brep.faces:
        if _is_corner(brep, face):
            _link(links, face.axis, *(brep.faces[side] for side in _sides_of_corner(brep, face)))
    return links


def _is_corner(brep: Brep, face: FaceRecord) -> bool:
    """Is it a rounded corner between two sides, or one that was turned down to a cylinder around the prism's axis?"""
    return face.kind is SurfaceKind.CYLINDER and face.outward > 0 and len(_sides_of_corner(brep, face)) == 2


def _sides_of_corner(brep: Brep, face: FaceRecord) -> list[int]:
    """The plane faces beside a cylinder, in straight edges along it: tangent ones, or such as cut into it."""
    wanted = EdgeConvexity.SMOOTH if is_blend(brep, face) else EdgeConvexity.CONVEX
    beside = [
        other
        for edge, other in brep.neighbours(face.id)
        if edge.convexity is wanted
        and brep.faces[other].kind is SurfaceKind.PLANE
        and (wanted is EdgeConvexity.SMOOTH or edge.kind is EdgeKind.LINE)
    ]
    return sorted(set(beside))


def _link(links: dict[Vector, dict[int, set[int]]], direction: Vector, a: FaceRecord, b: FaceRecord) -> None:
    if a.id == b.id or parallel(a.axis, b.axis, 1e-3):
        return
    turned = max(direction, scale(direction, -1.0))
    key = next((known for known in links if norm(cross(known, turned)) < 1e-3), turned)
    links[key][a.id].add(b.id)
    links[key][b.id].add(a.id)


def _faces_out(brep: Brep, ring: set[int], direction: Vector) -> bool:
    """Do all sides look away from the middle between them?"""
    corners = _corners(brep, ring, direction)
    middle = mean([edge.mid for edge in corners])
    return all(dot(sub(brep.faces[side].point, middle), brep.faces[side].axis) > 0 for side in ring)


def _turns_back(brep: Brep, ring: set[int]) -> bool:
    """Do two sides look the same way? Sides that turn around the material by convex corners never do."""
    normals = [brep.faces[side].axis for side in sorted(ring)]
    return any(dot(a, b) > 0 and parallel(a, b, ONE_WAY) for i, a in enumerate(normals) for b in normals[i + 1 :])


def _corners(brep: Brep, ring: set[int], direction: Vector) -> list[EdgeRecord]:
    """The edges along the prism in which its sides meet each other, or the corners between them."""
    return [
        edge
        for side in sorted(ring)
        for edge, other in brep.neighbours(side)
        if (other in ring or _is_corner(brep, brep.faces[other]))
        and edge.kind is EdgeKind.LINE
        and parallel(edge.direction, direction, 1e-3)
    ]


def _prism(brep: Brep, ring: set[int], direction: Vector, chamfers: Collection[int]) -> Prism:
    """The prism with these sides, named by those that are no broken corners.

    Of a side that runs on past its corners, level with what the prism stands on, only what lies between them is the
    prism's.
    """
    axis = upwards(direction)
    breaks = _edge_breaks(brep, ring, axis)
    breaks |= _edge_breaks(brep, {face for face in breaks if _is_corner(brep, brep.faces[face])}, axis) - ring
    caps = _caps(brep, ring | breaks, axis)
    corners = _corners(brep, ring, direction)
    whole = {side for side in ring if not _runs_on(brep, side, corners, axis)}
    edges = {edge.id for edge in corners} | brep.edges_of(whole | breaks)
    frame = frame_of_edges(brep, edges, axis, None)
    length, width, height = frame.size
    own = ring | breaks | caps
    box = faces_box(brep, own) if whole == ring else edges_box(brep, edges)
    assert box is not None  # a ring has corners
    center, low, high = box_center(box), frame.low[2], frame.low[2] + height
    levels = [dot(point, axis) for point in face_points(brep, _foot_fillets(brep, whole, axis))]
    if levels and (min(levels) < low or max(levels) > high):
        ends = [add(center, scale(axis, level - dot(center, axis))) for level in (min(levels), max(levels))]
        box = box_of((*box, *ends)) or box
        center, height = box_center(box), max(high, *levels) - min(low, *levels)
    named = _unbroken(brep, ring, axis, chamfers)
    return Prism(
        sides=len(named),
        normal=axis,
        direction=frame.u,
        length=length,
        width=width,
        height=height,
        center=center,
        extents=box_extents(box),
        tip=add(center, scale(axis, max([high, *levels]) - dot(center, axis))),
        faces=tuple(sorted(own)),
        body=brep.faces[min(ring)].body,
        outline=polygon_name([brep.faces[side].axis for side in named]),
    )


def _unbroken(brep: Brep, ring: set[int], axis: Vector, chamfers: Collection[int]) -> list[int]:
    """The sides without those that break corners: in a regular outline any that are narrow, else narrow `chamfers`."""
    spans = {i: faces_span(brep, (i,), cross(axis, brep.faces[i].axis)) for i in sorted(ring)}
    widths = {i: high - low for i, (low, high) in spans.items()}
    if across_flats_and_corners(brep, ring, axis) is not None:
        return [i for i in widths if widths[i] >= BROKEN * max(widths.values())]
    sides = [i for i in widths if i not in chamfers]
    least = min((widths[i] for i in sides), default=0.0)
    broken = all(widths[i] < BROKEN * least for i in ring.intersection(chamfers))
    return sides if broken and len(sides) > 2 else list(widths)


def _foot_fillets(brep: Brep, sides: Collection[int], axis: Vector) -> set[int]:
    """The fillets between the sides and what the prism stands on: it is as high as it stands there."""
    blends = {i for side in sides for i in brep.beside(side, EdgeConvexity.SMOOTH) if brep.faces[i].outward < 0}
    return {
        blend
        for blend in blends
        if any(
            brep.faces[i].kind is SurfaceKind.PLANE and parallel(brep.faces[i].axis, axis, 1e-3)
            for i in brep.beside(blend, EdgeConvexity.SMOOTH)
        )
    }


def _meets_in_chamfers(brep: Brep, ring: set[int], direction: Vector, chamfers: Collection[int]) -> bool:
    """Are the sides but for chamfers across corners all longer along the ring than the corners are?

    As two opposite faces of a block and the chamfers on two of its edges.
    """
    longest = max(edge.length for edge in _corners(brep, ring, direction))
    reaches = [faces_span(brep, (side,), direction) for side in ring.difference(chamfers)]
    return len(reaches) < len(ring) and all(high - low > ALIKE * longest for low, high in reaches)


def _outreach_corners(brep: Brep, ring: set[int], direction: Vector, chamfers: Collection[int]) -> bool:
    """Do two sides reach further along the ring than any two of its sides meet, with no chamfer turned around it?

    The ends of a profile, such as a Z or a saddle, and its two flanks. A side that runs on across, level with what the
    prism stands on, does not count; nor does what chamfers and rounds beside the sides take off their corners.
    """
    axis = upwards(direction)
    corners = _corners(brep, ring, direction)
    own = (side for side in sorted(ring) if not _runs_on(brep, side, corners, axis))
    reaches = [faces_span(brep, (side,), axis) for side in own]
    beside = [brep.faces[i] for i in sorted({i for side in ring for _, i in brep.neighbours(side)} - ring)]
    breaks = [face.id for face in beside if face.id in chamfers or (face.outward > 0 and is_blend(brep, face))]
    taken = (faces_span(brep, (face,), axis) for face in breaks)
    most = max(edge.length for edge in corners) + 2 * max((high - low for low, high in taken), default=0.0)
    turned = any(_is_turned_chamfer(brep, face, ring, axis) for face in beside)
    return not turned and sum(OUTREACH * (high - low) > most for low, high in reaches) > 1


def _runs_on(brep: Brep, side: int, corners: Sequence[EdgeRecord], axis: Vector) -> bool:
    """Does a side reach further across than the corners at its two ends?"""
    across = cross(axis, brep.faces[side].axis)
    first, last = span((p for edge in corners if side in edge.faces for p in (edge.start, edge.end)), across)
    low, high = faces_span(brep, (side,), across)
    return high - low > ALIKE * (last - first)


def _edge_breaks(brep: Brep, ring: set[int], axis: Vector) -> set[int]:
    """Chamfers and roundings between the sides, or the corners, and the ends: they belong to the prism."""
    breaks = set()
    for side in ring:
        for edge, other in brep.neighbours(side):
            face = brep.faces[other]
            slanted = face.kind is SurfaceKind.PLANE and 0.3 < abs(dot(face.axis, axis)) < 0.95
            chamfer = slanted and edge.convexity is EdgeConvexity.CONVEX and face.area < 0.5 * brep.faces[side].area
            rounding = face.outward > 0 and is_blend(brep, face) and edge.convexity is EdgeConvexity.SMOOTH
            turned = edge.convexity is EdgeConvexity.CONVEX and _is_turned_chamfer(brep, face, ring, axis)
            if other not in ring and (chamfer or rounding or turned):
                breaks.add(other)
    return breaks


def _is_turned_chamfer(brep: Brep, face: FaceRecord, ring: set[int], axis: Vector) -> bool:
    """Is it a cone around the prism that takes the corners off, as of a nut (ISO 4032), lower than the sides are?"""
    if face.kind is not SurfaceKind.CONE or face.outward < 0 or not parallel(face.axis, axis, 1e-3):
        return False
    (low, high), (bottom, top) = (faces_span(brep, faces, axis) for faces in ((face.id,), tuple(ring)))
    return ring.issubset(brep.beside(face.id, EdgeConvexity.CONVEX)) and high - low < (top - bottom) / 2


def _caps(brep: Brep, around: set[int], axis: Vector) -> set[int]:
    """The end faces: planes at right angles to the axis that only the prism's own faces bound from outside."""
    caps = set()
    for face in {other for side in around for _, other in brep.neighbours(side)} - around:
        record = brep.faces[face]
        if record.kind is not SurfaceKind.PLANE or not parallel(record.axis, axis, 1e-2) or not record.loops:
            continue
        outer = {other for e in record.loops[0].edges for other in brep.edges[e].faces} - {face}
        if outer <= around and record.loops[0].outer:
            caps.add(face)
    return caps
