"""A fixture: an octagonal base plate with a grid of holes on feet, dowel pins, a stop held by screws with washers."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Compound

from benchmark.kit import Item, Model, count, exists, length, lengths, point, points, size, texts
from benchmark.shapes import BACK, DOWN, assembly, block, grid, named, prism, rod

MODEL = Model("Fixture with dowel pins and stop", "dev", bodies=12)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the feet stand on z = 0, the plate's middle is x = y = 0."""

    plate: float = 180  # across flats, flats square to x and y
    thickness: float = 15
    foot: float = 20
    foot_height: float = 25
    feet: float = 100  # apart in x and in y
    grid: int = 5  # holes each way
    pitch: float = 25
    hole: float = 6
    dowel: float = 8
    dowel_above: float = 20
    dowels_x: float = 140
    stop: tuple[float, float, float] = (80, 16, 22)
    stop_hole: float = 6.6
    notch: float = 24  # diameter of the half-round cutout in the stop's upper edge
    washer: float = 12  # ISO 7089
    washer_hole: float = 6.4
    washer_thickness: float = 1.6
    head: float = 10  # across flats, ISO 4017
    head_height: float = 4
    shank: float = 35

    @property
    def top(self) -> float:
        """Height of the plate's upper face."""
        return self.foot_height + self.thickness

    @property
    def stop_y(self) -> float:
        """The stop stands on the rearmost row of holes but one."""
        return self.pitch

    def screws(self) -> list[float]:
        """Where are the screws, x?"""
        return [-self.pitch, self.pitch]


def build(p: P) -> Compound:
    """Drills the plate and puts everything in its place."""
    plate = prism(p.plate, p.thickness, (0, 0, p.foot_height), sides=8, rotation=22.5)
    plate -= [rod(p.hole, p.thickness, (x, y, p.foot_height)) for x, y in grid(p.grid, p.grid, p.pitch, p.pitch)]
    dowels = [(x, 0) for x in (-p.dowels_x / 2, p.dowels_x / 2)]
    plate -= [rod(p.dowel, p.thickness, (x, y, p.foot_height)) for x, y in dowels]
    bodies = [named(plate, "Base plate", "SlateGray")]
    bodies += [named(rod(p.foot, p.foot_height, (x, y, 0)), "Foot", "Black") for x, y in grid(2, 2, p.feet, p.feet)]
    length_ = p.thickness + p.dowel_above
    bodies += [named(rod(p.dowel, length_, (x, y, p.foot_height)), "Dowel pin", "Silver") for x, y in dowels]
    stop = block(p.stop, (0, p.stop_y, p.top))
    upper = p.top + p.stop[2]
    stop -= rod(p.notch, p.stop[1], (0, p.stop_y - p.stop[1] / 2, upper), BACK)
    stop -= [rod(p.stop_hole, p.stop[2], (x, p.stop_y, p.top)) for x in p.screws()]
    bodies.append(named(stop, "Stop", "Firebrick"))
    seat = upper + p.washer_thickness
    for x in p.screws():
        washer = rod(p.washer, p.washer_thickness, (x, p.stop_y, upper))
        washer -= rod(p.washer_hole, p.washer_thickness, (x, p.stop_y, upper))
        bodies.append(named(washer, "Washer 6", "LightGray"))
    for x in p.screws():
        screw = rod(p.hole, p.shank, (x, p.stop_y, seat), DOWN) + prism(p.head, p.head_height, (x, p.stop_y, seat))
        bodies.append(named(screw, "Hexagon screw M6x35", "Goldenrod"))
    return assembly(bodies)


def questions(p: P) -> list[Item]:
    """Asked by a toolmaker, a robot's programmer, an apprentice and a buyer."""
    upper = p.top + p.stop[2]
    seat = upper + p.washer_thickness
    names = ["Base plate", "Foot", "Dowel pin", "Stop", "Washer 6", "Hexagon screw M6x35"]
    return [
        size("octagonal base plate", "What is the size of the octagonal base plate?", (p.plate, p.plate, p.thickness)),
        length("octagonal base plate", "thickness", "Thickness of the octagon plate?", p.thickness),
        count("leg", "On how many feet does the fixture stand?", 4),
        lengths("leg", "height", "How high are the feet under the plate?", [p.foot_height] * 4),
        length("leg", "distance", "How far apart are the two feet you see from the front, axis to axis?", p.feet),
        count("grid", "How many holes make up the hole grid in the base plate?", p.grid**2),
        length("grid", "distance", "hole pitch of the grid?", p.pitch),
        length("hole", "diameter", "One of the grid holes in the plate - what diameter?", p.hole),
        count("rod", "How many dowel pins stick out of the plate?", 2),
        lengths("rod", "height", "How far do the dowel pins protrude above the base plate?", [p.dowel_above] * 2),
        length("rod", "distance", "centre distance of the dowel pins", p.dowels_x),
        points(
            "rod",
            "Positions (centres) of the dowel pins?",
            [(x, 0, p.foot_height + (p.thickness + p.dowel_above) / 2) for x in (-p.dowels_x / 2, p.dowels_x / 2)],
        ),
        size("rectangular part", "What size is the stop?", p.stop),
        length("semicircle", "radius", "What's the radius of the semicircular cutout in the stop?", p.notch / 2),
        count("hexagonal screw", "With how many hexagonal screws is the stop fastened?", 2),
        lengths("hexagonal screw head", "height", "Height of the hex heads?", [p.head_height] * 2),
        lengths("screw head", "width", "What spanner size do the screw heads need (width across flats)?", [p.head] * 2),
        lengths("screw", "length", "How long are the two screws incl. their heads?", [p.shank + p.head_height] * 2),
        lengths("ring", "thickness", "How thick are the washers below the screw heads?", [p.washer_thickness] * 2),
        exists("ring", "Are there any washers in this assembly?", True),
        point(
            "screw head",
            "Where is the centre of the left screw's head?",
            (-p.pitch, p.stop_y, seat + p.head_height / 2),
        ),
        length("object", "height", "Total height of fixture?", seat + p.head_height),
        texts("object", "What are the names of the different bodies?", names),
    ]
