"""A gripper's finger in an oblique position: foot with countersunk holes, upright with slot, nut hole and notch."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, Pos, Rot, chamfer

from benchmark.kit import Item, Model, Triple, count, length, lengths, point
from benchmark.shapes import BACK, FRONT, block, cone, prism, rod, slot

MODEL = Model("Gripper finger in an oblique position", "dev")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres and degrees; not yet turned, the foot lies on z = 0 behind the upright, which grips to the front."""

    width: float = 40
    foot: tuple[float, float] = (44, 12)  # from the gripping face to its end; thickness
    upright: tuple[float, float] = (15, 96)  # thickness, height above the foot's underside
    screw_hole: float = 5.5
    countersink: float = 10.5
    screw_span: float = 24
    screw_y: float = 32
    dowel: float = 4
    dowel_y: float = 23
    flats: float = 8  # of the nut hole (ISO 4032, M5)
    nut_depth: float = 4.5
    nut_bore: float = 5.2
    nut_z: float = 24
    slot: tuple[float, float] = (26, 6.4)  # length over all, width
    slot_z: float = 50
    pocket: tuple[float, float, float] = (30, 2, 12)
    pocket_z: float = 68
    notch: float = 7  # radius
    bevel: float = 6  # at 45 degrees
    turn: Triple = (24, -31, 40)  # about x, y and z, each about the turned axes

    def turned(self, at: Triple) -> Triple:
        """Where does a point go?"""
        place = (Rot(*self.turn) * Pos(*at)).position
        return (place.X, place.Y, place.Z)


def build(p: P) -> Part:
    """Mills the angle from the solid, bevels its upper corners, drills, turns into place."""
    thick, height = p.upright
    reach, foot = p.foot
    body = block((p.width, thick, height), (0, thick / 2, 0)) + block((p.width, reach, foot), (0, reach / 2, 0))
    tips = [e for e in body.edges().filter_by(Axis.Y) if abs(e.center().Z - height) < 1e-6]
    body = chamfer(tips, p.bevel)
    sink = (p.countersink - p.screw_hole) / 2  # 90 degrees
    for x in (-p.screw_span / 2, p.screw_span / 2):
        body -= rod(p.screw_hole, foot, (x, p.screw_y, 0))
        body -= cone(p.screw_hole, p.countersink, sink, (x, p.screw_y, foot - sink))
    body -= rod(p.dowel, foot, (0, p.dowel_y, 0))
    body -= rod(p.nut_bore, thick, (0, 0, p.nut_z), BACK) + prism(p.flats, p.nut_depth, (0, thick, p.nut_z), FRONT)
    body -= slot(*p.slot, thick, (0, 0, p.slot_z), BACK, rotation=90)
    body -= block(p.pocket, (0, p.pocket[1] / 2, p.pocket_z))
    return Rot(*p.turn) * (body - rod(2 * p.notch, thick, (0, 0, height), BACK))


def questions(p: P) -> list[Item]:
    """Asked in the plain way, and by a robot programmer, a toolmaker and a trainee."""
    return [
        count("hole", "Number of round holes with a diameter greater than 5 mm?", 3),
        lengths(
            "hole with bevel", "diameter", "State the diameters of the holes that have a bevel.", [p.screw_hole] * 2
        ),
        length("nut hole", "width", "Width across the flats of the hexagonal nut hole?", p.flats),
        length("nut hole", "depth", "Determine the depth of the hexagonal pocket for the nut.", p.nut_depth),
        length("semicircle", "radius", "Radius of the semicircular cutout at the tip?", p.notch),
        length("slot", "width", "Give me the width of the obround slot.", p.slot[1]),
        length("slot", "length", "How long is the slot over all?", p.slot[0]),
        length(
            "rectangular indentation",
            "depth",
            "By how much is the rectangular indentation sunk into the gripping face?",
            p.pocket[1],
        ),
        length("hole", "diameter", "What diameter has the smallest hole of the object?", p.dowel),
        point("hole", "Give the center of the hole with a diameter of 4 mm.", p.turned((0, p.dowel_y, p.foot[1] / 2))),
        length("hole with bevel", "distance", "the two countersunk screw holes, centre to centre?", p.screw_span),
        length("slot", "depth", "How thick is the material that the long slot goes through?", p.upright[0]),
        length(
            "rectangular indentation",
            "length",
            "A rubber strip gets glued into the shallow rectangular pocket. How long may it be at most?",
            p.pocket[0],
        ),
        length(
            "hole",
            "depth",
            "How long a 4 mm dowel pin do I need if it shall end flush on both sides of the foot?",
            p.foot[1],
        ),
    ]
