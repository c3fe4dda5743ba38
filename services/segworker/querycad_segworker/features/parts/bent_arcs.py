"""Two coaxial arcs with the material between them: bends of sheet, and sectors of a ring such as bent flat bars."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from querycad_contracts import Part, SurfaceKind, Vector
from querycad_segworker.features.shared.axes import Wall
from querycad_segworker.features.shared.part_measures import faces_area, faces_box, geometry, millimetres
from querycad_segworker.tolerances import Tolerances
from querycad_segworker.topology import Brep, EdgeConvexity, EdgeKind, EdgeRecord
from querycad_segworker.vectors import add, box_center, box_extents, dot, parallel, scale, unit

ALIKE = 0.1
"""Both arcs cover the same angle and length but for this share: ends may be cut square or to a point."""
SAME_WAY = 0.95
"""Cosine of the angle between the middles of both arcs as seen from their axis."""
LEAST_RAD = math.radians(10.0)
"""Less is a crown, not a bend."""
HALF_RAD = (math.radians(170.0), math.radians(190.0))


@dataclass(frozen=True, slots=True)
class BentArc:
    """One bend or ring sector. Metres, radians. `length`: along the axis."""

    inner: Wall | None
    """None of a bend that is drawn sharp on its inside."""
    outer: Wall
    is_bend: bool
    """Sheet runs on from it tangentially, on one side at least."""

    @property
    def inner_radius(self) -> float:
        """Which radius has its inside? 0 where that is sharp."""
        return 0.0 if self.inner is None else self.inner.radius

    @property
    def thickness(self) -> float:
        """How thick is it, along the radius?"""
        return self.outer.radius - self.inner_radius


def recognise_bent_arcs(brep: Brep, walls: Sequence[Wall], tolerances: Tolerances) -> list[BentArc]:
    """Which bends of sheet and sectors of rings does the model have? By lowest face id.

    A hollow arc with a bulging one behind it, on one axis, over the same angle and the same length. A bend may be
    drawn sharp on its inside: then the axis of the bulging arc is the edge there.
    """
    arcs = [
        wall for wall in walls if wall.kind is SurfaceKind.CYLINDER and not wall.encloses and wall.sweep > LEAST_RAD
    ]
    found = []
    for inner in (wall for wall in arcs if wall.outward < 0):
        behind = [
            wall
            for wall in arcs
            if wall.outward > 0
            and wall.body == inner.body
            and wall.radius > inner.radius
            and wall.axis.same_line(inner.axis, tolerances)
            and _same_place(brep, inner, wall)
        ]
        outer = min(behind, key=lambda wall: wall.radius, default=None)
        if outer is not None and _is_free(brep, inner):
            found.append(BentArc(inner, outer, _runs_on(brep, inner) and _runs_on(brep, outer)))
    corners = [e for e in brep.edges if e.convexity is EdgeConvexity.CONCAVE and e.kind is EdgeKind.LINE]
    sharp = [wall for wall in arcs if wall.outward > 0 and _is_sharp_inside(brep, wall, corners, tolerances)]
    found += [BentArc(None, outer, True) for outer in sharp]
    return sorted(found, key=lambda one: (one.inner or one.outer).faces)


def _is_sharp_inside(brep: Brep, outer: Wall, corners: Sequence[EdgeRecord], tolerances: Tolerances) -> bool:
    """Do the planes on both sides of an arc lie as far from the two of one sharp corner as its radius?

    `corners`: the straight concave edges of the model.
    """
    sides = [
        brep.faces[other].axis
        for i in outer.faces
        for edge, other in brep.neighbours(i)
        if edge.convexity is EdgeConvexity.SMOOTH and brep.faces[other].kind is SurfaceKind.PLANE
    ]
    for edge in corners:
        on_axis = outer.axis.radius_of(edge.mid) <= 10 * tolerances.length
        if not on_axis or edge.length < (1 - ALIKE) * outer.height:
            continue
        if not parallel(edge.direction, outer.axis.direction, 1e-3):
            continue
        inside = [brep.faces[i].axis for i in edge.faces if brep.faces[i].kind is SurfaceKind.PLANE]
        if len(inside) == 2 and all(any(dot(a, b) < -SAME_WAY for b in sides) for a in inside):
            return True
    return False


def _same_place(brep: Brep, inner: Wall, outer: Wall) -> bool:
    along = [inner.axis.position(outer.axis.at(p)) for p in (outer.low, outer.high)]
    overlap = min(inner.high, max(along)) - max(inner.low, min(along))
    alike = abs(inner.sweep - outer.sweep) <= ALIKE * outer.sweep
    long = overlap >= (1 - ALIKE) * max(inner.height, outer.height)
    return alike and long and dot(_middle(brep, inner), _middle(brep, outer)) > SAME_WAY


def _middle(brep: Brep, wall: Wall) -> Vector:
    """The direction from the axis to the middle of the arc, from all ends of its straight edges and its faces."""
    total: Vector = (0.0, 0.0, 0.0)
    for i in wall.faces:
        face = brep.faces[i]
        total = add(total, scale(wall.axis.out_to(face.point), face.area))
    return unit(total)


def _is_free(brep: Brep, wall: Wall) -> bool:
    """Does it end at nothing that closes it off, as the floor of a box does its rounded corner?"""
    edges = (edge for i in wall.faces for edge, _ in brep.neighbours(i))
    return not any(edge.convexity is EdgeConvexity.CONCAVE and edge.kind is not EdgeKind.LINE for edge in edges)


def _runs_on(brep: Brep, wall: Wall) -> bool:
    """Does a plane go on from it tangentially, across an edge along its axis?"""
    return any(
        edge.convexity is EdgeConvexity.SMOOTH
        and edge.kind is EdgeKind.LINE
        and brep.faces[other].kind is SurfaceKind.PLANE
        for i in wall.faces
        for edge, other in brep.neighbours(i)
    )


def bent_arc_part(brep: Brep, found: BentArc, number: int) -> Part:
    """A bend of sheet, or a sector of a ring; its thickness is radial, its length along the bend line or the arc.

    The bend radius is that of the inside; the radius of a bend that is sharp there is that of its outside.
    """
    outer, walls = found.outer, [wall for wall in (found.inner, found.outer) if wall is not None]
    kind = "bend" if found.is_bend else "ring_sector"
    faces = tuple(sorted({face for wall in walls for face in wall.faces}))
    box = faces_box(brep, faces)
    half = HALF_RAD[0] <= outer.sweep <= HALF_RAD[1]
    middle = (found.inner_radius + outer.radius) / 2
    length = max(wall.height for wall in walls) if found.is_bend else middle * outer.sweep
    tags = ("sheet", "bent") if found.is_bend else ("bent", "arc", *(("semicircular",) if half else ()))
    name = "sheet bend" if found.is_bend else "half ring" if half else "sector of a ring"
    radius = found.inner_radius if found.is_bend else middle
    return Part(
        id=f"sheet-bend-{number}" if found.is_bend else f"ring-sector-{number}",
        kind=kind,
        tags=tags,
        label=f"{name}, radii {millimetres(outer.radius)} and {millimetres(found.inner_radius)}, "
        f"{math.degrees(outer.sweep):.4g} degrees",
        faces=faces,
        center=box_center(box),
        extents=box_extents(box),
        axis=outer.axis.direction,
        radius=radius or outer.radius,
        diameter=None if found.is_bend else 2 * outer.radius,
        radii=tuple(wall.radius for wall in reversed(walls)),
        outer_diameter=2 * outer.radius,
        inner_diameter=2 * found.inner_radius or None,
        thickness=found.thickness,
        width=found.thickness,
        height=outer.height,
        length=length,
        angle=outer.sweep,
        bend_radius=radius,
        bend_angle=outer.sweep,
        area=faces_area(brep, faces),
        evidence=geometry(
            "a bulging arc around the sharp corner behind it, as far from both of its planes as the sheet is thick"
            if found.inner is None
            else "a hollow arc and a bulging one behind it, on one axis, with the material between them"
        ),
    )
