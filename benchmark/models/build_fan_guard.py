"""A fan guard stored as loose surfaces: a square plate with a grid of windows, fixing holes, and fins at the back."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, fillet

from benchmark.kit import Form, Item, Model, count, length, lengths, point, size
from benchmark.shapes import DOWN, block, grid, rod

MODEL = Model("Fan guard with cooling fins", "dev", Form.SURFACES)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the plate lies on z = 0 .. thickness, the fins hang below."""

    side: float = 100
    thickness: float = 5
    corner: float = 8
    windows: tuple[int, int] = (4, 3)
    window: float = 10
    window_pitch: float = 15
    window_y: float = 18  # middle of the grid
    holes: int = 4
    hole: float = 4.4
    hole_pitch: float = 84
    fins: int = 6
    fin: tuple[float, float, float] = (2.5, 30, 18)
    fin_pitch: float = 8
    fin_y: float = -24
    logo: tuple[float, float, float] = (24, 8, 1)
    logo_y: float = -24


def build(p: P) -> Part:
    """Cuts the windows, hangs the fins, raises the logo plate."""
    body = block((p.side, p.side, p.thickness))
    body = fillet(body.edges().filter_by(Axis.Z), p.corner)
    for x, y in grid(*p.windows, p.window_pitch, p.window_pitch, (0, p.window_y)):
        body -= block((p.window, p.window, p.thickness), (x, y, 0))
    body -= [rod(p.hole, p.thickness, (x, y, p.thickness), DOWN) for x, y in grid(2, 2, p.hole_pitch, p.hole_pitch)]
    body += [block(p.fin, (x, p.fin_y, -p.fin[2])) for x, _ in grid(p.fins, 1, p.fin_pitch, 0)]
    return body + block(p.logo, (0, p.logo_y, p.thickness))


def questions(p: P) -> list[Item]:
    """Asked by an electronics engineer and her intern."""
    number = p.windows[0] * p.windows[1]
    return [
        count("grid", "Of how many square openings does the grid consist?", number),
        length("grid", "width", "How wide is one opening of the grid?", p.window),
        count("cutout", "How many rectangular cutouts has the plate?", number),
        count("cooling fin", "How many cooling fins are on the underside?", p.fins),
        lengths("cooling fin", "thickness", "How thick are the fins?", [p.fin[0]] * p.fins),
        lengths("cooling fin", "height", "What is the height of each of the cooling fins?", [p.fin[2]] * p.fins),
        length(
            "cooling fin", "distance", "What is the clearance between two neighbouring fins?", p.fin_pitch - p.fin[0]
        ),
        count("mounting hole", "Number of round holes?", p.holes),
        lengths("mounting hole", "radius", "What is the radius of each mounting hole?", [p.hole / 2] * p.holes),
        length(
            "mounting hole", "distance", "Distance between the mounting holes along x, centre to centre?", p.hole_pitch
        ),
        length("object", "radius", "Plate corners: which radius?", p.corner),
        length("object", "thickness", "How thick is the plate itself, without fins?", p.thickness),
        length(
            "rectangular protrusion",
            "height",
            "What is the height of the rectangular protrusion on the top?",
            p.logo[2],
        ),
        size("rectangular protrusion", "What are the dimensions of the raised rectangle on top?", p.logo),
        point(
            "rectangular protrusion",
            "Where is the centre of the rectangular protrusion on the top side?",
            (0, p.logo_y, p.thickness + p.logo[2] / 2),
        ),
        size(
            "object",
            "What size does the bounding box of the guard have?",
            (p.side, p.side, p.thickness + p.fin[2] + p.logo[2]),
        ),
    ]
