"""One throw of a crankshaft: journals, two webs, the pin with its oil hole, a taper and a threaded end."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Part

from benchmark.kit import Item, Model, count, exists, length, lengths, point, size
from benchmark.shapes import DOWN, FRONT, LEFT, RIGHT, block, cone, drill, rod, slot

MODEL = Model("Crankshaft with one throw", "dev")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the journals' axis is x, the pin's middle x = 0, its axis above the journals'."""

    pin: float = 26
    pin_length: float = 28
    throw: float = 25
    web: float = 50  # width; both ends are round
    web_thickness: float = 14
    journal: float = 30
    left_length: float = 40
    right_length: float = 45
    taper: float = 20  # length
    taper_end: float = 22
    stud: float = 12
    stud_length: float = 16
    center: float = 8.5  # core hole of M10
    center_depth: float = 22
    oil: float = 4
    key: tuple[float, float, float] = (25, 8, 4)  # length, width, depth
    key_x: float = 50.5

    @property
    def web_end(self) -> float:
        """Where on x does the right web end?"""
        return self.pin_length / 2 + self.web_thickness


def build(p: P) -> Part:
    """Forges webs, pin and journals, then drills and mills."""
    x = p.web_end
    body = rod(p.pin, p.pin_length, (-p.pin_length / 2, 0, p.throw), RIGHT)
    for start in (-x, p.pin_length / 2):
        body += block((p.web_thickness, p.web, p.throw), (start + p.web_thickness / 2, 0, 0))
        body += [rod(p.web, p.web_thickness, (start, 0, z), RIGHT) for z in (0, p.throw)]
    body += rod(p.journal, p.left_length, (-x, 0, 0), LEFT)
    body += rod(p.journal, p.right_length, (x, 0, 0), RIGHT)
    x += p.right_length
    body += cone(p.journal, p.taper_end, p.taper, (x, 0, 0), RIGHT)
    body += rod(p.stud, p.stud_length, (x + p.taper, 0, 0), RIGHT)
    body -= drill(p.center, p.center_depth, (-p.web_end - p.left_length, 0, 0), RIGHT)
    body -= rod(p.oil, p.pin, (0, p.pin / 2, p.throw), FRONT)
    return body - slot(p.key[0], p.key[1], p.key[2], (p.key_x, 0, p.journal / 2), DOWN)


def questions(p: P) -> list[Item]:
    """Asked by engine people, a grinder, a measuring technician and students."""
    left = -p.web_end - p.left_length
    right = p.web_end + p.right_length + p.taper + p.stud_length
    return [
        length("cylinder", "diameter", "What is the diameter of the cylinder between the two crank webs?", p.pin),
        length("cylinder", "length", "How long is the crank pin between the webs?", p.pin_length),
        length("shaft", "length", "Length of the shaft journal on the left side", p.left_length),
        length("shaft", "radius", "Which radius have the shaft at the left end?", p.journal / 2),
        length(
            "semicircle", "radius", "The webs are rounded at their upper and lower ends - one radius, which?", p.web / 2
        ),
        lengths("rectangular part", "thickness", "how thick are the two crank webs along x", [p.web_thickness] * 2),
        length("cone", "height", "How long is the tapered (conical) section in axial direction?", p.taper),
        length("cone", "diameter", "Smaller diameter of the cone?", p.taper_end),
        length("rod", "diameter", "The thinnest cylinder at the right end, how thick is it in diameter?", p.stud),
        length("rod", "length", "Whats the length of the threaded stub on the far right", p.stud_length),
        count("blind hole", "How many blind holes does the crankshaft have?", 1),
        length("blind hole", "depth", "How deep was the blind hole drilled, seen from the left?", p.center_depth),
        length("through hole", "diameter", "What diameter has the oil hole across the crank pin?", p.oil),
        point("through hole", "Position of the centre of the through hole, please.", (0, 0, p.throw)),
        exists("slot", "Is there a keyway on the shaft?", True),
        length("slot", "length", "Keyway length on the right journal (over the round ends)?", p.key[0]),
        length("slot", "width", "And how wide is this keyway on the top?", p.key[1]),
        count("hole", "How many holes are visible when looking from the back?", 1),
        size(
            "object",
            "Please give overall dimensions of the crankshaft.",
            (right - left, p.web, p.web + p.throw),
            "size",
        ),
    ]
