"""Plates: two parallel faces that look away from each other, with walls square between them, thinner than wide."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from querycad_contracts import SurfaceKind, Vector
from querycad_segworker.features.protrusions.prisms import Prism
from querycad_segworker.features.protrusions.ribs import Rib
from querycad_segworker.features.shared.adjacency import breaks_edge
from querycad_segworker.features.shared.frames import frame_of_edges, outline_of
from querycad_segworker.features.shared.part_measures import PLATE_RATIO, faces_box
from querycad_segworker.features.shared.walls import REVOLVED
from querycad_segworker.tolerances import Tolerances, exceeds, reaches, significant
from querycad_segworker.topology import Brep, EdgeConvexity, EdgeKind, EdgeRecord, FaceRecord
from querycad_segworker.vectors import (
    add,
    box_center,
    box_extents,
    box_of,
    coordinate_axis,
    dot,
    parallel,
    scale,
    sub,
    upwards,
)

SQUARE = 1e-2
"""Sine of the angle by which walls and faces of a plate may deviate from square and parallel."""
MOST = 0.5
"""More than this share of a plate's outline is free, and of its face has another across from it; along the rest it runs
into what it carries or what carries it."""
BASE_RATIO = 0.6
"""A base is thinner than this share of its width: a rail is none."""
BASE_FREE = 0.9
"""More than this share of a base's outline is free."""
BASE_LEDGE, BASE_BARE = 0.25, 0.9
"""Between these shares of a base's face have another one across from it; on the rest stands what it carries."""
DISC = 0.75
"""Round by so much of a turn it is a disc, which is a boss; a plate with one round end is round by less."""
OWN = 2.0
"""A face larger than so many times the plate is that of what the plate goes on from: it may have further ones."""
ALIKE = 1e-9
"""Lengths of outline, as shares of it, that differ by less differ by rounding."""


@dataclass(frozen=True, slots=True)
class _Side:
    """One face of a plate, with the walls around it and where they end on the other side."""

    face: FaceRecord
    level: float
    """Position of the other side along the face's normal."""
    walls: tuple[int, ...]
    below: tuple[int, ...]
    """Faces of the other side."""


def recognise_plates(brep: Brep, prisms: Sequence[Prism], ribs: Sequence[Rib], tolerances: Tolerances) -> list[Prism]:
    """Which plates of any outline does the model have, beside those that are prisms with plane sides all around?

    Sorted by lowest face id. Round discs are bosses and left to them, thin walls that stand on the material are ribs.
    """
    known = [prism for prism in prisms if not reaches(prism.height, PLATE_RATIO * prism.width)]
    across = _Across(brep, 10 * tolerances.length)
    found: list[tuple[tuple[float, float], Prism, set[int]]] = []
    for face in brep.faces:
        side = _side(across, face)
        if side is None or any(_is_one(prism, side) for prism in known):
            continue
        if any({face.id, *side.below}.issuperset(rib.flanks) for rib in ribs):
            continue
        plate = _plate(brep, side, tolerances)
        if plate is not None:
            size = significant(face.area), significant(plate.length * plate.width)
            found.append((size, plate, {face.id, *side.below}))
    kept: list[Prism] = []
    taken: set[int] = set()
    # Of a bent sheet's two sides, as large as each other, the outer one counts: it goes on over its bends.
    for _, plate, faces in sorted(found, key=lambda one: (-one[0][0], -one[0][1], one[1].faces)):
        if taken.isdisjoint(faces):
            own = OWN * plate.length * plate.width
            taken |= {face for face in faces if not exceeds(brep.faces[face].area, own)}
            kept.append(plate)
    kept += _bases(across, [*prisms, *kept], tolerances)
    return sorted(kept, key=lambda plate: plate.faces[0])


def _bases(across: _Across, known: Sequence[Prism], tolerances: Tolerances) -> list[Prism]:
    """What a body stands on: a slab at one end of it, below steps on all sides, that is no prism by itself."""
    brep, found = across.brep, list[Prism]()
    boxes = {body.id: faces_box(brep, body.faces) for body in brep.bodies}
    for face in sorted(brep.faces, key=lambda one: (-one.area, one.id)):
        box, axis = boxes[face.body], max(range(3), key=lambda i: abs(face.axis[i]))
        near, far = (box[1][axis], box[0][axis]) if face.axis[axis] > 0 else (box[0][axis], box[1][axis])
        side = _side(across, face, BASE_FREE, BASE_LEDGE) if _lies_at(face, axis, near, across.near) else None
        if side is None or sum(brep.faces[i].area for i in side.below) > BASE_BARE * face.area:
            continue  # nothing stands on it
        if side.level - far * math.copysign(1.0, face.axis[axis]) < across.near:
            continue  # the body is no thicker than it: a plate with holes
        alike = (prism for prism in [*known, *found] if parallel(prism.normal, face.axis, SQUARE))
        if any(_is_one(prism, side) or not {face.id, *side.below}.isdisjoint(prism.faces) for prism in alike):
            continue
        slab = _plate(brep, side, tolerances, BASE_RATIO)
        if slab is not None:
            found.append(slab)
    return found


def _overlap(a: FaceRecord, b: FaceRecord) -> bool:
    """Does one lie before the other, as their boxes tell across the axis of the file that they look along most?"""
    along = coordinate_axis(a.axis)
    return all(min(a.box[1][i], b.box[1][i]) > max(a.box[0][i], b.box[0][i]) for i in range(3) if i != along)


def _lies_at(face: FaceRecord, axis: int, level: float, near: float) -> bool:
    """Does a plane face lie square to an axis of the file, at a level?"""
    square = face.kind is SurfaceKind.PLANE and abs(face.axis[axis]) > 1 - SQUARE**2
    return square and abs(face.point[axis] - level) < near


def without_edgewise(prisms: Sequence[Prism], plates: Sequence[Prism]) -> list[Prism]:
    """Those prisms that are no plates seen along their width: with both faces of a plate among their sides."""
    return [
        prism
        for prism in prisms
        if not any(
            abs(dot(prism.normal, plate.normal)) < SQUARE and len(set(prism.faces) & set(plate.faces)) > 2
            for plate in plates
        )
    ]


def _is_one(prism: Prism, side: _Side) -> bool:
    """Does a prism have these faces at its ends, or these walls around it?"""
    alike = parallel(prism.normal, side.face.axis, SQUARE)
    return alike and (side.face.id in prism.faces or len(set(prism.faces).intersection(side.walls)) > 1)


@dataclass(frozen=True, slots=True)
class _Ends:
    """Where an upright wall ends at faces that look another way, by level: what lies on one level is one.

    `levels`: (L,) float64, metres, rising. `first`: (L,) which of the wall's ends was the first there.
    """

    levels: NDArray[np.float64]
    first: NDArray[np.int64]
    faces: tuple[tuple[int, ...], ...]


def _side(across: _Across, face: FaceRecord, free_share: float = MOST, ledge: float = MOST) -> _Side | None:
    """The walls that run square from the outline of a face to one level, for most of the outline.

    `free_share`: of the outline, that ends there; `ledge`: of the face, that has another one across from it.
    """
    if face.kind is not SurfaceKind.PLANE or not face.loops or not face.loops[0].outer:
        return None
    brep = across.brep
    whole, above = 0.0, list[tuple[float, int]]()
    for e in face.loops[0].edges:
        edge = brep.edges[e]
        whole += edge.length
        beyond = [i for i in edge.faces if i != face.id]
        if len(beyond) != 1:
            return None
        other = brep.faces[beyond[0]]
        if breaks_edge(brep, face, edge, other):
            above += [(edge.length, wall) for wall in set(brep.beside(other.id, edge.convexity)) - {face.id}]
        elif edge.convexity is EdgeConvexity.CONVEX:
            above.append((edge.length, other.id))
    above = list(dict.fromkeys(above))
    ends = [across.ends(face, wall) for _, wall in above]
    levels = np.concatenate([each.levels for each in ends]) if ends else np.zeros(0)
    if not len(levels):
        return None
    counts = [len(each.levels) for each in ends]
    owner = np.repeat(np.arange(len(above)), counts)
    rising = np.argsort(levels, kind="stable")
    group = np.zeros(len(levels), dtype=np.int64)
    group[rising[1:]] = np.cumsum(np.diff(levels[rising]) > across.near)
    free = np.bincount(group, weights=np.array([length for length, _ in above])[owner])
    widest = np.flatnonzero(free[group] >= free.max() - ALIKE * whole)
    order = np.concatenate([each.first for each in ends])
    # Of several levels behind the face the nearest: the other leg of a U is across, too.
    top = dot(face.point, face.axis)
    behind = widest[levels[widest] < top - across.near]
    nearest = behind[levels[behind] >= levels[behind].max() - across.near] if len(behind) else widest
    first = min(nearest, key=lambda i: (owner[i], order[i]))
    if free[group[first]] <= free_share * whole:
        return None
    starts = np.cumsum([0, *counts])
    members = [(int(owner[i]), int(i - starts[owner[i]])) for i in np.flatnonzero(group == group[first])]
    below = tuple(sorted({f for k, i in members for f in ends[k].faces[i] if _overlap(face, brep.faces[f])}))
    if sum(brep.faces[i].area for i in below) < ledge * face.area:
        return None
    return _Side(face, float(levels[first]), tuple(sorted({above[k][1] for k, _ in members})), below)


class _Across:
    """The ends of upright walls. One with a thousand cutouts is gone through once for all faces that look one way."""

    def __init__(self, brep: Brep, near: float) -> None:
        self.brep, self.near = brep, near
        self._found: dict[tuple[int, Vector], _Ends] = {}

    def ends(self, face: FaceRecord, wall: int) -> _Ends:
        """Where does the wall end, against the normal of this face?"""
        x, y, z = (round(c, 6) + 0.0 for c in face.axis)
        key = (wall, (x, y, z))
        if key not in self._found:
            self._found[key] = self._by_level(_ends(self.brep, face, self.brep.faces[wall]))
        return self._found[key]

    def _by_level(self, ends: Sequence[tuple[float, int]]) -> _Ends:
        levels, first, faces = list[float](), list[int](), list[list[int]]()
        for number in sorted(range(len(ends)), key=lambda i: ends[i]):
            level, face = ends[number]
            if not levels or level - levels[-1] > self.near:
                levels.append(level)
                first.append(number)
                faces.append([])
            first[-1] = min(first[-1], number)
            faces[-1].append(face)
        return _Ends(np.array(levels), np.array(first, dtype=np.int64), tuple(map(tuple, faces)))


def _ends(brep: Brep, face: FaceRecord, wall: FaceRecord) -> list[tuple[float, int]]:
    """Where an upright wall ends at faces that look the other way: (level, face there)."""
    if wall.kind is SurfaceKind.PLANE:
        upright = abs(dot(wall.axis, face.axis)) < SQUARE
    elif wall.kind is SurfaceKind.CYLINDER:
        upright = parallel(wall.axis, face.axis, SQUARE)
    else:
        upright = wall.kind not in REVOLVED and _is_extruded(brep, face, wall)
    found = []
    for edge, other in brep.neighbours(wall.id) if upright else []:
        beyond = brep.faces[other]
        if beyond.kind is SurfaceKind.PLANE and dot(beyond.axis, face.axis) < SQUARE - 1:
            found.append((dot(beyond.point, face.axis), other))
        elif breaks_edge(brep, wall, edge, beyond):
            for last in brep.beside(other, edge.convexity):
                under = brep.faces[last]
                if under.kind is SurfaceKind.PLANE and dot(under.axis, face.axis) < SQUARE - 1:
                    found.append((dot(under.point, face.axis), last))
    return found


def _is_extruded(brep: Brep, face: FaceRecord, wall: FaceRecord) -> bool:
    """Is a freeform wall bounded by lines along the normal, and by edges in the plane of the face or across it?"""
    return all(
        abs(dot(sub(edge.end, edge.start), face.axis)) <= SQUARE * edge.length
        or (edge.kind is EdgeKind.LINE and parallel(edge.direction, face.axis, SQUARE))
        for edge, _ in brep.neighbours(wall.id)
    )


def _is_within(brep: Brep, wall: int, side: _Side, tolerances: Tolerances) -> bool:
    """Does a wall end where the plate does, instead of running on past it as the end of a bent sheet?"""
    points = [p for e in brep.face_edges[wall] for p in brep.edges[e].points]
    levels = [dot(point, side.face.axis) for point in points]
    near = 10 * tolerances.length
    return side.level - near <= min(levels) and max(levels) <= dot(side.face.point, side.face.axis) + near


def _level_box(around: tuple[Vector, Vector], own: tuple[Vector, Vector], normal: Vector) -> tuple[Vector, Vector]:
    """A box as wide as `around`; where the normal runs along an axis of the file, along that one at the level of `own`.

    What breaks the edges of a face lies below it.
    """
    along = coordinate_axis(normal)
    low, high = (
        (b[0] if along == 0 else a[0], b[1] if along == 1 else a[1], b[2] if along == 2 else a[2])
        for a, b in zip(around, own, strict=True)
    )
    return low, high


def _is_slit_disc(rim: Sequence[EdgeRecord]) -> bool:
    """Is most of an outline one arc, as of a ring with a slit?"""
    return any(edge.radius and edge.length > DISC * 2 * math.pi * edge.radius for edge in rim)


def _plate(brep: Brep, side: _Side, tolerances: Tolerances, ratio: float = PLATE_RATIO) -> Prism | None:
    face = side.face
    top = dot(face.point, face.axis)
    thickness = top - side.level
    outline, _ = outline_of(brep, face.loops[0], tolerances)
    rim = [brep.edges[e] for e in face.loops[0].edges]
    broken = {i for edge in rim for i in edge.faces if i != face.id and breaks_edge(brep, face, edge, brep.faces[i])}
    frame = frame_of_edges(brep, {edge.id for edge in rim} | brep.edges_of(broken), face.axis, None)
    length, width, _ = frame.size
    if thickness <= 0 or reaches(thickness, ratio * width) or outline == "circular" or _is_slit_disc(rim):
        return None
    down = scale(face.axis, -thickness)
    low, high_corner = _level_box(faces_box(brep, {face.id, *broken}), faces_box(brep, (face.id,)), face.axis)
    box = box_of((low, high_corner, add(low, down), add(high_corner, down)))
    assert box is not None  # of four points
    normal = upwards(face.axis)
    center = box_center(box)
    high = max(dot(normal, face.axis) * top, dot(normal, face.axis) * side.level)
    return Prism(
        sides=0,
        normal=normal,
        direction=frame.u,
        length=length,
        width=width,
        height=thickness,
        center=center,
        extents=box_extents(box),
        tip=add(center, scale(normal, high - dot(center, normal))),
        faces=tuple(sorted({face.id, *side.below, *(w for w in side.walls if _is_within(brep, w, side, tolerances))})),
        body=face.body,
        outline=outline,
    )
