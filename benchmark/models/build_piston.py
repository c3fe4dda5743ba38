"""A piston, stored as B-splines: three ring grooves, bowl in the crown, pin bosses, oil holes, round skirt cutouts."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Part

from benchmark.kit import Form, Item, Model, count, length, lengths
from benchmark.shapes import BACK, DOWN, RIGHT, circle, rod

MODEL = Model("Piston", "dev", Form.BSPLINE)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is z, the skirt ends at z = 0, the gudgeon pin runs along x."""

    bore: float = 80
    height: float = 65
    inner: float = 66
    inner_depth: float = 52  # from below
    bowl: float = 40
    bowl_depth: float = 6
    groove_depth: float = 3.5
    grooves: tuple[tuple[float, float], ...] = ((56, 2), (50.5, 2), (44, 3))  # lower flank on z, width
    oils: int = 4  # holes in the lowest groove
    oil: float = 2
    boss: float = 34
    boss_gap: float = 26
    pin: float = 20
    pin_z: float = 26
    skirt: float = 15  # radius of the cutouts at front and back


def build(p: P) -> Part:
    """Turns and hollows, adds the bosses inside, drills, mills."""
    body = rod(p.bore, p.height) - rod(p.inner, p.inner_depth)
    reach = (p.bore - p.boss_gap) / 2
    bosses = rod(p.boss, reach, (p.boss_gap / 2, 0, p.pin_z), RIGHT)
    bosses += rod(p.boss, reach, (-p.bore / 2, 0, p.pin_z), RIGHT)
    body += bosses & rod((p.bore + p.inner) / 2, p.height)
    body -= rod(p.bowl, p.bowl_depth, (0, 0, p.height), DOWN)
    for z, width in p.grooves:
        body -= rod(p.bore, width, (0, 0, z)) - rod(p.bore - 2 * p.groove_depth, width, (0, 0, z))
    body -= rod(p.pin, p.bore, (-p.bore / 2, 0, p.pin_z), RIGHT)
    body -= rod(2 * p.skirt, p.bore, (0, -p.bore / 2, 0), BACK)
    z, width = p.grooves[-1]
    starts = circle(p.oils, p.inner - 4, 45)
    return body - [rod(p.oil, p.bore / 2, (x, y, z + width / 2), (x / p.inner, y / p.inner, 0)) for x, y in starts]


def questions(p: P) -> list[Item]:
    """Asked in the plain way, and by an engine tuner, a lathe operator and a foreign trainee."""
    return [
        length("object", "diameter", "What is the diameter of the object?", p.bore),
        length("object", "height", "What is the total height of the object?", p.height),
        count("groove", "How many circumferential grooves does the object have?", len(p.grooves)),
        lengths("groove", "depth", "What is the depth of the grooves?", [p.groove_depth] * len(p.grooves)),
        length("hole", "diameter", "What is the diameter of the hole visible from the right?", p.pin),
        length("semicircle", "radius", "What is the radius of the semicircle visible from the front?", p.skirt),
        length("blind hole", "depth", "What is the depth of the round recess on the top?", p.bowl_depth),
        length("blind hole", "diameter", "bowl diameter in the crown?", p.bowl),
        length(
            "through hole",
            "distance",
            "How far below the top of the crown is the axis of the gudgeon pin hole?",
            p.height - p.pin_z,
        ),
        lengths("groove", "width", "How wide are the ring grooves, one by one?", [width for _, width in p.grooves]),
        length("tube", "thickness", "wall thickness of the skirt", (p.bore - p.inner) / 2),
        count("hole", "How much oil holes of 2 mm are drilled into the lowest ring groove?", p.oils),
        length("tube", "diameter", "Inside diameter of the skirt, looking in from underneath?", p.inner),
        length(
            "circular protrusion",
            "distance",
            "What's the gap between the two pin bosses, so that I know how wide the con-rod may be?",
            p.boss_gap,
        ),
    ]
