"""A bicycle stem, placed obliquely: slotted steerer clamp, beam with a window, half-round handlebar seat."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part

from benchmark.kit import Item, Model, count, exists, length, lengths
from benchmark.shapes import BACK, LEFT, block, drill, grid, rod, slot

MODEL = Model("Bicycle stem in an oblique position", "dev")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; drawn with the steerer's axis along z, the handlebar's along y, then turned about y and z."""

    reach: float = 90  # between the two axes
    steerer: float = 28.6  # outer diameter of an 1 1/8 inch steerer
    collar: float = 38
    collar_height: float = 40
    beam: tuple[float, float] = (30, 26)  # along y and z
    window: tuple[float, float] = (30, 12)
    window_x: float = 43
    head: tuple[float, float, float] = (24, 44, 52)  # its face holds the handlebar's axis
    bar: float = 31.8
    bolts: int = 4
    bolt: float = 4.2  # core hole of M5
    bolt_depth: float = 14
    bolt_span: tuple[float, float] = (28, 42)  # along y and z
    ear: tuple[float, float] = (30, 20)  # from the steerer's axis, along y
    slit: float = 3
    pinch: float = 5.2
    pinch_x: float = 23.5
    pinch_span: float = 22
    pitch: float = 17
    turn: float = 50


def build(p: P) -> Part:
    """Joins collar, ear, beam and head, cuts and turns."""
    half = p.collar_height / 2
    body = rod(p.collar, p.collar_height, (0, 0, -half))
    body += block((*p.ear, p.collar_height), (-p.ear[0] / 2, 0, -half))
    joint = p.reach - p.head[0] / 2
    body += block((joint, *p.beam), (joint / 2, 0, -p.beam[1] / 2))
    body += block(p.head, (joint, 0, -p.head[2] / 2))
    body -= rod(p.steerer, p.collar_height, (0, 0, -half))
    body -= block((p.ear[0], p.slit, p.collar_height), (-p.ear[0] / 2, 0, -half))
    body -= [
        rod(p.pinch, p.ear[1], (-p.pinch_x, -p.ear[1] / 2, z), BACK) for z in (-p.pinch_span / 2, p.pinch_span / 2)
    ]
    body -= slot(*p.window, p.beam[0], (p.window_x, -p.beam[0] / 2, 0), BACK)
    body -= rod(p.bar, p.head[1], (p.reach, -p.head[1] / 2, 0), BACK)
    body -= [drill(p.bolt, p.bolt_depth, (p.reach, y, z), LEFT) for y, z in grid(2, p.bolts // 2, *p.bolt_span)]
    return body.rotate(Axis.Y, -p.pitch).rotate(Axis.Z, p.turn)


def questions(p: P) -> list[Item]:
    """Asked by a bicycle mechanic, a buyer, a frame builder and learners; nothing depends on the position."""
    return [
        length(
            "semicircle",
            "distance",
            "stem length c-c? so from the axis of the steerer bore to the axis of the half-round bar seat",
            p.reach,
        ),
        length("hole", "diameter", "dia of the big bore for the steerer tube", p.steerer),
        length(
            "semicircle",
            "diameter",
            "The handlebar lies in a half-round seat at the end of this stem. What diameter does the seat have, in mm?",
            p.bar,
        ),
        length(
            "tube",
            "height",
            "hi, I'm selling spacers and want to know how tall the steerer clamp is, measured along its bore?",
            p.collar_height,
        ),
        length(
            "tube", "diameter", "Please, which outer diameter has the round collar around the steerer bore?", p.collar
        ),
        length(
            "tube",
            "thickness",
            "How much wall is left between the steerer bore and the round outside of its collar?",
            (p.collar - p.steerer) / 2,
        ),
        count(
            "threaded hole",
            "The faceplate is screwed on beside the half-round seat. How many tapped holes are there for it?",
            p.bolts,
        ),
        lengths("blind hole", "depth", "drill depth of the blind holes, w/o the tip?", [p.bolt_depth] * p.bolts),
        length(
            "threaded hole",
            "diameter",
            "core hole diameter of one of these M5 threads in the handlebar clamp (they are not drawn as threads)?",
            p.bolt,
        ),
        length(
            "threaded hole",
            "distance",
            "Of the four blind holes, what's the centre distance of two neighbours measured parallel to the handlebar?",
            p.bolt_span[0],
        ),
        length(
            "slot",
            "width",
            "To save weight I cut a long window with round ends right through the beam. How wide is it?",
            p.window[1],
        ),
        length("slot", "length", "and the obround window in the beam, overall length", p.window[0]),
        length(
            "rectangular slot",
            "width",
            "what is the width of the thin slit that makes the steerer clamp to be elastic?",
            p.slit,
        ),
        length(
            "mounting hole",
            "distance",
            "Two pinch bolts close the slit at the steerer. How far apart are their axes from each other?",
            p.pinch_span,
        ),
        length("mounting hole", "diameter", "pinch bolt hole, what dia is it drilled", p.pinch),
        exists("hole with bevel", "is there any countersunk hole on the stem??", False),
    ]
