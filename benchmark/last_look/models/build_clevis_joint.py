"""A pinned joint of a cylinder rod: fork, eye with bush, pin, washer and split pin."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Compound

from benchmark.kit import Model
from benchmark.shapes import BACK, FRONT, LEFT, RIGHT, assembly, block, named, rod

MODEL = Model("Clevis joint", "held_out", bodies=6)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the pin's axis is y, through x = z = 0; the fork lies at -x, the eye's shank at +x."""

    ear: float = 16  # thickness of a fork's ear
    gap: float = 32  # between the ears
    ear_w: float = 56  # height of an ear, its end is round
    hole: float = 28.2  # through the ears and the bush
    gap_bottom: float = 36  # from the pin's axis
    bridge: float = 26  # thickness of the fork behind the gap
    boss_d: float = 50
    boss_l: float = 38
    thread_d: float = 26.5  # core hole of M30 in the boss
    thread_depth: float = 45
    eye_d: float = 62
    eye: float = 30  # thickness
    bush_d: float = 34  # outside
    shank_d: float = 27
    shank_end: float = 110  # from the pin's axis
    grease_d: float = 6  # from the eye's top to the bush
    pin_d: float = 28
    head_d: float = 40
    head: float = 8
    pin_l: float = 80  # under the head
    washer_d: float = 44
    washer_hole: float = 29
    washer: float = 4
    split_hole: float = 5.5
    split_d: float = 5
    split_l: float = 48
    split_head_d: float = 9
    split_head: float = 3
    split_gap: float = 1  # from the washer to the split pin's hole


def build(p: P) -> Compound:
    """Makes the pieces and puts them together."""
    over = p.gap + 2 * p.ear
    back = p.gap_bottom + p.bridge
    fork = rod(p.ear_w, over, (0, -over / 2, 0), BACK)
    fork += block((back, over, p.ear_w), (-back / 2, 0, -p.ear_w / 2))
    fork -= block((p.gap_bottom + p.ear_w, p.gap, p.ear_w), (p.ear_w / 2 - p.gap_bottom / 2, 0, -p.ear_w / 2))
    fork += rod(p.boss_d, p.boss_l, (-back, 0, 0), LEFT)
    fork -= rod(p.thread_d, p.thread_depth, (-back - p.boss_l, 0, 0), RIGHT)
    fork -= rod(p.hole, over, (0, -over / 2, 0), BACK)
    eye = rod(p.eye_d, p.eye, (0, -p.eye / 2, 0), BACK)
    shank = rod(p.shank_d, p.shank_end, (0, 0, 0), RIGHT)
    eye += shank
    eye -= rod(p.bush_d, 2 * p.eye, (0, -p.eye, 0), BACK)
    eye -= rod(p.grease_d, p.eye_d / 2, (0, 0, 0))
    bush = rod(p.bush_d, p.eye, (0, -p.eye / 2, 0), BACK) - rod(p.hole, p.eye, (0, -p.eye / 2, 0), BACK)
    pin = rod(p.head_d, p.head, (0, -over / 2, 0), FRONT) + rod(p.pin_d, p.pin_l, (0, -over / 2, 0), BACK)
    at = over / 2 + p.washer + p.split_gap + p.split_hole / 2
    pin -= rod(p.split_hole, p.pin_d, (0, at, -p.pin_d / 2))
    washer = rod(p.washer_d, p.washer, (0, over / 2, 0), BACK) - rod(p.washer_hole, p.washer, (0, over / 2, 0), BACK)
    top = p.pin_d / 2
    split = rod(p.split_d, p.split_l, (0, at, top - p.split_l)) + rod(p.split_head_d, p.split_head, (0, at, top))
    return assembly(
        [
            named(fork, "Fork", "slategray"),
            named(eye, "Eye", "steelblue"),
            named(bush, "Bush", "goldenrod"),
            named(pin, "Pin", "firebrick"),
            named(washer, "Washer", "silver"),
            named(split, "Split pin", "limegreen"),
        ]
    )
