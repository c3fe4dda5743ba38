"""A tool flange for a robot wrist: spigot, sunk screw holes, outer tapped circle, dowels, face groove, air port."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Part, chamfer

from benchmark.kit import Model
from benchmark.shapes import DOWN, LEFT, RIGHT, block, circle, rod

MODEL = Model("Robot tool flange", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is x, the robot's face is x = 0, the tool's face at +x; the flat with the air port is up."""

    outside: float = 102
    thickness: float = 18
    spigot: float = 31.5
    spigot_height: float = 5  # towards -x
    bore: float = 18
    recess: float = 36  # in the tool's face
    recess_depth: float = 5
    robot_screws: int = 4
    robot_circle: float = 50
    robot_screw: float = 6.6
    sink: float = 11
    sink_depth: float = 6.8
    robot_dowel: float = 6  # one, through, at +y on the same circle
    tool_taps: int = 6
    tool_circle: float = 82
    tool_tap: float = 5  # M6 core, through
    tool_dowels: int = 2
    tool_dowel: float = 8  # opposite each other on the tool's circle, blind from the tool's face
    tool_dowel_depth: float = 12
    ring: tuple[float, float, float] = (36.5, 42, 1.9)  # face groove at the robot's side: inner, outer diameter, depth
    flat: float = 47  # of the flat from the axis
    port: float = 4.2  # M5 core, from the flat into the bore
    port_at: float = 6  # over the robot's face
    rim: float = 1  # chamfer of the outer edges
    lead: float = 1  # of the spigot


def build(p: P) -> Part:
    """Turns the disc, then drills both circles."""
    body = rod(p.outside, p.thickness, (0, 0, 0), RIGHT)
    body = chamfer(body.edges().filter_by(lambda e: e.geom_type.name == "CIRCLE"), p.rim)
    spigot = rod(p.spigot, p.spigot_height, (0, 0, 0), LEFT)
    body += chamfer(
        spigot.edges().filter_by(lambda e: e.geom_type.name == "CIRCLE" and abs(e.center().X + p.spigot_height) < 0.01), p.lead
    )
    body -= rod(p.ring[1], p.ring[2], (0, 0, 0), RIGHT) - rod(p.ring[0], p.ring[2], (0, 0, 0), RIGHT)
    body -= rod(p.bore, p.thickness + p.spigot_height, (-p.spigot_height, 0, 0), RIGHT)
    body -= rod(p.recess, p.recess_depth, (p.thickness, 0, 0), LEFT)
    for y, z in circle(p.robot_screws, p.robot_circle, 45):
        body -= rod(p.robot_screw, p.thickness, (0, y, z), RIGHT)
        body -= rod(p.sink, p.sink_depth, (p.thickness, y, z), LEFT)
    body -= rod(p.robot_dowel, p.thickness, (0, p.robot_circle / 2, 0), RIGHT)
    for y, z in circle(p.tool_taps, p.tool_circle):
        body -= rod(p.tool_tap, p.thickness, (0, y, z), RIGHT)
    for y, z in circle(p.tool_dowels, p.tool_circle, 30):
        body -= rod(p.tool_dowel, p.tool_dowel_depth, (p.thickness, y, z), LEFT)
    body -= block((4 * p.thickness, p.outside, p.outside), (0, 0, p.flat))
    body -= rod(p.port, p.flat, (p.port_at, 0, p.flat), DOWN)
    return body
