"""An eccentric with its hub, from an American drawing: offset bore with a keyway, set screw hole, lightening holes, rim groove."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Part

from benchmark.kit import INCH, Model
from benchmark.shapes import RIGHT, block, rod

MODEL = Model("Eccentric", "held_out", unit="in")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres, from inches; the bore's axis is z, the disc's underside lies on z = 0, the hub stands on top."""

    disc: float = 3 * INCH
    thickness: float = 0.75 * INCH
    throw: float = 0.375 * INCH  # of the disc's middle towards +x
    hub: float = 1.75 * INCH
    hub_height: float = 0.625 * INCH
    bore: float = 1 * INCH
    key: float = 0.25 * INCH  # width of the keyway, at +y
    key_depth: float = 0.125 * INCH  # beyond the bore
    screw: float = 0.25 * INCH  # set screw hole, from -x
    lightening: float = 0.5 * INCH
    lightening_x: float = 1.3 * INCH
    lightening_y: float = 1 * INCH  # between the two
    groove: float = 0.125 * INCH
    groove_depth: float = 0.0625 * INCH

    @property
    def height(self) -> float:
        """Disc and hub."""
        return self.thickness + self.hub_height


def build(p: P) -> Part:
    """Turns disc and hub, then bores, broaches and drills."""
    body = rod(p.disc, p.thickness, (p.throw, 0, 0)) + rod(p.hub, p.height)
    low = (p.throw, 0, (p.thickness - p.groove) / 2)
    body -= rod(p.disc, p.groove, low) - rod(p.disc - 2 * p.groove_depth, p.groove, low)
    body -= rod(p.bore, p.height)
    reach = p.bore / 2 + p.key_depth
    body -= block((p.key, reach, p.height), (0, reach / 2, 0))
    body -= rod(p.screw, p.hub / 2, (-p.hub / 2, 0, p.thickness + p.hub_height / 2), RIGHT)
    return body - [rod(p.lightening, p.thickness, (p.lightening_x, s * p.lightening_y / 2, 0)) for s in (-1, 1)]
