"""The B-rep as recognition sees it: faces, edges and bodies with canonical geometry, free of the kernel.

Metres and radians; frame of the file. Face ids are positions in file order, edge ids positions in `Brep.edges`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from functools import cached_property
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from querycad_contracts import Convexity, Matrix, SurfaceKind, Vector

from .vectors import Box, add, around, box_union, cross, scale, sub, unit

REVOLVED = (SurfaceKind.CYLINDER, SurfaceKind.CONE, SurfaceKind.TORUS)
"""Surfaces that turn about an axis."""


class EdgeKind(StrEnum):
    """The canonical form of an edge's curve."""

    LINE = "line"
    CIRCLE = "circle"
    OTHER = "other"


class EdgeConvexity(StrEnum):
    """How two faces meet along an edge, seen from outside the material."""

    CONVEX = "convex"
    CONCAVE = "concave"
    SMOOTH = "smooth"
    FREE = "free"
    SEAM = "seam"


@dataclass(frozen=True, slots=True)
class EdgeRecord:
    """One edge. `faces` holds the ids of the faces that meet in it: two as a rule, one for a free or seam edge."""

    id: int
    kind: EdgeKind
    start: Vector
    end: Vector
    mid: Vector
    length: float
    faces: tuple[int, ...]
    convexity: EdgeConvexity
    angle: float
    """Between the two outward normals at the edge's middle, 0 (smooth) to pi (knife)."""
    center: Vector | None = None
    axis: Vector | None = None
    radius: float | None = None
    closed: bool = False
    between: tuple[Vector, ...] = ()
    """More points of what is no line and no arc, from its start to its end."""

    @property
    def points(self) -> tuple[Vector, Vector, Vector]:
        """Where does it start, pass its middle, and end?"""
        return self.start, self.mid, self.end

    @property
    def direction(self) -> Vector:
        """Which unit vector points from its start to its end? Zero where it is closed."""
        return unit(sub(self.end, self.start))


@dataclass(frozen=True, slots=True)
class Loop:
    """One wire of a face: its edges in order. The outer loop comes first in `FaceRecord.loops`."""

    edges: tuple[int, ...]
    outer: bool


@dataclass(frozen=True, slots=True)
class Moments:
    """How much area or volume there is, where its middle lies, and how it spreads around that.

    `inertia`: about the middle, along the file's axes, for density 1: m4 of an area, m5 of a volume. Its diagonal holds
    the moments about x, y, z; off it are the products of inertia with a minus sign.
    """

    amount: float
    center: Vector
    inertia: Matrix

    def positive(self) -> Moments:
        """The same with a positive amount: faces that point inwards enclose a negative one."""
        if self.amount >= 0:
            return self
        x, y, z = (scale(row, -1.0) for row in self.inertia)
        return Moments(-self.amount, self.center, (x, y, z))

    def in_metres(self, unit_m: float, dimension: int) -> Moments:
        """The same in metres; `unit_m`: the unit it is in; `dimension`: 2 of an area, 3 of a volume."""
        x, y, z = (scale(row, unit_m ** (dimension + 2)) for row in self.inertia)
        return Moments(self.amount * unit_m**dimension, scale(self.center, unit_m), (x, y, z))


NO_MOMENTS = Moments(0.0, (0.0, 0.0, 0.0), ((0.0,) * 3,) * 3)


def together(pieces: Sequence[Moments]) -> Moments:
    """The moments of several pieces as one (parallel axis theorem); of nothing, nothing."""
    amounts = np.array([piece.amount for piece in pieces])
    if not amounts.sum():
        return NO_MOMENTS
    centers = np.array([piece.center for piece in pieces])
    center = amounts @ centers / amounts.sum()
    arms = centers - center
    steiner = np.eye(3) * (amounts @ (arms**2).sum(axis=1)) - (arms.T * amounts) @ arms
    x, y, z = map(tuple, (np.sum([piece.inertia for piece in pieces], axis=0) + steiner).tolist())
    return Moments(float(amounts.sum()), tuple(center.tolist()), (x, y, z))


@dataclass(frozen=True, slots=True)
class FaceRecord:
    """One face with its canonical surface.

    `origin` and `axis`: a plane's point and outward normal; a point on and the direction of the axis of a cylinder,
    cone or torus (a cone's axis points towards growing radius, its origin is the apex); a sphere's centre.
    `radius`: cylinder, sphere; a torus's major radius, whose tube has `minor_radius`; a cone's largest radius, its
    smallest is `minor_radius` and `half_angle` its angle to the axis.
    `outward`: +1 where the outward normal points away from the axis or centre (convex), -1 where towards it, 0 for
    planes and freeform faces.
    `sweep`: angle that a surface of revolution covers around its axis, up to 2 pi.
    """

    id: int
    body: int
    kind: SurfaceKind
    origin: Vector
    axis: Vector
    area: float
    box: Box
    loops: tuple[Loop, ...]
    radius: float = 0.0
    minor_radius: float = 0.0
    half_angle: float = 0.0
    outward: int = 0
    sweep: float = 0.0
    point: Vector = (0.0, 0.0, 0.0)
    """A point on the surface near the middle of the face's parameter range."""
    point_normal: Vector = (0.0, 0.0, 0.0)
    """Outward unit normal there."""
    moments: Moments = NO_MOMENTS
    """Of its area."""

    @property
    def convexity(self) -> Convexity:
        """How does the face bulge?"""
        if self.kind is SurfaceKind.PLANE:
            return Convexity.FLAT
        if self.kind is SurfaceKind.FREEFORM:
            return Convexity.MIXED
        return Convexity.CONVEX if self.outward > 0 else Convexity.CONCAVE

    @property
    def facing(self) -> Vector:
        """Where to does it look? Its exact normal where it is plane, else that near its middle."""
        return self.axis if self.kind is SurfaceKind.PLANE else self.point_normal


@dataclass(frozen=True, slots=True)
class BodyRecord:
    """One body: a solid, or a shell or loose faces sewn together."""

    id: int
    name: str
    color: str | None
    is_solid: bool
    faces: tuple[int, ...]
    volume: float
    area: float
    moments: Moments | None = None
    """Of its volume; None of a body that is not closed."""


@dataclass(frozen=True)
class Brep:
    """A whole model. `warnings` says what was skipped or mended on the way in."""

    name: str
    faces: tuple[FaceRecord, ...]
    edges: tuple[EdgeRecord, ...]
    bodies: tuple[BodyRecord, ...]
    warnings: tuple[str, ...] = field(default=())

    @cached_property
    def box(self) -> Box:
        """Which exact axis-aligned box holds the model?"""
        box = box_union(face.box for face in self.faces)
        if box is None:
            raise ValueError("a model without faces has no box")
        return box

    @cached_property
    def face_edges(self) -> tuple[tuple[int, ...], ...]:
        """Which edges bound each face? Indexed by face id."""
        return tuple(tuple(edge for loop in face.loops for edge in loop.edges) for face in self.faces)

    @cached_property
    def face_pairs(self) -> tuple[tuple[int, int], ...]:
        """Which faces meet along an edge? Each pair once, the lower id first."""
        met = {pair for edge in self.edges for pair in combinations(sorted(set(edge.faces)), 2)}
        return tuple(sorted(met))

    @cached_property
    def _neighbours(self) -> tuple[tuple[tuple[EdgeRecord, int], ...], ...]:
        edges = self.edges
        return tuple(
            tuple((edges[i], other) for i in own for other in edges[i].faces if other != face)
            for face, own in enumerate(self.face_edges)
        )

    def neighbours(self, face: int) -> tuple[tuple[EdgeRecord, int], ...]:
        """Which faces meet this face, and along which edge? One entry an edge; seam edges left out."""
        return self._neighbours[face]

    @cached_property
    def edge_points(self) -> tuple[tuple[Vector, ...], ...]:
        """Which points span each edge? Its ends and middle, and `_around` it."""
        return tuple((*edge.points, *_around(edge)) for edge in self.edges)

    @cached_property
    def _edge_points(self) -> tuple[NDArray[np.float64], NDArray[np.intp]]:
        """`edge_points` as one array (n, 3), and where those of each edge begin."""
        counts = [len(points) for points in self.edge_points]
        begins = np.cumsum([0, *counts[:-1]])
        return np.array([point for points in self.edge_points for point in points]).reshape(-1, 3), begins

    def edge_reach(self, direction: Vector) -> tuple[list[float], list[float]]:
        """From where to where does each edge reach along a direction, in metres from the origin? Lows, then highs."""
        if not self.edges:
            return [], []
        points, begins = self._edge_points
        along = points @ np.array(direction)
        return np.minimum.reduceat(along, begins).tolist(), np.maximum.reduceat(along, begins).tolist()

    def beside(self, face: int, convexity: EdgeConvexity) -> list[int]:
        """Which faces meet this face in edges of this convexity? One entry an edge."""
        return [other for edge, other in self.neighbours(face) if edge.convexity is convexity]

    def of_kind(self, kind: SurfaceKind, faces: Iterable[int]) -> list[FaceRecord]:
        """Which of these faces are of this kind? In the order given."""
        return [self.faces[face] for face in faces if self.faces[face].kind is kind]

    def edges_of(self, faces: Iterable[int]) -> set[int]:
        """Which edges bound these faces?"""
        return {edge for face in faces for edge in self.face_edges[face]}


def _around(edge: EdgeRecord) -> Sequence[Vector]:
    """Sixteen points of a full circle; of an arc of more than half a turn, a quarter to both sides of its middle."""
    if edge.center is None or edge.axis is None or edge.radius is None:
        return edge.between
    if edge.closed:
        return around(edge.center, edge.axis, edge.radius, 16)
    if edge.length <= math.pi * edge.radius:
        return ()
    aside = cross(edge.axis, sub(edge.mid, edge.center))
    return add(edge.center, aside), sub(edge.center, aside)


def spread(start: Iterable[int], onwards: Callable[[int], Iterable[int]]) -> set[int]:
    """Which faces does one come to from these, themselves among them, when `onwards` leads from each to the next?"""
    reached, todo = set(start), list(start)
    while todo:
        new = set(onwards(todo.pop())) - reached
        reached |= new
        todo.extend(new)
    return reached


def parted(faces: Iterable[int], onwards: Callable[[int], Iterable[int]]) -> Iterator[set[int]]:
    """Those of the faces together that `onwards` links, in order of the first of each."""
    seen: set[int] = set()
    for face in faces:
        if face not in seen:
            group = spread((face,), onwards)
            seen |= group
            yield group


def linked(faces: Iterable[int], pairs: Iterable[Sequence[int]]) -> list[list[int]]:
    """Which of the faces hang together by these pairs of them? Each group sorted, in order of the lowest of each."""
    links: dict[int, list[int]] = {face: [] for face in sorted(faces)}
    for a, b in pairs:
        links[a].append(b)
        links[b].append(a)
    return [sorted(group) for group in parted(links, links.__getitem__)]
