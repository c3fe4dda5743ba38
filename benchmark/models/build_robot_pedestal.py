"""A robot's pedestal: octagonal base plate with radial slots, tube with gussets and a cutout, round flange on top."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Part, Pos, Rot

from benchmark.kit import Item, Model, count, length, lengths, size
from benchmark.shapes import DOWN, block, circle, prism, rod, slot

MODEL = Model("Robot pedestal", "dev")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres and degrees; the base plate lies on z = 0, its flats face x and y, the tube's axis is z."""

    flats: float = 420
    base: float = 20
    slots: int = 8
    slot: tuple[float, float] = (44, 18)  # length over all, width
    slot_circle: float = 350  # of the slots' middles
    jacks: int = 4
    jack: float = 14  # core of M16
    jack_circle: float = 370
    tube: float = 180
    wall: float = 12
    tube_height: float = 480
    gussets: int = 4
    gusset: tuple[float, float, float] = (50, 10, 120)  # radial, thickness, height
    window: tuple[float, float] = (70, 90)  # width, height
    window_z: float = 260
    flange: float = 250
    flange_height: float = 25
    flange_bore: float = 80
    flange_holes: int = 6
    flange_hole: float = 10.2  # core of M12
    flange_circle: float = 215
    dowels: int = 2
    dowel: float = 8
    dowel_depth: float = 15
    ring: float = 110
    ring_height: float = 7

    @property
    def levels(self) -> tuple[float, float]:
        """Where on z are the flange's lower and upper faces?"""
        return self.base + self.tube_height, self.base + self.tube_height + self.flange_height


def build(p: P) -> Part:
    """Welds plate, tube, gussets, flange and ring; bores, slots and drills."""
    low, top = p.levels
    body = prism(p.flats, p.base, sides=8, rotation=22.5) + rod(p.tube, p.tube_height, (0, 0, p.base))
    for index in range(p.gussets):
        radial, thick, height = p.gusset
        gusset = Pos((p.tube + radial) / 2 - 2, 0, p.base) * block((radial + 4, thick, height))
        body += Rot(0, 0, 45 + index * 360 / p.gussets) * gusset
    body += rod(p.flange, p.flange_height, (0, 0, low)) + rod(p.ring, p.ring_height, (0, 0, top))
    body -= rod(p.tube - 2 * p.wall, low) + rod(p.flange_bore, top + p.ring_height)
    for index in range(p.slots):
        turn = index * 360 / p.slots
        body -= Rot(0, 0, turn) * slot(*p.slot, p.base, (p.slot_circle / 2, 0, p.base))
    width, height = p.window
    body -= block((width, p.tube / 2, height), (0, -p.tube / 4, p.window_z))
    body -= [rod(p.jack, p.base, (x, y, 0)) for x, y in circle(p.jacks, p.jack_circle, 22.5)]
    body -= [rod(p.flange_hole, p.flange_height, (x, y, low)) for x, y in circle(p.flange_holes, p.flange_circle)]
    return body - [rod(p.dowel, p.dowel_depth, (x, y, top), DOWN) for x, y in circle(p.dowels, p.flange_circle, 90)]


def questions(p: P) -> list[Item]:
    """Asked in the plain way, and by a steel builder, a robot programmer and a site manager."""
    return [
        size("octagonal base plate", "Give me the dimensions of the octagonal base plate.", (p.flats, p.flats, p.base)),
        count("radial slots", "Count the radial slots in the octagonal base plate.", p.slots),
        lengths("radial slots", "width", "Width of the radial slots?", [p.slot[1]] * p.slots),
        length("tube", "diameter", "Determine the outer diameter of the tube between base plate and flange.", p.tube),
        length("flange", "thickness", "How thick is the flange at the top, without the ring?", p.flange_height),
        lengths("blind hole", "depth", "Depth of the blind holes on the top face?", [p.dowel_depth] * p.dowels),
        count("threaded hole", "What is the number of 10.2 mm threaded holes in the flange?", p.flange_holes),
        lengths(
            "rectangular part",
            "height",
            "State the heights of the rectangular gussets that brace the tube.",
            [p.gusset[2]] * p.gussets,
        ),
        length("cutout", "width", "Width of the rectangular cutout facing front?", p.window[0]),
        count("hole", "Number of holes in the base plate with a diameter between 12 and 16 mm?", p.jacks),
        length(
            "radial slots",
            "length",
            "How long is one of the anchor slots in the base, rounded ends included?",
            p.slot[0],
        ),
        length("tube", "thickness", "what wall thickness did they choose for the column tube?", p.wall),
        lengths(
            "hole",
            "radius",
            "I need the radius of the two dowel pin holes up on the flange, they are the 8 mm ones.",
            [p.dowel / 2] * p.dowels,
        ),
        length(
            "flange",
            "diameter",
            "The robot sits on the round flange at the top - how big is that flange across?",
            p.flange,
        ),
    ]
