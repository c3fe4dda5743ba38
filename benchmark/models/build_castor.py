"""A fixed castor: top plate with slots, fork, wheel with tyre and bush, axle bolt and nut, as named bodies."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Compound, Part

from benchmark.kit import Item, Model, count, length, lengths, point
from benchmark.shapes import BACK, FRONT, assembly, block, grid, named, prism, rod, slot

MODEL = Model("Fixed castor", "dev", bodies=7)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the wheel stands on z = 0, its axis runs along y above x = 0, its middle is y = 0."""

    plate: tuple[float, float, float] = (105, 85, 6)
    slots: int = 4
    slot: tuple[float, float] = (13, 9)  # along x and y
    slot_span: tuple[float, float] = (80, 66)
    tyre: float = 100
    tyre_width: float = 32
    centre: float = 78  # diameter of the wheel centre, where the tyre begins
    bush: float = 20
    bolt: float = 12
    bolt_length: float = 65  # below the head
    flats: float = 18  # ISO 4014, ISO 4032
    head: float = 7.5
    nut: float = 10.8
    gap: float = 40  # between the legs; also the bush's length
    leg: tuple[float, float] = (46, 4)  # along x and y
    leg_foot: float = 34  # height of the legs' lower ends
    crown: float = 4
    height: float = 116  # of the plate's upper face

    @property
    def flank(self) -> float:
        """Where on y are the legs' outer faces?"""
        return self.gap / 2 + self.leg[1]


def fork(p: P) -> Part:
    """Two legs under a crown, drilled for the bolt."""
    top = p.height - p.plate[2]
    body = block((p.leg[0], 2 * p.flank, p.crown), (0, 0, top - p.crown))
    y = (p.gap + p.leg[1]) / 2
    body += [block((*p.leg, top - p.leg_foot), (0, side * y, p.leg_foot)) for side in (-1, 1)]
    return body - rod(p.bolt, 2 * p.flank, (0, -p.flank, p.tyre / 2), BACK)


def wheel(p: P, outer: float, inner: float, width: float) -> Part:
    """A ring about the wheel's axis."""
    start = (0, -width / 2, p.tyre / 2)
    return rod(outer, width, start, BACK) - rod(inner, width, start, BACK)


def build(p: P) -> Compound:
    """Bolts the wheel into the fork, the fork below the plate."""
    axle = p.tyre / 2
    low = p.height - p.plate[2]
    plate = block(p.plate, (0, 0, low)) - [
        slot(*p.slot, p.plate[2], (x, y, p.height)) for x, y in grid(2, p.slots // 2, *p.slot_span)
    ]
    bolt = rod(p.bolt, p.bolt_length, (0, -p.flank, axle), BACK) + prism(p.flats, p.head, (0, -p.flank, axle), FRONT)
    start = (0, p.flank, axle)
    nut = prism(p.flats, p.nut, start, BACK) - rod(p.bolt, p.nut, start, BACK)
    return assembly(
        [
            named(plate, "Top plate", "Silver"),
            named(fork(p), "Fork", "LightSteelBlue"),
            named(wheel(p, p.tyre, p.centre, p.tyre_width), "Tyre", "DimGray"),
            named(wheel(p, p.centre, p.bush, p.tyre_width), "Wheel centre", "OrangeRed"),
            named(wheel(p, p.bush, p.bolt, p.gap), "Bush", "Goldenrod"),
            named(bolt, "Axle bolt", "SlateGray"),
            named(nut, "Nut", "Gray"),
        ]
    )


def questions(p: P) -> list[Item]:
    """Asked in the plain way, and by a storekeeper, a maintenance man and a buyer."""
    return [
        count("slot", "How many slots are visible from the top?", p.slots),
        lengths("slot", "width", "What is the width of the slots on the top?", [p.slot[1]] * p.slots),
        length("rectangular part", "thickness", "What is the thickness of the top plate?", p.plate[2]),
        length("screw head", "height", "What is the height of the screw head on the front?", p.head),
        length("ring", "diameter", "What is the outer diameter of the tyre?", p.tyre),
        point("ring", "What is the center of the tyre?", (0, 0, p.tyre / 2)),
        length("object", "height", "What is the total height of the object?", p.height),
        lengths("leg", "thickness", "sheet thickness of the fork's legs?", [p.leg[1]] * 2),
        length("leg", "distance", "What is the clear gap between the two legs of the fork?", p.gap),
        length("hexagonal screw head", "width", "What size of spanner for the hex head of the axle bolt", p.flats),
        length(
            "screw",
            "length",
            "Total length of the axle bolt, from the top of its head to the end of the thread?",
            p.bolt_length + p.head,
        ),
        length("nut", "height", "How thick is the nut?", p.nut),
        length("tube", "thickness", "whats the wall thickness of the bush in the wheel", (p.bush - p.bolt) / 2),
        count("object", "Out of how many single parts is the castor assembled?", 7),
    ]
