"""The faces as users and programs see them, and the side that a model stands on: what the B-rep alone tells of both."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

from querycad_contracts import Face, Outline, Side, SurfaceKind, Vector
from querycad_segworker.tolerances import FACING, Tolerances
from querycad_segworker.topology import REVOLVED, Brep, FaceRecord
from querycad_segworker.vectors import (
    box_center,
    box_extents,
    cross,
    dist,
    dot,
    foot,
)

from .shared.frames import frame_of_edges, outline_of
from .shared.reach import reach_along

_AXES: tuple[Vector, ...] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
_OUTLINES = {"circular": Outline.CIRCLE, "rectangular": Outline.RECTANGLE, "obround": Outline.SLOT}
STANDS = 0.25
"""Most files are drawn upright: a bottom with this share of the firmest stand is what the model stands on."""


@dataclass(frozen=True, slots=True)
class _OwnSize:
    """A plane face in its own frame."""

    along: Vector
    size: Vector


def faces_of(brep: Brep) -> list[Face]:
    """The faces as users and programs see them, in order of their ids."""
    tolerances = Tolerances.for_diagonal(dist(*brep.box))
    return [_face(brep, record, tolerances) for record in brep.faces]


def _face(brep: Brep, record: FaceRecord, tolerances: Tolerances) -> Face:
    is_plane = record.kind is SurfaceKind.PLANE
    revolved = record.kind in REVOLVED
    radius = record.minor_radius if record.kind is SurfaceKind.TORUS else record.radius
    own = _own_size(brep, record) if is_plane else None
    along_axis = record.kind in (SurfaceKind.CYLINDER, SurfaceKind.CONE)
    length = _extent(brep, record, brep.face_edges[record.id], record.axis) if along_axis else None
    center = box_center(record.box)
    return Face(
        id=record.id,
        body=record.body,
        kind=record.kind,
        center=center,
        extents=box_extents(record.box),
        area=record.area,
        convexity=record.convexity,
        radius=radius if revolved or record.kind is SurfaceKind.SPHERE else None,
        normal=record.axis if is_plane else None,
        axis=record.axis if revolved else None,
        axis_point=foot(center, record.origin, record.axis) if revolved else None,
        length=own.size[0] if own is not None else length,
        outline=_outline(brep, record, tolerances) if is_plane else None,
        local_size=own.size if own is not None else None,
        along=own.along if own is not None else None,
        neighbours=tuple(sorted({other for _, other in brep.neighbours(record.id)})),
    )


def _outline(brep: Brep, record: FaceRecord, tolerances: Tolerances) -> Outline | None:
    outer = next((loop for loop in record.loops if loop.outer), None)
    return None if outer is None else _OUTLINES.get(outline_of(brep, outer, tolerances)[0], Outline.FREE)


def _own_size(brep: Brep, record: FaceRecord) -> _OwnSize | None:
    """The length and width of a plane face; None where its boundary is neither straight nor round nor along the axes.

    Its length is along the longest straight edge, or across it where the face is larger that way.
    """
    outer = next((loop for loop in record.loops if loop.outer), None)
    if outer is None:
        return None
    along = frame_of_edges(brep, outer.edges, record.axis, outer).u
    across = cross(record.axis, along)
    sizes = [_extent(brep, record, outer.edges, way) for way in (along, across)]
    if sizes[0] is None or sizes[1] is None:
        return None
    if sizes[1] > sizes[0] * (1 + 1e-9):
        return _OwnSize(across, (sizes[1], sizes[0], 0.0))
    return _OwnSize(along, (sizes[0], sizes[1], 0.0))


def _extent(brep: Brep, record: FaceRecord, edges: Collection[int], way: Vector) -> float | None:
    """How far do these edges of a face reach along a unit vector? None where that is not known exactly."""
    for axis, extent in zip(_AXES, box_extents(record.box), strict=True):
        if abs(dot(axis, way)) > 1 - 1e-12:
            return extent
    reach = reach_along(brep, edges, way)
    return None if reach is None else reach[1] - reach[0]


def likely_up(brep: Brep) -> Side | None:
    """Which side is likely up? The top, as files are drawn, unless the model would hardly stand on its bottom.

    Then it is opposite the side that has the largest area of plane faces on the bounding box. None where no side has
    any.
    """
    tolerance = Tolerances.for_diagonal(dist(*brep.box)).length
    low, high = brep.box
    firm = dict.fromkeys(Side, 0.0)
    for face in brep.faces:
        if face.kind is not SurfaceKind.PLANE:
            continue
        side = max(Side, key=lambda one: dot(one.outward, face.axis))
        axis = next(i for i in range(3) if side.outward[i])
        border = (high if side.outward[axis] > 0 else low)[axis]
        if dot(side.outward, face.axis) > FACING.parallel and abs(box_center(face.box)[axis] - border) <= tolerance:
            firm[side] += face.area
    best = max(firm.values())
    if best <= 0:
        return None
    stands_on = Side.BOTTOM if firm[Side.BOTTOM] >= STANDS * best else max(firm, key=lambda side: firm[side])
    return stands_on.opposite
