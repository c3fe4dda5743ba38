"""A control knob with a pinion: a skirt with scale notches, a conical grip, a dial recess, a shaft with teeth below."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Face, Part, Pos, Wire, extrude

from benchmark.kit import Item, Model, count, length, point, size
from benchmark.shapes import DOWN, UP, block, cone, drill, rod
from build_gear_shaft import GearShaft, tooth_edges

MODEL = Model("Control knob with pinion", "dev")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the skirt's underside is z = 0, the axis z; the shaft points down."""

    skirt: float = 60
    skirt_height: float = 5
    notches: int = 10  # radial slots in the skirt
    notch: tuple[float, float] = (8, 3)  # length from the rim inwards, width
    notch_depth: float = 2
    grip: float = 42  # diameter at the foot of the cone
    grip_top: float = 36
    grip_height: float = 18
    recess: float = 24
    recess_depth: float = 3
    pointer: tuple[float, float, float] = (4, 10, 1.5)  # raised in the recess
    shaft: float = 10
    shaft_length: float = 22  # between skirt and pinion
    module: float = 1
    teeth: int = 18
    pressure_angle: float = 20
    face: float = 8  # width of the pinion
    bore: float = 4.2  # core hole of M5
    bore_depth: float = 14

    @property
    def top(self) -> float:
        """Height of the grip's rim."""
        return self.skirt_height + self.grip_height

    @property
    def bottom(self) -> float:
        """Where on z does the pinion end?"""
        return -self.shaft_length - self.face

    @property
    def tip(self) -> float:
        """Tip diameter of the pinion: one module above the pitch circle all round (ISO 53)."""
        return self.module * (self.teeth + 2)


def build(p: P) -> Part:
    """Turns the knob, mills the notches, adds shaft and pinion."""
    body = rod(p.skirt, p.skirt_height) + cone(p.grip, p.grip_top, p.grip_height, (0, 0, p.skirt_height))
    body -= rod(p.recess, p.recess_depth, (0, 0, p.top), DOWN)
    body += block(p.pointer, (0, 4, p.top - p.recess_depth))
    reach = p.notch[0] + 3  # the cutter runs out beyond the rim
    tool = block(
        (reach, p.notch[1], p.notch_depth),
        (p.skirt / 2 - p.notch[0] + reach / 2, 0, p.skirt_height - p.notch_depth),
    )
    body -= [tool.rotate(Axis.Z, 360 * index / p.notches) for index in range(p.notches)]
    body += rod(p.shaft, p.shaft_length, (0, 0, 0), DOWN)
    teeth = GearShaft(module=p.module, teeth=p.teeth, pressure_angle=p.pressure_angle)
    outline = Wire([edge for index in range(p.teeth) for edge in tooth_edges(teeth, index)])
    body += Pos(0, 0, p.bottom) * extrude(Face(outline), amount=p.face)
    return body - drill(p.bore, p.bore_depth, (0, 0, p.bottom), UP)


def questions(p: P) -> list[Item]:
    """Asked by an instrument maker, an industrial designer, a pupil and a gear cutter."""
    return [
        length("circular base", "diameter", "What is the diameter of the knob's circular base?", p.skirt),
        length("circular base", "height", "And how thick is that round base (the skirt)?", p.skirt_height),
        count("radial slots", "How many radial notches are cut in the rim of the base?", p.notches),
        length("radial slots", "width", "Width of a single radial slot?", p.notch[1]),
        length("radial slots", "depth", "what depth have the radial slots, just one number", p.notch_depth),
        length("cone", "height", "How high is the conical grip?", p.grip_height),
        length("cone", "diameter", "The cone's largest diameter is...?", p.grip),
        length("hole", "diameter", "Diameter of the round recess on top?", p.recess),
        length("hole", "depth", "How far down does the circular recess in the top go?", p.recess_depth),
        length(
            "rectangular protrusion", "height", "Height of the little rectangular protrusion on the top?", p.pointer[2]
        ),
        point(
            "rectangular protrusion",
            "Center position of the rectangular bump that serves as pointer on top?",
            (0, 4, p.top - p.recess_depth + p.pointer[2] / 2),
        ),
        length("shaft", "diameter", "How thick is the shaft between the knob and the gear?", p.shaft),
        length("shaft", "length", "What's the length of the plain shaft section, without the pinion?", p.shaft_length),
        count("gear", "number of teeth of the pinion?", p.teeth),
        length("gear", "diameter", "Tip diameter of the gear on the underside?", p.tip),
        length("gear", "width", "How wide (along teh axis) is the gear?", p.face),
        length("blind hole", "diameter", "What diameter has the hole in the bottom end of the shaft?", p.bore),
        length("blind hole", "depth", "How deep is the blind hole visible from the bottom?", p.bore_depth),
        size(
            "object", "Please state the overall extents of this knob.", (p.skirt, p.skirt, p.top - p.bottom), "extents"
        ),
    ]
