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
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from functools import partial
from itertools import groupby
from pathlib import Path
from typing import Any

from OCP.BRep import BRep_Builder
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeSolid, BRepBuilderAPI_NurbsConvert, BRepBuilderAPI_Transform
from OCP.gp import gp_Ax1, gp_Dir, gp_Pnt, gp_Trsf, gp_Vec
from OCP.IFSelect import IFSelect_ReturnStatus
from OCP.ShapeUpgrade import ShapeUpgrade_ShapeDivideClosed
from OCP.STEPControl import STEPControl_Reader, STEPControl_StepModelType, STEPControl_Writer
from OCP.TopAbs import TopAbs_ShapeEnum
from OCP.TopExp import TopExp_Explorer
from OCP.TopoDS import TopoDS, TopoDS_Shape, TopoDS_Shell

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


def _solids(shape: TopoDS_Shape) -> list[TopoDS_Shape]:
    return list(_each(shape, TopAbs_ShapeEnum.TopAbs_SOLID))


def _each(shape: TopoDS_Shape, kind: TopAbs_ShapeEnum) -> Iterator[TopoDS_Shape]:
    explorer = TopExp_Explorer(shape, kind)
    while explorer.More():
        yield explorer.Current()
        explorer.Next()


def _halves(shape: TopoDS_Shape) -> TopoDS_Shape:
    """Closed faces in two, as several kernels write them."""
    divide = ShapeUpgrade_ShapeDivideClosed(shape)
    divide.SetNbSplitPoints(1)
    divide.Perform()
    return divide.Result()


def _splines(shape: TopoDS_Shape) -> TopoDS_Shape:
    """Every surface and curve as a B-spline."""
    return BRepBuilderAPI_NurbsConvert(shape, True).Shape()


def _reversed(shape: TopoDS_Shape) -> TopoDS_Shape:
    """The faces in the opposite order."""
    builder = BRep_Builder()
    (solid,) = _solids(shape)
    made = BRepBuilderAPI_MakeSolid()
    for old in _each(solid, TopAbs_ShapeEnum.TopAbs_SHELL):
        shell = TopoDS_Shell()
        builder.MakeShell(shell)
        for face in reversed(list(_each(old, TopAbs_ShapeEnum.TopAbs_FACE))):
            builder.Add(shell, face)
        shell.Closed(True)
        made.Add(TopoDS.Shell(shell.Oriented(old.Orientation())))
    return made.Solid()


def _moved(transform: gp_Trsf, shape: TopoDS_Shape) -> TopoDS_Shape:
    return BRepBuilderAPI_Transform(shape, transform, True).Shape()


def _turn(degrees: float, *axis: float) -> gp_Trsf:
    transform = gp_Trsf()
    transform.SetRotation(gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(*axis)), degrees * 3.141592653589793 / 180)
    return transform


def _shift() -> gp_Trsf:
    transform = gp_Trsf()
    transform.SetTranslation(gp_Vec(137.3, -41.7, 88.9))
    return transform


def _scale() -> gp_Trsf:
    transform = gp_Trsf()
    transform.SetScale(gp_Pnt(0, 0, 0), SCALE)
    return transform


def _mirror() -> gp_Trsf:
    transform = gp_Trsf()
    transform.SetMirror(gp_Pnt(0, 0, 0))
    return transform


CHANGES: dict[str, Callable[[TopoDS_Shape], TopoDS_Shape]] = {
    "as it was": lambda shape: shape,
    "halves": _halves,
    "splines": _splines,
    "reversed": _reversed,
    "shifted": partial(_moved, _shift()),
    "turned": partial(_moved, _turn(90, 0, 0, 1)),
    "tilted": partial(_moved, _turn(33, 1, 2, 3)),
    "mirrored": partial(_moved, _mirror()),
    "scaled": partial(_moved, _scale()),
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


def read_step(file: Path) -> TopoDS_Shape | None:
    """The one body of a file, or nothing where there are more."""
    with tempfile.NamedTemporaryFile(suffix=".step") as plain:
        data = file.read_bytes()
        plain.write(gzip.decompress(data) if file.suffix == ".gz" else data)
        plain.flush()
        reader = STEPControl_Reader()
        if reader.ReadFile(plain.name) != IFSelect_ReturnStatus.IFSelect_RetDone:
            return None
        reader.TransferRoots()
        solids = _solids(reader.OneShape())
    return solids[0] if len(solids) == 1 else None


def write_step(shape: TopoDS_Shape, file: Path) -> None:
    """Writes a shape, in millimetres."""
    writer = STEPControl_Writer()
    writer.Transfer(shape, STEPControl_StepModelType.STEPControl_AsIs)
    writer.Write(str(file))


def _of_model(changes: Sequence[str], store: Path, asked_here: Sequence[Question]) -> list[dict[str, Any]]:
    quiet()
    shape = read_step(asked_here[0].file)
    if shape is None:
        return []
    rows: list[dict[str, Any]] = []
    with tempfile.TemporaryDirectory() as folder, EmbeddedRuntime(store) as runtime:
        before: dict[str, Any] = {}
        for change in changes:
            file = Path(folder) / f"{change}.step"
            try:
                write_step(CHANGES[change](shape), file)
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
