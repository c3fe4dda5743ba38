"""The lid of an oil pump: kidneys, ports and seal groove, with pressed bush, two dowel pins and a screw plug."""

from __future__ import annotations

import math
from dataclasses import dataclass

from build123d import Compound

from benchmark.kit import Model
from benchmark.shapes import BACK, FRONT, LEFT, assembly, block, named, prism, rod

MODEL = Model("Oil pump lid", "held_out", bodies=5)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the joint face is z = 0, the shaft's axis z; suction lies on the side x < 0."""

    lid: float = 130
    thick: float = 16
    boss: float = 48
    high: float = 36  # of the boss over the joint face
    bush: float = 30  # outside
    bush_bore: float = 22
    bush_length: float = 28  # flush with the joint face
    seal: float = 38  # recess for the shaft seal, from the boss's top
    seal_depth: float = 7
    screw: float = 6.6
    screw_circle: float = 114
    screw_angles: tuple[float, ...] = (20, 50, 95, 150, 205, 255, 310)  # from x
    dowel: float = 8
    dowel_length: float = 20
    dowel_in: float = 10  # the depth of their holes
    dowel_angles: tuple[float, float] = (120, 290)  # on the screws' circle
    ring_inside: float = 84  # seal groove in the joint face
    ring_outside: float = 90.4
    ring_depth: float = 2.4
    kidney_inside: float = 54  # diameters of both kidneys
    kidney_outside: float = 78
    kidney_depth: float = 7
    suction_from: float = 6  # suction kidney: x below -6
    delivery_from: float = 14  # delivery kidney: x above 14
    suction: float = 11.8  # from the upper side into the suction kidney
    suction_x: float = -33
    delivery: float = 8.8  # from the rim into the delivery kidney, along x
    drill_z: float = 9.5
    cross: float = 8.5  # drilling from the rim along y into the delivery kidney, closed with the plug
    cross_x: float = 20
    cross_end: float = 24  # its inner end's y
    plug: float = 10  # length
    plug_end: float = 60  # outer end's y
    hexagon: float = 5  # socket across flats
    hexagon_depth: float = 4.5


def build(p: P) -> Compound:
    """Turns the lid, mills the kidneys, drills; then the small parts."""
    lid = rod(p.lid, p.thick) + rod(p.boss, p.high)
    lid -= rod(p.bush, p.high)
    lid -= rod(p.seal, p.seal_depth, (0, 0, p.high - p.seal_depth))
    lid -= rod(p.ring_outside, p.ring_depth) - rod(p.ring_inside, p.ring_depth)
    kidney = rod(p.kidney_outside, p.kidney_depth) - rod(p.kidney_inside, p.kidney_depth)
    half = p.kidney_outside
    lid -= kidney & block((half, 2 * half, p.kidney_depth), (-p.suction_from - half / 2, 0, 0))
    lid -= kidney & block((half, 2 * half, p.kidney_depth), (p.delivery_from + half / 2, 0, 0))
    lid -= rod(p.suction, p.thick, (p.suction_x, 0, 0))
    middle = (p.kidney_inside + p.kidney_outside) / 4
    lid -= rod(p.delivery, p.lid / 2 - middle, (p.lid / 2, 0, p.drill_z), LEFT)
    lid -= rod(p.cross, p.lid / 2 - p.cross_end, (p.cross_x, p.lid / 2, p.drill_z), FRONT)
    for a in p.screw_angles:
        x, y = (p.screw_circle / 2 * f(math.radians(a)) for f in (math.cos, math.sin))
        lid -= rod(p.screw, p.thick, (x, y, 0))
    parts = []
    for a, name in zip(p.dowel_angles, ("a", "b")):
        x, y = (p.screw_circle / 2 * f(math.radians(a)) for f in (math.cos, math.sin))
        lid -= rod(p.dowel, p.dowel_in, (x, y, 0))
        parts.append(named(rod(p.dowel, p.dowel_length, (x, y, p.dowel_in - p.dowel_length)), f"dowel_{name}", "silver"))
    bush = rod(p.bush, p.bush_length) - rod(p.bush_bore, p.bush_length)
    plug = rod(p.cross, p.plug, (p.cross_x, p.plug_end - p.plug, p.drill_z), BACK)
    plug -= prism(p.hexagon, p.hexagon_depth, (p.cross_x, p.plug_end, p.drill_z), FRONT)
    return assembly(
        [named(lid, "lid", "lightsteelblue"), named(bush, "bush", "goldenrod"), *parts, named(plug, "plug", "dimgray")]
    )
