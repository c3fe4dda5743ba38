"""A turned infeed roller: drum with two round-belt grooves, stepped journals, circlip grooves, keyed drive end."""

from __future__ import annotations

from dataclasses import dataclass

from benchmark.kit import Model
from benchmark.shapes import BACK, FRONT, drill, rod, slot
from build123d import Align, Axis, Box, Part, Plane, Pos, Torus, chamfer

MODEL = Model("Infeed roller", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is y, the drum begins at y = 0, the drive end points to +y."""

    drum: float = 52
    drum_length: float = 164
    belt: float = 6  # round belt: the groove is half a circle of this diameter in the drum's skin
    belt_at: tuple[float, float] = (40, 124)  # from the drum's near end
    shoulder: float = 28
    shoulder_length: float = 5
    journal: float = 20
    journal_length: float = 22
    ring: float = 19  # bottom of the circlip groove
    ring_width: float = 1.3
    ring_at: float = 16  # from the shoulder to the groove's near flank
    drive: float = 16
    drive_length: float = 36
    key: float = 5
    key_length: float = 25  # over all, round ends
    key_depth: float = 3
    key_gap: float = 4  # from the end of the shaft
    tap: float = 5  # M6, drive end
    tap_depth: float = 16
    near_tap: float = 6.8  # M8, other end
    near_tap_depth: float = 20
    flat: float = 17  # across two spanner flats on the near end
    flat_length: float = 3
    edge: float = 1
    drum_edge: float = 2


def build(p: P) -> Part:
    """Strings the steps together along y, then cuts grooves, key seat and end holes."""
    drum = rod(p.drum, p.drum_length, (0, 0, 0), BACK)
    body = chamfer(drum.edges(), p.drum_edge)
    for y in p.belt_at:
        ring = Plane(origin=(0, y, 0), x_dir=(1, 0, 0), z_dir=(0, 1, 0)) * Torus(p.drum / 2, p.belt / 2)
        body -= ring
    for sign, at in ((-1, 0.0), (1, p.drum_length)):
        way = BACK if sign > 0 else FRONT
        body += rod(p.shoulder, p.shoulder_length, (0, at, 0), way)
        start = at + sign * p.shoulder_length
        part = rod(p.journal, p.journal_length, (0, start, 0), way)
        outer = part.edges().sort_by(Axis.Y)
        body += chamfer([outer[-1] if sign > 0 else outer[0]], p.edge)
        near = start + sign * p.ring_at
        groove = rod(p.journal + 4, p.ring_width, (0, near, 0), way) - rod(p.ring, p.ring_width, (0, near, 0), way)
        body -= groove
    end = p.drum_length + p.shoulder_length + p.journal_length
    stub = rod(p.drive, p.drive_length, (0, end, 0), BACK)
    body += chamfer([stub.edges().sort_by(Axis.Y)[-1]], p.edge)
    tip = end + p.drive_length
    middle = tip - p.key_gap - p.key_length / 2
    body -= slot(p.key_length, p.key, p.key_depth, (0, middle, p.drive / 2), rotation=90)
    body -= drill(p.tap, p.tap_depth, (0, tip, 0), FRONT)
    low = -p.shoulder_length - p.journal_length
    for sign in (-1, 1):
        body -= Pos(sign * p.flat / 2, low, 0) * Box(
            20, 2 * p.flat_length, 60, align=(Align.MIN if sign > 0 else Align.MAX, Align.CENTER, Align.CENTER)
        )
    body -= drill(p.near_tap, p.near_tap_depth, (0, low, 0), BACK)
    return body
