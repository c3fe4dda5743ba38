"""Bodies that are round about one axis: shafts, rods, tubes, rings, discs; and which of their ends are free."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from querycad_contracts import Bottom, Vector
from querycad_segworker.features.holes.hole import RIM, Hole
from querycad_segworker.features.shared.axes import Axis
from querycad_segworker.features.shared.clearance import IsClear
from querycad_segworker.features.shared.refusals import refuse
from querycad_segworker.tolerances import exceeds, reaches
from querycad_segworker.topology import BodyRecord, Brep
from querycad_segworker.vectors import add, dist, mid, parallel, points_up, scale, sub, unit

from .bosses import Boss
from .gears import Gear

RING_RATIO = 0.3
"""The hole of a ring or tube takes at least this share of its diameter: a third in washers of the large series
(ISO 7093), a half in those of the normal one (ISO 7089), more in sleeves."""
WASHER_RATIO = 0.25
"""A plain ring thinner than this share of its diameter is a washer: ISO 7089 has 0.1 to 0.2, spring washers 0.25."""
HOLLOW_SHARE = 0.5
"""A blind coaxial hole shorter than this share of a body is a centre or threaded hole; a longer one makes it hollow."""
MOSTLY = 0.5
"""A body with a tube over more than this share of its length is one; a hub or socket on it makes none."""
ROUND = 1.005
"""A body is round when nothing reaches beyond its widest step by more than this factor."""
COAXIAL = 0.01
"""Share of the radius by which axes of one turned part may lie apart."""
ALONG = 1e-2
"""Sine of the angle to the axis within which a hole runs along it: a cross hole, too, has its middle on the axis."""
BESIDE_RIM = 0.01
"""A look out along the axis starts this share of the radius beyond the end, clear of the end face's own triangles."""


@dataclass(frozen=True, slots=True)
class TurnedBody:
    """A body that is round about one axis, whatever is cut into it. Metres, frame of the file.

    `radius` is that of a shaft's widest step that is no collar, flange or gear; of what is no longer than wide, the
    widest of all. `radii` are those of all steps along the axis, then of the bore. `low` and `high` are its ends.
    """

    axis: Axis
    low: Vector
    high: Vector
    radius: float
    outer_radius: float
    radii: tuple[float, ...]
    bore: Hole | None
    steps: int
    tapered: bool
    """Its widest step is a cone."""
    walled: bool
    """More than half of it is a tube."""
    spoked: bool
    """It is a wheel: most of it is open between a hub and its rim."""
    wall: float | None
    """Thickness of the material around the bore, at the longest hollow step."""
    widest_at: float
    """Where along the axis the middle of the widest step lies."""
    disc: float | None
    """How thick the widest step is, where it is a disc."""
    pointed: tuple[Vector, ...]
    """Ends of it that are narrow ends of cones."""

    @property
    def length(self) -> float:
        """How long is it along its axis?"""
        return dist(self.low, self.high)

    @property
    def slender(self) -> bool:
        """Is it longer than it is wide anywhere?"""
        return exceeds(self.length, 2 * self.outer_radius)

    @property
    def tags(self) -> tuple[str, ...]:
        """What kinds of turned part is it?"""
        diameter = 2 * self.outer_radius
        tags = ["circular", "conical" if self.tapered else "cylindrical"]
        if self.slender:
            tags.append("slender")
        if self.bore is not None:
            tags.append("hollow")
        through = self.bore is not None and self.bore.bottom is Bottom.THROUGH
        wide = through and self.bore is not None and reaches(self.bore.radius, RING_RATIO * self.outer_radius)
        if wide and not reaches(self.length, 0.5 * diameter):
            low = self.steps == 1 and not reaches(self.length, WASHER_RATIO * diameter)
            tags.extend(("ring", "washer") if low else ("ring",))
        elif through and (wide or self.walled) and not self.spoked:
            tags.append("tube")
        elif self.slender and self.steps > 1:
            tags.append("shaft")
        elif self.slender:
            tags.extend(("shaft", "rod"))
        elif not reaches(self.length, 0.5 * diameter):
            tags.append("disc")
        return tuple(tags)


def turned_body(
    brep: Brep, record: BodyRecord, bosses: Sequence[Boss], holes: Sequence[Hole], gears: Sequence[Gear] = ()
) -> TurnedBody | None:
    """Is the whole body round about one axis? `bosses`, `holes` and `gears` are those of this body.

    It is when no edge lies further from the widest step's axis than that step's wall, but for what lies in a gear on
    the same axis, as long as the body is longer than the gear is wide: a shaft with teeth, not a gear with a hub.
    """
    # A cone is no wider than the cylinder whose rim it begins at.
    widest = max(bosses, key=lambda boss: boss.radius / ROUND if "conical" in boss.tags else boss.radius, default=None)
    if widest is None:
        return None
    axis = Axis(widest.base, widest.normal)
    near = COAXIAL * widest.radius
    toothed = [g for g in gears if not g.internal and axis.radius_of(g.center) < near]
    edges = brep.edges_of(record.faces)
    points = [p for e in edges for p in brep.edges[e].points]
    beyond = [p for p in points if axis.radius_of(p) > ROUND * widest.radius]
    if not all(any(_is_within(axis, p, gear) for gear in toothed) for p in beyond):
        if "slender" in widest.tags:
            refuse("shaft", record.faces, "something of the body reaches out beyond its widest round step")
        return None
    outer = max([widest.radius, *(gear.tip_radius for gear in toothed)])
    steps = [b for b in bosses if axis.radius_of(mid(b.base, b.tip)) < near]
    steps.sort(key=lambda b: axis.position(mid(b.base, b.tip)))
    positions = [axis.position(p) for p in points] + [axis.position(p) for b in steps for p in (b.base, b.tip)]
    low, high = axis.at(min(positions)), axis.at(max(positions))
    bore = _bore(holes, axis, near, dist(low, high))
    slender = exceeds(dist(low, high), 2 * outer)
    if beyond and not slender:
        refuse("shaft", record.faces, "its gear is wider than it is long: a gear with a hub")
        return None
    own = [b.radius for b in steps if "flat" not in b.tags] if slender else []
    along = [(axis.position(mid(b.base, b.tip)), b.radius) for b in steps]
    along += [(axis.position(gear.center), gear.tip_radius) for gear in toothed]
    radii = [radius for _, radius in sorted(along)] + ([bore.radius] if bore is not None else [])
    return TurnedBody(
        axis=axis,
        low=low,
        high=high,
        radius=max(own, default=widest.radius),
        outer_radius=outer,
        radii=tuple(dict.fromkeys(radii)),
        bore=bore,
        steps=len(steps),
        tapered="conical" in widest.tags,
        walled=sum(b.height for b in steps if "tube" in b.tags) > MOSTLY * dist(low, high),
        spoked=any(RIM in h.tags and axis.radius_of(h.center) < near for h in holes),
        wall=_wall(steps),
        widest_at=_widest_at(axis, widest, toothed),
        disc=(widest.between_planes or widest.height) if "flat" in widest.tags else None,
        pointed=tuple(end for end in (low, high) if _is_point(end, steps)),
    )


def _is_point(end: Vector, steps: Sequence[Boss]) -> bool:
    """Does a cone narrow towards this end?"""
    return any("conical" in step.tags and dist(step.tip, end) < COAXIAL * step.radius for step in steps)


def _wall(steps: Sequence[Boss]) -> float | None:
    """How thick is the wall of the longest hollow step, tubes before all others?"""
    longest = max(steps, key=lambda b: (b.bore_radius is not None, "tube" in b.tags, b.height), default=None)
    if longest is None or longest.bore_radius is None:
        return None
    return (longest.radius - longest.bore_radius) * math.cos(longest.lean)


def _is_within(axis: Axis, point: Vector, gear: Gear) -> bool:
    """Does a point lie between the end faces of a gear on this axis, and no further out than its tips?"""
    along = abs(axis.position(point) - axis.position(gear.center))
    return along <= 0.505 * gear.width and axis.radius_of(point) <= ROUND * gear.tip_radius


def _widest_at(axis: Axis, widest: Boss, toothed: Sequence[Gear]) -> float:
    gear = max(toothed, key=lambda g: g.tip_radius, default=None)
    return axis.position(gear.center if gear is not None else mid(widest.base, widest.tip))


def _bore(holes: Sequence[Hole], axis: Axis, near: float, length: float) -> Hole | None:
    """The coaxial hole that makes the body hollow: right through it, or at least half as deep as it is long.

    The inside of a rim is none: a wheel is bored where its hub is.
    """
    bores = (h for h in holes if not h.is_ring and RIM not in h.tags)
    along = (h for h in bores if parallel(h.normal, axis.direction, ALONG))
    coaxial = [h for h in along if axis.radius_of(h.center) < near]
    deep = [h for h in coaxial if h.bottom is Bottom.THROUGH or reaches(h.depth, HOLLOW_SHARE * length)]
    return max(deep, key=lambda h: (h.bottom is Bottom.THROUGH, h.radius), default=None)


def tips_of(body: TurnedBody, is_clear: IsClear, model_m: float) -> tuple[Vector, ...]:
    """Which ends of a turned body are free? One or both; of two, first the end away from the widest step.

    With the widest step in the middle, the one that faces top, then front, then right. Of two free ends one of which
    alone is pointed, that is the tip.
    """
    at_widest = body.widest_at - body.axis.position(mid(body.low, body.high))
    if abs(at_widest) > 1e-3 * body.length:
        first = body.low if at_widest > 0 else body.high
    else:
        first = body.high if points_up(body.axis.direction) else body.low
    second = body.low if first is body.high else body.high
    free = free_ends((first, second), body.radius, is_clear, model_m)
    pointed = tuple(end for end in free if end in body.pointed)
    return pointed if len(pointed) == 1 else free


def free_ends(ends: tuple[Vector, Vector], radius: float, is_clear: IsClear, model_m: float) -> tuple[Vector, ...]:
    """Which of the two ends of an axis have a clear way out of the model, `model_m` long? Both where neither has."""
    free = []
    for end, other in (ends, ends[::-1]):
        out = unit(sub(end, other))
        start = add(end, scale(out, BESIDE_RIM * radius))
        if is_clear(start, add(start, scale(out, model_m))):
            free.append(end)
    return tuple(free) or ends


def with_free_tips(bosses: Sequence[Boss], is_clear: IsClear, model_m: float) -> list[Boss]:
    """The same bosses; one that is free at both ends by itself, such as a rod, has its tip at a free end."""
    result = []
    for boss in bosses:
        if "free" in boss.tags and boss.step_of == 1 and "conical" not in boss.tags:
            ends = free_ends((boss.tip, boss.base), boss.radius, is_clear, model_m)
            if ends[0] != boss.tip:
                boss = replace(boss, tip=boss.base, base=boss.tip, normal=scale(boss.normal, -1.0))
            boss = replace(boss, tips=ends)
        result.append(boss)
    return result
