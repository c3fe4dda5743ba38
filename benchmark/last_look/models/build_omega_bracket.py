"""A hat-shaped sheet bracket: two flanges with a slot each, two webs with a cable hole, a top with tapped holes."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, Plane, Polygon, chamfer, extrude, fillet

from benchmark.kit import Model
from benchmark.shapes import RIGHT, block, grid, rod, slot

MODEL = Model("Omega bracket", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the flanges lie on z = 0, the middle is x = y = 0, the profile runs along y."""

    sheet: float = 3
    radius: float = 3  # inside of the bends
    top: float = 76  # outer width of the hat
    height: float = 42
    depth: float = 56
    flange: float = 29  # from the web's outside to the edge
    flange_corner: float = 7  # cut at 45 degrees
    slot: tuple[float, float] = (18, 7)  # along y
    slot_x: float = 54  # from the middle
    web_hole: float = 16
    web_z: float = 21
    tapped: float = 5  # core hole of M6
    tapped_x: float = 52
    tapped_y: float = 34
    window: tuple[float, float] = (28, 18)

    @property
    def width(self) -> float:
        """Over both flanges."""
        return self.top + 2 * self.flange


def build(p: P) -> Part:
    """Profile, bends, then punches."""
    t, w, o, h = p.sheet, p.top / 2, p.width / 2, p.height
    half = [(o, 0), (o, t), (w, t), (w, h)]  # outside
    inside = [(w - t, h - t), (w - t, 0)]
    right = [(w - t, 0), *half]
    outline = [*right, *[(-x, z) for x, z in reversed(right)], (-inside[0][0], inside[0][1]), inside[0]]
    body = extrude((Plane.XZ * Polygon(*outline, align=None)).face(), amount=p.depth / 2, both=True)

    def pick(shape: Part, spots: list[tuple[float, float]]):
        return [
            e
            for e in shape.edges().filter_by(Axis.Y)
            if any(abs(abs(e.center().X) - x) < 1e-3 and abs(e.center().Z - z) < 1e-3 for x, z in spots)
        ]

    body = fillet(pick(body, [(w - t, 0), (w, h)]), p.radius + t)
    body = fillet(pick(body, [(w, t), (w - t, h - t)]), p.radius)
    corners = [e for e in body.edges().filter_by(Axis.Z) if abs(abs(e.center().X) - o) < 1e-3]
    body = chamfer(corners, p.flange_corner)
    for x in (-p.slot_x, p.slot_x):
        body -= slot(*p.slot, t, (x, 0, t), rotation=90)
    body -= rod(p.web_hole, p.top, (-w, 0, p.web_z), RIGHT)
    for x, y in grid(2, 2, p.tapped_x, p.tapped_y):
        body -= rod(p.tapped, t, (x, y, h - t))
    return body - block((*p.window, t), (0, 0, h - t))
