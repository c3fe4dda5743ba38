"""Flat walls that ribs and fins have the sides of: which of the two are they? And what do they say of their bodies?"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from querycad_segworker.features.protrusions.ribs import Rib
from querycad_segworker.vectors import dot

from .flat_walls import APART, FlatWall

SAME = 0.01
"""Thicknesses that differ by less than this share are one."""
BOX = 3
"""An open box has at least so many sides; two are those of a channel or a corner."""
EDGE = 0.5
"""What is smaller than this share of the wall that has its sides is an edge of that wall, and no rib: a rib fills most
of the wall between its flanks."""


def with_fins(walls: Sequence[FlatWall], flanks: Sequence[frozenset[int]]) -> list[FlatWall]:
    """The same walls; those between the flanks of fins are marked: they are fins, and no walls of a housing.

    Gussets stay what they are, however many are alike.
    """
    return [
        replace(wall, tags=(*wall.tags, "fin"))
        if "gusset" not in wall.tags and any(map(frozenset(wall.faces).issuperset, flanks))
        else wall
        for wall in walls
    ]


def is_in_wall(rib: Rib, walls: Sequence[FlatWall]) -> bool:
    """Is it no rib by itself: a gusset, or an edge of a larger wall between the same two sides, or what encloses?"""
    flanks = set(rib.flanks)
    return any(
        not flanks.isdisjoint(wall.faces)
        if "gusset" in wall.tags
        else len(flanks) > 1
        and "fin" not in wall.tags
        and flanks.issubset(wall.faces)
        and (wall.encloses or rib.length * rib.height < EDGE * wall.length * wall.width)
        for wall in walls
    )


def besides_fins(bodies: Mapping[int, float], walls: Sequence[FlatWall]) -> dict[int, float]:
    """The thickness that most walls of each body share; where those are fins, that of its largest other wall."""
    found = dict(bodies)
    for body in {wall.body for wall in walls if "fin" in wall.tags} & bodies.keys():
        own = [wall for wall in walls if wall.body == body]
        others = [wall for wall in own if "fin" not in wall.tags and not wall.is_floor]
        alike = (wall for wall in own if abs(wall.thickness - bodies[body]) <= SAME * bodies[body])
        if others and any("fin" in wall.tags for wall in alike):
            found[body] = max(others, key=lambda wall: wall.length * wall.width).thickness
    return found


def sides_of_boxes(walls: Sequence[FlatWall]) -> dict[int, float]:
    """The thickness that the sides of each body share which is an open box, metres; its floor may be thicker.

    A flange around its opening lies along its floor, and is no side.
    """
    found = {}
    floors = {wall.body: wall.normal for wall in walls if wall.is_floor}
    for body, normal in floors.items():
        own = (wall for wall in walls if wall.body == body and wall.is_thin and "fin" not in wall.tags)
        sides = [wall.thickness for wall in own if abs(dot(wall.normal, normal)) < APART]
        if len(sides) >= BOX and max(sides) - min(sides) <= SAME * max(sides):
            found[body] = sides[0]
    return found
