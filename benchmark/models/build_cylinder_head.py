"""A three-cylinder head on its gasket: ports, spark plug holes, camshaft bearings, hexagonal screws."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Compound, Part

from benchmark.kit import Item, Model, count, length, lengths, size, texts
from benchmark.shapes import FRONT, RIGHT, assembly, block, grid, named, prism, rod

MODEL = Model("Cylinder head with gasket", "dev", bodies=10)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the gasket lies on z = 0, the cylinders stand in a row along x, the intake is at the front."""

    size: tuple[float, float, float] = (270, 112, 48)
    gasket: float = 2
    cylinders: int = 3
    pitch: float = 80
    gasket_bore: float = 72
    chamber: float = 68
    chamber_depth: float = 8
    plug: float = 12.8  # core of M14 x 1.25
    intake: tuple[float, float, float] = (32, 30, 18)
    intake_z: float = 20  # its floor
    exhaust: float = 26
    exhaust_depth: float = 28
    exhaust_z: float = 30
    bearings: int = 4
    bearing: tuple[float, float, float] = (14, 44, 24)
    camshaft: float = 13  # radius
    screw: float = 10
    flats: float = 16  # ISO 4017
    head: float = 6.4
    screw_y: float = 84  # between the rows

    @property
    def top(self) -> float:
        """Of the head, where bearings and screws stand."""
        return self.gasket + self.size[2]

    def rows(self, number: int) -> list[float]:
        """Where are so many features along x?"""
        return [(index - (number - 1) / 2) * self.pitch for index in range(number)]

    def screws(self) -> list[tuple[float, float]]:
        """Where are the screws?"""
        return grid(self.bearings, 2, self.pitch, self.screw_y)


def head(p: P) -> Part:
    """The casting with its bearings, ports, chambers and holes."""
    width, depth, _ = p.size
    body = block(p.size, (0, 0, p.gasket))
    for x in p.rows(p.bearings):
        body += block(p.bearing, (x, 0, p.top))
    body -= rod(2 * p.camshaft, width, (-width / 2, 0, p.top + p.bearing[2]), RIGHT)
    for x in p.rows(p.cylinders):
        body -= rod(p.chamber, p.chamber_depth, (x, 0, p.gasket)) + rod(p.plug, p.top, (x, 0, 0))
        body -= block(p.intake, (x, (p.intake[1] - depth) / 2, p.intake_z))
        body -= rod(p.exhaust, p.exhaust_depth, (x, depth / 2, p.exhaust_z), FRONT)
    return body - [rod(p.screw, p.size[2], (x, y, p.gasket)) for x, y in p.screws()]


def build(p: P) -> Compound:
    """Screws the head through the gasket; the screws end with the gasket's underside."""
    gasket = block((p.size[0], p.size[1], p.gasket))
    gasket -= [rod(p.gasket_bore, p.gasket, (x, 0, 0)) for x in p.rows(p.cylinders)]
    gasket -= [rod(p.screw, p.gasket, (x, y, 0)) for x, y in p.screws()]
    bodies = [named(head(p), "Cylinder head", "Silver"), named(gasket, "Head gasket", "DarkOrange")]
    for number, (x, y) in enumerate(p.screws(), start=1):
        screw = rod(p.screw, p.top, (x, y, 0)) + prism(p.flats, p.head, (x, y, p.top))
        bodies.append(named(screw, f"Hexagonal screw M10 {number}", "DimGray"))
    return assembly(bodies)


def questions(p: P) -> list[Item]:
    """Asked in the plain way, and by an engine builder, a tuner and a storekeeper."""
    n, screws = p.cylinders, len(p.screws())
    return [
        length("head gasket", "thickness", "Thickness of the head gasket?", p.gasket),
        size(
            "head gasket",
            "Determine the dimensions of the head gasket in x, y and z.",
            (p.size[0], p.size[1], p.gasket),
        ),
        count("hexagonal screw", "Number of hexagonal screws seen from above?", screws),
        lengths("hexagonal screw head", "height", "Heights of the hexagonal screw heads on top?", [p.head] * screws),
        lengths(
            "rectangular indentation", "width", "Width of the rectangular openings facing front?", [p.intake[0]] * n
        ),
        lengths(
            "rectangular indentation",
            "depth",
            "Give me the depths of the rectangular openings on the front.",
            [p.intake[1]] * n,
        ),
        lengths("blind hole", "diameter", "Diameters of the blind holes on the back?", [p.exhaust] * n),
        lengths(
            "threaded hole", "radius", "State the radius of each threaded spark plug hole on the top.", [p.plug / 2] * n
        ),
        lengths(
            "semicircle",
            "radius",
            "Give the radii of the semicircles that are cut into the camshaft bearings.",
            [p.camshaft] * p.bearings,
        ),
        length("screw head", "width", "spanner size for one of the head screws?", p.flats),
        length("screw", "length", "I am ordering new head screws. How long must a screw be below its head?", p.top),
        length(
            "threaded hole",
            "distance",
            "How far apart are neighbouring spark plug holes, measured centre to centre?",
            p.pitch,
        ),
        lengths(
            "rectangular protrusion",
            "height",
            "How high do the rectangular camshaft bearings stand above the top of the head?",
            [p.bearing[2]] * p.bearings,
        ),
        texts(
            "object",
            "If the eight screws are left aside, what are the names of the other parts?",
            ["Cylinder head", "Head gasket"],
        ),
    ]
