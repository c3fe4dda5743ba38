"""A duct transition: flange plate, rectangular duct, round nozzle; stored as loose surfaces, without a solid."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Part

from benchmark.kit import Form, Item, Model, count, length, lengths, points, size
from benchmark.shapes import block, grid, rod

MODEL = Model("Air duct with flange", "dev", Form.SURFACES)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the flange lies on z = 0, the duct rises from it, the round nozzle stands on the duct's lid."""

    flange: tuple[float, float, float] = (180, 140, 6)
    holes: int = 6
    hole: float = 7
    hole_pitch: tuple[float, float] = (78, 120)
    duct: tuple[float, float, float] = (130, 90, 50)
    wall: float = 3
    nozzle: float = 60
    nozzle_height: float = 35

    @property
    def height(self) -> float:
        """Over all."""
        return self.flange[2] + self.duct[2] + self.nozzle_height

    @property
    def inside(self) -> tuple[float, float, float]:
        """Of the duct: from the flange's underside to its lid."""
        return (self.duct[0] - 2 * self.wall, self.duct[1] - 2 * self.wall, self.flange[2] + self.duct[2] - self.wall)


def build(p: P) -> Part:
    """Flange, duct and nozzle, hollowed by the wall's thickness."""
    lid = p.flange[2] + p.duct[2]
    body = block(p.flange) + block(p.duct, (0, 0, p.flange[2])) + rod(p.nozzle, p.nozzle_height, (0, 0, lid))
    tools = [block(p.inside), rod(p.nozzle - 2 * p.wall, p.nozzle_height + p.wall, (0, 0, lid - p.wall))]
    tools += [rod(p.hole, p.flange[2], (x, y, 0)) for x, y in grid(p.holes // 2, 2, *p.hole_pitch)]
    return body - tools


def questions(p: P) -> list[Item]:
    """Asked by ventilation engineers."""
    return [
        size(
            "rectangular inside",
            "How large is the rectangular inside of the duct, from the underside up to the lid?",
            p.inside,
        ),
        length(
            "rectangular inside",
            "width",
            "What is the clear width of the rectangular opening in the bottom?",
            p.inside[0],
        ),
        length(
            "rectangular inside",
            "depth",
            "How deep is the rectangular cavity when you look into it from below?",
            p.inside[2],
        ),
        length("tube", "diameter", "What is the outer diameter of the round nozzle on top?", p.nozzle),
        length("tube", "diameter", "Inner diameter of the tube on the top?", p.nozzle - 2 * p.wall),
        length("tube", "height", "How far does the tube rise above the lid of the duct?", p.nozzle_height),
        length("tube", "thickness", "Thickness of the tube's wall?", p.wall),
        count("mounting hole", "How many screw holes of 7 mm are in the flange?", p.holes),
        lengths("mounting hole", "radius", "Radius of the screw holes in the flange?", [p.hole / 2] * p.holes),
        lengths("through hole", "depth", "How deep are the 7 mm through holes?", [p.flange[2]] * p.holes),
        points(
            "mounting hole",
            "Locate the 7 mm holes: give their centres.",
            [(x, y, p.flange[2] / 2) for x, y in grid(p.holes // 2, 2, *p.hole_pitch)],
        ),
        length("object", "height", "How high is the duct altogether?", p.height),
        length("object", "thickness", "How thick is the flange plate?", p.flange[2]),
        size("object", "What are the overall extents?", (p.flange[0], p.flange[1], p.height), "extents"),
    ]
