"""A 19 inch rack shelf bent from sheet: front with ears, tray with vent slots, side flanges, a rear lip."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Align, Axis, Box, Part, Plane, Pos, Rectangle, Rot, extrude, fillet

from benchmark.kit import Model
from benchmark.shapes import BACK, block, grid, rod, slot

MODEL = Model("Rack shelf", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the tray's underside is z = 0, the front's face y = 0, the tray goes to +y, the middle is x = 0."""

    sheet: float = 1.5
    bend: float = 1.5  # inner radius
    width: float = 440  # outside of the side flanges
    depth: float = 250  # from the front's face to the rear lip's back
    flange: float = 30  # height of the sides, from the underside
    lip: float = 15  # height of the rear lip, from the underside
    gap: float = 4  # between the sides and the front, and the lip
    front: tuple[float, float] = (482.6, 43.6)  # width, height
    relief: float = 4  # cut beside the front's bend
    ear_slot: tuple[float, float] = (10.3, 6.8)
    ear_x: float = 465.1  # between the slots of both ears
    ear_z: float = 31.75  # between the slots of one ear
    vent: tuple[float, float] = (40, 5)  # length along y, width
    vents: tuple[int, int] = (8, 3)  # along x, along y
    vent_pitch: tuple[float, float] = (48, 60)
    vent_y: float = 120  # of the field's middle, from the front's face
    grommet: float = 25
    grommet_at: tuple[float, float] = (180, 222)
    tie: float = 4.5  # holes for cable ties
    ties: int = 4
    tie_pitch: float = 80
    tie_at: tuple[float, float] = (-20, 222)  # of the row's middle


def _angle(p: P, length: float, a: float, b: float) -> Part:
    """A bent angle along x from x = 0: leg a lies on z = 0 to +y, leg b stands at y = 0."""
    low = (Align.MIN, Align.MIN)
    profile = Plane.YZ * Rectangle(a, b, align=low) - Plane.YZ * Pos(p.sheet, p.sheet) * Rectangle(a, b, align=low)
    solid = extrude(profile, amount=length, dir=(1, 0, 0))
    edges = solid.edges().filter_by(Axis.X)
    inner = edges.sort_by(lambda e: (e.center().Y - p.sheet) ** 2 + (e.center().Z - p.sheet) ** 2)[0]
    solid = fillet(inner, p.bend)
    outer = solid.edges().filter_by(Axis.X).sort_by(lambda e: e.center().Y ** 2 + e.center().Z ** 2)[0]
    return fillet(outer, p.bend + p.sheet)


def build(p: P) -> Part:
    """Joins the bent angles to the tray, then punches."""
    half = p.width / 2
    reach = 40  # of the angles' legs into the tray, all in one plane with it
    inset = p.sheet + p.bend  # where the flat of the tray begins
    tray = Pos(0, p.depth / 2, 0) * Box(
        p.width - 2 * inset, p.depth - 2 * (inset + p.gap), p.sheet, align=(Align.CENTER, Align.CENTER, Align.MIN)
    )
    inner = p.width - 2 * (inset + p.relief)
    body = tray
    body += Pos(-inner / 2, 0, 0) * _angle(p, inner, reach, p.front[1])
    body += Pos(inner / 2, p.depth, 0) * (Rot(0, 0, 180) * _angle(p, inner, reach, p.lip))
    side = p.depth - 2 * (inset + p.gap)
    body += Pos(-half, p.depth / 2 + side / 2, 0) * (Rot(0, 0, -90) * _angle(p, side, reach, p.flange))
    body += Pos(half, p.depth / 2 - side / 2, 0) * (Rot(0, 0, 90) * _angle(p, side, reach, p.flange))
    for end in (-1, 1):
        width = (p.front[0] - inner) / 2
        ear = block((width, p.sheet, p.front[1]), (end * (inner + width) / 2, p.sheet / 2, 0))
        notch = block((p.relief, p.sheet, 2 * inset), (end * (inner + p.relief) / 2, p.sheet / 2, 0))
        body += ear - notch
        for up in (-1, 1):
            at = (end * p.ear_x / 2, 0, p.front[1] / 2 + up * p.ear_z / 2)
            body -= slot(*p.ear_slot, p.sheet, at, BACK)
    for at in grid(*p.vents, *p.vent_pitch, (0, p.vent_y)):
        body -= slot(*p.vent, p.sheet, (*at, p.sheet), rotation=90)
    body -= rod(p.grommet, p.sheet, (*p.grommet_at, 0))
    for at in grid(p.ties, 1, p.tie_pitch, 0, p.tie_at):
        body -= rod(p.tie, p.sheet, (*at, 0))
    return body
