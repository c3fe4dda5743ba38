"""A planet carrier: slotted disc with three pins, a collar with bore above, a cone, a shaft and a pinion below."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Face, Part, Pos, Wire, extrude

from benchmark.kit import Form, Item, Model, count, length, lengths, points, size
from benchmark.shapes import DOWN, UP, block, circle, cone, drill, rod
from build_gear_shaft import GearShaft, tooth_edges

MODEL = Model("Planet carrier with pinion", "held_out", Form.BSPLINE)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is z, the disc's underside z = 0, the shaft points down."""

    disc: float = 104
    thickness: float = 12
    pins: int = 3
    pin: float = 14
    pin_height: float = 22
    pin_circle: float = 64
    tap: float = 5  # core hole of M6
    tap_depth: float = 13
    holes: int = 3
    hole: float = 11
    slots: int = 6
    slot: tuple[float, float] = (9, 5)  # length from the rim inwards, width; right through
    slots_start: float = 15  # degrees from x
    collar: float = 32
    collar_height: float = 4
    seat: float = 19
    seat_depth: float = 9  # from the collar's rim
    foot: float = 46  # diameter of the cone under the disc
    cone_height: float = 10
    shaft: float = 24
    shaft_length: float = 30  # between cone and pinion
    module: float = 1.5
    teeth: int = 20
    pressure_angle: float = 20
    face: float = 14  # width of the pinion
    bore: float = 10.2  # core hole of M12
    bore_depth: float = 24

    @property
    def bottom(self) -> float:
        """Where on z does the pinion end?"""
        return -self.cone_height - self.shaft_length - self.face

    @property
    def tip(self) -> float:
        """Tip diameter of the pinion: one module above the pitch circle all round (ISO 53)."""
        return self.module * (self.teeth + 2)


def build(p: P) -> Part:
    """Turns disc, collar and shaft, sets the pins, mills the slots, cuts the teeth."""
    top = p.thickness + p.collar_height
    body = rod(p.disc, p.thickness) + rod(p.collar, top)
    body += [rod(p.pin, p.pin_height, (x, y, p.thickness)) for x, y in circle(p.pins, p.pin_circle, 90)]
    body += cone(p.foot, p.shaft, p.cone_height, (0, 0, 0), DOWN)
    body += rod(p.shaft, p.shaft_length + p.cone_height, (0, 0, 0), DOWN)
    teeth = GearShaft(module=p.module, teeth=p.teeth, pressure_angle=p.pressure_angle)
    outline = Wire([edge for index in range(p.teeth) for edge in tooth_edges(teeth, index)])
    body += Pos(0, 0, p.bottom) * extrude(Face(outline), amount=p.face)
    body -= rod(p.seat, p.seat_depth, (0, 0, top), DOWN)
    body -= [drill(p.tap, p.tap_depth, (x, y, p.thickness + p.pin_height)) for x, y in circle(p.pins, p.pin_circle, 90)]
    body -= [rod(p.hole, p.thickness, (x, y, 0)) for x, y in circle(p.holes, p.pin_circle, 30)]
    reach = p.slot[0] + 4  # the cutter runs out beyond the rim
    tool = block((reach, p.slot[1], p.thickness), (p.disc / 2 - p.slot[0] + reach / 2, 0, 0))
    body -= [tool.rotate(Axis.Z, p.slots_start + 360 * index / p.slots) for index in range(p.slots)]
    return body - drill(p.bore, p.bore_depth, (0, 0, p.bottom), UP)


def questions(p: P) -> list[Item]:
    """Asked by a gear designer, a machinist, a robot programmer and a student."""
    return [
        length("circular base", "diameter", "carrier disc OD", p.disc),
        length("circular base", "thickness", "how thick is this disc without pins and collar?", p.thickness),
        count("rod", "The planets run on pins. How many of them stand on the disc?", p.pins),
        lengths("rod", "radius", "radius of the planet pins on the upper side", [p.pin / 2] * p.pins),
        lengths("rod", "height", "How far do the pins protrude from the top of the disc?", [p.pin_height] * p.pins),
        points(
            "threaded hole",
            "A robot drives a screw into each pin from above. At which coordinates are the centres of the tapped holes "
            "in the pins?",
            [(x, y, p.thickness + p.pin_height - p.tap_depth / 2) for x, y in circle(p.pins, p.pin_circle, 90)],
        ),
        lengths("through hole", "diameter", "thru holes in the disc, dia", [p.hole] * p.holes),
        length("through hole", "diameter", "On what pitch circle dia. do the three through holes lie?", p.pin_circle),
        count("blind hole", "How many blind holes can be seen from the top?", p.pins + 1),
        count("radial slots", "How many radial slots are milled into the edge of the disc?", p.slots),
        lengths("radial slots", "width", "width of every one of the radial slots", [p.slot[1]] * p.slots),
        length("hole with ring", "diameter", "top side, middle: diameter of the hole with the ring around it", p.seat),
        length(
            "hole with ring",
            "depth",
            "The bearing sits in the middle of the collar, in a blind hole. How deep is it from the collar's rim?",
            p.seat_depth,
        ),
        length("cone", "height", "height of teh cone between disc and shaft", p.cone_height),
        count("gear", "pinion at the lower end: no. of teeth?", p.teeth),
        length("gear", "diameter", "What is the outside (tip) diameter of the gear?", p.tip),
        size(
            "object",
            "bounding box of the complete part",
            (p.disc, p.disc, p.thickness + p.pin_height - p.bottom),
            "extents",
        ),
    ]
