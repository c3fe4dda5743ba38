"""A flanged valve body: run along x with a ball-shaped middle, neck with a square bonnet flange, drain boss below."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, Pos, Sphere, chamfer

from benchmark.kit import Model
from benchmark.shapes import DOWN, LEFT, RIGHT, block, circle, drill, grid, rod

MODEL = Model("Valve body", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the run's axis is x, its middle the origin; the bonnet is at +z."""

    face_to_face: float = 170  # raised faces included
    raised: float = 70
    raised_height: float = 2
    flange: float = 115
    flange_thickness: float = 14
    holes: int = 4  # of each end flange
    hole: float = 14
    hole_circle: float = 90
    tube: float = 56
    bore: float = 40
    ball: float = 84
    neck: float = 54
    neck_bore: float = 36
    top: float = 85  # height of the bonnet flange's face above the axis
    bonnet: float = 80  # square
    bonnet_thickness: float = 14
    bonnet_bevel: float = 10
    recess: float = 46  # for the gasket
    recess_depth: float = 4
    stud: float = 8.5  # core hole of M10
    stud_depth: float = 10
    studs: float = 58  # square pattern
    boss: float = 26
    boss_bottom: float = -54
    drain: float = 12


def build(p: P) -> Part:
    """Casts, then machines flanges, run and neck."""
    half = p.face_to_face / 2
    inner = half - p.raised_height
    body = rod(p.tube, 2 * inner, (-inner, 0, 0), RIGHT)
    body += Pos(0, 0, 0) * Sphere(p.ball / 2)
    body += rod(p.boss, -p.boss_bottom, (0, 0, 0), DOWN)
    body += rod(p.neck, p.top - p.bonnet_thickness)
    bonnet = block((p.bonnet, p.bonnet, p.bonnet_thickness), (0, 0, p.top - p.bonnet_thickness))
    body += chamfer(bonnet.edges().filter_by(Axis.Z), p.bonnet_bevel)
    for side, into in ((1, LEFT), (-1, RIGHT)):
        flange = rod(p.flange, p.flange_thickness, (side * inner, 0, 0), into)
        flange += rod(p.raised, p.raised_height, (side * half, 0, 0), into)
        flange -= [
            rod(p.hole, p.flange_thickness, (side * inner, y, z), into) for y, z in circle(p.holes, p.hole_circle, 45)
        ]
        body += flange
    body -= rod(p.bore, p.face_to_face, (-half, 0, 0), RIGHT)
    body -= rod(p.neck_bore, p.top)
    body -= rod(p.recess, p.recess_depth, (0, 0, p.top), DOWN)
    body -= [drill(p.stud, p.stud_depth, (x, y, p.top)) for x, y in grid(2, 2, p.studs, p.studs)]
    return body - rod(p.drain, -p.boss_bottom, (0, 0, 0), DOWN)
