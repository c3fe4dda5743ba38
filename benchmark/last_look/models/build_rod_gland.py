"""The screwed gland of a cylinder: rod bore with wiper, seal and guide grooves, spigot with O-ring groove, pin spanner holes."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Part

from benchmark.kit import Model
from benchmark.shapes import DOWN, RIGHT, circle, cone, drill, rod

MODEL = Model("Rod gland", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is z, the pressure side's face is z = 0, the head is on top."""

    bore: float = 45  # for the rod
    length: float = 84  # over all
    head: float = 104  # diameter
    head_height: float = 18
    thread: float = 88  # outside diameter of the thread (modelled plain)
    relief: float = 83  # diameter of the thread undercut below the head
    relief_width: float = 5
    spigot: float = 80  # diameter
    spigot_length: float = 26
    lead: float = 3  # length of the lead-in chamfer on the spigot
    lead_depth: float = 1.2  # radial
    oring: float = 70.5  # ground diameter of the O-ring groove
    oring_width: float = 7.2
    oring_z: float = 15  # its middle
    wiper: float = 53.6  # diameter of the wiper recess, open to the top
    wiper_depth: float = 6.3
    seal: float = 60  # ground diameter of the rod seal groove
    seal_width: float = 11
    seal_z: float = 48  # its lower edge
    guide: float = 50  # ground diameter of both guide ring grooves
    guide_width: float = 9.7
    guides_z: tuple[float, float] = (8, 27)  # lower edges
    pins: int = 4
    pin: float = 8
    pin_depth: float = 12
    pins_on: float = 86  # bolt circle
    leak: float = 5  # radial leakage hole through the head
    leak_z: float = 74  # height of its axis


def build(p: P) -> Part:
    """Turns it and drills it."""
    under = p.length - p.head_height
    body = rod(p.head, p.head_height, (0, 0, under))
    body += rod(p.relief, p.relief_width, (0, 0, under - p.relief_width))
    body += rod(p.thread, under - p.relief_width - p.spigot_length, (0, 0, p.spigot_length))
    body += rod(p.spigot, p.spigot_length - p.lead, (0, 0, p.lead))
    body += cone(p.spigot - 2 * p.lead_depth, p.spigot, p.lead)
    body -= rod(p.bore, p.length)
    w = p.oring_width
    body -= rod(p.spigot + 2, w, (0, 0, p.oring_z - w / 2)) - rod(p.oring, w, (0, 0, p.oring_z - w / 2))
    body -= rod(p.wiper, p.wiper_depth, (0, 0, p.length), DOWN)
    body -= rod(p.seal, p.seal_width, (0, 0, p.seal_z))
    for z in p.guides_z:
        body -= rod(p.guide, p.guide_width, (0, 0, z))
    for x, y in circle(p.pins, p.pins_on, 45):
        body -= drill(p.pin, p.pin_depth, (x, y, p.length))
    body -= rod(p.leak, p.head, (0, 0, p.leak_z), RIGHT)
    return body
