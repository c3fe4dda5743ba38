"""A cast inspection cover of a gear case: flange with seal groove, hollow dome with ribs, breather boss, jacking holes."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, Plane, Pos, RectangleRounded, extrude, fillet

from benchmark.kit import Model
from benchmark.shapes import block, grid, rod

MODEL = Model("Cast inspection cover", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the sealing face is y = 0, the cover bulges to -y; long side along x, short side along z."""

    size: tuple[float, float] = (168, 118)
    flange: float = 9
    corner: float = 16
    dome: tuple[float, float] = (124, 74)  # outside
    dome_corner: float = 14
    height: float = 34  # from the sealing face to the dome's outer face
    wall: float = 5  # of the dome, at the sides and the roof
    roof_fillet: float = 4  # outer edge of the dome's roof
    foot_fillet: float = 3  # between dome and flange
    ribs: int = 2  # inside, across the short side
    rib: float = 4  # thickness
    rib_height: float = 12  # from the roof's inner side
    rib_span: float = 64
    screws: int = 8
    screw: float = 9
    spot: float = 15
    spot_depth: float = 1
    inset: float = 11  # of the corner screws, from both edges; the others lie midway between
    groove: tuple[float, float] = (4, 2.6)  # seal groove around the opening: width, depth
    groove_gap: float = 5  # from the opening to the groove's inner wall
    boss: float = 32
    boss_height: float = 8  # over the dome's roof
    breather: float = 14.5  # M16x1.5 core
    jacks: int = 2
    jack: float = 6.8  # M8 core, through the flange
    jack_span: float = 76  # in the upper and lower long edge, diagonally


def build(p: P) -> Part:
    """Builds it lying on z = 0, then turns it upright."""
    flange = extrude(RectangleRounded(*p.size, p.corner), amount=p.flange)
    dome = extrude(RectangleRounded(*p.dome, p.dome_corner), amount=p.height)
    dome = fillet(dome.faces().sort_by(Axis.Z)[-1].edges(), p.roof_fillet)
    body = flange + dome
    foot = body.edges().filter_by(
        lambda e: abs(e.center().Z - p.flange) < 0.01 and abs(e.center().X) < p.dome[0] / 2 + 0.1 and abs(e.center().Y) < p.dome[1] / 2 + 0.1
    )
    body = fillet(foot, p.foot_fillet)
    body += rod(p.boss, p.height + p.boss_height - 10, (0, 0, 10))
    opening = (p.dome[0] - 2 * p.wall, p.dome[1] - 2 * p.wall)
    radius = p.dome_corner - p.wall
    cavity = extrude(RectangleRounded(*opening, radius), amount=p.height - p.wall)
    body -= cavity
    for side in (-1, 1):
        low = p.height - p.wall - p.rib_height
        body += block((p.rib, opening[1], p.rib_height), (side * p.rib_span / 2, 0, low))
    body -= rod(p.breather, p.height + p.boss_height)
    spots = [(x, y) for x, y in grid(3, 3, p.size[0] / 2 - p.inset, p.size[1] / 2 - p.inset) if (x, y) != (0, 0)]
    for x, y in spots:
        body -= rod(p.screw, p.flange, (x, y, 0))
        body -= rod(p.spot, p.spot_depth, (x, y, p.flange - p.spot_depth))
    inner = (opening[0] + 2 * p.groove_gap, opening[1] + 2 * p.groove_gap)
    outer = (inner[0] + 2 * p.groove[0], inner[1] + 2 * p.groove[0])
    ring = extrude(RectangleRounded(*outer, radius + p.groove_gap + p.groove[0]), amount=p.groove[1])
    ring -= extrude(RectangleRounded(*inner, radius + p.groove_gap), amount=p.groove[1])
    body -= ring
    y = p.size[1] / 2 - p.inset
    for side in (-1, 1):
        body -= rod(p.jack, p.flange, (side * p.jack_span / 2, side * y, 0))
    return Plane((0, 0, 0), x_dir=(1, 0, 0), z_dir=(0, -1, 0)).location * body
