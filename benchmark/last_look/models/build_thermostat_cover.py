"""The cast cover over an engine's thermostat: two-eared foot, dome, rising hose spout, sensor boss, bleeder boss."""

from __future__ import annotations

import math
from dataclasses import dataclass

from build123d import Part, Pos, Sphere, Circle, Sketch, extrude, make_hull

from benchmark.kit import Model
from benchmark.shapes import LEFT, block, rod

MODEL = Model("Thermostat cover", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; stands on z = 0, the dome's axis is z; ears on +-x, the hose spout rises to the front (low y)."""

    foot: float = 9  # thickness
    foot_disc: float = 82
    ears: float = 98  # between the bolt holes
    ear: float = 26  # diameter of an ear
    bolt: float = 8.6
    dome: float = 66  # outside
    wall: float = 5
    dome_z: float = 24  # centre of the sphere
    seat: float = 60  # counterbore below for the thermostat's rim
    seat_depth: float = 4
    groove: tuple[float, float] = (67, 74)  # inner and outer diameter of the seal groove
    groove_depth: float = 2.4
    spout: float = 38  # outside
    spout_bore: float = 30
    spout_reach: float = 80  # along its axis, from the sphere's centre
    spout_rise: float = 25  # degrees above the horizontal
    bead: float = 42  # ring that keeps the hose
    bead_width: float = 5
    bead_back: float = 4  # from the spout's end to the ring's near side
    sensor: float = 24  # boss on top
    sensor_y: float = 8
    sensor_z: float = 66  # its top
    sensor_bore: float = 12.5  # into the dome
    bleeder: float = 15  # boss at the right (high x)
    bleeder_x: float = 40  # its face
    bleeder_z: float = 25
    bleeder_bore: float = 6.8  # into the dome


def build(p: P) -> Part:
    """Casts the outside, then takes the inside out."""
    rims = [Circle(p.foot_disc / 2).edge()]
    rims += [(Pos(s * p.ears / 2, 0) * Circle(p.ear / 2)).edge() for s in (-1, 1)]
    body = extrude(Sketch() + make_hull(rims), amount=p.foot)
    body += rod(p.dome, p.dome_z)
    centre = Pos(0, 0, p.dome_z)
    above = block((p.dome, p.dome, p.dome), (0, 0, p.dome_z))
    body += (centre * Sphere(p.dome / 2)) & above
    a = math.radians(p.spout_rise)
    out = (0, -math.cos(a), math.sin(a))

    def along(s: float) -> tuple[float, float, float]:
        return (0, s * out[1], p.dome_z + s * out[2])

    body += rod(p.spout, p.spout_reach, along(0), out)
    body += rod(p.bead, p.bead_width, along(p.spout_reach - p.bead_back - p.bead_width), out)
    body += rod(p.sensor, p.sensor_z - p.dome_z, (0, p.sensor_y, p.dome_z))
    body += rod(p.bleeder, p.bleeder_x, (p.bleeder_x, 0, p.bleeder_z), LEFT)
    hollow = p.dome - 2 * p.wall
    body -= rod(hollow, p.dome_z)
    body -= (centre * Sphere(hollow / 2)) & above
    body -= rod(p.spout_bore, p.spout_reach, along(0), out)
    body -= rod(p.sensor_bore, p.sensor_z - p.dome_z, (0, p.sensor_y, p.dome_z))
    body -= rod(p.bleeder_bore, p.bleeder_x, (p.bleeder_x, 0, p.bleeder_z), LEFT)
    body -= rod(p.seat, p.seat_depth)
    body -= rod(p.groove[1], p.groove_depth) - rod(p.groove[0], p.groove_depth)
    for side in (-1, 1):
        body -= rod(p.bolt, p.foot, (side * p.ears / 2, 0, 0))
    return body
