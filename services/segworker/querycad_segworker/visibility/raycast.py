"""Which face does each pixel show? Primary rays through Intel Embree: no graphics driver, no window system.

Embree computes in single precision, so the mesh is centred and scaled to a sphere of radius 1 before it is traced:
a watch screw and a bridge render alike. Embree's worker threads do not survive a fork: make a Scene after it.
"""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import Any

import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene
from numpy.typing import ArrayLike, NDArray

from querycad_contracts import Side, Vector
from querycad_contracts.infrastructure import processors
from querycad_segworker.mesh import Mesh

from .cameras import Camera, box_corners, off_axis
from .normals import smooth_normals

BACKGROUND = -1
"""Face id of a pixel that shows no face."""

FaceIds = NDArray[np.signedinteger[Any]]


def id_type(mesh: Mesh) -> np.dtype[np.signedinteger[Any]]:
    """How wide are the ids in an image of this mesh? Half as wide where the faces allow: images are what takes memory.

    One more than the highest id still fits, for those who count the background as 0.
    """
    narrow = mesh.triangle_face.max(initial=0) < np.iinfo(np.int16).max
    return np.dtype(np.int16) if narrow else np.dtype(np.int32)


RAYS_PER_TILE = 1 << 16
"""Rays traced in one call: 3 MB of rays and results a thread, and Python's share of the time does not show."""

GRAZING_DEG = 2.0
"""A surface that faces a side by less than this is not looked at from there: twice the angle by which side cameras are
off axis, so that an opening at right angles to a side does not count as facing it."""


@dataclass(frozen=True, slots=True, eq=False)
class IdImage:
    """What one camera sees: the result of every renderer, whichever way it was made."""

    camera: Camera
    face_id_map: FaceIds
    """(H, W) of `id_type`; -1 where the background shows."""
    depth_m: NDArray[np.float32]
    """(H, W) float32, metres from the camera's near plane; infinite where the background shows."""
    normals: NDArray[np.float32] | None
    """(H, W, 3) float32, unit, world frame, towards the viewer; zero on the background. None unless asked for."""


@dataclass(frozen=True, slots=True, eq=False)
class _Hits:
    """What N rays hit first, in the scaled frame."""

    triangle: NDArray[np.int32]
    """-1 for nothing."""
    distance: NDArray[np.float32]
    u: NDArray[np.float32]
    """Share of the triangle's second corner at the hit; `v` that of the third."""
    v: NDArray[np.float32]


class Scene:
    """A mesh made ready for tracing; the hierarchy of boxes is built once for all views and points."""

    def __init__(self, mesh: Mesh, threads: int | None = None) -> None:
        self.mesh = mesh
        self._threads = threads or processors()
        self.bounds = mesh.bounds
        low, high = self.bounds
        self._center: NDArray[np.float64] = (low + high) / 2
        self._radius = float(np.linalg.norm(high - low) / 2) or 1.0
        self._face_of = np.append(mesh.triangle_face, np.int32(BACKGROUND))  # index -1: a ray that hits nothing
        self._corner_normals: NDArray[np.float32] | None = None
        self._embree: Any = None  # without triangles there is nothing to trace
        if len(mesh.triangles):
            self._embree = EmbreeScene(robust=True)  # robust: no ray slips through between two triangles
            vertices = ((mesh.vertices_m - self._center) / self._radius).astype(np.float32)
            TriangleMesh(self._embree, vertices, mesh.triangles)
            self._trace(np.zeros((1, 3)), np.ones((1, 3)))  # builds the hierarchy, before threads share it

    def render_ids(self, camera: Camera, normals: bool = False) -> IdImage:
        """Which face does each pixel of `camera` show, and how far away?"""
        faces = np.full((camera.height, camera.width), BACKGROUND, dtype=id_type(self.mesh))
        depth = np.full(faces.shape, np.inf, dtype=np.float32)
        directions = np.zeros((*faces.shape, 3), dtype=np.float32) if normals else None
        rows, columns = self.window(camera)
        if self._embree is None or not rows or not columns:
            return IdImage(camera, faces, depth, directions)
        corners = self._corners() if normals else None
        down, across = self._places(camera, np.array(rows), np.array(columns))
        backward = camera.axes[2]
        span = slice(columns.start, columns.stop)
        tile_rows = max(1, RAYS_PER_TILE // len(columns))

        def tile(first: int) -> None:
            origins = down[first : first + tile_rows, None] + across[None]
            hits = self._trace(origins.reshape(-1, 3), -backward[None])
            shape = origins.shape[:2]
            band = slice(rows.start + first, rows.start + first + shape[0])
            distance = np.where(hits.triangle >= 0, hits.distance, np.inf) * np.float32(self._radius)
            faces[band, span] = self._face_of[hits.triangle].reshape(shape)
            depth[band, span] = distance.reshape(shape)
            if directions is not None and corners is not None:
                found = _interpolate(corners, hits)
                found *= np.where(found @ backward.astype(np.float32) < 0, -1, 1)[:, None].astype(np.float32)
                directions[band, span] = found.reshape(*shape, 3)

        self._spread(tile, range(0, len(rows), tile_rows))
        return IdImage(camera, faces, depth, directions)

    def faces_at(self, camera: Camera, rows: NDArray[np.integer], columns: NDArray[np.integer]) -> NDArray[np.int32]:
        """Which face does each of these pixels of `camera` show? (N,) rows and columns in, (N,) int32 out."""
        faces = np.full(len(rows), BACKGROUND, dtype=np.int32)
        if self._embree is None:
            return faces
        towards = -camera.axes[2][None]

        def tile(first: int) -> None:
            chosen = slice(first, first + RAYS_PER_TILE)
            down, across = self._places(camera, rows[chosen], columns[chosen])
            faces[chosen] = self._face_of[self._trace(down + across, towards).triangle]

        self._spread(tile, range(0, len(rows), RAYS_PER_TILE))
        return faces

    def backs(self, camera: Camera) -> float:
        """Of the pixels that show a face, which share shows the back of a triangle? 0 where nothing is seen."""
        if self._embree is None:
            return 0.0
        rows, columns = np.mgrid[: camera.height, : camera.width]
        pixels = np.stack([columns.ravel() + 0.5, rows.ravel() + 0.5, np.zeros(rows.size)], axis=1)
        backward = np.array(camera.backward)
        hits = self._trace((camera.to_world(pixels) - self._center) / self._radius, -backward[None]).triangle
        corners = self.mesh.vertices_m[self.mesh.triangles[hits[hits >= 0]]]
        facing = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) @ backward
        return float((facing < 0).mean()) if len(facing) else 0.0

    def sees(self, points_m: ArrayLike, normals: ArrayLike | None = None) -> NDArray[np.bool_]:
        """From which sides is each point seen? (N, 3) metres in; (6, N) bool out, rows in the order of `Side`.

        A point is seen when nothing lies between it and a viewer far out on that side, the viewer standing one degree
        off axis as the side's camera does. With `normals` (N, 3), unit, such as the direction out of a hole's opening,
        it must also face that viewer, by more than a grazing angle. Points may lie on the surface: what is within
        1e-5 of the model's size (the recogniser's own length tolerance) before them does not hide them.
        """
        points = (np.asarray(points_m, dtype=np.float64).reshape(-1, 3) - self._center) / self._radius
        facing = np.zeros_like(points) if normals is None else np.asarray(normals, dtype=np.float64).reshape(-1, 3)
        if facing.shape != points.shape:
            raise ValueError(f"{len(points)} points but {len(facing)} normals")
        gap = 2e-5  # of the radius 1
        seen = np.ones((len(Side), len(points)), dtype=np.bool_)
        for row, side in enumerate(Side):
            towards = np.array(off_axis(side)[2])
            if self._embree is not None and len(points):
                seen[row] = self._trace(points + gap * (facing + towards), towards[None]).triangle < 0
            if normals is not None:
                seen[row] &= facing @ towards > np.sin(np.radians(GRAZING_DEG))
        return seen

    def reach(self, points_m: ArrayLike, directions: ArrayLike) -> NDArray[np.float64]:
        """How far is it from each point to the next surface? (N, 3) metres and (N, 3) unit in; (N,) metres out.

        Infinite where nothing is hit. A point on a surface starts 1e-5 of the model's size beyond it.
        """
        return self.ahead(points_m, directions)[0]

    def ahead(self, points_m: ArrayLike, directions: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
        """As `reach`, and which face is there: (N,) metres and (N,) int32 ids, `BACKGROUND` where nothing is hit."""
        points = (np.asarray(points_m, dtype=np.float64).reshape(-1, 3) - self._center) / self._radius
        towards = np.asarray(directions, dtype=np.float64).reshape(-1, 3)
        gap = 2e-5  # of the radius 1
        if self._embree is None or not len(points):
            return np.full(len(points), np.inf), np.full(len(points), BACKGROUND, dtype=np.int32)
        hits = self._trace(points + gap * towards, towards)
        distances = np.where(hits.triangle >= 0, (hits.distance.astype(np.float64) + gap) * self._radius, np.inf)
        return distances, self._face_of[hits.triangle]

    def is_clear(self, start_m: Vector, end_m: Vector) -> bool:
        """Is the straight way from one point to another free of surfaces?"""
        way = np.subtract(end_m, start_m)
        length = float(np.linalg.norm(way))
        return length == 0 or bool(self.reach([start_m], [way / length])[0] > length * (1 - 1e-6))

    def _trace(self, origins: NDArray[np.float64], directions: NDArray[np.float64]) -> _Hits:
        """What do the rays hit first? Origins (N, 3) in the scaled frame; directions (N, 3), or (1, 3) for all."""
        hits = self._embree.run(origins.astype(np.float32), directions.astype(np.float32), output=True)
        return _Hits(hits["primID"], hits["tfar"], hits["u"], hits["v"])

    def _places(
        self, camera: Camera, rows: NDArray[np.integer], columns: NDArray[np.integer]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Where in the scaled frame are rows, (R, 3) on the near plane, and how far beside are columns, (C, 3)?"""
        right, up, _ = camera.axes
        step = camera.pixel_m / self._radius
        eye = (np.array(camera.eye_m) - self._center) / self._radius
        down = eye + up * ((camera.height / 2 - rows - 0.5) * step)[:, None]
        return down, right * ((columns + 0.5 - camera.width / 2) * step)[:, None]

    def window(self, camera: Camera) -> tuple[range, range]:
        """Which rows and columns may the model's box cover? No other pixel needs a ray."""
        spots = camera.to_pixels(box_corners(self.bounds))[:, :2]
        first, last = np.floor(spots.min(axis=0)) - 1, np.ceil(spots.max(axis=0)) + 1
        (left, right), (top, bottom) = (
            (int(np.clip(first[axis], 0, size)), int(np.clip(last[axis], 0, size)))
            for axis, size in ((0, camera.width), (1, camera.height))
        )
        return range(top, bottom), range(left, right)

    def _corners(self) -> NDArray[np.float32]:
        if self._corner_normals is None:
            self._corner_normals = smooth_normals(self.mesh)
        return self._corner_normals

    def _spread(self, work: Callable[[int], None], items: range) -> None:
        if self._threads == 1 or len(items) == 1:
            for item in items:
                work(item)
            return
        with ThreadPoolExecutor(self._threads) as pool:  # embreex lets go of the interpreter's lock while it traces
            for _ in pool.map(work, items):
                pass


def render_ids(scene: Scene | Mesh, camera: Camera, normals: bool = False) -> IdImage:
    """Which face does each pixel show? For several views of one mesh, make the Scene once and pass that."""
    return (scene if isinstance(scene, Scene) else Scene(scene)).render_ids(camera, normals)


def _interpolate(corners: NDArray[np.float32], hits: _Hits) -> NDArray[np.float32]:
    """Which unit normals are at the hits, between those of the triangles' corners? (N, 3); zero without a hit."""
    result = np.zeros((len(hits.triangle), 3), dtype=np.float32)
    hit = hits.triangle >= 0
    at = corners[hits.triangle[hit]]
    u, v = hits.u[hit, None], hits.v[hit, None]
    mixed = at[:, 0] * (1 - u - v) + at[:, 1] * u + at[:, 2] * v
    length = np.linalg.norm(mixed, axis=1, keepdims=True)
    result[hit] = mixed / np.where(length > 0, length, 1)
    return result
