"""A gear blank before hobbing: rim, recessed web with lightening holes, hub standing out on one side, keyway and grub screw."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import GeomType, Part, chamfer, fillet

from benchmark.kit import Model
from benchmark.shapes import BACK, block, circle, rod

MODEL = Model("Gear blank", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is z, the rim's lower face z = 0, the hub stands out towards +z."""

    outside: float = 164
    face: float = 30  # width of the rim
    rim: float = 136  # its inside diameter
    bevel: float = 2  # at the rim's outside edges, 45 degrees
    web_low: float = 10  # from the rim's lower face to the web
    web: float = 12  # its thickness
    hub: float = 58
    hub_length: float = 46
    foot: float = 3  # fillet of the hub on the web's upper side
    bore: float = 34
    bore_bevel: float = 1
    key: float = 10  # width of the keyway, towards -x
    key_top: float = 37.3
    holes: int = 6
    hole: float = 24
    hole_circle: float = 98
    dowel: float = 8  # driver hole through the web, between two lightening holes
    dowel_angle: float = 30  # from x
    grub: float = 5  # core hole M6 through the hub, towards +y
    grub_z: float = 38


def build(p: P) -> Part:
    """Turns the blank, then drills and broaches."""
    body = rod(p.outside, p.face)
    body -= rod(p.rim, p.web_low)
    up = p.web_low + p.web
    body -= rod(p.rim, p.face - up, (0, 0, up))
    rims = [e for e in body.edges().filter_by(GeomType.CIRCLE) if abs(e.radius - p.outside / 2) < 1e-3]
    body = chamfer(rims, p.bevel)
    body += rod(p.hub, p.hub_length)
    foot = [
        e
        for e in body.edges().filter_by(GeomType.CIRCLE)
        if abs(e.radius - p.hub / 2) < 1e-3 and abs(e.center().Z - up) < 1e-3
    ]
    body = fillet(foot, p.foot)
    body -= rod(p.bore, p.hub_length)
    edges = [e for e in body.edges().filter_by(GeomType.CIRCLE) if abs(e.radius - p.bore / 2) < 1e-3]
    body = chamfer(edges, p.bore_bevel)
    deep = p.key_top - p.bore / 2
    body -= block((deep, p.key, p.hub_length), (-deep / 2, 0, 0))
    for x, y in circle(p.holes, p.hole_circle):
        body -= rod(p.hole, p.face, (x, y, 0))
    for x, y in circle(1, p.hole_circle, p.dowel_angle):
        body -= rod(p.dowel, p.face, (x, y, 0))
    body -= rod(p.grub, p.hub / 2, (0, 0, p.grub_z), BACK)
    return body
