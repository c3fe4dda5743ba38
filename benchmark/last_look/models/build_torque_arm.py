"""A torque arm of a shaft-mounted gear unit: keyed hub, tapering plate arm with a pocket and a slot, eye at the far end."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Circle, GeomType, Part, Polygon, Pos, RectangleRounded, chamfer, extrude, fillet

from benchmark.kit import Model
from benchmark.shapes import FRONT, block, circle, drill, rod, slot

MODEL = Model("Torque arm", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the hub's axis is z, the plate's underside z = 0, the eye lies towards +x."""

    plate: float = 20  # thickness
    big: float = 100  # diameter of the plate about the hub
    small: float = 56  # diameter of the plate about the eye
    reach: float = 220  # from the hub's axis to the eye's
    hub: float = 84
    height: float = 42  # of the hub over the plate's underside
    fillet: float = 5  # at the hub's foot
    bore: float = 50
    key: float = 14  # width of the keyway, towards +y
    key_top: float = 53.8  # from the keyway's bottom to the far side of the bore
    eye: float = 25
    eye_bevel: float = 1.5  # both sides, 45 degrees
    taps: int = 4
    tap: float = 6.8  # core hole of M8, in the hub's face
    tap_depth: float = 18
    tap_circle: float = 70
    screw: float = 8.5  # core hole of M10, radial onto the keyway
    screw_z: float = 31
    pocket: tuple[float, float] = (80, 44)
    pocket_depth: float = 13
    pocket_corner: float = 6
    pocket_x: float = 97  # of its middle
    slot_length: float = 32
    slot_width: float = 11
    slot_x: float = 163  # of its middle


def build(p: P) -> Part:
    """Cuts the plate, adds the hub, machines everything."""
    big, small = p.big / 2, p.small / 2
    sine = (big - small) / p.reach  # of the sides' slope
    cosine = (1 - sine**2) ** 0.5
    sides = Polygon(
        (big * sine, big * cosine), (big * sine, -big * cosine),
        (p.reach + small * sine, -small * cosine), (p.reach + small * sine, small * cosine), align=None,
    )
    outline = sides + Circle(big) + Pos(p.reach, 0) * Circle(small)
    body = extrude(outline, amount=p.plate)
    body += rod(p.hub, p.height)
    foot = [
        e
        for e in body.edges().filter_by(GeomType.CIRCLE)
        if abs(e.radius - p.hub / 2) < 1e-3 and abs(e.center().Z - p.plate) < 1e-3
    ]
    body = fillet(foot, p.fillet)
    body -= rod(p.bore, p.height)
    top = p.key_top - p.bore / 2
    body -= block((p.key, top, p.height), (0, top / 2, 0))
    body -= rod(p.screw, p.hub / 2, (0, p.hub / 2 + 1, p.screw_z), FRONT)
    for x, y in circle(p.taps, p.tap_circle, 45):
        body -= drill(p.tap, p.tap_depth, (x, y, p.height))
    body -= rod(p.eye, p.plate, (p.reach, 0, 0))
    rims = [e for e in body.edges().filter_by(GeomType.CIRCLE) if abs(e.radius - p.eye / 2) < 1e-3]
    body = chamfer(rims, p.eye_bevel)
    pocket = extrude(RectangleRounded(*p.pocket, p.pocket_corner), amount=p.pocket_depth)
    body -= Pos(p.pocket_x, 0, p.plate - p.pocket_depth) * pocket
    body -= slot(p.slot_length, p.slot_width, p.plate, (p.slot_x, 0, p.plate))
    return body
