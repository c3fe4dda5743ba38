"""What the parts of all families are described with: boxes, areas, lengths in labels, reasons."""

from __future__ import annotations

import math
from collections.abc import Iterable

from querycad_contracts import Evidence, Vector
from querycad_segworker.topology import Brep
from querycad_segworker.vectors import Box, box_union


def millimetres(*lengths_m: float) -> str:
    """How are lengths written in a label? Millimetres, at most three decimals: '5.5 mm', '40 x 12.5 mm'."""
    return " x ".join(f"{length * 1e3:.3f}".rstrip("0").rstrip(".") for length in lengths_m) + " mm"


def faces_box(brep: Brep, faces: Iterable[int]) -> Box:
    """Which exact box holds these faces?"""
    box = box_union(brep.faces[face].box for face in faces)
    if box is None:
        raise ValueError("a part needs at least one face")
    return box


def faces_area(brep: Brep, faces: Iterable[int]) -> float:
    """How large are these faces together, in m2?"""
    return sum(brep.faces[face].area for face in faces)


ALIGNED = 0.9998
"""Cosine of one degree: what deviates less runs along an axis of the file."""
PLATE_RATIO = 0.35
"""A body thinner than this share of its smaller other extent is a plate."""


def width_of(normal: Vector, extents: Vector, sizes: tuple[float, float]) -> float:
    """The width of something rectangular, across which `sizes` are: the smaller one, as that of a pocket.

    On an upright wall it is the level one: along x, or along y where it faces left or right. What stands oblique in the
    file, or is turned about its normal, has its own: the smaller one again.
    """
    along = max(range(3), key=lambda i: abs(normal[i]))
    if along == 2:
        return min(sizes)
    width = extents[1] if along == 0 else extents[0]
    aligned = abs(normal[along]) >= ALIGNED and any(math.isclose(width, size, rel_tol=1 - ALIGNED) for size in sizes)
    return width if aligned else min(sizes)


UPRIGHT = 0.05
"""Sine of the angle by which something upright or lying may lean: 3 degrees."""


def stance(normal: Vector) -> str:
    """How does something flat with this normal stand: 'lying', 'upright' or 'inclined'?"""
    rise = abs(normal[2])
    return "lying" if rise > 1 - UPRIGHT**2 else "upright" if rise < UPRIGHT else "inclined"


def inclination(normal: Vector) -> float:
    """By which angle is it inclined to the horizontal plane, in radians?"""
    return math.atan2(math.hypot(normal[0], normal[1]), abs(normal[2]))


def outlined(outline: str, name: str) -> str:
    """How is a part called by its outline? A free outline has no name."""
    return name if outline == "free" else f"{outline} {name}"


def geometry(reason: str) -> Evidence:
    """The evidence of a part that rests on its geometry alone."""
    return Evidence(source="geometry", confidence=1.0, reason=reason)
