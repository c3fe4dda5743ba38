"""The same part, stored or placed in another way: are the same features recognised?

`python -m benchmark.part_invariance FILE ... [--change halves] [--share 0.2] [--out FILE]` takes STEP files, packed or
not, changes each of one body as `invariance.CHANGES` says, and compares what is recognised: kinds, attributes and
sizes, without places. No labels are needed: a difference is an error of recognition in one of the two. It prints per
change how many models differ, and how many parts; with `--out` each that differs is a line of a file.
"""

from __future__ import annotations

import argparse
import json
import math
import random
import tempfile
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

from build123d import export_step

from querycad_contracts import Part
from querycad_segworker.brep.step import quiet
from querycad_segworker.errors import FileProblem
from querycad_segworker.ingest import ingest
from querycad_segworker.model import ModelStore

from .invariance import CHANGES, MOVES, SCALE, read

LENGTHS = (
    *("radius", "depth", "width", "length", "thickness", "pitch", "outer_diameter", "inner_diameter"),
    *("tube_diameter", "across_flats", "center_length", "chamfer_size", "bend_radius", "mouth_length", "mouth_width"),
)
NUMBERS = ("count", "angle", "draft")
PLACED = {
    *("vertical", "horizontal", "oblique", "upright", "lying", "inclined", "grounded", "roof", "foot"),
    *("symmetric_x", "symmetric_y", "symmetric_z"),
}
"""Attributes that follow the axes of the file."""
ALONG_AXES = ("body", "model")
"""Kinds whose sizes do."""
SAME = 1e-3
"""Relative; what a file's rounding changes is far below."""


class _Trait(NamedTuple):
    """A part without its place: its kind, its attributes, and its sizes by name, in metres or radians."""

    kind: str
    tags: tuple[str, ...]
    sizes: dict[str, float]

    def same(self, other: _Trait) -> bool:
        """Are two parts one, for all that can be said of them?"""
        return (self.kind, self.tags, self.sizes.keys()) == (other.kind, other.tags, other.sizes.keys()) and all(
            math.isclose(size, other.sizes[name], rel_tol=SAME, abs_tol=1e-7) for name, size in self.sizes.items()
        )


def _trait(part: Part, change: str) -> _Trait:
    scale = SCALE if change == "scaled" else 1.0
    tags = tuple(sorted(part.tags))
    sizes = {name: getattr(part, name) / scale for name in LENGTHS if getattr(part, name) is not None}
    sizes |= {name: float(getattr(part, name)) for name in NUMBERS if getattr(part, name) is not None}
    return _Trait(str(part.kind), tags, sizes)


def _placeless(trait: _Trait) -> _Trait:
    sizes = {} if trait.kind in ALONG_AXES else trait.sizes
    return _Trait(trait.kind, tuple(tag for tag in trait.tags if tag not in PLACED), sizes)


def different(before: Sequence[_Trait], after: Sequence[_Trait]) -> tuple[list[_Trait], list[_Trait]]:
    """Those that only one of two models has: lost, new."""
    lost, new = list(before), list[_Trait]()
    for trait in after:
        known = next((one for one in lost if one.same(trait)), None)
        if known is None:
            new.append(trait)
        else:
            lost.remove(known)
    return lost, new


def _of_model(changes: Sequence[str], file: Path) -> list[dict[str, Any]]:
    quiet()
    shape = read(file)
    if shape is None:
        return []
    rows: list[dict[str, Any]] = []
    before: list[_Trait] = []
    with tempfile.TemporaryDirectory() as folder:
        store = ModelStore(Path(folder) / "store")
        for change in ("as it was", *changes):
            step = Path(folder) / f"{change}.step"
            try:
                export_step(CHANGES[change](shape), step)
                parts = ingest(step, store).load_model().parts
            except (FileProblem, RuntimeError, TypeError) as problem:
                rows.append({"file": str(file), "change": change, "problem": str(problem)})
                continue
            traits = [_trait(part, change) for part in parts]
            if change == "as it was":
                before = traits
                continue
            both = (before, traits) if change not in MOVES else (map(_placeless, before), map(_placeless, traits))
            lost, new = different(*map(list, both))
            rows.append({"file": str(file), "change": change, "parts": len(parts), "lost": lost, "new": new})
    return rows


def main() -> int:
    """Compares and prints; returns the exit code."""
    parser = argparse.ArgumentParser(prog="python -m benchmark.part_invariance", description=__doc__)
    parser.add_argument("files", nargs="+", type=Path, help="STEP files, packed or not")
    parser.add_argument("--change", action="append", choices=list(CHANGES)[1:], help="default: all")
    parser.add_argument("--share", type=float, default=1.0, help="of the files, drawn by seed")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--out", type=Path, help="the models that differ, a line of JSON each")
    options = parser.parse_args()
    files = random.Random(7).sample(options.files, round(options.share * len(options.files)))  # noqa: S311 - no secret
    changes = options.change or list(CHANGES)[1:]
    with ProcessPoolExecutor(options.jobs) as pool:
        rows = [row for part in pool.map(partial(_of_model, changes), files) for row in part]
    print(f"{'change':<10} {'models':>7} {'differ':>7} {'parts':>7} {'lost':>6} {'new':>6} {'not read':>9}")
    for change in changes:
        here = [row for row in rows if row["change"] == change]
        told = [row for row in here if "problem" not in row]
        differ = sum(bool(row["lost"] or row["new"]) for row in told)
        parts = sum(row["parts"] for row in told)
        lost, new = (sum(len(row[which]) for row in told) for which in ("lost", "new"))
        print(f"{change:<10} {len(told):>7} {differ:>7} {parts:>7} {lost:>6} {new:>6} {len(here) - len(told):>9}")
    if options.out:
        lines = [row for row in rows if "problem" in row or row["lost"] or row["new"]]
        options.out.write_text("".join(json.dumps(row) + "\n" for row in lines), encoding="utf-8")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
