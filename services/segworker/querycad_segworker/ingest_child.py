"""The child process of `ingest`: everything that touches the CAD kernel when a file is read."""

from __future__ import annotations

import gc
import json
import resource
import sys
import time
from pathlib import Path

from .errors import FileProblem
from .model import Artefacts, Model


def main(source: Path, file_name: str, sha256: str, folder: Path, memory_bytes: int) -> None:
    """Writes the artefacts and `outcome.json` into `folder`. Dies by signal where the kernel does."""
    resource.setrlimit(resource.RLIMIT_AS, (memory_bytes, memory_bytes))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    gc.disable()  # what is made here lives as long as the process: looking through it for garbage finds none
    try:
        _ingest(source, file_name, sha256, Artefacts(folder))
        outcome: dict[str, str] = {}
    except FileProblem as problem:
        outcome = {"problem": type(problem).__name__, "message": str(problem)}
    except MemoryError:
        outcome = {"problem": "KernelDied", "message": "the file needs more memory than is allowed for reading"}
    (folder / "outcome.json").write_text(json.dumps(outcome), encoding="utf-8")


def _ingest(source: Path, file_name: str, sha256: str, artefacts: Artefacts) -> None:
    clock = _Clock()
    clock.begin("read")
    import numpy as np

    from .brep.extract import extract
    from .brep.measure import save_faces
    from .brep.step import read_step
    from .brep.tessellate import tessellate

    content = read_step(source)
    clock.begin("measure")
    extracted = extract(content)
    brep = extracted.brep
    save_faces(extracted.faces, artefacts.kernel_faces)
    np.save(artefacts.face_pairs, np.array(brep.face_pairs, dtype=np.int32).reshape(-1, 2))
    clock.begin("tessellate")
    from .vectors import dist

    mesh = tessellate(extracted.faces, dist(*brep.box))
    mesh.save(artefacts.mesh)
    clock.begin("look")
    from .render.raycast import Scene
    from .render.visibility import visible_pixels

    scene = Scene(mesh)
    visibility = visible_pixels(scene, len(brep.faces))
    clock.begin("recognise")
    from .features.recognise import faces_of, recognise
    from .features.thickness import material_thickness
    from .segcad.sides import with_sides

    found = recognise(brep, scene.is_clear, material_thickness(brep, mesh, scene), mesh)
    parts = with_sides(found.parts, brep, scene, visibility)
    clock.end()
    model = Model(
        sha256=sha256,
        file_name=file_name,
        shape=found.shape,
        parts=tuple(parts),
        warnings=brep.warnings,
        timings_ms=clock.timings_ms,
    )
    artefacts.save(model, faces_of(brep))


class _Clock:
    """Tells the parent which stage begins, and how long each took."""

    def __init__(self) -> None:
        self.timings_ms: dict[str, float] = {}
        self._stage: str | None = None
        self._start = 0.0

    def begin(self, stage: str) -> None:
        self.end()
        sys.stdout.write(f"stage {stage}\n")
        sys.stdout.flush()
        self._stage, self._start = stage, time.perf_counter()

    def end(self) -> None:
        if self._stage is not None:
            self.timings_ms[self._stage] = round((time.perf_counter() - self._start) * 1e3, 2)
        self._stage = None


if __name__ == "__main__":
    main(Path(sys.argv[1]), sys.argv[2], sys.argv[3], Path(sys.argv[4]), int(sys.argv[5]))
