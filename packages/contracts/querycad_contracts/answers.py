"""Questions in, typed answers with their evidence out."""

from __future__ import annotations

from enum import StrEnum
from typing import Annotated, Any

from pydantic import Field

from .geometry import Frozen, GroundedBy, Part


class AnswerType(StrEnum):
    """What kind of value answers a question."""

    COUNT = "count"
    NUMBER = "number"
    LENGTH = "length"
    LENGTHS = "lengths"
    AREA = "area"
    VOLUME = "volume"
    ANGLE = "angle"
    POINT = "point"
    POINTS = "points"
    DIRECTION = "direction"
    DIRECTIONS = "directions"
    SIZE = "size"
    SIZES = "sizes"
    TEXT = "text"
    TEXTS = "texts"
    BOOLEAN = "boolean"
    PARTS = "parts"
    AREAS = "areas"
    VOLUMES = "volumes"
    ANGLES = "angles"
    NUMBERS = "numbers"


class Unit(StrEnum):
    """SI unit of an answer's value."""

    METRE = "m"
    SQUARE_METRE = "m2"
    CUBIC_METRE = "m3"
    RADIAN = "rad"
    NONE = ""

    @property
    def power(self) -> int:
        """Which power of a length is it? 0 of what is none."""
        return {Unit.METRE: 1, Unit.SQUARE_METRE: 2, Unit.CUBIC_METRE: 3}.get(self, 0)


class LengthUnit(StrEnum):
    """Unit that lengths are written in for people; values stay SI."""

    MM = "mm"
    CM = "cm"
    M = "m"
    IN = "in"

    @property
    def metres(self) -> float:
        """How many metres is one of this unit? (Inch: 25.4 mm exactly, ISO 31-1.)"""
        return {"mm": 1e-3, "cm": 1e-2, "m": 1.0, "in": 0.0254}[self.value]


class Frame(StrEnum):
    """Whose coordinates are the numbers of a point, direction or size in?"""

    MODEL = "model"
    PART = "part"


class Expectation(Frozen):
    """What the caller expects of an answer. An answer that is something else is a failure, never a wrong type."""

    type: AnswerType | None = Field(None, description="The type; a plural takes one value as a list of one.")
    unit: Unit | None = Field(None, description="SI unit of the value: 'm', 'm2', 'm3', 'rad', or '' for none.")
    frame: Frame | None = Field(None, description="Of points, directions and sizes: the file's axes or the part's own.")


LEAST_CONFIDENCE = 0.45
"""Below it another reading than the best one may well be meant: then both are shown. Confidence leans to the low side
(`benchmark/understanding/fit.py`), so that an even chance is about 0.45."""


class Codegen(StrEnum):
    """Who writes the program?"""

    PARSER = "parser"
    LLM = "llm"
    BOTH = "both"
    AGENT = "agent"
    """A language model that runs programs to look, and then answers."""


class LlmOptions(Frozen):
    """What a caller may choose of a language model. Its address and key are the service's own, always."""

    model: str | None = Field(None, max_length=200, description="One of the models that the service allows.")
    samples: int | None = Field(
        None, ge=1, le=9, strict=True, description="Programs asked for, whose answers are voted on."
    )
    repairs: int | None = Field(
        None, ge=0, le=5, strict=True, description="Times that a program that fails is sent back."
    )


class Selection(Frozen):
    """What is pointed at while a question is asked: clicked in a view of the model, say. 'It' and 'this' are these."""

    parts: tuple[str, ...] = Field((), max_length=1000, description="Ids of parts, such as 'hole-4'.")
    faces: tuple[Annotated[int, Field(ge=0, strict=True)], ...] = Field(
        (), max_length=1000, description="Numbers of faces in the file; a feature that has them all is meant."
    )


class AnswerOptions(Frozen):
    """How a question is to be answered, as far as the caller has a say."""

    codegen: Codegen | None = Field(
        None,
        description="Who writes the program; null: the agent with a capable language model, both with any other, else "
        "the parser.",
    )
    expect: Expectation | None = None
    llm: LlmOptions | None = None
    grounding: GroundedBy = Field(GroundedBy.GEOMETRY, description="By which evidence words are turned into parts.")
    least_confidence: float | None = Field(
        None,
        ge=0.0,
        le=1.0,
        strict=True,
        description=f"An answer less probable than this is `unsure`; null: {LEAST_CONFIDENCE}. 0: never unsure.",
    )
    selection: Selection | None = Field(None, description="What is pointed at: what 'it', 'these', 'this hole' mean.")
    context: tuple[Annotated[str, Field(max_length=2000)], ...] = Field(
        (), max_length=20, description="Questions asked before, the oldest first: what 'and how deep is it?' leans on."
    )


class Answer(Frozen):
    """A typed value."""

    value: Any = Field(description="SI: metres, m2, m3, radians; counts are integers; points are three floats.")
    type: AnswerType
    unit: Unit
    text: str = Field(description="The value as a person reads it, in the unit the caller asked for.")
    frame: Frame | None = Field(None, description="Of points, directions and sizes: whose axes; null for the rest.")


class Program(Frozen):
    """A Python program that answers a question, and who wrote it."""

    code: str
    codegen: str = Field(description="Who wrote it: 'parser', or 'llm:<model>'.")
    expects: AnswerType | None = Field(
        None, description="The type the answer must have; None when the writer did not say."
    )
    confidence: float = Field(1.0, ge=0.0, le=1.0, description="Of the parser's: that its answer is right.")
    unused_words: tuple[str, ...] = Field((), description="Words of the question that the program does not reflect.")
    notes: tuple[str, ...] = Field(
        (), description="Readings chosen where the question was ambiguous, said to the user."
    )

    @property
    def is_checked(self) -> bool:
        """Is it known to name only what exists? The parser writes from the guest API alone, as its tests check."""
        return self.codegen == "parser"


class Status(StrEnum):
    """How a question ended."""

    ANSWERED = "answered"
    UNSURE = "unsure"
    """The answer is the most probable of several; the others are the alternatives."""
    NOT_GROUNDED = "not_grounded"
    FAILED = "failed"


class MissingAttribute(Frozen):
    """A measure that a program read of something that does not have it."""

    part: str = Field(description="Id of the part; empty for what is no part: a face, a body, the model.")
    attribute: str


class FailureCategory(StrEnum):
    """Why is there no answer, in a word?"""

    NOT_GROUNDED = "not_grounded"
    NOT_UNDERSTOOD = "not_understood"
    BAD_INPUT = "bad_input"
    PROGRAM = "program"
    LIMIT = "limit"
    CANCELLED = "cancelled"
    INTERNAL = "internal"
    UNEXPECTED = "unexpected"


class Failure(Frozen):
    """Why there is no answer."""

    category: FailureCategory = Field(
        description="'not_grounded', 'not_understood', 'bad_input', 'program', 'limit', 'cancelled', 'internal' or "
        "'unexpected' (the answer is not what the caller expects)."
    )
    message: str = Field(description="One sentence for the user.")
    nearest: tuple[str, ...] = Field((), description="The nearest terms that would be understood.")
    retryable: bool = False
    missing_attribute: MissingAttribute | None = Field(
        None, description="What was found, and lacks the measure that was asked for."
    )


class TokenUse(Frozen):
    """What a language model read and wrote."""

    input: int = 0
    output: int = 0

    def __add__(self, other: TokenUse) -> TokenUse:
        return TokenUse(input=self.input + other.input, output=self.output + other.output)


class Attempt(Frozen):
    """One program that a language model wrote for a question, and what came of it."""

    codegen: str = Field(description="'llm:<model>', or 'agent:<model>'.")
    sample: int = Field(1, description="Which of several independent tries it belongs to, or step of an agent, from 1.")
    code: str | None = Field(description="Null when the reply held no program, or none came.")
    answer: str | None = Field(None, description="The answer's text, when it was one.")
    problem: str = Field("", description="What the model was told: what to repair; of an agent's step what it saw.")
    tokens: TokenUse = TokenUse()
    seconds: float = 0.0


class Agreement(Frozen):
    """How many of the programs written independently for a question give the answer?"""

    agreeing: int
    programs: int


class Alternative(Frozen):
    """Another reading of the question, or another program for it, which gives another answer."""

    codegen: str
    code: str
    answer: Answer
    understood_as: str = Field("", description="What was asked, by this reading; empty of a language model's program.")
    confidence: float | None = Field(None, description="Probability that this answer is right; null as above.")


class AnswerRecord(Frozen):
    """The whole outcome of one question: what `querycad ask --json` prints and the API returns."""

    question: str
    status: Status
    answer: Answer | None
    code: str | None
    codegen: str | None
    parts: tuple[Part, ...]
    timings_ms: dict[str, float]
    warnings: tuple[str, ...]
    failure: Failure | None = None
    confidence: float | None = Field(
        None, description="Probability that the answer is right; null of a language model's alone."
    )
    understood_as: str = Field("", description="What was asked, in plain words: 'depth of the 4 blind holes'.")
    ignored: tuple[str, ...] = Field(
        (), description="Words that carry meaning and were skipped, and what could not be checked on the model."
    )
    attempts: tuple[Attempt, ...] = Field((), description="Every program that a language model wrote, in order.")
    agreement: Agreement | None = Field(None, description="Null where only one program was written.")
    alternatives: tuple[Alternative, ...] = Field((), description="Readings, and programs, with another answer.")
    tokens: TokenUse | None = Field(None, description="Of all attempts; null where no language model was asked.")

    @classmethod
    def failed(cls, question: str, failure: Failure) -> AnswerRecord:
        """The record of a question that no program was run for."""
        return cls(
            question=question,
            status=Status.FAILED,
            answer=None,
            code=None,
            codegen=None,
            parts=(),
            timings_ms={},
            warnings=(),
            failure=failure,
        )

    @classmethod
    def cancelled(cls, question: str) -> AnswerRecord:
        """The record of a question that somebody called off."""
        return cls.failed(question, Failure(category=FailureCategory.CANCELLED, message="the question was cancelled"))
