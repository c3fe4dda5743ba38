"""A cast iron trench grating: slots that widen downwards, a skirt, a spine, bolt bosses, lifting slots, grip studs."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Part, Pos, SlotOverall, extrude

from benchmark.kit import Model
from benchmark.shapes import DOWN, block, grid, rod, slot

MODEL = Model("Trench grate", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the skirt stands on z = 0, the middle is x = y = 0, people walk on the top."""

    size: tuple[float, float, float] = (500, 250, 40)  # without the studs
    deck: float = 14  # thickness of the top
    skirt: float = 15  # thickness of the rim below the deck
    spine: float = 16  # thickness of the rib along x in the middle
    spine_height: float = 20  # below the deck
    slots: tuple[int, int] = (13, 2)
    slot: tuple[float, float] = (90, 16)  # along y, width; at the top
    slot_draft: float = 3  # each side in degrees, wider below
    pitch: tuple[float, float] = (32, 110)
    stud: float = 8
    stud_height: float = 3
    boss: float = 38  # under the deck, down to z = 0
    bolt: float = 13
    counterbore: float = 24
    counterbore_depth: float = 9
    bolts: float = 436  # between the two, along x
    lift: tuple[float, float] = (40, 12)  # lifting slots along y, width
    lifts: tuple[float, float] = (442, 150)  # offsets between the two, at opposite corners


def build(p: P) -> Part:
    """Casts the grating."""
    x, y, z = p.size
    under = z - p.deck
    body = block(p.size) - block((x - 2 * p.skirt, y - 2 * p.skirt, under))
    body += block((x - 2 * p.skirt, p.spine, p.spine_height), (0, 0, under - p.spine_height))
    ends = [(-p.bolts / 2, 0.0), (p.bolts / 2, 0.0)]
    for at in ends:
        body += rod(p.boss, z, (*at, 0))
    for at in grid(*p.slots, *p.pitch):
        # The extrusion goes down, so the taper is negative: it widens.
        cutter = extrude(
            Pos(*at, z) * SlotOverall(*p.slot, rotation=90), amount=p.deck, dir=(0, 0, -1), taper=-p.slot_draft
        )
        body -= cutter
    for at in ends:
        body -= rod(p.bolt, z, (*at, 0))
        body -= rod(p.counterbore, p.counterbore_depth, (*at, z), DOWN)
    for side in (-1, 1):
        body -= slot(*p.lift, p.deck, (side * p.lifts[0] / 2, -side * p.lifts[1] / 2, z), rotation=90)
    for at in grid(p.slots[0] - 1, p.slots[1], *p.pitch):
        body += rod(p.stud, p.stud_height, (*at, z))
    return body
