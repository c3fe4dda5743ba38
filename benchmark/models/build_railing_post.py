"""A railing post in an oblique position: octagonal base plate with ribs, tube with collar, cable holes and a stop."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, Plane, Polyline, Pos, Rot, extrude, make_face

from benchmark.kit import Item, Model, Triple, count, length, lengths, points
from benchmark.shapes import BACK, RIGHT, block, circle, prism, rod

MODEL = Model("Railing post in an oblique position", "dev")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres and degrees; not yet turned, the base plate lies on z = 0, the tube's axis is z."""

    plate: float = 160  # across flats
    plate_thickness: float = 12
    bolts: int = 4
    bolt: float = 14
    bolt_circle: float = 125
    tube: float = 60.3  # EN 10220
    wall: float = 2.9
    height: float = 300
    ribs: int = 4
    rib: tuple[float, float, float] = (35, 6, 60)  # along the plate, thickness, along the tube
    collar: float = 80
    collar_height: float = 20
    collar_z: float = 250
    cables: int = 3  # holes in the wall towards the back
    cable: float = 8
    cable_pitch: float = 50
    cable_z: float = 120  # of the lowest
    window: tuple[float, float] = (20, 45)  # slot in the wall towards the front, around and along the tube
    window_z: float = 110  # of its middle
    stop: float = 16  # rod on the right
    stop_z: float = 180
    turn: Triple = (12, -18, 25)  # about x, y and z, each about the turned axes

    @property
    def inner(self) -> float:
        """Inner diameter of the tube."""
        return self.tube - 2 * self.wall

    def turned(self, at: Triple) -> Triple:
        """Where does a point go?"""
        place = (Rot(*self.turn) * Pos(*at)).position
        return (place.X, place.Y, place.Z)


def rib(p: P) -> Part:
    """A triangle between tube and plate, to the right."""
    reach, thick, high = p.rib
    start = p.tube / 2 - p.wall / 2  # rooted in the tube's wall
    foot, tip = p.tube / 2 + reach, p.plate_thickness + high
    low = p.plate_thickness
    outline = make_face(Polyline((start, low), (foot, low), (p.tube / 2, tip), (start, tip), close=True))
    return extrude(Plane.XZ.offset(-thick / 2) * outline, amount=thick)


def build(p: P) -> Part:
    """Welds tube, ribs and collar on the plate, cuts, turns into place."""
    low = p.plate_thickness
    body = prism(p.plate, low, sides=8, rotation=22.5) + rod(p.tube, p.height - low, (0, 0, low))
    body += [rib(p).rotate(Axis.Z, 45 + 360 * index / p.ribs) for index in range(p.ribs)]
    body += rod(p.collar, p.collar_height, (0, 0, p.collar_z))
    body += rod(p.stop, p.tube / 2 + 40, (0, 0, p.stop_z), RIGHT)
    body -= rod(p.inner, p.height - low, (0, 0, low))
    body -= [rod(p.bolt, low, (x, y, 0)) for x, y in circle(p.bolts, p.bolt_circle)]
    body -= [rod(p.cable, p.tube, (0, 0, p.cable_z + index * p.cable_pitch), BACK) for index in range(p.cables)]
    window = (p.window[0], p.tube / 2, p.window[1])
    body -= block(window, (0, -p.tube / 4, p.window_z - p.window[1] / 2))
    return Rot(*p.turn) * body


def questions(p: P) -> list[Item]:
    """Asked in the plain way, and by a locksmith, a building site's foreman and a draughtswoman."""
    return [
        length(
            "octagonal base plate", "thickness", "What is the thickness of the octagonal base plate?", p.plate_thickness
        ),
        count("mounting hole", "How many mounting holes does the octagonal base plate have?", p.bolts),
        lengths("mounting hole", "diameter", "What is the diameter of the mounting holes?", [p.bolt] * p.bolts),
        length("tube", "radius", "What is the inner radius of the tube?", p.inner / 2),
        length("ring", "diameter", "What is the outer diameter of the ring around the tube?", p.collar),
        length("ring", "height", "What is the height of the ring?", p.collar_height),
        length("rectangular slot", "length", "How long is the rectangular slot in the tube?", p.window[1]),
        length("octagonal base plate", "width", "base plate across flats?", p.plate),
        length("tube", "thickness", "Which wall thickness has the tube?", p.wall),
        length(
            "mounting hole",
            "distance",
            "I have to drill the concrete: how far apart are two mounting holes that lie opposite each other?",
            p.bolt_circle,
        ),
        points(
            "mounting hole",
            "Coordinates of the centres of the anchor bolt holes in the base plate",
            [p.turned((x, y, p.plate_thickness / 2)) for x, y in circle(p.bolts, p.bolt_circle)],
        ),
        count("hole", "How many holes of 8 mm diameter are drilled in the tube for the cables?", p.cables),
        length("hole", "distance", "Spacing between neighboring cable holes (the 8 mm ones)?", p.cable_pitch),
        length("rod", "diameter", "how thick is the round rod that sticks out of tube sideways", p.stop),
    ]
