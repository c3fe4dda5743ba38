"""A Geneva wheel: disc with radial slots and locking arcs, lightening holes, a hub with keyway and set screw."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, pi

from build123d import Axis, Part, chamfer

from benchmark.kit import Item, Model, count, length, lengths, points
from benchmark.shapes import FRONT, block, circle, rod

MODEL = Model("Geneva wheel", "dev")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is z, the disc's underside lies on z = 0, the hub points up, the first slot to x."""

    disc: float = 120
    thickness: float = 10
    slots: int = 6
    slot: float = 8.1  # for the driver's pin of 8 mm
    slot_end: float = 28  # from the axis to the end of a slot
    arc: float = 22  # radius of the locking arcs
    hole: float = 9
    hole_circle: float = 66
    hub: float = 36
    hub_height: float = 14
    bevel: float = 1  # at 45 degrees on the hub's edge
    bore: float = 16
    key_width: float = 5  # DIN 6885 for a 16 mm shaft
    key_top: float = 18.3  # from the far side of the bore
    screw: float = 4.2  # core hole of M5
    screw_height: float = 17

    @property
    def centers(self) -> float:
        """Distance of the two axes: the driver's pin enters the slots along their middle."""
        return self.disc / 2 / cos(pi / self.slots)


def build(p: P) -> Part:
    """Turns disc and hub, mills slots and arcs, bores, slots the bore."""
    total = p.thickness + p.hub_height
    hub = rod(p.hub, total)
    body = rod(p.disc, p.thickness) + chamfer(hub.faces().sort_by(Axis.Z)[-1].edges(), p.bevel)
    foot = p.slot_end + p.slot / 2
    reach = p.disc / 2 - foot + 5  # the cutter runs out beyond the rim
    slot = block((reach, p.slot, p.thickness), (foot + reach / 2, 0, 0)) + rod(p.slot, p.thickness, (foot, 0, 0))
    step = 360 / p.slots
    body -= [slot.rotate(Axis.Z, index * step) for index in range(p.slots)]
    body -= [rod(2 * p.arc, p.thickness, (x, y, 0)) for x, y in circle(p.slots, 2 * p.centers, step / 2)]
    body -= [rod(p.hole, p.thickness, (x, y, 0)) for x, y in circle(p.slots, p.hole_circle, step / 2)]
    key = p.key_top - p.bore / 2
    body -= [rod(p.bore, total), block((p.key_width, key, total), (0, key / 2, 0))]
    return body - rod(p.screw, p.hub / 2, (0, 0, p.screw_height), FRONT)


def questions(p: P) -> list[Item]:
    """Asked in the plain way, and by a watchmaker, a student of mechanisms and a turner."""
    return [
        count("radial slots", "How many radial slots are visible from the top?", p.slots),
        lengths("radial slots", "width", "What is the width of the radial slots?", [p.slot] * p.slots),
        length("circular base", "diameter", "What is the diameter of the circular base?", p.disc),
        length("circular base", "thickness", "What is the thickness of the circular base?", p.thickness),
        length(
            "circular protrusion", "height", "What is the height of the circular protrusion on the top?", p.hub_height
        ),
        count("through hole", "How many through holes have a diameter of 9 mm?", p.slots),
        points(
            "hole",
            "What are the centers of the holes with a diameter of 9 mm?",
            [(x, y, p.thickness / 2) for x, y in circle(p.slots, p.hole_circle, 180 / p.slots)],
        ),
        length("hole", "diameter", "dia of the hub bore?", p.bore),
        length("slot", "width", "And how wide is the keyway in the bore, please?", p.key_width),
        count("semicircle", "around the rim there are those concave arcs between the slots, how many?", p.slots),
        lengths(
            "semicircle",
            "radius",
            "Which radius have the concave locking arcs on the circumference?",
            [p.arc] * p.slots,
        ),
        length(
            "threaded hole",
            "diameter",
            "Diameter of the tapped hole for the grub screw that goes sideways into the hub?",
            p.screw,
        ),
        length(
            "threaded hole",
            "distance",
            "How far above the underside of the disc is the axis of the set screw hole in the hub?",
            p.screw_height,
        ),
        length("bevel", "height", "what's the height of the bevel at the top edge of the hub", p.bevel),
    ]
