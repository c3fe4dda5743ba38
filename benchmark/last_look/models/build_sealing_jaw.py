"""A cross sealing jaw of a flow wrapper: bar with serrated face, knife slot, heater bores, sensor hole, fixing holes at the rear."""

from __future__ import annotations

from dataclasses import dataclass

from benchmark.kit import Model
from benchmark.shapes import FRONT, LEFT, RIGHT, block, drill, rod
from build123d import Axis, Part, Plane, Polygon, chamfer, extrude

MODEL = Model("Cross sealing jaw", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the bar lies along x, its sealing face is y = 0 and looks to -y, the rear is y = depth; z = 0 is the middle."""

    length: float = 210
    depth: float = 34  # y
    height: float = 42  # z
    face: float = 184  # length of the raised sealing face
    raised: float = 4  # how far it stands proud of the ends
    slot: float = 3  # knife slot: width, z
    slot_depth: float = 14
    teeth: int = 5  # grooves above and below the slot
    pitch: float = 2.4
    groove: float = 1.6  # width of a groove at the face
    groove_deep: float = 0.8
    first: float = 5  # first groove's middle from the middle of the bar
    heater: float = 10  # two bores along x
    heater_y: float = 18
    heater_span: float = 23
    probe: float = 3.2  # thermocouple, blind from the +x end
    probe_depth: float = 60
    probe_at: tuple[float, float] = (10, 6)  # y, z
    tap: float = 6.8  # M8, from the rear
    tap_depth: float = 11
    tap_x: tuple[float, ...] = (-78, -26, 26, 78)
    dowel: float = 8
    dowel_depth: float = 9
    dowel_x: float = 52
    clamp: float = 2.5  # M3 for the cable clip, upper side
    clamp_depth: float = 5
    clamp_at: tuple[tuple[float, float], ...] = ((84, 28), (96, 28))  # x, y
    edge: float = 1.5  # chamfer along the rear


def build(p: P) -> Part:
    """Mills the ends back, cuts slot and serrations, then drills."""
    body = block((p.length, p.depth - p.raised, p.height), (0, (p.depth + p.raised) / 2, -p.height / 2))
    body = chamfer(body.edges().filter_by(Axis.X).group_by(Axis.Y)[-1], p.edge)
    body += block((p.face, p.raised, p.height), (0, p.raised / 2, -p.height / 2))
    body -= block((p.length, p.slot_depth, p.slot), (0, p.slot_depth / 2, -p.slot / 2))
    for side in (-1, 1):
        for index in range(p.teeth):
            z = side * (p.first + index * p.pitch)
            half = p.groove / 2
            plane = Plane(origin=(-p.face / 2, 0, z), x_dir=(0, 1, 0), z_dir=(1, 0, 0))
            body -= extrude(plane * Polygon((0, -half), (p.groove_deep, 0), (0, half), align=None), amount=p.face)
        body -= rod(p.heater, p.length, (-p.length / 2, p.heater_y, side * p.heater_span / 2), RIGHT)
        body -= rod(p.dowel, p.dowel_depth, (side * p.dowel_x, p.depth, 0), FRONT)
    body -= drill(p.probe, p.probe_depth, (p.length / 2, *p.probe_at), LEFT)
    for x in p.tap_x:
        body -= drill(p.tap, p.tap_depth, (x, p.depth, 0), FRONT)
    for x, y in p.clamp_at:
        body -= drill(p.clamp, p.clamp_depth, (x, y, p.height / 2))
    return body
