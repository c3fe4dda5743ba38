"""What a disc is made of that is turned out on one or both sides: the rim and the web of a wheel, pulley or gear."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from querycad_contracts import Part
from querycad_segworker.features.holes.hole import RIM, Hole
from querycad_segworker.features.shared.part_measures import (
    faces_area,
    faces_box,
    geometry,
    millimetres,
    stance,
)
from querycad_segworker.features.turned.bosses import Boss
from querycad_segworker.topology import Brep
from querycad_segworker.vectors import add, box_extents, dot, line_distance, mid, parallel, scale, sub

ON_AXIS = 0.02
"""Two axes are one that are nearer to each other than this share of the radius."""


def wheel_parts(brep: Brep, holes: Sequence[Hole], bosses: Sequence[Boss]) -> list[Part]:
    """The rims around ring-shaped recesses that are wider than the rim is thick, and the webs between two recesses."""
    rings = [hole for hole in holes if hole.core_radius is not None]
    found = [*_rims(brep, rings, bosses), *_webs(brep, rings)]
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
            if thickness >= radius - core:
                continue
            faces = tuple(sorted({*a.faces, *b.faces}))
            yield Part(
                id="web",
                kind="wall",
                tags=("planar", "annular", "web", stance(a.normal)),
                label=f"web, thickness {millimetres(thickness)}, between hub and rim",
                faces=faces,
                center=mid(*floors),
                extents=box_extents(faces_box(brep, faces)),
                axis=a.normal,
                normal=a.normal,
                thickness=thickness,
                length=2 * radius,
                width=radius - core,
                radii=(radius, core),
                area=faces_area(brep, faces),
                evidence=geometry("the floors of two ring-shaped recesses that look away from each other"),
            )
