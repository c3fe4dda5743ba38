"""The same part, stored or placed in another way: does every answer stay what it was?

`python -m benchmark.invariance FILE ... [--change halves] [--share 0.2] [--out FILE]` takes files of questions as in
`benchmark/specified`, changes each model of one body as `CHANGES` says, and asks the same questions of both. A change
keeps what the part is, so an answer that differs is an error of recognition, whatever the truth. It prints per change
how many answers stayed, and how many were right before and after; with `--out` each that differs is a line of a file.
"""

from __future__ import annotations

import argparse
import gzip
import json
import random
import re
import tempfile
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from functools import partial
from itertools import groupby
from pathlib import Path
from typing import Any

from build123d import Axis, Plane, Pos, Shell, Solid, export_step, import_step, mirror, scale
from OCP.BRepBuilderAPI import BRepBuilderAPI_NurbsConvert
from OCP.ShapeUpgrade import ShapeUpgrade_ShapeDivideClosed

from querycad import EmbeddedRuntime
from querycad_segworker.brep.step import quiet
from querycad_segworker.errors import FileProblem

from .understanding.data import Question, asked, is_right

SCALE = 1.7
SIDED = re.compile(
    r"\b(top|bottom|left|right|front|rear|back|upper|lower|above|below|under\w*|beneath|facing|side|[xyz])\b|"
    r"[xyz][- ]|\b(up|down)(wards?)?\b|horizontal|vertical|\bwid|\bdeep|\bdepth|\blong|\blength|\bhigh|\bheight|\btall",
    re.IGNORECASE,
)
"""Words whose meaning may follow the axes of the file."""


def _halves(solid: Solid) -> Solid:
    """Closed faces in two, as several kernels write them."""
    divide = ShapeUpgrade_ShapeDivideClosed(solid.wrapped)
    divide.SetNbSplitPoints(1)
    divide.Perform()
    return Solid(divide.Result())


def _reversed(solid: Solid) -> Solid:
    """The faces in the opposite order."""
    return Solid(Shell(list(reversed(solid.faces()))))


CHANGES: dict[str, Callable[[Solid], Solid]] = {
    "as it was": lambda solid: solid,
    "halves": _halves,
    "splines": lambda solid: Solid(BRepBuilderAPI_NurbsConvert(solid.wrapped, True).Shape()),
    "reversed": _reversed,
    "shifted": lambda solid: Pos(137.3, -41.7, 88.9) * solid,
    "turned": lambda solid: solid.rotate(Axis.Z, 90),
    "tilted": lambda solid: solid.rotate(Axis((0, 0, 0), (1, 2, 3)), 33),
    "mirrored": lambda solid: mirror(solid, Plane.YZ),
    "scaled": lambda solid: scale(solid, SCALE),
}
MOVES = {"turned", "tilted", "mirrored"}
"""Changes after which words of sides and of the three axes mean something else."""
POWERS = {"length": 1, "lengths": 1, "size": 1, "sizes": 1, "area": 2, "areas": 2, "volume": 3, "mass": 3}
"""By which power of the scale a value of a type grows; others stay."""
PLACES = {"point", "points", "direction", "directions"}


def comparable(change: str, one: Question) -> bool:
    """May the answer be expected to stay as it is under this change?"""
    if change == "as it was":
        return True
    if one.kind in PLACES:
        return change in ("halves", "splines", "reversed")
    if change == "scaled":
        return re.search(r"\d", one.question) is None  # a size or a thread that is stated
    return change not in MOVES or SIDED.search(one.question) is None


def read(file: Path) -> Solid | None:
    """The one body of a file, packed or not; none where there are more."""
    with tempfile.NamedTemporaryFile(suffix=".step") as plain:
        data = file.read_bytes()
        plain.write(gzip.decompress(data) if file.suffix == ".gz" else data)
        plain.flush()
        solids = import_step(plain.name).solids()
    return solids[0] if len(solids) == 1 else None


def _of_model(changes: Sequence[str], store: Path, asked_here: Sequence[Question]) -> list[dict[str, Any]]:
    quiet()
    shape = read(asked_here[0].file)
    if shape is None:
        return []
    rows: list[dict[str, Any]] = []
    with tempfile.TemporaryDirectory() as folder, EmbeddedRuntime(store) as runtime:
        before: dict[str, Any] = {}
        for change in changes:
            file = Path(folder) / f"{change}.step"
            try:
                export_step(CHANGES[change](shape), file)
                model = runtime.open(file)
            except (FileProblem, RuntimeError) as problem:
                rows.append({"change": change, "model": asked_here[0].model, "problem": str(problem)})
                continue
            for one in asked_here:
                if not comparable(change, one):
                    continue
                reply = model.ask(one.question)
                value = reply.answer.value if reply.answer is not None else None
                factor = SCALE ** POWERS.get(one.kind, 0) if change == "scaled" else 1.0
                value = _divided(value, factor)
                before.setdefault(one.question, value)
                was = before[one.question]
                same = value == was or (was is not None and is_right(value, replace(one, truth=was, pattern=None)))
                rows.append(
                    {
                        "change": change,
                        "model": one.model,
                        "question": one.question,
                        "truth": one.truth,
                        "was": was,
                        "value": value,
                        "same": same,
                        "right_before": is_right(was, one),
                        "right": is_right(value, one),
                        "confidence": reply.confidence or 0.0,
                    }
                )
    return rows


def _divided(value: Any, factor: float) -> Any:
    if factor == 1.0 or isinstance(value, bool | str) or value is None:
        return value
    if isinstance(value, list | tuple):
        return [_divided(item, factor) for item in value]
    if isinstance(value, dict):
        return {name: _divided(item, factor) for name, item in value.items()}
    return value / factor


def main() -> int:
    """Asks and prints; returns the exit code."""
    parser = argparse.ArgumentParser(prog="python -m benchmark.invariance", description=__doc__)
    parser.add_argument("files", nargs="+", type=Path, help="files as in benchmark/specified")
    parser.add_argument("--change", action="append", choices=list(CHANGES)[1:], help="default: all")
    parser.add_argument("--share", type=float, default=1.0, help="of the models, drawn by seed")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--store", type=Path, default=Path("build/understanding"))
    parser.add_argument("--out", type=Path, help="the answers that differ, a line of JSON each")
    options = parser.parse_args()
    data = sorted((one for file in options.files for one in asked(file)), key=lambda one: one.file)
    groups = [list(of) for _, of in groupby(data, key=lambda one: one.file)]
    groups = random.Random(7).sample(groups, round(options.share * len(groups)))  # noqa: S311 - no secret
    changes = ["as it was", *(options.change or list(CHANGES)[1:])]
    with ProcessPoolExecutor(options.jobs) as pool:
        rows = [row for part in pool.map(partial(_of_model, changes, options.store), groups) for row in part]
    print(f"{'change':<10} {'asked':>6} {'stayed':>7} {'right before':>13} {'right after':>12} {'not read':>9}")
    for change in changes[1:]:
        here = [row for row in rows if row["change"] == change]
        told = [row for row in here if "problem" not in row]
        stayed = sum(row["same"] for row in told) / max(1, len(told))
        right = [sum(row[key] for row in told) for key in ("right_before", "right")]
        print(f"{change:<10} {len(told):>6} {stayed:>7.3f} {right[0]:>13} {right[1]:>12} {len(here) - len(told):>9}")
    if options.out:
        lines = [row for row in rows if "problem" in row or not row["same"]]
        options.out.write_text("".join(json.dumps(row) + "\n" for row in lines), encoding="utf-8")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
