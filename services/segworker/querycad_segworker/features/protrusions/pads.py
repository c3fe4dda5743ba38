"""What rises from a face as far as its border, so that some of its sides are flush with the body's: pads and ledges."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from querycad_contracts import SurfaceKind, Vector
from querycad_segworker.features.shared.frames import LocalFrame, frame_of_points, outline_of
from querycad_segworker.features.shared.refusals import refuse
from querycad_segworker.features.shared.regular import is_d
from querycad_segworker.tolerances import FACING, Tolerances
from querycad_segworker.topology import Brep, EdgeConvexity, EdgeKind, EdgeRecord, FaceRecord
from querycad_segworker.vectors import add, box_extents, box_of, dot, scale, sub, unit

from .protrusions import AS_LARGE, Protrusion, tags_of

SQUARE = 1e-2
"""Sine of the angle by which the foot edges of one piece may run apart, and its sides deviate from upright."""
LEAN = math.cos(math.radians(44.0))
"""The sides of a piece lean out by less than 46 degrees: dovetails have flanks at 45 to 60 (DIN 1833 cutters)."""
DRAFT = math.sin(math.radians(10.0))
"""They lean back by no more than a draft: what rises behind a slope is the plate that a gusset stands on."""
BEHIND = 0.9
"""The share of its foot behind which a piece lies: what goes around the face is the body, and the face a floor."""
MINOR = 0.5
"""A piece whose box fills more than this share of its body's box is the body."""
RIVAL = 2.0
"""Of the two pieces that meet at one edge, one that is so many times larger is what the other stands on."""


MANY = 100
"""A piece of more faces is a part with parts of its own."""
_Foot: TypeAlias = tuple[EdgeRecord, FaceRecord, int | None]
"""An edge at which something rises from a level, the plane wall there, and the fillet between."""


@dataclass(frozen=True, slots=True)
class _Piece:
    """What lies on the outer side of a level, connected there. `feet`: the edges it stands on, each with its wall."""

    normal: Vector
    hosts: frozenset[int]
    feet: tuple[tuple[EdgeRecord, FaceRecord], ...]
    fillets: frozenset[int]
    faces: frozenset[int]
    flush: frozenset[int]
    """Those of its faces that run on below the level."""
    frame: LocalFrame

    @property
    def room(self) -> float:
        """The volume of its box, m3."""
        return math.prod(self.frame.size)

    @property
    def sides(self) -> int:
        """To how many sides does it stand out, as its walls look?"""
        looks: list[Vector] = []
        for _, wall in self.feet:
            if all(dot(wall.axis, look) < FACING.alike for look in looks):
                looks.append(wall.axis)
        return len(looks)


def recognise_pads(
    brep: Brep, known: Collection[int], tolerances: Tolerances
) -> tuple[list[Protrusion], list[Protrusion]]:
    """Which pieces reach as far as the border of the face they stand on: pads, and ledges? By lowest face id.

    A piece is all that lies beyond the plane of a face, connected there, behind the straight edges at which it rises.
    A pad rises at two or more sides to a level top, which is smaller than what is left of the face beside it. A ledge
    rises at one, leans, or is larger: the leg of an angle, a lip, the nose of a hook, what steps on both sides leave.
    `known`: faces of protrusions that stand within a face, and the tops of ribs.
    """
    pieces = [piece for level in _levels(brep, tolerances) for piece in _pieces(brep, level, tolerances)]
    pieces = [piece for piece in pieces if piece.flush and _is_apart(piece, known) and not _is_d(brep, piece)]
    pads: list[_Piece] = []
    ledges: list[_Piece] = []
    for piece in pieces:
        if piece.sides > 1 and _rises_to_a_top(brep, piece) and _is_smaller(brep, piece):
            pads.append(piece)
        elif not _is_the_body(brep, piece) and not _outdone(piece, pieces):
            ledges.append(piece)
        elif piece.sides > 1:
            reason = "larger than what is left beside it: the body, with steps cut beside it"
            refuse("protrusion", piece.faces - piece.flush, reason)
    made = ([_protrusion(brep, piece, tolerances) for piece in own] for own in (pads, ledges))
    pad_records, ledge_records = (sorted(records, key=lambda record: record.faces) for records in made)
    return pad_records, ledge_records


def _is_apart(piece: _Piece, known: Collection[int]) -> bool:
    """Is none of its own faces known?"""
    return not (piece.faces - piece.flush).intersection(known)


def _is_d(brep: Brep, piece: _Piece) -> bool:
    """Is it what a flat leaves of a round shaft, beside the shoulder that the flat ends at?"""
    return all(is_d(brep, wall, brep.faces[host]) for _, wall in piece.feet for host in piece.hosts)


def _levels(brep: Brep, tolerances: Tolerances) -> Iterator[list[FaceRecord]]:
    """Plane faces of one body in one plane that look one way."""
    near = 10 * tolerances.length
    levels: dict[tuple[object, ...], list[list[FaceRecord]]] = defaultdict(list)
    for face in brep.of_kind(SurfaceKind.PLANE, range(len(brep.faces))):
        height = dot(face.point, face.axis)
        alike = levels[(face.body, *(round(c, 3) for c in face.axis), round(height / (100 * near)))]
        for level in alike:
            first = level[0]
            if dot(first.axis, face.axis) > 1 - 1e-6 and abs(dot(first.point, first.axis) - height) <= near:
                level.append(face)
                break
        else:
            alike.append([face])
    for own in levels.values():
        yield from own


def _pieces(brep: Brep, level: Sequence[FaceRecord], tolerances: Tolerances) -> Iterator[_Piece]:
    """What stands on one level, each connected piece once."""
    feet = [foot for host in level for foot in _feet(brep, host)]
    if not feet:
        return
    side = _Beyond(brep, level, 10 * tolerances.length)
    while feet:
        faces, edges = side.connected(feet[0])
        own = [foot for foot in feet if foot is feet[0] or foot[1].id in faces]
        feet = [foot for foot in feet if foot not in own]
        piece = _piece(side, own, faces, edges) if len(faces) <= MANY else None
        if piece is not None:
            yield piece


class _Beyond:
    """The outer side of one level."""

    def __init__(self, brep: Brep, level: Sequence[FaceRecord], near: float) -> None:
        self.brep, self.near = brep, near
        self.hosts = frozenset(face.id for face in level)
        self.normal = level[0].axis
        self.level = dot(level[0].point, self.normal)
        self._lows, self._highs = brep.edge_reach(self.normal)
        self._flush: dict[int, bool] = {}
        self._known: dict[int, tuple[list[int], NDArray[np.float64]]] = {}

    def height(self, point: Vector) -> float:
        """How far out of the level does a point lie, in metres?"""
        return dot(point, self.normal) - self.level

    def is_flush(self, face: int) -> bool:
        """Does the face run on below the level?"""
        if face not in self._flush:
            self._flush[face] = any(self._lows[e] < self.level - self.near for e in self.brep.face_edges[face])
        return self._flush[face]

    def connected(self, foot: _Foot) -> tuple[frozenset[int], frozenset[int]]:
        """The faces and edges that one comes to from a foot, beyond the level; some, where they are too many.

        Within a face that runs on below the level one comes no farther than along the edges beyond it.
        """
        edge, wall, fillet = foot
        faces = {wall.id} if fillet is None else {wall.id, fillet}
        edges = {e for face in faces for e in self._onwards(face, edge)}
        todo = list(edges)
        whole = {face for face in faces if not self.is_flush(face)}
        while todo and len(faces) <= MANY:
            at = self.brep.edges[todo.pop()]
            for face in set(at.faces) - self.hosts - whole:
                faces.add(face)
                if not self.is_flush(face):
                    whole.add(face)
                new = self._onwards(face, at) - edges
                edges |= new
                todo.extend(new)
        return frozenset(faces), frozenset(edges)

    def _reaching(self, face: int) -> tuple[list[int], NDArray[np.float64]]:
        """The edges of a face that reach beyond the level, and their ends, (n, 2, 3)."""
        if face not in self._known:
            own = [e for e in self.brep.face_edges[face] if self._highs[e] > self.level + self.near]
            edges = (self.brep.edges[e] for e in own)
            self._known[face] = own, np.array([(edge.start, edge.end) for edge in edges]).reshape(-1, 2, 3)
        return self._known[face]

    def _onwards(self, face: int, edge: EdgeRecord) -> set[int]:
        """The edges of a face beyond the level that one comes to from one of its edges."""
        own, ends = self._reaching(face)
        if self.is_flush(face):
            points = [p for p in (edge.start, edge.end) if self.height(p) > -self.near]
            apart = [np.linalg.norm(ends - np.array(point), axis=2).min(axis=1, initial=math.inf) for point in points]
            own = [e for e, *gaps in zip(own, *apart, strict=True) if gaps and min(gaps) <= self.near]
        return set(own) - {edge.id}


def _feet(brep: Brep, host: FaceRecord) -> Iterator[_Foot]:
    """The straight edges of the outline at which something rises, the plane wall there, and the fillet between."""
    outline = {e for loop in host.loops if loop.outer for e in loop.edges}
    for edge, other in brep.neighbours(host.id):
        if edge.id not in outline or edge.kind is not EdgeKind.LINE:
            continue
        wall = brep.faces[other]
        if edge.convexity is EdgeConvexity.CONCAVE:
            if wall.kind is SurfaceKind.PLANE and -LEAN < dot(wall.axis, host.axis) < DRAFT:
                yield edge, wall, None
        elif edge.convexity is EdgeConvexity.SMOOTH and wall.kind is SurfaceKind.CYLINDER and wall.outward < 0:
            for beyond in map(brep.faces.__getitem__, brep.beside(other, EdgeConvexity.SMOOTH)):
                plane = beyond.id != host.id and beyond.kind is SurfaceKind.PLANE
                if plane and -LEAN < dot(beyond.axis, host.axis) < DRAFT:
                    yield edge, beyond, other


def _piece(side: _Beyond, feet: Sequence[_Foot], faces: frozenset[int], edges: frozenset[int]) -> _Piece | None:
    """The piece on these feet; None where it does not lie behind them, has no height, or is a void."""
    fillets = frozenset(fillet for _, _, fillet in feet if fillet is not None)
    flush = frozenset(face for face in faces if side.is_flush(face))
    if not faces - flush - fillets:
        return None
    own = edges - side.brep.edges_of(fillets) | side.brep.edges_of(faces - flush - fillets)
    frame = _frame(side, own, max((edge for edge, _, _ in feet), key=lambda edge: edge.length))
    if min(frame.size) <= side.near:
        return None
    middle = frame.point(0.5, 0.5, 0.5)
    whole = sum(edge.length for edge, _, _ in feet)
    behind = sum(edge.length for edge, wall, _ in feet if dot(sub(middle, wall.point), wall.axis) < 0)
    if behind < BEHIND * whole or _is_void(side, faces, frame.size[2]):
        return None
    walls = tuple((edge, wall) for edge, wall, _ in feet)
    return _Piece(side.normal, side.hosts, walls, fillets, faces, flush, frame)


def _is_void(side: _Beyond, faces: Collection[int], height: float) -> bool:
    """Does what lies beyond the level end at walls that look back at it? It is the room of a pocket, not material."""
    planes = side.brep.of_kind(SurfaceKind.PLANE, sorted(faces))
    looks = [dot(face.axis, side.normal) for face in planes if side.height(face.point) > height - side.near]
    return min(looks, default=0.0) < -FACING.parallel and max(looks) < FACING.parallel


def _frame(side: _Beyond, edges: Collection[int], foot: EdgeRecord) -> LocalFrame:
    """The box of what lies beyond the level, as wide as it is above the fillets at its foot."""
    normal = side.normal
    along = unit(sub(foot.direction, scale(normal, dot(foot.direction, normal))))
    box = frame_of_points(list(_above(side, edges)), normal, along)
    low, size = (*box.low[:2], side.level), (*box.size[:2], box.low[2] + box.size[2] - side.level)
    return LocalFrame(box.u, box.v, normal, low, size)


def _above(side: _Beyond, edges: Collection[int]) -> Iterator[Vector]:
    """Which points span the edges beyond the level? Where an edge crosses it, the point there."""
    for e in edges:
        edge = side.brep.edges[e]
        for a, b in pairwise(side.brep.edge_points[e] if edge.closed else edge.points):
            at_a, at_b = side.height(a), side.height(b)
            if max(at_a, at_b) > side.near:
                crossing = add(a, scale(sub(b, a), at_a / (at_a - at_b))) if at_a * at_b < 0 else a
                yield a if at_a >= 0 else crossing
                yield b if at_b >= 0 else crossing


def _rises_to_a_top(brep: Brep, piece: _Piece) -> bool:
    """Does a level plane lie at its full height? The lower wall of a window in it is none."""
    foot = dot(piece.frame.point(0.0, 0.0, 0.0), piece.normal)
    return any(dot(top.point, piece.normal) - foot > AS_LARGE * piece.frame.size[2] for top in _tops(brep, piece))


def _is_smaller(brep: Brep, piece: _Piece) -> bool:
    """Is its top smaller than what is left beside it?"""
    top = max(face.area for face in _tops(brep, piece))
    return top < sum(brep.faces[f].area for f in piece.hosts)


def _is_the_body(brep: Brep, piece: _Piece) -> bool:
    body = brep.bodies[brep.faces[min(piece.faces)].body]
    points = [p for face in body.faces for p in brep.faces[face].box]
    box = box_of(points)
    return box is not None and piece.room > MINOR * math.prod(box_extents(box))


def _outdone(piece: _Piece, pieces: Sequence[_Piece]) -> bool:
    """Does a much smaller piece stand on it, at one of its own feet?"""
    edges = {edge.id for edge, _ in piece.feet}
    for other in pieces:
        meets = edges.intersection(edge.id for edge, _ in other.feet) or piece.fillets & other.fillets
        if other is not piece and meets and piece.room > RIVAL * other.room:
            return True
    return False


def _protrusion(brep: Brep, piece: _Piece, tolerances: Tolerances) -> Protrusion:
    length, width, height = piece.frame.size
    own = piece.faces - piece.flush
    return Protrusion(
        outline=_outline(brep, piece, tolerances),
        normal=piece.normal,
        base=piece.frame.point(0.5, 0.5, 0.0),
        tip=piece.frame.point(0.5, 0.5, 1.0),
        center=piece.frame.point(0.5, 0.5, 0.5),
        length=length,
        width=width,
        height=height,
        faces=tuple(sorted(own)),
        feet=tuple(sorted({wall.id for _, wall in piece.feet})),
        tags=tags_of(length, width, height),
    )


def _outline(brep: Brep, piece: _Piece, tolerances: Tolerances) -> str:
    """The name of the outline of its largest level top; 'free' where it has none."""
    tops = _tops(brep, piece)
    return outline_of(brep, max(tops, key=lambda top: top.area).loops[0], tolerances)[0] if tops else "free"


def _tops(brep: Brep, piece: _Piece) -> list[FaceRecord]:
    own = brep.of_kind(SurfaceKind.PLANE, sorted(piece.faces - piece.flush))
    return [face for face in own if dot(face.axis, piece.normal) > 1 - SQUARE and face.loops]
