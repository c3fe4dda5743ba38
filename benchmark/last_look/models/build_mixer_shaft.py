"""A mixer shaft: drive end with keyway, two bearing seats, a collar, a taper and a threaded stub."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import GeomType, Part, chamfer, fillet

from benchmark.kit import Model
from benchmark.shapes import LEFT, RIGHT, block, cone, drill, rod, slot

MODEL = Model("Mixer shaft", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is x, the drive end's face is x = 0, the keyway looks up (z)."""

    drive_d: float = 40
    drive_l: float = 82
    seat1_d: float = 45  # bearing seat between drive end and collar
    seat1_l: float = 34
    collar_d: float = 60
    collar_l: float = 12
    mid_d: float = 52
    mid_l: float = 240
    seat2_d: float = 48  # bearing seat at the mixer's side
    seat2_l: float = 40
    ring_d: float = 45.5  # ground of the groove for the retaining ring, in the second seat
    ring_w: float = 1.9
    ring_edge: float = 4  # from the groove to the seat's end on the taper's side
    taper_d1: float = 38
    taper_d2: float = 30
    taper_l: float = 64
    stub_d: float = 24  # M24
    stub_l: float = 30
    relief_d: float = 20.5  # thread run-out against the taper
    relief_w: float = 5
    pin_d: float = 5  # split pin hole across the stub
    pin_edge: float = 8  # from the stub's end
    key_w: float = 12
    key_l: float = 63
    key_depth: float = 5  # below the top of the shaft
    key_start: float = 8  # from the drive end's face
    tap_d: float = 10.2  # core hole of M12 in the drive end
    tap_depth: float = 28
    flats: float = 46  # across the two spanner flats
    flats_l: float = 30
    flats_start: float = 45  # from the collar
    bevel: float = 2  # of both ends
    collar_r: float = 3  # of the corner between collar and middle


def build(p: P) -> Part:
    """Turns the steps one after the other, then mills and drills."""
    steps = (
        (p.drive_d, p.drive_l),
        (p.seat1_d, p.seat1_l),
        (p.collar_d, p.collar_l),
        (p.mid_d, p.mid_l),
        (p.seat2_d, p.seat2_l),
    )
    x = 0.0
    body = Part()
    for d, l in steps:
        body += rod(d, l, (x, 0, 0), RIGHT)
        x += l
    seat_end = x
    body += cone(p.taper_d1, p.taper_d2, p.taper_l, (x, 0, 0), RIGHT)
    x += p.taper_l
    body += rod(p.stub_d, p.stub_l, (x, 0, 0), RIGHT)
    stub_start = x
    end = x + p.stub_l
    circles = body.edges().filter_by(GeomType.CIRCLE)
    body = chamfer([e for e in circles if abs(e.center().X) < 1e-6 or abs(e.center().X - end) < 1e-6], p.bevel)
    collar_end = p.drive_l + p.seat1_l + p.collar_l
    body = fillet(
        [
            e
            for e in body.edges().filter_by(GeomType.CIRCLE)
            if abs(e.center().X - collar_end) < 1e-6 and abs(e.radius - p.mid_d / 2) < 1e-6
        ],
        p.collar_r,
    )
    start = seat_end - p.ring_edge - p.ring_w
    body -= rod(p.collar_d, p.ring_w, (start, 0, 0), RIGHT) - rod(p.ring_d, p.ring_w, (start, 0, 0), RIGHT)
    body -= rod(p.collar_d, p.relief_w, (stub_start, 0, 0), RIGHT) - rod(
        p.relief_d, p.relief_w, (stub_start, 0, 0), RIGHT
    )
    body -= rod(p.pin_d, p.collar_d, (end - p.pin_edge, 0, -p.collar_d / 2))
    body -= slot(
        p.key_l, p.key_w, p.key_depth, (p.key_start + p.key_l / 2, 0, p.drive_d / 2)
    )
    body -= drill(p.tap_d, p.tap_depth, (0, 0, 0), RIGHT)
    for side in (-1, 1):
        middle = side * (p.flats / 2 + p.mid_d / 4)
        body -= block(
            (p.flats_l, p.mid_d / 2, p.mid_d),
            (collar_end + p.flats_start + p.flats_l / 2, middle, -p.mid_d / 2),
        )
    return body
