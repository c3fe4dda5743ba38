"""A finger of a robot's gripper, hanging from its mounting face: key, bolt holes, pad pocket, half-round jaw."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, chamfer

from benchmark.kit import Item, Model, count, exists, length, lengths, point, points, size
from benchmark.shapes import BACK, DOWN, RIGHT, block, grid, prism, rod

MODEL = Model("Finger of a robot's gripper", "dev")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the frame lies in the middle of the mounting face, z = 0; the finger hangs down, grips to +x."""

    base: tuple[float, float, float] = (56, 42, 12)
    key: tuple[float, float, float] = (34, 8, 3.5)  # raised on the mounting face
    bolts: int = 4
    bolt: float = 5.5
    bolt_span: tuple[float, float] = (44, 30)
    dowels: int = 2
    dowel: float = 4
    dowel_depth: float = 7
    dowel_span: float = 44  # along x, at y = 0
    finger: tuple[float, float] = (22, 28)  # along x and y
    grip_x: float = 10  # of the gripping face
    bottom: float = -112
    bevel: float = 9  # of the fingertip's outer edge, at 45 degrees
    jaw: float = 8  # radius of the half round across the gripping face
    jaw_z: float = -94
    pocket: tuple[float, float, float] = (2.5, 20, 30)
    pocket_z: float = -58
    nut: float = 7  # across flats of M4 (ISO 4032)
    nut_depth: float = 3.4
    screw: float = 4.3
    sensor: float = 9
    sensor_at: tuple[float, float] = (-1, -27)  # x, z


def build(p: P) -> Part:
    """Joins base, key and finger, then cuts."""
    width, depth = p.finger
    height = -p.base[2] - p.bottom
    x = p.grip_x - width / 2
    finger = block((width, depth, height), (x, 0, p.bottom))
    finger = chamfer(finger.edges().filter_by(Axis.Y).group_by(Axis.Z)[0].sort_by(Axis.X)[0], p.bevel)
    body = finger + block(p.base, (0, 0, -p.base[2])) + block(p.key)
    body -= [rod(p.bolt, p.base[2], (x, y, 0), DOWN) for x, y in grid(2, p.bolts // 2, *p.bolt_span)]
    body -= [rod(p.dowel, p.dowel_depth, (x, 0, 0), DOWN) for x, _ in grid(p.dowels, 1, p.dowel_span, 0)]
    body -= rod(2 * p.jaw, depth, (p.grip_x, -depth / 2, p.jaw_z), BACK)
    body -= block(p.pocket, (p.grip_x - p.pocket[0] / 2, 0, p.pocket_z - p.pocket[2] / 2))
    left = p.grip_x - width
    body -= rod(p.screw, width, (left, 0, p.pocket_z), RIGHT) + prism(p.nut, p.nut_depth, (left, 0, p.pocket_z), RIGHT)
    return body - rod(p.sensor, depth, (p.sensor_at[0], -depth / 2, p.sensor_at[1]), BACK)


def questions(p: P) -> list[Item]:
    """Asked by a robot programmer, a designer, a toolmaker and a trainee."""
    middle = -p.base[2] / 2
    return [
        points(
            "mounting hole",
            "I need the hole pattern in the tool frame: centres of the four mounting holes in the base plate?",
            [(x, y, middle) for x, y in grid(2, p.bolts // 2, *p.bolt_span)],
        ),
        lengths("mounting hole", "diameter", "bolt holes thru the base plate, dia ?", [p.bolt] * p.bolts),
        count("blind hole", "number of dowel pin holes (blind) visible from the top", p.dowels),
        length("blind hole", "distance", "dowel holes c-c", p.dowel_span),
        lengths("blind hole", "depth", "and what depth have the blind dowel holes", [p.dowel_depth] * p.dowels),
        size(
            "rectangular protrusion",
            "A rectangular key on the top locates the finger in the jaw of the gripper. How big is it in x, y, z?",
            p.key,
        ),
        length("rectangular part", "thickness", "thickness of the base plate, key not included, in mm", p.base[2]),
        count("hole", "How many round holes have a diameter above 5 mm? Complete circles only.", p.bolts + 1),
        length(
            "semicircle",
            "diameter",
            "My rods sit in the semicircular recess of the finger. Which rod diameter fits in there exactly?",
            2 * p.jaw,
        ),
        length("rectangular indentation", "depth", "depth of rectangular pocket on the right side?", p.pocket[0]),
        length(
            "rectangular indentation",
            "height",
            "There is a pocket for a rubber pad on the gripping side. Which height (along z) must the pad have to fill "
            "it?",
            p.pocket[2],
        ),
        length("nut hole", "width", "nut trap in the left side of the finger, width across flats", p.nut),
        length("hole", "diameter", "dia of the cross hole for the sensor, seen from the front", p.sensor),
        point(
            "hole",
            "where is the sensor hole centred? it runs from front to back",
            (p.sensor_at[0], 0, p.sensor_at[1]),
        ),
        length(
            "object",
            "distance",
            "For the tool offset: how far is the lowest point of the finger tip below the mounting face on which the "
            "key stands?",
            -p.bottom,
        ),
        exists("slot", "Sorry for the stupid question, but has this finger a slot with round ends?", False),
    ]
