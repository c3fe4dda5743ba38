"""Bores drilled in one go, through both walls of a fork or across the bore of a shaft, are one hole."""

from __future__ import annotations

from collections.abc import Sequence

from querycad_contracts import Bottom, Vector
from querycad_segworker.features.shared.axes import Axis, by_line
from querycad_segworker.features.shared.clearance import IsClear
from querycad_segworker.features.shared.refusals import refuse
from querycad_segworker.tolerances import Tolerances
from querycad_segworker.vectors import ORIGIN, dist, dot, mid, scale, sub

from .hole import Hole
from .sections import different_radii

FORK_GAP = 2.0
"""Two bores of one radius on one axis, this many diameters apart or nearer with nothing between, are one hole drilled
through two walls: the gap of a fork head is about its pin's diameter (DIN 71752)."""

REACH = 1e3
"""How far apart, in length tolerances, the keys of one line may be: `Axis.same_line` forgives 0.3 degrees, which over
the length of the model is 5e-3 of it."""


def united_through_walls(holes: Sequence[Hole], tolerances: Tolerances, is_clear: IsClear) -> list[Hole]:
    """Bores drilled in one go through two walls with a gap between them, made one hole."""
    result = []
    for line in _by_line(holes, tolerances):
        axis = _axis(line[0])
        kept: list[Hole] = []
        for hole in sorted(line, key=lambda hole: axis.position(hole.center)):
            united = _united(kept[-1], hole, tolerances, is_clear) if kept else None
            kept[-1:] = [united] if united is not None else [*kept[-1:], hole]
        result.extend(kept)
    return result


def _by_line(holes: Sequence[Hole], tolerances: Tolerances) -> list[list[Hole]]:
    """Holes of one body and radius that lie on one line, together."""

    def alike(a: Hole, b: Hole) -> bool:
        same = a.body == b.body and abs(a.radius - b.radius) <= 3 * tolerances.length
        return same and _axis(a).same_line(_axis(b), tolerances)

    fixed = holes[0].opening if holes else ORIGIN
    return by_line(holes, _axis, fixed, REACH * tolerances.length, alike)


def _axis(hole: Hole) -> Axis:
    return Axis(hole.opening, hole.normal)


def _united(a: Hole, b: Hole, tolerances: Tolerances, is_clear: IsClear) -> Hole | None:
    """One hole from two, or None when they are not two walls of one drilling."""
    axis = _axis(a)
    if a.body != b.body or not axis.same_line(_axis(b), tolerances):
        return None
    upper, lower = (a, b) if axis.position(a.center) > axis.position(b.center) else (b, a)
    ends = [
        (axis.position(p), p)
        for h in (upper, lower)
        for p in ((h.opening, h.far_opening) if h.far_opening else (h.opening,))
    ]
    inner_upper = min(((t, p) for t, p in ends[: 1 + (upper.far_opening is not None)]), key=lambda e: e[0])
    inner_lower = max(((t, p) for t, p in ends[1 + (upper.far_opening is not None) :]), key=lambda e: e[0])
    gap = inner_upper[0] - inner_lower[0]
    faces_inwards = _open_towards(upper, scale(axis.direction, -1.0)) and _open_towards(lower, axis.direction)
    # Across a bore that both end in, the drill went on whatever the bore's width.
    crosses = upper.bottom is Bottom.BORE and lower.bottom is Bottom.BORE
    near = gap >= 0 and (crosses or gap <= FORK_GAP * 2 * a.radius)
    if not faces_inwards or gap < 0:
        return None
    if not near or not is_clear(inner_upper[1], inner_lower[1]):
        why = "material lies between" if near else "they are more than two diameters apart"
        refuse("hole", (*a.faces, *b.faces), f"two bores on one line are not one: {why}")
        return None
    through = upper.far_opening is not None and lower.far_opening is not None
    outer, inner = (upper, lower) if upper.far_opening is not None else (lower, upper)
    if outer.opening_radius < inner.opening_radius and through:
        outer, inner = inner, outer
    out = axis.direction if outer is upper else scale(axis.direction, -1.0)
    opening = max((p for _, p in ends), key=lambda p: dot(p, out))
    end = (
        min((p for _, p in ends), key=lambda p: dot(p, out))
        if through
        else sub(inner.opening, scale(inner.normal, inner.depth))
    )
    return Hole(
        opening=opening,
        far_opening=end if through else None,
        normal=out,
        center=mid(opening, end),
        radius=a.radius,
        opening_radius=outer.opening_radius,
        steps=different_radii(outer.steps + inner.steps, tolerances),
        depth=dist(opening, end),
        bottom=Bottom.THROUGH if through else inner.bottom,
        tags=tuple(
            dict.fromkeys(
                (*(t for t in outer.tags if t not in ("through", "blind", "cross")), "through" if through else "blind")
            )
        ),
        faces=tuple(sorted({*outer.faces, *inner.faces})),
        body=a.body,
        sections=outer.sections + inner.sections,
    )


def _open_towards(hole: Hole, direction: Vector) -> bool:
    return dot(hole.normal, direction) > 0 or hole.far_opening is not None
