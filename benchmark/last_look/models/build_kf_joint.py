"""A KF25 vacuum joint without its clamp: hose nozzle, centring ring, O-ring, blank flange with two feedthrough holes."""

from __future__ import annotations

import math
from dataclasses import dataclass

from build123d import Compound, Part, Plane, Torus

from benchmark.kit import Model
from benchmark.shapes import LEFT, RIGHT, Vector, assembly, cone, named, rod

MODEL = Model("KF joint", "held_out", bodies=4)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is x, the plane between the two flanges is x = 0, the nozzle points to -x."""

    flange: float = 40  # outside, of both
    rim: float = 3  # width of the cylindrical rim
    taper: float = 15  # degrees between the conical back and the flange's face
    gap: float = 3.9  # between the flanges' faces
    recess: float = 26.2  # in both faces
    recess_depth: float = 3
    hub: float = 28  # of the nozzle, behind the cone
    hub_length: float = 16  # from the nozzle's face to the hub's end
    hub_bore: float = 24
    hub_bore_depth: float = 12  # from the nozzle's face
    stem: float = 12
    stem_bore: float = 9
    nozzle: float = 48  # from the nozzle's face to its tip
    barb: float = 14.5  # large diameter
    barb_small: float = 11.6
    barb_length: float = 7
    barbs: int = 3
    blank: float = 7  # thickness of the blank flange over all
    blank_hub: float = 30  # diameter of its back
    pin: float = 3.2  # feedthrough holes in the blank
    pins: float = 10  # between the two, along y
    ring: float = 26  # outside of the centring ring's sleeve
    ring_bore: float = 22
    ring_length: float = 8
    collar: float = 28  # outside of its collar
    collar_width: float = 3.5
    cord: float = 3.9  # of the O-ring


def build(p: P) -> Compound:
    """Turns every body about x."""
    face = p.gap / 2
    nozzle = _flange(p, p.hub, p.hub_length, (-face, 0, 0), LEFT)
    bare = p.nozzle - p.barbs * p.barb_length - p.hub_length
    nozzle += rod(p.stem, bare, (-face - p.hub_length, 0, 0), LEFT)
    for index in range(p.barbs):
        start = -face - p.nozzle + (p.barbs - index) * p.barb_length
        nozzle += cone(p.barb, p.barb_small, p.barb_length, (start, 0, 0), LEFT)
    nozzle -= rod(p.hub_bore, p.hub_bore_depth, (-face, 0, 0), LEFT)
    nozzle -= rod(p.stem_bore, p.nozzle, (-face, 0, 0), LEFT)

    blank = _flange(p, p.blank_hub, p.blank, (face, 0, 0), RIGHT)
    for y in (-p.pins / 2, p.pins / 2):
        blank -= rod(p.pin, p.blank, (face, y, 0), RIGHT)

    ring = rod(p.ring, p.ring_length, (-p.ring_length / 2, 0, 0), RIGHT)
    ring += rod(p.collar, p.collar_width, (-p.collar_width / 2, 0, 0), RIGHT)
    ring -= rod(p.ring_bore, p.ring_length, (-p.ring_length / 2, 0, 0), RIGHT)
    seal = Plane.YZ * Torus((p.collar + p.cord) / 2, p.cord / 2)
    return assembly(
        [
            named(nozzle, "Hose nozzle", "silver"),
            named(ring, "Centring ring", "lightgray"),
            named(seal, "O-ring", "black"),
            named(blank, "Blank flange", "silver"),
        ]
    )


def _flange(p: P, hub: float, length: float, face: Vector, along: Vector) -> Part:
    def at(distance: float) -> Vector:
        return (face[0] + along[0] * distance, 0, 0)

    fall = (p.flange - hub) / 2 * math.tan(math.radians(p.taper))
    body = rod(p.flange, p.rim, face, along) + cone(p.flange, hub, fall, at(p.rim), along)
    body += rod(hub, length - p.rim - fall, at(p.rim + fall), along)
    return body - rod(p.recess, p.recess_depth, face, along)
