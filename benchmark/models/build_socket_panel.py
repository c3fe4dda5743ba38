"""A panel with a power connector: a rectangular socket with three rectangular pins inside, and a cable notch."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Compound

from benchmark.kit import Item, Model, count, length, lengths, point, points, size
from benchmark.shapes import FRONT, assembly, block, grid, named, rod

MODEL = Model("Panel with power connector", "dev", bodies=5)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the panel stands upright, its front face is y = 0, its middle is x = 0, its lower edge z = 0."""

    width: float = 90
    height: float = 70
    thickness: float = 4
    screws: tuple[int, int] = (2, 2)
    screw: float = 4.5
    screw_x: float = 76
    screw_z: float = 54
    notch: float = 9  # radius of the half round at the lower edge
    socket: tuple[float, float] = (34, 24)  # x, z
    socket_depth: float = 15  # how far it stands out
    socket_wall: float = 2
    socket_z: float = 38
    pins: int = 3
    pin: tuple[float, float, float] = (2, 9, 6)  # x, y, z
    pin_pitch: float = 9


def build(p: P) -> Compound:
    """A sheet, a cup and three pins."""
    middle = p.height / 2
    panel = block((p.width, p.thickness, p.height), (0, p.thickness / 2, 0))
    for x, z in grid(*p.screws, p.screw_x, p.screw_z, (0, middle)):
        panel -= rod(p.screw, p.thickness, (x, p.thickness, z), FRONT)
    panel -= rod(2 * p.notch, p.thickness, (0, p.thickness, 0), FRONT)
    w, h = p.socket
    y = -p.socket_depth / 2
    low = p.socket_z - h / 2
    cup = block((w, p.socket_depth, h), (0, y, low))
    cup -= block(
        (w - 2 * p.socket_wall, p.socket_depth - p.socket_wall, h - 2 * p.socket_wall),
        (0, y - p.socket_wall / 2, low + p.socket_wall),
    )
    pins = [
        named(block(p.pin, (x, -p.socket_wall - p.pin[1] / 2, p.socket_z - p.pin[2] / 2)), f"pin {n}", "gold")
        for n, (x, _) in enumerate(grid(p.pins, 1, p.pin_pitch, 0), start=1)
    ]
    return assembly([named(panel, "panel", "lightgray"), named(cup, "power connector", "black"), *pins])


def questions(p: P) -> list[Item]:
    """Asked by an electrician and a plugging robot."""
    middle = p.height / 2
    return [
        size(
            "power connector",
            "What is the size of the power connector?",
            (p.socket[0], p.socket_depth, p.socket[1]),
        ),
        point("power connector", "Where is the power connector?", (0, -p.socket_depth / 2, p.socket_z)),
        length("power connector", "depth", "How far does the connector stick out of the panel?", p.socket_depth),
        count("rectangular pin", "How many rectangular pins does the connector have?", p.pins),
        lengths("rectangular pin", "width", "How wide are the pins?", [p.pin[0]] * p.pins),
        lengths("rectangular pin", "height", "What is the height of the pins in z?", [p.pin[2]] * p.pins),
        length(
            "rectangular inside",
            "width",
            "What is the width of the rectangular inside of the connector?",
            p.socket[0] - 2 * p.socket_wall,
        ),
        length(
            "rectangular inside",
            "depth",
            "How deep is the rectangular indentation visible from the front?",
            p.socket_depth - p.socket_wall,
        ),
        count("mounting hole", "How many mounting holes are there?", p.screws[0] * p.screws[1]),
        lengths("mounting hole", "diameter", "Diameters of all mounting holes?", [p.screw] * 4),
        points(
            "mounting hole",
            "Where exactly are the mounting holes (centres)?",
            sorted((x, p.thickness / 2, z) for x, z in grid(*p.screws, p.screw_x, p.screw_z, (0, middle))),
        ),
        length("semicircle", "radius", "What is the radius of the semicircle at the bottom?", p.notch),
        length("semicircle", "diameter", "Diameter of the half-round cable notch?", 2 * p.notch),
        length("rectangular part", "thickness", "How thick is the panel?", p.thickness),
        length("object", "width", "What is the total width of the object?", p.width),
        length("rectangular pin", "distance", "What is the gap between neighbouring pins?", p.pin_pitch - p.pin[0]),
        count("rectangular pin", "How many golden bodies are there?", p.pins),
    ]
