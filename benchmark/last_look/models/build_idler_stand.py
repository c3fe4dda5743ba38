"""A stand for an idler roller, welded from a base plate, two uprights, a tube and two gussets."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Compound, Plane, Polygon, extrude

from benchmark.kit import Model
from benchmark.shapes import LEFT, RIGHT, assembly, block, grid, named, rod, slot

MODEL = Model("Idler stand", "held_out", bodies=6)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the base plate lies on z = 0, its middle is x = y = 0; the roller's shaft runs along x."""

    base: tuple[float, float, float] = (380, 180, 12)
    base_slot: tuple[float, float] = (30, 14)
    base_grid: tuple[float, float] = (310, 130)  # between the middles of the slots
    span: float = 260  # over the outer faces of the uprights
    sheet: float = 10  # of the uprights
    foot: float = 140  # width of an upright at its foot
    head: float = 84  # and at its head
    height: float = 230  # of the upright
    notch: float = 27  # width for the shaft
    notch_depth: float = 40  # with its round ground
    keeper_d: float = 9  # two holes beside each notch
    keeper_pitch: float = 54
    keeper_down: float = 18  # from the upright's top
    tube_d: float = 48.3
    tube_wall: float = 4
    tube_up: float = 90  # of its axis above the base plate's top
    gusset: float = 8  # thickness
    gusset_foot: float = 50
    gusset_height: float = 100
    gusset_clip: float = 12  # cut corner over the weld


def build(p: P) -> Compound:
    """Cuts the pieces and puts them together."""
    z = p.base[2]
    plate = block(p.base)
    for x, y in grid(2, 2, *p.base_grid):
        plate -= slot(*p.base_slot, z, (x, y, z))
    bodies = [named(plate, "Base plate", "steelblue")]
    top = z + p.height
    for side, label, color in ((-1, "Left upright", "orange"), (1, "Right upright", "gold")):
        outline = Polygon(
            (-p.foot / 2, z), (p.foot / 2, z), (p.head / 2, top), (-p.head / 2, top), align=None
        )
        inner = side * (p.span / 2 - p.sheet)
        start = min(inner, inner + side * p.sheet)
        upright = extrude(Plane.YZ.offset(start) * outline, amount=p.sheet)
        ground = top - p.notch_depth + p.notch / 2
        upright -= rod(p.notch, p.sheet, (start, 0, ground), RIGHT)
        upright -= block((p.sheet, p.notch, top - ground), (start + p.sheet / 2, 0, ground))
        for way in (-1, 1):
            upright -= rod(p.keeper_d, p.sheet, (start, way * p.keeper_pitch / 2, top - p.keeper_down), RIGHT)
        bodies.append(named(upright, label, color))
    length = p.span - 2 * p.sheet
    axis = (-length / 2, 0, z + p.tube_up)
    tube = rod(p.tube_d, length, axis, RIGHT) - rod(p.tube_d - 2 * p.tube_wall, length, axis, RIGHT)
    bodies.append(named(tube, "Tie tube", "silver"))
    for side, label in ((-1, "Left gusset"), (1, "Right gusset")):
        x = side * p.span / 2
        c = p.gusset_clip
        outline = Polygon(
            (x + side * c, z),
            (x + side * p.gusset_foot, z),
            (x, z + p.gusset_height),
            (x, z + c),
            align=None,
        )
        gusset = extrude(Plane.XZ * outline, amount=p.gusset / 2, both=True)
        bodies.append(named(gusset, label, "firebrick"))
    return assembly(bodies)
