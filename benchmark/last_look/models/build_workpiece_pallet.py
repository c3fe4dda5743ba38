"""A transfer pallet: plate with a round and a rectangular nest, two hardened bushes, round and flattened locating pin."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Compound, Part, Pos, RectangleRounded, chamfer, extrude

from benchmark.kit import Model
from benchmark.shapes import assembly, block, grid, named, rod, slot

MODEL = Model("Workpiece pallet", "held_out", bodies=5)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the plate's underside is z = 0, its middle at the origin; long side along x."""

    plate: tuple[float, float, float] = (220, 140, 20)
    corner: float = 10
    bevel: float = 1.5  # upper outer edge
    nest: float = 64  # round nest
    nest_depth: float = 8
    nest_x: float = -52
    through: float = 44  # opening in its bottom
    fingers: tuple[float, float] = (88, 20)  # round-ended gripper groove along y: length, width
    tray: tuple[float, float, float] = (70, 46, 11)  # rectangular nest: x, y, depth
    tray_corner: float = 5
    tray_x: float = 50
    ejector: float = 12  # hole through the rectangular nest's bottom
    pin: float = 8  # shank and head, of the locating pins
    pin_over: float = 7  # over the rectangular nest's bottom
    pin_seat: float = 9  # depth in the plate, all through the bottom
    pin_span: float = 50  # along x
    pin_bevel: float = 1.5
    pin_flat: float = 5  # width of the flattened pin, between the flats
    bush: float = 18  # outside
    bush_bore: float = 12
    bush_x: float = 95  # of the bushes, diagonal
    bush_y: float = 55
    tag: tuple[float, float] = (31, 7)  # round pocket for the data tag in the underside: diameter, depth
    tag_x: float = 5
    tag_y: float = 48
    notch: tuple[float, float, float] = (24, 9, 10)  # stopper notch in the middle of the -y side: x, y, height
    screws: int = 4
    screw: float = 5.5
    sink: float = 10  # at the underside
    sink_depth: float = 5.4
    screw_span: tuple[float, float] = (150, 112)


def build(p: P) -> Compound:
    """Mills the plate, then sets in bushes and pins."""
    thick = p.plate[2]
    plate = extrude(RectangleRounded(p.plate[0], p.plate[1], p.corner), amount=thick)
    plate = chamfer(plate.faces().sort_by(Axis.Z)[-1].edges(), p.bevel)
    plate -= rod(p.nest, p.nest_depth, (p.nest_x, 0, thick - p.nest_depth))
    plate -= slot(*p.fingers, p.nest_depth, (p.nest_x, 0, thick), rotation=90)
    plate -= rod(p.through, thick, (p.nest_x, 0, 0))
    floor = thick - p.tray[2]
    plate -= Pos(p.tray_x, 0, floor) * extrude(RectangleRounded(p.tray[0], p.tray[1], p.tray_corner), amount=p.tray[2])
    plate -= rod(p.ejector, thick, (p.tray_x, 0, 0))
    pins = [p.tray_x - p.pin_span / 2, p.tray_x + p.pin_span / 2]
    for x in pins:
        plate -= rod(p.pin, p.pin_seat, (x, 0, floor - p.pin_seat))
    spots = [(-p.bush_x, -p.bush_y), (p.bush_x, p.bush_y)]
    for x, y in spots:
        plate -= rod(p.bush, thick, (x, y, 0))
    plate -= rod(*p.tag, (p.tag_x, p.tag_y, 0))
    plate -= block((p.notch[0], 2 * p.notch[1], p.notch[2]), (0, -p.plate[1] / 2, 0))
    for x, y in grid(2, 2, *p.screw_span):
        plate -= rod(p.screw, thick, (x, y, 0))
        plate -= rod(p.sink, p.sink_depth, (x, y, 0))
    bodies = [named(plate, "pallet plate", "silver")]
    bush = rod(p.bush, thick) - rod(p.bush_bore, thick)
    bush = chamfer(
        bush.edges().filter_by(lambda e: e.geom_type.name == "CIRCLE" and abs(e.radius - p.bush_bore / 2) < 0.01 and e.center().Z < 1),
        1,
    )
    for label, (x, y) in zip(("bush 1", "bush 2"), spots, strict=True):
        bodies.append(named(Pos() * bush, label, "dimgray", Pos(x, y, 0)))
    pin = rod(p.pin, p.pin_seat + p.pin_over)
    pin = chamfer(pin.faces().sort_by(Axis.Z)[-1].edges(), p.pin_bevel)
    flat = pin
    for side in (-1, 1):
        x = side * (p.pin_flat / 2 + 5)
        flat = flat - block((10, 20, p.pin_over), (x, 0, p.pin_seat))
    low = floor - p.pin_seat
    bodies.append(named(pin, "round pin", "gray", Pos(pins[0], 0, low)))
    bodies.append(named(flat, "flattened pin", "gray", Pos(pins[1], 0, low)))
    return assembly(bodies)
