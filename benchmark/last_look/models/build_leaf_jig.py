"""A leaf drill jig: base with feet and nest, hinged leaf with two headed bushings, hinge pin, thumb knob."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Compound, Axis, fillet

from benchmark.kit import Model
from benchmark.shapes import BACK, assembly, block, grid, named, rod

MODEL = Model("Leaf jig", "held_out", bodies=6)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the base's underside without the feet is z = 0; the hinge is at -x, its pin runs along y."""

    base: tuple[float, float, float] = (130, 80, 25)
    foot: float = 14
    foot_height: float = 12
    feet: tuple[float, float] = (106, 56)
    nest: tuple[float, float, float] = (62, 32, 10)  # pocket for the workpiece, depth last
    nest_corner: float = 4
    ear: float = 12  # thickness along y
    ear_length: float = 20  # along x; the ear's top is a half round of that diameter
    gap: float = 42  # between the ears
    pin: float = 10
    pin_length: float = 74
    pin_x: float = -53
    pin_z: float = 34
    leaf: tuple[float, float, float] = (112, 41, 18)
    leaf_x: float = -61  # of its rear end
    leaf_bore: float = 10.2  # for the pin
    bushings_x: float = 30  # between the two
    bushing: float = 12  # body diameter
    bushing_head: float = 17
    bushing_head_height: float = 5
    drill_a: float = 6.1
    drill_b: float = 8.2
    chip: float = 11  # clearance holes in the base under the bushings, through
    stud: float = 8
    stud_x: float = 47
    stud_depth: float = 15  # in the base
    mouth: float = 9  # width of the slot in the leaf's free end
    knob: float = 30
    knob_height: float = 16


def build(p: P) -> Compound:
    """Mills, drills, puts together."""
    top = p.base[2]
    base = block(p.base)
    for x, y in grid(2, 2, *p.feet):
        base += rod(p.foot, p.foot_height, (x, y, -p.foot_height))
    nest = block(p.nest, (0, 0, top - p.nest[2]))
    base -= fillet(nest.edges().filter_by(Axis.Z), p.nest_corner)
    for side in (-1, 1):
        y = side * (p.gap + p.ear) / 2
        base += block((p.ear_length, p.ear, p.pin_z - top), (p.pin_x, y, top))
        base += rod(p.ear_length, p.ear, (p.pin_x, y - p.ear / 2, p.pin_z), BACK)
        base -= rod(p.pin, p.ear, (p.pin_x, y - p.ear / 2, p.pin_z), BACK)
        base -= rod(p.chip, top, (side * p.bushings_x / 2, 0, 0))
    base -= rod(p.stud, p.stud_depth, (p.stud_x, 0, top - p.stud_depth))
    length, width, thick = p.leaf
    leaf = block(p.leaf, (p.leaf_x + length / 2, 0, top))
    leaf -= rod(p.leaf_bore, width, (p.pin_x, -width / 2, p.pin_z), BACK)
    end = p.leaf_x + length
    leaf -= rod(p.mouth, thick, (p.stud_x, 0, top))
    leaf -= block((end - p.stud_x, p.mouth, thick), ((end + p.stud_x) / 2, 0, top))
    bushes = []
    for side, d in ((-1, p.drill_a), (1, p.drill_b)):
        x = side * p.bushings_x / 2
        leaf -= rod(p.bushing, thick, (x, 0, top))
        bush = rod(p.bushing, thick, (x, 0, top))
        bush += rod(p.bushing_head, p.bushing_head_height, (x, 0, top + thick))
        bush -= rod(d, thick + p.bushing_head_height, (x, 0, top))
        bushes.append(bush)
    pin = rod(p.pin, p.pin_length, (p.pin_x, -p.pin_length / 2, p.pin_z), BACK)
    knob = rod(p.knob, p.knob_height, (p.stud_x, 0, top + thick))
    knob += rod(p.stud, thick + p.stud_depth, (p.stud_x, 0, top - p.stud_depth))
    return assembly(
        [
            named(base, "jig base", "slategray"),
            named(leaf, "leaf", "lightsteelblue"),
            named(pin, "hinge pin", "silver"),
            named(bushes[0], "bushing A", "goldenrod"),
            named(bushes[1], "bushing B", "goldenrod"),
            named(knob, "thumb knob", "black"),
        ]
    )
