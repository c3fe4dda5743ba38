"""A printed box hinge, partly open: leaf with three knuckles, leaf with two, headed pin."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Compound, Part, Plane, Pos, RectangleRounded, chamfer, extrude

from benchmark.kit import Model
from benchmark.shapes import BACK, FRONT, assembly, block, cone, named, rod

MODEL = Model("Printed hinge", "held_out", bodies=3)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the pin's axis is y, the leaf with three knuckles lies towards +x, its underside tangent to them."""

    length: float = 60  # along the pin
    leaf: float = 38  # from the pin's axis to a leaf's free edge
    thickness: float = 4
    knuckle: float = 11  # diameter
    knuckles: int = 5  # of both leaves
    gap: float = 0.4  # between neighbouring knuckles
    relief: float = 0.6  # between a knuckle and the other leaf
    bore: float = 5.2
    pin: float = 4.9
    head: float = 9
    head_height: float = 2.5
    pin_over: float = 3  # sticks out at the far end
    pin_bevel: float = 0.8  # at the far end
    corner: float = 5
    holes: int = 3  # of each leaf
    hole: float = 4.4
    sink: float = 8.4  # countersink, 90 degrees
    rows: tuple[float, float] = (17, 30)  # from the pin's axis: middle hole, outer holes
    pitch: float = 40  # between the outer holes
    open: float = 120  # between the leaves, degrees


def _leaf(p: P, own: int) -> Part:
    """A leaf towards +x that owns every second knuckle from number `own` on."""
    low = -p.knuckle / 2
    pitch = (p.length + p.gap) / p.knuckles
    plate = extrude(RectangleRounded(2 * p.leaf, p.length, p.corner), amount=p.thickness)
    plate = Pos(0, 0, low) * plate
    plate -= block((4 * p.leaf, 2 * p.length, 4 * p.thickness), (-2 * p.leaf, 0, -2 * p.thickness))
    for index in range(p.knuckles):
        y = -p.length / 2 + index * pitch
        long = pitch - p.gap
        if index % 2 == own:
            plate += rod(p.knuckle, long, (0, y, 0), BACK)
        else:
            reach = p.knuckle / 2 + p.relief
            plate -= rod(2 * reach, long + 2 * p.gap, (0, y - p.gap, 0), BACK)
            plate -= block((2 * reach, long + 2 * p.gap, 20), (0, y + long / 2, -10))
    plate -= rod(p.bore, 2 * p.length, (0, -p.length, 0), BACK)
    top = low + p.thickness
    spots = [(p.rows[0], 0.0)] + [(p.rows[1], side * p.pitch / 2) for side in (-1, 1)]
    for x, y in spots:
        plate -= rod(p.hole, p.thickness, (x, y, low))
        plate -= cone(p.hole, p.sink, (p.sink - p.hole) / 2, (x, y, top - (p.sink - p.hole) / 2))
    return plate


def build(p: P) -> Compound:
    """Makes both leaves alike, turns the second about the pin."""
    first = _leaf(p, 0)
    second = _leaf(p, 1).mirror(Plane.YZ)
    second = second.rotate(Axis.Y, 180 - p.open)
    start = -p.length / 2
    pin = rod(p.pin, p.length + p.pin_over, (0, start, 0), BACK)
    end = pin.faces().sort_by(Axis.Y)[-1]
    pin = chamfer(end.edges(), p.pin_bevel)
    pin += rod(p.head, p.head_height, (0, start, 0), FRONT)
    bodies = [
        named(first, "leaf 3 knuckles", "steelblue"),
        named(second, "leaf 2 knuckles", "lightsteelblue"),
        named(pin, "pin", "dimgray"),
    ]
    return assembly(bodies)
