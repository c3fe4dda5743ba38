"""A roller lever: two-armed lever with a bushed pivot, a fork with roller and headed pin, a spring eye and a stop tap."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Circle, Compound, Polygon, Pos, Rot, extrude

from benchmark.kit import Model
from benchmark.shapes import BACK, FRONT, assembly, block, named, rod

MODEL = Model("Roller lever", "held_out", bodies=4)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the pivot's axis is z, z = 0 the middle of the thickness, the roller lies towards +x."""

    plate: float = 20
    boss: float = 46
    boss_height: float = 32
    arm: float = 125  # pivot to roller
    tip: float = 28  # width of the fork's round end
    short: float = 70  # pivot to spring eye
    short_angle: float = 120  # between the arms
    short_tip: float = 26
    eye: float = 8.5
    bush: float = 26
    bush_bore: float = 20
    bush_length: float = 36  # centred
    fork: float = 10.4  # width of the fork's gap
    fork_depth: float = 24  # from the roller's axis back towards the pivot
    roller: float = 38
    roller_width: float = 10
    roller_bore: float = 8.2
    pin: float = 8
    pin_low: float = 13  # from the middle down to its lower end
    head: float = 13
    head_height: float = 3  # on the fork's upper side
    oil: float = 5  # from the pivot's boss, side y < 0, through the bush too
    stop: float = 6.8  # core hole M8 through the long arm along y
    stop_x: float = 66
    relief: float = 14  # hole through the long arm along z
    relief_x: float = 43


def _tapered(reach: float, small: float, big: float):
    sine = (big - small) / 2 / reach
    cosine = (1 - sine**2) ** 0.5
    b, s = big / 2, small / 2
    return Polygon(
        (b * sine, b * cosine), (b * sine, -b * cosine), (reach + s * sine, -s * cosine), (reach + s * sine, s * cosine),
        align=None,
    ) + _disc(small, reach)


def _disc(diameter: float, x: float):
    return Pos(x, 0) * Circle(diameter / 2)


def build(p: P) -> Compound:
    """The lever with its machining, then bush, roller and pin."""
    low = -p.plate / 2
    outline = Circle(p.boss / 2) + _tapered(p.arm, p.tip, p.boss) + Rot(0, 0, p.short_angle) * _tapered(p.short, p.short_tip, p.boss)
    lever = Pos(0, 0, low) * extrude(outline, amount=p.plate)
    lever += rod(p.boss, p.boss_height, (0, 0, -p.boss_height / 2))
    lever -= rod(p.bush, p.boss_height, (0, 0, -p.boss_height / 2))
    lever -= block((p.fork_depth + p.tip, p.tip * 2, p.fork), (p.arm + (p.tip - p.fork_depth) / 2, 0, -p.fork / 2))
    lever -= rod(p.pin, p.plate, (p.arm, 0, low))
    eye = Rot(0, 0, p.short_angle) * rod(p.eye, p.plate, (p.short, 0, low))
    lever -= eye
    lever -= rod(p.stop, 4 * p.tip, (p.stop_x, -2 * p.tip, 0), BACK)
    lever -= rod(p.relief, p.plate, (p.relief_x, 0, low))
    lever -= rod(p.oil, p.boss, (0, 0, 0), FRONT)
    bush = rod(p.bush, p.bush_length, (0, 0, -p.bush_length / 2)) - rod(p.bush_bore, p.bush_length, (0, 0, -p.bush_length / 2))
    bush -= rod(p.oil, p.boss, (0, 0, 0), FRONT)
    base = (p.arm, 0, -p.roller_width / 2)
    roller = rod(p.roller, p.roller_width, base) - rod(p.roller_bore, p.roller_width, base)
    pin = rod(p.pin, p.pin_low - low, (p.arm, 0, -p.pin_low)) + rod(p.head, p.head_height, (p.arm, 0, -low))
    return assembly(
        [named(lever, "lever", "steelblue"), named(bush, "pivot_bush", "goldenrod"), named(roller, "roller", "silver"), named(pin, "roller_pin", "dimgray")]
    )
