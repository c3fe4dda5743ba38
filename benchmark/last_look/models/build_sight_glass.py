"""A sight glass for a tank wall: weld-in body, two gaskets, glass disc, cover ring, six socket head screws."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Compound

from benchmark.kit import Model
from benchmark.shapes import DOWN, assembly, circle, cone, drill, named, prism, rod

MODEL = Model("Sight glass", "held_out", bodies=11)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is z, the body's rear face z = 0, one looks in from above."""

    body: float = 136
    body_height: float = 34
    view: float = 68  # clear bore of the body and of the gaskets
    recess: float = 88  # for the glass and the gaskets, from the body's top
    recess_depth: float = 16
    weld: float = 6  # 45 degree weld bevel on the rear rim
    glass: float = 86
    glass_thick: float = 12
    gasket: float = 87  # outside
    gasket_thick: float = 2.5
    cover: float = 136
    cover_thick: float = 16
    window: float = 72  # clear opening of the cover
    sink: float = 90  # 90 degree countersink of the window towards the top
    screws: int = 6
    screw: float = 8
    screw_length: float = 25  # under the head
    screw_circle: float = 110
    head: float = 13
    head_height: float = 8
    socket: float = 6  # across flats
    socket_depth: float = 4
    hole: float = 9  # in the cover
    cbore: float = 15
    cbore_depth: float = 9
    tap_depth: float = 22  # of the tapped holes in the body, drawn at the thread's nominal diameter


def build(p: P) -> Compound:
    """From the rear to the front."""
    z = p.body_height
    floor = z - p.recess_depth
    body = cone(p.body - 2 * p.weld, p.body, p.weld) + rod(p.body, z - p.weld, (0, 0, p.weld))
    body -= rod(p.view, z)
    body -= rod(p.recess, p.recess_depth, (0, 0, floor))
    rings = []
    for start in (floor, floor + p.gasket_thick + p.glass_thick):
        at = (0, 0, start)
        rings.append(rod(p.gasket, p.gasket_thick, at) - rod(p.view, p.gasket_thick, at))
    glass = rod(p.glass, p.glass_thick, (0, 0, floor + p.gasket_thick))
    under = floor + 2 * p.gasket_thick + p.glass_thick
    top = under + p.cover_thick
    cover = rod(p.cover, p.cover_thick, (0, 0, under)) - rod(p.window, p.cover_thick, (0, 0, under))
    deep = (p.sink - p.window) / 2
    cover -= cone(p.sink, p.window, deep, (0, 0, top), DOWN)
    screws = []
    for i, (x, y) in enumerate(circle(p.screws, p.screw_circle)):
        body -= drill(p.screw, p.tap_depth, (x, y, z))
        cover -= rod(p.hole, p.cover_thick, (x, y, under))
        seat = top - p.cbore_depth
        cover -= rod(p.cbore, p.cbore_depth, (x, y, seat))
        screw = rod(p.head, p.head_height, (x, y, seat)) + rod(p.screw, p.screw_length, (x, y, seat), DOWN)
        screw -= prism(p.socket, p.socket_depth, (x, y, seat + p.head_height), DOWN)
        screws.append(named(screw, f"screw_m8x25_{i + 1}", "dimgray"))
    return assembly(
        [
            named(body, "weld_body", "silver"),
            named(rings[0], "gasket_rear", "saddlebrown"),
            named(rings[1], "gasket_front", "saddlebrown"),
            named(glass, "glass", "lightcyan"),
            named(cover, "cover_ring", "lightsteelblue"),
            *screws,
        ]
    )
