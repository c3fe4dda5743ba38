"""A compact pneumatic cylinder: barrel with sensor grooves, two covers with ports, piston, rod and jam nut."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Compound, Part, Plane, Pos, RectangleRounded, chamfer, extrude

from benchmark.kit import Model
from benchmark.shapes import DOWN, LEFT, RIGHT, assembly, block, drill, grid, named, prism, rod

MODEL = Model("Compact cylinder", "held_out", bodies=6)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is x, the rod points to +x, the barrel runs from x = 0; the ports are on top, +z."""

    square: float = 48  # outside of barrel and covers
    corner: float = 6
    barrel: float = 62
    bore: float = 32
    groove: tuple[float, float] = (4.2, 5)  # sensor grooves, in the middle of both sides +y and -y: width, depth
    rear: float = 14  # thickness of the rear cover
    front: float = 18
    screw_square: float = 34  # pattern of the four cover screws
    screw: float = 5.5  # through the covers
    sink: float = 9.5
    sink_depth: float = 5.5
    tap: float = 4.2  # M5 core hole in the barrel, both ends
    tap_depth: float = 13
    port: float = 8.6  # G1/8 core hole
    port_depth: float = 10
    duct: float = 3  # from the port to the bore
    rod_bore: float = 12  # in the front cover
    pilot: tuple[float, float] = (25, 3)  # centring ring on the front cover: diameter, height
    wiper: tuple[float, float] = (18, 5)  # wiper seat in the front cover: diameter, depth
    piston: float = 32
    piston_length: float = 14
    piston_at: float = 6  # its rear face over the rear cover
    seal: tuple[float, float] = (25, 4)  # groove in the middle of the piston: diameter, width
    spigot: float = 8  # of the rod, in the piston
    rod: float = 12
    rod_over: float = 14  # past the front cover's pilot, d12 part
    flats: float = 10  # across
    flats_length: float = 7
    flats_at: float = 4  # from the shoulder to the flats
    thread: float = 10  # M10x1.25
    thread_length: float = 20
    thread_bevel: float = 1
    nut: float = 16  # across flats
    nut_height: float = 5
    nut_gap: float = 6  # from the rod's shoulder to the nut


def _prism(p: P, long: float, x: float) -> Part:
    return extrude(Plane((x, 0, 0), x_dir=(0, 1, 0), z_dir=(1, 0, 0)) * RectangleRounded(p.square, p.square, p.corner), amount=long)


def build(p: P) -> Compound:
    """Makes the bodies in place."""
    half = p.square / 2
    spots = grid(2, 2, p.screw_square, p.screw_square)
    barrel = _prism(p, p.barrel, 0) - rod(p.bore, p.barrel, (0, 0, 0), RIGHT)
    for side in (-1, 1):
        barrel -= block((p.barrel, 2 * p.groove[1], p.groove[0]), (p.barrel / 2, side * half, -p.groove[0] / 2))
    for y, z in spots:
        barrel -= drill(p.tap, p.tap_depth, (0, y, z), RIGHT)
        barrel -= drill(p.tap, p.tap_depth, (p.barrel, y, z), LEFT)
    low = half - p.port_depth  # bottom of the ports
    rear = _prism(p, p.rear, -p.rear)
    front = _prism(p, p.front, p.barrel) + rod(p.pilot[0], p.front + p.pilot[1], (p.barrel, 0, 0), RIGHT)
    for y, z in spots:
        rear -= rod(p.screw, p.rear, (0, y, z), LEFT)
        rear -= rod(p.sink, p.sink_depth, (-p.rear, y, z), RIGHT)
        front -= rod(p.screw, p.front, (p.barrel, y, z), RIGHT)
        front -= rod(p.sink, p.sink_depth, (p.barrel + p.front, y, z), LEFT)
    rear -= rod(p.port, p.port_depth, (-p.rear / 2, 0, half), DOWN)
    rear -= rod(p.duct, p.rear / 2, (0, 0, low), LEFT)
    x = p.barrel + p.front / 2
    front -= rod(p.port, p.port_depth, (x, 0, half), DOWN)
    front -= rod(p.duct, p.front / 2, (p.barrel, 0, low), RIGHT)
    tip = p.barrel + p.front + p.pilot[1]
    front -= rod(p.rod_bore, tip - p.barrel, (p.barrel, 0, 0), RIGHT)
    front -= rod(p.wiper[0], p.wiper[1], (tip, 0, 0), LEFT)
    start = p.piston_at
    piston = rod(p.piston, p.piston_length, (start, 0, 0), RIGHT) - rod(p.spigot, p.piston_length, (start, 0, 0), RIGHT)
    middle = start + (p.piston_length - p.seal[1]) / 2
    piston -= rod(2 * p.piston, p.seal[1], (middle, 0, 0), RIGHT) - rod(p.seal[0], p.seal[1], (middle, 0, 0), RIGHT)
    neck = start + p.piston_length
    shoulder = tip + p.rod_over
    stem = rod(p.spigot, p.piston_length, (start, 0, 0), RIGHT)
    stem += rod(p.rod, shoulder - neck, (neck, 0, 0), RIGHT)
    thread = rod(p.thread, p.thread_length, (shoulder, 0, 0), RIGHT)
    stem += chamfer(thread.faces().sort_by(Axis.X)[-1].edges(), p.thread_bevel)
    middle = shoulder - p.flats_at - p.flats_length / 2
    for side in (-1, 1):
        stem -= block((p.flats_length, 20, 10), (middle, 0, p.flats / 2 if side > 0 else -p.flats / 2 - 10))
    at = shoulder + p.nut_gap
    nut = prism(p.nut, p.nut_height, (at, 0, 0), RIGHT) - rod(p.thread, p.nut_height, (at, 0, 0), RIGHT)
    return assembly(
        [
            named(barrel, "barrel", "silver"),
            named(rear, "rear cover", "dimgray"),
            named(front, "front cover", "dimgray"),
            named(piston, "piston", "goldenrod"),
            named(stem, "piston rod", "lightgray"),
            named(nut, "jam nut", "black"),
        ]
    )
