"""Which face does each pixel show? The same images as `raycast`, drawn by OpenGL without a window (moderngl on EGL).

One context serves all scenes of a process. It is made with the first scene, so after a worker's fork, and is never
used in another process or by two threads at once. Before a driver is trusted, a small scene with a known image is
drawn by it and by rays: one that disagrees counts as no OpenGL at all.
"""

from __future__ import annotations

import logging
import os
import threading
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from querycad_segworker.mesh import Mesh

from .cameras import Camera, isometric_camera
from .normals import smooth_normals
from .raycast import BACKGROUND, FaceIds, IdImage, Scene, id_type

ALIKE = 0.995
"""Share of pixels that a driver must draw as rays show them; rounding may decide about the rest, on silhouettes."""

TRIANGLES_AT_ONCE = 1 << 15
"""A software rasteriser keeps all triangles of a call before it draws them: so many take some 5 MB."""

_VERTEX = """
#version 330 core
uniform mat4 to_clip;
in vec3 position;
in int owner;
flat out int face_id;
#ifdef NORMALS
in vec3 normal;
out vec3 world_normal;
#endif
void main() {
    gl_Position = to_clip * vec4(position, 1.0);
    face_id = owner;
#ifdef NORMALS
    world_normal = normal;
#endif
}
"""
_FRAGMENT = """
#version 330 core
flat in int face_id;
layout(location = 0) out uint face;
#ifdef NORMALS
uniform vec3 backward;
in vec3 world_normal;
layout(location = 1) out vec4 towards_viewer;
#endif
void main() {
    face = uint(face_id + 1);
#ifdef NORMALS
    float size = length(world_normal);
    vec3 unit = size > 0.0 ? world_normal / size : vec3(0.0);
    towards_viewer = vec4(dot(unit, backward) < 0.0 ? -unit : unit, 0.0);
#endif
}
"""
"""The face travels with the corners: a look-up by triangle costs a software rasteriser half as much again."""

_log = logging.getLogger(__name__)


class GlUnavailable(Exception):
    """There is no OpenGL on this machine that draws without a window as it should; the message says why."""


@dataclass(slots=True)
class _Context:
    """moderngl's context with what is made once for it."""

    ctx: Any
    process: int
    programs: dict[bool, Any]
    """With normals, and without."""
    target: tuple[tuple[tuple[int, int], str, bool], Any] | None = None
    """The frame buffer drawn into last, and what is told of it below."""

    def target_of(self, size: tuple[int, int], kind: str, normals: bool) -> Any:
        """A frame buffer of this size, with ids of this kind; the last one is kept, as views come in series."""
        if self.target is None or self.target[0] != (size, kind, normals):
            self.target = None
            self.ctx.gc()
            colors = [self.ctx.texture(size, 1, dtype=kind)]
            colors += [self.ctx.texture(size, 4, dtype="f2")] if normals else []
            self.target = ((size, kind, normals), self.ctx.framebuffer(colors, self.ctx.depth_texture(size)))
        return self.target[1]


@dataclass(slots=True)
class _Process:
    """What there is of OpenGL in this process."""

    found: _Context | GlUnavailable | None = None
    """None before the first scene."""
    lock: threading.RLock = field(default_factory=threading.RLock)

    def after_fork(self) -> None:
        """A driver whose threads stayed behind in the parent process would wait for them for ever."""
        self.lock = threading.RLock()
        if isinstance(self.found, _Context):
            self.found = GlUnavailable("the process was forked after OpenGL was begun with")


_process = _Process()
os.register_at_fork(after_in_child=_process.after_fork)


class GlScene:
    """A mesh ready to be drawn by OpenGL. Raises GlUnavailable. Only for the process that made it."""

    def __init__(self, mesh: Mesh, context: _Context | None = None) -> None:
        self.mesh = mesh
        self.bounds = mesh.bounds
        low, high = self.bounds
        self._center: NDArray[np.float64] = (low + high) / 2
        self._radius = float(np.linalg.norm(high - low) / 2) or 1.0
        self._context = context or _context()
        self._drawn: dict[bool, Any] = {}

    def render_ids(self, camera: Camera, normals: bool = False) -> IdImage:
        """Which face does each pixel of `camera` show, and how far away?"""
        if self._context.process != os.getpid():
            raise RuntimeError("a scene of OpenGL was made before the process was forked")
        size = (camera.height, camera.width)
        if not len(self.mesh.triangles):
            directions = np.zeros((*size, 3), dtype=np.float32) if normals else None
            background = np.full(size, BACKGROUND, dtype=id_type(self.mesh))
            return IdImage(camera, background, np.full(size, np.inf, dtype=np.float32), directions)
        with _process.lock, self._context.ctx as ctx:
            ctx.gc()  # what scenes that are gone have left
            faces, depth, directions = self._draw(ctx, camera, normals)
        faces -= 1
        depth *= np.float32(camera.range_m)
        np.copyto(depth, np.float32(np.inf), where=faces == BACKGROUND)
        return IdImage(camera, faces, depth, directions)

    def _draw(
        self, ctx: Any, camera: Camera, normals: bool
    ) -> tuple[FaceIds, NDArray[np.float32], NDArray[np.float32] | None]:
        """Faces, counted from 1 with 0 for the background; depths from 0 to 1; and normals, where asked for."""
        ids = id_type(self.mesh)
        kind = f"u{ids.itemsize}"
        target = self._context.target_of((camera.width, camera.height), kind, normals)
        target.use()
        target.clear(depth=1.0)
        ctx.enable_only(ctx.DEPTH_TEST | (ctx.CULL_FACE if self.mesh.closed else 0))
        ctx.front_face = "cw"  # as rows run downwards; what is culled are backs, which fronts hide
        program = self._context.programs[normals]
        program["to_clip"].write(self._to_clip(camera).T.astype(np.float32).tobytes())
        if normals:
            program["backward"].value = camera.backward
        array, corners = self._array(normals), 3 * len(self.mesh.triangles)
        for first in range(0, corners, 3 * TRIANGLES_AT_ONCE):
            array.render(ctx.TRIANGLES, first=first, vertices=min(corners - first, 3 * TRIANGLES_AT_ONCE))
            ctx.finish()
        size = (camera.height, camera.width)
        depth, faces = np.empty(size, dtype=np.float32), np.empty(size, dtype=ids)
        target.read_into(depth, components=1, attachment=-1, dtype="f4")
        target.read_into(faces, components=1, attachment=0, dtype=kind)
        if not normals:
            return faces, depth, None
        half = np.empty((*size, 4), dtype=np.float16)
        target.read_into(half, components=4, attachment=1, dtype="f2")
        return faces, depth, half[..., :3].astype(np.float32)

    def _array(self, normals: bool) -> Any:
        """What is drawn, put into the driver's memory once: the triangles, with or without a normal at each corner."""
        if normals not in self._drawn:
            ctx, mesh, program = self._context.ctx, self.mesh, self._context.programs[normals]
            points = np.subtract(mesh.vertices_m, self._center)
            points = np.divide(points, self._radius, out=points).astype(np.float32)
            owner = _owners(mesh)
            if normals or owner is None:
                content = [
                    (ctx.buffer(points[mesh.triangles]), "3f", "position"),
                    (ctx.buffer(np.repeat(mesh.triangle_face, 3)), "i", "owner"),
                ]
                if normals:
                    content.append((ctx.buffer(smooth_normals(mesh)), "3f", "normal"))
                self._drawn[normals] = ctx.vertex_array(program, content)
            else:
                content = [(ctx.buffer(points), "3f", "position"), (ctx.buffer(owner), "i", "owner")]
                self._drawn[normals] = ctx.vertex_array(program, content, ctx.buffer(mesh.triangles))
        return self._drawn[normals]

    def _to_clip(self, camera: Camera) -> NDArray[np.float64]:
        """Which matrix takes scaled points to clip space? (4, 4); rows downwards, as arrays hold them."""
        right, up, backward = camera.axes
        across, down, deep = (
            2 / (camera.width * camera.pixel_m),
            2 / (camera.height * camera.pixel_m),
            2 / camera.range_m,
        )
        linear = np.stack([right * across, -up * down, -backward * deep])
        matrix = np.eye(4)
        matrix[:3, :3] = linear * self._radius
        matrix[:3, 3] = linear @ (self._center - np.array(camera.eye_m)) - (0.0, 0.0, 1.0)
        return matrix


def _context() -> _Context:
    """The context of this process, made now if it has none yet. Raises GlUnavailable, each time."""
    with _process.lock:
        if _process.found is None:
            try:
                _process.found = _make()
            except GlUnavailable as reason:
                _process.found = reason
                _log.info("%s; rays draw instead", reason)
        if isinstance(_process.found, GlUnavailable):
            raise _process.found
        return _process.found


def _make() -> _Context:
    os.environ.setdefault("EGL_LOG_LEVEL", "fatal")  # Mesa tells of every device that it does not find
    try:
        import moderngl

        settings: dict[str, Any] = {"backend": "egl"}
        ctx = moderngl.create_context(require=330, standalone=True, **settings)
        ctx.gc_mode = "context_gc"
        programs = {
            normals: ctx.program(_source(_VERTEX, normals), _source(_FRAGMENT, normals)) for normals in (False, True)
        }
        made = _Context(ctx, os.getpid(), programs)
        alike = _agreement(made)
    except Exception as error:  # each layer has errors of its own: loader, EGL, driver
        raise GlUnavailable(f"no OpenGL without a window: {error}") from error
    if alike < ALIKE:
        raise GlUnavailable(
            f"OpenGL ({ctx.info['GL_RENDERER']}) draws only {alike:.1%} of the pixels as rays show them"
        )
    return made


def _agreement(context: _Context) -> float:
    """Which share of a known picture's pixels does this driver draw as rays show them? Faces, depths and normals.

    The picture: a square behind two triangles that pass through each other, seen from a corner.
    """
    corners = [(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, 0, -1), (1, 0, -1), (0, 0, 1), (0, -1, -1)]
    vertices = np.array([*corners, (0, 1, -1)], dtype=np.float64)
    triangles = np.array([(0, 1, 2), (0, 2, 3), (4, 5, 6), (7, 8, 6)], dtype=np.int32)
    mesh = Mesh(vertices, triangles, np.array([0, 0, 1, 2], dtype=np.int32))
    camera = isometric_camera(mesh.bounds, 320, 180)
    drawn, cast = (scene.render_ids(camera, normals=True) for scene in (GlScene(mesh, context), Scene(mesh, threads=1)))
    same = drawn.face_id_map == cast.face_id_map
    shown = same & (cast.face_id_map != BACKGROUND)
    assert drawn.normals is not None and cast.normals is not None  # noqa: PT018 - both were asked for
    same[shown] = (np.abs(drawn.depth_m[shown] - cast.depth_m[shown]) < 1e-3) & (
        np.abs(drawn.normals[shown] - cast.normals[shown]).max(axis=1) < 1e-2
    )
    return float(same.mean())


def _owners(mesh: Mesh) -> NDArray[np.int32] | None:
    """Which face does each vertex belong to? (V,) int32; None where faces share vertices."""
    owner = np.zeros(len(mesh.vertices_m), dtype=np.int32)
    owner[mesh.triangles] = mesh.triangle_face[:, None]
    return owner if (owner[mesh.triangles] == mesh.triangle_face[:, None]).all() else None


def _source(text: str, normals: bool) -> str:
    head, _, rest = text.strip().partition("\n")
    return f"{head}\n{'#define NORMALS' if normals else ''}\n{rest}"
