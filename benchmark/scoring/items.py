"""Which questions does a benchmark folder hold? The published CAD-Q&A layout and the project's own, in one form."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ConfigDict, ValidationError

from querycad_contracts import AnswerType

OWN_SET = "querycad"
"""Name of the set that the project's own questions belong to where their file names no split."""
_UNORDERED_TYPES = frozenset(
    {
        AnswerType.LENGTHS,
        AnswerType.POINTS,
        AnswerType.DIRECTIONS,
        AnswerType.SIZES,
        AnswerType.TEXTS,
        AnswerType.AREAS,
        AnswerType.VOLUMES,
        AnswerType.ANGLES,
        AnswerType.NUMBERS,
    }
)


class BadBenchmark(ValueError):
    """A folder that cannot be measured; `str()` is the sentence for the user."""


@dataclass(frozen=True, slots=True)
class Item:
    """One question with its label.

    `label` is text as published: a Python literal in metres, or a regular expression behind `re`. `is_sorted` says
    that the label is a list in no particular order. `type` is None where the benchmark does not tell it.
    """

    set: str
    id: str
    index: int
    file: Path
    question: str
    label: str
    is_sorted: bool = False
    type: AnswerType | None = None
    part: str = ""
    measure: str = ""

    @property
    def key(self) -> str:
        """What identifies the question in its benchmark: 'abc/00000013/0', the index counting from 0."""
        return f"{self.set}/{self.id}/{self.index}"


@dataclass(frozen=True, slots=True)
class Benchmark:
    """The questions of one folder, in order of their keys; `name` is the folder's."""

    name: str
    items: tuple[Item, ...]


def read_benchmark(folder: Path, models: Path | None = None) -> Benchmark:
    """Which questions are below `folder`? Raises BadBenchmark when there is none, or one has no label or no model.

    `models` is where the STEP files of questions/*.json are, when not in `folder` itself.
    """
    if not folder.is_dir():
        raise BadBenchmark(f"{folder}: no such folder")
    items = [*_published(folder), *_own(folder, models)]
    if not items:
        raise BadBenchmark(f"{folder}: neither <set>/<id>/input.txt nor questions/*.json below it")
    keys = [item.key for item in items]
    twice = next((key for key in keys if keys.count(key) > 1), None)
    if twice is not None:
        raise BadBenchmark(f"{folder}: two questions are called {twice}")
    return Benchmark(folder.resolve().name, tuple(sorted(items, key=lambda item: (item.set, item.id, item.index))))


def _published(folder: Path) -> Iterator[Item]:
    for questions in sorted(folder.glob("**/input.txt")):
        model = questions.parent
        if not (model / "cad.step").is_file():
            raise BadBenchmark(f"{model}: no cad.step beside input.txt")
        asked, labels = _lines(questions), _lines(model / "solution.txt")
        if len(asked) != len(labels):
            raise BadBenchmark(f"{model}: {len(asked)} questions but {len(labels)} labels")
        marks = _lines(model / "metadata.txt") if (model / "metadata.txt").is_file() else []
        for index, (question, label) in enumerate(zip(asked, labels, strict=True)):
            yield Item(
                set=model.parent.relative_to(folder).as_posix() if model.parent != folder else folder.name,
                id=model.name,
                index=index,
                file=model / "cad.step",
                question=question,
                label=label,
                is_sorted=index < len(marks) and "sorted" in marks[index].split(),
            )


def _lines(path: Path) -> list[str]:
    """The lines, stripped, without the empty ones at the end: an empty line in between still counts."""
    try:
        lines = [line.strip() for line in path.read_text(encoding="utf-8").splitlines()]
    except (OSError, UnicodeDecodeError) as error:
        raise BadBenchmark(f"{path}: {getattr(error, 'strerror', None) or 'not UTF-8 text'}") from error
    while lines and not lines[-1]:
        lines.pop()
    return lines


class _Tags(BaseModel):
    part: str = ""
    property: str = ""


class _OwnItem(BaseModel):
    question: str
    value: Any
    type: AnswerType
    tags: _Tags = _Tags()


class _OwnFile(BaseModel):
    """One model's questions; what else the file says of the model is passed over."""

    model_config = ConfigDict(extra="ignore")

    model: str
    items: tuple[_OwnItem, ...]
    split: str = OWN_SET


def _own(folder: Path, models: Path | None) -> Iterator[Item]:
    for path in sorted(folder.glob("questions/*.json")):
        try:
            read = _OwnFile.model_validate_json(path.read_bytes())
        except ValidationError as error:
            raise BadBenchmark(f"{path}: {error.errors()[0]['loc']}: {error.errors()[0]['msg']}") from error
        places = (*([models] if models else []), path.parent, folder, folder / "models")
        file = next((place / read.model for place in places if (place / read.model).is_file()), None)
        if file is None:
            raise BadBenchmark(f"{path}: there is no model {read.model}; --models names the folder")
        for index, item in enumerate(read.items):
            yield Item(
                set=read.split,
                id=path.name.removesuffix(".json").removesuffix(".questions"),
                index=index,
                file=file,
                question=item.question,
                label=repr(item.value),
                is_sorted=item.type in _UNORDERED_TYPES and isinstance(item.value, list) and len(item.value) > 1,
                type=item.type,
                part=item.tags.part,
                measure=item.tags.property,
            )


def literal(text: str) -> Any:
    """Which value does a Python literal stand for? Tuples become lists. Raises ValueError for anything else."""
    try:
        return _plain(ast.literal_eval(text.strip()))
    except (ValueError, SyntaxError, TypeError, MemoryError, RecursionError) as error:
        raise ValueError(f"{text!r} is no Python literal") from error


def _plain(value: Any) -> Any:
    if isinstance(value, list | tuple):
        return [_plain(entry) for entry in value]
    return value
