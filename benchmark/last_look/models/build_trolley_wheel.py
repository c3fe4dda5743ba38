"""A moulded trolley wheel: rim with rounded tread edges, thin web, ribs on both sides, hub with two bearing pockets."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import GeomType, Part, Rot, fillet

from benchmark.kit import Model
from benchmark.shapes import block, circle, rod

MODEL = Model("Trolley wheel", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is z, the middle plane z = 0."""

    outside: float = 125
    tread: float = 32  # width of the rim
    round: float = 4  # radius of the tread's edges
    rim: float = 7  # wall of the rim
    hub: float = 44
    hub_length: float = 40
    web: float = 4.5  # thickness
    ribs: int = 8  # on each side
    rib: float = 3.5  # thickness
    rib_back: float = 3  # the ribs lie that far below the rim's edge
    bearing: float = 32  # pockets from both ends
    bearing_depth: float = 10
    bore: float = 22  # between the pockets
    holes: int = 4
    hole: float = 12  # through the web
    hole_circle: float = 78


def build(p: P) -> Part:
    """Rim, web, hub and ribs; then the pockets and holes."""
    body = rod(p.outside, p.tread, (0, 0, -p.tread / 2))
    body = fillet([e for e in body.edges() if e.geom_type == GeomType.CIRCLE], p.round)
    body -= rod(p.outside - 2 * p.rim, p.tread, (0, 0, -p.tread / 2))
    body += rod(p.outside - p.rim, p.web, (0, 0, -p.web / 2))
    body += rod(p.hub, p.hub_length, (0, 0, -p.hub_length / 2))
    high = p.tread - 2 * p.rib_back
    start, end = p.hub / 2 - 1, p.outside / 2 - p.rim + 1
    for i in range(p.ribs):
        rib = block((end - start, p.rib, high), ((start + end) / 2, 0, -high / 2))
        body += Rot(0, 0, 360 / p.ribs * i) * rib
    for s in (-1, 1):
        z = -p.hub_length / 2 if s < 0 else p.hub_length / 2 - p.bearing_depth
        body -= rod(p.bearing, p.bearing_depth, (0, 0, z))
    body -= rod(p.bore, p.hub_length, (0, 0, -p.hub_length / 2))
    for x, y in circle(p.holes, p.hole_circle, 180 / p.ribs):
        body -= rod(p.hole, p.web, (x, y, -p.web / 2))
    return body
