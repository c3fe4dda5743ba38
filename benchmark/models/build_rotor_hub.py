"""A rotor hub: a round base with radial slots, a bolt circle, a hub with a blind bore, a stub shaft with a cone."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part

from benchmark.kit import Form, Item, Model, count, length, point, size
from benchmark.shapes import DOWN, block, circle, cone, rod

MODEL = Model("Rotor hub", "dev", Form.BSPLINE)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the disc's underside is z = 0, its axis z."""

    base: float = 110
    base_height: float = 12
    slots: int = 5
    slot_width: float = 7
    slot_length: float = 16  # radially, from the rim inwards
    slot_depth: float = 5
    bolts: int = 5
    bolt: float = 6.4
    bolt_circle: float = 62
    bolt_start: float = 36  # degrees, half-way between two slots
    hub: float = 36
    hub_height: float = 20
    bore: float = 20
    bore_depth: float = 24
    shaft: float = 16
    shaft_length: float = 30
    tip: float = 10  # height of the cone
    tip_end: float = 6  # diameter of its end

    @property
    def top(self) -> float:
        """Height of the hub's upper face."""
        return self.base_height + self.hub_height


def build(p: P) -> Part:
    """Turns, bores and mills."""
    body = rod(p.base, p.base_height) + rod(p.hub, p.top)
    body += rod(p.shaft, p.shaft_length, (0, 0, 0), DOWN)
    body += cone(p.shaft, p.tip_end, p.tip, (0, 0, -p.shaft_length), DOWN)
    body -= rod(p.bore, p.bore_depth, (0, 0, p.top), DOWN)
    body -= [rod(p.bolt, p.base_height, (x, y, 0)) for x, y in circle(p.bolts, p.bolt_circle, p.bolt_start)]
    reach = p.slot_length + 5  # the cutter runs out beyond the rim
    tool = block(
        (reach, p.slot_width, p.slot_depth), (p.base / 2 - p.slot_length + reach / 2, 0, p.base_height - p.slot_depth)
    )
    body -= [tool.rotate(Axis.Z, 360 * index / p.slots) for index in range(p.slots)]
    return body


def questions(p: P) -> list[Item]:
    """Asked by a turner."""
    return [
        count("radial slots", "How many radial slots does the top of the disc have?", p.slots),
        length("radial slots", "width", "How wide is one of the radial slots?", p.slot_width),
        length("radial slots", "depth", "What depth do the radial slots have, one value?", p.slot_depth),
        length("circular base", "diameter", "What is the diameter of the circular base?", p.base),
        length("circular base", "thickness", "How thick is the round base plate?", p.base_height),
        count("through hole", "How many through holes are there?", p.bolts),
        count("blind hole", "How many blind holes are there?", 1),
        length("blind hole", "diameter", "What's the diameter of the blind hole?", p.bore),
        length("blind hole", "depth", "How deep is the central bore?", p.bore_depth),
        length("hole", "radius", "Radius of the holes that sit on the bolt circle, single value?", p.bolt / 2),
        length("hole", "diameter", "What is the pitch circle diameter of the bolt holes?", p.bolt_circle),
        length("shaft", "diameter", "What is the diameter of the shaft on the bottom?", p.shaft),
        length("cone", "height", "How high is the cone?", p.tip),
        point("shaft", "Where is the tip of the shaft?", (0, 0, -p.shaft_length - p.tip)),
        length("circular protrusion", "height", "What height does the circular protrusion on top have?", p.hub_height),
        length("circular protrusion", "radius", "Which outer radius has the hub?", p.hub / 2),
        size("object", "How big is the whole thing in x, y and z?", (p.base, p.base, p.top + p.shaft_length + p.tip)),
        length("object", "height", "How high is the object without the height of the shaft and its cone?", p.top),
    ]
