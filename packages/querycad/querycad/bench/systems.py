"""What can be measured? Anything that answers a question about a file; here, the embedded runtime.

Another system is measured through an adapter: a class with `ask` and `close` as in `System`, named on the command line
as `package.module:Class` and made once for every model, in a worker process, with the options of the run.
"""

from __future__ import annotations

import importlib
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol, cast

from pydantic import BaseModel, ConfigDict

from querycad_contracts import AnswerRecord, AnswerType, Part

EMBEDDED = "querycad.bench.embedded:EmbeddedSystem"


class SystemOptions(BaseModel):
    """How is the system set up? The options that an ablation varies, kept with the results."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    system: str = EMBEDDED
    codegen: str = "parser"
    store: Path | None = None
    """Folder with the artefacts of models read before; None for the user's own."""
    pictures: bool = False
    timeout_s: float = 60.0
    """Of one question, reading its model included the first time: a thousand times what a question should take."""


@dataclass(frozen=True, slots=True)
class Reply:
    """What a system says to one question. Only `value` is needed; the rest explains it.

    `value` is plain data in SI units, None when there is no answer. `failure` is a category of `contracts.Failure`.
    """

    value: Any = None
    type: AnswerType | None = None
    text: str = ""
    code: str | None = None
    codegen: str | None = None
    parts: tuple[Part, ...] = ()
    seconds: float | None = None
    failure: str | None = None
    message: str = ""
    picture_png: bytes | None = None


class System(Protocol):
    """Answers questions about files. Raises nothing that concerns a single question."""

    def ask(self, file: Path, question: str) -> Reply:
        """What is the answer to the question about this STEP file?"""
        ...

    def close(self) -> None:
        """Ends what the system started."""
        ...


OpenSystem = Callable[[SystemOptions], System]


class UnknownSystem(ValueError):
    """There is no such system, or it cannot be set up as asked; `str()` is the sentence for the user."""


def open_system(options: SystemOptions) -> System:
    """The system that `options.system` names, set up. Raises UnknownSystem."""
    module, _, name = options.system.partition(":")
    try:
        make = getattr(importlib.import_module(module), name)
    except (ImportError, AttributeError, ValueError) as error:
        raise UnknownSystem(f"there is no system {options.system}: {error}") from error
    return cast(System, make(options))


def reply_of(record: AnswerRecord, seconds: float | None = None, picture_png: bytes | None = None) -> Reply:
    """The record of an answered or failed question, as a reply."""
    answer, failure = record.answer, record.failure
    return Reply(
        value=answer.value if answer else None,
        type=answer.type if answer else None,
        text=answer.text if answer else "",
        code=record.code,
        codegen=record.codegen,
        parts=record.parts,
        seconds=seconds,
        failure=failure.category if failure else None,
        message=failure.message if failure else "; ".join(record.warnings),
        picture_png=picture_png,
    )
