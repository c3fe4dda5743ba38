"""An indexing table: octagonal base plate, round table with radial slots and threads, bevelled bore, keys, pin hole."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part

from benchmark.kit import Item, Model, count, exists, length, lengths, points, size
from benchmark.shapes import DOWN, LEFT, block, circle, cone, drill, prism, rod

MODEL = Model("Indexing table", "dev")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres and degrees; the octagonal base plate lies on z = 0, the axis is z."""

    base: float = 180  # across flats, two of which face left and right
    base_height: float = 16
    bolts: int = 4
    bolt: float = 9
    bolt_circle: float = 155
    head: float = 15
    head_depth: float = 9
    table: float = 120
    table_height: float = 32
    slots: int = 8
    slot: tuple[float, float, float] = (34, 10, 8)  # length up to the rim, width, depth
    threads: int = 8
    thread: float = 6.8  # core hole of M8
    thread_depth: float = 16
    thread_circle: float = 90
    bore: float = 30
    bevel: float = 2  # at 45 degrees
    keys: int = 2
    key: tuple[float, float, float] = (10, 6, 9)
    key_at: tuple[float, float] = (22, -75)  # on x, to both sides; on y
    pin: float = 8  # hole in the right
    pin_depth: float = 22

    @property
    def height(self) -> float:
        """Of the whole."""
        return self.base_height + self.table_height


def build(p: P) -> Part:
    """Puts the table on its plate, mills, drills."""
    top, low = p.height, p.base_height
    body = prism(p.base, low, sides=8, rotation=22.5) + rod(p.table, p.table_height, (0, 0, low))
    body += [block(p.key, (x, p.key_at[1], low)) for x in (-p.key_at[0], p.key_at[0])]
    length, width, depth = p.slot
    cutter = block((length, width, depth), ((p.table - length) / 2, 0, top - depth))
    body -= [cutter.rotate(Axis.Z, 360 * index / p.slots) for index in range(p.slots)]
    body -= rod(p.bore, top) + cone(p.bore + 2 * p.bevel, p.bore, p.bevel, (0, 0, top), DOWN)
    body -= [
        drill(p.thread, p.thread_depth, (x, y, top)) for x, y in circle(p.threads, p.thread_circle, 180 / p.threads)
    ]
    for x, y in circle(p.bolts, p.bolt_circle, 45):
        body -= rod(p.bolt, low, (x, y, 0)) + rod(p.head, p.head_depth, (x, y, low), DOWN)
    return body - rod(p.pin, p.pin_depth, (p.table / 2, 0, low + 10), LEFT)


def questions(p: P) -> list[Item]:
    """Asked in the plain way, and by a toolmaker, a robot programmer and a trainee."""
    bolts = circle(p.bolts, p.bolt_circle, 45)
    return [
        size(
            "octagonal base plate",
            "What is the size of the octagonal base plate?",
            (p.base, p.base, p.base_height),
        ),
        count("radial slots", "How many radial slots are visible from the top?", p.slots),
        lengths("radial slots", "width", "What is the width of the radial slots?", [p.slot[1]] * p.slots),
        length(
            "circular protrusion", "diameter", "What is the diameter of the circular protrusion on the top?", p.table
        ),
        count("threaded hole", "How many blind threaded holes are visible from the top?", p.threads),
        length("hole", "diameter", "What is the diameter of the hole visible from the right?", p.pin),
        lengths(
            "rectangular pin", "height", "What is the height of the rectangular pins on the top?", [p.key[2]] * p.keys
        ),
        length("blind hole", "depth", "index pin hole on the right, how deep?", p.pin_depth),
        lengths("mounting hole", "diameter", "Counterbore dia of the mounting holes in the base", [p.head] * p.bolts),
        points(
            "mounting hole",
            "I'd like the centre coordinates of the four counterbored mounting holes.",
            [(x, y, p.base_height / 2) for x, y in bolts],
        ),
        length("object", "height", "What is total hight of the table, base plate included?", p.height),
        length("hole with bevel", "radius", "Radius of the central bore that has a bevel at its mouth?", p.bore / 2),
        length("threaded hole", "diameter", "On what diameter is the circle of tapped holes?", p.thread_circle),
        exists("hole", "Can you see any hole from the left side?", False),
    ]
