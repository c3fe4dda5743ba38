"""A stereo amplifier without its lid: case on feet, heat sink, knob, mains inlet with pins, vents, logo."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Compound, Part

from benchmark.kit import Item, Model, count, length, lengths, point, size
from benchmark.shapes import DOWN, FRONT, RIGHT, assembly, block, grid, named, rod

MODEL = Model("Stereo amplifier", "dev", bodies=5)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the feet stand on z = 0, the case is open to the top, its middle is x = y = 0."""

    case: tuple[float, float, float] = (210, 150, 60)
    wall: float = 3
    feet: tuple[float, float] = (170, 118)  # pattern
    foot: float = 20
    foot_height: float = 10
    posts: tuple[float, float] = (110, 70)  # pattern of the standoffs with holes
    posts_x: float = 20
    post: float = 9
    post_height: float = 8
    post_hole: float = 3
    post_hole_depth: float = 6
    studs: int = 2
    stud: float = 6  # standoffs without holes
    stud_x: float = -70
    stud_y: float = 30
    vents: tuple[int, int] = (5, 4)  # along y and z, in the right wall
    vent: float = 6
    vent_pitch: float = 11
    vent_z: float = 42
    card: tuple[float, float] = (40, 14)  # along y and z, in the left wall
    card_z: float = 36  # of its underside
    sink: tuple[float, float, float] = (108, 6, 50)  # base plate
    sink_x: float = 40
    sink_z: float = 15
    fins: int = 9
    fin: tuple[float, float] = (3, 22)  # thickness, height from the base plate
    fin_pitch: float = 12
    inlet: tuple[float, float, float] = (28, 18, 22)
    inlet_x: float = -65
    inlet_z: float = 30  # of its underside
    inlet_out: float = 4  # in front of the back wall
    socket: tuple[float, float, float] = (20, 12, 14)  # along x, y and z
    pins: int = 3
    pin: tuple[float, float, float] = (4, 9, 2)  # along x, y and z
    pin_pitch: float = 6
    knob: float = 32
    knob_length: float = 18
    knob_x: float = 60
    knob_z: float = 40
    logo: tuple[float, float, float] = (24, 1.5, 24)  # along x, y and z
    logo_stroke: float = 6
    logo_x: float = -60
    logo_z: float = 28

    @property
    def floor(self) -> float:
        """Height of the floor inside."""
        return self.foot_height + self.wall

    @property
    def inside(self) -> tuple[float, float, float]:
        """Size of the hollow."""
        width, depth, height = self.case
        return (width - 2 * self.wall, depth - 2 * self.wall, height - self.wall)


def case(p: P) -> Part:
    """Hollow, on feet, with standoffs, cut out for air, card and mains inlet."""
    width, depth, _ = p.case
    body = block(p.case, (0, 0, p.foot_height)) - block(p.inside, (0, 0, p.floor))
    body += [rod(p.foot, p.foot_height, (x, y, 0)) for x, y in grid(2, 2, *p.feet)]
    tip = p.floor + p.post_height
    for x, y in grid(2, 2, *p.posts, (p.posts_x, 0)):
        body += rod(p.post, p.post_height, (x, y, p.floor))
        body -= rod(p.post_hole, p.post_hole_depth, (x, y, tip), DOWN)
    body += [rod(p.stud, p.post_height, (p.stud_x, y, p.floor)) for y in (-p.stud_y, p.stud_y)]
    body -= [
        rod(p.vent, p.wall, (width / 2 - p.wall, y, z), RIGHT)
        for y, z in grid(*p.vents, p.vent_pitch, p.vent_pitch, (0, p.vent_z))
    ]
    body -= block((p.wall, *p.card), ((p.wall - width) / 2, 0, p.card_z))
    return body - block((p.inlet[0], p.wall, p.inlet[2]), (p.inlet_x, (depth - p.wall) / 2, p.inlet_z))


def inlet(p: P) -> Part:
    """A block with a rectangular socket, out of whose bottom stand three flat pins."""
    back = p.case[1] / 2 + p.inlet_out
    x, depth = p.inlet_x, p.inlet[1]
    body = block(p.inlet, (x, back - depth / 2, p.inlet_z))
    low = p.inlet_z + (p.inlet[2] - p.socket[2]) / 2
    body -= block(p.socket, (x, back - p.socket[1] / 2, low))
    y = back - p.socket[1] + p.pin[1] / 2
    z = p.inlet_z + (p.inlet[2] - p.pin[2]) / 2
    return body + [block(p.pin, (x + (index - (p.pins - 1) / 2) * p.pin_pitch, y, z)) for index in range(p.pins)]


def sink(p: P) -> Part:
    """A base plate on the back wall with upright fins."""
    wall, thick = p.case[1] / 2, p.sink[1]
    body = block(p.sink, (p.sink_x, wall + thick / 2, p.sink_z))
    fin = (p.fin[0], p.fin[1], p.sink[2])
    xs = [p.sink_x + (index - (p.fins - 1) / 2) * p.fin_pitch for index in range(p.fins)]
    return body + [block(fin, (x, wall + thick + p.fin[1] / 2, p.sink_z)) for x in xs]


def logo(p: P) -> Part:
    """A T, read from the front."""
    wide, thick, high = p.logo
    y = -(p.case[1] + thick) / 2
    body = block((p.logo_stroke, thick, high), (p.logo_x, y, p.logo_z))
    return body + block((wide, thick, p.logo_stroke), (p.logo_x, y, p.logo_z + high - p.logo_stroke))


def build(p: P) -> Compound:
    """Puts heat sink, inlet, knob and logo into place."""
    knob = rod(p.knob, p.knob_length, (p.knob_x, -p.case[1] / 2, p.knob_z), FRONT)
    return assembly(
        [
            named(case(p), "Case", "DimGray"),
            named(sink(p), "Heat sink", "Silver"),
            named(inlet(p), "Power connector", "Black"),
            named(knob, "Volume knob", "Gainsboro"),
            named(logo(p), "Logo", "Gold"),
        ]
    )


def questions(p: P) -> list[Item]:
    """Asked in the plain way, and by a hi-fi tinkerer, a repair shop and a product manager."""
    back = p.case[1] / 2 + p.inlet_out
    middle = (p.inlet_x, back - p.inlet[1] / 2, p.inlet_z + p.inlet[2] / 2)
    return [
        count("cooling fin", "How many cooling fins are visible from the back?", p.fins),
        lengths("cooling fin", "thickness", "What is the thickness of the cooling fins?", [p.fin[0]] * p.fins),
        size("rectangular inside", "What is the size of the rectangular inside visible from the top?", p.inside),
        point("power connector", "What is the center of the power connector?", middle),
        lengths(
            "standoff with hole", "diameter", "What is the outer diameter of the standoffs with a hole?", [p.post] * 4
        ),
        count("standoff without hole", "How many standoffs without a hole are visible from the top?", p.studs),
        lengths("leg", "height", "What is the height of the legs visible from the bottom?", [p.foot_height] * 4),
        count("grid", "nr of vent holes in the grid on the right side", p.vents[0] * p.vents[1]),
        length("leg", "distance", "Distance between a front foot and the foot behind it, centre to centre?", p.feet[1]),
        length("logo", "thickness", "By how much does the logo stand proud of the front panel?", p.logo[1]),
        length("cylinder", "diameter", "volume knob diameter pls", p.knob),
        length(
            "cutout", "width", "How wide is the rectangular cutout in the left wall, measured front to back?", p.card[0]
        ),
        count(
            "rectangular pin", "Hey, how many rectangular pins do I find inside the mains socket at the back?", p.pins
        ),
        size("power connector", "Which dimensions has the power connector itself?", p.inlet),
    ]
