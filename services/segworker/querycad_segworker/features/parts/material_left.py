"""How much material is left: behind a bottom or a counterbore, and beside a hole to the nearest outer face."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from querycad_contracts import Bottom, Part, PartKind, SurfaceKind, Vector
from querycad_segworker.features.shared.adjacency import is_blend
from querycad_segworker.features.shared.clearance import Ahead
from querycad_segworker.mesh import Mesh
from querycad_segworker.topology import Brep, EdgeConvexity, FaceRecord
from querycad_segworker.vectors import dot

Reals = NDArray[np.float64]
Ids = NDArray[np.int64]
BLIND = frozenset((PartKind.HOLE, PartKind.POCKET))
FLOORED = frozenset((PartKind.SLOT, PartKind.CHANNEL, PartKind.NOTCH, PartKind.COUNTERBORE, PartKind.SPOTFACE))
"""What has a floor though it is open: at a side, or to the bore that it widens."""
MOST_STARTS = 24
"""Rays from one bottom, from the middles of its largest triangles."""
AROUND = 16
"""Rays around a hole, every 22 degrees, at each of `LEVELS`: what is plane or round about a parallel axis is then met
straight on, so that they need only find the face."""
LEVELS = {(PartKind.HOLE,): (0.1, 0.9, 0.5), (PartKind.COUNTERBORE, PartKind.SPOTFACE): (0.5, 0.9, 0.7)}
"""Shares of the depth of holes, and of what widens them: a broken outer edge may lie beside their mouths. The last one
counts only where the others meet nothing but such an edge."""
SQUARE = 1e-3
"""Sine of the angle by which a face may lean and still run alongside a hole."""
LEVEL_M = 1e-6
"""Points this near to a plane lie in it."""
FACES_UP = 0.9
"""Cosine of the angle within which a face is a bottom."""


def with_material_left(parts: Sequence[Part], brep: Brep, mesh: Mesh | None, ahead: Ahead | None) -> list[Part]:
    """The same parts with `bottom_thickness` and `wall_distance`, where straight ways into the material leave it again.

    Exact where they leave through a plane, or, sideways, through a cylinder along the hole; else as the triangles are.
    """
    if mesh is None or ahead is None:
        return list(parts)
    faces = _Faces(brep, ahead)
    below = _below(parts, brep, faces, mesh)
    beside: dict[int, float] = {}
    for kinds, levels in LEVELS.items():
        beside |= _beside(parts, brep, faces, kinds, levels)
    result = []
    for i, part in enumerate(parts):
        found = {"bottom_thickness": below.get(i), "wall_distance": beside.get(i)}
        update = {name: value for name, value in found.items() if value is not None}
        result.append(part.model_copy(update=update) if update else part)
    return result


class _Faces:
    """All faces as columns, and what a ray meets of them exactly. Metres."""

    def __init__(self, brep: Brep, ahead: Ahead) -> None:
        self.records = brep.faces
        self._ahead = ahead
        self.is_plane = np.array([face.kind is SurfaceKind.PLANE for face in brep.faces])
        self.is_round = np.array([face.kind is SurfaceKind.CYLINDER for face in brep.faces])
        self.point = np.array([f.point if f.kind is SurfaceKind.PLANE else f.origin for f in brep.faces])
        self.axis = np.array([face.axis for face in brep.faces])
        self.radius = np.array([face.radius for face in brep.faces])

    def met(self, starts: Reals, ways: Reals) -> tuple[Reals, Ids]:
        """How far ahead of each start, (N, 3), is the next surface, (N,), and which face is it, (N,)? -1: none."""
        if not len(starts):
            return np.zeros(0), np.zeros(0, dtype=np.int64)
        distances, faces = self._ahead(starts, ways)
        ids = faces.astype(np.int64)
        axes, to_point = self.axis[ids], self.point[ids] - starts
        slope = np.einsum("ij,ij->i", axes, ways)
        plane = self.is_plane[ids] & (ids >= 0) & (np.abs(slope) > SQUARE)
        distances = distances.astype(np.float64)
        distances[plane] = np.einsum("ij,ij->i", axes[plane], to_point[plane]) / slope[plane]
        around = self.is_round[ids] & (ids >= 0) & (np.abs(slope) < SQUARE)
        if around.any():
            along = np.einsum("ij,ij->i", axes[around], to_point[around])
            level = to_point[around] - along[:, None] * axes[around]
            before = np.einsum("ij,ij->i", level, ways[around])
            off = (level**2).sum(axis=1) - before**2
            root = np.sqrt(np.maximum(0.0, self.radius[ids[around]] ** 2 - off))
            ends, near = np.stack([before - root, before + root]), distances[around]
            distances[around] = np.take_along_axis(ends, np.abs(ends - near).argmin(axis=0)[None], axis=0)[0]
        return distances, ids


def _least(owners: Ids, distances: Reals, counts: NDArray[np.bool_]) -> dict[int, float]:
    """By owner: the shortest of its distances that count."""
    counts = counts & (distances > 0.0) & np.isfinite(distances)
    owners, distances = owners[counts], distances[counts]
    order = np.lexsort((distances, owners))
    first, index = np.unique(owners[order], return_index=True)
    return dict(zip(first.tolist(), distances[order][index].tolist(), strict=True))


def _below(parts: Sequence[Part], brep: Brep, faces: _Faces, mesh: Mesh) -> dict[int, float]:
    """By index of what has a bottom: from all over it away from the opening; from the tip of a drill point, too.

    Where an open end of the bottom runs out in a face that leans under it, nothing is left, and the bottom ends before.
    """
    blind = (Bottom.FLAT, Bottom.CONICAL, Bottom.SPHERICAL)
    wanted = [
        i
        for i, part in enumerate(parts)
        if part.normal and (part.kind in FLOORED or (part.kind in BLIND and part.bottom in blind))
    ]
    if not wanted:
        return {}
    order = np.argsort(mesh.triangle_face, kind="stable")
    first = np.searchsorted(mesh.triangle_face[order], np.arange(len(faces.records) + 1))
    starts: list[Reals] = []
    owners: list[int] = []
    between: list[tuple[int, Reals]] = []
    floors: dict[int, list[int]] = defaultdict(list)
    ends: dict[int, set[int]] = defaultdict(set)
    for i in wanted:
        for face in (faces.records[f] for f in _with_floor(parts[i], brep)):
            triangles = order[first[face.id] : first[face.id + 1]]
            points = _bottom_points(parts[i], face, mesh, triangles)
            starts.append(points)
            owners += [i] * len(points)
            if _looks(face, parts[i].normal):
                floors[face.id].append(i)
                ends[i].update(_lean_under(face, brep))
                between.append((i, _all_over(mesh, triangles)))
    rays = _Rays.of(parts, faces, ends, np.array(owners, dtype=np.int64), np.concatenate([np.zeros((0, 3)), *starts]))
    more = _Rays.of(parts, faces, ends, *_nearest(parts, faces, floors, rays))
    finer = _through_planes(parts, faces, ends, between)
    # What is small behind a wide bottom, as the tip of a drill, is met from there.
    back = [
        (i, seen.distances[ray])
        for seen in (rays, finer)
        for ray in np.flatnonzero(seen.leaves).tolist()
        for i in floors.get(int(seen.ids[ray]), ())
        if np.dot(seen.ways[ray], np.array(parts[i].normal)) > FACES_UP
    ]
    own = (rays, more, finer)
    which = np.concatenate([*(one.owners for one in own), np.array([i for i, _ in back], dtype=np.int64)])
    distances = np.concatenate([*(one.distances for one in own), np.array([distance for _, distance in back])])
    return _least(which, distances, np.concatenate([*(one.leaves for one in own), np.ones(len(back), dtype=np.bool_)]))


@dataclass(frozen=True, slots=True, eq=False)
class _Rays:
    """From bottoms into the material, against the normals of their parts.

    `leaves`: out of it, not back to the part, nor through a face at which its bottom runs out.
    """

    owners: Ids
    starts: Reals
    ways: Reals
    distances: Reals
    ids: Ids
    leaves: NDArray[np.bool_]

    @classmethod
    def of(
        cls, parts: Sequence[Part], faces: _Faces, ends: Mapping[int, Collection[int]], owners: Ids, starts: Reals
    ) -> _Rays:
        """Those from these starts, (N, 3). `ends`: the faces at which the bottom of a part runs out."""
        ways = -np.array([parts[i].normal for i in owners], dtype=np.float64).reshape(-1, 3)
        distances, ids = faces.met(starts, ways)
        pairs = zip(owners.tolist(), ids.tolist(), strict=True)
        own = np.array([f in parts[i].faces or f in ends.get(i, ()) for i, f in pairs], dtype=np.bool_)
        return cls(owners, starts, ways, distances, ids, (ids >= 0) & ~own)


def _through_planes(
    parts: Sequence[Part], faces: _Faces, ends: Mapping[int, Collection[int]], starts: Sequence[tuple[int, Reals]]
) -> _Rays:
    """The rays from these starts of these parts, of which those leave that come out through a plane.

    Behind a flat bottom a round wall is nearest at one point, which `_nearest` knows.
    """
    owners = np.array([i for i, points in starts for _ in points], dtype=np.int64)
    rays = _Rays.of(parts, faces, ends, owners, np.concatenate([np.zeros((0, 3)), *(points for _, points in starts)]))
    return replace(rays, leaves=rays.leaves & faces.is_plane[rays.ids])


def _nearest(
    parts: Sequence[Part], faces: _Faces, floors: Mapping[int, Sequence[int]], rays: _Rays
) -> tuple[Ids, Reals]:
    """Points of the bottoms straight before what is round behind them, where it comes nearest; and their owners.

    `floors`: the parts that have a plane face as bottom.
    """
    found = []
    for ray in np.flatnonzero(rays.leaves).tolist():
        behind, i = faces.records[rays.ids[ray]], int(rays.owners[ray])
        if behind.kind not in (SurfaceKind.CYLINDER, SurfaceKind.SPHERE) or not parts[i].depth:
            continue
        aside = np.array(behind.origin) - rays.starts[ray]
        for way in (rays.ways[ray], *([np.array(behind.axis)] if behind.kind is SurfaceKind.CYLINDER else [])):
            aside = aside - np.dot(aside, way) * way
        found.append((i, rays.starts[ray] + aside))
    if not found:
        return np.zeros(0, dtype=np.int64), np.zeros((0, 3))
    owners, points = np.array([i for i, _ in found], dtype=np.int64), np.array([point for _, point in found])
    normals = np.array([parts[i].normal for i in owners])
    lifts = np.array([parts[i].depth for i in owners]) / 2
    depths, ids = faces.met(points + lifts[:, None] * normals, -normals)  # from within the cut: is it on the bottom?
    on_floor = [owner in floors.get(face, ()) for owner, face in zip(owners.tolist(), ids.tolist(), strict=True)]
    chosen = np.array(on_floor, dtype=np.bool_) & (np.abs(depths - lifts) < LEVEL_M)
    return owners[chosen], points[chosen]


def _lean_under(floor: FaceRecord, brep: Brep) -> set[int]:
    """Which planes, and cones about its normal, meet a plane bottom in convex edges?

    A straight way down from the bottom leaves through them only where they lean under it.
    """
    beside = (brep.faces[other] for other in brep.beside(floor.id, EdgeConvexity.CONVEX))
    return {
        face.id
        for face in beside
        if face.kind is SurfaceKind.PLANE
        or (face.kind is SurfaceKind.CONE and abs(dot(face.axis, floor.axis)) > FACES_UP)
    }


def _looks(face: FaceRecord, towards: Vector | None) -> bool:
    """Is it a plane that looks there?"""
    return face.kind is SurfaceKind.PLANE and np.dot(face.axis, np.array(towards)) > FACES_UP


def _with_floor(part: Part, brep: Brep) -> set[int]:
    """The faces of a part; of a step of a hole with the ring that it ends at."""
    own = set(part.faces)
    widened = part.kind in (PartKind.COUNTERBORE, PartKind.SPOTFACE)
    if not widened or part.normal is None or part.opening is None or not part.depth:
        return own
    low = np.dot(part.normal, part.opening) - part.depth
    around = {i for f in own for _, i in brep.neighbours(f) if brep.faces[i].kind is SurfaceKind.PLANE}
    return own | {i for i in around if abs(np.dot(part.normal, brep.faces[i].point) - low) < LEVEL_M}


def _bottom_points(part: Part, face: FaceRecord, mesh: Mesh, triangles: NDArray[np.integer]) -> Reals:
    """Points (N, 3) of the bottom on a face of a blind part; none on its walls."""
    out = np.array(part.normal)
    if face.kind is SurfaceKind.CONE and part.bottom is Bottom.CONICAL and np.dot(face.axis, out) > FACES_UP:
        return np.array([face.origin])
    if face.kind is SurfaceKind.SPHERE and part.bottom is Bottom.SPHERICAL:
        return np.array([np.array(face.origin) - face.radius * out])
    axis, origin = np.array(face.axis), np.array(face.origin)
    if face.kind is SurfaceKind.CYLINDER and face.outward < 0 and abs(np.dot(axis, out)) < SQUARE:  # a round trough
        low, high = np.array(face.box)
        lowest = origin + axis * np.dot(axis, (low + high) / 2 - origin) - face.radius * out
        return lowest[None] if np.all((lowest > low - LEVEL_M) & (lowest < high + LEVEL_M)) else np.zeros((0, 3))
    if _looks(face, part.normal):
        corners = mesh.vertices_m[mesh.triangles[triangles]]
        sizes = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
        middles: Reals = corners[np.argsort(-sizes, kind="stable")[:MOST_STARTS]].mean(axis=1)
        return middles
    return np.zeros((0, 3))


def _all_over(mesh: Mesh, triangles: NDArray[np.integer]) -> Reals:
    """Points (N, 3) all over a face: there is more behind a rectangle than behind the middles of its two triangles."""
    if len(triangles) >= MOST_STARTS:
        return np.zeros((0, 3))
    corners: Reals = mesh.vertices_m[mesh.triangles[triangles]]
    while 0 < len(corners) < MOST_STARTS:
        corners = _halved(corners)
    middles: Reals = corners.mean(axis=1)
    return middles


def _halved(corners: Reals) -> Reals:
    """Each triangle, (N, 3, 3), as the two on both sides of the middle of its longest side, (2 N, 3, 3)."""
    longest = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2).argmax(axis=1)
    order = (longest[:, None] + np.arange(3)) % 3
    a, b, c = np.take_along_axis(corners, order[..., None], axis=1).transpose(1, 0, 2)
    middle = (a + b) / 2
    return np.concatenate([np.stack([a, middle, c], axis=1), np.stack([middle, b, c], axis=1)])


def _beside(
    parts: Sequence[Part], brep: Brep, faces: _Faces, kinds: Sequence[PartKind], levels: Sequence[float]
) -> dict[int, float]:
    """By index of a hole: from its wall to the nearest face outside, of those that belong to nothing that is cut in.

    `kinds`: holes, or what widens them, looked at from these shares of their depth. What breaks an edge beside a hole,
    and the face that it opens in, count only where nothing else is met in the same direction: how far they are is a
    matter of the level.
    """
    holes = [i for i, part in enumerate(parts) if part.kind in kinds and part.depth and part.opening and part.normal]
    if not holes:
        return {}
    outside = np.ones(len(faces.records) + 1, dtype=np.bool_)
    outside[-1] = False  # nothing was met
    outside[[face for part in parts if part.kind.cuts_in for face in part.faces]] = False
    owner = np.full(len(faces.records) + 1, -1, dtype=np.int64)
    for i in holes:
        owner[list(parts[i].faces)] = i
    mouths: Reals = np.array([parts[i].opening for i in holes], dtype=np.float64)
    normals: Reals = np.array([parts[i].normal for i in holes], dtype=np.float64)
    depths: Reals = np.array([parts[i].depth for i in holes], dtype=np.float64)
    turns = np.arange(AROUND) * (2 * np.pi / AROUND)
    helper = np.where(np.abs(normals[:, :1]) < 0.7, [[1.0, 0.0, 0.0]], [[0.0, 1.0, 0.0]])
    x = _unit(np.cross(normals, helper))
    y = np.cross(normals, x)
    ways = x[:, None] * np.cos(turns)[:, None] + y[:, None] * np.sin(turns)[:, None]  # (H, A, 3)
    middles = mouths[:, None] - (np.array(levels) * depths[:, None])[..., None] * normals[:, None]  # (H, L, 3)
    shape = (len(holes), len(levels), AROUND, 3)
    axis_points = np.broadcast_to(middles[:, :, None], shape).reshape(-1, 3)
    rays = np.broadcast_to(ways[:, None], shape).reshape(-1, 3)
    which = np.repeat(np.array(holes, dtype=np.int64), len(levels) * AROUND)
    at_ends = _AtEnds.of(parts, holes, brep)
    distances, ids, kept = _through(faces, owner, axis_points, rays, which)
    which, starts = which[kept], axis_points[kept]
    directions = kept // (len(levels) * AROUND) * AROUND + kept % AROUND  # one number for all levels
    first = kept // AROUND % len(levels) < len(levels) - 1
    ends = at_ends.holds(which, ids) & ~_alongside(parts, faces, which, ids)
    met = outside[ids] & (distances > 0.0)
    again = np.isin(directions, directions[met & first & ends]) & ~np.isin(directions, directions[met & first & ~ends])
    counts = met & ~ends & (first | again)
    counts |= met & ends & first & ~np.isin(directions, directions[counts])
    found = _least(which, distances, counts)
    straight = _straight(parts, faces, counts, which, starts, ids)
    if straight is not None:
        which, starts, square = straight
        distances, ids, kept = _through(faces, owner, starts, square, which)
        ends = at_ends.holds(which[kept], ids) & ~_alongside(parts, faces, which[kept], ids)
        for i, nearer in _least(which[kept], distances, outside[ids] & ~ends).items():
            found[i] = min(nearer, found.get(i, nearer))
    return found


@dataclass(frozen=True, slots=True, eq=False)
class _AtEnds:
    """The faces that are nearest to a hole only at one end of it: what breaks edges, and what its mouths lie in."""

    breaks: NDArray[np.bool_]
    """By face."""
    mouths: Ids
    """Numbers of pairs, sorted: hole times the number of faces, plus face."""

    @classmethod
    def of(cls, parts: Sequence[Part], holes: Sequence[int], brep: Brep) -> _AtEnds:
        """Those of these holes."""
        breaks = np.array([face.outward > 0 and is_blend(brep, face) for face in brep.faces], dtype=np.bool_)
        breaks[[face for part in parts if part.kind.breaks_edge for face in part.faces]] = True
        pairs = {
            i * len(brep.faces) + beside for i in holes for f in parts[i].faces for _, beside in brep.neighbours(f)
        }
        return cls(breaks, np.array(sorted(pairs), dtype=np.int64))

    def holds(self, which: Ids, ids: Ids) -> NDArray[np.bool_]:
        """Which of these faces are so of which holes, (N,)?"""
        return (self.breaks[ids] & (ids >= 0)) | np.isin(which * len(self.breaks) + ids, self.mouths)


def _through(faces: _Faces, owner: Ids, starts: Reals, ways: Reals, which: Ids) -> tuple[Reals, Ids, NDArray[np.intp]]:
    """From a hole's axis through its own wall on: how far beyond is the next face, which is it, for which rays?"""
    distances, ids = faces.met(starts, ways)
    kept = np.flatnonzero((ids >= 0) & (owner[ids] == which))
    beyond, ids = faces.met(starts[kept] + distances[kept, None] * ways[kept], ways[kept])
    return beyond, ids, kept


def _straight(
    parts: Sequence[Part], faces: _Faces, counts: NDArray[np.bool_], which: Ids, starts: Reals, ids: Ids
) -> tuple[Ids, Reals, Reals] | None:
    """The shortest ways from holes' axes to the faces that run alongside, one for each hole and face that counts."""
    counts = counts & _alongside(parts, faces, which, ids)
    which, starts, ids = which[counts], starts[counts], ids[counts]
    _, first = np.unique(np.stack([which, ids]), axis=1, return_index=True)
    if not len(first):
        return None
    which, starts, ids = which[first], starts[first], ids[first]
    plane, axes = faces.is_plane[ids], faces.axis[ids]
    apart = starts - faces.point[ids]
    aside = apart - np.einsum("ij,ij->i", apart, axes)[:, None] * axes
    chosen = plane | (np.linalg.norm(aside, axis=1) > SQUARE * faces.radius[ids])
    return which[chosen], starts[chosen], np.where(plane[:, None], axes, _unit(aside))[chosen]


def _alongside(parts: Sequence[Part], faces: _Faces, which: Ids, ids: Ids) -> NDArray[np.bool_]:
    """Which of these faces are planes or cylinders that run along the hole, (N,)?"""
    along = np.array([parts[i].normal for i in which.tolist()], dtype=np.float64).reshape(-1, 3)
    slope = np.abs(np.einsum("ij,ij->i", faces.axis[ids], along))
    found: NDArray[np.bool_] = faces.is_plane[ids] & (slope < SQUARE)
    found |= faces.is_round[ids] & (slope > 1 - SQUARE**2 / 2)
    return found


def _unit(vectors: ArrayLike) -> Reals:
    found = np.asarray(vectors, dtype=np.float64)
    lengths = np.linalg.norm(found, axis=1, keepdims=True)
    result: Reals = found / np.where(lengths > 0, lengths, 1.0)
    return result
