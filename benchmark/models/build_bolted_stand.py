"""A small stand of several bodies: an adapter plate on four legs, a rod with a ring, held by two named screws."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Compound

from benchmark.kit import Item, Model, count, length, lengths, point, points, size
from benchmark.shapes import DOWN, assembly, block, grid, named, prism, rod

MODEL = Model("Bolted stand", "dev", bodies=9)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the legs stand on z = 0, the plate's middle is x = y = 0."""

    plate: tuple[float, float, float] = (100, 80, 10)
    leg: tuple[float, float, float] = (12, 12, 45)
    leg_x: float = 84
    leg_y: float = 64
    rod: float = 18
    rod_length: float = 60
    ring: float = 30
    ring_height: float = 8
    ring_z: float = 25  # of its underside above the plate
    screws: float = 60  # along x
    shank: float = 8  # M8
    hole: float = 8.4
    shank_length: float = 16
    head: float = 13  # across flats, ISO 4017
    head_height: float = 5.3  # ISO 4017
    blind: float = 6
    blind_depth: float = 7
    blind_y: float = 28

    @property
    def top(self) -> float:
        """Height of the plate's upper face."""
        return self.leg[2] + self.plate[2]


def build(p: P) -> Compound:
    """Drills the plate and puts everything in its place."""
    plate = block(p.plate, (0, 0, p.leg[2]))
    xs = (-p.screws / 2, p.screws / 2)
    plate -= [rod(p.hole, p.plate[2], (x, 0, p.leg[2])) for x in xs]
    plate -= [rod(p.blind, p.blind_depth, (0, y, p.top), DOWN) for y in (-p.blind_y, p.blind_y)]
    bodies = [named(plate, "adapter plate", "steelblue")]
    bodies += [
        named(block(p.leg, (x, y, 0)), f"leg {n}", "dimgray")
        for n, (x, y) in enumerate(grid(2, 2, p.leg_x, p.leg_y), start=1)
    ]
    bodies.append(named(rod(p.rod, p.rod_length, (0, 0, p.top)), "rod", "silver"))
    ring = rod(p.ring, p.ring_height) - rod(p.rod, p.ring_height)
    bodies.append(named(ring.translate((0, 0, p.top + p.ring_z)), "ring", "red"))
    for n, x in enumerate(xs, start=1):
        screw = rod(p.shank, p.shank_length, (x, 0, p.top), DOWN) + prism(p.head, p.head_height, (x, 0, p.top))
        bodies.append(named(screw, f"hexagon screw M8 {n}", "goldenrod"))
    return assembly(bodies)


def questions(p: P) -> list[Item]:
    """Asked by an assembly robot's programmer."""
    return [
        count("leg", "How many legs are there?", 4),
        length("leg", "height", "How long are the legs? One number, please.", p.leg[2]),
        length(
            "leg",
            "distance",
            "What is the clear distance between the two legs visible from the front?",
            p.leg_x - p.leg[0],
        ),
        size("adapter plate", "What is the size of the adapter plate?", p.plate),
        length("adapter plate", "thickness", "How thick is the adapter plate?", p.plate[2]),
        length("rod", "diameter", "Rod diameter?", p.rod),
        length("rod", "length", "Length of the rod that stands on the plate?", p.rod_length),
        point("rod", "Where is the upper end of the rod?", (0, 0, p.top + p.rod_length)),
        length("ring", "diameter", "Outer diameter of the red ring?", p.ring),
        length("ring", "height", "How high is the ring?", p.ring_height),
        count("hexagonal screw", "How many hexagonal screws hold the stand together?", 2),
        lengths(
            "hexagonal screw head", "height", "How high are the heads of the hexagonal screws?", [p.head_height] * 2
        ),
        lengths(
            "screw",
            "length",
            "What is the total length of the screws, head included?",
            [p.shank_length + p.head_height] * 2,
        ),
        points(
            "screw head",
            "Where are the centres of the screw heads?",
            [(x, 0, p.top + p.head_height / 2) for x in (-p.screws / 2, p.screws / 2)],
        ),
        count("blind hole", "How many blind holes does the adapter plate have?", 2),
        lengths("blind hole", "depth", "Depth of the blind holes on the top?", [p.blind_depth] * 2),
        length("hole", "distance", "How far apart are the two blind holes?", 2 * p.blind_y),
        length("object", "height", "How high is the whole stand?", p.top + p.rod_length),
        count("object", "Of how many bodies does the assembly consist?", 9),
    ]
