"""A bottle closure with a tamper band: ribbed drafted skirt, plug seal, retaining bead, bridges, catches."""

from __future__ import annotations

import math
from dataclasses import dataclass

from build123d import Axis, Part, Rot, fillet

from benchmark.kit import Model
from benchmark.shapes import block, cone, rod

MODEL = Model("Screw cap", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; axis z, the open end at z = 0, the closed top up."""

    height: float = 23
    band: float = 41  # outside of the tamper band
    band_height: float = 4.2
    gap: float = 0.9  # between band and skirt
    bridges: int = 12
    bridge: float = 1.3  # width
    skirt: float = 41  # outside at its lower end, without the ribs
    draft: float = 1.5  # degrees, narrower to the top
    bore: float = 37  # inside, skirt and band
    top: float = 1.8  # wall
    edge: float = 1.2  # radius at the top
    ribs: int = 40
    rib: tuple[float, float] = (1.1, 0.7)  # width, and height over the skirt
    rib_height: float = 14  # from the skirt's lower end
    plug: float = 30  # outside of the seal ring under the top
    plug_wall: float = 1.4
    plug_length: float = 5
    bead: float = 34.6  # inner diameter of the retaining bead
    bead_height: float = 1.6
    bead_z: float = 9  # its lower side
    catches: int = 8
    catch: tuple[float, float, float] = (1.2, 3, 2)  # inwards, width, height, from z = 0


def build(p: P) -> Part:
    """Moulds it."""
    low = p.band_height + p.gap
    up = p.height - low
    slope = math.tan(math.radians(p.draft))
    skirt = cone(p.skirt, p.skirt - 2 * up * slope, up, (0, 0, low))
    skirt = fillet(skirt.edges().group_by(Axis.Z)[-1], p.edge)
    skirt -= rod(p.bore, up - p.top, (0, 0, low))
    tall = p.rib_height
    out = p.skirt + 2 * p.rib[1]
    wrap = cone(out, out - 2 * tall * slope, tall, (0, 0, low)) - rod(p.bore + 1, tall, (0, 0, low))
    bars = [
        Rot(0, 0, 360 * i / p.ribs) * block((out, p.rib[0], tall), (out / 2, 0, low)) for i in range(p.ribs)
    ]
    comb = Part() + bars
    body = skirt + (wrap & comb)
    body += rod(p.bead + 8, p.bead_height, (0, 0, p.bead_z)) & rod(p.bore + 1, p.height) - rod(p.bead, p.height)
    ceiling = p.height - p.top
    body += rod(p.plug, p.plug_length, (0, 0, ceiling - p.plug_length)) - rod(
        p.plug - 2 * p.plug_wall, p.plug_length, (0, 0, ceiling - p.plug_length)
    )
    band = rod(p.band, p.band_height) - rod(p.bore, p.band_height)
    ring = rod(p.band, low + 0.2) - rod(p.bore, low + 0.2)
    stays = [
        Rot(0, 0, 360 * (i + 0.5) / p.bridges) * block((p.band, p.bridge, p.gap), (p.band / 2, 0, p.band_height))
        for i in range(p.bridges)
    ]
    body += band
    body += ring & (Part() + stays)
    inner = p.bore / 2 - p.catch[0]
    keep = rod(p.bore + 1, p.catch[2]) - rod(2 * inner, p.catch[2])
    wide = [
        Rot(0, 0, 360 * i / p.catches) * block((p.bore / 2, p.catch[1], p.catch[2]), (p.bore / 4 + 0.4, 0, 0))
        for i in range(p.catches)
    ]
    body += keep & (Part() + wide)
    return body
