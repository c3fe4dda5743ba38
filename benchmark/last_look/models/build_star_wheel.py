"""A bottle star wheel: plate with round pockets, centre bore, counterbored screw holes, dowel holes, windows, hub recess below."""

from __future__ import annotations

from dataclasses import dataclass

from benchmark.kit import Model
from benchmark.shapes import circle, rod, slot
from build123d import Axis, Part, chamfer, fillet

MODEL = Model("Bottle star wheel", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the underside is z = 0, the axis is z, a pocket opens towards +x."""

    diameter: float = 300
    thick: float = 20
    pockets: int = 8
    pocket: float = 72  # diameter
    pitch: float = 310  # circle of the pockets' axes
    tip: float = 3  # rounding of the tips between pockets
    bore: float = 40
    bore_edge: float = 1.5  # chamfer, top
    screws: int = 6
    screw: float = 9
    head: float = 15
    head_depth: float = 9  # from the top
    screw_circle: float = 72
    dowel: float = 8
    dowel_circle: float = 72  # two, opposite each other, on y
    recess: float = 100  # from below
    recess_depth: float = 4
    windows: int = 4
    window: tuple[float, float] = (50, 26)  # over all, long side along the radius
    window_circle: float = 168
    mark: float = 6  # blind, top, before pocket no. 1
    mark_depth: float = 5
    mark_at: float = 108


def build(p: P) -> Part:
    """Cuts the pockets, rounds the tips, then bores."""
    body = rod(p.diameter, p.thick)
    for x, y in circle(p.pockets, p.pitch):
        body -= rod(p.pocket, p.thick, (x, y, 0))
    tips = [e for e in body.edges().filter_by(Axis.Z) if (e.center().X ** 2 + e.center().Y ** 2) ** 0.5 > p.diameter / 2 - 1]
    body = fillet(tips, p.tip)
    bore = rod(p.bore, p.thick)
    body -= bore
    rim = [e for e in body.edges() if str(e.geom_type).endswith("CIRCLE") and abs(e.radius - p.bore / 2) < 1e-6 and abs(e.center().Z - p.thick) < 1e-6]
    body = chamfer(rim, p.bore_edge)
    body -= rod(p.recess, p.recess_depth)
    for x, y in circle(p.screws, p.screw_circle):
        body -= rod(p.screw, p.thick, (x, y, 0))
        body -= rod(p.head, p.head_depth, (x, y, p.thick - p.head_depth))
    for sign in (-1, 1):
        body -= rod(p.dowel, p.thick, (0, sign * p.dowel_circle / 2, 0))
    for index, (x, y) in enumerate(circle(p.windows, p.window_circle, 45)):
        body -= slot(*p.window, p.thick, (x, y, p.thick), rotation=45 + 90 * index + 90)
    body -= rod(p.mark, p.mark_depth, (p.mark_at, 0, p.thick - p.mark_depth))
    return body
