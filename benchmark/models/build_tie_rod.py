"""A tie rod with two eyes, placed obliquely, stored as B-splines."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Part, Pos, Rot

from benchmark.kit import Form, Item, Model, Triple, count, length, lengths, point
from benchmark.shapes import RIGHT, rod

MODEL = Model("Tie rod in an oblique position", "dev", Form.BSPLINE)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres and degrees; not yet turned, the rod runs along x about the origin, the eyes' axes along z."""

    rod: float = 20
    spacing: float = 180  # of the eyes' axes
    eye: float = 48
    eye_width: float = 24
    small: float = 16
    large: float = 22
    turn: tuple[float, float, float] = (15, 25, 40)  # about x, y and z, each about the turned axes

    def turned(self, x: float) -> Triple:
        """Where does a point of the axis go?"""
        at = (Rot(*self.turn) * Pos(x, 0, 0)).position
        return (at.X, at.Y, at.Z)


def build(p: P) -> Part:
    """Rod and eyes, bored, turned."""
    half = p.spacing / 2
    body = rod(p.rod, p.spacing, (-half, 0, 0), RIGHT)
    body += [rod(p.eye, p.eye_width, (x, 0, -p.eye_width / 2)) for x in (-half, half)]
    bores = [rod(bore, p.eye_width, (x, 0, -p.eye_width / 2)) for x, bore in ((-half, p.small), (half, p.large))]
    return Rot(*p.turn) * (body - bores)


def questions(p: P) -> list[Item]:
    """Asked by those who have to fit pins into the eyes."""
    half = p.spacing / 2
    return [
        length("rod", "diameter", "What is the diameter of the rod between the two eyes?", p.rod),
        length("rod", "radius", "Radius of the straight rod?", p.rod / 2),
        count("ring", "How many ring-shaped eyes does the tie rod have?", 2),
        lengths("ring", "diameter", "What is the outer diameter of the ring-shaped eyes?", [p.eye] * 2),
        count("through hole", "How many through holes are in the part?", 2),
        lengths("hole", "diameter", "List the diameters of the holes.", [p.small, p.large]),
        length("hole", "diameter", "How large is the diameter of the largest hole?", p.large),
        length("hole", "radius", "What's the radius of the smallest hole?", p.small / 2),
        lengths("through hole", "depth", "How deep are the holes?", [p.eye_width] * 2),
        length("hole", "distance", "What is the distance between the centres of the two holes?", p.spacing),
        point("hole", "Where is the centre of the bigger hole?", p.turned(half)),
        point("hole", "Position of the centre of the smaller hole?", p.turned(-half)),
        count("hole", "How many holes have a radius between 10 and 12 mm?", 1),
    ]
