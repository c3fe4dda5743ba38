"""A hold-down clamp on a machine table: strap on a step block, stud in a T-nut, dished washer and flange nut."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Compound, Plane, Polygon, extrude

from benchmark.kit import Model
from benchmark.shapes import DOWN, assembly, block, named, prism, rod, slot

MODEL = Model("Hold-down clamp set", "held_out", bodies=6)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the table's surface is z = 0, the strap runs along x with its nose to +x, the stud's axis is z."""

    thread: float = 12  # stud, plain
    stud: float = 130  # length
    tee: tuple[float, float, float] = (24, 24, 9)  # head of the T-nut
    tee_neck: float = 14  # width of its neck along x
    tee_neck_height: float = 8
    tee_drop: float = 1.5  # of the neck's top below the table
    engage: float = 15  # of the stud in the T-nut, from its top
    strap: tuple[float, float, float] = (125, 38, 20)
    strap_x: float = 5  # of its middle from the stud
    strap_slot: tuple[float, float] = (60, 14)
    slot_x: float = -4  # of the slot's middle from the stud
    nose: float = 10  # height of the nose's end face
    nose_run: float = 28  # length of the nose's slope, along x
    steps: int = 6
    rise: float = 9  # of every step
    run: float = 8  # of every step
    step_width: float = 32
    on: int = 4  # the strap's heel stands on this step, from below
    cup: float = 27  # washer
    cup_bore: float = 13.5
    cup_thick: float = 6
    flange: float = 25
    flange_thick: float = 4
    hexagon: float = 18  # across flats
    nut: float = 20  # height over all


def build(p: P) -> Compound:
    """Puts the six pieces together, the T-nut in an unseen slot of the table."""
    neck_top = -p.tee_drop
    tee = block((p.tee_neck, p.tee[1], p.tee_neck_height), (0, 0, neck_top - p.tee_neck_height))
    tee += block(p.tee, (0, 0, neck_top - p.tee_neck_height - p.tee[2]))
    tee -= rod(p.thread, p.tee_neck_height + p.tee[2], (0, 0, neck_top), DOWN)
    stud = rod(p.thread, p.stud, (0, 0, neck_top - p.engage))
    under = p.on * p.rise
    x, y, z = p.strap
    left, right = p.strap_x - x / 2, p.strap_x + x / 2
    side = Polygon(
        (left, 0), (right, 0), (right, p.nose), (right - p.nose_run, z), (left, z), align=None
    )
    strap = extrude(Plane((0, y / 2, under), x_dir=(1, 0, 0), z_dir=(0, -1, 0)) * side, amount=y)
    strap -= slot(*p.strap_slot, z, (p.slot_x, 0, under + z), DOWN)
    stairs = [(left + (p.on - p.steps) * p.run, 0.0), (left + p.on * p.run, 0.0)]
    for step in range(1, p.steps + 1):  # the next step's riser touches the strap's end
        stairs += [(left + (p.on - step + 1) * p.run, step * p.rise), (left + (p.on - step) * p.run, step * p.rise)]
    outline = Polygon(*stairs, align=None)
    steps = extrude(Plane((0, p.step_width / 2, 0), x_dir=(1, 0, 0), z_dir=(0, -1, 0)) * outline, amount=p.step_width)
    seat = under + z
    cup = rod(p.cup, p.cup_thick, (0, 0, seat)) - rod(p.cup_bore, p.cup_thick, (0, 0, seat))
    nut = rod(p.flange, p.flange_thick, (0, 0, seat + p.cup_thick))
    nut += prism(p.hexagon, p.nut, (0, 0, seat + p.cup_thick))
    nut -= rod(p.thread, p.nut, (0, 0, seat + p.cup_thick))
    return assembly(
        [
            named(tee, "T-nut", "dimgray"),
            named(stud, "Stud M12", "silver"),
            named(strap, "Strap", "royalblue"),
            named(steps, "Step block", "darkorange"),
            named(cup, "Dished washer", "gold"),
            named(nut, "Flange nut", "seagreen"),
        ]
    )
