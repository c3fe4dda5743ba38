"""The cylinder barrel of an axial piston pump: nine bores, kidney ports in the end face, splined middle, spring pocket."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import CenterArc, Part, Rot, SlotArc, extrude

from benchmark.kit import Model
from benchmark.shapes import DOWN, block, circle, cone, rod

MODEL = Model("Piston barrel", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is z, the port side is z = 0, the pistons enter from above."""

    diameter: float = 98
    length: float = 72
    bores: int = 9
    bore: float = 17
    bores_on: float = 68  # pitch circle
    bore_depth: float = 58
    kidney: float = 7  # width of the ports
    kidney_angle: float = 15  # degrees between the centres of a kidney's round ends
    land: float = 84  # outside diameter of the raised running face
    land_inner: float = 50
    land_height: float = 2.5  # of the relief round it
    neck: float = 93  # ground of the groove round the outside
    neck_width: float = 12
    neck_z: float = 20  # lower edge
    centre: float = 24  # bore, through, minor diameter of the spline
    splines: int = 12
    spline: float = 3  # width of the spline's spaces
    spline_depth: float = 1.8  # from the bore's surface
    pocket: float = 38  # spring pocket from the top
    pocket_depth: float = 34
    clip: float = 41  # ground of the circlip groove
    clip_width: float = 1.85
    clip_down: float = 6  # its upper edge below the top face
    bevel: float = 2  # on the upper outer edge


def build(p: P) -> Part:
    """Turns, bores and mills it."""
    body = rod(p.diameter, p.length - p.land_height - p.bevel, (0, 0, p.land_height))
    body += cone(p.diameter, p.diameter - 2 * p.bevel, p.bevel, (0, 0, p.length - p.bevel))
    body += rod(p.land, p.land_height)
    body -= rod(p.land_inner, p.land_height)
    w = p.neck_width
    body -= rod(p.diameter + 2, w, (0, 0, p.neck_z)) - rod(p.neck, w, (0, 0, p.neck_z))
    for x, y in circle(p.bores, p.bores_on):
        body -= rod(p.bore, p.bore_depth, (x, y, p.length), DOWN)
    for i in range(p.bores):
        arc = CenterArc((0, 0), p.bores_on / 2, 360 / p.bores * i - p.kidney_angle / 2, p.kidney_angle)
        body -= extrude(SlotArc(arc, p.kidney), amount=p.length - p.bore_depth)
    body -= rod(p.centre, p.length)
    for i in range(p.splines):
        reach = p.centre / 2 + p.spline_depth
        body -= Rot(0, 0, 360 / p.splines * i) * block((reach, p.spline, p.length), (reach / 2, 0, 0))
    body -= rod(p.pocket, p.pocket_depth, (0, 0, p.length), DOWN)
    body -= rod(p.clip, p.clip_width, (0, 0, p.length - p.clip_down), DOWN)
    return body
