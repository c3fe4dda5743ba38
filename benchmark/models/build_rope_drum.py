"""A rope drum of a winch: drum between two flanges, a spur gear, two journals, a keyway and a tapered end."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Face, Part, Plane, Wire, extrude

from benchmark.kit import Item, Model, count, length, lengths, point
from benchmark.shapes import RIGHT, cone, drill, rod, slot
from build_gear_shaft import GearShaft, tooth_edges

MODEL = Model("Rope drum with gear", "dev")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres and degrees; the axis is x, the left journal's end lies on x = 0."""

    journal: float = 25
    left: float = 30  # length of the left journal
    module: float = 3
    teeth: int = 30
    pressure_angle: float = 20
    face: float = 24  # width of the gear
    flange: float = 112
    flange_width: float = 8
    drum: float = 72
    drum_length: float = 100
    right: float = 42  # length of the right journal
    taper: tuple[float, float, float] = (20, 14, 18)  # both diameters, length
    key: tuple[float, float, float] = (28, 8, 4)  # length, width, depth from the top of the journal (DIN 6885)
    screw: float = 6.8  # core hole of M8
    screw_depth: float = 20
    rope: float = 9  # holes for the rope's clamp, in the right flange
    ropes: int = 2
    rope_x: float = 46  # from the axis, before and behind it

    @property
    def tip(self) -> float:
        """Tip diameter of the gear: one module above the pitch circle all round (ISO 53)."""
        return self.module * (self.teeth + 2)

    def steps(self) -> tuple[float, float, float, float, float]:
        """Where on x do gear, left flange, drum, right flange and right journal begin?"""
        flange = self.left + self.face
        drum = flange + self.flange_width
        right = drum + self.drum_length
        return self.left, flange, drum, right, right + self.flange_width


def build(p: P) -> Part:
    """Turns the contour from left to right, puts the gear on, mills, drills."""
    gear, left, drum, right, end = p.steps()
    outline = GearShaft(module=p.module, teeth=p.teeth, pressure_angle=p.pressure_angle)
    teeth = Wire([edge for index in range(p.teeth) for edge in tooth_edges(outline, index)])
    body = extrude(Plane(origin=(gear, 0, 0), x_dir=(0, 1, 0), z_dir=RIGHT) * Face(teeth), amount=p.face)
    body += rod(p.journal, p.left, (0, 0, 0), RIGHT)
    body += [rod(p.flange, p.flange_width, (x, 0, 0), RIGHT) for x in (left, right)]
    body += rod(p.drum, p.drum_length, (drum, 0, 0), RIGHT)
    body += rod(p.journal, p.right, (end, 0, 0), RIGHT)
    body += cone(*p.taper, (end + p.right, 0, 0), RIGHT)
    length, width, depth = p.key
    body -= slot(length, width, depth, (end + p.right / 2, 0, p.journal / 2))
    body -= drill(p.screw, p.screw_depth, (0, 0, 0), RIGHT)
    return body - [rod(p.rope, p.flange_width, (right, y, 0), RIGHT) for y in (-p.rope_x, p.rope_x)]


def questions(p: P) -> list[Item]:
    """Asked in the plain way, and by a winch's repairer, a gear cutter and a student."""
    gear, _, _, _, end = p.steps()
    total = end + p.right + p.taper[2]
    return [
        length("gear", "diameter", "What is the outer diameter of the gear?", p.tip),
        length("shaft", "diameter", "What is the diameter of the shaft visible from the left?", p.journal),
        length("slot", "width", "What is the width of the slot visible from the top?", p.key[1]),
        length("slot", "depth", "How deep is the slot on the top?", p.key[2]),
        length("cone", "height", "What is the height of the cone on the right?", p.taper[2]),
        length("threaded hole", "diameter", "What is the diameter of the threaded hole on the left?", p.screw),
        count("through hole", "How many through holes does the object have?", p.ropes),
        length("object", "width", "How wide is the object in total?", total),
        count("gear", "number of teeth?", p.teeth),
        length("gear", "width", "Face width of the gear, in mm", p.face),
        lengths("flange", "diameter", "What diameter do the two flanges of the drum have?", [p.flange] * 2),
        length("flange", "distance", "How much room for rope is there between the two flanges?", p.drum_length),
        length(
            "blind hole",
            "depth",
            "Drilling depth of the centre hole in the left shaft end, not counting the tip?",
            p.screw_depth,
        ),
        point("gear", "Hi! Where's the centre of the gear located?", (gear + p.face / 2, 0, 0)),
    ]
