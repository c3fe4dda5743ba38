"""A pillow block: a foot with two elongated holes, a bearing seat with ring grooves, tapped holes for the cover."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, chamfer

from benchmark.kit import Item, Model, count, exists, length, lengths, point, points, size
from benchmark.shapes import BACK, DOWN, block, circle, drill, rod, slot

MODEL = Model("Pillow block", "dev")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the foot stands on z = 0, its middle is x = y = 0; the seat's axis runs along y."""

    foot: tuple[float, float, float] = (160, 44, 18)
    corner: float = 5  # cut at 45 degrees
    axis: float = 60  # height of the bearing's axis
    housing: float = 84  # diameter of the rounded top, and width below it
    housing_depth: float = 36
    bore: float = 52  # outer diameter of a 6205 (ISO 15)
    groove: float = 55  # for a retaining ring (DIN 472)
    groove_width: float = 2.15
    groove_inset: float = 5
    slot: tuple[float, float] = (24, 13)
    slots_x: float = 122
    grease: float = 5  # core hole of M6
    cover_holes: int = 4
    cover_hole: float = 4.2  # core hole of M5
    cover_depth: float = 12
    cover_circle: float = 68
    relief: tuple[float, float, float] = (90, 28, 4)

    @property
    def top(self) -> float:
        """Height of the rounded top."""
        return self.axis + self.housing / 2


def build(p: P) -> Part:
    """Casts foot and housing, then machines."""
    foot = block(p.foot)
    foot = chamfer(foot.edges().filter_by(Axis.Z), p.corner)
    front = -p.housing_depth / 2
    body = foot + block((p.housing, p.housing_depth, p.axis))
    body += rod(p.housing, p.housing_depth, (0, front, p.axis), BACK)
    body -= rod(p.bore, p.housing_depth, (0, front, p.axis), BACK)
    for y in (front + p.groove_inset, -front - p.groove_inset - p.groove_width):
        body -= rod(p.groove, p.groove_width, (0, y, p.axis), BACK)
    for x in (-p.slots_x / 2, p.slots_x / 2):
        body -= slot(*p.slot, p.foot[2], (x, 0, p.foot[2]))
    body -= rod(p.grease, p.housing / 2, (0, 0, p.top), DOWN)
    for x, z in _cover(p):
        body -= drill(p.cover_hole, p.cover_depth, (x, front, z), BACK)
    return body - block(p.relief)


def questions(p: P) -> list[Item]:
    """Asked in a maintenance shop, a drawing office and a lecture on machine elements."""
    front = -p.housing_depth / 2
    return [
        count("slot", "how many elongated holes has the foot of this pillow block got?", 2),
        lengths("slot", "length", "Overall length of both fixing slots, please", [p.slot[0]] * 2),
        length("slot", "distance", "Centre-to-centre spacing of the two obround slots in the base?", p.slots_x),
        length("hole", "diameter", "I need to order a bearing. What's the diameter of the big bore?", p.bore),
        point("hole", "Coordinates of the centre of the largest hole?", (0, 0, p.axis)),
        length("through hole", "depth", "How deep is the biggest hole seen from the front?", p.housing_depth),
        length(
            "semicircle", "radius", "The housing is rounded at the top like a semicircle. Its radius?", p.housing / 2
        ),
        count("ring", "Number of ring grooves turned inside the bore", 2),
        lengths("ring", "width", "What width do the retaining ring grooves in the bore have?", [p.groove_width] * 2),
        count("threaded hole", "How many tapped holes are there in the front face of the housing?", p.cover_holes),
        length(
            "threaded hole",
            "diameter",
            "pitch circle diameter of the four tapped cover holes at the front?",
            p.cover_circle,
        ),
        lengths("blind hole", "depth", "How deep are the blind holes on the front?", [p.cover_depth] * p.cover_holes),
        points(
            "threaded hole",
            "Where exactly are the centers of the M5 holes visible from the front?",
            [(x, front + p.cover_depth / 2, z) for x, z in _cover(p)],
        ),
        length("hole", "radius", "What radius has the round lubrication hole on top?", p.grease / 2),
        length(
            "rectangular indentation", "depth", "Depth of the rectangular indentation on the underside?", p.relief[2]
        ),
        count("bevel", "How many vertical corners of the foot are bevelled?", 4),
        count("hole", "How many round holes are between 4 and 6 mm in diameter?", p.cover_holes + 1),
        exists("slot", "Does the bore contain a keyway?", False),
        length(
            "hole", "distance", "At what height above the bottom of the foot is the axis of the bearing bore?", p.axis
        ),
        size("object", "Extents of the whole pillow block in x, y and z?", (p.foot[0], p.foot[1], p.top), "extents"),
    ]


def _cover(p: P) -> list[tuple[float, float]]:
    """Where are the cover's holes, x and z?"""
    return circle(p.cover_holes, p.cover_circle, 45, (0, p.axis))
