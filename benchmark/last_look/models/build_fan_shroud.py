"""A fan shroud of a radiator, bent from sheet: a face with the fan opening, a skirt, flanges above and below."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Part, Plane, Polyline, Vector as Spot, extrude, fillet, make_face

from benchmark.kit import Model
from benchmark.shapes import BACK, RIGHT, Vector, block, circle, grid, rod, slot

MODEL = Model("Fan shroud", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the outer side of the face looks to -y at y = 0; width x, height z; middle x = z = 0."""

    sheet: float = 1.5
    bend: float = 2.5  # inner radius of every bend
    width: float = 420  # over the side walls, outside
    height: float = 310  # over the upper and lower wall, outside
    depth: float = 46  # from the face to the mounting plane of the flanges
    side_depth: float = 38  # left and right wall, from the face
    flange: float = 22  # above and below, from the wall's outside
    fan: float = 262
    fan_hole: float = 5.5
    fan_circle: float = 290
    slot_length: float = 15
    slot_width: float = 7
    slots: int = 4  # per flange
    slot_pitch: float = 110
    slot_edge: float = 10  # from the flange's free edge to the slot's middle line
    vents: int = 5  # at the left
    vent_length: float = 36
    vent_width: float = 6
    vent_pitch: float = 13
    vent_x: float = -172
    grommet: float = 24  # in the right wall
    grommet_y: float = 20  # from the face's outside


def _profile(p: P, points: list[tuple[float, float]], plane: Plane, length: float) -> Part:
    """The middle of the sheet's outer line offset inside: given as a closed outline already."""
    face = make_face(plane * Polyline(*points, close=True))
    return extrude(face, amount=length / 2, both=True)


def _bends(part: Part, along: Vector, spots: list[tuple[Vector, float]]) -> Part:
    for spot, radius in spots:
        edge = part.edges().sort_by(lambda e: (e.center() - Spot(*spot)).length)[0]
        part = fillet(edge, radius)
    return part


def build(p: P) -> Part:
    t, r = p.sheet, p.bend
    h, w, d, f = p.height / 2, p.width / 2, p.depth, p.flange
    # upper and lower: face, wall, flange; outline in yz
    outline = [
        (0, -h), (d - t, -h), (d - t, -h - f + 0), (d, -h - f + 0), (d, -h + t), (t, -h + t),
        (t, h - t), (d, h - t), (d, h + f), (d - t, h + f), (d - t, h), (0, h),
    ]
    channel = _profile(p, outline, Plane.YZ, p.width - 2 * (r + t))
    spots = []
    for s in (-1, 1):
        spots += [
            ((0, 0, s * h), r + t), ((0, t, s * (h - t)), r),
            ((0, d - t, s * h), r), ((0, d, s * (h - t)), r + t),
        ]
    channel = _bends(channel, RIGHT, spots)
    sides = [(-w, 0), (w, 0), (w, p.side_depth), (w - t, p.side_depth), (w - t, t), (-w + t, t),
             (-w + t, p.side_depth), (-w, p.side_depth)]
    skirt = _profile(p, sides, Plane.XY, p.height - 2 * (r + t))
    spots = []
    for s in (-1, 1):
        spots += [((s * w, 0, 0), r + t), ((s * (w - t), t, 0), r)]
    skirt = _bends(skirt, RIGHT, spots)
    body = channel + skirt
    body -= rod(p.fan, 4 * t, (0, -t, 0), BACK)
    for x, z in circle(4, p.fan_circle, 45):
        body -= rod(p.fan_hole, 4 * t, (x, -t, z), BACK)
    for s in (-1, 1):
        for x, z in grid(p.slots, 1, p.slot_pitch, 0, (0, s * (h + f - p.slot_edge))):
            body -= slot(p.slot_length, p.slot_width, 4 * t, (x, d - 2 * t, z), BACK)
    for x, z in grid(1, p.vents, 0, p.vent_pitch, (p.vent_x, 0)):
        body -= slot(p.vent_length, p.vent_width, 4 * t, (x, -t, z), BACK)
    body -= rod(p.grommet, 4 * t, (w - 2 * t, p.grommet_y, 0), RIGHT)
    return body
