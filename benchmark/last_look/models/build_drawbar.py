"""A welded drawbar of a trailer: square tube, base plate, tow eye, two gussets and a chain lug."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Compound, Plane, Polyline, extrude, make_face

from benchmark.kit import Model
from benchmark.shapes import BACK, RIGHT, assembly, block, grid, named, rod

MODEL = Model("Drawbar", "held_out", bodies=6)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the tube runs along x; the base plate's rear face at x = 0, the eye in front (+x)."""

    plate_y: float = 180
    plate_z: float = 140
    plate: float = 12
    hole: float = 13.5
    hole_dy: float = 140
    hole_dz: float = 100
    tube: float = 70
    wall: float = 5
    length: float = 620
    eye: float = 96
    eye_bore: float = 40
    eye_thick: float = 32
    eye_gap: float = 84  # from the tube's end to the eye's axis
    shank: float = 44  # width of the shank between foot and eye
    foot: float = 12  # square foot of the eye, closes the tube
    gusset: float = 50  # along y
    gusset_x: float = 110
    gusset_thick: float = 8
    gusset_tip: float = 10  # blunt ends
    lug_x: float = 300  # of the chain lug's middle, from the plate's rear face
    lug_length: float = 60
    lug_high: float = 45
    lug_thick: float = 10
    lug_hole: float = 20
    lug_hole_z: float = 25  # below the tube's underside


def build(p: P) -> Compound:
    plate = block((p.plate, p.plate_y, p.plate_z), (p.plate / 2, 0, -p.plate_z / 2))
    for y, z in grid(2, 2, p.hole_dy, p.hole_dz):
        plate -= rod(p.hole, p.plate, (0, y, z), RIGHT)
    inner = p.tube - 2 * p.wall
    middle = p.plate + p.length / 2
    tube = block((p.length, p.tube, p.tube), (middle, 0, -p.tube / 2))
    tube -= block((p.length, inner, inner), (middle, 0, -inner / 2))
    end = p.plate + p.length
    axis = end + p.eye_gap
    eye = rod(p.eye, p.eye_thick, (axis, 0, -p.eye_thick / 2))
    eye += block((p.eye_gap, p.shank, p.eye_thick), (end + p.eye_gap / 2, 0, -p.eye_thick / 2))
    eye += block((p.foot, p.tube, p.tube), (end + p.foot / 2, 0, -p.tube / 2))  # one forging
    eye -= rod(p.eye_bore, p.eye_thick, (axis, 0, -p.eye_thick / 2))
    gussets = []
    for s in (-1, 1):
        w = s * p.tube / 2
        face = make_face(
            Plane.XY
            * Polyline(
                (p.plate, w),
                (p.plate + p.gusset_x, w),
                (p.plate + p.gusset_x, w + s * p.gusset_tip),
                (p.plate + p.gusset_tip, w + s * p.gusset),
                (p.plate, w + s * p.gusset),
                close=True,
            )
        )
        gussets.append(extrude(face, amount=p.gusset_thick / 2, both=True))
    lug = block((p.lug_length, p.lug_thick, p.lug_high), (p.lug_x, 0, -p.tube / 2 - p.lug_high))
    lug -= rod(p.lug_hole, p.lug_thick, (p.lug_x, -p.lug_thick / 2, -p.tube / 2 - p.lug_hole_z), BACK)
    return assembly(
        [
            named(plate, "BASE_PLATE", "slategray"),
            named(tube, "MAIN_TUBE", "steelblue"),
            named(eye, "TOW_EYE", "firebrick"),
            named(gussets[0], "GUSSET_R", "goldenrod"),
            named(gussets[1], "GUSSET_L", "goldenrod"),
            named(lug, "CHAIN_LUG", "darkgreen"),
        ]
    )
