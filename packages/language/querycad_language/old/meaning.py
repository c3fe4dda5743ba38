"""What a question means, apart from the words that asked it and the Python that will answer it.

Lengths are metres, areas square metres, volumes cubic metres. Axes: 0 is x (width), 1 y (depth), 2 z (height).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, fields, is_dataclass
from enum import StrEnum
from typing import TypeAlias

from querycad_contracts import Side


class Measure(StrEnum):
    """A property that can be asked of a part or of the whole model."""

    RADIUS = "radius"
    DIAMETER = "diameter"
    INNER_RADIUS = "inner_radius"
    OUTER_RADIUS = "outer_radius"
    INNER_DIAMETER = "inner_diameter"
    OUTER_DIAMETER = "outer_diameter"
    CIRCUMFERENCE = "circumference"
    DEPTH = "depth"
    HEIGHT = "height"
    WIDTH = "width"
    LENGTH = "length"
    AXIAL_LENGTH = "axial_length"
    """Along its own axis: of what sticks out its height."""
    THICKNESS = "thickness"
    WALL_THICKNESS = "wall_thickness"
    MAGNITUDE = "magnitude"
    """How big something is, where no dimension is named; the noun decides which one is meant."""
    LEAST_EXTENT = "least_extent"
    SIZE = "size"
    SHORT_SIDE = "short_side"
    LONG_SIDE = "long_side"
    HALF_SIZE = "half_size"
    X_EXTENT = "x_extent"
    Y_EXTENT = "y_extent"
    Z_EXTENT = "z_extent"
    DIAGONAL = "diagonal"
    ANGLE = "angle"
    AREA = "area"
    VOLUME = "volume"
    BOX_VOLUME = "box_volume"
    POSITION = "position"
    OPENING = "opening"
    TIP = "tip"
    TOP_END = "top_end"
    BOTTOM_END = "bottom_end"
    LEFT_END = "left_end"
    RIGHT_END = "right_end"
    FRONT_END = "front_end"
    BACK_END = "back_end"
    X = "x"
    Y = "y"
    Z = "z"
    AXIS = "axis"
    NORMAL = "normal"
    DIRECTION = "direction"
    """Where something points, where neither axis nor normal is named; the noun decides."""
    EDGE_DISTANCE = "edge_distance"
    NAME = "name"
    KIND = "kind"
    COLOR = "color"
    SIDES = "sides"
    BOTTOM = "bottom"


ENDS = {
    Measure.TOP_END: Side.TOP,
    Measure.BOTTOM_END: Side.BOTTOM,
    Measure.LEFT_END: Side.LEFT,
    Measure.RIGHT_END: Side.RIGHT,
    Measure.FRONT_END: Side.FRONT,
    Measure.BACK_END: Side.BACK,
}
"""The ends of a part, by the side that they lie on."""


class NounClass(StrEnum):
    """What the head noun of a phrase tells about how its size is meant; the noun itself stays free text."""

    HOLE = "hole"
    AXIAL = "axial"
    """Round and sticking out along its axis: shafts, pins, bosses."""
    ROUND = "round"
    """Round otherwise: discs, fillets, bolt circles."""
    BODY = "body"
    FACE = "face"
    OTHER = "other"

    @property
    def is_round(self) -> bool:
        """Is its size a diameter?"""
        return self in (NounClass.HOLE, NounClass.AXIAL, NounClass.ROUND)


class Relation(StrEnum):
    """How two values compare."""

    EQUAL = "equal"
    UNEQUAL = "unequal"
    ABOUT = "about"
    LESS = "less"
    AT_MOST = "at_most"
    MORE = "more"
    AT_LEAST = "at_least"
    BETWEEN = "between"

    @property
    def negated(self) -> Relation:
        """Which relation holds exactly when this one does not? ABOUT and BETWEEN have none and stay."""
        return _NEGATED.get(self, self)


_NEGATED = {
    Relation.EQUAL: Relation.UNEQUAL,
    Relation.UNEQUAL: Relation.EQUAL,
    Relation.LESS: Relation.AT_LEAST,
    Relation.AT_LEAST: Relation.LESS,
    Relation.MORE: Relation.AT_MOST,
    Relation.AT_MOST: Relation.MORE,
}


class Reduce(StrEnum):
    """What becomes of one value per part."""

    EACH = "each"
    DIFFERENT = "different"
    ONE = "one"
    """The value that like parts share; all that differ where they do not."""
    TOTAL = "total"
    MEAN = "mean"
    LARGEST = "largest"
    SMALLEST = "smallest"


@dataclass(frozen=True, slots=True)
class Whole:
    """The whole model."""


@dataclass(frozen=True, slots=True)
class Bound:
    """A filter: the part's measure compares so with `low`; `high` is the other end of BETWEEN."""

    measure: Measure
    relation: Relation
    low: Scalar
    high: float | None = None


@dataclass(frozen=True, slots=True)
class Placed:
    """A filter: the part's centre lies so along `axis` as seen from the centre of `reference`."""

    axis: int
    relation: Relation
    reference: Target


@dataclass(frozen=True, slots=True)
class Centered:
    """A filter: the part's centre is the model's centre along all of `axes`; along at least two of three when empty."""

    axes: tuple[int, ...] = ()


@dataclass(frozen=True, slots=True)
class AnyOf:
    """A filter: at least one of the bounds holds."""

    bounds: tuple[Bound, ...]


@dataclass(frozen=True, slots=True)
class Seen:
    """A filter: the part is, or is not, visible from `side`."""

    side: Side
    visible: bool


@dataclass(frozen=True, slots=True)
class Within:
    """A filter: the part's centre lies inside the box of one of `reference`."""

    reference: Selection


@dataclass(frozen=True, slots=True)
class Holding:
    """A filter: one of `members` lies in the part, as the holes of a bolt circle do."""

    members: Selection


@dataclass(frozen=True, slots=True)
class Bottom:
    """A filter: a hole's bottom has this form: 'flat', 'conical', 'spherical', 'through' or 'open'."""

    form: str
    holds: bool


@dataclass(frozen=True, slots=True)
class Described:
    """A filter: the part is, or is not, among those that `description` finds."""

    description: str
    holds: bool


Filter: TypeAlias = Bound | AnyOf | Placed | Centered | Seen | Within | Holding | Bottom | Described


@dataclass(frozen=True, slots=True)
class ByMeasure:
    """An order of parts: by a measure."""

    measure: Measure


@dataclass(frozen=True, slots=True)
class ByPlace:
    """An order of parts: along an axis."""

    axis: int


@dataclass(frozen=True, slots=True)
class ByDistance:
    """An order of parts: by the distance from `reference`, or from the model's edge when None."""

    reference: Target | Origin | None


Order: TypeAlias = ByMeasure | ByPlace | ByDistance


@dataclass(frozen=True, slots=True)
class Rank:
    """The part that comes `nth` in an order, from its large or its small end; the first `count` parts when over 1."""

    order: Order
    largest: bool
    nth: int = 1
    count: int = 1


@dataclass(frozen=True, slots=True)
class Phrase:
    """A noun phrase about parts: what to look for, and which of them are meant."""

    description: str
    noun_class: NounClass
    plural: bool = False
    sides: tuple[Side, ...] = ()
    filters: tuple[Filter, ...] = ()
    ranks: tuple[Rank, ...] = ()
    stands: bool = False
    """They are said to be on the side, not only to be visible from there; SegCAD looks which way they point."""
    sample: bool = False
    """Any one of them is meant: 'one of the holes'. Their different values answer for it."""

    @property
    def noun(self) -> str:
        """Which word names the parts? The last one before what says where they are or what they have."""
        words = self.description.split()
        end = next((i for i, word in enumerate(words) if i and word in LINKS), len(words))
        return words[end - 1]


LINKS = frozenset(
    (
        "between",
        "near",
        "in",
        "on",
        "of",
        "at",
        "with",
        "without",
        "for",
        "around",
        "from",
        "to",
        "inside",
        "through",
        "by",
    )
)
"""Words that end the noun of a description; what follows is a place or a trait."""


@dataclass(frozen=True, slots=True)
class Selection:
    """The parts of one phrase, or of several ('holes and slots')."""

    phrases: tuple[Phrase, ...]

    @property
    def plural(self) -> bool:
        """Does the wording ask for one value per part?"""
        return len(self.phrases) > 1 or self.phrases[0].plural

    @property
    def single(self) -> bool:
        """Is it one part, whatever the model holds, because a superlative picks it?"""
        return len(self.phrases) == 1 and bool(self.phrases[0].ranks) and self.phrases[0].ranks[-1].count == 1

    @property
    def noun_class(self) -> NounClass:
        """How sizes are meant: that of all phrases, OTHER where they differ."""
        classes = {phrase.noun_class for phrase in self.phrases}
        return classes.pop() if len(classes) == 1 else NounClass.OTHER


Target: TypeAlias = Selection | Whole


@dataclass(frozen=True, slots=True)
class Origin:
    """The origin of the file's frame."""


@dataclass(frozen=True, slots=True)
class Boundary:
    """The outermost plane of the whole model on one side."""

    side: Side


@dataclass(frozen=True, slots=True)
class Plane:
    """The outermost plane of parts on one side: the underside of a foot, the front face of a flange."""

    side: Side
    of: Selection


Place: TypeAlias = Selection | Whole | Origin | Boundary | Plane


@dataclass(frozen=True, slots=True)
class Get:
    """Which values do `measures` have?"""

    measures: tuple[Measure, ...]
    target: Target
    reduce: Reduce = Reduce.EACH
    nth: int = 1


@dataclass(frozen=True, slots=True)
class Distance:
    """How far apart are two places, or every two parts of one selection when `second` is None?"""

    first: Place
    second: Place | None
    centers: bool
    axis: int | None = None
    reduce: Reduce = Reduce.EACH
    alike: bool = False
    """Of neighbours in a row or circle, which are alike: only like parts are measured, where there are any."""


@dataclass(frozen=True, slots=True)
class Count:
    """How many parts, or how many different values of `measure` among them?"""

    target: Selection
    measure: Measure | None = None


Scalar: TypeAlias = Get | Distance | Count | float


class Operation(StrEnum):
    """What is made of two numbers."""

    MINUS = "minus"
    WITHOUT = "without"
    """Minus what a body or the whole model holds: a feature does not hold what stands on it."""
    APART = "apart"
    """Their difference, whichever is larger."""
    PLUS = "plus"
    RATIO = "ratio"


@dataclass(frozen=True, slots=True)
class Calculate:
    """What does the operation give for `left` and `right`?"""

    operation: Operation
    left: Scalar
    right: Scalar


@dataclass(frozen=True, slots=True)
class Compare:
    """Does `left` compare so with `right`?"""

    left: Scalar
    relation: Relation
    right: Scalar


@dataclass(frozen=True, slots=True)
class Overhang:
    """How far does each part reach out of `holder`, on the side where it reaches farthest out of the whole model?"""

    target: Selection
    holder: Selection


@dataclass(frozen=True, slots=True)
class Span:
    """How long are parts together, along the axis on which they lie apart: over the flanges?"""

    target: Selection


@dataclass(frozen=True, slots=True)
class Exists:
    """Is there such a part?"""

    target: Selection


@dataclass(frozen=True, slots=True)
class Every:
    """Do all the parts pass the filters?"""

    target: Selection
    filters: tuple[Filter, ...]


@dataclass(frozen=True, slots=True)
class Uniform:
    """Do all the parts have the same value?"""

    measure: Measure
    target: Selection


@dataclass(frozen=True, slots=True)
class Angle:
    """Which angle do two parts enclose (`second` None: every two of one selection)?"""

    first: Selection
    second: Selection | None
    seen: bool = False
    """Of neighbours around a centre: as seen from the middle of all of them."""


@dataclass(frozen=True, slots=True)
class Aligned:
    """Do two parts enclose exactly `angle` (radians)?"""

    first: Selection
    second: Selection | None
    angle: float


@dataclass(frozen=True, slots=True)
class Parts:
    """Which parts are they?"""

    target: Selection


Query: TypeAlias = (
    Get | Distance | Overhang | Span | Calculate | Compare | Count | Exists | Every | Uniform | Angle | Aligned | Parts
)


def descriptions(meaning: object) -> Iterator[str]:
    """Which descriptions of parts are in a meaning?"""
    if isinstance(meaning, (Phrase, Described)):
        yield meaning.description
    if isinstance(meaning, tuple):
        for item in meaning:
            yield from descriptions(item)
    elif is_dataclass(meaning):
        for field in fields(meaning):
            yield from descriptions(getattr(meaning, field.name))
