"""Named, typed parameters that a program asks of a model: `POST /v1/models/{id}/parameters`, and its answer.

Lengths are in the unit that is asked for, areas and volumes in its powers, angles in radians or degrees.
"""

from __future__ import annotations

from enum import StrEnum
from typing import Annotated, Any, Literal, Self

from pydantic import Field, model_validator

from .answers import Codegen, LengthUnit
from .geometry import Frozen, GroundedBy, Side, Vector
from .services import ModelId, ModelSummary, ModelTask
from .vectors import cross, dot

Row = tuple[float, float, float, float]
Matrix = Annotated[
    tuple[Row, Row, Row, Row],
    Field(description="Homogeneous, 4x4, row by row: a rotation, a translation, and 0 0 0 1."),
]


class ParameterType(StrEnum):
    """What kind of value a parameter takes: those of answers, and what a robot's program is made of."""

    COUNT = "count"
    NUMBER = "number"
    NUMBERS = "numbers"
    LENGTH = "length"
    LENGTHS = "lengths"
    AREA = "area"
    VOLUME = "volume"
    ANGLE = "angle"
    POINT = "point"
    POINTS = "points"
    DIRECTION = "direction"
    SIZE = "size"
    TEXT = "text"
    BOOLEAN = "boolean"
    PARTS = "parts"
    POSE = "pose"
    """A `Pose` at a part: its z axis is the way that a tool comes, into a hole, or from its free end over a shaft."""
    APPROACH = "approach"
    """An `Axis`: where and which way something comes that is fitted to the part, or grips it along its axis."""
    INSERTION = "insertion"
    """An `Axis`: which way the part itself moves as it is fitted, such as a shaft with its free end first."""
    GRASPS = "grasps"
    """A list of `Grasp`: opposite parallel faces of a part, those that share the largest area first."""
    MATES = "mates"
    """A list of `Mate`: which hole takes which shaft."""


class AngleUnit(StrEnum):
    """Unit that angles are told in."""

    RAD = "rad"
    DEG = "deg"


class ModelFrame(Frozen):
    """The file's own axes."""

    of: Literal["model"] = "model"


class PartFrame(Frozen):
    """A part's own axes."""

    of: Literal["part"]
    part: str = Field(min_length=1, max_length=500, description="Its id, such as 'hole-3', or words for it.")


class GivenFrame(Frozen):
    """Axes that the caller knows."""

    of: Literal["given"]
    matrix: Matrix = Field(
        description="The frame's pose in the file's coordinates, its translation in the unit asked for. "
        "For a world's coordinates: the pose of the world as seen from the model.",
    )

    @model_validator(mode="after")
    def _rigid(self) -> Self:
        if not _is_rigid(self.matrix):
            raise ValueError("`matrix` must be a right-handed rotation and a translation, with 0 0 0 1 below")
        return self


ReferenceFrame = Annotated[ModelFrame | PartFrame | GivenFrame, Field(discriminator="of")]
"""Whose coordinates are positions and directions told in?"""


RIGID = 1e-6
"""How far rows may be from unit length and square to one another: single precision, which many programs write."""


def _is_rigid(matrix: Matrix) -> bool:
    x, y, z = (row[:3] for row in matrix[:3])
    dots = [dot(p, q) for p, q in ((x, x), (y, y), (z, z), (x, y), (y, z), (z, x))]
    found, wanted = (*dots, dot(x, cross(y, z)), *matrix[3]), (1, 1, 1, 0, 0, 0, 1, 0, 0, 0, 1)
    return all(abs(each - right) < RIGID for each, right in zip(found, wanted, strict=True))


class ParameterRequest(Frozen):
    """One parameter. With a question that is asked as it stands; else its name and description say what is meant."""

    name: str = Field(pattern=r"^[A-Za-z_][A-Za-z0-9_.-]{0,99}$")
    type: ParameterType
    question: str | None = Field(None, min_length=1, max_length=2000)
    description: str = Field("", max_length=2000, description="What it is, such as 'diameter of the bore'.")
    unit: LengthUnit | None = Field(None, description="Null: that of the request.")
    frame: ReferenceFrame | None = Field(None, description="Null: that of the request.")
    side: Side | None = Field(None, description="Which end of a part is meant that has two, such as a through hole.")
    at_most: float | None = Field(
        None, gt=0, allow_inf_nan=False, description="Of grasps: how far the gripper opens, in the unit."
    )


class ParametersRequest(Frozen):
    """Parameters of one model, all at once."""

    parameters: tuple[ParameterRequest, ...] = Field(min_length=1, max_length=64)
    unit: LengthUnit = Field(LengthUnit.MM, description="Of lengths; areas and volumes are in its powers.")
    angle_unit: AngleUnit = AngleUnit.RAD
    frame: ReferenceFrame = ModelFrame()
    other: ModelId | None = Field(
        None,
        description="Another uploaded model, for `mates`: its shafts in this one's holes, or vice versa.",
    )
    codegen: Codegen | None = Field(None, description="Who writes programs, as for a question.")
    grounding: GroundedBy = GroundedBy.GEOMETRY
    least_confidence: float = Field(
        0.5, ge=0.0, le=1.0, strict=True, description="A value less probable than this is `unsure`."
    )

    @model_validator(mode="after")
    def _unique(self) -> Self:
        names = [each.name for each in self.parameters]
        if len(names) > len(set(names)):
            raise ValueError("two parameters have the same name")
        return self


class ParametersTask(ModelTask):
    """Find the values of parameters."""

    asked: ParametersRequest
    summary: ModelSummary


class Pose(Frozen):
    """Place and orientation of a frame, in the unit and coordinates asked for."""

    position: Vector = Field(
        description="Half-way between the part's ends, on its axis: within a hole, not at its mouth; or the place "
        "that the question asks for."
    )
    quaternion: Row = Field(description="x, y, z, w.")
    matrix: Matrix


class Axis(Frozen):
    """A point and a way from it, in the unit and coordinates asked for."""

    point: Vector = Field(description="An end of the part: the mouth of a hole, the free end of a shaft.")
    direction: Vector = Field(description="Of length 1.")


class Grasp(Frozen):
    """Two faces that face away from each other, between the fingers of a gripper.

    Only the two faces are looked at: whether the fingers have room beside them is for a planner to see.
    """

    center: Vector = Field(description="In the middle of what the faces share, half-way between them.")
    closing: Vector = Field(description="Of length 1: the way that one finger moves; the other moves against it.")
    along: Vector = Field(description="Of length 1: the longer side of what the faces share, square to `closing`.")
    distance: float = Field(description="Between the faces: how far the gripper opens at least.")
    area: float = Field(description="What the faces share, as the bounding rectangles in their planes overlap.")
    faces: tuple[int, int] = Field(description="Ids of the faces.")


class Mate(Frozen):
    """A hole and a shaft that goes into it."""

    hole: str = Field(description="Id of the part.")
    shaft: str
    hole_model: ModelId | None = Field(None, description="Of the hole, where it is not the model asked about.")
    shaft_model: ModelId | None = Field(None, description="Likewise.")
    hole_diameter: float
    shaft_diameter: float
    clearance: float = Field(description="The hole's diameter less the shaft's; 0: line to line.")
    depth: float = Field(description="How far the shaft can go in: the shorter of the two.")
    assembled: bool = Field(description="Whether the file has the shaft in the hole already.")


class PartName(Frozen):
    """A part, in short."""

    id: str
    label: str


class ParameterStatus(StrEnum):
    """Is there a value?"""

    ANSWERED = "answered"
    UNSURE = "unsure"
    """Several are possible: `alternatives` has them, the most probable first. A person should choose."""
    UNANSWERED = "unanswered"


class ParameterAlternative(Frozen):
    """A value that may be meant instead."""

    value: Any
    text: str
    confidence: float | None = None
    understood_as: str = ""
    parts: tuple[PartName, ...] = ()


class ParameterValue(Frozen):
    """What became of one parameter. There is a `value` only where it is sure enough; else `reason` says why not."""

    name: str
    type: ParameterType
    status: ParameterStatus
    value: Any = Field(None, description="As the type has it: a number, a triple, a Pose, an Axis, a list of Grasp …")
    unit: str = Field("", description="'mm', 'mm2', 'mm3', 'm', 'in' …, 'rad' or 'deg'; empty for what has none.")
    frame: ReferenceFrame | None = Field(None, description="Of what has a place or a direction.")
    text: str = Field("", description="The value as a person reads it.")
    confidence: float | None = Field(None, description="Probability that the value is right; null without any.")
    reason: str = Field("", description="Why there is no value, for the person who is asked instead.")
    asked: str = Field("", description="The question that was asked for it.")
    understood_as: str = ""
    parts: tuple[PartName, ...] = Field((), description="What the value rests on.")
    faces: tuple[int, ...] = Field((), description="Ids of the faces of these parts, at most 1,000.")
    code: str | None = Field(None, description="The program that found it.")
    alternatives: tuple[ParameterAlternative, ...] = ()


class ParameterSet(Frozen):
    """The parameters of a model, in the order asked."""

    model: ModelId | None = Field(None, description="Null outside of a service.")
    unit: LengthUnit
    angle_unit: AngleUnit
    parameters: tuple[ParameterValue, ...]
    open: tuple[str, ...] = Field(description="Names of those without a value: what a person is to be asked.")
