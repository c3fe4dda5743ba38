"""All questions with a known truth, in one form: model, writer, question, truth."""

from __future__ import annotations

import ast
import json
import math
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from benchmark.scoring.own_models import LAST_LOOK, MODELS

SHARED = Path("../shared")
SPECIFIED = Path("benchmark/specified/models")
UNREAD = frozenset((
    "cell_task_writer", "fixture_integrator", "hardware_user", "mating_part_designer", "path_programmer",
    "polite_replacer", "robot_teacher", "sample_rebuilder", "spare_part_orderer", "special_machine_designer",
    "supplier_file_opener", "test_part_checker", "voice_mechanic", "welded_part_reviewer",
))  # fmt: skip
"""Writers of `benchmark/specified` and `benchmark/asked` whose questions nobody has read: nothing is fitted on them."""
MISSING = "absent"
"""The kind of a question about what its model does not have: the right answer is to say so."""
SI = {
    "mm": 1e-3, "m": 1.0, "in": 0.0254, "inch": 0.0254, "cm": 1e-2, "deg": math.pi / 180, "rad": 1.0, "mm2": 1e-6,
    "mm3": 1e-9, "in3": 0.0254**3, "cm3": 1e-6, "g": 1e-3, "kg": 1.0, "lb": 0.45359237, "count": 1, "": 1,
}  # fmt: skip


@dataclass(frozen=True, slots=True)
class Question:
    """One question. `writer` is who asked; folds leave out whole writers and whole models."""

    model: str
    file: Path
    writer: str
    question: str
    truth: Any
    kind: str
    """A type of `querycad_contracts.AnswerType`, or 'mass'."""
    pattern: str | None = None
    """A regular expression that the value must match, as CAD-Q&A has some."""


def questions(held_out: bool = False) -> list[Question]:
    """All that may be looked at; with `held_out` those that never were."""
    found = [*_own(held_out), *([] if held_out else _others())]
    return [one for one in found if one.file.is_file()]


def _others() -> Iterator[Question]:
    yield from _examples()
    for folder in ("asked", "specified", "reworded", "missing"):
        for path in sorted(Path("benchmark", folder).glob("*.json")):
            if path.stem not in UNREAD:
                yield from asked(path)
    yield from _facts()
    yield from _published()


def _own(held_out: bool) -> Iterator[Question]:
    for path in sorted(Path("benchmark/questions").glob("*.json")):
        data = json.loads(path.read_text(encoding="utf-8"))
        if (data["split"] == "held_out") != held_out:
            continue
        for item in data["items"]:
            yield Question(
                f"own:{path.stem}",
                MODELS / data["model"],
                item.get("writer", "own"),
                item["question"],
                item["value"],
                item["type"],
            )


def _examples() -> Iterator[Question]:
    for path in sorted(Path("examples").glob("*.questions.json")):
        data = json.loads(path.read_text(encoding="utf-8"))
        name = path.name.removesuffix(".questions.json")
        for item in data["items"] if isinstance(data, dict) else data:
            yield Question(
                f"own:{name}",
                Path("examples") / f"{name}.step",
                "examples",
                item["question"],
                item["value"],
                item["type"],
            )


def model_file(model: str) -> Path:
    """Where is the file of 'own:name', 'shared:path', 'sealed:name' or 'specified:name'?"""
    where, _, name = model.partition(":")
    if where == "shared":
        return SHARED / name
    if where == "sealed":
        return LAST_LOOK / f"{name}.step"
    if where == "specified":
        return SPECIFIED / f"{name}.step.gz"
    example = Path("examples") / f"{name}.step"
    return example if example.is_file() else MODELS / f"{name}.step"


def asked(path: Path) -> Iterator[Question]:
    """The questions of one hand."""
    data = json.loads(path.read_text(encoding="utf-8"))
    for item in data["items"]:
        yield Question(
            item["model"], model_file(item["model"]), data["hand"], item["question"], item["value"], item["type"]
        )


def _facts() -> Iterator[Question]:
    for path in sorted((SHARED / "facts-dev").glob("*/ground_truth.json")):
        for model in json.loads(path.read_text(encoding="utf-8"))["models"]:
            file = path.parent / model["file"]
            for fact in model["facts"]:
                answer = fact["answer"]
                scale = SI[fact["unit"]]
                value = [v * scale for v in answer] if isinstance(answer, list) else answer * scale
                kind = {"count": "count", "mass": "mass", "angle": "angle", "volume": "volume"}.get(
                    fact["type"], "length"
                )
                yield Question(
                    f"shared:{file.relative_to(SHARED)}",
                    file,
                    f"facts:{path.parent.name}",
                    fact["question"],
                    value,
                    kind,
                )


def _published() -> Iterator[Question]:
    for path in sorted((SHARED / "cad-qa-dev").glob("*/*/input.txt")):
        asked_here = path.read_text(encoding="utf-8").splitlines()
        labels = (path.parent / "solution.txt").read_text(encoding="utf-8").splitlines()
        for question, label in zip(asked_here, labels, strict=True):
            pattern = label[2:] if label.startswith("re(") else None
            truth = None if pattern else ast.literal_eval(label)
            truth = sorted(truth) if isinstance(truth, set) else truth
            kind = "count" if isinstance(truth, int) or (pattern and "0." not in pattern) else "published"
            yield Question(
                f"shared:{path.parent.relative_to(SHARED)}",
                path.parent / "cad.step",
                "cad-qa",
                question,
                truth,
                kind,
                pattern,
            )


def is_right(value: Any, one: Question) -> bool:
    """Is a value right, within 1 % or 0.1 mm; counts exact; lists in any order; points within 0.1 mm or 1 %?

    One name holds another: "the upper lug" is "upper".
    """
    if value is None:
        return False
    if one.pattern is not None:
        return any(
            _close(value, ast.literal_eval(option), one.kind) for option in re.sub(r"[()]", "", one.pattern).split("|")
        )
    return _close(value, one.truth, one.kind)


def _close(value: Any, truth: Any, kind: str) -> bool:
    if isinstance(truth, bool) or isinstance(value, bool):
        return value is truth or (isinstance(value, list) and [truth] == value)
    if isinstance(truth, str) or (isinstance(truth, list) and truth and isinstance(truth[0], str)):
        texts, truths = sorted(_texts(value)), sorted(_texts(truth))
        texts = sorted(set(texts)) if len(truths) == 1 else texts  # "z" of each of four holes
        named = len(texts) == len(truths) == 1 and "," not in texts[0] and "alike" not in texts[0].split()
        return texts == truths or (named and set(truths[0].split()) <= set(texts[0].split()))
    got, want = _numbers(value), _numbers(truth)
    if got is None or want is None:
        return False
    if kind == "count":
        return len(got) == 1 and got[0] == want[0]
    slack = 1.01e-4 if kind in ("length", "lengths", "size", "sizes", "point", "points", "published") else 1e-9
    share = 0.015 if kind == "mass" else 0.01

    def close(a: float, b: float) -> bool:
        return abs(a - b) <= max(slack, share * abs(b))

    if kind in ("point", "size", "direction") and len(want) == 3:
        rows = [got[i : i + 3] for i in range(0, len(got), 3)]
        return bool(rows) and all(
            len(row) == 3
            and all(map(close, row if kind != "size" else sorted(row), want if kind != "size" else sorted(want)))
            for row in rows
        )
    if len(want) == 1:
        return bool(got) and all(close(v, want[0]) for v in got)
    if kind == "points":
        return sorted(map(_key, _rows(got))) == sorted(map(_key, _rows(want))) or _matched(
            _rows(got), _rows(want), close
        )
    return len(got) == len(want) and all(map(close, sorted(got), sorted(want)))


def _matched(got: list[list[float]], want: list[list[float]], close: Any) -> bool:
    left = list(got)
    for row in want:
        found = next((one for one in left if len(one) == len(row) and all(map(close, one, row))), None)
        if found is None:
            return False
        left.remove(found)
    return not left


def _rows(values: list[float]) -> list[list[float]]:
    return [values[i : i + 3] for i in range(0, len(values), 3)]


def _key(row: list[float]) -> tuple[float, ...]:
    return tuple(round(v, 4) for v in row)


def _texts(value: Any) -> list[str]:
    return [str(v).lower() for v in (value if isinstance(value, list) else [value])]


def _numbers(value: Any) -> list[float] | None:
    if isinstance(value, list | tuple):
        found: list[float] = []
        for item in value:
            inner = _numbers(item)
            if inner is None:
                return None
            found += inner
        return found
    return [float(value)] if isinstance(value, int | float) else None
