"""A moulded pusher lug of a carton conveyor chain: hollow body with inclined back, ribs, foot with counterbored holes, pegs."""

from __future__ import annotations

from dataclasses import dataclass

from benchmark.kit import Model
from benchmark.shapes import DOWN, RIGHT, block, grid, rod
from build123d import Axis, Part, Plane, Polygon, extrude, fillet

MODEL = Model("Pusher lug", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; it pushes towards +y with the upright face y = 0, the foot's underside is z = 0, the hollow opens to -z."""

    width: float = 58  # of the pusher, x
    height: float = 85  # over all, without pegs
    base: float = 50  # depth of the pusher at z = 0, towards -y
    crown: float = 16  # depth at the top
    wall: float = 3
    roof: float = 4  # measured upright
    rib: float = 2
    ribs: int = 2  # upright webs in the hollow, parallel to y-z
    rib_pitch: float = 18
    foot: tuple[float, float] = (102, 50)  # x, y
    foot_height: float = 8
    foot_corner: float = 8
    holes: tuple[float, float] = (82, 30)  # pattern: x, y
    hole: float = 6.6
    head: float = 12
    head_depth: float = 4
    peg: float = 7
    peg_height: float = 5
    peg_x: float = 82  # between the two
    edge: float = 2  # rounding of the pushing face's two upright edges
    cross: float = 8.2  # hole through both side walls and the ribs, for a cross bar
    cross_at: tuple[float, float] = (-14, 56)  # y, z


def build(p: P) -> Part:
    """Subtracts a smaller wedge from the wedge, leaving the webs, and adds the foot."""

    def wedge(x: float, width: float, shape: Polygon) -> Part:
        return extrude(Plane(origin=(x, 0, 0), x_dir=(0, 1, 0), z_dir=(1, 0, 0)) * shape, amount=width)

    outer = Polygon((0, 0), (0, p.height), (-p.crown, p.height), (-p.base, 0), align=None)
    body = wedge(-p.width / 2, p.width, outer)
    body = fillet(body.faces().sort_by(Axis.Y)[-1].edges().filter_by(Axis.Z), p.edge)
    foot = block((*p.foot, p.foot_height), (0, -p.foot[1] / 2, 0))
    body += fillet(foot.edges().filter_by(Axis.Z), p.foot_corner)
    slope = (p.base - p.crown) / p.height
    slant = p.wall * (1 + slope * slope) ** 0.5
    top = p.height - p.roof
    hollow = Polygon((-p.wall, 0), (-p.wall, top), (-p.base + slope * top + slant, top), (-p.base + slant, 0), align=None)
    inside = p.width - 2 * p.wall
    void = wedge(-inside / 2, inside, hollow)
    for index in range(p.ribs):
        x = (index - (p.ribs - 1) / 2) * p.rib_pitch
        void -= block((p.rib, 3 * p.base, p.height), (x, 0, 0))
    body -= void
    for x, y in grid(2, 2, *p.holes, (0, -p.foot[1] / 2)):
        body -= rod(p.hole, p.foot_height, (x, y, 0))
        body -= rod(p.head, p.head_depth, (x, y, p.foot_height - p.head_depth))
    for side in (-1, 1):
        body += rod(p.peg, p.peg_height, (side * p.peg_x / 2, -p.foot[1] / 2, 0), DOWN)
    body -= rod(p.cross, p.width, (-p.width / 2, *p.cross_at), RIGHT)
    return body
