"""A circuit board on standoffs: power connector, pin header, heat sink; each a named body."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Compound, Part

from benchmark.kit import Item, Model, count, length, lengths, point, points, size, texts
from benchmark.shapes import LEFT, RIGHT, assembly, block, grid, named, rod

MODEL = Model("Circuit board on standoffs", "dev", bodies=17)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the standoffs stand on z = 0, the board's middle is x = y = 0."""

    board: tuple[float, float, float] = (100, 70, 1.6)
    holes: tuple[float, float] = (92, 62)
    hole: float = 3.2
    standoff: float = 6
    standoff_height: float = 8
    standoff_bore: float = 2.5  # core hole of M3
    post: float = 5
    posts: tuple[tuple[float, float], ...] = ((0, 25), (0, -25))
    jack: tuple[float, float, float] = (14, 9, 11)
    jack_y: float = 12
    jack_over: float = 2  # beyond the board's left edge
    jack_bore: float = 6.4
    jack_depth: float = 10
    jack_pin: float = 2
    jack_pin_length: float = 9
    jack_z: float = 6.5  # of its axis above the board
    pins: int = 6
    pin: tuple[float, float, float] = (0.64, 0.64, 11.5)
    pin_pitch: float = 2.54
    pin_tail: float = 3  # below the board's upper face
    pin_hole: float = 1
    header_height: float = 2.5
    header_at: tuple[float, float] = (20, -28)
    sink: tuple[float, float, float] = (25, 20, 3)
    sink_at: tuple[float, float] = (22, 10)
    fins: int = 7
    fin: float = 1
    fin_height: float = 9
    logo: tuple[float, float, float] = (12, 9, 0.4)  # an H of three bars, on the board
    logo_bar: float = 3
    logo_at: tuple[float, float] = (-20, -15)

    @property
    def under(self) -> float:
        """Height of the board's underside."""
        return self.standoff_height

    @property
    def top(self) -> float:
        """Height of the board's upper face."""
        return self.standoff_height + self.board[2]

    def pins_at(self) -> list[tuple[float, float]]:
        """Where are the header's pins?"""
        return grid(self.pins, 1, self.pin_pitch, 0, self.header_at)


def jack(p: P) -> Part:
    """Open to the left, with a round pin inside."""
    x = -p.board[0] / 2 - p.jack_over
    z = p.top + p.jack_z
    body = block(p.jack, (x + p.jack[0] / 2, p.jack_y, p.top))
    body -= rod(p.jack_bore, p.jack_depth, (x, p.jack_y, z), RIGHT)
    return body + rod(p.jack_pin, p.jack_pin_length, (x + p.jack_depth, p.jack_y, z), LEFT)


def sink(p: P) -> Part:
    """A base with fins along y, the outer ones flush with it."""
    x, y = p.sink_at
    pitch = (p.sink[0] - p.fin) / (p.fins - 1)
    body = block(p.sink, (x, y, p.top))
    fins = [block((p.fin, p.sink[1], p.fin_height), (a, y, p.top + p.sink[2])) for a, _ in grid(p.fins, 1, pitch, 0)]
    return body + [fin.translate((x, 0, 0)) for fin in fins]


def logo(p: P) -> Part:
    """Two bars upright, one between them."""
    (width, depth, height), (x, y) = p.logo, p.logo_at
    body = block((width, p.logo_bar, height), (x, y, p.top))
    return body + [
        block((p.logo_bar, depth, height), (x + side * (width - p.logo_bar) / 2, y, p.top)) for side in (-1, 1)
    ]


def build(p: P) -> Compound:
    """Mounts the parts."""
    board = block(p.board, (0, 0, p.under))
    board -= [rod(p.hole, p.board[2], (x, y, p.under)) for x, y in grid(2, 2, *p.holes)]
    board -= [rod(p.pin_hole, p.board[2], (x, y, p.under)) for x, y in p.pins_at()]
    header = block((p.pins * p.pin_pitch, p.pin_pitch, p.header_height), (*p.header_at, p.top))
    header -= [block((p.pin[0], p.pin[1], p.header_height), (x, y, p.top)) for x, y in p.pins_at()]
    bodies = [
        named(board, "PCB", "DarkGreen"),
        named(jack(p), "DC power connector", "Black"),
        named(header, "Header housing", "DimGray"),
        named(sink(p), "Heat sink", "Silver"),
        named(logo(p), "Logo", "White"),
    ]
    bodies += [named(block(p.pin, (x, y, p.top - p.pin_tail)), "Pin", "Gold") for x, y in p.pins_at()]
    for x, y in grid(2, 2, *p.holes):
        standoff = rod(p.standoff, p.standoff_height, (x, y, 0)) - rod(p.standoff_bore, p.standoff_height, (x, y, 0))
        bodies.append(named(standoff, "Standoff M3", "Goldenrod"))
    bodies += [named(rod(p.post, p.standoff_height, (x, y, 0)), "Support post", "White") for x, y in p.posts]
    return assembly(bodies)


def questions(p: P) -> list[Item]:
    """Asked by electronics people, an enclosure's designer and a pick-and-place programmer."""
    names = ["PCB", "DC power connector", "Header housing", "Heat sink", "Logo", "Pin", "Standoff M3", "Support post"]
    x, y = p.sink_at
    sink_top = p.top + p.sink[2] + p.fin_height
    return [
        size("object", "board dimensions? (PCB only, L x W x thickness)", p.board),
        length("object", "thickness", "How thick is the PCB?", p.board[2]),
        lengths(
            "mounting hole",
            "diameter",
            "What diameter do the four corner mounting holes of the board have?",
            [p.hole] * 4,
        ),
        length(
            "mounting hole",
            "distance",
            "For the enclosure I need the mounting hole spacing along the width of the PCB, centre to centre.",
            p.holes[0],
        ),
        lengths("hole", "diameter", "Which different hole diameters occur in the PCB?", [p.pin_hole, p.hole]),
        length("logo", "height", "By how much is the logo raised above the board?", p.logo[2]),
        length("logo", "width", "how wide is the logo", p.logo[0]),
        point("logo", "Where is the logo's centre on the board?", (*p.logo_at, p.top + p.logo[2] / 2)),
        count("rectangular pin", "How many rectangular pins has the pin header?", p.pins),
        length("rectangular pin", "distance", "Pitch of the header pins?", p.pin_pitch),
        lengths("rectangular pin", "height", "How tall is each of the pins in z?", [p.pin[2]] * p.pins),
        size("power connector", "What are the dimensions of the power connector?", p.jack),
        length(
            "power connector", "radius", "Radius of the round opening of the DC connector on the left", p.jack_bore / 2
        ),
        length(
            "power connector",
            "distance",
            "By how much does the power connector stick out over the left edge of the board?",
            p.jack_over,
        ),
        count("standoff with hole", "Count the standoffs with a hole.", 4),
        lengths("standoff with hole", "height", "How high are the M3 standoffs?", [p.standoff_height] * 4),
        count("standoff without hole", "How many standoffs without a hole support the board?", len(p.posts)),
        lengths("standoff without hole", "diameter", "Diameter of the support posts?", [p.post] * len(p.posts)),
        points(
            "standoff without hole",
            "where are the support posts (center coordinates)",
            [(a, b, p.standoff_height / 2) for a, b in p.posts],
        ),
        count("cooling fin", "How many fins does the heatsink have?", p.fins),
        lengths("cooling fin", "thickness", "What's the thickness of the cooling fins?", [p.fin] * p.fins),
        length("cooling fin", "height", "How high is a single fin of the heat sink, without the base?", p.fin_height),
        point("object", "Where is the centre of the heat sink?", (x, y, (p.top + sink_top) / 2)),
        length("object", "height", "What's the total height of the assembly including standoffs?", sink_top),
        texts("object", "Which different body names occur in the file?", names),
    ]
