"""A cryostat cold finger of copper: bolted flange, stem with wire anchoring grooves, flat blade for the sample."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, GeomType, Part, fillet

from benchmark.kit import Model
from benchmark.shapes import BACK, LEFT, UP, block, circle, drill, grid, rod

MODEL = Model("Cold finger", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is z, the flange's underside is z = 0; the sample's face of the blade is y = 0, facing -y."""

    flange: float = 44
    flange_thickness: float = 6
    bolt: float = 4.5
    bolts: int = 6
    bolt_circle: float = 34
    dowel: float = 3  # through the flange, on the bolt circle, 30 degrees from x
    notch: float = 5  # width of the two wire notches in the rim, on +y and -y
    notch_depth: float = 4.5
    stem: float = 20
    stem_end: float = 40  # in z
    root: float = 2  # fillet between flange and stem
    groove: float = 3  # width
    groove_depth: float = 1.2
    grooves: tuple[float, ...] = (14, 20, 26)  # z of their middles
    heater: float = 6.4  # axial, from the flange's underside
    heater_depth: float = 22  # of the cylinder
    sensor: float = 3.2  # into the stem from +x
    sensor_depth: float = 9  # of the cylinder, from the stem's surface
    sensor_z: float = 34
    blade: tuple[float, float, float] = (16, 5, 45)  # width, thickness, length
    blade_corner: float = 3  # radius of its two free corners
    tap: float = 2.5  # core hole of M3, through the blade
    taps: tuple[float, float] = (10, 26)  # along x and z
    taps_z: float = 64  # of the middle of the four
    pocket: tuple[float, float] = (12, 14)  # in the sample's face, width and height, on the taps' middle
    pocket_depth: float = 1


def build(p: P) -> Part:
    """Turns flange and stem, mills the blade, drills."""
    w, t, length = p.blade
    body = rod(p.flange, p.flange_thickness) + rod(p.stem, p.stem_end - p.flange_thickness, (0, 0, p.flange_thickness))
    ring = [
        e
        for e in body.edges().filter_by(GeomType.CIRCLE)
        if abs(e.radius - p.stem / 2) < 0.01 and abs(e.center().Z - p.flange_thickness) < 0.01
    ]
    body = fillet(ring, p.root)
    for z in p.grooves:
        low = (0, 0, z - p.groove / 2)
        body -= rod(p.stem + 2, p.groove, low) - rod(p.stem - 2 * p.groove_depth, p.groove, low)
    blade = block((w, t, length), (0, t / 2, p.stem_end))
    free = blade.edges().filter_by(Axis.Y).sort_by(Axis.Z)[-2:]
    body += fillet(free, p.blade_corner)
    for x, z in grid(2, 2, *p.taps, center=(0, p.taps_z)):
        body -= rod(p.tap, t, (x, 0, z), BACK)
    body -= block((p.pocket[0], p.pocket_depth, p.pocket[1]), (0, p.pocket_depth / 2, p.taps_z - p.pocket[1] / 2))
    for x, y in circle(p.bolts, p.bolt_circle):
        body -= rod(p.bolt, p.flange_thickness, (x, y, 0))
    x, y = circle(1, p.bolt_circle, 30)[0]
    body -= rod(p.dowel, p.flange_thickness, (x, y, 0))
    for side in (-1, 1):
        middle = side * (p.flange - p.notch_depth) / 2
        outward = side * 2
        body -= block((p.notch, p.notch_depth + 4, p.flange_thickness), (0, middle + outward, 0))
    body -= drill(p.heater, p.heater_depth, (0, 0, 0), UP)
    return body - drill(p.sensor, p.sensor_depth, (p.stem / 2, 0, p.sensor_z), LEFT)
