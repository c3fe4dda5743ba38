"""A lens holder, turned about z, as loose surfaces: a tube with a seat and clamping screws on a post with a foot."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, radians, sin

from build123d import Axis, Part, Pos, Rot

from benchmark.kit import Form, Item, Model, Triple, angle, count, length, lengths, points
from benchmark.shapes import BACK, DOWN, FRONT, block, rod

MODEL = Model("Lens holder", "dev", Form.SURFACES)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres and degrees; not yet turned, the optical axis is y, the foot lies on z = 0 about x = y = 0."""

    foot: tuple[float, float, float] = (64, 40, 9)
    fixing: float = 6.6  # for M6
    fixing_head: float = 11
    fixing_head_depth: float = 4
    fixing_x: float = 50
    post: tuple[float, float] = (16, 20)  # along x and y
    axis: float = 58  # height
    tube: float = 50
    bore: float = 40
    stop: float = 34  # inner diameter of the lens's seat
    stop_width: float = 3  # at the rear end
    length: float = 28
    screws: int = 3
    screw: float = 2.5  # core hole of M3
    slots: int = 4  # of the face at the front, for a pin wrench
    slot: tuple[float, float] = (4, 3)  # width, depth along the axis
    turn: float = 30  # about z

    def turned(self, at: Triple) -> Triple:
        """Where does a point go?"""
        c, s = cos(radians(self.turn)), sin(radians(self.turn))
        return (c * at[0] - s * at[1], s * at[0] + c * at[1], at[2])


def build(p: P) -> Part:
    """Mills, bores, turns into place."""
    half = p.length / 2
    body = block(p.foot) + block((*p.post, p.axis))
    body += rod(p.tube, p.length, (0, -half, p.axis), BACK)
    body -= rod(p.stop, p.length, (0, -half, p.axis), BACK)
    body -= rod(p.bore, p.length - p.stop_width, (0, half - p.stop_width, p.axis), FRONT)
    for x in (-p.fixing_x / 2, p.fixing_x / 2):
        body -= rod(p.fixing, p.foot[2], (x, 0, 0))
        body -= rod(p.fixing_head, p.fixing_head_depth, (x, 0, p.foot[2]), DOWN)
    screw = rod(p.screw, p.tube / 2, (0, 0, p.tube / 2), DOWN)
    body -= [Pos(0, 0, p.axis) * screw.rotate(Axis.Y, 360 * i / p.screws) for i in range(p.screws)]
    wrench = block((p.slot[0], p.slot[1], p.tube), (0, -half + p.slot[1] / 2, 0))
    hollow = rod(p.bore, p.slot[1], (0, -half, p.axis), BACK)
    for index in range(p.slots):
        body -= Pos(0, 0, p.axis) * wrench.rotate(Axis.Y, 45 + 360 * index / p.slots) - hollow
    return Rot(0, 0, p.turn) * body


def questions(p: P) -> list[Item]:
    """Asked in an optics laboratory, by a doctoral student, a technician and a machinist."""
    return [
        length("tube", "diameter", "What is the outer diameter of the tube that holds the lens?", p.tube),
        length("tube", "length", "How long is the lens tube along its own axis?", p.length),
        length("tube", "radius", "What's the radius of the tube's wider bore, where the lens goes in?", p.bore / 2),
        length("hole", "diameter", "Clear aperture (the narrowest diameter of the big hole)?", p.stop),
        lengths(
            "hole",
            "radius",
            "Which different radii does the large stepped hole in the tube have?",
            [p.stop / 2, p.bore / 2],
        ),
        count("radial slots", "How many radial slots are there in the front face of the tube?", p.slots),
        lengths("radial slots", "width", "width of the radial slots", [p.slot[0]] * p.slots),
        lengths(
            "radial slots",
            "depth",
            "How deep are the radial slots, measured along the tube's axis?",
            [p.slot[1]] * p.slots,
        ),
        count("threaded hole", "How many small holes for clamping screws go radially into the tube?", p.screws),
        lengths("threaded hole", "diameter", "Diameters of the radial screw holes, please.", [p.screw] * p.screws),
        angle("threaded hole", "What angle is between two neighbouring radial screw holes?", 360 / p.screws),
        count("hole", "How many counterbored holes does the foot plate have?", 2),
        length("hole", "distance", "Spacing of the two fixing holes in the foot?", p.fixing_x),
        points(
            "mounting hole",
            "What are the centres of the two counterbored holes?",
            [p.turned((x, 0, p.foot[2] / 2)) for x in (-p.fixing_x / 2, p.fixing_x / 2)],
        ),
        lengths("hole", "depth", "How deep are the counterbores themselves?", [p.fixing_head_depth] * 2),
        length("rectangular part", "thickness", "How thick is the foot plate?", p.foot[2]),
        length("object", "height", "How tall is the whole holder?", p.axis + p.tube / 2),
        length("tube", "distance", "How high is the optical axis above the underside of the foot?", p.axis),
    ]
