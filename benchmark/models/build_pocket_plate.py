"""A milled workpiece carrier: rectangular indentations, obround slot, counterbored and blind holes, bevelled rim."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

from build123d import Axis, Part, chamfer, fillet

from benchmark.kit import Item, Model, area, count, length, lengths, points
from benchmark.shapes import DOWN, block, grid, rod, slot

MODEL = Model("Milled workpiece carrier", "dev")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the carrier lies on z = 0."""

    size: tuple[float, float, float] = (200, 120, 20)
    rim: float = 2
    pockets: int = 3
    pocket: tuple[float, float, float] = (36, 50, 8)
    pocket_corner: float = 4
    pocket_pitch: float = 50
    pocket_y: float = 12
    slot_length: float = 90
    slot_width: float = 10
    slot_depth: float = 6
    slot_y: float = -36
    bolts: int = 4
    bolt: float = 6.6
    head: float = 11
    head_depth: float = 6.8
    bolt_span: tuple[float, float] = (176, 96)
    pins: int = 2
    pin: float = 5
    pin_depth: float = 12
    pin_spacing: float = 140
    pin_y: float = -36

    def bolts_at(self) -> list[tuple[float, float]]:
        """Where are the counterbored holes?"""
        return grid(2, 2, *self.bolt_span)

    def pockets_at(self) -> list[tuple[float, float]]:
        """Where are the pockets?"""
        return grid(self.pockets, 1, self.pocket_pitch, 0, (0, self.pocket_y))


def build(p: P) -> Part:
    """Bevels the upper rim, mills and drills from above."""
    top = p.size[2]
    plate = block(p.size)
    plate = chamfer(plate.edges().group_by(Axis.Z)[-1], p.rim)
    tools: list[Part] = []
    for x, y in p.pockets_at():
        pocket = block(p.pocket, (x, y, top - p.pocket[2]))
        tools.append(fillet(pocket.edges().filter_by(Axis.Z), p.pocket_corner))
    tools.append(slot(p.slot_length, p.slot_width, p.slot_depth, (0, p.slot_y, top)))
    for x, y in p.bolts_at():
        tools += [rod(p.bolt, top, (x, y, 0)), rod(p.head, p.head_depth, (x, y, top), DOWN)]
    tools += [rod(p.pin, p.pin_depth, (x, p.pin_y, top), DOWN) for x in (-p.pin_spacing / 2, p.pin_spacing / 2)]
    return plate - tools


def questions(p: P) -> list[Item]:
    """Asked by machinists, fixture designers and a robot programmer."""
    top, n = p.size[2], p.pockets
    return [
        count("rectangular indentation", "How many rectangular indentations are in the top of the carrier?", n),
        lengths(
            "rectangular indentation", "depth", "What is the depth of the rectangular indentations?", [p.pocket[2]] * n
        ),
        lengths(
            "rectangular indentation", "width", "How wide (along x) is each rectangular pocket?", [p.pocket[0]] * n
        ),
        points(
            "rectangular indentation",
            "Where are the centres of the rectangular pockets, half-way down?",
            [(x, y, top - p.pocket[2] / 2) for x, y in p.pockets_at()],
        ),
        length(
            "rectangular indentation",
            "radius",
            "Which radius do the vertical corners of the pockets have?",
            p.pocket_corner,
        ),
        length("slot", "width", "What is the width of the slot with round ends?", p.slot_width),
        length("slot", "length", "How long is the long slot with the round ends, over all?", p.slot_length),
        length("slot", "depth", "How deep was the obround slot milled?", p.slot_depth),
        count("mounting hole", "How many counterbored holes are there?", p.bolts),
        lengths("mounting hole", "diameter", "Bore diameter of the counterbored holes?", [p.bolt] * p.bolts),
        points(
            "mounting hole",
            "The robot needs the centre positions of the four counterbored holes.",
            [(x, y, top / 2) for x, y in p.bolts_at()],
        ),
        count("blind hole", "How many round blind holes are visible from the top?", p.pins),
        lengths("blind hole", "depth", "How deep are the round blind holes?", [p.pin_depth] * p.pins),
        lengths("blind hole", "radius", "Radii of the round blind holes?", [p.pin / 2] * p.pins),
        length("bevel", "size", "How wide is the 45 degree bevel around the upper rim, measured along z?", p.rim),
        area(
            "object",
            "What is the area of the flat underside, holes taken off?",
            p.size[0] * p.size[1] - p.bolts * pi / 4 * p.bolt**2,
        ),
    ]
