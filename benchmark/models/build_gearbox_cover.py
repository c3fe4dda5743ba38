"""A gearbox cover: a hollow box on a flange, bearing bosses and cooling fins on top, an oil plug, dowel holes."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, chamfer, fillet

from benchmark.kit import Item, Model, count, length, lengths, point, points, size, volume
from benchmark.shapes import BACK, DOWN, block, grid, rod

MODEL = Model("Gearbox cover with fins", "dev")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the flange's underside is z = 0, its middle x = y = 0."""

    flange: tuple[float, float, float] = (184, 124, 10)
    corner: float = 10
    box: tuple[float, float, float] = (150, 90, 42)  # height from z = 0
    bevel: float = 4  # at the box's upper edges
    inside: tuple[float, float, float] = (138, 78, 36)
    bolt: float = 9
    bolt_head: float = 15  # counterbore
    bolt_head_depth: float = 3
    bolts: tuple[float, float] = (167, 107)
    dowel: float = 6
    dowels_x: float = 167
    dowel_y: float = 20  # both off the middle, so that the cover fits in one way only
    boss: tuple[float, float] = (52, 38)  # outer diameters
    bore: tuple[float, float] = (35, 22)  # of the bearings 6202 and 608 (ISO 15)
    boss_height: float = 9
    boss_x: tuple[float, float] = (42, -14)
    fins: int = 4
    fin: tuple[float, float, float] = (3, 60, 12)
    fin_pitch: float = 8
    fin_x: float = -52  # middle of the row
    plug: float = 12  # in the front wall
    plug_x: float = -40
    plug_z: float = 24


def build(p: P) -> Part:
    """Casts, then bores and drills."""
    flange = block(p.flange)
    body = fillet(flange.edges().filter_by(Axis.Z), p.corner)
    box = block(p.box)
    box = chamfer(box.edges().group_by(Axis.Z)[-1], p.bevel)
    body += box
    top = p.box[2]
    body += [rod(d, p.boss_height, (x, 0, top)) for d, x in zip(p.boss, p.boss_x, strict=True)]
    body += [block(p.fin, (x, y, top)) for x, y in grid(p.fins, 1, p.fin_pitch, 0, (p.fin_x, 0))]
    body -= block(p.inside)
    body -= [rod(d, top + p.boss_height, (x, 0, 0)) for d, x in zip(p.bore, p.boss_x, strict=True)]
    for x, y in _bolts(p):
        body -= rod(p.bolt, p.flange[2], (x, y, 0))
        body -= rod(p.bolt_head, p.bolt_head_depth, (x, y, p.flange[2]), DOWN)
    body -= [rod(p.dowel, p.flange[2], (x, p.dowel_y, 0)) for x in (-p.dowels_x / 2, p.dowels_x / 2)]
    wall = (p.box[1] - p.inside[1]) / 2
    return body - rod(p.plug, wall, (p.plug_x, -p.box[1] / 2, p.plug_z), BACK)


def questions(p: P) -> list[Item]:
    """Asked in a foundry, in assembly, in quality control and in a design office."""
    top = p.box[2] + p.boss_height
    middle = (top + p.inside[2]) / 2
    return [
        count("hole", "How many counterbored bolt holes are in the flange of the cover?", 6),
        lengths(
            "mounting hole",
            "diameter",
            "Diameter of the bolt holes, i.e. of the bore and not of the counterbore",
            [p.bolt] * 6,
        ),
        length(
            "mounting hole",
            "distance",
            "What is the biggest centre distance of the bolt holes in x direction?",
            p.bolts[0],
        ),
        points(
            "through hole",
            "Where are the two 6 mm dowel holes?",
            [(x, p.dowel_y, p.flange[2] / 2) for x in (-p.dowels_x / 2, p.dowels_x / 2)],
        ),
        count("hole with ring", "How many holes with a raised ring around them do you see on the top?", 2),
        lengths("hole with ring", "diameter", "Bearing bores on top: list both diameters.", p.bore),
        length("ring", "diameter", "outter diamter of the larger boss on the cover", max(p.boss)),
        lengths(
            "circular protrusion",
            "height",
            "By what height do the round bosses rise over the top of the cover?",
            [p.boss_height] * 2,
        ),
        length(
            "hole",
            "distance",
            "What's the shaft centre distance, that is between the two bearing bores?",
            p.boss_x[0] - p.boss_x[1],
        ),
        point("hole", "Centre of the bore with the greatest diameter?", (p.boss_x[0], 0, middle)),
        count("cooling fin", "How many cooling ribs are cast on the top surface?", p.fins),
        lengths("cooling fin", "height", "height of the fins?", [p.fin[2]] * p.fins),
        lengths("cooling fin", "length", "What length have the cooling fins along y?", [p.fin[1]] * p.fins),
        length("cooling fin", "distance", "What is the clear gap between adjacent fins?", p.fin_pitch - p.fin[0]),
        count("hole", "How many holes have a radius of less than 5 mm?", 8),
        length("threaded hole", "diameter", "There's a hole for the oil plug at the front. Its diameter?", p.plug),
        length("threaded hole", "depth", "how deep is the hole visible from the front", (p.box[1] - p.inside[1]) / 2),
        length("rectangular inside", "depth", "How deep is the rectangular hollow, viewed from below?", p.inside[2]),
        volume(
            "rectangular inside",
            "What volume does the rectangular inside of the cover have?",
            p.inside[0] * p.inside[1] * p.inside[2],
        ),
        length("object", "thickness", "How thick is the flange?", p.flange[2]),
        size(
            "object",
            "Bounding box dimensions of the cover?",
            (p.flange[0], p.flange[1], p.box[2] + max(p.boss_height, p.fin[2])),
            "extents",
        ),
    ]


def _bolts(p: P) -> list[tuple[float, float]]:
    """Three on each long side."""
    return grid(3, 2, p.bolts[0] / 2, p.bolts[1])
