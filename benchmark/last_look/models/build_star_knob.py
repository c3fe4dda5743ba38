"""A printed star knob: seven finger scallops, hub below, nut trap and cap recess on top, pointer dot."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, GeomType, Part, chamfer, fillet

from benchmark.kit import Model
from benchmark.shapes import circle, prism, rod

MODEL = Model("Star knob", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is z, the hub's underside z = 0, the dot lies towards +x."""

    diameter: float = 54
    grip: float = 15  # height of the star
    hub: float = 22
    hub_height: float = 9  # below the star
    hub_bevel: float = 1  # lower rim, 45 degrees
    scallops: int = 7
    scallop: float = 8  # radius
    scallop_circle: float = 60  # diameter on which their axes lie
    round: float = 2  # upper and lower outer edges of the star
    bolt: float = 8.4
    flats: float = 13.3  # of the nut trap
    trap_depth: float = 6.8  # below the cap recess
    cap: float = 26
    cap_depth: float = 2
    dot: float = 3
    dot_depth: float = 1
    dot_circle: float = 42
    pins: int = 2  # blind holes in the star's underside
    pin: float = 4
    pin_depth: float = 6
    pin_span: float = 34  # between them, along y


def build(p: P) -> Part:
    """Cuts the star, rounds it, adds the hub, sinks trap and recess."""
    top = p.hub_height + p.grip
    body = rod(p.diameter, p.grip, (0, 0, p.hub_height))
    for x, y in circle(p.scallops, p.scallop_circle, 180 / p.scallops):
        body -= rod(2 * p.scallop, p.grip, (x, y, p.hub_height))
    rims = [e for e in body.edges() if e.geom_type == GeomType.CIRCLE and e.bounding_box().size.Z < 1e-6]
    body = fillet(rims, p.round)
    foot = rod(p.hub, p.hub_height)
    foot = chamfer(foot.edges().group_by(Axis.Z)[0], p.hub_bevel)
    body += foot
    body -= rod(p.bolt, top)
    body -= rod(p.cap, p.cap_depth, (0, 0, top - p.cap_depth))
    body -= prism(p.flats, p.trap_depth, (0, 0, top - p.cap_depth - p.trap_depth))
    body -= rod(p.dot, p.dot_depth, (p.dot_circle / 2, 0, top - p.dot_depth))
    for side in (-1, 1):
        body -= rod(p.pin, p.pin_depth, (0, side * p.pin_span / 2, p.hub_height))
    return body
