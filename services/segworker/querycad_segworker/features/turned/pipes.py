"""Pipes and bars bent along a line: straight lengths and bends that run into each other, one part together."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from querycad_contracts import Bottom, SurfaceKind, Vector
from querycad_segworker.features.holes.hole import Hole
from querycad_segworker.features.shared.axes import Axis, Wall
from querycad_segworker.features.shared.refusals import refuse
from querycad_segworker.tolerances import Tolerances
from querycad_segworker.topology import Brep, EdgeConvexity, EdgeRecord, FaceRecord, linked
from querycad_segworker.vectors import dist

from .bosses import Boss

WHOLE_TURN = math.radians(350.0)
"""The rim of a bend goes around the pipe by this much at least; what goes around less is a rounded edge."""
NEAR = 1e-3
"""Share of its radius by which a rim may differ from the pipe's cross-section."""


@dataclass(frozen=True, slots=True)
class Bend:
    """Part of a torus that a pipe, or its bore, is bent along. Metres, radians. `axis`: what it is bent around."""

    face: int
    axis: Axis
    radius: float
    """Of the pipe's middle line."""
    section: float
    """Radius of the pipe's cross-section."""
    angle: float
    outward: int


@dataclass(frozen=True, slots=True)
class Pipe:
    """One bent pipe or bar. Metres. `inner` is None of a bar, `outer` of a bent bore in a block.

    `length` is that of the middle line, through flanges where the bore goes on in them.
    """

    outer: float | None
    inner: float | None
    length: float
    bends: tuple[Bend, ...]
    """Of the outer surface, or the bore's where there is no other."""
    faces: tuple[int, ...]
    body: int


@dataclass(frozen=True, slots=True)
class _Run:
    """One surface of a pipe: cylinders and bends of one cross-section that follow each other smoothly."""

    bends: tuple[Bend, ...]
    walls: tuple[Wall, ...]

    @property
    def faces(self) -> tuple[int, ...]:
        return tuple(sorted({*(b.face for b in self.bends), *(face for wall in self.walls for face in wall.faces)}))

    @property
    def length(self) -> float:
        return sum(b.radius * b.angle for b in self.bends) + sum(wall.height for wall in self.walls)


def recognise_pipes(brep: Brep, walls: Sequence[Wall], tolerances: Tolerances) -> list[Pipe]:
    """Which bent pipes, bars and bores does the model have? Sorted by lowest face id.

    A bend is a part of a torus whose rims go all around its cross-section; a pipe is an outer run of bends and
    cylinders with a bore that is bent around the same axes. Straight tubes are bosses.
    """
    runs = list(_runs(brep, walls, tolerances))
    outer = [run for run in runs if run.bends[0].outward > 0]
    bores = [run for run in runs if run.bends[0].outward < 0]
    found = []
    for run in outer:
        bore = next((bore for bore in bores if _goes_along(bore, run, tolerances)), None)
        bores = [other for other in bores if other is not bore]
        found.append(_pipe(brep, run, bore))
    found += [_pipe(brep, None, bore) for bore in bores]
    return sorted(found, key=lambda pipe: pipe.faces[0])


def _pipe(brep: Brep, outer: _Run | None, bore: _Run | None) -> Pipe:
    runs = [run for run in (outer, bore) if run is not None]
    return Pipe(
        outer=None if outer is None else outer.bends[0].section,
        inner=None if bore is None else bore.bends[0].section,
        length=max(run.length for run in runs),
        bends=runs[0].bends,
        faces=tuple(sorted({face for run in runs for face in run.faces})),
        body=brep.faces[runs[0].faces[0]].body,
    )


def _goes_along(bore: _Run, outer: _Run, tolerances: Tolerances) -> bool:
    """Is every bend of the bore one of the outer surface, too?"""
    return all(
        any(
            a.section < b.section
            and dist(a.axis.origin, b.axis.origin) <= 3 * tolerances.length
            and a.axis.same_line(b.axis, tolerances)
            and abs(a.radius - b.radius) <= 3 * tolerances.length
            for b in outer.bends
        )
        for a in bore.bends
    )


def _runs(brep: Brep, walls: Sequence[Wall], tolerances: Tolerances) -> Iterator[_Run]:
    bends = {face.id: bend for face in brep.faces if (bend := _bend(brep, face)) is not None}
    wall_of = {face: i for i, wall in enumerate(walls) if wall.kind is SurfaceKind.CYLINDER for face in wall.faces}
    pairs: list[tuple[int, int]] = []
    beside: dict[int, set[int]] = defaultdict(set)
    for bend in bends.values():
        for edge, other in brep.neighbours(bend.face):
            if edge.convexity is not EdgeConvexity.SMOOTH or not _is_rim(edge, bend):
                continue
            if other in bends and abs(bends[other].section - bend.section) <= 3 * tolerances.length:
                pairs.append((bend.face, other))
            elif other in wall_of and abs(walls[wall_of[other]].radius - bend.section) <= 3 * tolerances.length:
                beside[wall_of[other]].add(bend.face)
    for members in beside.values():  # a straight length between two bends
        pairs += pairwise(members)
    for group in linked(bends, pairs):
        straight = sorted(i for i, members in beside.items() if not members.isdisjoint(group))
        yield _Run(tuple(bends[face] for face in group), tuple(walls[i] for i in straight))


def _bend(brep: Brep, face: FaceRecord) -> Bend | None:
    """Is the face a pipe's bend? Part of a torus that is bounded by whole cross-sections."""
    if face.kind is not SurfaceKind.TORUS or face.sweep > WHOLE_TURN or face.minor_radius >= face.radius:
        return None
    bend = Bend(face.id, Axis.of(face), face.radius, face.minor_radius, face.sweep, face.outward)
    turns: dict[Vector, float] = defaultdict(float)
    for e in set(brep.face_edges[face.id]):
        edge = brep.edges[e]
        if _is_rim(edge, bend) and edge.center is not None:
            near = (known for known in turns if dist(known, edge.center) <= NEAR * bend.section)
            turns[next(near, edge.center)] += edge.length / bend.section
    if max(turns.values(), default=0.0) < WHOLE_TURN:
        if turns and len(brep.neighbours(face.id)) > 1:
            refuse("pipe", (face.id,), "its rim does not go all around: a rounded edge")
        return None
    return bend


def _is_rim(edge: EdgeRecord, bend: Bend) -> bool:
    """Is the edge part of the pipe's cross-section, around its middle line?"""
    if edge.center is None or edge.radius is None or abs(edge.radius - bend.section) > NEAR * bend.section:
        return False
    level = abs(bend.axis.position(edge.center)) <= NEAR * bend.radius
    return level and abs(bend.axis.radius_of(edge.center) - bend.radius) <= NEAR * bend.radius


def bent_measures(pipe: Pipe) -> dict[str, object]:
    """Which radius, along the middle line, do all bends of a pipe share; which angle, in radians, has its only one?"""
    radii = [bend.radius for bend in pipe.bends]
    measures: dict[str, object] = {}
    if max(radii) - min(radii) <= NEAR * max(radii):
        measures["bend_radius"] = radii[0]
    if len(pipe.bends) == 1:
        measures["bend_angle"] = pipe.bends[0].angle
    return measures


def ending_in_bends(holes: Sequence[Hole], pipes: Sequence[Pipe]) -> list[Hole]:
    """The same holes; one that runs on into the bend of a bore has no bottom there."""
    bores = {face for pipe in pipes if pipe.inner is not None for face in pipe.faces}
    return [
        _opened(hole) if hole.bottom is Bottom.FLAT and not bores.isdisjoint(hole.faces) else hole for hole in holes
    ]


def beside_pipes(brep: Brep, bosses: Sequence[Boss], pipes: Sequence[Pipe]) -> list[Boss]:
    """Without those that are straight lengths of a pipe."""
    own = {face for pipe in pipes if pipe.outer is not None for face in pipe.faces}

    def walls(boss: Boss) -> list[int]:
        return [face for face in boss.faces if brep.faces[face].kind is SurfaceKind.CYLINDER]

    return [boss for boss in bosses if not walls(boss) or not own.issuperset(walls(boss))]


def _opened(hole: Hole) -> Hole:
    far = tuple(c - n * hole.depth for c, n in zip(hole.opening, hole.normal, strict=True))
    tags = tuple("cross" if tag == "blind" else tag for tag in hole.tags)
    return replace(hole, bottom=Bottom.BORE, far_opening=(far[0], far[1], far[2]), tags=tags)
