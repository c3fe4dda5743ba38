"""An electric motor: housing with cooling fins and legs, adapter plate, shaft, power connector, as named bodies."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Compound, Part, chamfer

from benchmark.kit import Item, Model, count, length, lengths, point, points, size
from benchmark.shapes import RIGHT, assembly, block, circle, grid, named, rod

MODEL = Model("Electric motor", "dev", bodies=4)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is x, the housing begins at x = 0, the adapter plate and the shaft lie to its right."""

    length: float = 140
    square: float = 90
    fins: int = 7  # on the front and as many on the back
    fin: float = 3
    fin_reach: float = 10
    fin_pitch: float = 11
    fin_length: float = 120
    legs: int = 4
    leg: tuple[float, float, float] = (24, 16, 25)  # along x, y, z
    leg_span: tuple[float, float] = (100, 66)
    adapter: float = 120
    adapter_thickness: float = 12
    holes: int = 4
    hole: float = 9
    hole_circle: float = 100
    shaft: float = 19  # IEC 60072-1, frame 80
    shaft_out: float = 40
    shaft_bevel: float = 1
    plug: tuple[float, float, float] = (34, 24, 20)
    plug_x: float = 40

    @property
    def face(self) -> float:
        """Where the adapter plate ends."""
        return self.length + self.adapter_thickness

    def holes_at(self) -> list[tuple[float, float]]:
        """Where are the adapter plate's mounting holes, y and z?"""
        return circle(self.holes, self.hole_circle, 45)


def housing(p: P) -> Part:
    """A box with horizontal fins on front and back, on four legs."""
    half = p.square / 2
    body = block((p.length, p.square, p.square), (p.length / 2, 0, -half))
    for _, z in grid(1, p.fins, 0, p.fin_pitch):
        for side in (-1, 1):
            at = (p.length / 2, side * (half + p.fin_reach / 2), z - p.fin / 2)
            body += block((p.fin_length, p.fin_reach, p.fin), at)
    legs = grid(2, p.legs // 2, *p.leg_span, (p.length / 2, 0))
    return body + [block(p.leg, (x, y, -half - p.leg[2])) for x, y in legs]


def build(p: P) -> Compound:
    """Four bodies that touch."""
    tools = [rod(p.hole, p.adapter_thickness, (p.length, y, z), RIGHT) for y, z in p.holes_at()]
    tools.append(rod(p.shaft, p.adapter_thickness, (p.length, 0, 0), RIGHT))
    plate = rod(p.adapter, p.adapter_thickness, (p.length, 0, 0), RIGHT) - tools
    shaft = rod(p.shaft, p.adapter_thickness + p.shaft_out, (p.length, 0, 0), RIGHT)
    shaft = chamfer(shaft.edges().group_by(Axis.X)[-1], p.shaft_bevel)
    plug = block(p.plug, (p.plug_x, 0, p.square / 2))
    return assembly(
        [
            named(housing(p), "Motor housing", "SteelBlue"),
            named(plate, "Adapter plate", "DimGray"),
            named(shaft, "Shaft", "Silver"),
            named(plug, "Power connector", "Black"),
        ]
    )


def questions(p: P) -> list[Item]:
    """Asked by drive engineers."""
    half = p.square / 2
    ground = -half - p.leg[2]
    top = half + p.plug[2]
    shaft_length = p.adapter_thickness + p.shaft_out
    return [
        length("shaft", "diameter", "What is the diameter of the motor's shaft?", p.shaft),
        length("shaft", "length", "How long is the shaft as a body of its own?", shaft_length),
        point("shaft", "Where is the centre of the shaft?", (p.length + shaft_length / 2, 0, 0)),
        length("shaft", "distance", "How far does the shaft stick out of the adapter plate?", p.shaft_out),
        length("adapter plate", "diameter", "Diameter of the adapter plate, please.", p.adapter),
        size(
            "adapter plate",
            "What are the extents of the adapter plate?",
            (p.adapter_thickness, p.adapter, p.adapter),
            "extents",
        ),
        count("mounting hole", "How many mounting holes surround the shaft in the adapter plate?", p.holes),
        points(
            "mounting hole",
            "Where are the centres of the 9 mm holes in the adapter plate?",
            [(p.length + p.adapter_thickness / 2, y, z) for y, z in p.holes_at()],
        ),
        count("cooling fin", "How many cooling fins has the motor housing in total?", 2 * p.fins),
        count("cooling fin", "How many cooling fins are visible from the front?", p.fins),
        lengths(
            "cooling fin", "thickness", "What thickness do the cooling fins on the front side have?", [p.fin] * p.fins
        ),
        count("leg", "On how many legs does the motor stand?", p.legs),
        lengths("leg", "height", "What is the height of the motor's legs?", [p.leg[2]] * p.legs),
        size("power connector", "How big is the power connector on top (x, y, z)?", p.plug),
        point("power connector", "Position of the power connector's centre?", (p.plug_x, 0, half + p.plug[2] / 2)),
        length(
            "object",
            "height",
            "What is the overall height of the motor, from the bottom of the legs to the top of the connector?",
            top - ground,
        ),
        length("object", "length", "Overall length of the motor along x with its shaft?", p.face + p.shaft_out),
    ]
