"""A pivot joint: bracket plate, shoulder screw, washer, flanged bush, link and lock nut."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Compound, Part, Plane, RectangleRounded, chamfer, extrude, fillet

from benchmark.kit import Model
from benchmark.shapes import BACK, FRONT, assembly, block, cone, named, prism, rod

MODEL = Model("Pivot with shoulder screw", "held_out", bodies=6)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the screw's axis is y, its head's underside is y = 0, its thread points to +y; the link hangs to -z."""

    head: float = 18
    head_height: float = 7
    head_bevel: float = 0.8
    socket: float = 6  # across flats
    socket_depth: float = 4
    shoulder: float = 12
    shoulder_length: float = 22
    thread: float = 10  # M10
    thread_length: float = 21
    undercut: tuple[float, float] = (8.2, 2)  # between shoulder and thread: diameter, width
    thread_bevel: float = 1
    washer: tuple[float, float, float] = (12.5, 24, 1.6)  # inside, outside, thickness
    bush_bore: float = 12.1
    bush_outside: float = 16
    bush_flange: tuple[float, float] = (24, 2)  # diameter, thickness
    bush_length: float = 19.9  # over all
    link: float = 17  # thickness
    link_eye: float = 32  # upper round end, diameter
    link_foot: float = 24  # lower round end, diameter
    link_centres: float = 85
    link_pin: float = 10  # lower bore
    link_shank: tuple[float, float] = (18, 10)  # width, thickness between the eyes
    link_oil: float = 3  # through one side of the upper eye from +x, to the bush bore
    plate: tuple[float, float, float] = (60, 10, 70)  # along x, y, z
    plate_corner: float = 8
    plate_hole: float = 10.5
    plate_screws: int = 4
    plate_screw: float = 6.6
    plate_span: tuple[float, float] = (42, 52)
    nut: float = 17  # across flats
    nut_height: float = 8
    nut_collar: tuple[float, float] = (14, 2)  # nylon collar: diameter, height
    """The bracket plate's middle lies at the screw's axis."""


def build(p: P) -> Compound:
    """Stacks the bodies from the head on."""
    head = rod(p.head, p.head_height, (0, -p.head_height, 0), BACK)
    head = chamfer(head.faces().sort_by(Axis.Y)[0].edges(), p.head_bevel)
    screw = head + rod(p.shoulder, p.shoulder_length, (0, 0, 0), BACK)
    screw += rod(p.undercut[0], p.undercut[1], (0, p.shoulder_length, 0), BACK)
    thread = rod(p.thread, p.thread_length - p.undercut[1], (0, p.shoulder_length + p.undercut[1], 0), BACK)
    screw += chamfer(thread.faces().sort_by(Axis.Y)[-1].edges(), p.thread_bevel)
    screw -= prism(p.socket, p.socket_depth, (0, -p.head_height, 0), BACK)
    inside, outside, thick = p.washer
    washer = rod(outside, thick, (0, 0, 0), BACK) - rod(inside, thick, (0, 0, 0), BACK)
    bush = rod(p.bush_outside, p.bush_length, (0, thick, 0), BACK) + rod(*p.bush_flange, (0, thick, 0), BACK)
    bush -= rod(p.bush_bore, p.bush_length, (0, thick, 0), BACK)
    start = thick + p.bush_flange[1]
    middle = start + p.link / 2
    low = -p.link_centres
    link = rod(p.link_eye, p.link, (0, start, 0), BACK) + rod(p.link_foot, p.link, (0, start, low), BACK)
    link += block((p.link_shank[0], p.link_shank[1], p.link_centres), (0, middle, low))
    link -= rod(p.bush_outside, p.link, (0, start, 0), BACK) + rod(p.link_pin, p.link, (0, start, low), BACK)
    link -= rod(p.link_oil, p.link_eye, (0, middle, 0), (1, 0, 0))
    plane = Plane((0, p.shoulder_length, 0), x_dir=(1, 0, 0), z_dir=(0, 1, 0))
    plate = extrude(plane * RectangleRounded(p.plate[0], p.plate[2], p.plate_corner), amount=p.plate[1])
    plate -= rod(p.plate_hole, p.plate[1], (0, p.shoulder_length, 0), BACK)
    for x in (-p.plate_span[0] / 2, p.plate_span[0] / 2):
        for z in (-p.plate_span[1] / 2, p.plate_span[1] / 2):
            plate -= rod(p.plate_screw, p.plate[1], (x, p.shoulder_length, z), BACK)
    at = p.shoulder_length + p.plate[1]
    nut = prism(p.nut, p.nut_height, (0, at, 0), BACK)
    nut += rod(*p.nut_collar, (0, at + p.nut_height, 0), BACK)
    nut -= rod(p.thread, p.nut_height + p.nut_collar[1], (0, at, 0), BACK)
    return assembly(
        [
            named(screw, "shoulder screw", "dimgray"),
            named(washer, "washer", "silver"),
            named(bush, "flanged bush", "goldenrod"),
            named(link, "link", "steelblue"),
            named(plate, "bracket plate", "slategray"),
            named(nut, "lock nut", "lightgray"),
        ]
    )
