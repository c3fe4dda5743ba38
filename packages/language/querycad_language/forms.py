"""What a question means, apart from the words that asked it and the Python that will answer it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, fields, is_dataclass, replace
from enum import StrEnum
from typing import Literal, TypeAlias, TypeVar, cast

from querycad_contracts import Measure, PartQuery, Relation, Side


class Reduce(StrEnum):
    """What becomes of one value per part?"""

    EACH = "each"
    ONE = "one"
    """The value that like parts share; all that differ where they do not."""
    DIFFERENT = "different"
    TOTAL = "total"
    MEAN = "mean"
    LARGEST = "largest"
    SMALLEST = "smallest"
    RANGE = "range"
    """The smallest and the largest value."""
    SIDES = "sides"
    """Of the rectangle that four parts are the corners of."""


Target: TypeAlias = PartQuery | None
"""Parts, or the whole model where None."""


@dataclass(frozen=True, slots=True)
class Boundary:
    """The outermost plane of the model on one side; the nearest edge of the part's face where None.

    `of`: the nearer of the two ends of that part, or of the model; along which `axis`, LONGEST or SHORTER.
    """

    side: Side | None
    of: Target = None
    axis: int | None = None


@dataclass(frozen=True, slots=True)
class Plane:
    """The outermost plane of a part on one side: the underside of a foot, the front face of a flange.

    Without a side: along its own length, where the part reaches furthest beyond the other plane's, or where it ends
    nearest to the other part.
    """

    side: Side | None
    of: PartQuery


@dataclass(frozen=True, slots=True)
class Behind:
    """The outer plane of the model that lies behind a cut, where the material below its floor ends."""


@dataclass(frozen=True, slots=True)
class Origin:
    """The origin of the file's frame."""


@dataclass(frozen=True, slots=True)
class MassCentre:
    """The centre of mass of the model."""


@dataclass(frozen=True, slots=True)
class Get:
    """Which values do the measures of a target have?"""

    measures: tuple[Measure, ...]
    target: Target
    reduce: Reduce = Reduce.ONE
    density: float | None = None  # kg/m3, of a mass
    overall: bool = False  # a length over all, with the head of a screw


@dataclass(frozen=True, slots=True)
class Count:
    """How many parts, or how many different values of `measure` among them?"""

    target: PartQuery
    measure: Measure | None = None


Anchor: TypeAlias = PartQuery | Boundary | Plane | Behind | Origin | MassCentre | None


@dataclass(frozen=True, slots=True)
class Distance:
    """How far apart are two anchors, or every two parts of the first where `second` is missing?"""

    first: Anchor
    second: Anchor | Literal["each other"]
    mode: Literal[
        "centers", "amid", "surfaces", "outsides", "usual", "overlap", "beyond", "beyond both", "within", "across",
        "on diameter", "on radius"
    ] = "usual"  # fmt: skip
    """'amid': from the middle of all of the second; 'outsides': over all of them; 'overlap': the volume that bodies
    share; 'beyond': less than zero if within, 'beyond both': the lesser at the two ends; 'within': how far the first
    reaches into the second; 'across': from its floor to the far side of the second, round; 'on diameter': what a bore
    has more than what runs in it."""
    axis: int | PartQuery | None = None  # 0, 1, 2 for x, y, z; LONGEST and SHORTER for the model's sides; along a part
    reduce: Reduce = Reduce.ONE


LONGEST, SHORTER, HORIZONTAL, VERTICAL = 3, 4, 5, 6
"""Along the longest side of the model, the other one of its two longer sides; as on a drawing, which is a plan of what
lies on one level: along x or y, and z or y."""


@dataclass(frozen=True, slots=True)
class Several:
    """One value each of several distances: 'the spacing in x and in y'."""

    of: tuple[Distance, ...]


@dataclass(frozen=True, slots=True)
class Angle:
    """Which angle do two parts enclose, or every two of the first?"""

    first: PartQuery
    second: PartQuery | None


Operation: TypeAlias = Literal["minus", "ratio", "plus", "apart", "per", "share"]
"""'per': of each of the others as many; 'share': in percent."""


@dataclass(frozen=True, slots=True)
class Combine:
    """What do two measures, or two numbers of parts, give together?"""

    operation: Operation
    left: Get | Count
    right: Get | Count


@dataclass(frozen=True, slots=True)
class Check:
    """Does the value compare so with a stated one, or with another value?"""

    left: Get | Count | Distance | Angle | Combine
    relation: Relation
    low: float | Get | Count | Distance
    high: float | None = None


@dataclass(frozen=True, slots=True)
class Which:
    """Which of two parts, named by these words, has more of a measure, or less; or of which are there more?"""

    left: Get | Count
    relation: Relation
    right: Get | Count
    words: tuple[str, str]


@dataclass(frozen=True, slots=True)
class Exists:
    """Is there such a part?"""

    target: PartQuery


@dataclass(frozen=True, slots=True)
class AtBothEnds:
    """Do some of the parts open, or lie, towards one end of the model and some towards the opposite one?"""

    target: PartQuery


@dataclass(frozen=True, slots=True)
class Every:
    """Are all parts of `target` among those of `among`?"""

    target: PartQuery
    among: PartQuery


@dataclass(frozen=True, slots=True)
class Either:
    """Which of two words is true of the parts: 'blind or through'? `options`: the parts that each is true of."""

    target: PartQuery
    words: tuple[str, str]
    options: tuple[PartQuery, PartQuery]


@dataclass(frozen=True, slots=True)
class Uniform:
    """Do all the parts have the same value?"""

    get: Get


@dataclass(frozen=True, slots=True)
class Parallel:
    """Are the parts' axes (or normals) parallel, square to each other, or on one line?

    `in_line`: along their 'axis', or several of them in a 'row' as well.
    """

    first: PartQuery
    second: PartQuery | None
    square: bool = False
    in_line: Literal["", "axis", "row"] = ""


@dataclass(frozen=True, slots=True)
class Facing:
    """Do all parts look to the 'same' side, some to 'opposite' ones, or lie two 'across' the middle from each other?"""

    first: PartQuery
    second: PartQuery | None
    how: Literal["same", "opposite", "across"]


@dataclass(frozen=True, slots=True)
class Parts:
    """Which parts are they?"""

    target: PartQuery


@dataclass(frozen=True, slots=True)
class Towards:
    """Towards which of these sides do parts lie or open? Seen from most, or from none, or numbers on each."""

    target: PartQuery
    sides: tuple[Side, ...]
    seen: Literal["", "most", "none", "each"] = ""
    axes: bool = False  # is a side called by the axis that it looks along: '+x'?


Form: TypeAlias = (
    Get | Count | Distance | Several | Angle | Combine | Check | Exists | Every | Uniform | Parallel | Parts | Towards
    | Facing | Which | Either | AtBothEnds
)  # fmt: skip


def queries(form: object) -> Iterator[PartQuery]:
    """The part queries of a form, each once, in the order in which they are written."""
    found: dict[PartQuery, PartQuery] = {}
    mapped(form, lambda query: found.setdefault(query, query))
    return iter(found)


F = TypeVar("F")


def mapped(form: F, change: Callable[[PartQuery], PartQuery]) -> F:
    """The form with every part query changed."""
    if isinstance(form, PartQuery):
        return cast("F", change(form))
    if isinstance(form, tuple):
        return cast("F", tuple(mapped(one, change) for one in form))
    if not is_dataclass(form) or isinstance(form, type):
        return form
    return replace(form, **{field.name: mapped(getattr(form, field.name), change) for field in fields(form)})
