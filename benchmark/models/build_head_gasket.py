"""A cylinder head gasket of a three-cylinder engine: bores, bolt holes and coolant passages in a thin plate."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, fillet

from benchmark.kit import Item, Model, count, length, lengths, point, points, size
from benchmark.shapes import block, grid, rod, slot

MODEL = Model("Cylinder head gasket", "dev")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the row of cylinders runs along x, the underside lies on z = 0."""

    width: float = 276
    depth: float = 132
    thickness: float = 1.4
    corner: float = 10
    bores: int = 3
    bore: float = 74
    bore_pitch: float = 84
    bolts: int = 8
    bolt: float = 11
    bolt_rows: float = 112
    passages: int = 6
    passage: tuple[float, float] = (20, 7)  # length over all, width
    passage_rows: float = 104
    oil: float = 5
    oil_at: tuple[float, float] = (-42, 44)

    def bores_at(self) -> list[tuple[float, float]]:
        """Where are the cylinders?"""
        return grid(self.bores, 1, self.bore_pitch, 0)


def build(p: P) -> Part:
    """Punches the plate."""
    plate = block((p.width, p.depth, p.thickness))
    plate = fillet(plate.edges().filter_by(Axis.Z), p.corner)
    tools = [rod(p.bore, p.thickness, (x, y, 0)) for x, y in p.bores_at()]
    tools += [rod(p.bolt, p.thickness, (x, y, 0)) for x, y in grid(p.bolts // 2, 2, p.bore_pitch, p.bolt_rows)]
    passages = grid(p.passages // 2, 2, p.bore_pitch, p.passage_rows)
    tools += [slot(*p.passage, p.thickness, (x, y, p.thickness)) for x, y in passages]
    tools.append(rod(p.oil, p.thickness, (*p.oil_at, 0)))
    return plate - tools


def questions(p: P) -> list[Item]:
    """Asked by mechanics and students of engines."""
    z = p.thickness / 2
    return [
        length("head gasket", "thickness", "How thick is the head gasket?", p.thickness),
        length("head gasket", "width", "What is the width of the head gasket?", p.width),
        size("head gasket", "Size of the cylinder head gasket in x, y, z?", (p.width, p.depth, p.thickness)),
        count("hole", "how many round holes has the gasket with a diameter bigger than 50 mm?", p.bores),
        lengths("hole", "radius", "Give the radii of the three big cylinder openings.", [p.bore / 2] * p.bores),
        length(
            "hole", "distance", "What is the distance between the centres of two adjacent large bores?", p.bore_pitch
        ),
        points("hole", "Where are the centres of the three largest holes?", [(x, y, z) for x, y in p.bores_at()]),
        count("hole", f"How many {p.bolt:g} mm bolt holes are in the gasket?", p.bolts),
        count("slot", "How many coolant slots (elongated holes) are punched into the gasket?", p.passages),
        lengths("slot", "width", "How wide are the elongated holes?", [p.passage[1]] * p.passages),
        lengths(
            "slot",
            "length",
            "What is the overall length of each slot, rounded ends included?",
            [p.passage[0]] * p.passages,
        ),
        lengths(
            "hole", "diameter", "List all the different diameters of the round holes.", sorted({p.bore, p.bolt, p.oil})
        ),
        length("hole", "diameter", "What is the diameter of the smallest round hole?", p.oil),
        point("hole", "What is the position of the smallest round hole?", (*p.oil_at, z)),
    ]
