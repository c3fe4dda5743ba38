"""A stud-type cam follower in inches: stud, roller, needle cage, end plate, nut."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Compound, Part, chamfer, fillet

from benchmark.kit import INCH, Model
from benchmark.shapes import DOWN, RIGHT, assembly, named, prism, rod

MODEL = Model("Cam follower", "held_out", bodies=5)


@dataclass(frozen=True, slots=True)
class P:
    """Inches; axis z, the stud's threaded end at z = 0, the roller on top."""

    roller: float = 1.5  # outside
    roller_width: float = 0.875
    roller_bore: float = 1.0
    roller_edge: float = 0.0625  # radius of the two outer edges
    journal: float = 0.75  # of the stud, under the needles
    head: float = 1.1875
    head_height: float = 0.09375
    plate: float = 1.1875  # end plate
    plate_height: float = 0.09375
    clearance: float = 0.015625  # roller to head and roller to plate, each
    stud: float = 0.625
    stud_length: float = 1.75  # from the thread's end to the end plate
    thread_length: float = 0.8125
    thread_core: float = 0.578125  # the thread is drawn as a plain cylinder of its core
    end_bevel: float = 0.0625
    key: float = 0.3125  # hexagon in the head
    key_depth: float = 0.25
    grease: float = 0.1875  # bore from the threaded end along the axis
    grease_depth: float = 2.375
    cross: float = 0.125  # grease cross hole through the journal
    cage_width: float = 0.75  # needle cage, between journal and roller
    nut: float = 0.9375  # across flats
    nut_height: float = 0.546875
    nut_z: float = 0.15625  # its lower side


def build(p: P) -> Compound:
    """Turns every piece and puts it at its place."""
    i = INCH

    def bar(diameter: float, length: float, z: float) -> Part:
        return rod(diameter * i, length * i, (0, 0, z * i))

    plate_top = p.stud_length + p.plate_height
    roller_low = plate_top + p.clearance
    roller_top = roller_low + p.roller_width
    head_low = roller_top + p.clearance
    middle = (roller_low + roller_top) / 2
    stud = bar(p.thread_core, p.thread_length, 0)
    stud = chamfer(stud.edges().group_by()[0], p.end_bevel * i)
    stud += bar(p.stud, p.stud_length - p.thread_length + p.plate_height, p.thread_length)
    stud += bar(p.journal, head_low - plate_top, plate_top)
    stud += bar(p.head, p.head_height, head_low)
    top = head_low + p.head_height
    stud -= prism(p.key * i, p.key_depth * i, (0, 0, top * i), DOWN)
    stud -= bar(p.grease, p.grease_depth, 0)
    stud -= rod(p.cross * i, 2 * i, (-i, 0, middle * i), RIGHT)
    roller = bar(p.roller, p.roller_width, roller_low)
    roller = fillet(roller.edges(), p.roller_edge * i)
    roller -= bar(p.roller_bore, p.roller_width, roller_low)
    cage = bar(p.roller_bore, p.cage_width, middle - p.cage_width / 2)
    cage -= bar(p.journal, p.cage_width, middle - p.cage_width / 2)
    plate = bar(p.plate, p.plate_height, p.stud_length) - bar(p.stud, p.plate_height, p.stud_length)
    nut = prism(p.nut * i, p.nut_height * i, (0, 0, p.nut_z * i)) - bar(p.thread_core, p.nut_height, p.nut_z)
    return assembly(
        [
            named(stud, "stud", "gray"),
            named(roller, "roller", "silver"),
            named(cage, "needle cage", "gold"),
            named(plate, "end plate", "steelblue"),
            named(nut, "nut", "darkslategray"),
        ]
    )
