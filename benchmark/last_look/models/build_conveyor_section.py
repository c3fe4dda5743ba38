"""A short gravity conveyor: two channel rails, three rollers with their axles, a tie bar below."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Compound, Part

from benchmark.kit import Model
from benchmark.shapes import BACK, FRONT, assembly, block, drill, named, rod, slot

MODEL = Model("Conveyor section", "held_out", bodies=6)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the rails run along x and stand on z = 0, the middle is x = y = 0, goods travel along x."""

    rail: tuple[float, float, float] = (480, 38, 100)  # length, flange width with the web, height
    sheet: float = 4
    inside: float = 420  # between the webs' inner faces
    rollers: int = 3
    pitch: float = 150
    roller: float = 60
    roller_length: float = 408
    recess: tuple[float, float] = (46, 6)  # diameter, depth in the rollers' ends
    axle: float = 12
    axle_length: float = 446
    axle_hole: float = 12.5
    axle_z: float = 80
    tie: tuple[float, float] = (30, 25)  # width, height of the bar
    tie_z: float = 15  # of its underside
    tie_x: float = 75
    tap: float = 8.5  # core hole of M10
    tap_depth: float = 22
    tie_hole: float = 10.5  # through the webs
    foot_slot: tuple[float, float] = (22, 9)  # in the lower flanges along x
    foot_slots: int = 2
    foot_pitch: float = 380


def _rail(p: P, side: int) -> Part:
    """One channel; its flanges point outward, to `side` of y."""
    length, flange, height = p.rail
    middle = side * (p.inside + flange) / 2
    rail = block(p.rail, (0, middle, 0))
    rail -= block((length, flange - p.sheet, height - 2 * p.sheet), (0, middle + side * p.sheet / 2, p.sheet))
    into = BACK if side > 0 else FRONT
    face = side * p.inside / 2
    for index in range(p.rollers):
        rail -= rod(p.axle_hole, p.sheet, ((index - (p.rollers - 1) / 2) * p.pitch, face, p.axle_z), into)
    rail -= rod(p.tie_hole, p.sheet, (p.tie_x, face, p.tie_z + p.tie[1] / 2), into)
    for index in range(p.foot_slots):
        x = (index - (p.foot_slots - 1) / 2) * p.foot_pitch
        rail -= slot(*p.foot_slot, p.sheet, (x, middle + side * p.sheet / 2, p.sheet))
    return rail


def build(p: P) -> Compound:
    """Sets the rollers and the tie bar between the rails."""
    parts = [named(_rail(p, -1), "front rail", "royalblue"), named(_rail(p, 1), "rear rail", "royalblue")]
    for index in range(p.rollers):
        x = (index - (p.rollers - 1) / 2) * p.pitch
        roller = rod(p.roller, p.roller_length, (x, -p.roller_length / 2, p.axle_z), BACK)
        for side, into in ((-1, BACK), (1, FRONT)):
            roller -= rod(p.recess[0], p.recess[1], (x, side * p.roller_length / 2, p.axle_z), into)
        roller += rod(p.axle, p.axle_length, (x, -p.axle_length / 2, p.axle_z), BACK)
        parts.append(named(roller, f"roller {index + 1}", "silver"))
    tie = block((p.tie[0], p.inside, p.tie[1]), (p.tie_x, 0, p.tie_z))
    for side, into in ((-1, BACK), (1, FRONT)):
        tie -= drill(p.tap, p.tap_depth, (p.tie_x, side * p.inside / 2, p.tie_z + p.tie[1] / 2), into)
    parts.append(named(tie, "tie bar", "darkorange"))
    return assembly(parts)
