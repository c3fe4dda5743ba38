"""What can be measured? Anything that answers a question about a file; here, the embedded runtime.

Another system is measured through an adapter: a class with `ask` and `close` as in `System`, named on the command line
as `package.module:Class` and made once for every model, in a worker process, with the options of the run.
"""

from __future__ import annotations

import importlib
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Literal, Protocol, cast

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field

from querycad_answering.llm import PromptExamples
from querycad_contracts import AnswerRecord, AnswerType, GroundedBy, MissingAttribute, Part

EMBEDDED = "benchmark.scoring.embedded:EmbeddedSystem"
SERVED = "benchmark.scoring.served:ServedSystem"


class SystemOptions(BaseModel):
    """How is the system set up? The options that an ablation varies, kept with the results."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    system: str = EMBEDDED
    server: str | None = None
    """Address of the service that is asked, where one is."""
    codegen: str = "parser"
    """'parser', 'llm' or 'both'; which language model that is, the environment says: QUERYCAD_LLM_…"""
    llm_samples: int = 1
    llm_repairs: int = 2
    prompt_examples: PromptExamples = PromptExamples.NEAREST
    """Worked examples shown to a language model."""
    grounding: GroundedBy = GroundedBy.GEOMETRY
    views: Annotated[Literal[6, 8], BeforeValidator(int)] = 6
    """Looked at where `grounding` is vision or fused, from the sides or from the corners."""
    box_threshold: float = Field(0.30, gt=0, lt=1)
    """Score of a box below which the detector has seen nothing."""
    store: Path | None = None
    """Folder with the artefacts of models read before; None for the user's own."""
    pictures: bool = False
    timeout_s: float | None = None
    """Of one question, reading its model included the first time; see `limit_s`."""

    @property
    def limit_s(self) -> float:
        """How long may a question take? A thousand times what it should; networks and language models take minutes."""
        if self.timeout_s is not None:
            return self.timeout_s
        return 60.0 if (self.codegen, self.grounding) == ("parser", GroundedBy.GEOMETRY) else 600.0


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
    attempts: int = 0
    """Programs that a language model wrote."""
    parts: tuple[Part, ...] = ()
    seconds: float | None = None
    failure: str | None = None
    message: str = ""
    missing_attribute: MissingAttribute | None = None
    """What a found part lacks, where that is why there is no answer."""
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
    try:
        return cast(System, make(options))
    except TypeError as error:
        raise UnknownSystem(f"{options.system} is not made with the options of a run: {error}") from error


def reply_of(record: AnswerRecord, seconds: float | None = None, picture_png: bytes | None = None) -> Reply:
    """The record of an answered or failed question, as a reply."""
    answer, failure = record.answer, record.failure
    return Reply(
        value=answer.value if answer else None,
        type=answer.type if answer else None,
        text=answer.text if answer else "",
        code=record.code,
        codegen=record.codegen,
        attempts=len(record.attempts),
        parts=record.parts,
        seconds=seconds,
        failure=failure.category if failure else None,
        missing_attribute=failure.missing_attribute if failure else None,
        message=failure.message if failure else "; ".join(record.warnings),
        picture_png=picture_png,
    )
