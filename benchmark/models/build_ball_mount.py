"""A ball mount of a trailer hitch in inches: square tube, drop plate, ball plate, gussets, holes for pin and ball."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, Plane, Polyline, chamfer, extrude, make_face

from benchmark.kit import INCH, Item, Model, count, length, lengths, size
from benchmark.shapes import BACK, block, rod

MODEL = Model("Ball mount of a trailer hitch", "dev", unit="in")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres from inches; the tube runs along x and ends at x = 0 on the drop plate, its axis is y = z = 0."""

    tube: float = 2 * INCH  # outside, square
    wall: float = 0.25 * INCH
    shank: float = 8 * INCH
    pin: float = 0.625 * INCH  # through both side walls
    pin_x: float = 2 * INCH  # from the open end
    drop: tuple[float, float, float] = (0.75 * INCH, 2.5 * INCH, 6 * INCH)  # flush with the tube's top
    plate: tuple[float, float, float] = (
        4 * INCH,
        3 * INCH,
        0.75 * INCH,
    )  # its underside is flush with the drop plate's
    ball: float = 1.03125 * INCH  # for a 1 inch shank
    ball_x: float = 2.25 * INCH  # from the drop plate
    corner: float = 0.5 * INCH  # bevels of the plate's free corners, at 45 degrees
    gusset: tuple[float, float, float] = (1.25 * INCH, 0.375 * INCH, 1.5 * INCH)
    gusset_y: float = 1 * INCH  # of their middles
    tapped: float = 0.257 * INCH  # core hole of 5/16-18 UNC
    tapped_depth: float = 0.5 * INCH
    tapped_z: tuple[float, float] = (-1.75 * INCH, -2.75 * INCH)  # in the front of the drop plate
    pad: tuple[float, float, float] = (1.5 * INCH, 1 * INCH, 0.125 * INCH)  # for the type number, on the tube
    pad_x: float = -3 * INCH

    @property
    def low(self) -> float:
        """Where on z is the underside?"""
        return self.tube / 2 - self.drop[2]


def gusset(p: P, y: float) -> Part:
    """A triangle between drop plate and ball plate."""
    reach, thick, high = p.gusset
    x, z = p.drop[0], p.low + p.plate[2]
    outline = make_face(Polyline((x, z), (x + reach, z), (x, z + high), close=True))
    return extrude(Plane.XZ.offset(-(y + thick / 2)) * outline, amount=thick)


def build(p: P) -> Part:
    """Welds tube, plates, gussets and pad, drills."""
    thick, reach, low = p.drop[0], p.plate[0], p.low
    hollow = p.tube - 2 * p.wall
    tube = block((p.shank, p.tube, p.tube), (-p.shank / 2, 0, -p.tube / 2))
    tube -= block((p.shank, hollow, hollow), (-p.shank / 2, 0, -hollow / 2))
    tube += block(p.pad, (p.pad_x, 0, p.tube / 2))
    tube -= rod(p.pin, p.tube, (p.pin_x - p.shank, -p.tube / 2, 0), BACK)
    plate = block(p.plate, (thick + reach / 2, 0, low))
    plate = chamfer(plate.edges().filter_by(Axis.Z).group_by(Axis.X)[-1], p.corner)
    plate -= rod(p.ball, p.plate[2], (thick + p.ball_x, 0, low))
    drop = block(p.drop, (thick / 2, 0, low))
    drop -= [rod(p.tapped, p.tapped_depth, (thick / 2, -p.drop[1] / 2, z), BACK) for z in p.tapped_z]
    return drop + tube + plate + [gusset(p, y) for y in (-p.gusset_y, p.gusset_y)]


def questions(p: P) -> list[Item]:
    """Asked in the plain way, and by an American welder, a farmer and a purchasing agent."""
    hollow = p.tube - 2 * p.wall
    extents = (p.shank + p.drop[0] + p.plate[0], p.plate[1], p.drop[2] + p.pad[2])
    return [
        size(
            "rectangular inside",
            "What is the size of the rectangular inside visible from the left?",
            (p.shank, hollow, hollow),
        ),
        count("blind hole", "How many blind holes are visible from the front?", 2),
        lengths("blind hole", "depth", "What is the depth of the blind holes on the front?", [p.tapped_depth] * 2),
        length("hole", "diameter", "What is the diameter of the largest hole visible from the front?", p.pin),
        length(
            "rectangular protrusion", "height", "What is the height of the rectangular protrusion on the top?", p.pad[2]
        ),
        size("object", "What are the extents of the object?", extents, "extents"),
        length("through hole", "radius", "What is the radius of the through hole visible from the bottom?", p.ball / 2),
        length("tube", "thickness", "wall thickness of the square tubing?", p.wall),
        length("mounting hole", "diameter", "What size is the hole that the hitch ball gets bolted into?", p.ball),
        length("rectangular part", "thickness", "How thick is the horizontal plate the ball sits on?", p.plate[2]),
        lengths("rib", "thickness", "thickness of the two gussets", [p.gusset[1]] * 2),
        lengths(
            "bevel", "size", "The 45° bevels on the corners of the ball plate: how long is each leg?", [p.corner] * 2
        ),
        length(
            "hole",
            "distance",
            "How far is it from the open end of the square tube to the center of the hitch pin hole?",
            p.pin_x,
        ),
        length(
            "threaded hole",
            "distance",
            "Center to center spacing of the tapped holes on the front of the drop plate",
            p.tapped_z[0] - p.tapped_z[1],
        ),
    ]
