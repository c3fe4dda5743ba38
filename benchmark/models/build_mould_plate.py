"""The fixed half of an injection mould, stored as B-splines: two cavities, runner, sprue, guide and cooling bores."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, fillet

from benchmark.kit import Form, Item, Model, count, length, lengths, points, size
from benchmark.shapes import DOWN, FRONT, RIGHT, block, cone, drill, grid, rod

MODEL = Model("Injection mould half", "dev", Form.BSPLINE)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the underside lies on z = 0, the middle is x = y = 0, the parting plane is on top."""

    plate: tuple[float, float, float] = (200, 150, 40)
    cavity: tuple[float, float, float] = (50, 70, 12)
    cavity_x: float = 45
    cavity_corner: float = 6
    guide: float = 20
    guide_head: float = 26
    guide_head_depth: float = 6  # from below
    guides: tuple[float, float] = (170, 120)
    cooling: float = 8
    cooling_y: float = 44
    cooling_z: float = 14
    sprue: tuple[float, float] = (9, 5)  # diameters below and on top
    runner: float = 3  # radius
    screw: float = 9
    screw_bevel: float = 17  # at 90 degrees
    screw_y: float = 62
    eye: float = 10.2  # core hole of M12
    eye_depth: float = 20
    eye_x: float = 45
    eye_z: float = 28
    ejector: float = 5
    ejector_y: float = 20


def build(p: P) -> Part:
    """Mills, drills."""
    width, depth, height = p.plate
    body = block(p.plate)
    bevel = (p.screw_bevel - p.screw) / 2
    for side in (-1, 1):
        x = side * p.cavity_x
        tool = fillet(block(p.cavity, (x, 0, height - p.cavity[2])).edges().filter_by(Axis.Z), p.cavity_corner)
        body -= [tool, *(rod(p.ejector, height, (x, y, 0)) for y in (-p.ejector_y, p.ejector_y))]
        body -= rod(p.cooling, width, (-width / 2, side * p.cooling_y, p.cooling_z), RIGHT)
        body -= rod(p.screw, height, (0, side * p.screw_y, 0))
        body -= cone(p.screw_bevel, p.screw, bevel, (0, side * p.screw_y, height), DOWN)
        body -= drill(p.eye, p.eye_depth, (side * p.eye_x, depth / 2, p.eye_z), FRONT)
    for x, y in grid(2, 2, *p.guides):
        body -= [rod(p.guide, height, (x, y, 0)), rod(p.guide_head, p.guide_head_depth, (x, y, 0))]
    body -= rod(2 * p.runner, 2 * p.cavity_x, (-p.cavity_x, 0, height), RIGHT)
    return body - cone(*p.sprue, height, (0, 0, 0))


def questions(p: P) -> list[Item]:
    """Asked in the plain way, and by a toolmaker, a moulder and a CAM programmer."""
    depth = p.plate[1]
    return [
        count("rectangular indentation", "How many rectangular indentations are visible from the top?", 2),
        lengths("rectangular indentation", "depth", "How deep are the rectangular indentations?", [p.cavity[2]] * 2),
        count("hole with bevel", "How many holes with a bevel are there on the top?", 2),
        lengths("hole with bevel", "diameter", "What is the diameter of the holes with a bevel?", [p.screw] * 2),
        lengths(
            "through hole", "radius", "What is the radius of the holes visible from the right?", [p.cooling / 2] * 2
        ),
        count("blind hole", "How many blind holes are visible from the back?", 2),
        size("object", "What is the size of the object?", p.plate),
        points(
            "threaded hole",
            "Centre positions of the tapped holes in the back, please.",
            [(side * p.eye_x, (depth - p.eye_depth) / 2, p.eye_z) for side in (-1, 1)],
        ),
        lengths("through hole", "diameter", "guide bush bores: what diameter (narrow part)?", [p.guide] * 4),
        lengths("hole", "depth", "How deep is the counterbore of each of the 20 mm holes?", [p.guide_head_depth] * 4),
        length("semicircle", "radius", "What radius has the half-round runner between the two cavities?", p.runner),
        length(
            "hole",
            "distance",
            "center distance in y of the two coolant holes, the ones running through along x",
            2 * p.cooling_y,
        ),
        count("hole", "How many 5mm holes for ejector pins end in the cavities?", 4),
        lengths("bevel", "diameter", "Countersink diameter on the 9 mm screw holes?", [p.screw_bevel] * 2),
    ]
