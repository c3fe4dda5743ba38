"""A tray for a hard drive, bent from sheet: standoffs with and without hole, cutout, slots, finger notch."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, fillet

from benchmark.kit import Item, Model, count, length, lengths, size
from benchmark.shapes import LEFT, block, grid, rod, slot

MODEL = Model("Drive tray", "dev")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the tray lies on z = 0, its two side walls stand at left and right, the notch is at the front."""

    size: tuple[float, float, float] = (110, 150, 26)
    sheet: float = 1.5
    bend: float = 3.5  # outer radius
    standoff: float = 6.5
    standoff_height: float = 5
    standoff_hole: float = 3.2
    standoff_span: tuple[float, float] = (76, 96)
    post: float = 5
    post_height: float = 4
    post_y: float = 62
    post_span: float = 40
    cutout: tuple[float, float] = (50, 36)
    slots: int = 5
    slot: tuple[float, float] = (18, 3)  # length over all, width
    slot_pitch: float = 7
    slot_y: float = -42  # of the middle slot
    notch: float = 12  # radius
    wall_holes: int = 3
    wall_hole: float = 3.6
    wall_pitch: float = 42
    wall_z: float = 14


def build(p: P) -> Part:
    """Bends the tray, sets standoffs and posts, punches everything."""
    width, depth, height = p.size
    outer = block(p.size)
    bends = [e for e in outer.edges().filter_by(Axis.Y) if e.center().Z < 1e-6]
    inner = block((width - 2 * p.sheet, depth, height), (0, 0, p.sheet))
    corners = [e for e in inner.edges().filter_by(Axis.Y) if e.center().Z - p.sheet < 1e-6]
    body = fillet(bends, p.bend) - fillet(corners, p.bend - p.sheet)
    for x, y in grid(2, 2, *p.standoff_span):
        body += rod(p.standoff, p.standoff_height, (x, y, p.sheet))
        body -= rod(p.standoff_hole, p.sheet + p.standoff_height, (x, y, 0))
    body += [rod(p.post, p.post_height, (x, p.post_y, p.sheet)) for x in (-p.post_span / 2, p.post_span / 2)]
    body -= block((*p.cutout, p.sheet))
    for _, y in grid(1, p.slots, 0, p.slot_pitch, (0, p.slot_y)):
        body -= slot(*p.slot, p.sheet, (0, y, p.sheet))
    body -= rod(2 * p.notch, p.sheet, (0, -depth / 2, 0))
    for _, y in grid(1, p.wall_holes, 0, p.wall_pitch):
        body -= rod(p.wall_hole, width, (width / 2, y, p.wall_z), LEFT)
    return body


def questions(p: P) -> list[Item]:
    """Asked in the plain way, and by a sheet-metal worker, a PC builder and a server technician."""
    return [
        count("standoff with hole", "Give me the number of standoffs that have a hole.", 4),
        count("standoff without hole", "How many standoffs have no hole?", 2),
        lengths(
            "standoff with hole",
            "diameter",
            "State the outer diameters of the standoffs with a hole.",
            [p.standoff] * 4,
        ),
        lengths(
            "standoff without hole",
            "height",
            "Heights of the standoffs without a hole, measured from the floor of the tray?",
            [p.post_height] * 2,
        ),
        lengths("standoff with hole", "radius", "Radius of the holes in the standoffs?", [p.standoff_hole / 2] * 4),
        length("object", "thickness", "Which sheet thickness is the tray made of?", p.sheet),
        length("semicircle", "radius", "Determine the radius of the semicircle at the front edge.", p.notch),
        lengths(
            "mounting hole",
            "diameter",
            "Diameter of the mounting holes in the right-hand side wall?",
            [p.wall_hole] * p.wall_holes,
        ),
        size("object", "What are the external dimensions of the tray in x, y and z?", p.size),
        lengths("slot", "width", "Give the width of each of the obround slots.", [p.slot[1]] * p.slots),
        length("bend", "radius", "outer bend radius between floor and side walls?", p.bend),
        length(
            "cutout",
            "width",
            "There is a big rectangular opening in the floor. How wide is it from left to right?",
            p.cutout[0],
        ),
        count("slot", "how many long ventilation slots with rounded ends does the floor have", p.slots),
        length(
            "mounting hole",
            "distance",
            "On the left side wall: how far is it from one screw hole to the next?",
            p.wall_pitch,
        ),
    ]
