"""A chuck's face plate: circular base with radial slots in its top and a central threaded hole."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Part, Rot

from benchmark.kit import Item, Model, count, length, lengths, point, size
from benchmark.shapes import block, circle, rod

MODEL = Model("Chuck disc with radial slots", "dev")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is z, the circular base lies on z = 0, the slotted disc above it."""

    base: float = 120
    base_height: float = 8
    disc: float = 96
    disc_height: float = 14
    slots: int = 9
    slot_width: float = 5
    slot_depth: float = 6
    slot_start: float = 20  # radius at which the slots begin; they run out at the disc's edge
    thread: float = 10.2  # tap drill of M12
    screws: int = 3
    screw_hole: float = 6.6
    screw_circle: float = 108

    @property
    def top(self) -> float:
        """Of the disc."""
        return self.base_height + self.disc_height


def build(p: P) -> Part:
    """Turns base and disc, mills the slots, drills."""
    body = rod(p.base, p.base_height) + rod(p.disc, p.disc_height, (0, 0, p.base_height))
    reach = p.disc / 2 - p.slot_start + 2
    cutter = block((reach, p.slot_width, p.slot_depth), (p.slot_start + reach / 2, 0, p.top - p.slot_depth))
    tools = [Rot(0, 0, 360 * index / p.slots) * cutter for index in range(p.slots)]
    tools.append(rod(p.thread, p.top))
    tools += [rod(p.screw_hole, p.base_height, (x, y, 0)) for x, y in circle(p.screws, p.screw_circle, 60)]
    return body - tools


def questions(p: P) -> list[Item]:
    """Asked by lathe operators."""
    total = p.top
    return [
        count("radial slots", "How many radial slots are milled into the top surface?", p.slots),
        lengths("radial slots", "width", "What width do the radial slots have?", [p.slot_width] * p.slots),
        lengths(
            "radial slots", "depth", "How deep are the radial slots, from the top face down?", [p.slot_depth] * p.slots
        ),
        length("circular base", "diameter", "What is the outer diameter of the circular base?", p.base),
        length("circular base", "radius", "Which radius does the circular base have?", p.base / 2),
        length(
            "circular base",
            "thickness",
            "How thick is the circular base, so the larger of the two discs?",
            p.base_height,
        ),
        length("cylinder", "diameter", "What's the diameter of the slotted cylinder on the base?", p.disc),
        length("threaded hole", "diameter", "What is the core diameter of the threaded hole in the middle?", p.thread),
        length(
            "threaded hole", "depth", "The tapped hole in the middle goes all the way through. How deep is it?", total
        ),
        point("threaded hole", "Tell me the centre point of the threaded hole in the middle.", (0, 0, total / 2)),
        count("mounting hole", "How many 6.6 mm mounting holes are in the rim of the base?", p.screws),
        lengths(
            "mounting hole",
            "radius",
            "What are the radii of the holes with a diameter of 6.6 mm?",
            [p.screw_hole / 2] * p.screws,
        ),
        lengths(
            "hole",
            "diameter",
            "Name the different diameters of the holes visible from the bottom.",
            sorted({p.thread, p.screw_hole}),
        ),
        length("object", "height", "What is the total height of the object?", total),
        size("object", "How big is the object in x, y and z?", (p.base, p.base, total)),
    ]
