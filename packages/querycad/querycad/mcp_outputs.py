"""What the tools of the MCP server return: few fields, small, the same from call to call."""

from __future__ import annotations

from typing import Any

from pydantic import Field

from querycad_contracts import Frozen, RunStatus, Status


class Group(Frozen):
    """Parts that are alike."""

    what: str = Field(description="As a drawing calls them out, lengths in the unit asked for.")
    count: int
    ids: str = Field(description="In short: 'hole-1..3' are hole-1, hole-2, hole-3.")


class Opened(Frozen):
    """A model that is open."""

    model: str = Field(description="The id for all other tools.")
    text: str = Field(description="Size, features, patterns, and questions that it surely answers.")
    warnings: tuple[str, ...] = ()


class Answered(Frozen):
    """The answer to a question."""

    answer: str = Field(description="Id of this answer: look(answer=…) shows what it rests on.")
    status: Status = Field(description="'answered': confidence is 0.45 or more; 'unsure': less, it may well be wrong.")
    text: str
    value: Any = Field(None, description="SI; null where there is no answer.")
    type: str = ""
    unit: str = Field("", description="SI unit of the value.")
    confidence: float | None = Field(None, description="Probability that the value is right; sure is 0.8 or more.")
    understood_as: str = ""
    parts: tuple[Group, ...] = Field((), description="What the answer rests on.")
    notes: tuple[str, ...] = ()
    alternatives: tuple[str, ...] = Field((), description="Other readings, and their answers.")
    next: str = Field("", description="What to do where there is no sure answer.")


class FoundParts(Frozen):
    """Parts that words mean."""

    count: int
    groups: tuple[Group, ...]
    notes: tuple[str, ...] = ()
    next: str = ""


class Measured(Frozen):
    """A measure."""

    value: Any = Field(description="SI.")
    unit: str
    text: str


class TablePage(Frozen):
    """Some rows of a table."""

    rows: int = Field(description="Of the whole table.")
    parts: int = Field(description="That the rows stand for.")
    text: str = Field(description="Markdown.")
    next: str = ""


class Ran(Frozen):
    """What came of a program."""

    status: RunStatus
    value: Any = Field(None, description="Of `solution`, SI; a part is {'part': id}.")
    message: str = ""
    printed: str = ""
    next: str = ""
