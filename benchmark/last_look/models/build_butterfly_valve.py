"""A wafer butterfly valve, opened a bit: body with neck and actuator flange, liner, disc, stem, bushing."""

from __future__ import annotations

import math
from dataclasses import dataclass

from build123d import Axis, Compound, Rot, fillet

from benchmark.kit import Model
from benchmark.shapes import BACK, UP, assembly, block, circle, named, prism, rod

MODEL = Model("Butterfly valve", "held_out", bodies=5)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the pipe's axis is y, the stem's axis is z, both through the origin."""

    body: float = 110  # outer diameter of the ring
    face: float = 44  # face to face of the body, along y
    seat_bore: float = 82  # of the body, holds the liner
    liner: float = 65  # bore of the liner
    lug: float = 32
    lug_hole: float = 18
    lug_circle: float = 145  # four, at 45 degrees
    neck: float = 30
    flange: float = 70  # square
    flange_height: float = 12
    flange_top: float = 130  # above the pipe's axis
    flange_hole: float = 9
    flange_circle: float = 70  # four, at 45 degrees
    flange_corner: float = 8
    stem: float = 14
    stem_foot: float = 44  # the stem goes so far below the axis
    stem_top: float = 156  # above the axis
    square: float = 10  # across flats at the stem's top
    square_height: float = 18
    bushing: float = 20
    bushing_length: float = 26
    disc: float = 62
    disc_thick: float = 8
    hub: float = 22  # disc hub about the stem
    hub_height: float = 50
    opening: float = 35  # degrees, 0 is shut


def build(p: P) -> Compound:
    half = p.face / 2
    body = rod(p.body, p.face, (0, -half, 0), BACK)
    for x, z in circle(4, p.lug_circle, 45):
        body += rod(p.lug, p.face, (x, -half, z), BACK)
        reach = (x**2 + z**2) ** 0.5
        start = p.body / 2 - 8
        web = block((reach - start, p.face, p.lug * 0.7), ((reach + start) / 2, 0, -p.lug * 0.35))
        body += Rot(0, -math.degrees(math.atan2(z, x)), 0) * web
    body += rod(p.neck, p.flange_top - p.body / 2 + 6, (0, 0, p.body / 2 - 6))
    plate = block((p.flange, p.flange, p.flange_height), (0, 0, p.flange_top - p.flange_height))
    plate = fillet(plate.edges().filter_by(Axis.Z), p.flange_corner)
    body += plate
    body -= rod(p.seat_bore, p.face, (0, -half, 0), BACK)
    body -= rod(p.stem, p.flange_top + 1, (0, 0, 0))
    body -= rod(p.stem, p.stem_foot, (0, 0, -p.stem_foot))
    body -= rod(p.bushing, p.bushing_length, (0, 0, p.flange_top - p.bushing_length))
    for x, z in circle(4, p.lug_circle, 45):
        body -= rod(p.lug_hole, p.face, (x, -half, z), BACK)
    for x, y in circle(4, p.flange_circle, 45):
        body -= rod(p.flange_hole, p.flange_height, (x, y, p.flange_top - p.flange_height))
    liner = rod(p.seat_bore, p.face, (0, -half, 0), BACK) - rod(p.liner, p.face, (0, -half, 0), BACK)
    liner -= rod(p.stem, 200, (0, 0, -100))
    disc = rod(p.disc, p.disc_thick, (0, -p.disc_thick / 2, 0), BACK)
    disc += rod(p.hub, p.hub_height, (0, 0, -p.hub_height / 2))
    disc -= rod(p.stem, 200, (0, 0, -100))
    disc = Rot(0, 0, p.opening) * disc
    stem = rod(p.stem, p.stem_foot + p.stem_top - p.square_height, (0, 0, -p.stem_foot))
    stem += prism(p.square, p.square_height, (0, 0, p.stem_top - p.square_height), UP, 4, 45) & rod(
        p.stem, p.square_height, (0, 0, p.stem_top - p.square_height)
    )
    bushing = rod(p.bushing, p.bushing_length, (0, 0, p.flange_top - p.bushing_length)) - rod(
        p.stem, p.bushing_length, (0, 0, p.flange_top - p.bushing_length)
    )
    return assembly(
        [
            named(body, "BODY", "royalblue"),
            named(liner, "SEAT_LINER", "black"),
            named(disc, "DISC", "silver"),
            named(stem, "STEM", "gray"),
            named(bushing, "UPPER_BUSHING", "orange"),
        ]
    )
