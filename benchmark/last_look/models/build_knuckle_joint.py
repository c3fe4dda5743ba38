"""A knuckle joint after the textbook: fork end, eye end, pin with head, collar, and a taper pin through both."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Compound

from benchmark.kit import Model
from benchmark.shapes import BACK, DOWN, LEFT, RIGHT, assembly, block, cone, named, prism, rod

MODEL = Model("Knuckle joint", "held_out", bodies=5)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the rods lie along x, the pin's axis is z, the joint's middle the origin; the fork is at -x."""

    rod: float = 30
    rod_length: float = 65
    octagon: float = 36  # across flats
    octagon_length: float = 30
    eye: float = 56  # outer diameter, and the fork's width
    prong: float = 14
    gap: float = 28
    fork_start: float = 45  # distance of the fork's back from the pin's axis
    gap_ground: float = 32  # distance of the gap's ground from the pin's axis
    tongue: float = 27  # thickness of the eye
    neck: float = 44  # width of the tongue behind the eye
    neck_end: float = 36  # distance of its end from the pin's axis
    pin: float = 25
    head: float = 38
    head_height: float = 10
    collar: float = 40
    collar_height: float = 12
    tail: float = 4  # of the pin below the collar
    taper_thick: float = 6
    taper_thin: float = 5.04  # 1 in 50
    taper_length: float = 48

    @property
    def half(self) -> float:
        """Half the fork's height."""
        return self.gap / 2 + self.prong


def build(p: P) -> Compound:
    """Forges both ends, bores them and pins them together."""
    fork = block((p.fork_start, p.eye, 2 * p.half), (-p.fork_start / 2, 0, -p.half))
    fork += rod(p.eye, 2 * p.half, (0, 0, -p.half))
    free = p.gap_ground + p.eye / 2
    fork -= block((free, p.eye, p.gap), (p.eye / 2 - free / 2, 0, -p.gap / 2))
    fork += prism(p.octagon, p.octagon_length, (-p.fork_start, 0, 0), LEFT, sides=8, rotation=22.5)
    fork += rod(p.rod, p.rod_length, (-p.fork_start - p.octagon_length, 0, 0), LEFT)
    fork -= rod(p.pin, 2 * p.half, (0, 0, -p.half))
    eye = rod(p.eye, p.tongue, (0, 0, -p.tongue / 2))
    eye += block((p.neck_end, p.neck, p.tongue), (p.neck_end / 2, 0, -p.tongue / 2))
    eye += prism(p.octagon, p.octagon_length, (p.neck_end, 0, 0), RIGHT, sides=8, rotation=22.5)
    eye += rod(p.rod, p.rod_length, (p.neck_end + p.octagon_length, 0, 0), RIGHT)
    eye -= rod(p.pin, p.tongue, (0, 0, -p.tongue / 2))
    length = 2 * p.half + p.collar_height + p.tail
    pin = rod(p.pin, length, (0, 0, p.half), DOWN) + rod(p.head, p.head_height, (0, 0, p.half))
    collar = rod(p.collar, p.collar_height, (0, 0, -p.half), DOWN)
    collar -= rod(p.pin, p.collar_height, (0, 0, -p.half), DOWN)
    at = (0, -p.taper_length / 2, -p.half - p.collar_height / 2)
    taper = cone(p.taper_thick, p.taper_thin, p.taper_length, at, BACK)
    return assembly(
        [
            named(fork, "Fork end", "SteelBlue"),
            named(eye, "Eye end", "Goldenrod"),
            named(pin - taper, "Knuckle pin", "Silver"),
            named(collar - taper, "Collar", "DimGray"),
            named(taper, "Taper pin", "Firebrick"),
        ]
    )
