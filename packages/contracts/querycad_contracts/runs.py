"""What the sandbox and the segworker owe each other: the port that guest code calls, and the outcome of a run."""

from __future__ import annotations

from collections.abc import Sequence
from enum import StrEnum
from typing import Annotated, Any, Protocol

from pydantic import Field

from .answers import MissingAttribute
from .geometry import Face, Frozen, Part, Shape, Side, Vector
from .queries import FaceQuery, Grounded, PartQuery

RunId = Annotated[str, Field(pattern=r"^[0-9a-f]{32}$", description="Id of one run; whoever starts it may choose it.")]

RESULT = "solution"
"""The variable that holds a program's result."""
MOST_SHOWN = 30
"""Most parts that are numbered in one picture."""


class Grounding(Frozen):
    """Which parts does a description mean?

    `understood` is False when a word of the description is not known at all; then `parts` is empty and `nearest`
    holds known terms. A known word for something that the model does not have gives no parts with `understood` True.
    """

    description: str
    sides: tuple[Side, ...] | None
    parts: tuple[Part, ...]
    understood: bool
    nearest: tuple[str, ...] = Field((), description="Nearest terms that would find something in this model.")
    message: str = Field("", description="Why nothing was found; empty when something was.")
    warnings: tuple[str, ...] = ()
    ignored: tuple[str, ...] = Field((), description="Words of the description that say nothing which is known here.")
    unchecked: tuple[str, ...] = Field((), description="What restricts, by the words, and could not be checked.")
    seen_by: str | None = Field(
        None, description="Who looked at pictures for it; empty: nobody did so far. Null where no eyes were asked for."
    )


class PictureRequest(Frozen):
    """A picture that a program asks for: the model from a side, these parts numbered."""

    side: Side | None = Field(None, description="Null: from wherever the parts are seen best.")
    parts: tuple[str, ...] = Field((), max_length=MOST_SHOWN, description="Ids of the parts.")


class FoundFaces(Frozen):
    """The faces that a query asks for, and the part that they make, which an answer can rest on; None without any."""

    faces: tuple[Face, ...]
    part: Part | None = None


class NoSuchMeasure(ValueError):
    """The parts are known, but have no such measure; `str()` says why, to whoever asked for it."""


class PartFinder(Protocol):
    """Finds and measures the parts of one known model: in this process when embedded, else over Celery.

    What measures raises NoSuchMeasure where the parts have none.
    """

    def shape(self) -> Shape:
        """What is the whole model?"""
        ...

    def find_parts(self, description: str | PartQuery, sides: Sequence[Side] | None = None) -> Grounding:
        """Which parts does `description` mean, of those visible from any of `sides`? Free text is read as a query."""
        ...

    def look(self, phrase: str) -> Grounding:
        """Which parts look like this to whoever was shown pictures of them? Geometry has no say."""
        ...

    def ground(self, queries: Sequence[PartQuery]) -> tuple[tuple[Grounded, ...], ...]:
        """In which ways can each query be grounded on the model, the best first?"""
        ...

    def parts(self) -> tuple[Part, ...]:
        """Which parts were recognised in the model? All of them, the model itself among them."""
        ...

    def faces(self, ids: Sequence[int]) -> tuple[Face, ...]:
        """What are the faces with these ids? Raises KeyError for an id the model does not have."""
        ...

    def find_faces(self, query: FaceQuery) -> FoundFaces:
        """Which faces are so?"""
        ...

    def extent(self, part: str, direction: Vector) -> float:
        """How far does a part extend along a unit vector, in metres? Raises KeyError for an unknown part id."""
        ...

    def distance(self, part_a: str, part_b: str) -> float:
        """How far apart are the surfaces of two parts, in metres? Raises KeyError for an unknown part id."""
        ...

    def overlap(self, part_a: str, part_b: str) -> float:
        """Which volume do two closed bodies share, in m3? Raises KeyError for an unknown part id."""
        ...

    def edge_distance(self, part: str) -> float:
        """How far is a part from the outer edge of its face, in metres? Raises KeyError for an unknown part id."""
        ...


class RunStatus(StrEnum):
    """How a program ended."""

    OK = "ok"
    RAISED = "raised"
    TIMED_OUT = "timed_out"
    OUT_OF_MEMORY = "out_of_memory"
    REFUSED = "refused"
    CANCELLED = "cancelled"
    CRASHED = "crashed"


class RunLimits(Frozen):
    """What one program may use."""

    duration_s: float = Field(5.0, gt=0, le=60, description="Interpreter time; a program of a few lines needs 1 ms.")
    segcad_s: float = Field(180.0, gt=0, le=3600, description="Time in the segworker, all calls together.")
    wall_s: float = Field(240.0, gt=0, le=3600, description="From start to end, whatever it waits for.")
    memory_bytes: int = Field(
        64 * 2**20, gt=0, le=512 * 2**20, description="Interpreter heap; a thousand parts take a few MB."
    )
    recursion: int = Field(200, gt=0, le=1000, description="Stack depth; generated code does not recurse.")
    host_calls: int = Field(2000, gt=0, le=100_000, description="Calls to the guest API, lazy attributes included.")
    output_bytes: int = Field(64 * 2**10, gt=0, le=2**20, description="Printed text kept.")
    code_bytes: int = Field(64 * 2**10, gt=0, le=2**20, description="Length of the program itself.")


class RunOutcome(Frozen):
    """What came of one program."""

    status: RunStatus
    value: Any = Field(
        None,
        description="`solution` as plain data: None, bool, int, float, str, nested lists; a part is {'part': id}.",
    )
    message: str = Field(
        "", description="Why it did not end well, or for want of which measure it gave None: for users and repairs."
    )
    missing_attribute: MissingAttribute | None = Field(
        None,
        description="The measure that was not there, for want of which it ended or gave None.",
    )
    empty_selection: bool = Field(
        False, description="Whether it ended since it chose among too few: min() or max() of none, an index too high."
    )
    printed: str = ""
    groundings: tuple[Grounding, ...] = Field((), description="Every find_parts call, in order.")
    pictures: tuple[PictureRequest, ...] = Field((), description="What the program asked to be shown, in order.")
    used_parts: tuple[str, ...] = Field(
        (), description="Ids of parts whose measures the program read or returned, in order."
    )
    duration_ms: float = 0.0
    walls_missing: tuple[str, ...] = Field((), description="Walls of the sandbox that were not up.")
