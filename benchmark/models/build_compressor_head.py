"""An air compressor's cylinder with its head, gasket and four screws, as named bodies."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Compound, Part

from benchmark.kit import Item, Model, count, length, lengths, size
from benchmark.shapes import BACK, DOWN, assembly, block, drill, grid, named, prism, rod

MODEL = Model("Compressor cylinder with finned head", "dev", bodies=7)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the cylinder's axis is z, its lower end lies on z = 0, the fins of the head point up."""

    side: float = 90  # of flange, gasket and head
    barrel: float = 76
    barrel_height: float = 46
    bore: float = 60
    flange: float = 14
    gasket: float = 1.5
    gasket_bore: float = 62
    head: float = 20
    fins: int = 7
    fin: tuple[float, float, float] = (3, 50, 20)
    fin_pitch: float = 9.5
    span: float = 74  # pattern of the screws
    clearance: float = 9
    screw: float = 8
    screw_length: float = 35  # below the head
    flats: float = 13  # ISO 4017
    screw_head: float = 5.3
    port: float = 11.8  # core hole of G 1/4
    port_depth: float = 22

    @property
    def levels(self) -> tuple[float, float, float]:
        """Where on z begin the gasket, the head and its fins?"""
        gasket = self.barrel_height + self.flange
        return gasket, gasket + self.gasket, gasket + self.gasket + self.head


def cylinder(p: P) -> Part:
    """A bored barrel below a square flange, with holes for the screws."""
    total = p.barrel_height + p.flange
    body = rod(p.barrel, p.barrel_height) + block((p.side, p.side, p.flange), (0, 0, p.barrel_height))
    body -= rod(p.bore, total)
    return body - [rod(p.screw, p.flange, (x, y, p.barrel_height)) for x, y in grid(2, 2, p.span, p.span)]


def head(p: P) -> Part:
    """A block with fins between the screws, an air port in the front."""
    _, low, high = p.levels
    body = block((p.side, p.side, p.head), (0, 0, low))
    body += [block(p.fin, ((index - (p.fins - 1) / 2) * p.fin_pitch, 0, high)) for index in range(p.fins)]
    body -= drill(p.port, p.port_depth, (0, -p.side / 2, low + p.head / 2), BACK)
    return body - [rod(p.clearance, p.head, (x, y, low)) for x, y in grid(2, 2, p.span, p.span)]


def build(p: P) -> Compound:
    """Stacks cylinder, gasket and head, screws them together."""
    low, _, high = p.levels
    gasket = block((p.side, p.side, p.gasket), (0, 0, low)) - rod(p.gasket_bore, p.gasket, (0, 0, low))
    gasket -= [rod(p.clearance, p.gasket, (x, y, low)) for x, y in grid(2, 2, p.span, p.span)]
    bodies = [
        named(cylinder(p), "Cylinder", "DarkGray"),
        named(gasket, "Head gasket", "SandyBrown"),
        named(head(p), "Cylinder head", "Silver"),
    ]
    for number, (x, y) in enumerate(grid(2, 2, p.span, p.span), start=1):
        screw = rod(p.screw, p.screw_length, (x, y, high), DOWN) + prism(p.flats, p.screw_head, (x, y, high))
        bodies.append(named(screw, f"Hexagonal screw M8 {number}", "SlateGray"))
    return assembly(bodies)


def questions(p: P) -> list[Item]:
    """Asked in the plain way, and by a compressor's owner, a mechanic and a designer."""
    return [
        count("cooling fin", "How many cooling fins are visible from the top?", p.fins),
        lengths("cooling fin", "height", "What is the height of the cooling fins?", [p.fin[2]] * p.fins),
        lengths("cooling fin", "thickness", "How thick are the individual cooling fins?", [p.fin[0]] * p.fins),
        length("head gasket", "thickness", "What is the thickness of the head gasket?", p.gasket),
        count("hole", "How many holes does the head gasket have?", 5),
        count("hexagonal screw", "How many hexagonal screws are visible from the top?", 4),
        lengths(
            "hexagonal screw head", "height", "What is the height of the hexagonal screw heads?", [p.screw_head] * 4
        ),
        size("head gasket", "Give me the outer dimensions of the gasket pls", (p.side, p.side, p.gasket)),
        length("tube", "diameter", "bore of the cylinder?", p.bore),
        length("threaded hole", "diameter", "Which diameter has the air port in the front of the head?", p.port),
        length(
            "blind hole",
            "depth",
            "How far does the port on the front go into the head, without the drill tip?",
            p.port_depth,
        ),
        length(
            "cooling fin",
            "distance",
            "How much air is there between one cooling fin and the next (clear gap)?",
            p.fin_pitch - p.fin[0],
        ),
        length(
            "screw",
            "distance",
            "distance betwen neighbouring head screws, centre to centre",
            p.span,
        ),
        length(
            "object",
            "height",
            "How tall is the whole thing, from the foot of the barrel to the fin tips?",
            p.levels[2] + p.fin[2],
        ),
    ]
