"""The cast end shield of an electric motor: rim with spigot, web with windows and ribs, drafted bearing hub, four ears."""

from __future__ import annotations

import math
from dataclasses import dataclass

from build123d import Part, Rot

from benchmark.kit import Model
from benchmark.shapes import DOWN, UP, block, circle, cone, drill, rod

MODEL = Model("Motor end shield", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; axis z; the web's underside (towards the rotor) at z = 0, the hub stands up (outside)."""

    outer: float = 190  # rim
    rim: float = 9  # wall
    rim_height: float = 26
    web: float = 7
    spigot: float = 176  # centring, below
    spigot_height: float = 5
    spigot_wall: float = 8
    hub: float = 76  # at its upper end
    hub_height: float = 38  # above the web's underside
    draft: float = 3  # degrees, hub's outside
    seat: float = 52  # bearing bore, from below
    seat_depth: float = 20
    shaft: float = 34
    seal: float = 47  # shaft seal bore, from above
    seal_depth: float = 8
    ribs: int = 6
    rib: float = 6
    rib_height: float = 20  # above the web's underside
    windows: int = 6
    window: float = 22
    window_circle: float = 130
    ears: int = 4
    ear: float = 24  # outer diameter
    ear_hole: float = 9
    ear_circle: float = 206
    ear_height: float = 14
    cover: float = 4.2  # M5 core holes in the hub's top face
    covers: int = 3
    cover_circle: float = 62
    cover_depth: float = 12
    drain: float = 6  # condensate hole through the rim, at the bottom (-y)
    drain_z: float = 16


def build(p: P) -> Part:
    inner = p.outer - 2 * p.rim
    body = rod(p.outer, p.rim_height) - rod(inner, p.rim_height, (0, 0, p.web))
    for x, y in circle(p.ears, p.ear_circle, 45):
        ear = rod(p.ear, p.ear_height, (x, y, 0))
        toward = Rot(0, 0, math.degrees(math.atan2(y, x)))
        reach = p.ear_circle / 2
        ear += toward * block((reach - inner / 2 - 2, p.ear, p.ear_height), ((reach + inner / 2 + 2) / 2, 0, 0))
        body += ear
    for index in range(p.ribs):
        body += Rot(0, 0, 360 / p.ribs * index) * block(
            (inner / 2 + 1 - 20, p.rib, p.rib_height), ((inner / 2 + 1 + 20) / 2, 0, 0)
        )
    foot = p.hub + 2 * p.hub_height * math.tan(math.radians(p.draft))
    body += cone(foot, p.hub, p.hub_height)
    body += rod(p.spigot, p.spigot_height, (0, 0, 0), DOWN) - rod(
        p.spigot - 2 * p.spigot_wall, p.spigot_height, (0, 0, 0), DOWN
    )
    body -= rod(p.shaft, 200, (0, 0, -50))
    body -= rod(p.seat, p.seat_depth, (0, 0, 0), UP)
    body -= rod(p.seal, p.seal_depth, (0, 0, p.hub_height), DOWN)
    for x, y in circle(p.windows, p.window_circle, 30):
        body -= rod(p.window, 3 * p.web, (x, y, -p.web))
    for x, y in circle(p.ears, p.ear_circle, 45):
        body -= rod(p.ear_hole, 100, (x, y, -50))
    for x, y in circle(p.covers, p.cover_circle, 90):
        body -= drill(p.cover, p.cover_depth, (x, y, p.hub_height))
    body -= rod(p.drain, 3 * p.rim, (0, -p.outer / 2 - p.rim, p.drain_z), (0, 1, 0))
    return body
