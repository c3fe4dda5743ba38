"""An extruded heat sink: base with cooling fins and tapped mounting holes from below."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Part

from benchmark.kit import Item, Model, count, length, lengths, point, points, size
from benchmark.shapes import UP, block, grid, rod

MODEL = Model("Heat sink with twelve fins", "dev")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the fins stand on the base along y, the base's underside lies on z = 0."""

    width: float = 92
    depth: float = 60
    base: float = 8
    fins: int = 12
    fin: float = 2
    fin_height: float = 27
    holes: int = 4
    hole: float = 3.3  # tap drill of M4
    hole_depth: float = 5
    hole_span: tuple[float, float] = (70, 40)

    @property
    def pitch(self) -> float:
        """From fin to fin; the outer ones are flush with the base."""
        return (self.width - self.fin) / (self.fins - 1)

    def mounting(self) -> list[tuple[float, float]]:
        """Where are the holes?"""
        return grid(2, 2, *self.hole_span)


def build(p: P) -> Part:
    """Fins on a base, drilled from below."""
    body = block((p.width, p.depth, p.base))
    body += [block((p.fin, p.depth, p.fin_height), (x, 0, p.base)) for x, _ in grid(p.fins, 1, p.pitch, 0)]
    return body - [rod(p.hole, p.hole_depth, (x, y, 0), UP) for x, y in p.mounting()]


def questions(p: P) -> list[Item]:
    """Asked by thermal engineers and by people who machine the base."""
    pitch = p.pitch
    return [
        count("cooling fin", "How many cooling fins does this heat sink have?", p.fins),
        lengths("cooling fin", "thickness", "What is the thickness of each cooling fin?", [p.fin] * p.fins),
        lengths(
            "cooling fin",
            "height",
            "How high do the fins rise above the base? One value per fin.",
            [p.fin_height] * p.fins,
        ),
        lengths("cooling fin", "length", "State the length of the fins along the y direction.", [p.depth] * p.fins),
        length("cooling fin", "distance", "How wide is the air gap between two neighbouring fins?", pitch - p.fin),
        length("cooling fin", "distance", "What is the centre-to-centre pitch of the cooling fins?", pitch),
        length("object", "height", "Total height of the heat sink, base and fins together?", p.base + p.fin_height),
        length("object", "width", "What's the overall width of the part?", p.width),
        length("object", "depth", "what is the depth of the whole object, front to back?", p.depth),
        count("blind hole", "How many blind holes are drilled into the underside?", p.holes),
        lengths("blind hole", "depth", "How deep are the holes on the bottom?", [p.hole_depth] * p.holes),
        lengths(
            "mounting hole",
            "diameter",
            "Please tell me the diameters of the mounting holes at the bottom.",
            [p.hole] * p.holes,
        ),
        points(
            "mounting hole",
            "At which positions are the holes of the bottom side? Give the centres.",
            [(x, y, p.hole_depth / 2) for x, y in p.mounting()],
        ),
        count("hole", "How many holes can be seen from the top?", 0),
        point("object", "Where is the middle of the heat sink?", (0, 0, (p.base + p.fin_height) / 2)),
        size("object", "What are the extents of the object?", (p.width, p.depth, p.base + p.fin_height), "extents"),
    ]
