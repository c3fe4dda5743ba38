"""Bores drilled in one go, through both walls of a fork or across the bore of a shaft, are one hole."""

from __future__ import annotations

from collections.abc import Sequence

from querycad_contracts import Bottom, Vector
from querycad_segworker.features.shared.axes import SWEEP, Axis
from querycad_segworker.features.shared.clearance import IsClear
from querycad_segworker.features.shared.refusals import refuse
from querycad_segworker.tolerances import Tolerances
from querycad_segworker.vectors import dist, dot, foot, mid, scale, sub

from .hole import Hole
from .sections import different_radii

FORK_GAP = 2.0
"""Two bores of one radius on one axis, this many diameters apart or nearer with nothing between, are one hole drilled
through two walls: the gap of a fork head is about its pin's diameter (DIN 71752)."""


def united_through_walls(holes: Sequence[Hole], tolerances: Tolerances, is_clear: IsClear) -> list[Hole]:
    """Bores drilled in one go through two walls with a gap between them, made one hole."""
    result = []
    for line in _by_line(holes, tolerances):
        axis = Axis(line[0].opening, line[0].normal)
        kept: list[Hole] = []
        for hole in sorted(line, key=lambda hole: axis.position(hole.center)):
            united = _united(kept[-1], hole, tolerances, is_clear) if kept else None
            kept[-1:] = [united] if united is not None else [*kept[-1:], hole]
        result.extend(kept)
    return result


def _by_line(holes: Sequence[Hole], tolerances: Tolerances) -> list[list[Hole]]:
    """Holes of one body and radius that lie on one line, together.

    The foot of one fixed point on the line is much the same for all of them: sorted by it, only few need comparing.
    """
    if not holes:
        return []
    keys = [dot(foot(holes[0].opening, hole.opening, hole.normal), SWEEP) for hole in holes]
    order = sorted(range(len(holes)), key=lambda i: keys[i])
    groups, taken = [], set[int]()
    for rank, i in enumerate(order):
        if i in taken:
            continue
        first = holes[i]
        axis = Axis(first.opening, first.normal)
        group = [first]
        for j in order[rank + 1 :]:
            if keys[j] - keys[i] > _SWEEP_REACH * tolerances.length:
                break
            other = holes[j]
            alike = other.body == first.body and abs(other.radius - first.radius) <= 3 * tolerances.length
            if alike and j not in taken and axis.same_line(Axis(other.opening, other.normal), tolerances):
                taken.add(j)
                group.append(other)
        groups.append(group)
    return groups


_SWEEP_REACH = 1e3
"""How far apart, in length tolerances, the keys of one line may be: `Axis.same_line` forgives 0.3 degrees, which over
the length of the model is 5e-3 of it."""


def _united(a: Hole, b: Hole, tolerances: Tolerances, is_clear: IsClear) -> Hole | None:
    """One hole from two, or None when they are not two walls of one drilling."""
    axis = Axis(a.opening, a.normal)
    if a.body != b.body or not axis.same_line(Axis(b.opening, b.normal), tolerances):
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
