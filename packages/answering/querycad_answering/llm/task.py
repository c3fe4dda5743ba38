"""A question with all that is known when a program is written for it, and what came of writing."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from querycad_answering.judging import NO_EXPECTATION, Verdict
from querycad_contracts import (
    Answer,
    AnswerType,
    Attempt,
    Expectation,
    ModelSummary,
    PictureRequest,
    Program,
    RunOutcome,
)

from .messages import LlmError
from .settings import PromptExamples


@dataclass(frozen=True, slots=True)
class Limits:
    """How far an agent may go with one question, and how its prompt begins."""

    steps: int = 6
    tokens: int = 60_000
    """Read and written, in all."""
    temperature: float = 0.7
    """Of a reply to what it answered with a program that had failed before: at 0 it would say so again."""
    examples: PromptExamples = PromptExamples.NEAREST
    only_programs: bool = False
    """It is held to a form in which it can say nothing else."""
    capable: bool = False
    """A strong model: it is shown more at once, doubted less, and its last word stands against the parser's."""


LIMITS = Limits()


@dataclass(frozen=True, slots=True)
class Parsed:
    """What the parser answers, and how it understands the question."""

    answer: Answer
    meant: str
    is_sure: bool = False


@dataclass(frozen=True, slots=True)
class Task:
    """A question with all that is known when a program is written for it.

    `asked` is the type that the parser reads the question as asking for; None where it does not understand it. What
    follows it is for who looks before he answers: how the parser reads the question, the likeliest reading first, and
    what it answers.
    """

    question: str
    run: Callable[[Program], RunOutcome]
    judged: Callable[[Program, RunOutcome], Verdict]
    """What comes of a program that was run so."""
    summary: ModelSummary | None = None
    expect: Expectation = NO_EXPECTATION
    asked: AnswerType | None = None
    readings: Callable[[], tuple[str, ...]] = tuple
    parsed: Callable[[], Parsed | None] = lambda: None
    tools: tuple[str, ...] = ()
    """Which of `look` and `picture` programs may call."""
    draw: Callable[[PictureRequest], bytes] | None = None
    """The picture that a program asked for, a PNG file. Raises KeyError and OSError."""

    @property
    def wanted(self) -> AnswerType | None:
        """The type that an answer should have."""
        return self.expect.type or self.asked

    def judge(self, program: Program) -> Verdict:
        """Runs a program and says what comes of it."""
        return self.judged(program, self.run(program))


@dataclass(frozen=True, slots=True)
class Candidate:
    """A program, and what came of it."""

    program: Program
    verdict: Verdict


@dataclass(slots=True)
class Written:
    """All that a language model wrote for a question: one candidate a sample that led to any, and every attempt."""

    candidates: list[Candidate] = field(default_factory=list)
    attempts: list[Attempt] = field(default_factory=list)
    error: LlmError | None = None
    is_unsure: bool = False
    """The candidates are different answers, and none is preferred."""
    yields: bool = False
    """A parser that is sure gets another answer, and nothing was looked at that would show it wrong."""
    question: str = ""
    """What the language model wants to know before it answers."""
