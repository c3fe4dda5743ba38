"""A valve block in inches: a deep bore along x, counterbored ports on top, a nut hole at the back, chamfered edges."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, chamfer

from benchmark.kit import INCH, Item, Model, count, length, lengths, point, size
from benchmark.shapes import BACK, DOWN, FRONT, LEFT, block, prism, rod

MODEL = Model("Valve block", "dev", unit="in")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres from inches; the block's underside is z = 0, its middle x = y = 0."""

    width: float = 4 * INCH
    depth: float = 2 * INCH
    height: float = 1.5 * INCH
    bevel: float = 0.125 * INCH
    spool: float = 0.75 * INCH  # bore from the right, blind
    spool_depth: float = 3.25 * INCH
    spool_height: float = 0.8 * INCH
    ports: int = 3
    port: float = 0.25 * INCH
    port_head: float = 0.5 * INCH
    port_head_depth: float = 0.2 * INCH
    port_pitch: float = 0.9 * INCH
    nut: float = 0.5 * INCH  # across flats
    nut_depth: float = 0.25 * INCH
    nut_x: float = -1.6 * INCH
    nut_z: float = 1.0 * INCH
    fixing: float = 0.28 * INCH  # through, from front to back, at both lower ends
    fixing_x: float = 3.5 * INCH
    fixing_z: float = 0.25 * INCH


def build(p: P) -> Part:
    """Chamfers the block, then bores."""
    body = block((p.width, p.depth, p.height))
    body = chamfer(body.edges().group_by(Axis.Z)[-1], p.bevel)
    body -= rod(p.spool, p.spool_depth, (p.width / 2, 0, p.spool_height), LEFT)
    for index in range(p.ports):
        x = (index - 1) * p.port_pitch
        body -= rod(p.port, p.height - p.spool_height, (x, 0, p.height), DOWN)
        body -= rod(p.port_head, p.port_head_depth, (x, 0, p.height), DOWN)
    for x in (-p.fixing_x / 2, p.fixing_x / 2):
        body -= rod(p.fixing, p.depth, (x, p.depth / 2, p.fixing_z), FRONT)
    return body - prism(p.nut, p.nut_depth, (p.nut_x, p.depth / 2 - p.nut_depth, p.nut_z), BACK)


def questions(p: P) -> list[Item]:
    """Asked by a hydraulics engineer who thinks in inches and by one who does not."""
    return [
        count("hole", "How many counterbored holes are visible from the top?", p.ports),
        length("hole", "diameter", "What is the bore diameter of a counterbored port, not of the counterbore?", p.port),
        lengths("hole", "radius", "What are the radii of the holes on top?", [p.port / 2] * p.ports),
        length(
            "hole", "distance", "How far are neighbouring ports on the top apart from centre to centre?", p.port_pitch
        ),
        length("blind hole", "diameter", "What diameter has the hole visible from the right?", p.spool),
        length("blind hole", "depth", "How deep is the hole in the right side?", p.spool_depth),
        length("nut hole", "width", "How wide across its flats is the nut hole?", p.nut),
        length("nut hole", "depth", "What's the depth of the hexagonal pocket at the back?", p.nut_depth),
        point("nut hole", "What is the center of the nut hole?", (p.nut_x, p.depth / 2 - p.nut_depth / 2, p.nut_z)),
        count("through hole", "How many round holes are visible from the front?", 2),
        lengths("through hole", "diameter", "Diameters of the holes seen from the front?", [p.fixing] * 2),
        length("through hole", "distance", "What is the distance between the two holes in the front face?", p.fixing_x),
        count("bevel", "How many bevels are there on the top edges?", 4),
        size("object", "Give the size of the block.", (p.width, p.depth, p.height)),
        length("object", "height", "How tall is the object in total?", p.height),
        count("hole", "How many holes have a diameter between 6 and 8 mm?", p.ports + 2),
    ]
