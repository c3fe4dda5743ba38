"""How much of a CAD model is left in its mesh? `python -m benchmark.meshes FILE.step …` prints a table.

Each model is read as it is, and once more from an STL file that the kernel makes of it, at chord errors of 0.1 and
0.01 mm and no more than 0.5 rad between facets. What STEP gives is the truth: a hole is the same one where diameter and
depth agree within a tenth of the chord error and its middle within the chord error; overall size and volume are
compared in parts per million.
"""

from __future__ import annotations

import argparse
import math
import sys
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from OCP.BRepMesh import BRepMesh_IncrementalMesh
from OCP.StlAPI import StlAPI_Writer

from querycad_contracts import Part, PartKind
from querycad_segworker.brep.step import read_step
from querycad_segworker.errors import FileProblem
from querycad_segworker.ingest import ingest
from querycad_segworker.model import Model, ModelStore

CHORDS_MM = (0.1, 0.01)
MOST_TURN_RAD = 0.5
"""Between facets: what programs set that leave the kernel its own."""
MM = 1e-3
COMPARED = (PartKind.HOLE, PartKind.STEP, PartKind.POCKET, PartKind.SLOT, PartKind.FILLET, PartKind.CHAMFER)
"""Kinds that are counted; of holes the measures are compared too."""


@dataclass(frozen=True, slots=True)
class Compared:
    """One model at one chord error: how many of a kind there are, are found, and are found beside them."""

    name: str
    chord_mm: float
    faces: tuple[int, int]
    counts: dict[PartKind, tuple[int, int]]
    holes: tuple[int, int, int]
    """In STEP, the same ones in the mesh, and others there."""
    size_ppm: float
    volume_ppm: float
    read_s: float


def compare(path: Path, chord_mm: float, store: ModelStore, folder: Path) -> Compared:
    """What is left of the model in its mesh? Raises FileProblem where one of both cannot be read."""
    truth = ingest(path, store)
    mesh = folder / f"{path.stem}-{chord_mm}.stl"
    write_stl(path, mesh, chord_mm)
    found = ingest(mesh, store)
    one, other = truth.load_model(), found.load_model()
    return Compared(
        path.stem,
        chord_mm,
        (len(truth.load_faces()), len(found.load_faces())),
        {kind: (len(_of(one, kind)), len(_of(other, kind))) for kind in COMPARED},
        _matched(_of(one, PartKind.HOLE), _of(other, PartKind.HOLE), _same_hole(chord_mm * MM)),
        1e6 * max(abs(b / a - 1) for a, b in zip(one.shape.extents, other.shape.extents, strict=True)),
        1e6 * abs(other.shape.volume / one.shape.volume - 1) if one.shape.volume else math.nan,
        sum(other.timings_ms.values()) / 1e3,
    )


def write_stl(step: Path, path: Path, chord_mm: float) -> None:
    """Writes the binary STL file of a model."""
    shape = read_step(step).shape
    BRepMesh_IncrementalMesh(shape, chord_mm, False, MOST_TURN_RAD, False)
    writer = StlAPI_Writer()
    writer.ASCIIMode = False
    if not writer.Write(shape, str(path)):
        raise OSError(f"{path} could not be written")


def _of(model: Model, kind: PartKind) -> list[Part]:
    return [part for part in model.parts if part.kind is kind]


def _same_hole(chord_m: float) -> Callable[[Part, Part], bool]:
    def same(a: Part, b: Part) -> bool:
        sizes = [(a.diameter, b.diameter), (a.depth, b.depth)]
        alike = all((x is None) == (y is None) and abs((x or 0) - (y or 0)) <= 0.1 * chord_m for x, y in sizes)
        return alike and math.dist(a.center, b.center) <= chord_m

    return same


def _matched(truth: Sequence[Part], found: Sequence[Part], same: Callable[[Part, Part], bool]) -> tuple[int, int, int]:
    left = list(found)
    for part in truth:
        match = next((each for each in left if same(part, each)), None)
        if match is not None:
            left.remove(match)
    return len(truth), len(found) - len(left), len(left)


def table(rows: Sequence[Compared]) -> str:
    """As Markdown."""
    head = [
        "model",
        "chord, mm",
        "faces",
        *(kind.value + "s" for kind in COMPARED),
        "holes alike",
        "size, ppm",
        "volume, ppm",
        "read, s",
    ]
    lines = [head, ["---", "--:", *("---" for _ in COMPARED), "---", "---", "--:", "--:", "--:"]]
    for row in rows:
        counts = [_both(*row.counts[kind]) for kind in COMPARED]
        holes = f"{row.holes[1]} of {row.holes[0]}" + (f", {row.holes[2]} others" if row.holes[2] else "")
        numbers = [f"{row.size_ppm:.0f}", f"{row.volume_ppm:.0f}", f"{row.read_s:.1f}"]
        lines.append([row.name, f"{row.chord_mm:g}", _both(*row.faces), *counts, holes, *numbers])
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def _both(truth: int, found: int) -> str:
    return f"{truth}" if truth == found else f"{truth} / {found}"


def main(arguments: Sequence[str] | None = None) -> int:
    """Prints a row a model and chord error, and the sum of the holes."""
    parser = argparse.ArgumentParser(prog="python -m benchmark.meshes", description=__doc__)
    parser.add_argument("files", nargs="+", type=Path, metavar="FILE.step")
    files = parser.parse_args(arguments).files
    rows: list[Compared] = []
    with tempfile.TemporaryDirectory() as folder:
        store = ModelStore(Path(folder) / "store")
        for path in files:
            for chord in CHORDS_MM:
                try:
                    rows.append(compare(path, chord, store, Path(folder)))
                except FileProblem as problem:
                    sys.stderr.write(f"{path}: {problem}\n")
    sys.stdout.write(table(rows) + "\n")
    for chord in CHORDS_MM:
        there, same, others = (sum(row.holes[k] for row in rows if row.chord_mm == chord) for k in range(3))
        sys.stdout.write(f"\nAt {chord:g} mm: {same} of {there} holes alike, {others} others.\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
