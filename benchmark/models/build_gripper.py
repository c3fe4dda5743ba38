"""A parallel gripper turned about z: adapter plate, rectangular housing, two jaws, coloured bodies."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Compound, Pos, Rot

from benchmark.kit import Item, Model, Triple, count, length, lengths, point, points, size
from benchmark.shapes import assembly, block, circle, named, rod

MODEL = Model("Parallel gripper, turned about its axis", "dev", bodies=4)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres and degrees; before it is turned about z the jaws move along x; the adapter plate lies on z = 0."""

    plate: float = 80
    plate_height: float = 10
    plate_holes: int = 4
    plate_hole: float = 6.4
    plate_circle: float = 63
    pilot: float = 31.5
    pilot_depth: float = 5
    housing: tuple[float, float, float] = (90, 40, 50)
    jaw: tuple[float, float, float] = (14, 24, 46)
    jaw_gap: float = 32
    jaw_hole: float = 5
    jaw_hole_rise: float = 30  # above the jaw's foot
    turn: float = 30

    @property
    def top(self) -> float:
        """Of the housing."""
        return self.plate_height + self.housing[2]

    def turned(self, x: float, y: float, z: float) -> Triple:
        """Where does a point go?"""
        at = (Rot(0, 0, self.turn) * Pos(x, y, z)).position
        return (at.X, at.Y, at.Z)


def build(p: P) -> Compound:
    """Turned as a whole; the jaws are pierced along their closing direction."""
    turn = Rot(0, 0, p.turn)
    holes = [rod(p.plate_hole, p.plate_height, (x, y, 0)) for x, y in circle(p.plate_holes, p.plate_circle, 45)]
    plate = rod(p.plate, p.plate_height) - [*holes, rod(p.pilot, p.pilot_depth)]
    bodies = [
        named(plate, "Adapter plate", "DimGray", turn),
        named(block(p.housing, (0, 0, p.plate_height)), "Gripper housing", "SteelBlue", turn),
    ]
    for side in (-1, 1):
        x = side * (p.jaw_gap + p.jaw[0]) / 2
        hole = rod(p.jaw_hole, p.jaw[0], (x - p.jaw[0] / 2, 0, p.top + p.jaw_hole_rise), (1, 0, 0))
        bodies.append(named(block(p.jaw, (x, 0, p.top)) - hole, "Jaw", "Orange", turn))
    return assembly(bodies)


def questions(p: P) -> list[Item]:
    """Asked by robot programmers."""
    offset = (p.jaw_gap + p.jaw[0]) / 2
    holes = [p.turned(x, y, p.plate_height / 2) for x, y in circle(p.plate_holes, p.plate_circle, 45)]
    jaws = [p.turned(side * offset, 0, p.top + p.jaw[2] / 2) for side in (-1, 1)]
    return [
        length("adapter plate", "radius", "What is the radius of the adapter plate?", p.plate / 2),
        length("adapter plate", "thickness", "How thick is the gripper's adapter plate?", p.plate_height),
        size(
            "adapter plate",
            "Give the size of the adapter plate body in x, y and z.",
            (p.plate, p.plate, p.plate_height),
        ),
        count(
            "mounting hole",
            "How many mounting holes does the adapter plate have, without the pilot recess?",
            p.plate_holes,
        ),
        points("mounting hole", "Give the centres of the 6.4 mm holes of the adapter plate.", holes),
        length(
            "blind hole",
            "diameter",
            "What is the diameter of the large recess that is visible from the bottom?",
            p.pilot,
        ),
        length("blind hole", "depth", "How deep is the large round recess in the underside?", p.pilot_depth),
        count("rectangular part", "How many jaws has the gripper?", 2),
        length("rectangular part", "distance", "How far apart are the two jaws (clear opening)?", p.jaw_gap),
        points("rectangular part", "Where are the centers of the two jaws?", jaws),
        lengths("rectangular part", "height", "How high are the jaws?", [p.jaw[2]] * 2),
        lengths("hole", "diameter", "What is the diameter of the holes in the jaws?", [p.jaw_hole] * 2),
        count("object", "How many orange parts are there?", 2),
        length("object", "height", "What is the total height of the gripper?", p.top + p.jaw[2]),
        point("object", "Center of the housing body?", (0, 0, p.plate_height + p.housing[2] / 2)),
    ]
