"""Tubes with flat sides: square and rectangular hollow sections, and those with more sides, of one wall thickness."""

from __future__ import annotations

from bisect import bisect_right
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass

from querycad_contracts import SurfaceKind, Vector
from querycad_segworker.features.depressions.depression import Depression, DepressionKind
from querycad_segworker.features.protrusions.prisms import Prism
from querycad_segworker.features.shared.adjacency import is_blend
from querycad_segworker.features.shared.refusals import refuse
from querycad_segworker.topology import Brep, EdgeConvexity, FaceRecord
from querycad_segworker.vectors import Box, add, box_center, cross, dot, line_key, parallel, scale

MAX_WALL = 0.3
"""A wall is thinner than this share of what it surrounds: the thickest sections of EN 10210-2 have some 0.2."""
SAME = 0.01
"""Walls whose thicknesses differ by less than this share are alike: far below the tolerances of rolled sections."""
SQUARE = 1e-3
"""Sine of the angle by which inside and outside may deviate from parallel."""


@dataclass(frozen=True, slots=True)
class HollowSection:
    """One tube with flat sides. Metres. `length` runs along `axis`, `width` is the smaller of its outer measures."""

    outline: str
    axis: Vector
    direction: Vector
    """Unit direction of its larger outer measure."""
    center: Vector
    length: float
    size: tuple[float, float]
    """Outer measures across, the larger first."""
    wall: float
    outside: tuple[int, ...]
    faces: tuple[int, ...]

    @property
    def extents(self) -> Vector:
        """How large is its box along the axes of the file? A side may run on past it."""
        across = cross(self.axis, self.direction)
        sides = ((self.axis, self.length), (self.direction, self.size[0]), (across, self.size[1]))
        x, y, z = (sum(abs(way[i]) * size for way, size in sides) for i in range(3))
        return x, y, z


class _Planes:
    """Plane faces by body and line of their normal, in order of their distance from the origin along it."""

    def __init__(self, brep: Brep) -> None:
        self._along: dict[tuple[int, Vector], list[tuple[float, int]]] = defaultdict(list)
        self._brep = brep
        for face in brep.faces:
            if face.kind is SurfaceKind.PLANE:
                self._along[face.body, line_key(face.axis)].append((dot(face.point, face.axis), face.id))
        for members in self._along.values():
            members.sort()

    def behind(self, wall: FaceRecord, reach: float) -> FaceRecord | None:
        """The nearest face that closes the material behind the middle of a wall, within this distance."""
        out = scale(wall.axis, -1.0)
        middle = box_center(wall.box)
        members = self._along[wall.body, line_key(out)]
        level = dot(wall.point, out)
        for offset, face_id in members[bisect_right(members, (level, -1)) :]:
            if offset > level + reach:
                break
            face, across = self._brep.faces[face_id], add(middle, scale(out, offset - level))
            if dot(face.axis, out) > 1 - SQUARE and _holds(face.box, across, reach):
                return face
        return None


def _holds(box: Box, point: Vector, reach: float) -> bool:
    near = SAME * reach
    return all(low - near <= c <= high + near for low, c, high in zip(box[0], point, box[1], strict=True))


def recognise_hollow_sections(brep: Brep, depressions: Sequence[Depression]) -> list[HollowSection]:
    """Which tubes with flat sides does the model have? Sorted by lowest face id.

    One is found from its inside: a passage or deep pocket, longer than wide, of which each plane wall has a face of the
    outside behind it, all at one distance; these meet in convex edges or roundings, all the way around.
    """
    planes: _Planes | None = None
    found = []
    for inside in depressions:
        deep = inside.kind in (DepressionKind.PASSAGE, DepressionKind.POCKET) and inside.depth > inside.length
        if not deep:
            continue
        planes = planes or _Planes(brep)
        section = _section(brep, planes, inside)
        if section is not None:
            found.append(section)
    return sorted(found, key=lambda section: section.faces[0])


def _section(brep: Brep, planes: _Planes, inside: Depression) -> HollowSection | None:
    faces = [brep.faces[f] for f in inside.faces if f not in inside.floor]
    walls = [f for f in faces if f.kind is SurfaceKind.PLANE and abs(dot(f.axis, inside.normal)) < SQUARE]
    outside = [planes.behind(wall, MAX_WALL * inside.width) for wall in walls]
    gaps = [
        abs(dot(a.axis, a.point) - dot(a.axis, b.point)) for a, b in zip(walls, outside, strict=True) if b is not None
    ]
    sides = {face.id for face in outside if face is not None}
    if len(walls) < 3 or len(gaps) < len(walls):
        return None
    if max(gaps) > (1 + SAME) * min(gaps):
        refuse("tube", (*inside.faces, *sides), "its walls differ in thickness")
        return None
    if any(len(_beside(brep, side, inside.normal) & sides) < 2 for side in sides):
        return None
    wall = min(gaps)
    return HollowSection(
        outline=inside.outline,
        axis=inside.normal,
        direction=inside.direction,
        center=inside.center,
        length=inside.depth,
        size=(inside.length + 2 * wall, inside.width + 2 * wall),
        wall=wall,
        outside=tuple(sorted(sides)),
        faces=tuple(sorted({*inside.faces, *sides} - set(inside.floor))),
    )


def _beside(brep: Brep, side: int, axis: Vector) -> set[int]:
    """The faces that a side meets in convex edges along the axis, or over a rounding."""
    found = set()
    for edge, other in brep.neighbours(side):
        if not parallel(edge.direction, axis, 10 * SQUARE):
            continue
        if edge.convexity is EdgeConvexity.CONVEX:
            found.add(other)
        elif is_blend(brep, brep.faces[other]) and brep.faces[other].outward > 0:
            found |= set(brep.beside(other, EdgeConvexity.SMOOTH)) - {side}
    return found


def beside_sections(prisms: Sequence[Prism], sections: Sequence[HollowSection]) -> list[Prism]:
    """Without the prisms that are the outside of such a tube."""
    return [
        prism for prism in prisms if not any(len(set(prism.faces) & set(section.outside)) > 2 for section in sections)
    ]
