"""A tool holder with a steep taper, lying along x: cone, grooved flange with drive slots, nose, bore; a B-spline."""

from __future__ import annotations

from dataclasses import dataclass
from math import atan, degrees

from build123d import Part

from benchmark.kit import Form, Item, Model, angle, count, length, lengths
from benchmark.shapes import DOWN, LEFT, RIGHT, block, cone, rod

MODEL = Model("Tool holder with steep taper", "dev", Form.BSPLINE)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is x, the cone's thick end lies in x = 0, its thin end points to the left."""

    gauge: float = 31.75  # taper 30 (ISO 7388)
    taper: float = 7 / 24
    cone_length: float = 48
    flange: float = 50
    flange_length: float = 20
    groove: float = 42
    groove_width: float = 6
    groove_start: float = 8
    drive_slot: float = 16.1
    drive_floor: float = 18.5  # from the axis
    nose: float = 40
    nose_length: float = 32
    bevel: float = 2  # 45 degrees
    bore: float = 16
    bore_depth: float = 38
    pull_stud: float = 10.2  # core of M12
    pull_stud_depth: float = 24
    clamp: float = 8.5  # core of M10
    clamp_from_end: float = 14

    @property
    def thin(self) -> float:
        """Diameter of the cone's thin end."""
        return self.gauge - self.taper * self.cone_length

    @property
    def end(self) -> float:
        """Where the nose ends along x."""
        return self.flange_length + self.nose_length


def build(p: P) -> Part:
    """Turns the outside, mills the drive slots at front and back, drills from both ends and from the top."""
    body = cone(p.thin, p.gauge, p.cone_length, (-p.cone_length, 0, 0), RIGHT)
    body += rod(p.flange, p.flange_length, (0, 0, 0), RIGHT)
    body += rod(p.nose, p.nose_length - p.bevel, (p.flange_length, 0, 0), RIGHT)
    body += cone(p.nose, p.nose - 2 * p.bevel, p.bevel, (p.end - p.bevel, 0, 0), RIGHT)
    start = (p.groove_start, 0, 0)
    body -= rod(p.flange + 2, p.groove_width, start, RIGHT) - rod(p.groove, p.groove_width, start, RIGHT)
    reach = p.flange / 2 - p.drive_floor
    for side in (-1, 1):
        slot = (p.flange_length, reach, p.drive_slot)
        body -= block(slot, (p.flange_length / 2, side * (p.drive_floor + reach / 2), -p.drive_slot / 2))
    body -= rod(p.bore, p.bore_depth, (p.end, 0, 0), LEFT)
    body -= rod(p.pull_stud, p.pull_stud_depth, (-p.cone_length, 0, 0), RIGHT)
    return body - rod(p.clamp, p.nose / 2, (p.end - p.clamp_from_end, 0, p.nose / 2), DOWN)


def questions(p: P) -> list[Item]:
    """Asked in the plain way, and by a toolmaker, a grinder and an apprentice."""
    return [
        length("cone", "length", "Length of the cone along the x axis?", p.cone_length),
        length("cone", "diameter", "State the diameter of the cone at its thick end.", p.gauge),
        length("flange", "diameter", "Give me the outer diameter of the flange.", p.flange),
        length("bevel", "size", "Size of the 45° bevel at the right-hand end, measured along the axis?", p.bevel),
        length("hole", "depth", "How deep has the 16 mm bore on the right been drilled?", p.bore_depth),
        length(
            "threaded hole", "radius", "Radius of the threaded hole that is visible from the left?", p.pull_stud / 2
        ),
        length("threaded hole", "depth", "Determine the depth of the hole on the left.", p.pull_stud_depth),
        count("rectangular slot", "Give the number of rectangular slots cut into the rim of the flange.", 2),
        length(
            "cylinder", "diameter", "What is the outer diameter of the cylinder to the right of the flange?", p.nose
        ),
        angle(
            "cone",
            "What is the full included angle of the taper, from one flank to the opposite one?",
            degrees(2 * atan(p.taper / 2)),
        ),
        length("cone", "diameter", "and how thick is the taper at its thin end?", p.thin),
        lengths(
            "rectangular slot",
            "width",
            "The two drive slots in the flange: how far apart are the side walls in each of them?",
            [p.drive_slot] * 2,
        ),
        length(
            "groove", "width", "How wide, along the axis, is the groove that runs round the flange?", p.groove_width
        ),
        length(
            "threaded hole",
            "diameter",
            "From the top a clamping screw goes in. Which core diameter was drilled for it?",
            p.clamp,
        ),
    ]
