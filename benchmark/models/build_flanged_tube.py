"""A pipe spool: a tube with a flange at either end, stored as B-splines."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Part

from benchmark.kit import Form, Item, Model, count, length, lengths, point, size
from benchmark.shapes import BACK, circle, rod

MODEL = Model("Flanged pipe spool", "dev", Form.BSPLINE)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is y, the front flange begins at y = 0."""

    outer: float = 60.3  # DN 50 (ISO 1127)
    wall: float = 2.9
    length: float = 240
    flange: float = 165
    flange_thickness: float = 18
    bolts: int = 4
    bolt: float = 18
    bolt_circle: float = 125

    @property
    def inner(self) -> float:
        """Clear diameter."""
        return self.outer - 2 * self.wall


def build(p: P) -> Part:
    """Two flanges on a tube; the bolt holes straddle the centre lines."""
    ends = (0, p.length - p.flange_thickness)
    body = rod(p.outer, p.length, along=BACK)
    body += [rod(p.flange, p.flange_thickness, (0, y, 0), BACK) for y in ends]
    tools = [rod(p.inner, p.length, along=BACK)]
    for x, z in circle(p.bolts, p.bolt_circle, 45):
        tools += [rod(p.bolt, p.flange_thickness, (x, y, z), BACK) for y in ends]
    return body - tools


def questions(p: P) -> list[Item]:
    """Asked by pipe fitters."""
    return [
        length("tube", "diameter", "What is the outer diameter of the tube between the flanges?", p.outer),
        length("tube", "diameter", "What is the inner diameter of the tube?", p.inner),
        length("tube", "radius", "Inside radius of the pipe?", p.inner / 2),
        length("tube", "thickness", "What wall thickness has the tube?", p.wall),
        length("tube", "length", "How long is the pipe piece over all, from flange face to flange face?", p.length),
        count("flange", "How many flanges does the pipe have?", 2),
        lengths("flange", "thickness", "How thick are the two flanges?", [p.flange_thickness] * 2),
        lengths("flange", "diameter", "Give the outside diameters of both flanges.", [p.flange] * 2),
        length(
            "flange",
            "distance",
            "How much free space is between the two flanges along the y axis?",
            p.length - 2 * p.flange_thickness,
        ),
        count("mounting hole", "How many bolt holes do both flanges have together, the bore not counted?", 2 * p.bolts),
        lengths(
            "mounting hole",
            "diameter",
            "What is the diameter of the bolt holes in the flanges? List it for all of them.",
            [p.bolt] * 2 * p.bolts,
        ),
        length("hole", "diameter", "What is the diameter of the largest hole seen from the back?", p.inner),
        point("hole", "Where is the centre of the largest hole?", (0, p.length / 2, 0)),
        size("object", "Give me the bounding box dimensions of the object.", (p.flange, p.length, p.flange), "extents"),
    ]
