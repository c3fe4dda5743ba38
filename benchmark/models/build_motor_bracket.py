"""A motor bracket bent from sheet to a U: motor face on the left, bearing on the right, slots and nut holes below."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, chamfer, fillet

from benchmark.kit import Item, Model, count, length, lengths, point, points, size
from benchmark.shapes import RIGHT, block, circle, grid, prism, rod, slot

MODEL = Model("Motor bracket of sheet metal", "dev")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the foot lies on z = 0, its middle is x = y = 0; the walls stand left and right."""

    width: float = 100
    depth: float = 70
    height: float = 78
    thickness: float = 3
    bend: float = 4  # inner radius
    corner: float = 10  # cut at 45 degrees
    axis: float = 42  # height of the motor's axis
    pilot: float = 38.1  # NEMA 23 (NEMA ICS 16)
    motor: float = 5.1
    motor_pitch: float = 47.14
    bearing: float = 22
    bearing_screw: float = 3.4
    bearing_screws: int = 3
    bearing_circle: float = 32
    slot: tuple[float, float] = (14, 5.5)  # along y
    slots: tuple[float, float] = (64, 44)  # pattern, x and y
    nut: float = 8  # across flats
    nuts: float = 30  # apart in x
    cable: tuple[float, float] = (12, 20)  # cutout in the right wall, along y and z
    cable_y: float = -24
    cable_z: float = 50  # its middle


def build(p: P) -> Part:
    """Bends the sheet, cuts the corners, punches."""
    inside = block((p.width - 2 * p.thickness, p.depth, p.height), (0, 0, p.thickness))
    body = block((p.width, p.depth, p.height)) - inside
    edges = body.edges().filter_by(Axis.Y)
    body = fillet(edges.filter_by(lambda e: abs(e.center().Z - p.thickness) < 1e-6), p.bend)
    edges = body.edges().filter_by(Axis.Y)
    body = fillet(edges.filter_by(lambda e: abs(e.center().Z) < 1e-6 and abs(e.center().X) > 49), p.bend + p.thickness)
    body = chamfer(body.edges().filter_by(Axis.X).group_by(Axis.Z)[-1], p.corner)
    left, right = -p.width / 2, p.width / 2 - p.thickness
    tools = [
        rod(p.pilot, p.thickness, (left, 0, p.axis), RIGHT),
        rod(p.bearing, p.thickness, (right, 0, p.axis), RIGHT),
    ]
    tools += [rod(p.motor, p.thickness, (left, y, z), RIGHT) for y, z in _motor(p)]
    tools += [
        rod(p.bearing_screw, p.thickness, (right, y, z), RIGHT)
        for y, z in circle(p.bearing_screws, p.bearing_circle, 90, (0, p.axis))
    ]
    tools += [slot(*p.slot, p.thickness, (x, y, p.thickness), rotation=90) for x, y in grid(2, 2, *p.slots)]
    tools += [prism(p.nut, p.thickness, (x, 0, 0)) for x in (-p.nuts / 2, p.nuts / 2)]
    tools.append(block((p.thickness, *p.cable), (right + p.thickness / 2, p.cable_y, p.cable_z - p.cable[1] / 2)))
    return body - tools


def questions(p: P) -> list[Item]:
    """Asked by a mechatronics student, a sheet metal shop and a maker."""
    left, right = -(p.width - p.thickness) / 2, (p.width - p.thickness) / 2
    return [
        length("object", "thickness", "What sheet thickness was used?", p.thickness),
        length("bend", "radius", "inner bending radius?", p.bend),
        count("hole", "How many round holes are there in the left wall?", 5),
        length("hole", "diameter", "What diameter has the biggest hole of the bracket?", p.pilot),
        point("hole", "At which point is the largest hole centred?", (left, 0, p.axis)),
        lengths("mounting hole", "diameter", "The 4 motor mounting holes on the left: which diameters?", [p.motor] * 4),
        length(
            "mounting hole",
            "distance",
            "How far are two adjacent motor screw holes in the left wall apart along y (centre to centre)?",
            p.motor_pitch,
        ),
        length("hole", "radius", "What radius has the largest hole in the right wall?", p.bearing / 2),
        length(
            "mounting hole",
            "diameter",
            "The three small holes in the right wall sit on a circle. What is its diameter?",
            p.bearing_circle,
        ),
        count("hole", "How many round holes with a diameter below 6 mm does the bracket have?", 4 + p.bearing_screws),
        count("slot", "How many elongated slots has the foot?", 4),
        lengths("slot", "length", "slot length (tip to tip) for each slot in the base", [p.slot[0]] * 4),
        points(
            "slot",
            "Where are the centres of the obround slots?",
            [(x, y, p.thickness / 2) for x, y in grid(2, 2, *p.slots)],
        ),
        count("nut hole", "Number of hexagonal nut holes?", 2),
        lengths("nut hole", "width", "Width across flats of the hexagonal holes in the foot?", [p.nut] * 2),
        size("cutout", "How big is the rectangular cutout in the right wall, in x, y and z?", (p.thickness, *p.cable)),
        point("cutout", "Where's the middle of the cable cutout on the right?", (right, p.cable_y, p.cable_z)),
        length(
            "rectangular inside", "width", "What is the clear width between the two walls?", p.width - 2 * p.thickness
        ),
        count("bevel", "How many corners of the walls are cut off by a bevel?", 4),
        size("object", "Overal dimensions of the bent bracket (w, d, h)?", (p.width, p.depth, p.height)),
    ]


def _motor(p: P) -> list[tuple[float, float]]:
    """Where are the motor's screws, y and z?"""
    return grid(2, 2, p.motor_pitch, p.motor_pitch, (0, p.axis))
