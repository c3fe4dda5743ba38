"""One measurement of looking, start and imports not counted: `perf_vision_child views|rays ARTEFACTS`.

Both ways find the faces of 20 masks in six views of 1920x1080. `views`: as the vision path does, the model's way into
the driver's memory included. `rays`: one ray a pixel, through trimesh's binding of Embree, whose hierarchy is built
before the clock starts. Prints one JSON object: seconds, processor seconds, and the memory that the way takes at its
worst on top of what the process held before.
"""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import trimesh
from numpy.typing import NDArray
from trimesh.ray.ray_pyembree import RayMeshIntersector

from querycad_segworker.mesh import Mesh
from querycad_segworker.model import Artefacts
from querycad_segworker.segcad.align import align
from querycad_segworker.segcad.ports import VisionOptions
from querycad_segworker.segcad.render import cameras, render
from querycad_segworker.visibility.cameras import Camera
from querycad_segworker.visibility.raycast import BACKGROUND
from querycad_segworker.visibility.renderer import make_renderer

OPTIONS = VisionOptions()
MASKS = 20
SEED = 7


def main(what: str, folder: Path) -> None:
    """Measures one way."""
    artefacts = Artefacts(folder)
    mesh, face_count = Mesh.load(artefacts.mesh), artefacts.load_model().shape.face_count
    masks = _masks()
    work = _views(mesh, face_count, masks) if what == "views" else _rays(mesh, face_count, masks)
    held = _status("VmRSS")
    Path("/proc/self/clear_refs").write_text("5", encoding="ascii")  # the peak begins anew
    start, cpu = time.perf_counter(), time.process_time()
    work()
    seconds, cpu_seconds = time.perf_counter() - start, time.process_time() - cpu
    memory = max(0, _status("VmHWM") - held)
    print(json.dumps({"seconds": seconds, "cpu_seconds": cpu_seconds, "memory_bytes": memory}))


def _masks() -> NDArray[np.bool_]:
    """Ellipses of all sizes, the same for every view and run."""
    random = np.random.default_rng(SEED)
    rows, columns = np.ogrid[: OPTIONS.height, : OPTIONS.width]
    masks = np.zeros((MASKS, OPTIONS.height, OPTIONS.width), dtype=np.bool_)
    for mask in masks:
        x, y = random.uniform(0.2, 0.8, 2) * (OPTIONS.width, OPTIONS.height)
        a, b = random.uniform(0.02, 0.15, 2) * OPTIONS.height
        mask[:] = ((columns - x) / a) ** 2 + ((rows - y) / b) ** 2 < 1
    return masks


def _views(mesh: Mesh, face_count: int, masks: NDArray[np.bool_]) -> Callable[[], None]:
    """The vision path's own way. A driver compiles its programs once a process: not counted."""
    tiny = Mesh(np.eye(3), np.array([[0, 1, 2]], dtype=np.int32), np.zeros(1, dtype=np.int32))
    list(render(make_renderer(tiny), 1, VisionOptions(width=64, height=64)))

    def work() -> None:
        for view in render(make_renderer(mesh), face_count, OPTIONS):
            align(view, masks, OPTIONS)
            del view

    return work


def _rays(mesh: Mesh, face_count: int, masks: NDArray[np.bool_]) -> Callable[[], None]:
    """The plain way: every pixel's ray, its triangle, its face; then every mask over every face."""
    solid = trimesh.Trimesh(mesh.vertices_m, mesh.triangles, process=False)
    caster = RayMeshIntersector(solid)
    caster.intersects_first(np.zeros((1, 3)), np.ones((1, 3)))
    face_of = np.append(mesh.triangle_face, BACKGROUND)

    def work() -> None:
        for camera in cameras(mesh.bounds, OPTIONS):
            origins, directions = _primary(camera)
            ids = face_of[caster.intersects_first(origins, directions)].reshape(camera.height, camera.width)
            visible = np.bincount(ids[ids >= 0], minlength=face_count)
            for mask in masks:
                masked = np.bincount(ids[mask & (ids >= 0)], minlength=face_count)
                np.flatnonzero(masked > OPTIONS.face_share * visible)

    return work


def _primary(camera: Camera) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    rows, columns = np.mgrid[: camera.height, : camera.width]
    pixels = np.stack([columns.ravel() + 0.5, rows.ravel() + 0.5, np.zeros(rows.size)], axis=1)
    return camera.to_world(pixels), np.tile(-np.array(camera.backward), (rows.size, 1))


def _status(name: str) -> int:
    """A figure of this process in bytes, as Linux tells it."""
    for line in Path("/proc/self/status").read_text(encoding="ascii").splitlines():
        if line.startswith(f"{name}:"):
            return int(line.split()[1]) * 1024
    raise KeyError(name)


if __name__ == "__main__":
    main(sys.argv[1], Path(sys.argv[2]))
