"""A ball screw with machined ends: drive journal with flat, locknut thread, bearing seats, ring groove, spanner flats."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Part, chamfer, fillet

from benchmark.kit import Model
from benchmark.shapes import BACK, FRONT, block, cone, drill, rod

MODEL = Model("Ball screw with machined ends", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is y, the drive end's face is y = 0, the screw runs towards +y. Threads are plain."""

    drive: float = 10  # journal for the coupling
    drive_length: float = 20
    flat: float = 1.2  # depth of the flat in the drive journal, at +z
    flat_length: float = 14  # from the end face
    nut: float = 12  # M12x1
    nut_length: float = 14
    seat: float = 15  # fixed bearings
    seat_length: float = 26
    collar: float = 22
    collar_length: float = 6
    collar_fillet: float = 0.8  # between seat and collar
    screw: float = 25  # ball thread, over the crests
    screw_length: float = 240
    flats: float = 21  # across, spanner flats in the screw, square to z
    flats_length: float = 12
    flats_at: float = 10  # from the screw's end at the collar
    tail: float = 12  # floating bearing
    tail_length: float = 16
    ring: float = 11.5  # groove diameter
    ring_width: float = 1.1
    ring_at: float = 3  # from the tail's end face to the groove's near wall
    tap: float = 4.2  # M5 core hole in the drive end
    tap_depth: float = 12
    centre: float = 3.15  # centre hole in the tail
    centre_depth: float = 4
    centre_mouth: float = 6.7  # 60 degrees
    bevel: float = 1  # at both ends of the screw
    end_bevel: float = 0.5  # at both end faces


def build(p: P) -> Part:
    """Turns the steps one after another, then mills and drills."""
    body = Part()
    y = 0.0
    steps = ((p.drive, p.drive_length), (p.nut, p.nut_length), (p.seat, p.seat_length), (p.collar, p.collar_length))
    for diameter, long in steps:
        body += rod(diameter, long, (0, y, 0), BACK)
        y += long
    thread = rod(p.screw, p.screw_length, (0, y, 0), BACK)
    thread = chamfer(thread.edges().filter_by(lambda e: e.geom_type.name == "CIRCLE"), p.bevel)
    for side in (-1, 1):
        z = p.flats / 2 if side > 0 else -p.flats / 2 - 10
        thread -= block((40, p.flats_length, 10), (0, y + p.flats_at + p.flats_length / 2, z))
    body += thread
    y += p.screw_length
    body += rod(p.tail, p.tail_length, (0, y, 0), BACK)
    end = y + p.tail_length

    def rim(at: float, diameter: float):  # noqa: ANN202
        return body.edges().filter_by(
            lambda e: e.geom_type.name == "CIRCLE" and abs(e.center().Y - at) < 0.01 and abs(2 * e.radius - diameter) < 0.01
        )

    body = fillet(rim(p.drive_length + p.nut_length + p.seat_length, p.seat), p.collar_fillet)
    body = chamfer(rim(0, p.drive), p.end_bevel)
    body = chamfer(rim(end, p.tail), p.end_bevel)
    start = end - p.ring_at - p.ring_width
    body -= rod(2 * p.tail, p.ring_width, (0, start, 0), BACK) - rod(p.ring, p.ring_width, (0, start, 0), BACK)
    body -= block((20, p.flat_length, 10), (0, p.flat_length / 2, p.drive / 2 - p.flat))
    body -= drill(p.tap, p.tap_depth, (0, 0, 0), BACK)
    body -= drill(p.centre, p.centre_depth, (0, end, 0), FRONT)
    deep = (p.centre_mouth - p.centre) / 2 * 3**0.5
    body -= cone(p.centre_mouth, p.centre, deep, (0, end, 0), FRONT)
    return body
