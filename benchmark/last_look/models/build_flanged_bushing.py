"""A flanged bushing with an oil groove: flange with a flat and countersunk screws, lead-in, outside seal groove, oil hole."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import GeomType, Part, chamfer

from benchmark.kit import Model
from benchmark.shapes import LEFT, block, circle, cone, rod

MODEL = Model("Flanged bushing", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is z, the flange's upper face z = 0, the sleeve points towards -z."""

    sleeve: float = 42
    bore: float = 28
    length: float = 52  # over all
    flange: float = 72
    thick: float = 9  # of the flange
    flat: float = 29  # from the axis to the flat on the flange, towards +y
    lead: float = 2  # bevel at the sleeve's lower outside edge, 45 degrees
    bore_bevel: float = 1  # both ends, 45 degrees
    screws: int = 4
    screw: float = 5.5
    screw_circle: float = 56
    sink: float = 10.4  # countersinks' mouth, 90 degrees, in the upper face
    seal: float = 3.2  # width of the seal groove on the sleeve
    seal_bottom: float = 37.6
    seal_z: float = -38  # of its middle
    oil: float = 4  # width of the ring groove in the bore
    oil_bottom: float = 31  # its diameter
    oil_z: float = -24  # of its middle
    feed: float = 3.5  # hole from outside into the ring groove, on the side x < 0
    jack: float = 5  # core hole M6 through the flange, on the side y < 0


def build(p: P) -> Part:
    """Turns the outside, then the bore, then drills."""
    body = rod(p.flange, p.thick, (0, 0, -p.thick))
    body -= block((p.flange, p.flange, p.thick), (0, p.flat + p.flange / 2, -p.thick))
    body += rod(p.sleeve, p.length, (0, 0, -p.length))
    low = [e for e in body.edges().filter_by(GeomType.CIRCLE) if abs(e.center().Z + p.length) < 1e-3]
    body = chamfer(low, p.lead)
    body -= rod(p.bore, p.length, (0, 0, -p.length))
    rims = [e for e in body.edges().filter_by(GeomType.CIRCLE) if abs(e.radius - p.bore / 2) < 1e-3]
    body = chamfer(rims, p.bore_bevel)
    base = (0, 0, p.seal_z - p.seal / 2)
    body -= rod(p.sleeve + 2, p.seal, base) - rod(p.seal_bottom, p.seal, base)
    body -= rod(p.oil_bottom, p.oil, (0, 0, p.oil_z - p.oil / 2))
    body -= rod(p.feed, p.sleeve, (0, 0, p.oil_z), LEFT)
    for x, y in circle(p.screws, p.screw_circle, 45):
        body -= rod(p.screw, p.thick, (x, y, -p.thick))
        body -= cone(p.sink, 0, p.sink / 2, (x, y, 0), (0, 0, -1))
    body -= rod(p.jack, p.thick, (0, -p.screw_circle / 2, -p.thick))
    return body
