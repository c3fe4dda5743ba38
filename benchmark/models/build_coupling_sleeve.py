"""A coupling sleeve: a tube with a collar, a through keyway, two radial set-screw holes and chamfered ends."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, GeomType, Part, chamfer

from benchmark.kit import Item, Model, count, length, lengths, point, size
from benchmark.shapes import FRONT, RIGHT, block, rod

MODEL = Model("Coupling sleeve", "dev")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the sleeve's axis is x, its left end lies at x = 0."""

    outer: float = 40
    inner: float = 22
    length: float = 70
    collar: float = 56
    collar_start: float = 28
    collar_length: float = 14
    key: float = 6  # width
    key_top: float = 13.8  # from the axis to the groove's floor
    screws: float = 5  # core hole of M6
    screw_inset: float = 12
    edge: float = 1.5


def build(p: P) -> Part:
    """Turns the tube, breaks its outer edges, broaches the keyway, drills."""
    body = rod(p.outer, p.length, (0, 0, 0), RIGHT)
    circles = body.edges().filter_by(GeomType.CIRCLE).sort_by(Axis.X)
    body = chamfer([circles[0], circles[-1]], p.edge)
    body += rod(p.collar, p.collar_length, (p.collar_start, 0, 0), RIGHT)
    body -= rod(p.inner, p.length, (0, 0, 0), RIGHT)
    body -= block((p.length, p.key, p.key_top), (p.length / 2, 0, 0))
    body -= [rod(p.screws, p.outer, (x, 0, 0), FRONT) for x in (p.screw_inset, p.length - p.screw_inset)]
    return body


def questions(p: P) -> list[Item]:
    """Asked by a maintenance engineer."""
    return [
        length("tube", "diameter", "What is the inner diameter of the tube?", p.inner),
        length("tube", "length", "How long is the sleeve?", p.length),
        length(
            "tube",
            "thickness",
            "How thick is the wall of the tube, without keyway and collar?",
            (p.outer - p.inner) / 2,
        ),
        length("ring", "diameter", "The collar's outer diameter is what?", p.collar),
        length("ring", "width", "How wide is the collar along the axis?", p.collar_length),
        length("slot", "width", "Please tell me the width of the keyway.", p.key),
        length("slot", "length", "How long is the keyway?", p.length),
        count("threaded hole", "How many set screw holes are visible from the front?", 2),
        lengths("threaded hole", "diameter", "What diameter do the small radial holes have?", [p.screws] * 2),
        length(
            "threaded hole",
            "distance",
            "How far apart are the centres of the two small holes?",
            p.length - 2 * p.screw_inset,
        ),
        count("bevel", "How many chamfers does the part have?", 2),
        length("bevel", "width", "What leg length do the chamfers have, one value?", p.edge),
        point("ring", "Where is the centre of the collar?", (p.collar_start + p.collar_length / 2, 0, 0)),
        size("object", "What are width, depth and height of the part?", (p.length, p.collar, p.collar)),
        length("cylinder", "radius", "What is the radius of the largest cylinder?", p.collar / 2),
        length("hole", "radius", "Radius of the hole visible from the left?", p.inner / 2),
    ]
