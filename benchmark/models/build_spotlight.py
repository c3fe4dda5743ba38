"""A spotlight, stored as loose surfaces: circular base, stem tube, conical shade with a rim, lamp socket."""

from __future__ import annotations

from dataclasses import dataclass
from math import atan, degrees

from build123d import Part

from benchmark.kit import Form, Item, Model, angle, count, length, lengths
from benchmark.shapes import BACK, circle, cone, rod

MODEL = Model("Spotlight", "dev", Form.SURFACES)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is z, the base lies on z = 0, the shade opens upwards."""

    base: float = 110
    base_height: float = 12
    screws: int = 3
    screw: float = 4.5
    screw_circle: float = 84
    cable: float = 7  # from the front to the bore
    stem: float = 18
    stem_length: float = 60
    bore: float = 10  # from the underside up through the socket
    shade: tuple[float, float, float] = (44, 124, 70)  # both outer diameters, height
    wall: float = 2  # of the shade, measured square to the axis
    floor: float = 4  # of the shade
    rim: float = 136
    rim_height: float = 6
    socket: float = 28
    socket_height: float = 25

    @property
    def levels(self) -> tuple[float, float]:
        """Where on z begin the shade and its rim?"""
        shade = self.base_height + self.stem_length
        return shade, shade + self.shade[2]


def build(p: P) -> Part:
    """Stacks the outer contour, hollows the shade, drills."""
    low, high = p.levels
    small, large, tall = p.shade
    body = rod(p.base, p.base_height) + rod(p.stem, p.stem_length, (0, 0, p.base_height))
    body += cone(small, large, tall, (0, 0, low)) + rod(p.rim, p.rim_height, (0, 0, high))
    start = small + (large - small) * p.floor / tall - 2 * p.wall
    mouth = large - 2 * p.wall
    body -= cone(start, mouth, tall - p.floor, (0, 0, low + p.floor))
    body -= rod(mouth, p.rim_height, (0, 0, high))
    body += rod(p.socket, p.socket_height, (0, 0, low + p.floor))
    body -= rod(p.bore, low + p.floor + p.socket_height)
    body -= rod(p.cable, p.base / 2, (0, -p.base / 2, p.base_height / 2), BACK)
    return body - [rod(p.screw, p.base_height, (x, y, 0)) for x, y in circle(p.screws, p.screw_circle, 90)]


def questions(p: P) -> list[Item]:
    """Asked in the plain way, and by an electrician, a lighting designer and a student."""
    small, large, tall = p.shade
    return [
        length("circular base", "diameter", "What is the diameter of the circular base?", p.base),
        length("circular base", "height", "What is the height of the circular base?", p.base_height),
        count("mounting hole", "How many mounting holes does the circular base have?", p.screws),
        lengths("mounting hole", "diameter", "What is the diameter of the mounting holes?", [p.screw] * p.screws),
        length("ring", "diameter", "What is the outer diameter of the ring on the top?", p.rim),
        length("ring", "height", "What is the height of the ring on the top?", p.rim_height),
        length("hole", "diameter", "What is the diameter of the hole visible from the front?", p.cable),
        length("tube", "diameter", "outside diameter of the stem tube between base and shade?", p.stem),
        length("tube", "radius", "inner radius of the stem tube, where the cable runs", p.bore / 2),
        length("cone", "height", "How high is the conical shade if the rim ring is not counted?", tall),
        angle(
            "cone",
            "Full opening angle of the cone-shaped shade?",
            2 * degrees(atan((large - small) / 2 / tall)),
        ),
        length("object", "height", "How tall is the lamp all in all?", p.levels[1] + p.rim_height),
        length(
            "mounting hole",
            "diameter",
            "Hi, on what pitch circle do the three fixing holes of the base sit?",
            p.screw_circle,
        ),
        length(
            "cylinder",
            "diameter",
            "What diameter has the lamp socket, the small cylinder inside of the shade?",
            p.socket,
        ),
    ]
