"""What is told of a model without a question: callouts as on a drawing, tables of its parts, a description."""

from __future__ import annotations

from enum import StrEnum

from pydantic import Field

from .answers import LengthUnit
from .geometry import Frozen, PartKind, Vector


class Callout(Frozen):
    """Parts that a drawing would call out once: '8x Ø16 THRU, counterbore Ø26 depth 8'."""

    text: str = Field(description="With the number of parts before it, where there are several; in the unit asked for.")
    kind: PartKind
    ids: tuple[str, ...] = Field(description="Ids of the parts, at least one.")


class TableKind(StrEnum):
    """Which parts are in the rows of a table?"""

    HOLES = "holes"
    SLOTS = "slots"
    """All that is cut in and is no hole: slots, pockets, cutouts, channels, steps, notches, grooves."""
    BOSSES = "bosses"
    """All that stands out: bosses, shafts, pads, ribs; gears."""
    EDGES = "edges"
    """Fillets, rounds, chamfers."""
    BENDS = "bends"
    PATTERNS = "patterns"
    FASTENERS = "fasteners"
    BODIES = "bodies"
    """The bill of material."""


class TableFormat(StrEnum):
    """How is a table written?"""

    TEXT = "text"
    CSV = "csv"
    MARKDOWN = "markdown"
    JSON = "json"


class Quantity(StrEnum):
    """What do the cells of a column hold? Numbers are SI."""

    TEXT = "text"
    COUNT = "count"
    LENGTH = "length"
    AREA = "area"
    VOLUME = "volume"
    ANGLE = "angle"


class Column(Frozen):
    """A column of a table."""

    name: str
    quantity: Quantity = Quantity.TEXT


Cell = str | int | float | None
"""None where the part has no such value."""


class Table(Frozen):
    """Parts of one family, a row each, or a row for all that are alike."""

    kind: TableKind
    columns: tuple[Column, ...]
    rows: tuple[tuple[Cell, ...], ...]
    ids: tuple[tuple[str, ...], ...] = Field((), description="Of each row the ids of its parts.")
    parts: int = Field(description="How many parts the rows stand for.")


class Description(Frozen):
    """What a model is, as an engineer would say it who opens the file for the first time."""

    name: str
    unit: LengthUnit = Field(description="Of the lengths in texts; numbers are SI.")
    size: Vector = Field(description="Extents along x, y and z, metres.")
    volume: float = Field(description="Cubic metres.")
    area: float = Field(description="Square metres.")
    bodies: int
    faces: int
    declared_units: tuple[str, ...] = Field((), description="Length units that the file declares.")
    drawn_in: str = Field("", description="The unit in which its sizes are round numbers: 'mm', 'in', or empty.")
    stands_along: str = Field(
        "", description="Axis of the file, likely upright: that of rotation, else that square to the largest flat face."
    )
    material_thickness: float | None = Field(None, description="Of sheet or plate material, metres.")
    features: tuple[Callout, ...] = Field((), description="What a drawing would call out, grouped.")
    patterns: tuple[Callout, ...] = ()
    standard_parts: tuple[str, ...] = Field((), description="Bodies that are standard parts: '4x ISO 4762 M5x16'.")
    warnings: tuple[str, ...] = ()
    questions: tuple[str, ...] = Field((), description="Questions about this model that have a sure answer.")
    text: str = Field(description="All of it for a person.")


class ChangeKind(StrEnum):
    """What became of a part?"""

    ADDED = "added"
    REMOVED = "removed"
    CHANGED = "changed"
    """In the same place, of another size or form."""
    MOVED = "moved"
    """The same, in another place."""


class Change(Frozen):
    """What became of parts that changed alike."""

    kind: ChangeKind
    before: str = Field("", description="As a drawing calls it out; empty of what was added.")
    after: str = Field("", description="As above; empty of what was removed.")
    ids_before: tuple[str, ...] = ()
    ids_after: tuple[str, ...] = Field((), description="In the same order.")
    by: Vector | None = Field(None, description="Of a single part that moved: by how much, metres.")


class Comparison(Frozen):
    """What is different between two models, part by part."""

    unit: LengthUnit = Field(description="Of the lengths in texts; numbers are SI.")
    same: int = Field(description="How many parts are the same, in the same place.")
    changes: tuple[Change, ...]
    shift: Vector | None = Field(None, description="Metres that all of it was moved by; places are compared after it.")
    size_before: Vector = Field(description="Extents along x, y, z, metres.")
    size_after: Vector
    volume_before: float = Field(description="Cubic metres.")
    volume_after: float
    warnings: tuple[str, ...] = Field((), description="What is odd about the files: a mesh is approximate.")
    text: str = Field(description="All of it for a person.")
