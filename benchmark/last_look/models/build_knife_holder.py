"""A film knife set: holder with blade seat, bevelled blade, clamp bar, three socket head screws."""

from __future__ import annotations

import math
from dataclasses import dataclass

from benchmark.kit import Model
from benchmark.shapes import BACK, DOWN, FRONT, assembly, block, drill, named, prism, rod, slot
from build123d import Axis, Compound, Plane, Polygon, chamfer, extrude, fillet

MODEL = Model("Film knife set", "held_out", bodies=6)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the edge runs along x and looks to -z, the blade's rear is y = 0, the clamp bar lies in front, -y."""

    holder: tuple[float, float, float] = (130, 24, 46)  # x, y, z; y from the seat backwards
    ledge: float = 5  # step above the blade, forward of the seat
    seat: float = 22  # height of the seat, from the underside to the ledge
    edges: float = 2  # chamfer on the two upright rear edges of the holder
    mount: float = 9  # two slots through the holder from above, along y
    mount_long: float = 15
    mount_span: float = 104
    mount_y: float = 12  # of their middle
    pin: float = 6  # two dowel holes from above
    pin_depth: float = 12
    pin_span: float = 50
    tap: float = 5  # M5 into the seat: modelled at nominal size
    tap_depth: float = 14
    screw_x: tuple[float, ...] = (-40, 0, 40)
    screw_z: float = 10
    blade: tuple[float, float, float] = (116, 1.5, 30)  # x, y, z
    blade_out: float = 12  # how far it stands out under the holder
    bevel: float = 22  # degrees, on the front only
    blade_slot: tuple[float, float] = (9, 5.5)  # along z over all, width
    bar: tuple[float, float, float] = (124, 7, 18)
    bar_z: float = 1  # of its underside
    clear: float = 5.5
    head: float = 8.5
    head_length: float = 5
    screw: float = 5
    shank: float = 20
    key: float = 4
    key_depth: float = 2.5
    bar_end: float = 4  # rounding of the bar's ends, seen from the front


def build(p: P) -> Compound:
    """The bar presses the blade on the seat; its screws run into the holder."""
    x, y, z = p.holder
    holder = block((x, y, z), (0, y / 2, 0))
    holder = chamfer(holder.edges().filter_by(Axis.Z).group_by(Axis.Y)[-1], p.edges)
    holder += block((x, p.ledge, z - p.seat), (0, -p.ledge / 2, p.seat))
    for side in (-1, 1):
        holder -= slot(p.mount_long, p.mount, z, (side * p.mount_span / 2, p.mount_y, z), DOWN, 90)
        holder -= drill(p.pin, p.pin_depth, (side * p.pin_span / 2, p.mount_y, z), DOWN)
    for at in p.screw_x:
        holder -= drill(p.tap, p.tap_depth, (at, 0, p.screw_z), BACK)

    bx, by, bz = p.blade
    low = -p.blade_out
    rise = by / math.tan(math.radians(p.bevel))
    plane = Plane(origin=(-bx / 2, 0, 0), x_dir=(0, 1, 0), z_dir=(1, 0, 0))
    shape = Polygon((0, low), (0, low + bz), (-by, low + bz), (-by, low + rise), align=None)
    blade = extrude(plane * shape, amount=bx)
    for at in p.screw_x:
        blade -= slot(*p.blade_slot, by, (at, -by, p.screw_z), BACK, 90)

    wide, deep, high = p.bar
    bar = block((wide, deep, high), (0, -by - deep / 2, p.bar_z))
    bar = fillet(bar.edges().filter_by(Axis.Y), p.bar_end)
    screws = []
    for number, at in enumerate(p.screw_x, 1):
        bar -= rod(p.clear, deep, (at, -by, p.screw_z), FRONT)
        mouth = -by - deep
        head = rod(p.head, p.head_length, (at, mouth, p.screw_z), FRONT)
        one = head + rod(p.screw, p.shank, (at, mouth, p.screw_z), BACK)
        one -= prism(p.key, p.key_depth, (at, mouth - p.head_length, p.screw_z), BACK)
        screws.append(named(one, f"screw_{number}", "gray"))
    return assembly([
        named(holder, "knife_holder", "steelblue"),
        named(blade, "blade", "silver"),
        named(bar, "clamp_bar", "orange"),
        *screws,
    ])
