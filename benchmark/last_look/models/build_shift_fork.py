"""A selector fork of a gearbox: hub on the rail, web, half ring with two pads, dog with gate slot."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Circle, Part, Pos, extrude, make_hull

from benchmark.kit import Model
from benchmark.shapes import BACK, block, rod

MODEL = Model("Shift fork", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the rail's axis is z at x = y = 0, the sleeve's axis is parallel to it at +x, the web is centred on z = 0."""

    rail: float = 16  # bore of the hub
    hub: float = 30  # outer diameter
    hub_up: float = 30  # hub above the web's middle plane
    hub_down: float = 12
    offset: float = 82  # from the rail's axis to the sleeve's
    inner: float = 44  # radius of the fork's opening
    outer: float = 55  # radius
    web: float = 10  # thickness of web and ring
    pad: float = 7.2  # thickness of the pads
    pad_length: float = 18  # along x
    screw: float = 6.8  # core hole of M8, through the hub's wall at -y
    screw_z: float = 17
    dog: tuple[float, float, float] = (22, 24, 16)  # reach from the rail's axis, width along y, height
    gate: float = 12  # width of the slot in the dog, along y
    gate_depth: float = 7
    window: float = 14  # lightening hole in the web


def build(p: P) -> Part:
    """Forges hub, web, ring and dog, then machines them."""
    low = -p.web / 2
    outline = make_hull(Circle(p.hub / 2).edges() + (Pos(p.offset, 0) * Circle(p.outer)).edges())
    body = Part() + extrude(Pos(0, 0, low) * outline, amount=p.web)
    body -= rod(2 * p.inner, p.web, (p.offset, 0, low))
    body -= block((2 * p.outer, 4 * p.outer, p.web), (p.offset + p.outer, 0, low))
    hub = rod(p.hub, p.hub_up + p.hub_down, (0, 0, -p.hub_down))
    body += hub
    reach, width, height = p.dog
    body += block((reach, width, height), (-reach / 2, 0, p.hub_up - height))
    body -= block((p.gate_depth, p.gate, height), (-reach + p.gate_depth / 2, 0, p.hub_up - height))
    thin = (p.web - p.pad) / 2
    for z in (low, p.web / 2 - thin):
        body -= block((p.pad_length, 4 * p.outer, thin), (p.offset - p.pad_length / 2, 0, z))
    body -= rod(p.rail, p.hub_up + p.hub_down, (0, 0, -p.hub_down))
    body -= rod(p.screw, p.hub / 2, (0, -p.hub / 2, p.screw_z), BACK)
    middle = (p.hub / 2 + p.offset - p.inner) / 2
    return body - rod(p.window, p.web, (middle, 0, low))
