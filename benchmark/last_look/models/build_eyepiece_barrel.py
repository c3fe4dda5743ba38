"""A turned eyepiece barrel for a telescope: nose with a safety undercut, gripping grooves, lens seat, three grub screws."""

from __future__ import annotations

import math
from dataclasses import dataclass

from build123d import Axis, Box, GeomType, Part, Pos, Rot, chamfer

from benchmark.kit import Model
from benchmark.shapes import DOWN, circle, rod

MODEL = Model("Eyepiece barrel", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is z, the nose's end lies at z = 0, the eye looks in from the top."""

    nose: float = 31.75  # fits a 1.25 inch focuser
    nose_length: float = 28
    undercut: float = 30.5  # diameter of the safety groove
    undercut_width: float = 9
    undercut_z: float = 8  # of its lower edge
    head: float = 44
    head_length: float = 26
    head_chamfer: float = 1
    seat: float = 36  # for the lens, from the top
    seat_depth: float = 12
    field: float = 32  # bore below the seat
    field_depth: float = 9
    bore: float = 26  # through the nose
    filter: float = 28.6  # for the filter thread, from the nose's end
    filter_depth: float = 4
    ring: float = 38  # internal groove in the lens seat
    ring_width: float = 2
    ring_z: float = 2  # of its upper edge, below the top
    grips: int = 24
    grip_width: float = 2
    grip_depth: float = 1.2
    grip_length: float = 10
    grip_z: float = 4  # of their lower end, above the shoulder
    grubs: int = 3
    grub: float = 2.5  # core hole of M3
    grub_z: float = 8  # below the top


def build(p: P) -> Part:
    """Turns the barrel, mills the grips, drills the grub screws' holes."""
    top = p.nose_length + p.head_length
    body = rod(p.nose, p.nose_length)
    body -= rod(p.nose + 5, p.undercut_width, (0, 0, p.undercut_z)) - rod(
        p.undercut, p.undercut_width, (0, 0, p.undercut_z)
    )
    head = rod(p.head, p.head_length, (0, 0, p.nose_length))
    body += chamfer(head.edges().filter_by(GeomType.CIRCLE).sort_by(Axis.Z)[-1], p.head_chamfer)
    body -= rod(p.bore, top)
    body -= rod(p.filter, p.filter_depth)
    body -= rod(p.seat, p.seat_depth, (0, 0, top), DOWN)
    body -= rod(p.field, p.field_depth, (0, 0, top - p.seat_depth), DOWN)
    body -= rod(p.ring, p.ring_width, (0, 0, top - p.ring_z), DOWN)
    middle = p.nose_length + p.grip_z + p.grip_length / 2
    for index in range(p.grips):
        cutter = Pos(p.head / 2, 0, middle) * Box(2 * p.grip_depth, p.grip_width, p.grip_length)
        body -= Rot(0, 0, 360 / p.grips * (index + 0.5)) * cutter
    for at in circle(p.grubs, 2.0):
        along = (at[0], at[1], 0)
        start = (at[0] * p.field / 2, at[1] * p.field / 2, top - p.grub_z)
        assert math.isclose(math.hypot(*at), 1)
        body -= rod(p.grub, (p.head - p.field) / 2 + 1, start, along)
    return body
