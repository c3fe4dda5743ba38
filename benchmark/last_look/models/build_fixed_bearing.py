"""A foot-mounted housing for the fixed bearings of a ball screw: stepped bore, ring groove, seal seat, feet."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, chamfer, fillet

from benchmark.kit import Model
from benchmark.shapes import BACK, FRONT, block, circle, drill, grid, rod

MODEL = Model("Fixed bearing housing", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the feet stand on z = 0, the bore's axis is along y, the bearing side is at -y, middle at y = 0."""

    length: float = 46  # along y
    feet: float = 96  # across, x
    foot: float = 16  # height of a foot
    dome: float = 64  # width of the body and diameter of its round top
    axis: float = 38  # of the bore over the underside
    fillet: float = 2  # between body and feet
    toe: float = 2  # chamfer at the outer upper edges of the feet
    seat: float = 47  # bearing seat
    seat_depth: float = 28
    land: float = 36  # bore between the seats
    seal: float = 42
    seal_depth: float = 10
    groove: float = 49.5  # diameter, for the retaining ring
    groove_width: float = 1.85
    groove_at: float = 24.2  # from the bearing side's face to the groove's near wall
    lead: float = 1  # chamfer of the bearing seat
    taps: int = 4  # M4 in the bearing side's face, core holes
    tap: float = 3.3
    tap_depth: float = 10
    tap_circle: float = 56
    screws: int = 4
    screw: float = 6.6  # M6 through the feet
    sink: float = 11
    sink_depth: float = 6.5
    screw_span: tuple[float, float] = (80, 28)
    dowel: float = 5  # two, through the feet, midway between the screws
    grease: float = 5  # core hole of M6 from the top into the seat
    spot: float = 12
    spot_depth: float = 1.5
    grease_at: float = 13  # from the bearing side's face
    relief: tuple[float, float] = (44, 2)  # groove in the underside along y: width, depth


def build(p: P) -> Part:
    """Joins feet and body, bores, drills."""
    front = -p.length / 2
    body = block((p.feet, p.length, p.foot)) + block((p.dome, p.length, p.axis))
    body += rod(p.dome, p.length, (0, front, p.axis), BACK)
    toes = body.edges().filter_by(Axis.Y).filter_by(
        lambda e: abs(abs(e.center().X) - p.feet / 2) < 0.01 and abs(e.center().Z - p.foot) < 0.01
    )
    body = chamfer(toes, p.toe)
    inner = body.edges().filter_by(Axis.Y).filter_by(
        lambda e: abs(abs(e.center().X) - p.dome / 2) < 0.01 and abs(e.center().Z - p.foot) < 0.01
    )
    body = fillet(inner, p.fillet)
    body -= rod(p.land, p.length, (0, front, p.axis), BACK)
    body -= rod(p.seat, p.seat_depth, (0, front, p.axis), BACK)
    body -= rod(p.seal, p.seal_depth, (0, -front, p.axis), FRONT)
    mouth = body.edges().filter_by(
        lambda e: abs(e.center().Y - front) < 0.01 and e.geom_type.name == "CIRCLE" and abs(e.radius - p.seat / 2) < 0.01
    )
    body = chamfer(mouth, p.lead)
    body -= rod(p.groove, p.groove_width, (0, front + p.groove_at, p.axis), BACK)
    for x, z in circle(p.taps, p.tap_circle, 45, (0, p.axis)):
        body -= drill(p.tap, p.tap_depth, (x, front, z), BACK)
    for x, y in grid(2, 2, *p.screw_span):
        body -= rod(p.screw, p.foot, (x, y, 0))
        body -= rod(p.sink, p.sink_depth, (x, y, p.foot - p.sink_depth))
    for side in (-1, 1):
        body -= rod(p.dowel, p.foot, (side * p.screw_span[0] / 2, 0, 0))
    top = p.axis + p.dome / 2
    y = front + p.grease_at
    body -= rod(p.grease, p.dome / 2, (0, y, p.axis))
    body -= rod(p.spot, p.spot_depth, (0, y, top - p.spot_depth))
    body -= block((p.relief[0], p.length, p.relief[1]))
    return body
