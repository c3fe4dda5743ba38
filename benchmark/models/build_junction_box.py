"""A junction box: enclosure with lugs and standoffs, carrier with terminals, two glands, a plug, a screwed lid."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Compound, Part

from benchmark.kit import Item, Model, count, length, lengths, point, size, text, texts
from benchmark.shapes import BACK, DOWN, FRONT, LEFT, RIGHT, Vector, assembly, block, grid, named, prism, rod, slot

MODEL = Model("Junction box with cable glands", "held_out", bodies=15)
TERMINALS = (("L1", "SaddleBrown"), ("L2", "Black"), ("L3", "Gray"), ("N", "Blue"), ("PE", "GreenYellow"))


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the enclosure stands on z = 0, its middle is x = y = 0, the lid lies on top."""

    box: tuple[float, float, float] = (130, 90, 50)  # without lugs and lid
    wall: float = 3
    lug: tuple[float, float, float] = (14, 34, 5)
    slot: tuple[float, float] = (12, 6)  # along y and x
    post: float = 10  # side of the corner posts
    screw: float = 4
    screw_length: float = 18  # below the head
    head: float = 8
    head_height: float = 3.5
    screw_span: tuple[float, float] = (114, 74)
    lid: float = 4
    lid_hole: float = 4.5
    standoff: float = 9
    standoff_height: float = 8
    standoff_hole: float = 3.3
    standoff_depth: float = 6
    standoff_span: tuple[float, float] = (76, 40)
    carrier: tuple[float, float, float] = (90, 50, 2)
    carrier_hole: float = 3.6
    terminal: tuple[float, float, float] = (12, 28, 16)
    pitch: float = 13.5
    gland: float = 20
    gland_inside: float = 12  # from the wall's outer face inwards
    gland_bore: float = 11
    flats: float = 24
    hexagon: float = 6
    dome: float = 18
    dome_length: float = 10
    gland_z: float = 27
    plug: float = 16
    plug_cap: float = 22
    plug_cap_height: float = 3


def enclosure(p: P) -> Part:
    """The box with lugs, posts, standoffs and openings."""
    width, depth, height = p.box
    body = block(p.box) - block((width - 2 * p.wall, depth - 2 * p.wall, height - p.wall), (0, 0, p.wall))
    for x, y in grid(2, 2, *p.screw_span):
        body += block((p.post, p.post, height - p.wall), (x, y, p.wall))
    body -= [rod(p.screw, p.screw_length - p.lid, (x, y, height), DOWN) for x, y in grid(2, 2, *p.screw_span)]
    for side in (-1, 1):
        x = side * (width + p.lug[0]) / 2
        body += block(p.lug, (x, 0, 0))
        body -= slot(*p.slot, p.lug[2], (x, 0, p.lug[2]), DOWN, 90)
    for x, y in grid(2, 2, *p.standoff_span):
        top = p.wall + p.standoff_height
        body += rod(p.standoff, p.standoff_height, (x, y, p.wall))
        body -= rod(p.standoff_hole, p.standoff_depth, (x, y, top), DOWN)
    body -= rod(p.gland, width, (-width / 2, 0, p.gland_z), RIGHT)
    return body - rod(p.plug, p.wall, (0, -depth / 2, p.gland_z), BACK)


def gland(p: P, side: int) -> Part:
    """A cable gland through the left (-1) or right (1) wall."""
    x, outward, inward = side * p.box[0] / 2, LEFT if side < 0 else RIGHT, RIGHT if side < 0 else LEFT
    end: Vector = (x + side * (p.hexagon + p.dome_length), 0, p.gland_z)
    body = prism(p.flats, p.hexagon, (x, 0, p.gland_z), outward) + rod(
        p.dome, p.hexagon + p.dome_length, (x, 0, p.gland_z), outward
    )
    body += rod(p.gland, p.gland_inside, (x, 0, p.gland_z), inward)
    return body - rod(p.gland_bore, p.hexagon + p.dome_length + p.gland_inside, end, inward)


def build(p: P) -> Compound:
    """Mounts the carrier on the standoffs, glands and plug in the walls, the lid on the rim."""
    width, depth, height = p.box
    low = p.wall + p.standoff_height
    carrier = block(p.carrier, (0, 0, low)) - [
        rod(p.carrier_hole, p.carrier[2], (x, y, low)) for x, y in grid(2, 2, *p.standoff_span)
    ]
    lid = block((width, depth, p.lid), (0, 0, height)) - [
        rod(p.lid_hole, p.lid, (x, y, height)) for x, y in grid(2, 2, *p.screw_span)
    ]
    plug = rod(p.plug, p.wall, (0, -depth / 2, p.gland_z), BACK)
    plug += rod(p.plug_cap, p.plug_cap_height, (0, -depth / 2, p.gland_z), FRONT)
    top = height + p.lid
    screws = [
        rod(p.screw, p.screw_length, (x, y, top), DOWN) + rod(p.head, p.head_height, (x, y, top))
        for x, y in grid(2, 2, *p.screw_span)
    ]
    terminals = [
        named(block(p.terminal, (x, 0, low + p.carrier[2])), f"Terminal {name}", color)
        for (name, color), (x, _) in zip(TERMINALS, grid(len(TERMINALS), 1, p.pitch, 0), strict=True)
    ]
    return assembly(
        [
            named(enclosure(p), "Enclosure", "LightGray"),
            named(lid, "Lid", "Gainsboro"),
            named(carrier, "Carrier plate", "Beige"),
            *terminals,
            named(gland(p, -1), "Cable gland left", "DimGray"),
            named(gland(p, 1), "Cable gland right", "DimGray"),
            named(plug, "Blanking plug", "Silver"),
            *[named(screw, f"Lid screw {n}", "SlateGray") for n, screw in enumerate(screws, start=1)],
        ]
    )


def questions(p: P) -> list[Item]:
    """Asked by an electrician, a storekeeper, a panel builder from abroad and an assembly planner."""
    width, depth, height = p.box
    return [
        count("object", "how many seperate parts are in this file", 15),
        texts("rectangular part", "names of the terminals please", [f"Terminal {name}" for name, _ in TERMINALS]),
        text("rectangular part", "Inside there is one blue block. What is it called in the file?", "Terminal N"),
        length("rectangular part", "thickness", "lid thickness?", p.lid),
        count("screw", "With how much screws is the lid fixed on the box?", 4),
        length("screw head", "diameter", "lid screws - head dia (one number, they're all the same)", p.head),
        length(
            "screw",
            "length",
            "I'd like to order a spare lid screw. How long is it in total, its head included?",
            p.screw_length + p.head_height,
        ),
        lengths(
            "standoff with hole",
            "height",
            "The carrier plate rests on four round standoffs. How high are they, from the floor of the enclosure?",
            [p.standoff_height] * 4,
        ),
        length("rectangular inside", "thickness", "wall thickness of the enclosure", p.wall),
        length("hexagon", "width", "Which spanner for the left cable gland? (hexagon, across flats)", p.flats),
        length(
            "tube",
            "diameter",
            "What's the thickest round cable that can be pushed through the right gland, going by its bore?",
            p.gland_bore,
        ),
        lengths("slot", "length", "slots in the two lugs, how long are they over all?", [p.slot[0]] * 2),
        length(
            "slot",
            "distance",
            "We drill the wall before the box arrives. What is the centre distance of the slots in the mounting lugs?",
            width + p.lug[0],
        ),
        length(
            "rectangular part",
            "distance",
            "What gap is free between two neighbouring terminals?",
            p.pitch - p.terminal[0],
        ),
        point("rectangular part", "Coordinates of the middle of the lid, please.", (0, 0, height + p.lid / 2)),
        size(
            "object",
            "what is the size of complete box with everything mounted, x / y / z",
            (
                width + 2 * max(p.lug[0], p.hexagon + p.dome_length),
                depth + p.plug_cap_height,
                height + p.lid + p.head_height,
            ),
            "extents",
        ),
    ]
