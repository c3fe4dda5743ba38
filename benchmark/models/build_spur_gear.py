"""A spur gear with a hub: involute teeth, bore with keyway, lightening holes, a set-screw's tapped hole."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Face, Part, Wire, extrude

from benchmark.kit import Item, Model, count, length, lengths, points
from benchmark.shapes import block, circle, rod
from build_gear_shaft import GearShaft, tooth_edges

MODEL = Model("Spur gear with hub", "dev")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is z, the gear's underside lies on z = 0, the hub points up."""

    module: float = 2.5
    teeth: int = 26
    pressure_angle: float = 20
    width: float = 20
    hub: float = 34
    hub_height: float = 14
    bore: float = 18
    key_width: float = 6  # DIN 6885 for an 18 mm shaft
    key_top: float = 20.8  # from the far side of the bore
    holes: int = 5
    hole: float = 7
    hole_circle: float = 44

    @property
    def tip(self) -> float:
        """Tip diameter: one module above the pitch circle all round (ISO 53)."""
        return self.module * (self.teeth + 2)


def build(p: P) -> Part:
    """Extrudes the toothed outline, adds the hub, cuts."""
    teeth = GearShaft(module=p.module, teeth=p.teeth, pressure_angle=p.pressure_angle)
    outline = Wire([edge for index in range(p.teeth) for edge in tooth_edges(teeth, index)])
    gear = extrude(Face(outline), amount=p.width)
    gear += rod(p.hub, p.hub_height, (0, 0, p.width))
    total = p.width + p.hub_height
    key = block((p.key_width, p.key_top - p.bore / 2, total), (0, (p.key_top - p.bore / 2) / 2, 0))
    tools = [rod(p.bore, total), key]
    tools += [rod(p.hole, p.width, (x, y, 0)) for x, y in circle(p.holes, p.hole_circle, 54)]
    return gear - tools


def questions(p: P) -> list[Item]:
    """Asked by gear makers and by students."""
    return [
        count("gear", "How many gears does the file contain?", 1),
        count("gear", "How many teeth does the gear have?", p.teeth),
        length("gear", "diameter", "What is the tip diameter (outside diameter) of the gear?", p.tip),
        length("gear", "radius", "outer radius of the gear wheel?", p.tip / 2),
        length("gear", "width", "What is the face width of the gear's teeth along the axis?", p.width),
        length("circular protrusion", "diameter", "What is the diameter of the hub?", p.hub),
        length(
            "circular protrusion",
            "height",
            "How far does the round hub stick out of the gear's top face?",
            p.hub_height,
        ),
        length("hole", "diameter", "Which diameter has the central bore for the shaft?", p.bore),
        length("slot", "width", "What is the width of the keyway in the bore?", p.key_width),
        count("hole", "How many 7 mm lightening holes are there around the hub?", p.holes),
        lengths("hole", "radius", "What radius do the lightening holes have?", [p.hole / 2] * p.holes),
        points(
            "hole",
            "Give me the centre of every 7 mm hole.",
            [(x, y, p.width / 2) for x, y in circle(p.holes, p.hole_circle, 54)],
        ),
        length("object", "height", "Total height of the gear together with its hub?", p.width + p.hub_height),
    ]
