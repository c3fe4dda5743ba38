"""Faces that a CAD system or a converter split become one again, so that recognition sees features and not pieces."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

from querycad_contracts import SurfaceKind, Vector
from querycad_segworker.tolerances import Tolerances
from querycad_segworker.topology import (
    Brep,
    EdgeConvexity,
    EdgeKind,
    EdgeRecord,
    FaceRecord,
    Loop,
    linked,
    together,
)
from querycad_segworker.vectors import add, box_union, cross, dist, dot, mid, parallel, scale, sub

from .axes import Axis
from .coaxial_stacks import winding
from .walls import REVOLVED, same_surface


@dataclass(frozen=True, slots=True)
class United:
    """A B-rep whose split faces are one, and which faces of the file each of its faces is made of."""

    brep: Brep
    members: tuple[tuple[int, ...], ...]

    def faces_of_file(self, faces: Iterable[int]) -> tuple[int, ...]:
        """Which faces of the file are these?"""
        return tuple(sorted(i for face in faces for i in self.members[face]))

    @property
    def owner(self) -> list[int]:
        """Of each face of the file: the face here that it is part of."""
        owners = {i: face for face, pieces in enumerate(self.members) for i in pieces}
        return [owners[i] for i in range(len(owners))]


def united(brep: Brep, tolerances: Tolerances) -> United | None:
    """The B-rep with pieces of one surface that meet smoothly made one face; None where nothing is split.

    Edges between two such pieces are gone; edges that follow each other on one line or circle between the same two
    faces are one edge.
    """
    pairs = []
    for edge in brep.edges:
        if edge.convexity is EdgeConvexity.SMOOTH and len(edge.faces) == 2:
            a, b = (brep.faces[i] for i in edge.faces)
            if a.id != b.id and _is_one(a, b, tolerances):
                pairs.append((a.id, b.id))
    if not pairs:
        return None
    pieces = linked((face.id for face in brep.faces), pairs)
    owner = {i: new for new, ids in enumerate(pieces) for i in ids}
    edges, loops_edges = _edges(brep, owner, tolerances)
    faces: list[FaceRecord] = []
    for new, ids in enumerate(pieces):
        members = [brep.faces[i] for i in ids]
        faces.append(_face(members, new, edges, loops_edges, tolerances))
    bodies = [replace(one, faces=tuple(sorted({owner[i] for i in one.faces}))) for one in brep.bodies]
    made = Brep(brep.name, tuple(faces), tuple(edges), tuple(bodies), brep.warnings)
    return United(made, tuple(tuple(ids) for ids in pieces))


def _is_one(a: FaceRecord, b: FaceRecord, tolerances: Tolerances) -> bool:
    """Are both pieces of one plane, cylinder, cone, torus or sphere?"""
    if a.kind is not b.kind or a.body != b.body or a.outward != b.outward:
        return False
    if a.kind in REVOLVED:
        return same_surface(a, b, tolerances)
    near = 3 * tolerances.length
    if a.kind is SurfaceKind.SPHERE:
        return dist(a.origin, b.origin) <= near and abs(a.radius - b.radius) <= near
    level = abs(dot(sub(b.point, a.point), a.axis)) <= near
    return a.kind is SurfaceKind.PLANE and level and parallel(a.axis, b.axis, 3 * tolerances.angle)


def _edges(brep: Brep, owner: dict[int, int], tolerances: Tolerances) -> tuple[list[EdgeRecord], dict[int, int]]:
    """The edges that are left, numbered anew, and for each old id the new one.

    Those inside a plane are gone; those inside another face are seams, as where a kernel closes such a face by itself.
    """
    between: dict[tuple[object, ...], list[EdgeRecord]] = defaultdict(list)
    alone: list[list[EdgeRecord]] = []
    for edge in brep.edges:
        faces = tuple(sorted({owner[i] for i in edge.faces}))
        if len(faces) < len(edge.faces):
            if brep.faces[edge.faces[0]].kind is not SurfaceKind.PLANE:
                alone.append([replace(edge, convexity=EdgeConvexity.SEAM, faces=edge.faces[:1])])
        elif edge.kind is EdgeKind.OTHER or edge.closed or len(faces) != 2:
            alone.append([edge])
        else:
            between[(faces, edge.kind, edge.convexity)].append(edge)
    chains = alone + [chain for alike in between.values() for chain in _chains(alike, tolerances)]
    chains.sort(key=lambda chain: min(edge.id for edge in chain))
    renumbered, edges = {}, []
    for new, chain in enumerate(chains):
        renumbered.update({edge.id: new for edge in chain})
        whole = chain[0] if len(chain) == 1 else _joined(chain)
        edges.append(replace(whole, id=new, faces=tuple(owner[i] for i in whole.faces)))
    return edges, renumbered


def _chains(edges: Sequence[EdgeRecord], tolerances: Tolerances) -> Iterator[list[EdgeRecord]]:
    """Edges between the same two faces, those that follow each other on one line or circle together and in order."""
    left = list(edges)
    while left:
        chain = [left.pop(0)]
        grown = True
        while grown:
            grown = False
            for other in left:
                if not _same_curve(chain[0], other, tolerances):
                    continue
                at_end = _meet(chain[-1], other, tolerances)
                if at_end or _meet(chain[0], other, tolerances):
                    chain.insert(len(chain) if at_end else 0, other)
                    left.remove(other)
                    grown = True
                    break
        yield chain


def _meet(a: EdgeRecord, b: EdgeRecord, tolerances: Tolerances) -> bool:
    return min(dist(p, q) for p in (a.start, a.end) for q in (b.start, b.end)) <= tolerances.length


def _same_curve(a: EdgeRecord, b: EdgeRecord, tolerances: Tolerances) -> bool:
    near = 3 * tolerances.length
    if a.kind is EdgeKind.LINE:
        return parallel(a.direction, b.direction, 10 * tolerances.angle)
    if a.center is None or b.center is None or a.radius is None or b.radius is None:
        return False
    return dist(a.center, b.center) <= near and abs(a.radius - b.radius) <= near


def _joined(chain: Sequence[EdgeRecord]) -> EdgeRecord:
    """One edge from a chain of them on one line or circle."""
    first, last = chain[0], chain[-1]
    ends = [(p, q) for p in (first.start, first.end) for q in (last.start, last.end)]
    start, end = max(ends, key=lambda pair: dist(*pair))
    if len(chain) > 2 or first.kind is EdgeKind.CIRCLE:  # of arcs the ends that do not meet the next one
        start = _outer_end(first, chain[1])
        end = _outer_end(last, chain[-2])
    length = sum(edge.length for edge in chain)
    longest = max(chain, key=lambda edge: edge.length)
    whole = replace(first, start=start, end=end, mid=mid(start, end), length=length, angle=longest.angle)
    if first.kind is EdgeKind.LINE or first.center is None or first.axis is None or not first.radius:
        return whole
    turn = length / first.radius
    arm, ahead = sub(start, first.center), sub(first.mid, first.center)
    way = math.copysign(1.0, dot(cross(arm, ahead), first.axis))
    middle = add(first.center, _turned(arm, first.axis, way * turn / 2))
    closed = turn > 2 * math.pi - 1e-3
    return replace(whole, mid=middle, closed=closed, end=start if closed else end)


def _outer_end(edge: EdgeRecord, following: EdgeRecord) -> Vector:
    """The end of an edge that is further from the next one."""

    def gap(point: Vector) -> float:
        return min(dist(point, following.start), dist(point, following.end))

    return max((edge.start, edge.end), key=gap)


def _face(
    pieces: Sequence[FaceRecord],
    new: int,
    edges: Sequence[EdgeRecord],
    renumbered: dict[int, int],
    tolerances: Tolerances,
) -> FaceRecord:
    if len(pieces) == 1:
        face = pieces[0]
        same = tuple(Loop(_renumbered(loop.edges, renumbered), loop.outer) for loop in face.loops)
        return replace(face, id=new, loops=same)
    ids = list(_renumbered([e for face in pieces for loop in face.loops for e in loop.edges], renumbered))
    largest = max(pieces, key=lambda face: face.area)
    box = box_union(face.box for face in pieces)
    assert box is not None
    own = [edges[e] for e in ids]
    loops = _loops(largest, own, tolerances)
    outline = [edges[e] for e in loops[0].edges] if loops else []
    point, normal, sweep = _middle(pieces, outline or own)
    return replace(
        largest,
        id=new,
        point=point,
        point_normal=normal,
        area=sum(face.area for face in pieces),
        moments=together([face.moments for face in pieces]),
        box=box,
        loops=loops,
        sweep=sweep,
        radius=max(face.radius for face in pieces),
        minor_radius=min(face.minor_radius for face in pieces),
    )


def _middle(pieces: Sequence[FaceRecord], outline: Sequence[EdgeRecord]) -> tuple[Vector, Vector, float]:
    """A point near the middle of all pieces, the outward normal there, and the angle they cover about their axis.

    `outline`: their outer boundary. On a plane the middle is that of its edges by their lengths.
    """
    largest = max(pieces, key=lambda face: face.area)
    if largest.kind is SurfaceKind.PLANE:
        length = sum(edge.length for edge in outline)
        points = [scale(e.center if e.closed and e.center else e.mid, e.length / length) for e in outline]
        return (sum(p[0] for p in points), sum(p[1] for p in points), sum(p[2] for p in points)), largest.axis, 0.0
    if largest.kind not in REVOLVED:
        return largest.point, largest.point_normal, max(piece.sweep for piece in pieces)
    axis = Axis.of(largest)
    middle, sweep = _covered([(axis.angle_of(piece.point), piece.sweep) for piece in pieces])
    turn = middle - axis.angle_of(largest.point)
    foot = axis.foot(largest.point)
    if largest.kind is SurfaceKind.CYLINDER:
        ends = [axis.position(p) for edge in outline for p in edge.points]
        middle_foot = axis.at((min(ends) + max(ends)) / 2) if ends else foot
    else:
        middle_foot = foot
    arm = _turned(sub(largest.point, foot), axis.direction, turn)
    return add(middle_foot, arm), _turned(largest.point_normal, axis.direction, turn), sweep


def _covered(ranges: Sequence[tuple[float, float]]) -> tuple[float, float]:
    """The middle of what angular ranges, each by middle and width, cover together, and how much that is. Radians."""
    full = 2 * math.pi
    spans = sorted(((middle - width / 2) % full, width) for middle, width in ranges)
    start, reach = spans[0][0], spans[0][0]
    gap, after, covered = 0.0, spans[0][0], 0.0
    for low, width in spans:
        if low > reach and low - reach > gap:
            gap, after = low - reach, low
        covered += max(0.0, low + width - max(low, reach))
        reach = max(reach, low + width)
    last = start + full - reach
    covered = min(full, covered + min(0.0, last))
    if last >= gap:
        gap, after = max(last, 0.0), start
    return after + (full - gap) / 2, covered


def _turned(v: Vector, axis: Vector, angle: float) -> Vector:
    """The vector turned about the unit vector `axis` (Rodrigues)."""
    along = scale(axis, dot(v, axis))
    flat = sub(v, along)
    return add(along, add(scale(flat, math.cos(angle)), scale(cross(axis, flat), math.sin(angle))))


def _renumbered(ids: Iterable[int], renumbered: dict[int, int]) -> tuple[int, ...]:
    """The new ids, each once, in order; edges that are gone left out."""
    return tuple(dict.fromkeys(renumbered[e] for e in ids if e in renumbered))


def _loops(face: FaceRecord, edges: Sequence[EdgeRecord], tolerances: Tolerances) -> tuple[Loop, ...]:
    """The boundaries of a united face, the outer one first.

    A plane's outer one is the largest. On a face that turns about an axis all that go around it are one outer boundary,
    as they are where a seam joins them.
    """
    seams = [edge.id for edge in edges if edge.convexity is EdgeConvexity.SEAM]
    chains = _closed_chains([edge for edge in edges if edge.convexity is not EdgeConvexity.SEAM], tolerances)
    if face.kind is SurfaceKind.PLANE or face.kind not in REVOLVED:
        chains.sort(key=_size, reverse=True)
        outer, inner = chains[:1], chains[1:]
    else:
        axis = Axis.of(face)
        around = [_winds(face, axis, chain) for chain in chains]
        outer = [chain for chain, goes in zip(chains, around, strict=True) if goes]
        inner = [chain for chain, goes in zip(chains, around, strict=True) if not goes]
        if not outer:
            inner.sort(key=_size, reverse=True)
            outer, inner = inner[:1], inner[1:]
    first = [edge.id for chain in outer for edge in chain] + seams
    return (
        *((Loop(tuple(first), True),) if first else ()),
        *(Loop(tuple(edge.id for edge in chain), False) for chain in inner),
    )


def _winds(face: FaceRecord, axis: Axis, chain: Sequence[EdgeRecord]) -> bool:
    """Does a boundary go around the axis, or around the tube of a torus?"""
    if sum(winding(axis, edge) for edge in chain) > math.radians(350):
        return True
    if face.kind is not SurfaceKind.TORUS:
        return False
    near = 1e-3 * face.radius
    rims = [e for e in chain if e.center is not None and abs(axis.radius_of(e.center) - face.radius) <= near]
    rims = [e for e in rims if e.radius is not None and abs(e.radius - face.minor_radius) <= near]
    return sum(edge.length for edge in rims) > math.radians(350) * face.minor_radius


def _size(chain: Sequence[EdgeRecord]) -> float:
    points = [p for edge in chain for p in edge.points]
    points += [add(e.center, scale(sub(e.mid, e.center), -1.0)) for e in chain if e.closed and e.center is not None]
    return sum((max(p[i] for p in points) - min(p[i] for p in points)) ** 2 for i in range(3))


def _closed_chains(edges: Sequence[EdgeRecord], tolerances: Tolerances) -> list[list[EdgeRecord]]:
    """Edges that follow each other end to end, in order."""
    at = _Corners(tolerances.length)
    meeting: dict[int, list[EdgeRecord]] = defaultdict(list)
    for edge in edges:
        for corner in {at.number(edge.start), at.number(edge.end)}:
            meeting[corner].append(edge)
    chains, seen = [], set[int]()
    for first in edges:
        if first.id in seen:
            continue
        chain, corner = [first], at.number(first.end)
        seen.add(first.id)
        while (following := next((e for e in meeting[corner] if e.id not in seen), None)) is not None:
            seen.add(following.id)
            chain.append(following)
            ends = (at.number(following.start), at.number(following.end))
            corner = ends[1] if ends[0] == corner else ends[0]
        chains.append(chain)
    return chains


class _Corners:
    """Numbers for points: those nearer than a tolerance share one."""

    def __init__(self, near: float) -> None:
        self._near = max(near, 1e-12)
        self._cells: dict[tuple[int, int, int], list[tuple[Vector, int]]] = defaultdict(list)
        self._count = 0

    def number(self, point: Vector) -> int:
        """Which number has this point?"""
        x, y, z = (math.floor(c / self._near) for c in point)
        around = ((x + i, y + j, z + k) for i in (-1, 0, 1) for j in (-1, 0, 1) for k in (-1, 0, 1))
        known = [entry for cell in around if cell in self._cells for entry in self._cells[cell]]
        best = min(known, key=lambda entry: dist(entry[0], point), default=None)
        if best is not None and dist(best[0], point) <= self._near:
            return best[1]
        self._count += 1
        self._cells[(x, y, z)].append((point, self._count))
        return self._count
