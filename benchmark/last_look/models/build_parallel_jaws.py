"""A parallel gripper: body with robot flange below, two angled fingers screwed on top, a vee pad and a flat pad."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Compound, Polygon, Pos, extrude

from benchmark.kit import Model
from benchmark.shapes import BACK, LEFT, RIGHT, UP, assembly, block, circle, drill, grid, named, rod, slot

MODEL = Model("Parallel jaws", "held_out", bodies=5)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the robot flange's face is z = 0, the fingers point to +z, the jaws move along x."""

    body: tuple[float, float, float] = (134, 60, 52)
    spigot: float = 31.5  # recess in the flange's face
    spigot_depth: float = 6
    taps: int = 4
    tap: float = 5  # core holes M6 in the flange's face
    tap_circle: float = 50
    tap_depth: float = 14
    dowel: float = 6  # on the same circle, towards +y
    dowel_depth: float = 8
    port: float = 8.8  # air ports G1/8 in the side y < 0
    port_dx: float = 30
    port_z: float = 30
    port_depth: float = 12
    groove: float = 4  # sensor groove in the side y > 0, along x, all the way
    groove_depth: float = 5
    groove_z: float = 36  # of its middle
    open: float = 46  # between the pads' flat faces
    pad: tuple[float, float, float] = (5, 28, 32)
    vee: float = 3  # depth of the left pad's 90 degree vee, along z
    finger: float = 40  # width of both fingers
    foot: tuple[float, float] = (38, 16)  # along x, height
    upright: float = 14  # thickness
    height: float = 92  # of the fingers over the body
    screw: float = 6.6
    screw_dy: float = 24
    screw_gap: float = 12  # from the foot's outer end
    head: float = 11  # counterbores
    head_depth: float = 6.5
    core: float = 5  # holes M6 in the body below the screws
    core_depth: float = 15
    window: float = 26  # overall height of the slot through each upright
    window_width: float = 12
    window_z: float = 38  # of its middle over the body


def build(p: P) -> Compound:
    """The body, then a finger with its pad per side."""
    high = p.body[2]
    body = block(p.body)
    body -= rod(p.spigot, p.spigot_depth)
    for x, y in circle(p.taps, p.tap_circle, 45):
        body -= drill(p.tap, p.tap_depth, (x, y, 0), UP)
    body -= rod(p.dowel, p.dowel_depth, (0, p.tap_circle / 2, 0))
    for x, z in grid(2, 1, p.port_dx, 0, (0, p.port_z)):
        body -= rod(p.port, p.port_depth, (x, -p.body[1] / 2, z), BACK)
    body -= block((p.body[0], 2 * p.groove_depth, p.groove), (0, p.body[1] / 2, p.groove_z - p.groove / 2))
    parts = []
    inner = p.open / 2 + p.pad[0]
    long, thick = p.foot
    for s, name in ((-1, "left"), (1, "right")):
        finger = block((long, p.finger, thick), (s * (inner + long / 2), 0, high))
        finger += block((p.upright, p.finger, p.height), (s * (inner + p.upright / 2), 0, high))
        x = s * (inner + long - p.screw_gap)
        for y in (-p.screw_dy / 2, p.screw_dy / 2):
            finger -= rod(p.screw, thick, (x, y, high))
            finger -= rod(p.head, p.head_depth, (x, y, high + thick - p.head_depth))
            body -= drill(p.core, p.core_depth, (x, y, high))
        along = LEFT if s < 0 else RIGHT
        finger -= slot(p.window, p.window_width, p.upright, (s * inner, 0, high + p.window_z), along, 90)
        base = high + p.height - p.pad[2]
        pad = block(p.pad, (s * (p.open + p.pad[0]) / 2, 0, base))
        if s < 0:
            face = -p.open / 2
            vee = Polygon((face, -p.vee), (face, p.vee), (face - p.vee, 0), align=None)
            pad -= Pos(0, 0, base) * extrude(vee, amount=p.pad[2])
        parts += [named(finger, f"finger_{name}", "silver"), named(pad, f"pad_{name}", "orange")]
    return assembly([named(body, "gripper_body", "dimgray"), *parts])
