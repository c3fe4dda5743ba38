"""A robot's tool fixture: octagonal base plate, round spigot, rectangular fingers, bevelled and blind holes."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Part

from benchmark.kit import Item, Model, count, length, lengths, size
from benchmark.shapes import DOWN, UP, block, circle, cone, prism, rod

MODEL = Model("Tool fixture on an octagonal base plate", "dev")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the base plate lies on z = 0, its flats face x and y."""

    flats: float = 120
    thickness: float = 14
    spigot: float = 36
    spigot_height: float = 18
    spigot_bore: float = 16
    fingers: int = 4
    finger: tuple[float, float] = (20, 12)  # along x, along y
    finger_heights: tuple[float, float] = (30, 42)  # left and right pair
    finger_span: tuple[float, float] = (66, 44)
    bevelled: int = 8
    bevelled_hole: float = 7
    bevel: float = 1.5
    bevelled_circle: float = 104
    pins: int = 2
    pin_hole: float = 6
    pin_depth: float = 9
    pin_circle: float = 80
    recess: float = 50
    recess_depth: float = 4


def build(p: P) -> Part:
    """Plate, spigot and fingers; holes bevelled on top, pin holes and recess from below."""
    body = prism(p.flats, p.thickness, sides=8, rotation=22.5)
    body += rod(p.spigot, p.spigot_height, (0, 0, p.thickness))
    for side, height in zip((-1, 1), p.finger_heights, strict=True):
        for end in (-1, 1):
            foot = (side * p.finger_span[0] / 2, end * p.finger_span[1] / 2, p.thickness)
            body += block((*p.finger, height), foot)
    tools = [rod(p.spigot_bore, p.thickness + p.spigot_height), rod(p.recess, p.recess_depth)]
    for x, y in circle(p.bevelled, p.bevelled_circle):
        tools += [
            rod(p.bevelled_hole, p.thickness, (x, y, 0)),
            cone(p.bevelled_hole + 2 * p.bevel, p.bevelled_hole, p.bevel, (x, y, p.thickness), DOWN),
        ]
    tools += [rod(p.pin_hole, p.pin_depth, (x, y, 0), UP) for x, y in circle(p.pins, p.pin_circle, 90)]
    return body - tools


def questions(p: P) -> list[Item]:
    """Asked by robot programmers who grip and place the fixture."""
    low, high = p.finger_heights
    return [
        size("octagonal base plate", "What is the size of the octagonal base plate?", (p.flats, p.flats, p.thickness)),
        length("octagonal base plate", "thickness", "How thick is the octagonal plate at the base?", p.thickness),
        lengths(
            "rectangular protrusion",
            "height",
            "What are the heights of the rectangular protrusions on the plate?",
            [low, low, high, high],
        ),
        count("rectangular protrusion", "How many rectangular protrusions stand on the base plate?", p.fingers),
        length(
            "rectangular protrusion", "height", "How high is the tallest rectangular protrusion above the plate?", high
        ),
        length(
            "circular protrusion",
            "height",
            "What height has the circular protrusion in the centre, measured from the plate's top?",
            p.spigot_height,
        ),
        length("circular protrusion", "radius", "What is the radius of the circular protrusion?", p.spigot / 2),
        length(
            "circular protrusion",
            "diameter",
            "I want to grip the round spigot from outside: what is its outer diameter?",
            p.spigot,
        ),
        count("hole with bevel", "How many holes with a bevel are in the top?", p.bevelled),
        lengths(
            "hole with bevel",
            "diameter",
            "Which diameter do the bevelled holes have (the bore, not the bevel)?",
            [p.bevelled_hole] * p.bevelled,
        ),
        count("blind hole", "How many blind holes with a diameter of 6 mm are at the bottom?", p.pins),
        lengths("blind hole", "depth", "How deep are the 6 mm holes visible from the bottom?", [p.pin_depth] * p.pins),
        length("blind hole", "distance", "Distance between the centers of the two 6 mm blind holes?", p.pin_circle),
        length("object", "height", "What is the overall height of the fixture?", p.thickness + high),
        length("object", "width", "How wide is the entire object?", p.flats),
        count("hole", "How many holes between 6.5 mm and 10 mm in diameter does the plate have?", p.bevelled),
    ]
