"""A V-belt pulley with two grooves, lightening holes in its web, a hub with keyway and set screw; of B-splines."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, Plane, Polyline, make_face, revolve

from benchmark.kit import Form, Item, Model, count, exists, length, lengths, point, size
from benchmark.shapes import BACK, FRONT, LEFT, block, circle, rod

MODEL = Model("V-belt pulley", "dev", Form.BSPLINE)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is y, the rim's middle y = 0; the hub sticks out at the front."""

    rim: float = 120
    width: float = 38
    grooves: int = 2
    groove_pitch: float = 16
    groove_width: float = 13  # at the mouth
    groove_bottom: float = 6
    groove_depth: float = 11
    inside: float = 88  # inner diameter of the rim
    web: float = 12
    hub: float = 48
    hub_length: float = 50
    bore: float = 24
    key_width: float = 8  # DIN 6885
    key_top: float = 27.3  # from the far side of the bore
    holes: int = 6
    hole: float = 14
    hole_circle: float = 68
    screw: float = 5  # core hole of M6
    screw_y: float = -25

    @property
    def front(self) -> float:
        """Where on y does the hub end at the front?"""
        return self.width / 2 - self.hub_length


def build(p: P) -> Part:
    """Turns, broaches, drills."""
    half = p.width / 2
    body = rod(p.rim, p.width, (0, -half, 0), BACK)
    recess = rod(p.inside, half - p.web / 2, (0, half, 0), FRONT) - rod(p.hub, half - p.web / 2, (0, half, 0), FRONT)
    body -= [recess, recess.mirror(Plane.XZ)]
    body += rod(p.hub, p.hub_length, (0, half, 0), FRONT)
    for index in range(p.grooves):
        body -= _groove(p, (index - (p.grooves - 1) / 2) * p.groove_pitch)
    body -= rod(p.bore, p.hub_length, (0, half, 0), FRONT)
    height = p.key_top - p.bore / 2
    body -= block((p.key_width, p.hub_length, height), (0, half - p.hub_length / 2, 0))
    body -= [rod(p.hole, p.web, (x, -p.web / 2, z), BACK) for x, z in circle(p.holes, p.hole_circle)]
    return body - rod(p.screw, p.hub / 2, (p.hub / 2, p.screw_y, 0), LEFT)


def _groove(p: P, y: float) -> Part:
    """A trapezoid turned about the axis."""
    top, bottom = p.rim / 2, p.rim / 2 - p.groove_depth
    slope = (p.groove_width - p.groove_bottom) / 2 / p.groove_depth
    over = 1  # the tool starts outside
    a, b = p.groove_width / 2 + slope * over, p.groove_bottom / 2
    outline = Polyline(
        (top + over, y - a, 0), (bottom, y - b, 0), (bottom, y + b, 0), (top + over, y + a, 0), close=True
    )
    return revolve(make_face(outline), Axis.Y)


def questions(p: P) -> list[Item]:
    """Asked by those who design a drive, make the pulley or fit it."""
    return [
        length("cylinder", "diameter", "outside diameter of pulley", p.rim),
        count("ring", "How many grooves run around the rim of the pulley?", p.grooves),
        lengths("ring", "depth", "How deep are the belt grooves?", [p.groove_depth] * p.grooves),
        lengths(
            "ring",
            "width",
            "What is the width of the V-grooves, measured at the outside?",
            [p.groove_width] * p.grooves,
        ),
        length("hole", "diameter", "What diameter of shaft goes in the central bore?", p.bore),
        length("slot", "width", "Key width? (keyway in the bore)", p.key_width),
        exists("slot", "is there a keyway?", True),
        count("through hole", "How many lightening holes are drilled through the web?", p.holes),
        lengths(
            "through hole", "radius", "Tell me the radii of the lightening holes in the web.", [p.hole / 2] * p.holes
        ),
        length(
            "through hole",
            "diameter",
            "On which circle diameter are the six lightening holes arranged?",
            p.hole_circle,
        ),
        lengths("through hole", "depth", "Depth of the 14 mm holes?", [p.web] * p.holes),
        count("hole", "How many holes would you count looking at it from the back?", p.holes + 1),
        length("circular protrusion", "diameter", "Whats the hub daimeter?", p.hub),
        length("hole", "length", "How long is the hub bore from end to end?", p.hub_length),
        length("threaded hole", "diameter", "Diameter of the set screw hole that you see from the right", p.screw),
        length(
            "threaded hole",
            "distance",
            "How far is the middle of the set-screw hole from the front end of the hub?",
            p.screw_y - p.front,
        ),
        point(
            "through hole",
            "Which position does the lightening hole farthest to the right have?",
            (p.hole_circle / 2, 0, 0),
        ),
        size("object", "Width, depth and height of the pulley?", (p.rim, p.hub_length, p.rim)),
    ]
