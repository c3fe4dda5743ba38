"""A cast bellhousing between a motor and a hydraulic pump: conical wall with two windows, ribs, two machined faces."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Part, Plane, Polygon, Rot, extrude

from benchmark.kit import Model
from benchmark.shapes import LEFT, RIGHT, circle, cone, rod, slot

MODEL = Model("Bellhousing", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is z, the motor face is z = 0, the pump face on top."""

    height: float = 148
    motor: float = 250  # diameter of the motor flange
    motor_thickness: float = 16
    register: float = 180  # recess for the motor's spigot
    register_depth: float = 5
    motor_holes: int = 4
    motor_hole: float = 14
    motor_pcd: float = 215
    pump: float = 140  # diameter of the pump flange
    pump_thickness: float = 20
    pilot: float = 82.55  # bore for the pump's spigot, through the flange
    pump_taps: int = 2
    pump_tap: float = 8.5  # M10, through
    pump_pitch: float = 106.4
    low: float = 186  # outside diameter of the cone at the motor flange's back
    high: float = 128  # outside diameter of the cone at the pump flange's back
    wall: float = 9  # radially
    window: float = 58  # length over all, along the circumference
    window_height: float = 36
    window_z: float = 72  # middle
    ribs: tuple[float, ...] = (65, 115, 245, 295)  # degrees
    rib: float = 8  # thickness
    rib_foot: float = 112  # radius at the motor flange's back
    drain: float = 11  # hole in the wall on the back side
    drain_z: float = 40


def build(p: P) -> Part:
    """Casts and machines it."""
    z0, z1 = p.motor_thickness, p.height - p.pump_thickness
    body = rod(p.motor, z0) + rod(p.pump, p.pump_thickness, (0, 0, z1)) + cone(p.low, p.high, z1 - z0, (0, 0, z0))
    for a in p.ribs:
        web = Plane.XZ * Polygon((40, z0), (p.rib_foot, z0), (p.high / 2 + 4, z1), (40, z1), align=None)
        body += Rot(0, 0, a) * extrude(web, amount=p.rib / 2, both=True)
    body -= cone(p.low - 2 * p.wall, p.high - 2 * p.wall, z1 - z0, (0, 0, z0))
    body -= rod(p.low - 2 * p.wall, z0)
    body -= rod(p.register, p.register_depth)
    body -= rod(p.pilot, p.pump_thickness, (0, 0, z1))
    for x, y in circle(p.motor_holes, p.motor_pcd, 45):
        body -= rod(p.motor_hole, z0, (x, y, 0))
    for side in (-1, 1):
        body -= rod(p.pump_tap, p.pump_thickness, (side * p.pump_pitch / 2, 0, z1))
        body -= slot(p.window, p.window_height, 130, (0, 0, p.window_z), RIGHT if side > 0 else LEFT)
    body -= rod(p.drain, 150, (0, 0, p.drain_z), (0, 1, 0))
    return body
