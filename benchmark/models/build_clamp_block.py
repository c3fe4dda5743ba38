"""A clamp block turned obliquely: nut holes (hexagonal pockets) over clearance holes, a slot through its middle."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

from build123d import Part, Pos, Rot

from benchmark.kit import Item, Model, Triple, count, length, lengths, points, volume
from benchmark.shapes import DOWN, block, prism, rod

MODEL = Model("Clamp block in an oblique position", "dev")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres and degrees; before it is turned the block lies on z = 0, its slot opens upwards and runs along y."""

    size: tuple[float, float, float] = (80, 40, 30)
    slot_width: float = 10
    slot_depth: float = 18
    nuts: int = 2
    nut_flats: float = 13  # M8 (ISO 4032)
    nut_depth: float = 7
    bolt: float = 8.4
    bolt_spacing: float = 54
    turn: tuple[float, float, float] = (20, -35, 50)  # about x, y and z, each about the turned axes

    def turned(self, at: Triple) -> Triple:
        """Where does a point of the upright block go?"""
        x, y, z = (Rot(*self.turn) * Pos(*at)).position
        return (x, y, z)


def build(p: P) -> Part:
    """Bores, pockets for the nuts, slot; then turns it all."""
    height = p.size[2]
    tools = [block((p.slot_width, p.size[1], p.slot_depth), (0, 0, height - p.slot_depth))]
    for side in (-1, 1):
        x = side * p.bolt_spacing / 2
        tools += [rod(p.bolt, height, (x, 0, 0)), prism(p.nut_flats, p.nut_depth, (x, 0, height), DOWN)]
    return Rot(*p.turn) * (block(p.size) - tools)


def questions(p: P) -> list[Item]:
    """Asked by people whose parts do not lie along the axes."""
    width, depth, height = p.size
    hexagon = 3**0.5 / 2 * p.nut_flats**2
    circle = pi / 4 * p.bolt**2
    removed = p.slot_width * depth * p.slot_depth + p.nuts * (hexagon * p.nut_depth + circle * (height - p.nut_depth))
    bores = [p.turned((side * p.bolt_spacing / 2, 0, (height - p.nut_depth) / 2)) for side in (-1, 1)]
    return [
        count("nut hole", "How many nut holes does the clamp have?", p.nuts),
        lengths(
            "nut hole", "width", "What is the width across flats of the hexagonal nut pockets?", [p.nut_flats] * p.nuts
        ),
        lengths("nut hole", "depth", "How deep are the hexagonal recesses for the nuts?", [p.nut_depth] * p.nuts),
        count("through hole", "How many round bores go through the block?", p.nuts),
        lengths("through hole", "diameter", "What is the diameter of the round holes?", [p.bolt] * p.nuts),
        lengths("through hole", "radius", "Give the radius of the cylindrical bores.", [p.bolt / 2] * p.nuts),
        length("through hole", "distance", "How far apart are the axes of the two bores?", p.bolt_spacing),
        points("through hole", "Where are the middles of the cylindrical bores, between their ends?", bores),
        count("rectangular slot", "How many rectangular slots are cut in the block?", 1),
        length("rectangular slot", "width", "How wide is the rectangular slot?", p.slot_width),
        length(
            "rectangular slot", "depth", "What is the depth of the slot, from its mouth to its floor?", p.slot_depth
        ),
        volume("object", "What is the volume of the clamp block?", width * depth * height - removed),
    ]
