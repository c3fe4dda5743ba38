"""A turned hose adapter drawn in inches: a screw-in stub with a relief, a hexagon, three barbs, a stepped bore, a port."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Part

from benchmark.kit import INCH, Model
from benchmark.shapes import BACK, cone, prism, rod

MODEL = Model("Hose adapter", "held_out", unit="in")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres, from inches; the stub's end lies on z = 0, the axis is z, the barbs point up."""

    stub: float = 0.84 * INCH
    stub_length: float = 0.8 * INCH  # up to the hexagon, with the relief
    relief: float = 0.7 * INCH
    relief_width: float = 0.125 * INCH
    bevel: float = 0.05 * INCH
    flats: float = 1.125 * INCH
    hex_height: float = 0.45 * INCH
    neck: float = 0.56 * INCH
    neck_length: float = 0.2 * INCH
    barb: float = 0.68 * INCH
    barb_tip: float = 0.56 * INCH
    barb_length: float = 0.3 * INCH
    barbs: int = 3
    bore: float = 0.375 * INCH
    wide: float = 0.5 * INCH
    wide_depth: float = 0.65 * INCH
    port: float = 0.125 * INCH

    @property
    def length(self) -> float:
        """Over all."""
        return self.stub_length + self.hex_height + self.neck_length + self.barbs * self.barb_length

    @property
    def port_z(self) -> float:
        """Middle of the hexagon."""
        return self.stub_length + self.hex_height / 2


def build(p: P) -> Part:
    """Turned from below."""
    body = cone(p.stub - 2 * p.bevel, p.stub, p.bevel)
    body += rod(p.stub, p.stub_length - p.relief_width - p.bevel, (0, 0, p.bevel))
    body += rod(p.relief, p.relief_width, (0, 0, p.stub_length - p.relief_width))
    body += prism(p.flats, p.hex_height, (0, 0, p.stub_length))
    z = p.stub_length + p.hex_height
    body += rod(p.neck, p.neck_length, (0, 0, z))
    z += p.neck_length
    for n in range(p.barbs):
        body += cone(p.barb, p.barb_tip, p.barb_length, (0, 0, z + n * p.barb_length))
    body -= rod(p.bore, p.length)
    body -= rod(p.wide, p.wide_depth)
    return body - rod(p.port, p.flats / 2, (0, -p.flats / 2, p.port_z), BACK)
