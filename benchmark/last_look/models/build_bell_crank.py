"""A cast bell crank: pivot boss, two arms of different length with end bosses, oil hole, lightening slot."""

from __future__ import annotations

import math
from dataclasses import dataclass

from build123d import Circle, Part, Pos, Sketch, extrude, fillet, make_hull

from benchmark.kit import Model
from benchmark.shapes import UP, drill, rod, slot

MODEL = Model("Bell crank", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the pivot's axis is z through the origin, z = 0 is the web's mid-plane; the long arm runs on +x."""

    pivot: float = 46  # boss diameter
    pivot_height: float = 40
    pivot_bore: float = 24
    web: float = 12  # thickness
    root: float = 36  # width of both arms at the pivot
    long: float = 120  # pivot to end hole
    long_tip: float = 24  # width at the end
    long_boss: float = 30
    long_height: float = 24
    long_bore: float = 14
    short: float = 85
    short_tip: float = 22
    short_boss: float = 27
    short_height: float = 20
    short_bore: float = 12
    between: float = 110  # angle of the arms in degrees
    blend: float = 3  # radius from the web to the bosses
    slot_length: float = 44  # lightening slot in the long arm
    slot_width: float = 12
    slot_x: float = 66  # of its middle
    oil: float = 5  # radial oil hole into the pivot bore
    oil_z: float = 13


def build(p: P) -> Part:
    """Casts web and bosses, blends, machines the bores."""
    a = math.radians(p.between)
    sx, sy = p.short * math.cos(a), p.short * math.sin(a)

    def arm(x: float, y: float, tip: float) -> Part:
        sketch = Sketch() + [Circle(p.root / 2), Pos(x, y) * Circle(tip / 2)]
        return extrude(make_hull(sketch.edges()), amount=p.web / 2, both=True)

    body = arm(p.long, 0, p.long_tip) + arm(sx, sy, p.short_tip)
    bosses = (
        (p.pivot, p.pivot_height, 0, 0),
        (p.long_boss, p.long_height, p.long, 0),
        (p.short_boss, p.short_height, sx, sy),
    )
    for d, h, x, y in bosses:
        body += rod(d, h, (x, y, -h / 2))
    seams = [
        e
        for e in body.edges()
        if abs(abs(e.center().Z) - p.web / 2) < 1e-3
        and any(
            abs(math.hypot(e.position_at(q).X - x, e.position_at(q).Y - y) - d / 2) < 1e-3
            for d, _, x, y in bosses
            for q in (0.37,)
        )
    ]
    body = fillet(seams, p.blend)
    body -= rod(p.pivot_bore, p.pivot_height, (0, 0, -p.pivot_height / 2))
    body -= rod(p.long_bore, p.long_height, (p.long, 0, -p.long_height / 2))
    body -= rod(p.short_bore, p.short_height, (sx, sy, -p.short_height / 2))
    body -= slot(p.slot_length, p.slot_width, p.web, (p.slot_x, 0, p.web / 2))
    m = math.radians(p.between / 2 + 180)
    body -= rod(p.oil, p.pivot / 2, (0, 0, p.oil_z), (math.cos(m), math.sin(m), 0))
    return body
