"""A solenoid valve: body with two threaded ports, adapter plate, finned coil, power connector, nut, screws, logo."""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot

from build123d import Compound, Part

from benchmark.kit import Item, Model, count, length, lengths, size
from benchmark.shapes import LEFT, RIGHT, assembly, block, grid, named, prism, rod

MODEL = Model("Solenoid valve", "held_out", bodies=11)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the body stands on z = 0, its ports lie along x, the connector points to the front."""

    body: tuple[float, float, float] = (70, 44, 36)
    port: float = 11.8  # core of G 1/4
    port_depth: float = 16
    port_z: float = 18
    mounting: float = 5.5
    mounting_span: tuple[float, float] = (58, 30)
    plate: tuple[float, float, float] = (44, 44, 5)
    screw: float = 4
    screw_length: float = 13  # below the head
    screw_head: float = 7
    screw_head_height: float = 4
    screw_span: float = 35
    coil: tuple[float, float, float] = (26, 26, 34)
    fins: int = 6
    fin: tuple[float, float, float] = (1.6, 8, 30)
    fin_pitch: float = 4.4
    fin_lift: float = 2  # above the coil's underside
    tube: float = 13
    tube_out: float = 9  # above the coil
    flats: float = 17
    nut: float = 6
    connector: tuple[float, float, float] = (22, 14, 24)
    connector_z: float = 46
    inside: tuple[float, float, float] = (18, 11, 20)
    pins: int = 3
    pin: tuple[float, float, float] = (5, 9, 0.8)
    pin_pitch: float = 5
    logo: tuple[float, float, float] = (1, 12, 16)
    logo_stroke: float = 4

    @property
    def levels(self) -> tuple[float, float, float]:
        """Where on z are the upper faces of body, plate and coil?"""
        return self.body[2], self.body[2] + self.plate[2], self.body[2] + self.plate[2] + self.coil[2]


def connector(p: P) -> Part:
    """A socket open to the front; its flat pins stand on its floor."""
    mouth = -p.coil[1] / 2 - p.connector[1]
    floor = mouth + p.inside[1]
    socket = block(p.connector, (0, mouth + p.connector[1] / 2, p.connector_z))
    wall = (p.connector[2] - p.inside[2]) / 2
    socket -= block(p.inside, (0, mouth + p.inside[1] / 2, p.connector_z + wall))
    middle = p.connector_z + p.connector[2] / 2
    for index in range(p.pins):
        z = middle + (index - (p.pins - 1) / 2) * p.pin_pitch
        socket += block(p.pin, (0, floor - p.pin[1] / 2, z - p.pin[2] / 2))
    return socket


def logo(p: P) -> Part:
    """A raised letter L on the coil's right side."""
    thick, width, height = p.logo
    x, z = p.coil[0] / 2 + thick / 2, p.levels[1] + (p.coil[2] - height) / 2
    stem = block((thick, p.logo_stroke, height), (x, (p.logo_stroke - width) / 2, z))
    return stem + block((thick, width, p.logo_stroke), (x, 0, z))


def build(p: P) -> Compound:
    """Stacks body, plate, coil, tube and nut; screws the plate down."""
    body_top, plate_top, coil_top = p.levels
    half, corners = p.body[0] / 2, grid(2, 2, p.screw_span, p.screw_span)
    body = block(p.body) - [rod(p.mounting, body_top, (x, y, 0)) for x, y in grid(2, 2, *p.mounting_span)]
    body -= rod(p.port, p.port_depth, (-half, 0, p.port_z), RIGHT) + rod(
        p.port, p.port_depth, (half, 0, p.port_z), LEFT
    )
    sunk = p.screw_length - p.plate[2]
    body -= [rod(p.screw, sunk, (x, y, body_top - sunk)) for x, y in corners]
    plate = block(p.plate, (0, 0, body_top)) - [rod(p.screw, p.plate[2], (x, y, body_top)) for x, y in corners]
    coil = block(p.coil, (0, 0, plate_top))
    for index in range(p.fins):
        x = (index - (p.fins - 1) / 2) * p.fin_pitch
        coil += block(p.fin, (x, p.coil[1] / 2 + p.fin[1] / 2, plate_top + p.fin_lift))
    coil -= rod(p.tube, p.coil[2], (0, 0, plate_top))
    nut = prism(p.flats, p.nut, (0, 0, coil_top)) - rod(p.tube, p.nut, (0, 0, coil_top))
    bodies = [
        named(body, "Valve body", "Goldenrod"),
        named(plate, "Adapter plate", "Silver"),
        named(coil, "Coil", "DarkSlateGray"),
        named(connector(p), "Power connector", "Black"),
        named(logo(p), "Logo", "Red"),
        named(rod(p.tube, p.coil[2] + p.tube_out, (0, 0, plate_top)), "Armature tube", "LightSteelBlue"),
        named(nut, "Hexagon nut", "DimGray"),
    ]
    for number, (x, y) in enumerate(corners, start=1):
        screw = rod(p.screw, p.screw_length, (x, y, body_top - sunk))
        screw += rod(p.screw_head, p.screw_head_height, (x, y, plate_top))
        bodies.append(named(screw, f"Cap screw M4 {number}", "DimGray"))
    return assembly(bodies)


def questions(p: P) -> list[Item]:
    """Asked in the plain way, and by a fitter, an electrician and a buyer."""
    dx, dy = p.mounting_span
    front, back = p.coil[1] / 2 + p.connector[1], p.coil[1] / 2 + p.fin[1]
    back = max(back, p.body[1] / 2)
    return [
        count("rectangular pin", "State the number of rectangular pins inside the power connector.", p.pins),
        length("rectangular inside", "width", "Width of the rectangular inside of the power connector?", p.inside[0]),
        count("cooling fin", "How many cooling fins can be seen from the back?", p.fins),
        length("cooling fin", "thickness", "Determine the thickness of a single cooling fin.", p.fin[0]),
        lengths(
            "threaded hole",
            "depth",
            "Give me the depth of the threaded holes on the left and right.",
            [p.port_depth] * 2,
        ),
        length("threaded hole", "radius", "Radius of the threaded hole that is visible from the left?", p.port / 2),
        lengths("screw head", "diameter", "Give the diameters of the round screw heads.", [p.screw_head] * 4),
        length("adapter plate", "thickness", "State the thickness of the adapter plate.", p.plate[2]),
        size(
            "object",
            "Give the overall extents (width, depth, height) of the whole valve.",
            (p.body[0], front + back, p.levels[2] + p.tube_out),
            "extents",
        ),
        lengths(
            "mounting hole",
            "diameter",
            "The four mounting holes that run vertically through the valve body - what diameter were they drilled to?",
            [p.mounting] * 4,
        ),
        length(
            "mounting hole",
            "distance",
            "two diagonally opposite mounting holes of the valve body, how far from centre to centre?",
            hypot(dx, dy),
        ),
        length("nut", "width", "which spanner do I need for the hexagon nut on top of the coil?", p.flats),
        length("power connector", "depth", "How deep can the plug be pushed into the power connector?", p.inside[1]),
        length("logo", "height", "By how much is the logo raised above the side of the coil?", p.logo[0]),
    ]
