"""A cast thermostat housing (water outlet) of an engine: oval flange, dome, hose neck aslant, sensor boss."""

from __future__ import annotations

import math
from dataclasses import dataclass

from build123d import Circle, Part, Pos, Sphere, extrude, make_hull

from benchmark.kit import Model
from benchmark.shapes import DOWN, UP, cone, rod

MODEL = Model("Thermostat housing", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres and degrees; the gasket face is z = 0, the dome's axis is z, the bolts are along y."""

    flange: float = 11  # thickness
    flange_core: float = 74  # diameter of the oval's middle
    flange_ear: float = 13  # radius round the bolts
    bolts: float = 88  # between them
    bolt: float = 8.5
    dome: float = 58  # outer diameter
    dome_height: float = 30  # of the sphere's centre above the gasket face
    wall: float = 4
    seat: float = 54  # diameter of the thermostat's seat in the gasket face
    seat_depth: float = 3.5
    neck: float = 32  # outer diameter
    neck_bore: float = 25
    neck_angle: float = 30  # above the gasket face
    neck_length: float = 70  # from the sphere's centre to the end of the neck
    bead: float = 35  # largest diameter of the bead
    bead_width: float = 4
    bead_back: float = 6  # from the end of the neck to the bead
    boss: float = 20  # of the sensor, at -x
    boss_reach: float = 40  # of its face from the dome's axis
    boss_z: float = 24
    sensor: float = 10.2  # core hole of M12
    vent: float = 5  # bleed hole in the top
    vent_boss: float = 12
    vent_z: float = 63  # of the vent boss's face


def _along(p: P) -> tuple[float, float, float]:
    angle = math.radians(p.neck_angle)
    return (math.cos(angle), 0, math.sin(angle))


def build(p: P) -> Part:
    """Casts the outside, hollows it, machines seat, bolts and sensor hole."""
    oval = make_hull(
        Circle(p.flange_core / 2).edges()
        + (Pos(0, p.bolts / 2) * Circle(p.flange_ear)).edges()
        + (Pos(0, -p.bolts / 2) * Circle(p.flange_ear)).edges()
    )
    body = Part() + extrude(oval, amount=p.flange)
    centre = (0, 0, p.dome_height)
    body += rod(p.dome, p.dome_height) + Pos(*centre) * Sphere(p.dome / 2)
    along = _along(p)

    def on(distance: float) -> tuple[float, float, float]:
        return (along[0] * distance, 0, p.dome_height + along[2] * distance)

    body += rod(p.neck, p.neck_length, centre, along)
    start = p.neck_length - p.bead_back - p.bead_width
    half = p.bead_width / 2
    body += cone(p.neck, p.bead, half, on(start), along) + cone(p.bead, p.neck, half, on(start + half), along)
    body += rod(p.boss, p.boss_reach, (-p.boss_reach, 0, p.boss_z), (1, 0, 0))
    body += rod(p.vent_boss, p.vent_z - p.dome_height, centre, UP)
    inner = p.dome - 2 * p.wall
    body -= rod(inner, p.dome_height) + Pos(*centre) * Sphere(inner / 2)
    body -= rod(p.neck_bore, p.neck_length, centre, along)
    body -= rod(p.seat, p.seat_depth)
    body -= rod(p.sensor, p.boss_reach, (-p.boss_reach, 0, p.boss_z), (1, 0, 0))
    body -= rod(p.vent, p.vent_z - p.dome_height, (0, 0, p.vent_z), DOWN)
    for side in (-1, 1):
        body -= rod(p.bolt, p.flange, (0, side * p.bolts / 2, 0))
    return body
