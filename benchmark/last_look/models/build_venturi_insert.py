"""A venturi insert, turned, for a metering pipe: cone in, throat, cone out, two tap rings, two O-ring grooves."""

from __future__ import annotations

import math
from dataclasses import dataclass

from build123d import Part, chamfer

from benchmark.kit import Model
from benchmark.shapes import RIGHT, block, cone, rod

MODEL = Model("Venturi insert", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres and degrees; the axis is x, the inlet face is x = 0, water runs to +x."""

    length: float = 175
    body: float = 60  # diameter
    collar: float = 72  # diameter, at the inlet end
    collar_width: float = 8
    inlet: float = 50  # diameter
    inlet_length: float = 20
    converging: float = 21  # included angle
    throat: float = 25  # diameter
    throat_length: float = 20
    diverging: float = 15  # included angle
    outlet: float = 38  # diameter
    ring_groove: float = 4.7  # width of an O-ring groove
    ring_depth: float = 2.6
    rings_x: tuple[float, float] = (30, 150)  # near wall of the grooves
    channel: float = 6  # width of the tap ring channels
    channel_depth: float = 1.5
    inlet_tap: float = 3
    inlet_tap_x: float = 14
    throat_tap: float = 2
    taps: int = 4  # of each ring
    jack: float = 3.3  # core hole of M4, through the collar
    jack_circle: float = 66
    notch: float = 6  # width of the locating notch in the collar
    notch_depth: float = 5
    lead: float = 2  # chamfer at the outlet end, 45 degrees

    @property
    def converging_length(self) -> float:
        return (self.inlet - self.throat) / 2 / math.tan(math.radians(self.converging / 2))

    @property
    def diverging_length(self) -> float:
        return (self.outlet - self.throat) / 2 / math.tan(math.radians(self.diverging / 2))

    @property
    def throat_x(self) -> float:
        """Where the throat begins."""
        return self.inlet_length + self.converging_length

    @property
    def outlet_x(self) -> float:
        """Where the diverging cone ends."""
        return self.throat_x + self.throat_length + self.diverging_length


def _groove(p: P, x: float, width: float, depth: float) -> Part:
    return rod(p.body + 1, width, (x, 0, 0), RIGHT) - rod(p.body - 2 * depth, width, (x, 0, 0), RIGHT)


def build(p: P) -> Part:
    """Turns the outside, bores the inside, drills the taps."""
    body = rod(p.body, p.length, (0, 0, 0), RIGHT)
    body = chamfer(body.edges().sort_by(lambda e: e.center().X)[-1], p.lead)
    body += rod(p.collar, p.collar_width, (0, 0, 0), RIGHT)
    tap_x = p.throat_x + p.throat_length / 2
    for x in p.rings_x:
        body -= _groove(p, x, p.ring_groove, p.ring_depth)
    for x in (p.inlet_tap_x, tap_x):
        body -= _groove(p, x - p.channel / 2, p.channel, p.channel_depth)
    inside = rod(p.inlet, p.inlet_length, (0, 0, 0), RIGHT)
    inside += cone(p.inlet, p.throat, p.converging_length, (p.inlet_length, 0, 0), RIGHT)
    inside += rod(p.throat, p.throat_length, (p.throat_x, 0, 0), RIGHT)
    inside += cone(p.throat, p.outlet, p.diverging_length, (p.throat_x + p.throat_length, 0, 0), RIGHT)
    inside += rod(p.outlet, p.length - p.outlet_x, (p.outlet_x, 0, 0), RIGHT)
    body -= inside
    for index in range(p.taps):
        angle = 2 * math.pi * index / p.taps
        out = (0, math.cos(angle), math.sin(angle))
        body -= rod(p.inlet_tap, p.body, (p.inlet_tap_x, 0, 0), out)
        body -= rod(p.throat_tap, p.body, (tap_x, 0, 0), out)
    for side in (-1, 1):
        body -= rod(p.jack, p.collar_width, (0, side * p.jack_circle / 2, 0), RIGHT)
    body -= block((p.collar_width, p.notch, p.notch_depth + 5), (p.collar_width / 2, 0, p.collar / 2 - p.notch_depth))
    return body
