"""What came of a run: one result a question, kept as `results.json`."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ConfigDict, ValidationError

from querycad_contracts import AnswerType

from .failures import FailureClass, Override, failure_class
from .items import BadBenchmark, Item
from .rules import score
from .systems import Reply, SystemOptions

FORMAT = 1
SIGNIFICANT_DIGITS = 9
"""Of the numbers written: a nanometre in a metre. The kernel's noise beyond it would only make results differ."""


class PartFound(BaseModel):
    """A part that an answer rests on."""

    model_config = ConfigDict(frozen=True)

    id: str
    label: str
    faces: tuple[int, ...]


class Result(BaseModel):
    """One question's outcome. `answer` is a Python literal in SI units; `seconds` leaves out reading the model."""

    model_config = ConfigDict(frozen=True)

    set: str
    id: str
    index: int
    question: str
    answer: str | None
    label: str
    strict: bool
    tolerant: bool
    text: str = ""
    type: AnswerType | None = None
    part: str = ""
    measure: str = ""
    code: str | None = None
    codegen: str | None = None
    attempts: int = 0
    """Programs that a language model wrote; with `codegen` 'parser', none of them answered."""
    parts: tuple[PartFound, ...] = ()
    seconds: float | None = None
    status: str
    failure: FailureClass | None = None
    note: str = ""
    message: str = ""
    picture: str | None = None
    """Path of the picture, relative to the file of results."""

    @property
    def key(self) -> str:
        """What identifies the question: 'abc/00000013/0'."""
        return f"{self.set}/{self.id}/{self.index}"

    @property
    def topic(self) -> str:
        """What is asked for: the benchmark's own word for the property, else the type of the answer."""
        return self.measure or (self.type.value if self.type else "no type told" if self.answer else "no answer")


class Results(BaseModel):
    """A whole run."""

    model_config = ConfigDict(frozen=True)

    format: int = FORMAT
    benchmark: str
    options: SystemOptions | None = None
    results: tuple[Result, ...]

    def save(self, path: Path) -> None:
        """Writes the file at once, so that an interrupted run leaves the earlier one whole."""
        path.parent.mkdir(parents=True, exist_ok=True)
        partial = path.with_name(path.name + ".part")
        partial.write_text(self.model_dump_json(indent=1) + "\n", encoding="utf-8")
        partial.replace(path)


def load_results(path: Path) -> Results:
    """What did `Results.save` keep? Raises BadBenchmark."""
    try:
        return Results.model_validate_json(path.read_bytes())
    except OSError as error:
        raise BadBenchmark(f"{path}: {error.strerror}") from error
    except ValidationError as error:
        raise BadBenchmark(f"{path}: no results of a benchmark run: {error.errors()[0]['msg']}") from error


def result_of(item: Item, reply: Reply, overrides: Mapping[str, Override], picture: str | None = None) -> Result:
    """What came of one question: the reply scored and, where it is wrong, classed."""
    answer = None if reply.value is None else as_literal(reply.value)
    scored = score(item, answer, reply.type)
    result = Result(
        set=item.set,
        id=item.id,
        index=item.index,
        question=item.question,
        answer=answer,
        label=item.label,
        strict=scored.strict,
        tolerant=scored.tolerant,
        text=reply.text,
        type=reply.type,
        part=item.part,
        measure=item.measure,
        code=reply.code,
        codegen=reply.codegen,
        attempts=reply.attempts,
        parts=tuple(PartFound(id=part.id, label=part.label, faces=part.faces) for part in reply.parts),
        seconds=reply.seconds,
        status=reply.failure or ("answered" if answer is not None else "no answer"),
        failure=None if scored.tolerant else failure_class(item, reply),
        message=reply.message,
        picture=picture,
    )
    return overruled(result, overrides)


def overruled(result: Result, overrides: Mapping[str, Override]) -> Result:
    """The result, in the class that a person put it into, if it is wrong and a person did."""
    override = overrides.get(result.key)
    if override is None or result.tolerant:
        return result
    return result.model_copy(update={"failure": override.failure, "note": override.note})


def as_literal(value: Any) -> str:
    """The value as a Python literal; floats with 9 significant digits, negative zero as zero."""
    return repr(_shortened(value))


def _shortened(value: Any) -> Any:
    if isinstance(value, float):
        return float(f"{value:.{SIGNIFICANT_DIGITS}g}") + 0.0
    if isinstance(value, list | tuple):
        return [_shortened(entry) for entry in value]
    return value


def counts(results: Iterable[Result]) -> tuple[int, int, int]:
    """How many questions, how many right strictly, how many within tolerance?"""
    listed = list(results)
    return len(listed), sum(r.strict for r in listed), sum(r.tolerant for r in listed)
