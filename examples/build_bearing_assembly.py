"""A small assembly: base plate, bearing block, bushing, shaft and four socket-head screws, each named and coloured."""

from __future__ import annotations

from copy import copy
from dataclasses import dataclass

from build123d import (
    Align,
    Axis,
    Box,
    BuildPart,
    BuildSketch,
    Color,
    Compound,
    CounterBoreHole,
    Cylinder,
    GridLocations,
    Hole,
    Location,
    Locations,
    Mode,
    Part,
    Plane,
    Pos,
    RegularPolygon,
    chamfer,
    extrude,
    fillet,
)

from _example import count, length, point, publish, size

UP = (Align.CENTER, Align.CENTER, Align.MIN)


@dataclass(frozen=True, slots=True)
class BearingAssembly:
    """Millimetres; the plate lies on z = 0, the shaft runs along y. Screws after ISO 4762, bushing after ISO 4379."""

    plate_size: tuple[float, float, float] = (150, 90, 15)
    plate_corner: float = 8
    plate_hole: float = 9
    plate_counterbore: float = 15
    plate_counterbore_depth: float = 8.6
    plate_span: tuple[float, float] = (126, 66)
    foot_size: tuple[float, float, float] = (96, 36, 9)
    foot_corner: float = 4
    tower_width: float = 46
    axis_height: float = 38
    screws: int = 4
    screw_diameter: float = 5
    screw_length: float = 16
    screw_clearance: float = 5.5
    screw_head: float = 8.5
    screw_socket: float = 4
    screw_socket_depth: float = 2.5
    screw_span: tuple[float, float] = (76, 20)
    thread_depth: float = 12
    bushing_outer: float = 26
    bushing_length: float = 36
    shaft_diameter: float = 20
    shaft_length: float = 120
    shaft_chamfer: float = 1

    @property
    def axis_z(self) -> float:
        """Height of the shaft's axis in the assembly."""
        return self.plate_size[2] + self.axis_height


def plate(p: BearingAssembly) -> Part:
    """Counterbored at its corners, threaded (drawn at the nominal diameter) under the block."""
    with BuildPart() as part:
        Box(*p.plate_size, align=UP)
        fillet(part.edges().filter_by(Axis.Z), p.plate_corner)
        with Locations((0, 0, p.plate_size[2])):
            with GridLocations(*p.plate_span, 2, 2):
                CounterBoreHole(p.plate_hole / 2, p.plate_counterbore / 2, p.plate_counterbore_depth)
            with GridLocations(*p.screw_span, 2, p.screws // 2):
                Hole(p.screw_diameter / 2, p.thread_depth)
    return part.part


def block(p: BearingAssembly) -> Part:
    """A foot and a tower that ends round about the bore; its underside lies on z = 0."""
    along = (-90, 0, 0)
    with BuildPart() as part:
        Box(*p.foot_size, align=UP)
        fillet(part.edges().filter_by(Axis.Z), p.foot_corner)
        Box(p.tower_width, p.foot_size[1], p.axis_height, align=UP)
        with Locations((0, 0, p.axis_height)):
            Cylinder(p.tower_width / 2, p.foot_size[1], rotation=along)
            Cylinder(p.bushing_outer / 2, p.foot_size[1], rotation=along, mode=Mode.SUBTRACT)
        with Locations((0, 0, p.foot_size[2])), GridLocations(*p.screw_span, 2, p.screws // 2):
            Hole(p.screw_clearance / 2)
    return part.part


def screw(p: BearingAssembly) -> Part:
    """A hexagon socket head cap screw; its head rests on z = 0, its head is as high as its thread is wide."""
    with BuildPart() as part:
        Cylinder(p.screw_diameter / 2, p.screw_length, align=(Align.CENTER, Align.CENTER, Align.MAX))
        Cylinder(p.screw_head / 2, p.screw_diameter, align=UP)
        chamfer(part.edges().group_by(Axis.Z)[0] + part.edges().group_by(Axis.Z)[-1], 0.5)
        with BuildSketch(Plane.XY.offset(p.screw_diameter)):
            RegularPolygon(p.screw_socket / 2, 6, major_radius=False)
        extrude(amount=-p.screw_socket_depth, mode=Mode.SUBTRACT)
    return part.part


def bushing(p: BearingAssembly) -> Part:
    """A plain bushing about the y axis."""
    with BuildPart() as part:
        Cylinder(p.bushing_outer / 2, p.bushing_length, rotation=(-90, 0, 0))
        Cylinder(p.shaft_diameter / 2, p.bushing_length, rotation=(-90, 0, 0), mode=Mode.SUBTRACT)
    return part.part


def shaft(p: BearingAssembly) -> Part:
    """A plain shaft about the y axis, chamfered at both ends."""
    with BuildPart() as part:
        Cylinder(p.shaft_diameter / 2, p.shaft_length, rotation=(-90, 0, 0))
        chamfer(part.edges().group_by(Axis.Y)[0] + part.edges().group_by(Axis.Y)[-1], p.shaft_chamfer)
    return part.part


def build(p: BearingAssembly) -> Compound:
    """Places the bodies and gives each its name and colour."""
    top = p.plate_size[2]
    bodies = [
        _named(plate(p), "Base plate", Color("SlateGray")),
        _named(block(p), "Bearing block", Color("SteelBlue"), Pos(0, 0, top)),
        _named(bushing(p), "ISO 4379 bushing 20x26x36", Color("Goldenrod"), Pos(0, 0, p.axis_z)),
        _named(shaft(p), "Shaft 20x120", Color("Silver"), Pos(0, 0, p.axis_z)),
    ]
    model = screw(p)
    name = f"ISO 4762 M{p.screw_diameter}x{p.screw_length}"
    places = GridLocations(*p.screw_span, 2, p.screws // 2).locations
    bodies += [
        _named(copy(model), name, Color("Firebrick"), Pos(0, 0, top + p.foot_size[2]) * place) for place in places
    ]
    return Compound(children=bodies)


def _named(part: Part, label: str, color: Color, place: Location | None = None) -> Part:
    placed = part.locate(place) if place else part
    placed.label = label
    placed.color = color
    return placed


def main() -> None:
    """Writes the model and its questions."""
    p = BearingAssembly()
    publish(
        "bearing_assembly",
        build(p),
        [
            count("How many bodies does the assembly have?", 4 + p.screws),
            count("How many screws are there?", p.screws),
            length("What is the diameter of the shaft?", p.shaft_diameter),
            length("What is the length of the shaft?", p.shaft_length),
            point("Where is the center of the shaft?", (0, 0, p.axis_z)),
            length("What is the distance between the shaft and the base plate?", p.axis_height - p.shaft_diameter / 2),
            length("What is the outer diameter of the bushing?", p.bushing_outer),
            size("What is the size of the base plate?", p.plate_size),
            size("What is the size of the assembly?", (p.plate_size[0], p.shaft_length, p.axis_z + p.tower_width / 2)),
        ],
        bodies=4 + p.screws,
    )


if __name__ == "__main__":
    main()
