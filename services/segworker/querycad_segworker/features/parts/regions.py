"""Depressions and elevations that no family has taken become parts: last choice of 'recess', 'bump' and so on."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence, Set
from dataclasses import dataclass, replace
from itertools import combinations, permutations

import numpy as np

from querycad_contracts import Bottom, Part, PartKind, SurfaceKind, Vector
from querycad_segworker.features.blends.rolling_balls import normal_at
from querycad_segworker.features.depressions.concave_regions import LEANS_BACK
from querycad_segworker.features.depressions.depression import DepressionKind, depression_in
from querycad_segworker.features.protrusions.protrusions import Protrusion, tags_of
from querycad_segworker.features.shared.adjacency import is_blend
from querycad_segworker.features.shared.extruded_walls import section_of
from querycad_segworker.features.shared.face_regions import UPRIGHT, Moments, Region, closed_regions
from querycad_segworker.features.shared.frames import LocalFrame, frame_of, outline_of
from querycad_segworker.features.shared.part_measures import faces_area
from querycad_segworker.features.shared.refusals import refuse
from querycad_segworker.features.shared.regular import is_d
from querycad_segworker.tolerances import FACING, Tolerances
from querycad_segworker.topology import Brep, EdgeConvexity, EdgeKind, EdgeRecord, FaceRecord, Loop
from querycad_segworker.vectors import add, dot, scale, upwards

from .depressions import depression_part
from .protrusions import protrusion_part
from .volumes import Volumes

TAKEN = 0.5
"""A region with more than this share of its surface in parts of a family is one of them, or made of them."""
LEVEL = FACING.alike
"""A plane that looks to where a region opens gives the exact direction."""
ASIDE = 0.75
"""Cosine of 41 degrees: a rim whose face looks farther off the opening's direction leaves it open there."""
SQUARE = 1e-2
"""Sine of the angle by which walls may deviate from upright, and a floor from level."""
_BOTH = frozenset((PartKind.GEAR, PartKind.TOOTH, PartKind.PIPE))
_CUT = _BOTH | {kind for kind in PartKind if kind.cuts_in} | {PartKind.CAVITY}
_OUT = _BOTH | {kind for kind in PartKind if kind.stands_out} | {PartKind.WALL, PartKind.RING_SECTOR}


def region_parts(
    brep: Brep,
    parts: Sequence[Part],
    volumes: Volumes,
    tolerances: Tolerances,
    *,
    corners: Set[int] = frozenset(),
    caps: Collection[int] = (),
) -> list[Part]:
    """Which regions has no family taken? `parts`: those of all families. None without a mesh to measure them by.

    `corners`: faces of corners between walls; what is made of them is no depression. `caps`: faces of the top and
    bottom of arms, which are not among the arms' own. A ball at the end of a stud is none.
    """
    if volumes.moments is None:
        return []
    cuts = [part for part in parts if part.kind in _CUT]
    cut = frozenset(face for part in cuts for face in part.faces)
    # The gap of a fork has no walls of its own: they are those of the lugs, which stand out.
    sunk = [part for part in cuts if part.kind is not PartKind.STEP and "fork" not in part.tags]
    across = {face for part in sunk for face in part.faces}
    out = frozenset(face for part in parts if part.kind in _OUT for face in part.faces)
    studs = {face for part in parts if part.kind is PartKind.BOSS for face in part.faces}
    out |= {face for part in parts if "ball" in part.tags for face in part.faces if _is_on(brep, face, studs)}
    out = out.union(caps)
    maker = _Maker(brep, volumes, volumes.moments, tolerances, cut)
    breaks = frozenset(face for part in parts if part.kind.breaks_edge for face in part.faces)
    spokes = frozenset(face for part in parts if "spoke" in part.tags for face in part.faces)
    makers: dict[bool, Callable[[Region, int], Part | None]] = {True: maker.depression, False: maker.elevation}
    standing = [frozenset(part.faces) for part in parts if part.kind.stands_out and part.kind is not PartKind.BODY]
    found: dict[bool, list[Part]] = {True: [], False: []}
    for region in closed_regions(brep, volumes.moments, across):
        beside = region.sinks and any(_is_beside(region, faces) for faces in standing)
        if beside or _is_between_spokes(brep, region, spokes):
            continue
        taken = faces_area(brep, region.faces & (cut | corners if region.sinks else out))
        if not breaks >= region.faces and taken <= TAKEN * faces_area(brep, region.faces):
            part = makers[region.sinks](region, len(found[region.sinks]) + 1)
            found[region.sinks] += [part] if part is not None else []
    return [*found[True], *found[False]]


def _is_on(brep: Brep, ball: int, studs: Collection[int]) -> bool:
    """Does a ball meet nothing but these faces?"""
    beside = {other for _, other in brep.neighbours(ball)}
    return bool(beside) and beside.issubset(studs)


def _is_between_spokes(brep: Brep, region: Region, spokes: Collection[int]) -> bool:
    """Are its faces the sides of two spokes and the hub between? They bound an opening that ends inside a rim."""
    sides = region.faces.intersection(spokes)
    rest = [brep.faces[i] for i in region.faces - sides]
    return len(sides) > 1 and all(face.kind is SurfaceKind.CYLINDER and face.outward > 0 for face in rest)


def _is_beside(region: Region, standing: frozenset[int]) -> bool:
    """Is all of a hollow but one face the outside of one part that stands out? That is the corner beside a tab."""
    return len(region.faces) > 2 and len(region.faces - standing) == 1


@dataclass(frozen=True, slots=True)
class _Maker:
    brep: Brep
    volumes: Volumes
    moments: Moments
    tolerances: Tolerances
    cut: frozenset[int]
    """Faces of known cuts, which may break into a region's rim."""

    def depression(self, region: Region, number: int) -> Part | None:
        """None where it goes around something, so that it has no opening, and where nothing was cut in."""
        normal = self._normal(region)
        if normal is None:
            return None
        frame = _frame(self.brep, region.faces, normal)
        middle = dot(frame.point(0.5, 0.5, 0.5), normal)
        hosts = [(self.brep.edges[e], self._beyond(e, region)) for e in region.border]
        rim = [edge for edge, _ in hosts if dot(edge.mid, normal) > middle]
        is_open = any(h.id not in self.cut and abs(dot(self._looks(h, e), normal)) < ASIDE for e, h in hosts)
        if is_open and self._is_outside(region):
            refuse("depression", region.faces, "it is a flat of a shaft, or lies between sides at obtuse angles")
            return None
        outline = "free" if is_open else self._outline(rim, region, normal)
        floor = [face for face in self._faces(region) if dot(face.facing, normal) > UPRIGHT]
        body = self.brep.faces[min(region.faces)].body
        kind, ids = DepressionKind.DEPRESSION, tuple(face.id for face in floor)
        found = depression_in(kind, outline, frame, region.faces, ids, body, is_open=is_open)
        through = region.opening is None
        part = depression_part(self.brep, replace(found, tags=("through",) if through else ()), number, self.volumes)
        exact = not through and self._is_level(rim, normal)
        bottom = _bottom(floor, normal) if part.bottom is Bottom.FLAT else part.bottom
        return part.model_copy(update={"bottom": bottom, "volume": part.volume if exact else None})

    def elevation(self, region: Region, number: int) -> Part | None:
        """Height along what it goes around, where it is a collar; None where it has no direction."""
        normal = self._normal(region)
        if normal is None:
            return None
        frame = _frame(self.brep, region.faces, normal)
        middle = dot(frame.point(0.5, 0.5, 0.5), normal)
        foot = [edge for edge in map(self.brep.edges.__getitem__, region.border) if dot(edge.mid, normal) < middle]
        length, width, height = frame.size
        found = Protrusion(
            outline=self._outline(foot, region, normal),
            normal=normal,
            base=frame.point(0.5, 0.5, 0.0),
            tip=frame.point(0.5, 0.5, 1.0),
            center=frame.point(0.5, 0.5, 0.5),
            length=length,
            width=width,
            height=height,
            faces=tuple(sorted(region.faces)),
            tags=tags_of(length, width, height),
        )
        part = protrusion_part(self.brep, found, number, self.volumes, PartKind.ELEVATION)
        exact = region.opening is not None and self._is_level(foot, normal)
        return part.model_copy(update={"volume": part.volume if exact else None})

    def _faces(self, region: Region) -> list[FaceRecord]:
        return [self.brep.faces[face] for face in sorted(region.faces)]

    def _is_outside(self, region: Region) -> bool:
        """Do only planes make it that lean back from each other, over fillets too, or the flat of a D shaft?

        None of them is a wall.
        """
        faces = [face for face in self._faces(region) if not is_blend(self.brep, face)]
        if len(faces) < 2 or any(face.kind is not SurfaceKind.PLANE for face in faces):
            return False
        leaning = all(dot(a.axis, b.axis) > LEANS_BACK for a, b in combinations(faces, 2))
        return leaning or (len(faces) == 2 and any(is_d(self.brep, a, b) for a, b in permutations(faces)))

    def _normal(self, region: Region) -> Vector | None:
        """To where does it open or rise? As the largest plane says that looks that way, of its own or beside it."""
        if region.opening is None:
            return self._along(region)
        beside = {face for e in region.border for face in self.brep.edges[e].faces}
        for ids, least in ((region.faces | beside, LEVEL), (region.faces, UPRIGHT)):
            faces = (self.brep.faces[face] for face in sorted(ids))
            planes = [f for f in faces if f.kind is SurfaceKind.PLANE and dot(f.axis, region.opening) > least]
            if planes:
                return max(planes, key=lambda plane: plane.area).axis
        return region.opening

    def _along(self, region: Region) -> Vector | None:
        """The direction that all of its faces run along; None where some stand across it."""
        areas = self.moments.area_m2[sorted(region.faces)]
        sizes = np.maximum(np.linalg.norm(areas, axis=1), 1e-30)
        x, y, z = (float(c) for c in np.linalg.eigh((areas.T / sizes) @ areas)[1][:, 0])
        across = np.abs(areas @ np.array((x, y, z))) > UPRIGHT * sizes
        return None if across.any() else upwards((x, y, z))

    def _beyond(self, edge: int, region: Region) -> FaceRecord:
        faces = self.brep.edges[edge].faces
        return self.brep.faces[next((face for face in faces if face not in region.faces), faces[0])]

    def _looks(self, host: FaceRecord, edge: EdgeRecord) -> Vector:
        """Where to does the face beyond an edge look there? The face behind it, where it is a round."""
        if edge.convexity is EdgeConvexity.SMOOTH:
            links = self.brep.neighbours(host.id)
            smooth = [(e, f) for e, f in links if e.convexity is EdgeConvexity.SMOOTH and e.id != edge.id]
            if smooth:
                edge, behind = max(smooth, key=lambda link: link[0].length)
                host = self.brep.faces[behind]
        return normal_at(host, edge.mid) or host.point_normal

    def _outline(self, rim: Sequence[EdgeRecord], region: Region, normal: Vector) -> str:
        """The name of the outline: of a level rim or foot as it is, else of the section of upright walls."""
        if self._is_level(rim, normal):
            outline, _ = outline_of(self.brep, Loop(tuple(edge.id for edge in rim), outer=True), self.tolerances)
            corners = sum(edge.kind is EdgeKind.LINE for edge in rim)
            return "free" if outline == "polygonal" and corners < 3 else outline
        walls = [face for face in self._faces(region) if abs(dot(face.facing, normal)) < UPRIGHT]
        return section_of(walls) if walls and all(_is_upright(wall, normal) for wall in walls) else "free"

    def _is_level(self, edges: Sequence[EdgeRecord], normal: Vector) -> bool:
        levels = [dot(p, normal) for edge in edges for p in (edge.start, edge.mid)]
        return bool(levels) and max(levels) - min(levels) <= 10 * self.tolerances.length


def _frame(brep: Brep, faces: Collection[int], normal: Vector) -> LocalFrame:
    """The box of the edges, and of the curved faces as far as they reach beyond: the bottom of a bowl."""
    frame = frame_of(brep, faces, normal, None)
    axes = (frame.u, frame.v, frame.n)
    ranges = [[low, low + size] for low, size in zip(frame.low, frame.size, strict=True)]
    for face in (brep.faces[i] for i in faces if brep.faces[i].kind is not SurfaceKind.PLANE):
        for span, axis in zip(ranges, axes, strict=True):
            span[:] = min(span[0], *(reaches := _reaches(face, axis))), max(span[1], *reaches)
    low, size = zip(*((a, b - a) for a, b in ranges), strict=True)
    return LocalFrame(*axes, (low[0], low[1], low[2]), (size[0], size[1], size[2]))


def _reaches(face: FaceRecord, direction: Vector) -> Sequence[float]:
    """Positions along a direction that a curved face has: its ends along an axis of the file, its middle, its poles."""
    for i, c in enumerate(direction):
        if abs(c) > 1 - 1e-9:
            return [c * face.box[0][i], c * face.box[1][i]]
    points = [face.point]
    if face.kind is SurfaceKind.SPHERE:
        points += [add(face.origin, scale(direction, r)) for r in (face.radius, -face.radius)]
    inside = [p for p in points if all(a <= c <= b for a, c, b in zip(face.box[0], p, face.box[1], strict=True))]
    return [dot(p, direction) for p in (face.point, *inside)]


def _bottom(floor: Sequence[FaceRecord], normal: Vector) -> Bottom | None:
    """Which bottom do these faces make? None where it has no name."""
    kinds = {face.kind for face in floor}
    if kinds == {SurfaceKind.PLANE}:
        return Bottom.FLAT if all(dot(face.axis, normal) > 1 - SQUARE for face in floor) else None
    return Bottom.SPHERICAL if kinds == {SurfaceKind.SPHERE} else None


def _is_upright(wall: FaceRecord, normal: Vector) -> bool:
    if wall.kind is SurfaceKind.PLANE:
        return abs(dot(wall.axis, normal)) < SQUARE
    return wall.kind is SurfaceKind.CYLINDER and abs(dot(wall.axis, normal)) > 1 - SQUARE
