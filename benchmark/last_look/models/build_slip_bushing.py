"""A slip renewable drill bushing in inches: relieved guide bore, lock recess and release notch, chip slots."""

from __future__ import annotations

import math
from dataclasses import dataclass

from build123d import Part

from benchmark.kit import INCH, Model
from benchmark.shapes import DOWN, block, cone, rod

MODEL = Model("Slip renewable drill bushing", "held_out")  # inches by its dimensions; the file is written in mm


@dataclass(frozen=True, slots=True)
class P:
    """Inches; the axis is z, the nose stands on z = 0, the head is on top."""

    body: float = 3 / 4
    reach: float = 1 + 3 / 8  # length under the head
    head: float = 1 + 1 / 4
    head_height: float = 1 / 2
    bore: float = 13 / 32  # guide
    guide: float = 3 / 4  # length of the guide bore from the nose
    relief: float = 29 / 64  # bore above the guide
    sink: float = 5 / 8  # 90 degree countersink in the head
    nose: float = 11 / 16  # diameter at the very end
    nose_length: float = 1 / 8  # of the lead-in cone
    groove: float = 45 / 64  # diameter under the head
    groove_width: float = 1 / 16
    lock: float = 5 / 8  # diameter of the cutter for lock recess and release notch
    lock_pitch: float = 13 / 16  # of the cutter's axis from the bushing's
    lock_depth: float = 7 / 32  # of the recess below the head's top
    lock_angle: float = 65  # degrees from the recess (on +x) to the notch
    slot: float = 5 / 32  # width of the two chip slots across the nose
    slot_depth: float = 1 / 4


def build(p: P) -> Part:
    """Turns along z, then mills the head's rim and the nose."""
    top = p.reach + p.head_height
    i = INCH
    body = cone(p.nose * i, p.body * i, p.nose_length * i)
    body += rod(p.body * i, (p.reach - p.nose_length - p.groove_width) * i, (0, 0, p.nose_length * i))
    body += rod(p.groove * i, p.groove_width * i, (0, 0, (p.reach - p.groove_width) * i))
    body += rod(p.head * i, p.head_height * i, (0, 0, p.reach * i))
    body -= rod(p.bore * i, p.guide * i)
    body -= rod(p.relief * i, (top - p.guide) * i, (0, 0, p.guide * i))
    body -= cone(p.sink * i, 0, p.sink / 2 * i, (0, 0, top * i), DOWN)
    body -= rod(p.lock * i, p.lock_depth * i, (p.lock_pitch * i, 0, top * i), DOWN)
    a = math.radians(p.lock_angle)
    body -= rod(p.lock * i, p.head_height * i, (p.lock_pitch * i * math.cos(a), p.lock_pitch * i * math.sin(a), top * i), DOWN)
    body -= block((p.slot * i, p.body * i, p.slot_depth * i))
    return body
