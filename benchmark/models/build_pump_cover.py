"""A pump's cover drawn in inches: round plate with a boss, a stuffing-box bore, stud holes and jacking screws."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Part

from benchmark.kit import INCH, Item, Model, count, length, lengths, point, size
from benchmark.shapes import DOWN, LEFT, circle, rod

MODEL = Model("Pump cover", "dev", unit="in")


@dataclass(frozen=True, slots=True)
class P:
    """Inches turned into millimetres; the axis is x, the plate begins at x = 0, the boss lies to its right."""

    plate: float = 8 * INCH
    thickness: float = 0.75 * INCH
    boss: float = 4 * INCH
    boss_height: float = 1.25 * INCH
    bore: float = 1.5 * INCH
    box: float = 2.5 * INCH  # stuffing box, from the right
    box_depth: float = 1 * INCH
    studs: int = 8
    stud: float = 0.5625 * INCH
    stud_circle: float = 6.75 * INCH
    jacks: int = 2
    jack: float = 0.3125 * INCH  # tap drill of 3/8-16
    jack_circle: float = 5 * INCH
    flush: float = 0.25 * INCH
    flush_x: float = 1.375 * INCH


def build(p: P) -> Part:
    """Bored along x; the flush hole enters the stuffing box from above."""
    right = (1.0, 0.0, 0.0)
    total = p.thickness + p.boss_height
    body = rod(p.plate, p.thickness, along=right) + rod(p.boss, p.boss_height, (p.thickness, 0, 0), right)
    tools = [rod(p.bore, total, along=right), rod(p.box, p.box_depth, (total, 0, 0), LEFT)]
    tools += [rod(p.stud, p.thickness, (0, y, z), right) for y, z in circle(p.studs, p.stud_circle, 22.5)]
    tools += [rod(p.jack, p.thickness, (0, y, z), right) for y, z in circle(p.jacks, p.jack_circle)]
    tools.append(rod(p.flush, p.boss / 2, (p.flush_x, 0, p.boss / 2), DOWN))
    return body - tools


def questions(p: P) -> list[Item]:
    """Asked by maintenance people who think in inches."""
    total = p.thickness + p.boss_height
    return [
        length("circular base", "diameter", "What is the diameter of the round cover plate?", p.plate),
        length("circular base", "thickness", "How thick is the round plate without the boss?", p.thickness),
        length(
            "circular protrusion",
            "diameter",
            "What is the outer diameter of the circular protrusion on the right?",
            p.boss,
        ),
        length(
            "circular protrusion",
            "height",
            "How far does the circular protrusion stick out to the right of the plate?",
            p.boss_height,
        ),
        count("mounting hole", "How many 9/16 inch (14.2875 mm) stud holes are drilled in the plate?", p.studs),
        lengths(
            "mounting hole", "diameter", "Diameters of the stud holes on the 6.75 inch bolt circle?", [p.stud] * p.studs
        ),
        lengths("mounting hole", "depth", "How deep are the eight stud holes?", [p.thickness] * p.studs),
        count(
            "threaded hole", "How many threaded holes with 5/16 inch (7.9375 mm) tap drill diameter are there?", p.jacks
        ),
        length(
            "threaded hole",
            "distance",
            "What is the distance between the centres of the two 5/16 inch holes?",
            p.jack_circle,
        ),
        length("hole", "diameter", "What is the narrow bore diameter of the stepped hole in the middle?", p.bore),
        length("hole", "depth", "How deep is the wide step of the central hole, seen from the right?", p.box_depth),
        point(
            "hole", "Where is the centre of the stepped hole in the middle, half-way along its axis?", (total / 2, 0, 0)
        ),
        length("hole", "diameter", "What is the diameter of the hole that is visible from the top?", p.flush),
        count("hole", "How many holes are visible from the left of the cover?", p.studs + p.jacks + 1),
        size("object", "What is the overall size of the pump cover?", (total, p.plate, p.plate)),
        count("hole", "Seen from the left, how many holes have a diameter of more than half an inch?", p.studs + 1),
    ]
