"""A reducing pipe tee in inches: two equal flanges on the run, a smaller one with raised face above, a drain boss."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, sin

from build123d import Part

from benchmark.kit import INCH, Item, Model, count, exists, length, lengths, point, size
from benchmark.shapes import RIGHT, circle, rod

MODEL = Model("Reducing pipe tee with three flanges", "dev", unit="in")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres from inches; the run lies along x through the origin, the branch points up."""

    run: float = 3.5 * INCH  # nominal pipe size 3 (ASME B36.10)
    run_bore: float = 3.068 * INCH  # schedule 40
    run_length: float = 11 * INCH  # face to face
    flange: float = 7.5 * INCH
    thickness: float = 0.75 * INCH
    bolts: int = 4
    bolt: float = 0.75 * INCH
    bolt_circle: float = 6 * INCH
    branch: float = 1.9 * INCH  # nominal pipe size 1 1/2 (ASME B36.10)
    branch_bore: float = 1.61 * INCH  # schedule 40
    branch_height: float = 5.25 * INCH  # of the raised face above the run's axis
    top: float = 5 * INCH
    top_thickness: float = 0.5625 * INCH  # without the raised face
    top_bolts: int = 4
    top_bolt: float = 0.625 * INCH
    top_circle: float = 3.875 * INCH
    face: float = 2.875 * INCH
    face_height: float = 0.0625 * INCH
    boss: float = 1.25 * INCH
    boss_reach: float = 2.375 * INCH  # of its end below the run's axis
    drain: float = 0.578125 * INCH  # core hole of 3/8-18 NPT


def build(p: P) -> Part:
    """Welds three pipes and three flanges, then bores."""
    left, rim = -p.run_length / 2, p.branch_height - p.face_height
    body = rod(p.run, p.run_length, (left, 0, 0), RIGHT) + rod(p.branch, p.branch_height)
    body += [rod(p.flange, p.thickness, (x, 0, 0), RIGHT) for x in (left, -left - p.thickness)]
    body += rod(p.top, p.top_thickness, (0, 0, rim - p.top_thickness)) + rod(p.face, p.face_height, (0, 0, rim))
    body += rod(p.boss, p.boss_reach, (0, 0, -p.boss_reach))
    body -= rod(p.run_bore, p.run_length, (left, 0, 0), RIGHT)
    body -= rod(p.branch_bore, p.branch_height) + rod(p.drain, p.boss_reach, (0, 0, -p.boss_reach))
    for x in (left, -left - p.thickness):
        body -= [rod(p.bolt, p.thickness, (x, y, z), RIGHT) for y, z in circle(p.bolts, p.bolt_circle, 45)]
    return body - [
        rod(p.top_bolt, p.top_thickness, (x, y, rim - p.top_thickness))
        for x, y in circle(p.top_bolts, p.top_circle, 45)
    ]


def questions(p: P) -> list[Item]:
    """Asked by a fitter in a hurry, a purchasing clerk, a stress analyst and a trainee."""
    return [
        length("tube", "diameter", "run pipe OD in inch (the horizontal one)", p.run),
        length("tube", "diameter", "horizontal pipe - inside dia?", p.run_bore),
        length(
            "tube",
            "thickness",
            "What wall thickness does the vertical branch pipe have?",
            (p.branch - p.branch_bore) / 2,
        ),
        length("tube", "length", "face to face length of the run, left flange to right flange, thx", p.run_length),
        length(
            "flange",
            "distance",
            "For the isometric I need the centre-to-face dimension of the branch. How far is it from the centre line "
            "of the run up to the top face of the branch?",
            p.branch_height,
        ),
        count(
            "mounting hole",
            "Dear colleague, I have to order the bolts. How many bolt holes do the three flanges have together?",
            2 * p.bolts + p.top_bolts,
        ),
        count("mounting hole", "looking from the top, how many bolt holes do you see?", p.top_bolts),
        length("mounting hole", "diameter", "bolt circle dia of the small flange on top", p.top_circle),
        lengths(
            "mounting hole",
            "diameter",
            "What are the diameters of the bolt holes in the left flange?",
            [p.bolt] * p.bolts,
        ),
        length(
            "mounting hole",
            "distance",
            "In the right flange, how far is one bolt hole from the next one, center to center in a straight line?",
            p.bolt_circle * sin(pi / p.bolts),
        ),
        length("flange", "diameter", "[BOM pos. 3] diameter of the smallest flange", p.top),
        length("circular protrusion", "height", "How high is the raised face of the top flange?", p.face_height),
        length(
            "threaded hole",
            "diameter",
            "There's a short boss for the drain at the underside. What diameter is the hole in it?",
            p.drain,
        ),
        point(
            "flange",
            "where is the center of the flange at the left end of the run (x y z)",
            ((p.thickness - p.run_length) / 2, 0, 0),
        ),
        count("hole", "how many holes with 3/4 inch diameter has the fitting", 2 * p.bolts),
        exists("slot", "Does any one of the flanges have slots instead of round bolt holes?", False),
        size(
            "object",
            "What box would it just fit into? I mean the overall dimensions along x, y and z.",
            (p.run_length, p.flange, p.flange / 2 + p.branch_height),
        ),
    ]
