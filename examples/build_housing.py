"""An engine-block-like housing: cylinder bores, head-bolt holes, crossing oil passages, standoffs, fins, ears."""

from __future__ import annotations

from dataclasses import dataclass
from math import radians, tan

from build123d import (
    Align,
    Axis,
    Box,
    BuildPart,
    Cone,
    Cylinder,
    GridLocations,
    Locations,
    Mode,
    Part,
    Plane,
    fillet,
    insert,
)

from _example import count, length, lengths, point, publish, size

DRILL_ANGLE = 118  # point angle of a twist drill (DIN 1412, for steel and cast iron)
DOWN = (Align.CENTER, Align.CENTER, Align.MAX)
UP = (Align.CENTER, Align.CENTER, Align.MIN)


@dataclass(frozen=True, slots=True)
class Housing:
    """Millimetres; x runs along the row of cylinders, the sump's flange lies on z = 0, the standoffs face the front."""

    length: float = 212
    width: float = 112
    height: float = 120
    corner: float = 8
    sump_length: float = 180
    sump_width: float = 82
    sump_depth: float = 42
    sump_corner: float = 12
    bores: int = 3
    bore: float = 56
    bore_pitch: float = 62
    head_bolts: int = 8
    head_bolt_hole: float = 8.5  # tap drill of M10
    head_bolt_depth: float = 25
    head_bolt_span: float = 88
    gallery: float = 10
    gallery_offset: float = 42
    gallery_height: float = 60
    feed: float = 6
    ears: int = 4
    ear: float = 30
    ear_thickness: float = 14
    ear_reach: float = 20
    ear_spacing: float = 150
    ear_hole: float = 11
    fins: int = 6
    fin_thickness: float = 4
    fin_pitch: float = 9
    fin_height: float = 12
    fin_length: float = 176
    fin_first: float = 52
    standoffs: int = 4
    standoff: float = 16
    standoff_height: float = 10
    standoff_hole: float = 5  # tap drill of M6
    standoff_depth: float = 17
    standoff_span: float = 96
    standoff_rise: float = 52
    standoff_center: float = 63
    hub: float = 52
    hub_height: float = 8
    hub_bore: float = 30
    hub_depth: float = 14
    hub_center: float = 84


def drill(diameter: float, depth: float) -> None:
    """Drills a blind hole downwards from the current locations; `depth` is the cylinder's, the tip comes below."""
    tip = diameter / 2 / tan(radians(DRILL_ANGLE / 2))
    Cylinder(diameter / 2, depth, align=DOWN, mode=Mode.SUBTRACT)
    with Locations((0, 0, -depth)):
        Cone(0, diameter / 2, tip, align=DOWN, mode=Mode.SUBTRACT)


def build(p: Housing) -> Part:
    """Adds ears, fins, standoffs and hub to the block, then cuts sump, bores and passages."""
    front = Plane((0, -p.width / 2, p.standoff_center), x_dir=(1, 0, 0), z_dir=(0, -1, 0))
    right = Plane((p.length / 2, 0, p.hub_center), x_dir=(0, 1, 0), z_dir=(1, 0, 0))
    ear_y = p.width + 2 * p.ear_reach
    with BuildPart() as part:
        Box(p.length, p.width, p.height, align=UP)
        fillet(part.edges().filter_by(Axis.Z), p.corner)
        with GridLocations(p.ear_spacing, ear_y, 2, p.ears // 2):
            Cylinder(p.ear / 2, p.ear_thickness, align=UP)
        with GridLocations(p.ear_spacing, ear_y - p.ear_reach, 2, p.ears // 2):
            Box(p.ear, p.ear_reach, p.ear_thickness, align=UP)
        with Locations(*[(0, p.width / 2, p.fin_first + index * p.fin_pitch) for index in range(p.fins)]):
            Box(p.fin_length, p.fin_height, p.fin_thickness, align=(Align.CENTER, Align.MIN, Align.CENTER))
        with Locations(front), GridLocations(p.standoff_span, p.standoff_rise, 2, p.standoffs // 2):
            Cylinder(p.standoff / 2, p.standoff_height, align=UP)
        with Locations(right):
            Cylinder(p.hub / 2, p.hub_height, align=UP)

        with BuildPart(mode=Mode.PRIVATE) as sump:
            Box(p.sump_length, p.sump_width, p.sump_depth, align=UP)
            fillet(sump.edges().filter_by(Axis.Z), p.sump_corner)
        insert(sump.part, mode=Mode.SUBTRACT)
        with Locations((0, 0, p.height)), GridLocations(p.bore_pitch, 0, p.bores, 1):
            Cylinder(p.bore / 2, p.height - p.sump_depth, align=DOWN, mode=Mode.SUBTRACT)
        with Locations((0, 0, p.height)), GridLocations(p.bore_pitch, p.head_bolt_span, p.head_bolts // 2, 2):
            drill(p.head_bolt_hole, p.head_bolt_depth)
        with Locations((0, -p.gallery_offset, p.gallery_height)):
            Cylinder(p.gallery / 2, p.length, rotation=(0, 90, 0), mode=Mode.SUBTRACT)
        with Locations((0, -p.gallery_offset, p.height)), GridLocations(p.bore_pitch, 0, p.bores, 1):
            Cylinder(p.feed / 2, p.height - p.gallery_height, align=DOWN, mode=Mode.SUBTRACT)
        with GridLocations(p.ear_spacing, ear_y, 2, p.ears // 2):
            Cylinder(p.ear_hole / 2, p.ear_thickness, align=UP, mode=Mode.SUBTRACT)
        with (
            Locations(front.offset(p.standoff_height)),
            GridLocations(p.standoff_span, p.standoff_rise, 2, p.standoffs // 2),
        ):
            drill(p.standoff_hole, p.standoff_depth)
        with Locations(right.offset(p.hub_height)):
            Cylinder(p.hub_bore / 2, p.hub_depth, align=DOWN, mode=Mode.SUBTRACT)
    return part.part


def main() -> None:
    """Writes the model and its questions."""
    p = Housing()
    depth_mm = p.width + 2 * (p.ear_reach + p.ear / 2)  # the ears reach further than fins and standoffs
    hub_middle = (p.length / 2 + p.hub_height - p.hub_depth / 2, 0, p.hub_center)
    publish(
        "housing",
        build(p),
        [
            count(f"How many holes with a diameter of {p.bore} mm are there?", p.bores),
            count("How many holes are visible from the top?", p.bores + p.head_bolts + p.bores + p.ears),
            count("How many fins are there?", p.fins),
            count("How many standoffs are there?", p.standoffs),
            count("How many holes are visible from the front?", p.standoffs),
            lengths("What is the diameter of the holes visible from the front?", [p.standoff_hole] * p.standoffs),
            lengths(
                "What is the diameter of the holes visible from the bottom?", [p.bore] * p.bores + [p.ear_hole] * p.ears
            ),
            length("What is the diameter of the largest hole visible from the right?", p.hub_bore),
            length("How deep is the largest hole visible from the right?", p.hub_depth),
            point("Where is the center of the largest hole visible from the right?", hub_middle),
            size("What is the size of the object?", (p.length + p.hub_height, depth_mm, p.height)),
        ],
    )


if __name__ == "__main__":
    main()
