"""A ventilation cover: bevelled plate with a grid of rectangular slots, a raised logo and corner holes."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Compound, Part, fillet

from benchmark.kit import Item, Model, count, length, lengths, point, points, size
from benchmark.shapes import assembly, block, grid, named, rod

MODEL = Model("Ventilation cover with logo", "dev", bodies=2)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the cover lies on z = 0, the logo, a letter E, stands on its top."""

    size: tuple[float, float, float] = (160, 110, 4)
    corner: float = 8
    holes: int = 4
    hole: float = 5.5
    hole_span: tuple[float, float] = (144, 94)
    columns: int = 3
    rows: int = 7
    slit: tuple[float, float] = (30, 5)
    pitch: tuple[float, float] = (36, 9)
    grid_center: tuple[float, float] = (-16, 0)
    logo: tuple[float, float, float] = (18, 24, 1.2)
    logo_stroke: float = 5
    logo_center: tuple[float, float] = (58, 0)

    def slits(self) -> list[tuple[float, float]]:
        """Where are the slots of the grid?"""
        return grid(self.columns, self.rows, *self.pitch, self.grid_center)


def logo(p: P) -> Part:
    """An E: an upright and three bars."""
    width, depth, height = p.logo
    x, y = p.logo_center
    left, top = x - width / 2, p.size[2]
    body = block((p.logo_stroke, depth, height), (left + p.logo_stroke / 2, y, top))
    bars = (-(depth - p.logo_stroke) / 2, 0, (depth - p.logo_stroke) / 2)
    return body + [block((width, p.logo_stroke, height), (x, y + bar, top)) for bar in bars]


def build(p: P) -> Compound:
    """Rounds and cuts the plate, puts the logo on it."""
    plate = fillet(block(p.size).edges().filter_by(Axis.Z), p.corner)
    tools = [rod(p.hole, p.size[2], (x, y, 0)) for x, y in grid(2, p.holes // 2, *p.hole_span)]
    tools += [block((*p.slit, p.size[2]), (x, y, 0)) for x, y in p.slits()]
    return assembly([named(plate - tools, "Cover", "WhiteSmoke"), named(logo(p), "Logo", "Crimson")])


def questions(p: P) -> list[Item]:
    """Asked by designers of enclosures and by people who do not speak English all day."""
    number = p.columns * p.rows
    half = p.logo[2] / 2
    return [
        count("rectangular slot", "How many rectangular slots has the cover?", number),
        count("grid", "The grid of slots: how many openings has it in total?", number),
        lengths(
            "rectangular slot",
            "width",
            "What is the width (short side) of each rectangular slot?",
            [p.slit[1]] * number,
        ),
        lengths(
            "rectangular slot", "length", "What is the length of each of the rectangular slots?", [p.slit[0]] * number
        ),
        length(
            "grid",
            "distance",
            "In the grid, which centre distance have two slots one above the other in y direction?",
            p.pitch[1],
        ),
        count("logo", "Is there a logo on the cover? How many of them?", 1),
        size("logo", "What are the dimensions of the logo in x, y and z?", p.logo),
        length("logo", "height", "How high is the logo raised above the surface of the cover?", p.logo[2]),
        point("logo", "At what position is the center of the logo?", (*p.logo_center, p.size[2] + half)),
        count("mounting hole", "How much round holes for mounting are there?", p.holes),
        lengths("mounting hole", "diameter", "Diameters of the round corner holes?", [p.hole] * p.holes),
        points(
            "mounting hole",
            "Where must the four screws go? Give the centres of the round holes.",
            [(x, y, p.size[2] / 2) for x, y in grid(2, 2, *p.hole_span)],
        ),
        length("object", "thickness", "Which thickness has the cover plate without the logo?", p.size[2]),
        size(
            "object",
            "Overall extents of the model, the logo included?",
            (p.size[0], p.size[1], p.size[2] + p.logo[2]),
            "extents",
        ),
    ]
