"""What a disc is made of that is turned out on one or both sides: the rim, the web and the hub of a wheel or pulley."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from querycad_contracts import Bottom, Part, Vector
from querycad_segworker.features.holes.hole import RIM, Hole
from querycad_segworker.features.shared.part_measures import (
    faces_area,
    faces_box,
    geometry,
    millimetres,
    stance,
)
from querycad_segworker.features.turned.bosses import TUBE_RATIO, Boss
from querycad_segworker.tolerances import exceeds, reaches
from querycad_segworker.topology import Brep
from querycad_segworker.vectors import add, box_extents, dot, line_distance, mid, parallel, scale, sub

SLENDER = 2.0
"""A tube is longer than this many of its diameters."""
ON_AXIS = 0.02
"""Two axes are one that are nearer to each other than this share of the radius."""
RUNS = 0.9
"""The bore of a hub runs through this share of its length at least: the rest is recessed around it."""

WEB_RATIO = 2.0
"""A web is thinner than its recesses are wide; up to this many times as thick where they take half of the disc at
least, as in pulleys, whose groove keeps the web thick."""


def wheel_parts(brep: Brep, holes: Sequence[Hole], bosses: Sequence[Boss]) -> list[Part]:
    """The rims around ring-shaped recesses that are wider than the rim is thick, the webs between two, and the hubs."""
    rings = [hole for hole in holes if hole.core_radius is not None]
    found = [*_rims(brep, rings, bosses), *_webs(brep, rings), *_hubs(brep, holes, bosses)]
    return [part.model_copy(update={"id": f"{part.id}-{number}"}) for number, part in enumerate(found, start=1)]


def _rims(brep: Brep, rings: Sequence[Hole], bosses: Sequence[Boss]) -> Iterator[Part]:
    for boss in bosses:
        own = [ring for ring in rings if _is_in(ring, boss)]
        inner = max((ring.radius for ring in own), default=0.0)
        thickness = boss.radius - inner
        if not any(thickness < ring.radius - (ring.core_radius or 0.0) for ring in own):
            continue
        faces = tuple(sorted({*boss.faces, *(face for ring in own for face in ring.faces)}))
        yield Part(
            id=RIM,
            kind="wall",
            tags=("circular", RIM),
            label=f"rim, diameter {millimetres(2 * boss.radius)}, thickness {millimetres(thickness)}",
            faces=faces,
            center=mid(boss.base, boss.tip),
            extents=box_extents(faces_box(brep, boss.faces)),
            axis=boss.normal,
            normal=boss.normal,
            radius=boss.radius,
            diameter=2 * boss.radius,
            thickness=thickness,
            width=boss.height,
            height=boss.height,
            length=2 * boss.radius,
            radii=(boss.radius, inner),
            area=faces_area(brep, faces),
            evidence=geometry(f"a cylinder around a ring-shaped recess of radius {millimetres(inner)}"),
        )


def _is_in(ring: Hole, boss: Boss) -> bool:
    """Is a recess sunk into an end of a disc?"""
    level = dot(sub(ring.opening, boss.base), boss.normal)
    return (
        ring.body == boss.body
        and ring.radius < boss.radius
        and parallel(ring.normal, boss.normal, 1e-2)
        and line_distance(ring.center, boss.base, boss.normal) < ON_AXIS * boss.radius
        and -ON_AXIS * boss.height < level < (1 + ON_AXIS) * boss.height
    )


def _as_thick(extents: Vector, normal: Vector, thickness: float) -> Vector:
    """The extents of the recesses on both sides, but along an axis of the file as thick as what is between them."""
    x, y, z = (thickness if abs(part) > 1 - ON_AXIS else extent for extent, part in zip(extents, normal, strict=True))
    return (x, y, z)


def _webs(brep: Brep, rings: Sequence[Hole]) -> Iterator[Part]:
    """Between two recesses that open opposite ways, of one axis."""
    for i, a in enumerate(rings):
        for b in rings[i + 1 :]:
            floors = [add(ring.opening, scale(ring.normal, -ring.depth)) for ring in (a, b)]
            thickness = dot(sub(floors[0], floors[1]), a.normal)
            near = line_distance(b.center, a.center, a.normal) < ON_AXIS * a.radius
            if a.body != b.body or not near or dot(a.normal, b.normal) > 0 or thickness <= 0:
                continue
            radius, core = min(a.radius, b.radius), max(a.core_radius or 0.0, b.core_radius or 0.0)
            deep = reaches(a.depth + b.depth, thickness)
            if thickness >= (WEB_RATIO if deep else 1.0) * (radius - core):
                continue
            faces = tuple(sorted({*a.faces, *b.faces}))
            yield Part(
                id="web",
                kind="wall",
                tags=("planar", "annular", "web", stance(a.normal)),
                label=f"web, thickness {millimetres(thickness)}, between hub and rim",
                faces=faces,
                center=mid(*floors),
                extents=_as_thick(box_extents(faces_box(brep, faces)), a.normal, thickness),
                axis=a.normal,
                normal=a.normal,
                thickness=thickness,
                length=2 * radius,
                width=radius - core,
                radii=(radius, core),
                area=faces_area(brep, faces),
                evidence=geometry("the floors of two ring-shaped recesses that look away from each other"),
            )


@dataclass(frozen=True, slots=True)
class _End:
    """Where a hub may end: the tip of a boss, or the opening of a recess around its core."""

    at: Vector
    normal: Vector
    radius: float
    body: int
    faces: tuple[int, ...]


def _hubs(brep: Brep, holes: Sequence[Hole], bosses: Sequence[Boss]) -> Iterator[Part]:
    """What is around a bore and ends on both sides in a boss, or in the middle of a recess, of one radius.

    A thin and slender one is a tube, as those that go through the plates of a heat exchanger.
    """
    bored = [boss for boss in bosses if boss.hole is not None and _ends_a_core(boss, bosses)]
    ends = [_End(boss.tip, boss.normal, boss.radius, boss.body, boss.faces) for boss in bored]
    ends += [_End(one.opening, one.normal, one.core_radius, one.body, one.faces) for one in holes if one.core_radius]
    through = [hole for hole in holes if hole.bottom is Bottom.THROUGH and hole.core_radius is None]
    left = ends
    while left:
        first, *left = left
        own = [first, *(end for end in left if _same_core(first, end))]
        left = [end for end in left if end not in own]
        bore = next((hole for hole in through if _runs_in(hole, first)), None)
        levels = [dot(sub(end.at, first.at), first.normal) for end in own]
        if bore is None or all(dot(end.normal, first.normal) > 0 for end in own):
            continue
        high = max(level for level, end in zip(levels, own, strict=True) if dot(end.normal, first.normal) > 0)
        low = min(level for level, end in zip(levels, own, strict=True) if dot(end.normal, first.normal) < 0)
        runs = sum(abs(dot(sub(section.end, section.start), first.normal)) for section in bore.sections)
        if runs < RUNS * (high - low):
            continue  # bosses on two walls with a gap between them: of a hollow body, or the lugs of a fork
        faces = tuple(sorted({face for end in own for face in end.faces}))
        is_tube = exceeds(bore.radius, TUBE_RATIO * first.radius) and exceeds(high - low, SLENDER * 2 * first.radius)
        name = "tube" if is_tube else "hub"
        yield Part(
            id=name,
            kind="prism",
            tags=("circular", "cylindrical", "hub", *(("tube", "hollow", "slender") if is_tube else ())),
            label=f"{name}, diameter {millimetres(2 * first.radius)}, length {millimetres(high - low)}",
            faces=faces,
            center=add(first.at, scale(first.normal, (high + low) / 2)),
            extents=box_extents(faces_box(brep, faces)),
            axis=first.normal,
            radius=first.radius,
            diameter=2 * first.radius,
            thickness=first.radius - bore.radius,
            width=2 * first.radius,
            height=high - low,
            length=high - low,
            radii=(first.radius, bore.radius),
            outer_diameter=2 * first.radius,
            inner_diameter=2 * bore.radius,
            area=faces_area(brep, faces),
            evidence=geometry("cylinders around a bore that end on both sides"),
        )


def _ends_a_core(boss: Boss, bosses: Sequence[Boss]) -> bool:
    """May a hub end in the tip of a boss: does it come out of something wider, and does nothing wider end it?

    A flange at the end of a pipe comes out of what is narrower; so does the flange of a spool.
    """
    near = ON_AXIS * boss.radius
    for other in bosses:
        on_axis = line_distance(other.base, boss.base, boss.normal) < near and parallel(other.normal, boss.normal, 1e-2)
        if other is boss or other.body != boss.body or not on_axis:
            continue
        base, tip = (
            any(abs(dot(sub(end, at), boss.normal)) < near for end in (other.base, other.tip))
            for at in (boss.base, boss.tip)
        )
        if (base and other.radius < boss.radius + near) or (tip and other.radius > boss.radius + near):
            return False
    return True


def _same_core(first: _End, end: _End) -> bool:
    near = ON_AXIS * first.radius
    return (
        first.body == end.body
        and abs(first.radius - end.radius) < near
        and parallel(first.normal, end.normal, 1e-2)
        and line_distance(end.at, first.at, first.normal) < near
    )


def _runs_in(hole: Hole, end: _End) -> bool:
    near = line_distance(hole.center, end.at, end.normal) < ON_AXIS * end.radius
    return hole.body == end.body and hole.radius < end.radius and near and parallel(hole.normal, end.normal, 1e-2)
