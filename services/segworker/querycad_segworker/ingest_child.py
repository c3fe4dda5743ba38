"""What the child process of `ingest` does: everything that touches the CAD kernel when a file is read."""

from __future__ import annotations

import gc
import json
import mmap
import os
import resource
import shutil
import sys
import time
import traceback
from dataclasses import replace
from pathlib import Path
from typing import BinaryIO

import numpy as np

from querycad_contracts import Face, FileKind, Part, Shape

from .brep.extract import extract
from .brep.files import read_file
from .brep.measure import save_faces
from .brep.tessellate import tessellate
from .errors import FileProblem, UnreadableFile
from .features.faces import faces_of
from .features.recognise import recognise
from .features.sheet.material_thickness import material_thickness
from .files.sniff import kind_of, strange_number
from .mesh import Mesh
from .meshes.files import read_mesh_file
from .meshes.fitting import fitted
from .model import Artefacts, Model
from .orientation import outward
from .topology import Brep
from .vectors import dist
from .visibility.faces import shows_backs, visible_pixels
from .visibility.raycast import Scene
from .visibility.sides import with_sides

LARGEST_SI = 1e12
"""Metres, square or cubic metres: a cube of ten kilometres."""
DAMAGED = "the file is damaged, or not understood: its geometry contradicts itself, and nothing of it can be measured"
LEAST_BYTES = 32 * 2**20
"""What the smallest file needs."""


COPY = "source"


def work(
    opened: BinaryIO, source: str, _folder: str, memory_bytes: int, sha256: str, file_name: str, missing: str
) -> None:
    """As `main`, in the current folder, with arguments as data: what `kernel_host` calls.

    A file that this user may not open, but has open, is copied: the kernel takes paths alone.
    """
    path = Path(source)
    if not os.access(path, os.R_OK):
        path = Path(COPY)
        with path.open("xb") as copy:
            shutil.copyfileobj(opened, copy)
    main(path, file_name, sha256, Path(), memory_bytes, missing)
    Path(COPY).unlink(missing_ok=True)


def main(source: Path, file_name: str, sha256: str, folder: Path, memory_bytes: int, missing: str = "") -> None:
    """Writes the artefacts and `outcome.json` into `folder`. Dies by signal where the kernel does.

    `missing` are the walls that are not up, which the model then tells.
    """
    gc.disable()  # what is made here lives as long as the process: looking through it for garbage finds none
    try:
        _limit_memory(memory_bytes)
        _ingest(source, file_name, sha256, Artefacts(folder), missing)
        outcome: dict[str, str] = {}
    except FileProblem as problem:
        outcome = {"problem": type(problem).__name__, "message": str(problem)}
    except MemoryError:
        outcome = {"problem": "KernelDied", "message": "the file needs more memory than is allowed for reading"}
    except (OSError, ImportError, NameError):
        raise  # of the disk's, the installation's, or the program's own: the parent says so
    except Exception:
        # What a file's text passes for may be no geometry: a face without an area, a body without an edge. The log says
        # where it was noticed; it is the file's fault, as no sound one does this.
        traceback.print_exc()
        outcome = {"problem": "UnreadableFile", "message": DAMAGED}
    (folder / "outcome.json").write_text(json.dumps(outcome), encoding="utf-8")


def _limit_memory(memory_bytes: int) -> None:
    """Raises MemoryError where the libraries leave nothing of it: what fails then may be anything, even the stack."""
    resource.setrlimit(resource.RLIMIT_AS, (memory_bytes, memory_bytes))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    try:
        mmap.mmap(-1, LEAST_BYTES).close()
    except OSError as error:
        raise MemoryError from error


def _ingest(source: Path, file_name: str, sha256: str, artefacts: Artefacts, missing: str) -> None:
    clock = _Clock()
    clock.begin("read")
    kind = kind_of(source)
    if kind is not None and kind.is_mesh:
        brep, triangles, units = _mesh(source, kind, file_name, clock)
    else:
        brep, triangles, units = _kernel_faces(source, kind, file_name, artefacts, clock)
    np.save(artefacts.face_pairs, np.array(brep.face_pairs, dtype=np.int32).reshape(-1, 2))
    mesh = outward(triangles, [body.faces for body in brep.bodies])
    clock.begin("look")
    scene = Scene(mesh)
    replace(mesh, closed=mesh.closed and not shows_backs(scene)).save(artefacts.mesh)
    visibility = visible_pixels(scene, len(brep.faces))
    clock.begin("recognise")
    found = recognise(brep, scene.is_clear, material_thickness(brep, mesh, scene), mesh, scene.ahead)
    faces = faces_of(brep)
    measured: list[Shape | Part | Face] = [found.shape, *found.parts, *faces]
    for what in measured:
        _must_be_bounded(what)
    parts = with_sides(found.parts, brep, scene, visibility)
    clock.end()
    model = Model(
        sha256=sha256,
        file_name=file_name,
        shape=found.shape,
        parts=tuple(parts),
        units=units,
        warnings=(*brep.warnings, *([f"the file was read without these walls: {missing}"] if missing else [])),
        timings_ms=clock.timings_ms,
    )
    artefacts.save(model, faces, found.refused)


def _kernel_faces(
    source: Path, kind: FileKind | None, file_name: str, artefacts: Artefacts, clock: _Clock
) -> tuple[Brep, Mesh, tuple[str, ...]]:
    """The B-rep of a CAD file as the kernel reads it, its tessellation, and the units that it declares."""
    if strange := strange_number(source, kind):
        raise UnreadableFile(f"the file is damaged: {strange}, which is no size of anything")
    content = read_file(source, kind)
    if kind in (FileKind.IGES, FileKind.BREP) or not content.name:  # these have names of entities, not of the model
        content = replace(content, name=_name_of(file_name))
    clock.begin("measure")
    extracted = extract(content)
    save_faces(extracted.faces, artefacts.kernel_faces)
    clock.begin("tessellate")
    return extracted.brep, tessellate(extracted.faces, dist(*extracted.brep.box)), content.units


def _name_of(file_name: str) -> str:
    """What a file without a name in it is called: 'gear-rack' of gear-rack.step.gz."""
    path = Path(file_name)
    return Path(path.stem).stem if path.suffix.lower() in (".gz", ".zip") else path.stem


def _mesh(source: Path, kind: FileKind, file_name: str, clock: _Clock) -> tuple[Brep, Mesh, tuple[str, ...]]:
    """As `_kernel_faces`, of triangles: faces are fitted to them, and nothing is there for the kernel."""
    file = read_mesh_file(source, kind)
    clock.begin("measure")
    brep, triangles = fitted(file, _name_of(file_name))
    return brep, triangles, file.units


def _must_be_bounded(what: Shape | Part | Face) -> None:
    """Raises UnreadableFile for a measure that is not finite, or larger than anything that is made."""
    for name, value in vars(what).items():
        for number in value if isinstance(value, tuple) else (value,):
            if isinstance(number, float) and not abs(number) <= LARGEST_SI:
                which = f"{type(what).__name__.lower()} {getattr(what, 'id', '')}".strip()
                raise UnreadableFile(f"the file is damaged: the {name} of {which} is not finite, or beyond all bounds")


class _Clock:
    """Tells the parent which stage begins, and how long each took."""

    def __init__(self) -> None:
        self.timings_ms: dict[str, float] = {}
        self._stage: str | None = None
        self._start = 0.0

    def begin(self, stage: str) -> None:
        if self._stage is not None:  # the first is told by the parent
            self.end()
            sys.stdout.write(f"stage {stage}\n")
            sys.stdout.flush()
        self._stage, self._start = stage, time.perf_counter()

    def end(self) -> None:
        if self._stage is not None:
            self.timings_ms[self._stage] = round((time.perf_counter() - self._start) * 1e3, 2)
        self._stage = None
