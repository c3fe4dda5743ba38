"""A kinematic mirror mount: front plate with a one inch mirror, L-shaped back plate, two adjusters, a pivot ball."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Compound, Part, Pos, Sphere, fillet

from benchmark.kit import Model
from benchmark.shapes import BACK, DOWN, FRONT, RIGHT, assembly, block, cone, named, prism, rod

MODEL = Model("Kinematic mirror mount", "held_out", bodies=6)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the beam's axis is z through x = y = 0, the back plate's rear is z = 0, the mirror faces +z."""

    side: float = 50  # of both plates
    corner: float = 3  # radius of the plates' outer corners
    back: float = 9  # thickness of the back plate
    gap: float = 4  # between the plates
    front: float = 12  # thickness of the front plate
    arm: float = 14  # width of the back plate's two arms
    reach: float = 18  # of ball and adjusters from the middle, in x and in y
    pocket: float = 25.8  # for the mirror, from the front
    pocket_depth: float = 5
    aperture: float = 22  # behind the mirror
    grub: float = 3.3  # core hole of M4 from the top edge into the pocket
    mirror: float = 25.4
    mirror_thickness: float = 6
    ball: float = 6
    post: float = 5  # core hole of M6 in the back plate's lower and left edges
    post_depth: float = 9
    spring: float = 4  # spring holes through both plates
    spring_at: float = 9
    screw: float = 6  # adjusters
    screw_hole: float = 6.2
    screw_length: float = 26  # from the knob to where the ball tip begins
    tip: float = 5  # diameter of the ball tip
    knob: float = 14
    knob_length: float = 8
    hex: float = 2.5  # across flats, in the knob's end
    hex_depth: float = 4
    vee: float = 5  # width of the 90 degree groove under the adjuster on +x
    vee_length: float = 10


def build(p: P) -> Compound:
    """Mills both plates and puts the rest between them."""
    s, r = p.side, p.reach
    z1 = p.back + p.gap
    z2 = z1 + p.front
    seat_depth = p.ball / 2 * 2**0.5 - p.gap / 2  # of the 90 degree cones in which the ball sits

    back = _plate(p, p.back, 0)
    cut = s - p.arm
    back -= block((cut, cut, p.back), (p.arm / 2, p.arm / 2, 0))
    back -= rod(p.screw_hole, p.back, (r, -r, 0)) + rod(p.screw_hole, p.back, (-r, r, 0))
    back -= rod(p.post, p.post_depth, (0, -s / 2, p.back / 2), BACK)
    back -= rod(p.post, p.post_depth, (-s / 2, 0, p.back / 2), RIGHT)
    back -= cone(2 * seat_depth, 0, seat_depth, (-r, -r, p.back), DOWN)

    front = _plate(p, p.front, z1)
    front -= rod(p.pocket, p.pocket_depth, (0, 0, z2), DOWN)
    front -= rod(p.aperture, p.front, (0, 0, z1))
    front -= rod(p.grub, s / 2, (0, s / 2, z2 - p.pocket_depth / 2), FRONT)
    front -= cone(2 * seat_depth, 0, seat_depth, (-r, -r, z1))
    front -= prism(p.vee / 2**0.5, p.vee_length, (r - p.vee_length / 2, -r, z1), RIGHT, sides=4)
    for x, y in ((p.spring_at, -r), (-r, p.spring_at)):
        back -= rod(p.spring, p.back, (x, y, 0))
        front -= rod(p.spring, p.front, (x, y, z1))

    on_flat = z1 - p.tip / 2  # the tip's centre
    in_vee = z1 + p.vee / 2 - p.tip / 2 * 2**0.5
    return assembly(
        [
            named(back, "Back plate", "dimgray"),
            named(front, "Front plate", "gray"),
            named(Pos(-r, -r, p.back + p.gap / 2) * Sphere(p.ball / 2), "Pivot ball", "silver"),
            named(_adjuster(p), "Adjuster A", "goldenrod", Pos(r, -r, in_vee)),
            named(_adjuster(p), "Adjuster B", "goldenrod", Pos(-r, r, on_flat)),
            named(rod(p.mirror, p.mirror_thickness, (0, 0, z2 - p.pocket_depth)), "Mirror", "lightblue"),
        ]
    )


def _plate(p: P, thickness: float, z: float) -> Part:
    plate = block((p.side, p.side, thickness), (0, 0, z))
    return fillet(plate.edges().filter_by(Axis.Z), p.corner)


def _adjuster(p: P) -> Part:
    body = rod(p.screw, p.screw_length, (0, 0, 0), DOWN) + Sphere(p.tip / 2)
    body += rod(p.knob, p.knob_length, (0, 0, -p.screw_length), DOWN)
    return body - prism(p.hex, p.hex_depth, (0, 0, -p.screw_length - p.knob_length))
