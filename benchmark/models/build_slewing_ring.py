"""A slewing ring: a toothed outer ring, an inner ring with tapped holes, the drive's pinion on its shaft."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Compound, Face, Part, Plane, Pos, Wire, extrude

from benchmark.kit import Item, Model, count, length, lengths, points, size
from benchmark.shapes import DOWN, assembly, circle, named, rod
from build_gear_shaft import GearShaft, tooth_edges

MODEL = Model("Slewing ring with pinion", "dev", bodies=3)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres and degrees; the outer ring lies on z = 0, its axis is z, the pinion stands at the right."""

    module: float = 3
    teeth: int = 40
    pinion_teeth: int = 15
    pressure_angle: float = 20
    outer_height: float = 18
    outer_bore: float = 86
    outer_holes: int = 8
    outer_hole: float = 6.6
    outer_circle: float = 99
    inner_diameter: float = 85
    inner_bore: float = 50
    inner_base: float = 4  # above z = 0
    inner_height: float = 20
    inner_holes: int = 6
    inner_hole: float = 6.8  # core of M8
    inner_depth: float = 14
    inner_circle: float = 68
    pinion_base: float = -2
    pinion_face: float = 22
    shaft: float = 20
    shaft_out: float = 32

    def pitch(self, teeth: int) -> float:
        """Pitch diameter (ISO 53)."""
        return self.module * teeth

    def tip(self, teeth: int) -> float:
        """Tip diameter: one module above the pitch circle all round (ISO 53)."""
        return self.module * (teeth + 2)

    @property
    def spacing(self) -> float:
        """Between the axes of ring and pinion."""
        return (self.pitch(self.teeth) + self.pitch(self.pinion_teeth)) / 2


def gear(p: P, teeth: int, height: float) -> Part:
    """A toothed disc on z = 0; a tooth points to x."""
    outline = GearShaft(module=p.module, teeth=teeth, pressure_angle=p.pressure_angle)
    wire = Wire([edge for index in range(teeth) for edge in tooth_edges(outline, index)])
    return extrude(Plane.XY * Face(wire), amount=height)


def build(p: P) -> Compound:
    """The inner ring stands higher than the outer one; with an odd number of teeth the pinion needs no turn."""
    outer = gear(p, p.teeth, p.outer_height) - rod(p.outer_bore, p.outer_height)
    outer -= [rod(p.outer_hole, p.outer_height, (x, y, 0)) for x, y in circle(p.outer_holes, p.outer_circle)]
    top = p.inner_base + p.inner_height
    inner = rod(p.inner_diameter, p.inner_height, (0, 0, p.inner_base)) - rod(p.inner_bore, top)
    inner -= [rod(p.inner_hole, p.inner_depth, (x, y, top), DOWN) for x, y in circle(p.inner_holes, p.inner_circle)]
    pinion = Pos(p.spacing, 0, p.pinion_base) * gear(p, p.pinion_teeth, p.pinion_face)
    pinion += rod(p.shaft, p.shaft_out, (p.spacing, 0, p.pinion_base + p.pinion_face))
    return assembly(
        [
            named(outer, "Outer ring", "SteelBlue"),
            named(inner, "Inner ring", "Silver"),
            named(pinion, "Pinion shaft", "Goldenrod"),
        ]
    )


def questions(p: P) -> list[Item]:
    """Asked in the plain way, and by a crane builder, a machinist and a student."""
    ring, pinion = p.tip(p.teeth), p.tip(p.pinion_teeth)
    top = p.inner_base + p.inner_height
    return [
        count("gear", "Number of teeth on the largest gear?", p.teeth),
        length("ring", "diameter", "Determine the inner diameter of the inner ring.", p.inner_bore),
        length("ring", "height", "Height of the inner ring?", p.inner_height),
        length("gear", "diameter", "Give me the outer diameter of the pinion, measured over its teeth.", pinion),
        count(
            "hole",
            "Give me the number of holes smaller than 10 mm in diameter that are visible from below.",
            p.outer_holes,
        ),
        lengths(
            "blind hole",
            "depth",
            "State the depths of the blind holes seen from above.",
            [p.inner_depth] * p.inner_holes,
        ),
        lengths(
            "through hole",
            "radius",
            "Radii of the through holes in the outer ring?",
            [p.outer_hole / 2] * p.outer_holes,
        ),
        points(
            "blind hole",
            "Give me the center points of the blind holes in the inner ring.",
            [(x, y, top - p.inner_depth / 2) for x, y in circle(p.inner_holes, p.inner_circle)],
        ),
        size(
            "object",
            "What is the overall size of the assembly along x, y and z?",
            (ring / 2 + p.spacing + pinion / 2, ring, p.pinion_face + p.shaft_out),
        ),
        count("gear", "teeth of the small gear, the one on the pinion shaft?", p.pinion_teeth),
        length("gear", "distance", "How far is the pinion's axis away from the axis of the ring gear?", p.spacing),
        length(
            "shaft",
            "diameter",
            "Which diameter must a coupling have that fits onto the pinion shaft above the teeth?",
            p.shaft,
        ),
        length("shaft", "height", "How far does the shaft come up out of the pinion's toothed part?", p.shaft_out),
        length(
            "through hole",
            "distance",
            "On what pitch circle diameter do the 6.6 mm screw holes of the toothed ring lie?",
            p.outer_circle,
        ),
    ]
