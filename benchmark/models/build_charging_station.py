"""A desktop charging station without its lid: case on legs, standoffs, vents, connector with pin, raised logo."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Compound, Part

from benchmark.kit import Item, Model, count, length, lengths, point, size
from benchmark.shapes import BACK, DOWN, FRONT, RIGHT, assembly, block, grid, named, rod

MODEL = Model("Charging station", "dev", bodies=4)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the legs stand on z = 0, the case is open to the top, its middle is x = y = 0."""

    case: tuple[float, float, float] = (160, 110, 50)
    wall: float = 3
    legs: tuple[float, float] = (130, 84)  # pattern
    leg: float = 14
    leg_height: float = 8
    posts: tuple[float, float] = (96, 60)  # pattern of the standoffs with holes
    posts_x: float = -12
    post: float = 8
    post_height: float = 10
    post_hole: float = 3.2
    post_hole_depth: float = 7
    stud: float = 6  # standoffs without holes
    studs_x: float = 62
    studs_y: float = 25
    ports: int = 4
    port: tuple[float, float] = (13.2, 5.8)  # USB type A, along x and z
    port_pitch: float = 30
    port_z: float = 34  # of its middle
    vents: tuple[int, int] = (6, 3)
    vent: float = 5
    vent_pitch: float = 11
    vent_z: float = 38
    connector: tuple[float, float, float] = (16, 14, 12)  # flush with the back
    connector_x: float = 40
    connector_z: float = 22  # of its underside
    socket: float = 6.4
    socket_depth: float = 10
    pin: float = 2.1
    pin_length: float = 9
    logo: tuple[float, float, float] = (1.2, 20, 26)  # on the left side
    logo_stroke: float = 7
    logo_z: float = 20

    @property
    def floor(self) -> float:
        """Height of the floor inside."""
        return self.leg_height + self.wall

    @property
    def inside(self) -> tuple[float, float, float]:
        """Size of the hollow."""
        width, depth, height = self.case
        return (width - 2 * self.wall, depth - 2 * self.wall, height - self.wall)


def case(p: P) -> Part:
    """Hollow, on legs, with standoffs, cut out for sockets, connector and air."""
    width, depth, _ = p.case
    body = block(p.case, (0, 0, p.leg_height)) - block(p.inside, (0, 0, p.floor))
    body += [rod(p.leg, p.leg_height, (x, y, 0)) for x, y in grid(2, 2, *p.legs)]
    tip = p.floor + p.post_height
    for x, y in grid(2, 2, *p.posts, (p.posts_x, 0)):
        body += rod(p.post, p.post_height, (x, y, p.floor))
        body -= rod(p.post_hole, p.post_hole_depth, (x, y, tip), DOWN)
    body += [rod(p.stud, p.post_height, (p.studs_x, y, p.floor)) for y in (-p.studs_y, p.studs_y)]
    for index in range(p.ports):
        x = (index - (p.ports - 1) / 2) * p.port_pitch
        body -= block((p.port[0], p.wall, p.port[1]), (x, (p.wall - depth) / 2, p.port_z - p.port[1] / 2))
    body -= [
        rod(p.vent, p.wall, (width / 2 - p.wall, y, z), RIGHT)
        for y, z in grid(*p.vents, p.vent_pitch, p.vent_pitch, (0, p.vent_z))
    ]
    hole = (p.connector[0], p.wall, p.connector[2])
    return body - block(hole, (p.connector_x, (depth - p.wall) / 2, p.connector_z))


def logo(p: P) -> Part:
    """An L, read from the left."""
    thick, wide, high = p.logo
    x = -p.case[0] / 2 - thick / 2
    body = block((thick, wide, p.logo_stroke), (x, 0, p.logo_z))
    return body + block((thick, p.logo_stroke, high), (x, (wide - p.logo_stroke) / 2, p.logo_z))


def build(p: P) -> Compound:
    """Puts connector, pin and logo into place."""
    back = p.case[1] / 2
    axis = (p.connector_x, back, p.connector_z + p.connector[2] / 2)
    connector = block(p.connector, (p.connector_x, back - p.connector[1] / 2, p.connector_z))
    connector -= rod(p.socket, p.socket_depth, axis, FRONT)
    pin = rod(p.pin, p.pin_length, (axis[0], back - p.socket_depth, axis[2]), BACK)
    return assembly(
        [
            named(case(p), "Case", "DarkSlateGray"),
            named(connector, "Power connector", "Black"),
            named(pin, "Centre pin", "Gold"),
            named(logo(p), "Logo", "White"),
        ]
    )


def questions(p: P) -> list[Item]:
    """Asked in the plain way, and by an electronics technician, a product designer and a hobbyist."""
    number = p.vents[0] * p.vents[1]
    middle = (p.connector_x, (p.case[1] - p.connector[1]) / 2, p.connector_z + p.connector[2] / 2)
    return [
        count("leg", "How many legs are visible from the bottom?", 4),
        lengths("leg", "height", "What is the height of the legs?", [p.leg_height] * 4),
        size("rectangular inside", "What is the size of the rectangular inside visible from the top?", p.inside),
        count("standoff with hole", "How many standoffs with a hole are there?", 4),
        lengths(
            "standoff without hole", "diameter", "What is the diameter of the standoffs without a hole?", [p.stud] * 2
        ),
        size("power connector", "What is the size of the power connector?", p.connector),
        point("power connector", "What is the center of the power connector?", middle),
        lengths(
            "cutout", "length", "How long are the rectangular cutouts visible from the front?", [p.port[0]] * p.ports
        ),
        count("cutout", "how many usb cutouts has the front wall", p.ports),
        lengths(
            "standoff with hole",
            "depth",
            "How deep can a screw go into the holes of the standoffs?",
            [p.post_hole_depth] * 4,
        ),
        count("grid", "In the vent grid at the right side, how many holes are there?", number),
        length("rod", "diameter", "Pin diameter of the DC jack, the contact in the middle I mean?", p.pin),
        length("logo", "thickness", "How far does the logo stand out from the left side?", p.logo[0]),
        length("rectangular part", "thickness", "Wall thickness of the case?", p.wall),
    ]
