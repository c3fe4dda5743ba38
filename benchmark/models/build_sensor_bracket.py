"""A sensor bracket of sheet metal: an L with cut corners, rectangular slots for adjustment and a sensor hole."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, chamfer, fillet

from benchmark.kit import Item, Model, count, length, lengths, point, points, size
from benchmark.shapes import FRONT, block, grid, rod

MODEL = Model("Sheet-metal sensor bracket", "dev")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the foot lies on z = 0, the wall stands at the back, the bend runs along x."""

    width: float = 70
    depth: float = 55
    height: float = 64
    thickness: float = 3
    bend: float = 3  # inner radius
    corner: float = 8  # cut at 45 degrees
    slots: int = 2
    slot: tuple[float, float] = (6.5, 22)  # along x, along y
    slot_spacing: float = 40
    slot_center: float = -8  # y, from the middle of the foot's depth
    sensor: float = 18.5
    sensor_height: float = 40
    screws: int = 2
    screw: float = 4.5
    screw_spacing: float = 44
    screw_height: float = 20


def build(p: P) -> Part:
    """Bends the sheet, cuts the wall's upper corners, punches."""
    back = p.depth / 2
    body = block((p.width, p.depth, p.height)) - block(
        (p.width, p.depth - p.thickness, p.height - p.thickness), (0, -p.thickness / 2, p.thickness)
    )
    bends = body.edges().filter_by(Axis.X)
    inner = bends.filter_by(lambda e: abs(e.center().Y - back + p.thickness) + abs(e.center().Z - p.thickness) < 1e-6)
    body = fillet(inner, p.bend)
    outer = body.edges().filter_by(Axis.X).filter_by(lambda e: abs(e.center().Y - back) + abs(e.center().Z) < 1e-6)
    body = fillet(outer, p.bend + p.thickness)
    body = chamfer(body.edges().filter_by(Axis.Y).group_by(Axis.Z)[-1], p.corner)
    tools = [block((*p.slot, p.thickness), (x, p.slot_center, 0)) for x, _ in grid(p.slots, 1, p.slot_spacing, 0)]
    tools.append(rod(p.sensor, p.thickness, (0, back, p.sensor_height), FRONT))
    tools += [
        rod(p.screw, p.thickness, (x, back, p.screw_height), FRONT) for x, _ in grid(p.screws, 1, p.screw_spacing, 0)
    ]
    return body - tools


def questions(p: P) -> list[Item]:
    """Asked by automation engineers."""
    wall_y = (p.depth - p.thickness) / 2
    return [
        length("object", "thickness", "What is the thickness of the sheet this bracket is bent from?", p.thickness),
        count("rectangular slot", "How many rectangular slots are in the foot?", p.slots),
        lengths(
            "rectangular slot",
            "width",
            "What is the width (shorter side) of the rectangular slots?",
            [p.slot[0]] * p.slots,
        ),
        lengths(
            "rectangular slot",
            "length",
            "What is the length (longer side) of the rectangular slots?",
            [p.slot[1]] * p.slots,
        ),
        length(
            "rectangular slot",
            "distance",
            "How far apart are the two rectangular slots, middle to middle?",
            p.slot_spacing,
        ),
        count("hole", "How many round holes are visible from the front?", p.screws + 1),
        length("hole", "diameter", "Diameter of the largest hole on the back?", p.sensor),
        point(
            "hole",
            "Where does the sensor sit? Give the centre of the largest round hole.",
            (0, wall_y, p.sensor_height),
        ),
        lengths(
            "mounting hole",
            "diameter",
            "What is the diameter of the two small screw holes at the front?",
            [p.screw] * p.screws,
        ),
        points(
            "mounting hole",
            "Centres of the 4.5 mm holes?",
            [(x, wall_y, p.screw_height) for x, _ in grid(p.screws, 1, p.screw_spacing, 0)],
        ),
        count("bevel", "How many bevelled (cut) corners has the upright wall?", 2),
        lengths("bevel", "height", "What is the height in z of the bevels at the upper corners?", [p.corner] * 2),
        length("bend", "radius", "What is the inner bend radius?", p.bend),
        length("object", "height", "How high is the bracket?", p.height),
        size("object", "Which size (width, depth, height) has the bracket?", (p.width, p.depth, p.height)),
        count("mounting hole", "How many round holes on the back are smaller than 10 mm in diameter?", p.screws),
    ]
