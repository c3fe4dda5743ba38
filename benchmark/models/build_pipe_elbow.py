"""A 90 degree pipe elbow in inches: a round flange below, a square flange on the right, a gauge port on the left."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Circle, Location, Part, revolve

from benchmark.kit import INCH, Item, Model, count, length, lengths, point, points, size
from benchmark.shapes import LEFT, RIGHT, block, circle, grid, rod

MODEL = Model("Pipe elbow with two flanges", "dev", unit="in")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres from inches; the round flange lies on z = 0, its middle is x = y = 0, the bend goes to the right."""

    outer: float = 2.375 * INCH  # nominal pipe size 2 (ASME B36.10)
    inner: float = 2 * INCH
    bend: float = 3 * INCH  # radius of the middle line
    straight: float = 2 * INCH  # from either flange's face to the bend
    round: float = 5 * INCH
    square: float = 4.5 * INCH
    thickness: float = 0.5 * INCH
    bolts: int = 4
    bolt: float = 0.625 * INCH
    bolt_circle: float = 3.875 * INCH
    square_bolt: float = 0.5 * INCH
    square_pitch: float = 3.25 * INCH
    port: float = 1 * INCH
    port_reach: float = 1.875 * INCH  # of its end from the pipe's axis
    port_hole: float = 0.4375 * INCH  # core hole of 1/4-18 NPT
    port_z: float = 1.25 * INCH

    @property
    def end(self) -> float:
        """Where on x is the square flange's face, and on z its middle?"""
        return self.bend + self.straight


def pipe(p: P, diameter: float) -> Part:
    """Two straight lengths and the bend between them."""
    body = rod(diameter, p.straight) + rod(diameter, p.straight, (p.bend, 0, p.end), RIGHT)
    axis = Axis((p.bend, 0, p.straight), (0, 1, 0))
    return body + revolve(Location((0, 0, p.straight)) * Circle(diameter / 2), axis, 90)


def build(p: P) -> Part:
    """Welds the flanges on, bores."""
    body = pipe(p, p.outer) + rod(p.round, p.thickness)
    body += block((p.thickness, p.square, p.square), (p.end - p.thickness / 2, 0, p.end - p.square / 2))
    body += rod(p.port, p.port_reach, (0, 0, p.port_z), LEFT)
    body -= pipe(p, p.inner)
    body -= rod(p.port_hole, p.port_reach, (0, 0, p.port_z), LEFT)
    body -= [rod(p.bolt, p.thickness, (x, y, 0)) for x, y in circle(p.bolts, p.bolt_circle, 45)]
    start = p.end - p.thickness
    return body - [rod(p.square_bolt, p.thickness, (start, y, z), RIGHT) for y, z in _square(p)]


def questions(p: P) -> list[Item]:
    """Asked by pipe fitters, American and not, and by a stress analyst."""
    return [
        length("tube", "diameter", "What's the I.D. of the pipe?", p.inner),
        length("tube", "thickness", "Wall thickness of the pipe?", (p.outer - p.inner) / 2),
        length("tube", "radius", "What is the centerline bend radius of the elbow, in inches?", p.bend),
        length("flange", "diameter", "How big in diameter is the round flange?", p.round),
        length("circular base", "thickness", "How thick is the round flange at the bottom?", p.thickness),
        count("mounting hole", "How many bolt holes are in the round flange?", p.bolts),
        length("mounting hole", "diameter", "bolt circle diameter of the round flange", p.bolt_circle),
        lengths(
            "mounting hole",
            "diameter",
            "What are the diameters of the bolt holes in the flange on the right side?",
            [p.square_bolt] * 4,
        ),
        length("rectangular part", "width", "How wide is the square flange across, along y?", p.square),
        length(
            "mounting hole",
            "distance",
            "Distance between two neighboring bolt holes of the square flange?",
            p.square_pitch,
        ),
        points(
            "mounting hole",
            "What are the positions of the bolt holes in the right-hand flange?",
            [(p.end - p.thickness / 2, y, z) for y, z in _square(p)],
        ),
        count("mounting hole", "How many bolt holes are there altogether in both flanges?", p.bolts + 4),
        length("threaded hole", "diameter", "Diameter of the hole of the gauge port at the left", p.port_hole),
        length("circular protrusion", "diameter", "What is the outer diameter of the round boss on the left?", p.port),
        length(
            "threaded hole",
            "distance",
            "How high above the bottom face does the axis of the port on the left lie?",
            p.port_z,
        ),
        count("hole", "How many holes have a diameter of 5/8 inch?", p.bolts),
        point("flange", "Where is the centre of the square flange?", (p.end - p.thickness / 2, 0, p.end)),
        size(
            "object",
            "Overall size of the elbow fitting?",
            (p.round / 2 + p.end, max(p.round, p.square), p.end + p.square / 2),
        ),
    ]


def _square(p: P) -> list[tuple[float, float]]:
    """Where are the square flange's holes, y and z?"""
    return grid(2, 2, p.square_pitch, p.square_pitch, (0, p.end))
