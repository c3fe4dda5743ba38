"""A gear pump without its cover: adapter plate, body with two ports, two gears on shafts, screws, pins."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Compound, Face, Part, Plane, Pos, Rot, Wire, extrude

from benchmark.kit import Item, Model, count, length, lengths, text
from benchmark.shapes import BACK, DOWN, FRONT, assembly, block, grid, named, prism, rod
from build_gear_shaft import GearShaft, tooth_edges

MODEL = Model("Gear pump", "dev", bodies=10)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres and degrees; the adapter plate lies on z = 0, the gears' axes are parallel to z, at y = 0."""

    plate: tuple[float, float, float] = (130, 96, 10)
    mounting: float = 9
    mounting_span: tuple[float, float] = (112, 80)
    body: tuple[float, float, float] = (104, 68, 32)
    module: float = 2.5
    teeth: int = 14
    pressure_angle: float = 20
    face: float = 20
    clearance: float = 0.2  # between gears and chamber
    shaft: float = 14
    bearing: float = 8  # depth below the chamber
    drive: float = 35  # of the shaft, above the gears
    suction: float = 14  # port at the front
    pressure: float = 11  # port at the back
    port_depth: float = 26
    screw: float = 6
    screw_length: float = 38  # below the head
    head: float = 4  # ISO 4017
    flats: float = 10
    screw_span: tuple[float, float] = (88, 52)
    screw_hole: float = 6.6
    pin: float = 5
    pin_length: float = 16
    pin_out: float = 6
    pin_span: float = 90

    @property
    def spacing(self) -> float:
        """Centre distance of the gears: their pitch diameter."""
        return self.module * self.teeth

    @property
    def tip(self) -> float:
        """Tip diameter: one module above the pitch circle all round (ISO 53)."""
        return self.module * (self.teeth + 2)

    @property
    def levels(self) -> tuple[float, float]:
        """Where on z are the chamber's floor and the body's upper face?"""
        top = self.plate[2] + self.body[2]
        return top - self.face, top


def gear(p: P, x: float, turn: float, above: float) -> Part:
    """A gear on its shaft, which ends in the body's floor and `above` the gear."""
    floor, _ = p.levels
    outline = GearShaft(module=p.module, teeth=p.teeth, pressure_angle=p.pressure_angle)
    wire = Wire([edge for index in range(p.teeth) for edge in tooth_edges(outline, index)])
    teeth = Pos(x, 0, floor) * Rot(0, 0, turn) * extrude(Plane.XY * Face(wire), amount=p.face)
    return teeth + rod(p.shaft, p.bearing + p.face + above, (x, 0, floor - p.bearing))


def body(p: P) -> Part:
    """A block with the chamber, bearings, ports and holes for screws and pins."""
    floor, top = p.levels
    block_ = block(p.body, (0, 0, p.plate[2]))
    for x in (-p.spacing / 2, p.spacing / 2):
        block_ -= rod(p.tip + 2 * p.clearance, p.face, (x, 0, floor)) + rod(p.shaft, p.bearing, (x, 0, floor), DOWN)
    middle, half = floor + p.face / 2, p.body[1] / 2
    block_ -= rod(p.suction, p.port_depth, (0, -half, middle), BACK)
    block_ -= rod(p.pressure, p.port_depth, (0, half, middle), FRONT)
    block_ -= [rod(p.screw_hole, p.body[2], (x, y, p.plate[2])) for x, y in grid(2, 2, *p.screw_span)]
    inside = p.pin_length - p.pin_out
    return block_ - [rod(p.pin, inside, (x, 0, top), DOWN) for x in (-p.pin_span / 2, p.pin_span / 2)]


def build(p: P) -> Compound:
    """Puts gears, screws and pins into the body on its plate."""
    _, top = p.levels
    corners = grid(2, 2, *p.screw_span)
    thread = p.screw_length - p.body[2]
    plate = block(p.plate) - [rod(p.mounting, p.plate[2], (x, y, 0)) for x, y in grid(2, 2, *p.mounting_span)]
    plate -= [rod(p.screw, thread, (x, y, p.plate[2]), DOWN) for x, y in corners]
    bodies = [
        named(plate, "Adapter plate", "SlateGray"),
        named(body(p), "Pump body", "Silver"),
        named(gear(p, -p.spacing / 2, 0, p.drive), "Drive gear", "SteelBlue"),
        named(gear(p, p.spacing / 2, 180 / p.teeth, 0), "Idler gear", "LightSteelBlue"),
    ]
    for number, (x, y) in enumerate(corners, start=1):
        screw = rod(p.screw, p.screw_length, (x, y, top), DOWN) + prism(p.flats, p.head, (x, y, top))
        bodies.append(named(screw, f"Hexagonal screw M6 {number}", "DimGray"))
    for number, x in enumerate((-p.pin_span / 2, p.pin_span / 2), start=1):
        pin = rod(p.pin, p.pin_length, (x, 0, top + p.pin_out), DOWN)
        bodies.append(named(pin, f"Dowel pin {number}", "Goldenrod"))
    return assembly(bodies)


def questions(p: P) -> list[Item]:
    """Asked in the plain way, and by a hydraulics fitter, a gear designer and a storekeeper."""
    return [
        count("gear", "How many gears are visible from the top?", 2),
        lengths("gear", "diameter", "What is the outer diameter of the gears?", [p.tip] * 2),
        length("adapter plate", "thickness", "What is the thickness of the adapter plate?", p.plate[2]),
        count("mounting hole", "How many holes with a diameter of 9 mm does the adapter plate have?", 4),
        count("hexagonal screw", "How many hexagonal screws are visible from the top?", 4),
        lengths("hexagonal screw head", "height", "What is the height of the hexagonal screw heads?", [p.head] * 4),
        length("shaft", "diameter", "What is the diameter of the shaft that sticks out at the top?", p.shaft),
        count("gear", "no. of teeth on the drive gear?", p.teeth),
        length("gear", "distance", "Center distance between the drive gear and the idler gear", p.spacing),
        length("shaft", "height", "By how much does the drive shaft rise above the gears?", p.drive),
        lengths("screw head", "width", "whats the spanner size of the screw heads (across flats)", [p.flats] * 4),
        lengths(
            "screw",
            "length",
            "I must re-order the M6 screws: what length do they have under the head?",
            [p.screw_length] * 4,
        ),
        lengths("rod", "height", "How far do the dowel pins protrude from the pump body?", [p.pin_out] * 2),
        text("adapter plate", "What is the name of the lowest part in the assembly?", "Adapter plate"),
    ]
