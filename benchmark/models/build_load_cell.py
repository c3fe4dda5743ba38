"""A bending-beam load cell in inches: two flexure holes, mounting pad, tapped loading end, cable stub, name plate."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Part

from benchmark.kit import INCH, Item, Model, count, length, lengths, size
from benchmark.shapes import BACK, DOWN, LEFT, RIGHT, block, drill, rod

MODEL = Model("Bending-beam load cell", "dev", unit="in")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres from inches; the beam runs along x, its middle is x = y = 0, its underside lies on z = 0."""

    beam: tuple[float, float, float] = (5.5 * INCH, 1.25 * INCH, 1.25 * INCH)
    flexure: float = 0.7 * INCH  # holes through the beam along y
    flexure_x: float = 0.5 * INCH
    pad: tuple[float, float, float] = (1.75 * INCH, 1 * INCH, 0.125 * INCH)  # below the fixed end
    fixing: float = 0.28125 * INCH  # for 1/4
    fixing_head: float = 0.4375 * INCH
    fixing_head_depth: float = 0.25 * INCH
    fixing_x: tuple[float, float] = (-2.25 * INCH, -1.5 * INCH)
    load: float = 0.201 * INCH  # core hole of 1/4-20 UNC
    load_depth: float = 0.75 * INCH
    load_x: tuple[float, float] = (1.5 * INCH, 2.3 * INCH)
    stub: float = 0.5 * INCH
    stub_length: float = 0.375 * INCH
    cable: float = 0.25 * INCH
    cable_depth: float = 0.5 * INCH
    plate: tuple[float, float, float] = (1 * INCH, 0.0625 * INCH, 0.5 * INCH)  # milled into the front
    plate_x: float = 1.875 * INCH


def build(p: P) -> Part:
    """Saws the bar, adds pad and stub, drills, mills."""
    width, depth, height = p.beam
    middle, left = height / 2, -width / 2
    pad_x = sum(p.fixing_x) / 2
    body = block(p.beam) + block(p.pad, (pad_x, 0, -p.pad[2]))
    body += rod(p.stub, p.stub_length, (left, 0, middle), LEFT)
    body -= rod(p.cable, p.cable_depth, (left - p.stub_length, 0, middle), RIGHT)
    body -= [rod(p.flexure, depth, (x, -depth / 2, middle), BACK) for x in (-p.flexure_x, p.flexure_x)]
    body -= [rod(p.fixing, height + p.pad[2], (x, 0, -p.pad[2])) for x in p.fixing_x]
    body -= [rod(p.fixing_head, p.fixing_head_depth, (x, 0, height), DOWN) for x in p.fixing_x]
    body -= [drill(p.load, p.load_depth, (x, 0, height)) for x in p.load_x]
    return body - block(p.plate, (p.plate_x, (p.plate[1] - depth) / 2, middle - p.plate[2] / 2))


def questions(p: P) -> list[Item]:
    """Asked in the plain way, and by an American test engineer, a fitter and a strain-gauge maker."""
    return [
        count("blind hole", "How many blind holes are visible from the top?", 2),
        lengths("blind hole", "diameter", "What is the diameter of the blind holes on the top?", [p.load] * 2),
        lengths("blind hole", "depth", "How deep are the blind holes on the top?", [p.load_depth] * 2),
        lengths(
            "through hole",
            "radius",
            "What is the radius of the through holes visible from the front?",
            [p.flexure / 2] * 2,
        ),
        length(
            "rectangular protrusion",
            "height",
            "What is the height of the rectangular protrusion on the bottom?",
            p.pad[2],
        ),
        size("rectangular indentation", "What is the size of the rectangular indentation on the front?", p.plate),
        length("blind hole", "depth", "What is the depth of the hole visible from the left?", p.cable_depth),
        lengths("mounting hole", "diameter", "counterbore dia on the mounting holes?", [p.fixing_head] * 2),
        length(
            "mounting hole",
            "distance",
            "Center-to-center distance between the two counterbored mounting holes",
            p.fixing_x[1] - p.fixing_x[0],
        ),
        lengths("mounting hole", "depth", "how deep are the counterbores", [p.fixing_head_depth] * 2),
        length(
            "circular protrusion",
            "diameter",
            "What's the O.D. of the round stub at the left end, where the cable goes in?",
            p.stub,
        ),
        length(
            "object",
            "length",
            "I need the overall length of the sensor incl. the cable stub.",
            p.beam[0] + p.stub_length,
        ),
        length(
            "object",
            "height",
            "How high is the load cell if you leave out the mounting pad underneath?",
            p.beam[2],
        ),
        length(
            "threaded hole",
            "distance",
            "Spacing of the tapped holes at the loading end, please",
            p.load_x[1] - p.load_x[0],
        ),
    ]
