"""A cage plate for one inch optics: stepped bore, four rod holes with their grub screws, magnet pockets, post thread."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, fillet

from benchmark.kit import Model
from benchmark.shapes import BACK, DOWN, FRONT, LEFT, RIGHT, block, cone, grid, rod

MODEL = Model("Cage plate", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the beam's axis is z through x = y = 0; the rear is z = 0, the side with the wide bore is on top."""

    side: float = 40.6
    thickness: float = 9
    corner: float = 4  # radius
    bore: float = 25.7  # from the front
    bore_depth: float = 7.2
    bore_bevel: float = 0.6  # 45 degrees, at the mouth
    clear: float = 22.9  # through the shoulder
    rod: float = 6.02  # holes for the cage rods
    rods: float = 30  # between neighbours
    grub: float = 2.5  # core hole of M3 from the left and right edges into the rod holes
    lock: float = 3.3  # core hole of M4 from the upper edge into the bore
    lock_z: float = 5
    post: float = 4.2  # core hole of M5 in the lower edge
    post_depth: float = 5.5
    magnet: float = 4  # pockets in the front, left and right of the bore
    magnet_depth: float = 2.5
    magnets: float = 33  # between the two
    notch: tuple[float, float] = (12, 1.5)  # width and depth of the flat cut in the upper edge


def build(p: P) -> Part:
    """Mills the plate, bores and drills."""
    s, t = p.side, p.thickness
    body = block((s, s, t))
    body = fillet(body.edges().filter_by(Axis.Z), p.corner)
    body -= rod(p.clear, t)
    body -= rod(p.bore, p.bore_depth, (0, 0, t), DOWN)
    body -= cone(p.bore + 2 * p.bore_bevel, p.bore, p.bore_bevel, (0, 0, t), DOWN)
    width, depth = p.notch
    body -= block((width, depth, t), (0, (s - depth) / 2, 0))
    for x, y in grid(2, 2, p.rods, p.rods):
        body -= rod(p.rod, t, (x, y, 0))
        side = 1 if x > 0 else -1
        body -= rod(p.grub, (s - p.rods) / 2, (side * s / 2, y, t / 2), LEFT if side > 0 else RIGHT)
    body -= rod(p.lock, s / 2, (0, s / 2, p.lock_z), FRONT)
    body -= rod(p.post, p.post_depth, (0, -s / 2, t / 2), BACK)
    for x in (-p.magnets / 2, p.magnets / 2):
        body -= rod(p.magnet, p.magnet_depth, (x, 0, t), DOWN)
    return body
