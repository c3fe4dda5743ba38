"""From faces of triangles to `topology.Brep`: edges between faces, loops, bodies, moments. Metres throughout."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from querycad_contracts import SurfaceKind
from querycad_segworker.tolerances import FACING
from querycad_segworker.topology import (
    REVOLVED,
    BodyRecord,
    Brep,
    EdgeConvexity,
    EdgeKind,
    EdgeRecord,
    FaceRecord,
    Loop,
)
from querycad_segworker.vectors import Box, box_union

from .moments import gaps_of, gauss_places, of_area, of_volume, scaled
from .regions import MOST_STEP_RAD, Regions
from .shells import Shells, shells
from .surfaces import Fitted, circle_through
from .triangles import Array, Ints, Named, Triangles, grouped, vector_of

SMOOTH_RAD = math.radians(2.0)
"""As `Tolerances.smooth`."""


@dataclass(frozen=True, slots=True, eq=False)
class _Chain:
    """Sides of triangles in a row between the same two faces, as the first one runs: left of it lies `faces[0]`."""

    places: Ints
    """(N + 1,) vertices; the last is the first where it closes."""
    sides: Ints
    """(N,) sides of triangles of the first face."""
    faces: tuple[int, ...]


def brep_of(
    mesh: Triangles, found: Regions, objects: Sequence[Named], source: Ints, warnings: Sequence[str], near: float
) -> Brep:
    """The B-rep. `source`: (T,) the object that each triangle is of; `near`: what counts as the same place."""
    parts = shells(mesh)
    chains = _chains(mesh, found.owner, parts.of)
    builder = _Builder(mesh, found, chains, near)
    edges = [builder.edge(number, chain) for number, chain in enumerate(chains)]
    by_face: dict[int, list[int]] = defaultdict(list)
    for number, chain in enumerate(chains):
        for face in chain.faces:
            by_face[face].append(number)
    members = found.members
    faces = [builder.face(i, members[i], by_face[i], edges) for i in range(len(found.surfaces))]
    bodies = _bodies(mesh, parts, found, faces, objects, source)
    body_of = {face: body.id for body in bodies for face in body.faces}
    faces = [replace(face, body=body_of[face.id]) for face in faces]
    said = list(warnings)
    if any(not body.is_solid for body in bodies):
        said.append("a body that is not closed has no volume")
    return Brep("", tuple(faces), tuple(edges), tuple(bodies), tuple(said))


def _chains(mesh: Triangles, owner: Ints, shell: Ints) -> list[_Chain]:
    """Borders between faces, parted where a third face of the shell meets them: bodies may touch there."""
    across = mesh.across.ravel()
    sides = np.arange(len(across))
    own = owner[sides // 3]
    other = np.where(across < 0, -1, owner[np.where(across < 0, 0, across) // 3])
    # Each border once: the side of the face with the lower number, or the only one.
    border = np.flatnonzero((own != other) & ((other < 0) | (own < other)))
    start, end = mesh.corners.ravel()[border], np.roll(mesh.corners, -1, axis=1).ravel()[border]
    corner = np.r_[start, end] * np.int64(int(shell.max(initial=0)) + 1) + np.tile(shell[border // 3], 2)
    _, at_corner, uses = np.unique(corner, return_inverse=True, return_counts=True)
    ends = (uses != 2)[at_corner.reshape(-1)]
    begins, stops = ends[: len(border)], ends[len(border) :]
    pair = own[border] * (len(owner) + 1) + other[border]
    leaving: dict[tuple[int, int], list[int]] = defaultdict(list)
    for position, (vertex, key) in enumerate(zip(start.tolist(), pair.tolist(), strict=True)):
        leaving[vertex, key].append(position)
    taken = np.zeros(len(border), dtype=bool)
    starts = np.flatnonzero(begins).tolist() + list(range(len(border)))
    chains = []
    for first in starts:
        if taken[first]:
            continue
        row, at = [], first
        while True:
            taken[at] = True
            row.append(at)
            if stops[at]:
                break
            following = [each for each in leaving[int(end[at]), int(pair[at])] if not taken[each]]
            if not following:
                break
            at = following[0]
        places = np.r_[start[row[0]], end[row]]
        faces = (int(own[border[first]]), int(other[border[first]]))
        chains.append(_Chain(places, border[row], faces if faces[1] >= 0 else faces[:1]))
    return chains


class _Builder:
    def __init__(self, mesh: Triangles, found: Regions, chains: Sequence[_Chain], near: float) -> None:
        self.mesh = mesh
        self.found = found
        self.chains = chains
        self.near = near
        self.boxes: list[Box] = []

    def edge(self, number: int, chain: _Chain) -> EdgeRecord:
        """The line, circle or other curve that a chain follows."""
        points = self.mesh.vertices[chain.places]
        closed = chain.places[0] == chain.places[-1]
        steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
        surfaces = [self.found.surfaces[i] for i in chain.faces]
        kind, length = EdgeKind.OTHER, float(steps.sum())
        half = int(np.searchsorted(np.cumsum(steps), length / 2))
        middle = (points[half] + points[half + 1]) / 2
        circle = None
        if not closed and self._is_straight(points):
            kind, length, middle = (
                EdgeKind.LINE,
                float(np.linalg.norm(points[-1] - points[0])),
                (points[0] + points[-1]) / 2,
            )
        else:
            circle = self._circle(points, surfaces)
        box: Box = vector_of(points.min(axis=0)), vector_of(points.max(axis=0))
        if circle is not None:
            kind = EdgeKind.CIRCLE
            center, axis, radius = circle
            angles = _turns(points, center, axis)
            swept = float(angles[-1]) if not closed else math.copysign(2 * math.pi, angles[-1])
            length = abs(swept) * radius
            x = (points[0] - center) / radius
            y = np.cross(axis, x)
            middle = center + radius * (math.cos(swept / 2) * x + math.sin(swept / 2) * y)
            box = _arc_box(points, center, x, y, radius, swept)
        self.boxes.append(box)
        convexity, angle = self._convexity(chain, half, middle)
        return EdgeRecord(
            id=number,
            kind=kind,
            start=vector_of(points[0]),
            end=vector_of(points[-1]),
            mid=vector_of(middle),
            length=length,
            faces=chain.faces,
            convexity=convexity,
            angle=angle,
            center=None if circle is None else vector_of(circle[0]),
            axis=None if circle is None else vector_of(circle[1]),
            radius=None if circle is None else circle[2],
            closed=bool(closed),
            between=tuple(map(vector_of, points[1:-1])) if kind is EdgeKind.OTHER else (),
        )

    def _is_straight(self, points: Array) -> bool:
        chord = points[-1] - points[0]
        length = float(np.linalg.norm(chord))
        return len(points) == 2 or (
            length > 0
            and float(np.linalg.norm(np.cross(points - points[0], chord / length), axis=1).max()) <= self.near
        )

    def _circle(self, points: Array, surfaces: Sequence[Fitted | None]) -> tuple[Array, Array, float] | None:
        """About the axis of a round face, if the points are; else through them, if four or more lie on one."""
        for surface in surfaces:
            if surface is None or surface.kind not in REVOLVED:
                continue
            to = points - surface.origin
            along = to @ surface.axis
            radial = np.linalg.norm(to - along[:, None] * surface.axis, axis=1)
            if np.ptp(along) <= 2 * self.near and np.ptp(radial) <= 2 * self.near:
                return surface.origin + float(along.mean()) * surface.axis, surface.axis, float(radial.mean())
        if len(np.unique(points, axis=0)) < 4:
            return None
        found = circle_through(points)
        if found is None:
            return None
        center, axis, radius = found
        to = points - center
        off = np.abs(np.linalg.norm(to, axis=1) - radius).max(), np.abs(to @ axis).max()
        return found if max(off) <= self.near and radius < 100 * float(np.ptp(points, axis=0).max()) else None

    def _normal(self, face: int, side: int, place: Array) -> Array:
        """Outward normal of a face at a place on one of its sides."""
        surface, outward = self.found.surfaces[face], self.found.outward[face]
        if surface is None:
            facet: Array = self.mesh.normals[side // 3]
            return facet
        if surface.kind is SurfaceKind.PLANE:
            return surface.axis
        normal: Array = outward * surface.directions(place[None])[0]
        return normal

    def _convexity(self, chain: _Chain, at: int, middle: Array) -> tuple[EdgeConvexity, float]:
        """As `brep.faces`: convex where each face lies behind the other's plane."""
        if len(chain.faces) < 2:
            return EdgeConvexity.FREE, 0.0
        side = int(chain.sides[at])
        opposite = int(self.mesh.across.ravel()[side])
        one, other = self._normal(chain.faces[0], side, middle), self._normal(chain.faces[1], opposite, middle)
        along = self.mesh.sides.reshape(-1, 3)[side]
        angle = math.atan2(float(np.linalg.norm(np.cross(one, other))), float(one @ other))
        coarse = any(self.found.surfaces[i] is None for i in chain.faces)
        if angle < (MOST_STEP_RAD if coarse else SMOOTH_RAD):
            return EdgeConvexity.SMOOTH, angle
        into, into_other = np.cross(one, along), np.cross(other, -along)
        turn = float(into @ other) + float(into_other @ one)
        return (EdgeConvexity.CONVEX if turn < 0 else EdgeConvexity.CONCAVE), angle

    def face(self, number: int, members: Ints, own: Sequence[int], edges: Sequence[EdgeRecord]) -> FaceRecord:
        """One face from its triangles, its edges and its surface."""
        mesh = self.mesh
        surface, outward = self.found.surfaces[number], self.found.outward[number]
        loops, around = self._loops(number, own, surface)
        points = mesh.vertices[np.unique(mesh.corners[members])]
        moments = of_area(mesh, members)
        middle = members[np.linalg.norm(mesh.centers[members] - np.array(moments.center), axis=1).argmin()]
        point, normal = mesh.centers[middle], mesh.normals[middle]
        if surface is not None:
            off = surface.off(point[None])[0]
            direction = surface.directions(point[None])[0]
            point = point - off * direction
            normal = direction * (outward or 1)
        area = self._area(number, members, own, edges, moments.amount)
        moments = scaled(moments, area)
        box = box_union(self.boxes[i] for i in own)
        if box is None or surface is None or surface.kind in (SurfaceKind.SPHERE, SurfaceKind.TORUS):
            box = box_union([*([box] if box else []), (vector_of(points.min(axis=0)), vector_of(points.max(axis=0)))])
        if surface is not None and surface.kind in (SurfaceKind.SPHERE, SurfaceKind.TORUS) and box is not None:
            box = self._bulged(surface, members, box)
        assert box is not None
        form = surface or Fitted(SurfaceKind.FREEFORM, np.zeros(3), np.zeros(3))
        large, small = form.radius, form.minor_radius
        if form.kind is SurfaceKind.CONE:
            to = points - form.origin
            radial = np.linalg.norm(to - (to @ form.axis)[:, None] * form.axis, axis=1)
            small, large = float(radial.min()), float(radial.max())
        return FaceRecord(
            id=number,
            body=0,
            kind=form.kind,
            origin=vector_of(form.origin),
            axis=vector_of(form.axis),
            area=area,
            box=box,
            loops=loops,
            radius=large,
            minor_radius=small,
            half_angle=form.half_angle,
            outward=outward,
            sweep=self._sweep(surface, points, around) if outward and surface is not None else 0.0,
            point=vector_of(point),
            point_normal=vector_of(normal),
            moments=moments,
        )

    def _loops(self, number: int, own: Sequence[int], surface: Fitted | None) -> tuple[tuple[Loop, ...], bool]:
        """Edges in order, outer first; those that go around an axis are one loop, as the seam of a kernel joins them.

        Also: does the face go all around its axis?
        """
        left: dict[int, list[tuple[int, bool]]] = defaultdict(list)
        rings: list[list[tuple[int, bool]]] = []
        for i in own:
            chain = self.chains[i]
            forward = chain.faces[0] == number
            if chain.places[0] == chain.places[-1]:
                rings.append([(i, forward)])
            else:
                left[int(chain.places[0 if forward else -1])].append((i, forward))
        for vertex in list(left):
            while left[vertex]:
                ring = [left[vertex].pop()]
                while True:
                    chain = self.chains[ring[-1][0]]
                    end = int(chain.places[-1 if ring[-1][1] else 0])
                    if end == vertex or not left.get(end):
                        break
                    ring.append(left[end].pop())
                rings.append(ring)
        if not rings:
            return (), surface is not None and surface.kind is not SurfaceKind.PLANE
        outlines = [
            np.concatenate([self.mesh.vertices[self.chains[i].places][:: 1 if forward else -1] for i, forward in ring])
            for ring in rings
        ]
        if surface is not None and surface.kind in REVOLVED:
            turns = [abs(float(_turns(outline, surface.origin, surface.axis)[-1])) > math.pi for outline in outlines]
            if any(turns):
                joined = [i for ring, turned in zip(rings, turns, strict=True) if turned for i, _ in ring]
                rest = [ring for ring, turned in zip(rings, turns, strict=True) if not turned]
                return (Loop(tuple(joined), True), *(Loop(tuple(i for i, _ in ring), False) for ring in rest)), True
        sizes = [
            float(np.linalg.norm(np.cross(outline - outline[0], np.roll(outline - outline[0], -1, axis=0)).sum(axis=0)))
            for outline in outlines
        ]
        order = sorted(range(len(rings)), key=lambda k: -sizes[k])
        return tuple(Loop(tuple(i for i, _ in rings[k]), k == order[0]) for k in order), False

    def _sweep(self, surface: Fitted, points: Array, around: bool) -> float:
        """The angle that the face covers around its axis: all but the widest gap between its vertices."""
        if around or surface.kind is SurfaceKind.SPHERE:
            return 2 * math.pi
        to = points - surface.origin
        first = to[0] - (to[0] @ surface.axis) * surface.axis
        angles = np.sort(
            np.arctan2(
                to @ np.cross(surface.axis, first) / max(float(np.linalg.norm(first)), 1e-300),
                to @ first / max(float(np.linalg.norm(first)), 1e-300),
            )
        )
        gaps = np.diff(np.r_[angles, angles[0] + 2 * math.pi])
        return 2 * math.pi - float(gaps.max())

    def _area(self, number: int, members: Ints, own: Sequence[int], edges: Sequence[EdgeRecord], flat: float) -> float:
        """What the triangles have, corrected: round ones cut the bulge off, plane ones the segments of their arcs."""
        mesh, surface = self.mesh, self.found.surfaces[number]
        if surface is None:
            return flat
        if surface.kind is SurfaceKind.PLANE:
            more = 0.0
            for i in own:
                edge, chain = edges[i], self.chains[i]
                if edge.center is None or edge.axis is None or edge.radius is None:
                    continue
                if abs(float(np.array(edge.axis) @ surface.axis)) < FACING.parallel:
                    continue
                points = mesh.vertices[chain.places][:: 1 if chain.faces[0] == number else -1]
                angles = np.diff(_turns(points, np.array(edge.center), surface.axis))
                more += 0.5 * edge.radius**2 * float((angles - np.sin(angles)).sum())
            return max(flat + more, 0.0)
        weights, places, normals = mesh.areas[members], gauss_places(mesh, members), mesh.normals[members]
        if surface.kind is SurfaceKind.SPHERE:
            to = places - surface.origin
            far = np.linalg.norm(to, axis=2)
            seen = np.abs((to * normals[:, None, :]).sum(axis=2)) / far * (surface.radius / far) ** 2
        elif surface.kind is SurfaceKind.CYLINDER:
            to = places - surface.origin
            radial = to - (to @ surface.axis)[:, :, None] * surface.axis
            far = np.linalg.norm(radial, axis=2)
            seen = np.abs((radial * normals[:, None, :]).sum(axis=2)) / far * (surface.radius / far)
        else:
            return flat
        return float((weights * seen.mean(axis=1)).sum())

    def _bulged(self, surface: Fitted, members: Ints, box: Box) -> Box:
        """The box with the points of a ball or ring where its normal runs along x, y or z, if a triangle lies there."""
        found = [box]
        corners = self.mesh.vertices[self.mesh.corners[members]]
        for e in np.r_[np.eye(3), -np.eye(3)]:
            if surface.kind is SurfaceKind.SPHERE:
                place, inner = surface.origin + surface.radius * e, surface.origin
            else:
                across = e - (e @ surface.axis) * surface.axis
                if np.linalg.norm(across) < 1e-6:
                    continue
                inner = surface.origin + surface.radius * across / np.linalg.norm(across)
                place = inner + surface.minor_radius * e
            if _pierced(inner, place - inner, corners):
                found.append((vector_of(place), vector_of(place)))
        return box_union(found) or box


def _bodies(
    mesh: Triangles, parts: Shells, found: Regions, faces: Sequence[FaceRecord], objects: Sequence[Named], source: Ints
) -> list[BodyRecord]:
    """One a shell, with its voids. What is not closed has no volume."""
    body_of = parts.body[parts.of]
    gaps = gaps_of(mesh, found)
    owners = np.zeros(len(faces), dtype=np.int64)
    owners[found.owner] = body_of
    whole = grouped(body_of, len(parts.body))
    own_faces = grouped(owners, len(parts.body))
    bodies: list[BodyRecord] = []
    for body in dict.fromkeys(owners.tolist()):
        members = whole[body]
        moments = None
        if parts.closed[np.unique(parts.of[members])].all():
            raw = of_volume(mesh, members)
            moments = scaled(raw, max(raw.amount + float(gaps[members].sum()), 0.0)) if raw.amount > 0 else None
        named = objects[int(source[members[0]])]
        ids = tuple(own_faces[body].tolist())
        area = sum(faces[i].area for i in ids)
        volume = 0.0 if moments is None else moments.amount
        bodies.append(BodyRecord(len(bodies), named.name, named.color, moments is not None, ids, volume, area, moments))
    return bodies


def _turns(points: Array, center: Array, axis: Array) -> Array:
    """(N,) the angle that a row of points has gone around an axis, from the first on."""
    to = points - center
    to = to - (to @ axis)[:, None] * axis
    before, after = to[:-1], to[1:]
    angles = np.arctan2(np.cross(before, after) @ axis, (before * after).sum(axis=1))
    found: Array = np.r_[0.0, np.cumsum(angles)]
    return found


def _arc_box(points: Array, center: Array, x: Array, y: Array, radius: float, swept: float) -> Box:
    """The box of an arc that begins at `x` and goes towards `y`: its ends, and extreme points that it passes."""
    found = [points[0], points[-1]]
    for k in range(3):
        extreme = math.atan2(y[k], x[k])
        for turn in (extreme, extreme + math.pi):
            gone = turn % (2 * math.pi) if swept >= 0 else -((-turn) % (2 * math.pi))
            if abs(gone) <= abs(swept):
                found.append(center + radius * (math.cos(gone) * x + math.sin(gone) * y))
    return vector_of(np.min(found, axis=0)), vector_of(np.max(found, axis=0))


def _pierced(origin: Array, direction: Array, corners: Array) -> bool:
    """Does a ray go through one of (T, 3, 3) triangles? Source: Moeller and Trumbore, 1997."""
    one, two = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    across = np.cross(direction, two)
    scale = (one * across).sum(axis=1)
    scale = np.where(np.abs(scale) < 1e-300, 1e-300, scale)
    to = origin - corners[:, 0]
    u = (to * across).sum(axis=1) / scale
    over = np.cross(to, one)
    v = over @ direction / scale
    far = (two * over).sum(axis=1) / scale
    inside: NDArray[np.bool_] = (u >= -1e-9) & (v >= -1e-9) & (u + v <= 1 + 1e-9) & (far > 0)
    return bool(inside.any())
