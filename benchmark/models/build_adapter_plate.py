"""A motor's adapter plate: a round disc with a pilot bore, tapped motor holes and countersunk mounting holes."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Part

from benchmark.kit import Item, Model, count, length, lengths, point, points, size
from benchmark.shapes import DOWN, circle, cone, rod

MODEL = Model("Motor adapter plate", "dev")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is z, the underside lies on z = 0, the motor sits on top."""

    diameter: float = 96
    thickness: float = 12
    pilot: float = 40
    motor_holes: int = 6
    motor_hole: float = 5  # tap drill of M6
    motor_circle: float = 60
    mounting_holes: int = 4
    mounting_hole: float = 6.6
    mounting_countersink: float = 12.6
    mounting_circle: float = 82
    dowels: int = 2
    dowel: float = 4
    dowel_depth: float = 7
    dowel_circle: float = 60

    def mounting(self) -> list[tuple[float, float]]:
        """Where are the mounting holes?"""
        return circle(self.mounting_holes, self.mounting_circle, 45)


def build(p: P) -> Part:
    """Drills the disc; the dowel holes are blind, between the motor's holes."""
    sink = (p.mounting_countersink - p.mounting_hole) / 2  # 90 degrees
    tools = [rod(p.pilot, p.thickness)]
    tools += [rod(p.motor_hole, p.thickness, (x, y, 0)) for x, y in circle(p.motor_holes, p.motor_circle, 30)]
    for x, y in p.mounting():
        tools += [
            rod(p.mounting_hole, p.thickness, (x, y, 0)),
            cone(p.mounting_countersink, p.mounting_hole, sink, (x, y, p.thickness), DOWN),
        ]
    tools += [rod(p.dowel, p.dowel_depth, (x, y, p.thickness), DOWN) for x, y in circle(p.dowels, p.dowel_circle)]
    return rod(p.diameter, p.thickness) - tools


def questions(p: P) -> list[Item]:
    """Asked by people who mount motors."""
    return [
        length("adapter plate", "diameter", "What is the outer diameter of the adapter plate?", p.diameter),
        length("adapter plate", "radius", "Give me the radius of the round adapter plate.", p.diameter / 2),
        length("adapter plate", "thickness", "How thick is the adapter plate?", p.thickness),
        length("hole", "diameter", "Which diameter has the big hole in the middle?", p.pilot),
        count(
            "threaded hole",
            "How many M6 threaded holes are there? They are drawn with their 5 mm core diameter.",
            p.motor_holes,
        ),
        count("mounting hole", "How many countersunk mounting holes does the plate have?", p.mounting_holes),
        lengths(
            "mounting hole",
            "diameter",
            "What diameter do the countersunk mounting holes have?",
            [p.mounting_hole] * p.mounting_holes,
        ),
        points(
            "mounting hole",
            "List the centre positions of the countersunk holes.",
            [(x, y, p.thickness / 2) for x, y in p.mounting()],
        ),
        count("blind hole", "Count the blind holes for the dowel pins on the top side.", p.dowels),
        lengths("blind hole", "depth", "How deep are the blind holes?", [p.dowel_depth] * p.dowels),
        length(
            "blind hole", "distance", "What is the distance between the centres of the two blind holes?", p.dowel_circle
        ),
        count(
            "through hole",
            "How many through holes go from the top of the plate to the bottom, the central one included?",
            1 + p.motor_holes + p.mounting_holes,
        ),
        lengths(
            "hole",
            "diameter",
            "Which different hole diameters can be seen from the bottom?",
            sorted({p.pilot, p.motor_hole, p.mounting_hole}),
        ),
        point("object", "Where is the center of the object?", (0, 0, p.thickness / 2)),
        size(
            "object",
            "What are the overall dimensions of the part along x, y and z?",
            (p.diameter, p.diameter, p.thickness),
        ),
        count(
            "hole",
            "How many holes are smaller than 7 mm in diameter? Count the blind and the countersunk ones too.",
            p.dowels + p.motor_holes + p.mounting_holes,
        ),
        count("hole", "How many holes are visible from below?", 1 + p.motor_holes + p.mounting_holes),
    ]
