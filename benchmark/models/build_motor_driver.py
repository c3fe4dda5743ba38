"""A motor driver for a cabinet wall: heat sink with fins behind, vented housing, board, power connector below."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Compound, Part

from benchmark.kit import Item, Model, count, length, lengths, point, size, text, texts
from benchmark.shapes import BACK, FRONT, assembly, block, grid, named, rod

MODEL = Model("Motor driver with heat sink", "dev", bodies=10)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; upright: the heat sink's front face is y = 0, its lower edge z = 0, its middle x = 0."""

    plate: tuple[float, float, float] = (108, 8, 190)
    fins: int = 9
    fin: tuple[float, float, float] = (2.4, 24, 150)
    fin_pitch: float = 12
    holes: int = 4
    hole: float = 5.2
    hole_span: tuple[float, float] = (90, 176)  # along x and z
    housing: tuple[float, float, float] = (104, 62, 158)
    wall: float = 2.5
    vents: tuple[int, int] = (5, 3)  # along x and y
    vent: tuple[float, float] = (13, 4)
    vent_pitch: tuple[float, float] = (18, 11)
    display: tuple[float, float, float] = (52, 1.2, 26)  # recess in the front
    display_z: float = 120
    logo: tuple[float, float, float] = (26, 0.8, 18)
    logo_stroke: float = 5
    logo_z: float = 48
    light: float = 6
    light_height: float = 1.5
    light_span: float = 30
    light_z: float = 88
    standoff: float = 8
    standoff_height: float = 14
    standoff_hole: float = 3.2
    standoff_depth: float = 9
    standoff_span: tuple[float, float] = (70, 110)
    board: tuple[float, float, float] = (84, 1.6, 124)
    board_hole: float = 3.4
    connector: tuple[float, float, float] = (36, 24, 15)
    connector_wall: float = 2
    connector_y: float = -34
    pin: tuple[float, float, float] = (1.6, 6, 10)
    pin_pitch: float = 9

    @property
    def low(self) -> float:
        """How high is the housing's underside? The housing stands in the middle of the plate."""
        return (self.plate[2] - self.housing[2]) / 2

    @property
    def front(self) -> float:
        """Where on y is the housing's front face?"""
        return -self.housing[1]


def heat_sink(p: P) -> Part:
    """A plate with fins behind, standoffs in front and holes in the corners."""
    middle = p.plate[2] / 2
    body = block(p.plate, (0, p.plate[1] / 2, 0))
    for x, _ in grid(p.fins, 1, p.fin_pitch, 0):
        body += block(p.fin, (x, p.plate[1] + p.fin[1] / 2, middle - p.fin[2] / 2))
    body -= [rod(p.hole, p.plate[1], (x, 0, z), BACK) for x, z in grid(2, p.holes // 2, *p.hole_span, (0, middle))]
    for x, z in grid(2, 2, *p.standoff_span, (0, middle)):
        body += rod(p.standoff, p.standoff_height, (x, 0, z), FRONT)
        body -= rod(p.standoff_hole, p.standoff_depth, (x, -p.standoff_height, z), BACK)
    return body


def housing(p: P) -> Part:
    """A box that is open at the back, with vents above, an opening for the connector below, a display recess."""
    width, depth, height = p.housing
    body = block(p.housing, (0, -depth / 2, p.low))
    body -= block((width - 2 * p.wall, depth - p.wall, height - 2 * p.wall), (0, -(depth - p.wall) / 2, p.low + p.wall))
    top = p.low + height
    body -= [block((*p.vent, p.wall), (x, y, top - p.wall)) for x, y in grid(*p.vents, *p.vent_pitch, (0, -depth / 2))]
    body -= block((*p.connector[:2], p.wall), (0, p.connector_y, p.low))
    return body - block(p.display, (0, p.front + p.display[1] / 2, p.display_z - p.display[2] / 2))


def connector(p: P) -> Part:
    """A cup that is open downwards, in the housing's floor and below it."""
    width, depth, height = p.connector
    body = block(p.connector, (0, p.connector_y, p.low + p.wall - height))
    inside = (width - 2 * p.connector_wall, depth - 2 * p.connector_wall, height - p.connector_wall)
    return body - block(inside, (0, p.connector_y, p.low + p.wall - height))


def build(p: P) -> Compound:
    """Screws board and housing to the heat sink, adds connector, lamps and logo."""
    middle = p.plate[2] / 2
    board = block(p.board, (0, -p.standoff_height - p.board[1] / 2, middle - p.board[2] / 2))
    board -= [
        rod(p.board_hole, p.board[1], (x, -p.standoff_height, z), FRONT)
        for x, z in grid(2, 2, *p.standoff_span, (0, middle))
    ]
    roof = p.low + p.wall - p.connector_wall
    pins = [
        named(block(p.pin, (x, p.connector_y, roof - p.pin[2])), f"Pin {name}", "Gold")
        for name, (x, _) in zip(("L", "N", "PE"), grid(3, 1, p.pin_pitch, 0), strict=True)
    ]
    width, thickness, height = p.logo
    y, foot = p.front - thickness / 2, p.logo_z - height / 2
    logo = block((p.logo_stroke, thickness, height), (0, y, foot))
    logo += block((width, thickness, p.logo_stroke), (0, y, foot + height - p.logo_stroke))
    lights = [
        named(rod(p.light, p.light_height, (side * p.light_span / 2, p.front, p.light_z), FRONT), name, color)
        for side, name, color in ((-1, "Status LED", "Lime"), (1, "Error LED", "Red"))
    ]
    return assembly(
        [
            named(heat_sink(p), "Heat sink", "Silver"),
            named(housing(p), "Housing", "DimGray"),
            named(board, "Control board", "DarkGreen"),
            named(connector(p), "Power connector", "Black"),
            *pins,
            named(logo, "Logo", "White"),
            *lights,
        ]
    )


def questions(p: P) -> list[Item]:
    """Asked by a panel builder, a thermal engineer, a purchasing clerk and a plugging robot's programmer."""
    height = p.connector[2]
    return [
        count("cooling fin", "how many cooling fins at the back", p.fins),
        lengths("cooling fin", "thickness", "fin thickness, of each fin please", [p.fin[0]] * p.fins),
        length(
            "cooling fin",
            "distance",
            "I do the thermal simulation and need the air gap. What is the clear distance between two adjacent fins?",
            p.fin_pitch - p.fin[0],
        ),
        length(
            "cooling fin",
            "height",
            "By how much does one cooling fin stand out from the plate of the heat sink?",
            p.fin[1],
        ),
        length(
            "mounting hole",
            "distance",
            "drilling template for the cabinet: vertical c-c of the through holes in the heat sink?",
            p.hole_span[1],
        ),
        lengths(
            "mounting hole",
            "diameter",
            "Four screws hold the heat sink to the cabinet wall. What diameters do the through holes for them have?",
            [p.hole] * p.holes,
        ),
        size("power connector", "Size of the power connector in x, y and z?", p.connector),
        point(
            "power connector",
            "The robot shall plug in the cable from below. At what position is the power connector's centre?",
            (0, p.connector_y, p.low + p.wall - height / 2),
        ),
        count("rectangular pin", "how many rectangular pins are in the power connector", 3),
        texts(
            "rectangular pin",
            "How are these pins named? I mean the ones in the connector.",
            ["Pin L", "Pin N", "Pin PE"],
        ),
        count("grid", "The vent grid on top of the housing, how many openings does it have?", p.vents[0] * p.vents[1]),
        length("logo", "width", "logo - how wide overall, in cm?", p.logo[0]),
        length(
            "rectangular indentation",
            "depth",
            "Our display foil is glued into the rectangular recess on the front. How deep is it?",
            p.display[1],
        ),
        text("circular protrusion", "what is the red lamp at the front called", "Error LED"),
        lengths(
            "standoff with hole",
            "height",
            "The board is carried by four standoffs on the heat sink. What are their heights, along y?",
            [p.standoff_height] * 4,
        ),
        length(
            "object",
            "depth",
            "what depth does the whole thing need, from the LEDs at the front to the fin tips?",
            p.light_height - p.front + p.plate[1] + p.fin[1],
        ),
    ]
