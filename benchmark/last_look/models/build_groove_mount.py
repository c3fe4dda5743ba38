"""A printed extruder bracket: back plate for the carriage, shelf with groove mount, gussets, sensor ear."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, Plane, Polygon, extrude, fillet

from benchmark.kit import Model
from benchmark.shapes import BACK, block, drill, grid, rod

MODEL = Model("Extruder bracket", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the back plate's rear is y = 0, the shelf runs towards -y, its underside is z = 0."""

    width: float = 64
    plate: float = 7  # thickness of the back plate
    height: float = 58  # of the back plate from z = 0
    shelf: float = 38  # how far it stands off the back plate's front
    thick: float = 10  # of the shelf
    neck: float = 12.2  # width of the slot for the hot end's neck
    collar: float = 16.3  # width of the recess above
    collar_depth: float = 5.5
    throat: float = 20  # from the back plate's front to the hot end's axis
    gusset: float = 5  # thickness
    gusset_size: tuple[float, float] = (26, 30)  # y, z
    screws: tuple[float, float] = (40, 24)  # to the carriage: x, z
    screws_z: float = 40  # of the pattern's middle
    screw: float = 4.3
    head: float = 8
    head_depth: float = 4.2  # counterbore from the front
    clamp: float = 2.8  # two blind holes in the shelf's front for the clamp
    clamp_depth: float = 16
    clamp_span: float = 30
    ear: tuple[float, float] = (26, 26)  # x, y, on the +x side
    ear_forward: float = 4  # of the ear and its hole against the hot end, towards -y
    ear_hole: float = 12.4  # for the sensor
    wire: float = 10  # hole through the back plate
    wire_z: float = 22
    round: float = 8  # upper corners of the back plate


def build(p: P) -> Part:
    """Joins plate, shelf, ear and gussets, then cuts."""
    front = -p.plate
    body = block((p.width, p.plate, p.height), (0, -p.plate / 2, 0))
    body = fillet(body.edges().filter_by(Axis.Y).group_by(Axis.Z)[-1], p.round)
    body += block((p.width, p.shelf, p.thick), (0, front - p.shelf / 2, 0))
    middle = front - p.throat
    ear = block((p.ear[0], p.ear[1], p.thick), (p.width / 2 + p.ear[0] / 2, middle - p.ear_forward, 0))
    corners = ear.edges().filter_by(Axis.Z).group_by(Axis.X)[-1]
    body += fillet(corners, p.round)
    for x in (-p.width / 2, p.width / 2 - p.gusset):
        side = Plane(origin=(x, front, p.thick), x_dir=(0, -1, 0), z_dir=(-1, 0, 0))
        wedge = extrude(side * Polygon((0, 0), (p.gusset_size[0], 0), (0, p.gusset_size[1]), align=None), amount=-p.gusset)
        body += wedge
    end = p.shelf - p.throat
    for wide, low in ((p.neck, 0.0), (p.collar, p.thick - p.collar_depth)):
        body -= rod(wide, p.thick, (0, middle, low))
        body -= block((wide, end + 1, p.thick), (0, middle - (end + 1) / 2, low))
    for x, z in grid(2, 2, *p.screws, (0, p.screws_z)):
        body -= rod(p.screw, p.plate, (x, front, z), BACK)
        body -= rod(p.head, p.head_depth, (x, front, z), BACK)
    for x in (-p.clamp_span / 2, p.clamp_span / 2):
        body -= drill(p.clamp, p.clamp_depth, (x, front - p.shelf, p.thick / 2), BACK)
    body -= rod(p.ear_hole, p.thick, (p.width / 2 + p.ear[0] / 2, middle - p.ear_forward, 0))
    body -= rod(p.wire, p.plate, (0, front, p.wire_z), BACK)
    return body
