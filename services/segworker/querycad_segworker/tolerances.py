"""How near is the same? What several families of features share; limits of one family stand in its own module."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Tolerances:
    """Tolerances for one model, lengths in metres.

    Lengths follow the model's size, so that a model scaled by 0.01 or 100 is recognised alike.
    """

    length: float
    """Two points, axes or radii nearer than this are the same."""
    canonical: float
    """A freeform surface this near to a plane, cylinder, cone or sphere is one."""
    angle: float = math.radians(0.1)
    """Two directions nearer than this are parallel: CAD systems write directions to far more digits, but converted
    files carry errors of some 1e-4 rad."""
    smooth: float = math.radians(2.0)
    """Faces that meet with less than this between their normals are tangent: blends of converted files are off by
    up to one degree, while a real draft or chamfer edge is rarely below three."""

    @classmethod
    def for_diagonal(cls, diagonal_m: float) -> Tolerances:
        """Which tolerances suit a model whose bounding box has this diagonal, in metres?

        `length`: 1e-5 of the diagonal; writers keep 1e-7 m at least, and the smallest feature worth naming is a
        thousand times larger than this. `canonical`: 1e-5 of the diagonal, a tenth of usual drawing tolerances.
        """
        return cls(length=1e-5 * diagonal_m, canonical=1e-5 * diagonal_m)


TIE = 1e-4
"""Designs meet limits such as half or twice exactly, and files round: a size this near to a limit is at it. Below what
drawings tell (0.01 mm of 100 mm), above the digits that files lose in a shift or from inches."""


def exceeds(size: float, limit: float) -> bool:
    """Is a size more than a limit, both positive? What is at it is not."""
    return size > limit * (1 + TIE)


def reaches(size: float, limit: float) -> bool:
    """Is a size a limit or more, both positive? What is at it is."""
    return size >= limit * (1 - TIE)


def significant(size: float) -> float:
    """A size to four digits, to sort by: what is drawn alike is alike, and the next rule decides."""
    return float(f"{size:.4g}")


@dataclass(frozen=True, slots=True)
class Facing:
    """Which directions go the same way? Cosines of the angle between two unit vectors, above which they do."""

    viewer: float = 0.5
    """A plane face is turned to the viewer up to 60 degrees: beyond, it shows less than half of itself."""
    along_view: float = 0.9
    """One looks along the axis of an arc within 26 degrees: its mouth is seen."""
    opposed: float = 0.99
    """The flanks of a slot face each other within 8 degrees, as those of a rib do: draft on both leaves so much."""
    alike: float = 0.99
    """Planes look one way within 8 degrees: a floor to where its pocket opens, ribs of one row."""
    parallel: float = 0.999
    """Walls, and the axes of holes in a row, are parallel within 2.5 degrees: one saw cut, one line of sight."""


FACING = Facing()
"""The same for every model: angles do not grow with it."""
