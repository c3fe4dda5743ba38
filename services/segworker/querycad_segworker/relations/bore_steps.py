"""Steps of bores, which ring grooves part."""

from __future__ import annotations

import math
from collections.abc import Sequence

from querycad_contracts import Part, Vector
from querycad_segworker.vectors import add, dot, scale


def over_rings(step: Part, pieces: Sequence[Part], axis: Vector | None) -> Part:
    """A step of a bore as long as its pieces on both sides of a ring groove, where nothing narrower lies between.

    `pieces`: all inner cylinders of the bore; `axis`: its unit direction, in the frame of the file.
    """
    if axis is None or step.radius is None:
        return step
    spans = [(p.radius or 0.0, dot(p.center, axis), (p.height or 0.0) / 2) for p in pieces]
    like = [(at - half, at + half) for radius, at, half in spans if math.isclose(radius, step.radius)]
    low, high = min(like)[0], max(like)[1]
    if len(like) < 2 or any(low < at < high and radius < 0.999 * step.radius for radius, at, _ in spans):
        return step
    center = add(step.center, scale(axis, (low + high) / 2 - dot(step.center, axis)))
    return step.model_copy(update={"depth": high - low, "height": high - low, "length": high - low, "center": center})
