"""A stub spindle for a turning fixture: journal with keyway, bearing seat, bolted collar, short taper nose."""

from __future__ import annotations

import math
from dataclasses import dataclass

from build123d import Part

from benchmark.kit import Model
from benchmark.shapes import RIGHT, circle, cone, rod, slot

MODEL = Model("Stub spindle", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is z, the rear end lies on z = 0, the nose points up."""

    journal: float = 30
    journal_length: float = 42
    bevel: float = 1.5  # 45 degrees, at the rear end
    ring: float = 28.6  # bottom diameter of the retaining ring groove
    ring_width: float = 1.6
    ring_z: float = 4  # its edge nearer the rear end
    key: float = 8  # width of the keyway
    key_depth: float = 4  # below the journal's crest
    key_length: float = 28  # over the round ends
    key_z: float = 24  # of its middle
    seat: float = 45
    seat_length: float = 28  # undercut included
    undercut: float = 44  # diameter
    undercut_width: float = 3
    collar: float = 90
    collar_thickness: float = 14
    bolts: int = 6
    bolt: float = 6.6
    bolt_circle: float = 72
    dog: float = 12  # drive pin's hole, blind, from the front
    dog_depth: float = 9
    dog_angle: float = 30
    nose: float = 54  # diameter at the collar
    nose_length: float = 20
    taper: float = 14.25  # included angle in degrees
    bore: float = 16
    recess: float = 26  # counterbore in the nose
    recess_depth: float = 12


def build(p: P) -> Part:
    """Turns it from rear to front, then mills and drills."""
    shoulder = p.journal_length + p.seat_length
    front = shoulder + p.collar_thickness
    end = front + p.nose_length
    tip = p.nose - 2 * p.nose_length * math.tan(math.radians(p.taper / 2))
    body = cone(p.journal - 2 * p.bevel, p.journal, p.bevel)
    body += rod(p.journal, p.journal_length - p.bevel, (0, 0, p.bevel))
    body += rod(p.seat, p.seat_length - p.undercut_width, (0, 0, p.journal_length))
    body += rod(p.undercut, p.undercut_width, (0, 0, shoulder - p.undercut_width))
    body += rod(p.collar, p.collar_thickness, (0, 0, shoulder))
    body += cone(p.nose, tip, p.nose_length, (0, 0, front))
    body -= rod(p.bore, end)
    body -= rod(p.recess, p.recess_depth, (0, 0, end - p.recess_depth))
    body -= rod(p.journal + 2, p.ring_width, (0, 0, p.ring_z)) - rod(p.ring, p.ring_width, (0, 0, p.ring_z))
    bottom = p.journal / 2 - p.key_depth
    body -= slot(p.key_length, p.key, p.key_depth + 1, (bottom, 0, p.key_z), RIGHT, rotation=90)
    for x, y in circle(p.bolts, p.bolt_circle):
        body -= rod(p.bolt, p.collar_thickness, (x, y, shoulder))
    a = math.radians(p.dog_angle)
    r = p.bolt_circle / 2
    body -= rod(p.dog, p.dog_depth, (r * math.cos(a), r * math.sin(a), front - p.dog_depth))
    return body
