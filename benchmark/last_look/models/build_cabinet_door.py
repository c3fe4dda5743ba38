"""A sheet-metal door of a switch cabinet: folded edges, returns on the long sides, window, lock hole, vent slots."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, fillet

from benchmark.kit import Model
from benchmark.shapes import BACK, RIGHT, UP, block, grid, rod, slot

MODEL = Model("Cabinet door", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the front face is z = 0, its middle is x = y = 0, y is up the door, the hinges are at -x."""

    width: float = 400
    height: float = 600
    depth: float = 20  # of the folded edges
    sheet: float = 1.5
    bend: float = 1.5  # inside radius of every bend
    back: float = 25  # width of the returns of the long sides, outside
    flange: float = 340  # length of the top and bottom edges
    window: tuple[float, float] = (200, 140)
    window_corner: float = 8
    window_y: float = 150  # of its middle
    lock: float = 22  # diameter of the lock hole
    lock_flats: float = 20  # across its two flats
    lock_x: float = 150  # from the middle line
    lock_y: float = -40
    slots: int = 8
    slot: tuple[float, float] = (120, 6)
    slots_pitch: float = 16
    slots_y: float = -195  # middle of the field
    hinge: float = 6.5  # holes in the left edge
    hinge_pitch: float = 40  # within a pair
    hinges: float = 420  # between the middles of the pairs
    hinge_z: float = 10
    earth: float = 8.5  # hole in the lower edge
    earth_x: float = 120
    earth_z: float = 11


def _channel(width: float, depth: float, length: float, sheet: float, bend: float) -> Part:
    """A closed, rounded hollow section along y, its outer front face on z = 0."""
    outer = block((width, length, depth))
    outer = fillet(outer.edges().filter_by(Axis.Y), bend + sheet)
    inner = block((width - 2 * sheet, length, depth - 2 * sheet), (0, 0, sheet))
    return outer - fillet(inner.edges().filter_by(Axis.Y), bend)


def _flange(p: P) -> Part:
    """The upper edge with its bend, to be joined to a panel that ends where the bend begins."""
    radius = p.bend + p.sheet
    tall = block((p.flange, 2 * p.depth, 2 * p.depth), (0, p.height / 2 - p.depth, 0))
    tall = fillet(tall.edges().filter_by(Axis.X).sort_by(lambda e: e.center().Y - e.center().Z)[-1], radius)
    hollow = block((p.flange, 2 * p.depth, 2 * p.depth), (0, p.height / 2 - p.depth - p.sheet, p.sheet))
    hollow = fillet(hollow.edges().filter_by(Axis.X).sort_by(lambda e: e.center().Y - e.center().Z)[-1], p.bend)
    end = p.height / 2 - radius
    return (tall - hollow) & block((p.flange, radius, p.depth), (0, end + radius / 2, 0))


def build(p: P) -> Part:
    """Folds the blank, then shows the cut-outs."""
    radius = p.bend + p.sheet
    straight = p.height - 2 * radius
    body = _channel(p.width, p.depth, straight, p.sheet, p.bend)
    body -= block((p.width - 2 * p.back, straight, p.sheet), (0, 0, p.depth - p.sheet))
    flange = _flange(p)
    body += flange
    body += flange.rotate(Axis.Z, 180)
    pane = block((*p.window, p.sheet), (0, p.window_y, 0))
    body -= fillet(pane.edges().filter_by(Axis.Z), p.window_corner)
    lock = rod(p.lock, p.sheet, (p.lock_x, p.lock_y, 0)) & block(
        (p.lock_flats, p.lock, p.sheet), (p.lock_x, p.lock_y, 0)
    )
    body -= lock
    for _, y in grid(1, p.slots, 0, p.slots_pitch, (0, p.slots_y)):
        body -= slot(*p.slot, p.sheet, (0, y, 0), UP)
    for y in (-p.hinges / 2, p.hinges / 2):
        for half in (-p.hinge_pitch / 2, p.hinge_pitch / 2):
            body -= rod(p.hinge, p.sheet, (-p.width / 2, y + half, p.hinge_z), RIGHT)
    body -= rod(p.earth, p.sheet, (p.earth_x, -p.height / 2, p.earth_z), BACK)
    return body
