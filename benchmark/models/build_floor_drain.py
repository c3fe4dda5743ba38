"""A floor drain, stored as loose surfaces: square frame with a grid, drain tube with ring and cone, four legs."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Part

from benchmark.kit import Form, Item, Model, count, length, lengths, points, size
from benchmark.shapes import DOWN, block, cone, grid, rod

MODEL = Model("Floor drain", "held_out", Form.SURFACES)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the frame's underside lies in z = 0, the tube's axis is z, everything else hangs below."""

    frame: tuple[float, float, float] = (150, 150, 6)
    openings: int = 5  # along x, and along y
    opening: float = 7
    pitch: float = 10
    screw_hole: float = 5.2
    bevel: float = 2.4  # at 45 degrees
    screw_span: float = 130
    tube: float = 76
    wall: float = 3
    tube_length: float = 60
    ring: float = 98
    ring_height: float = 5
    ring_z: float = -35  # its upper face
    outlet: float = 58
    cone_height: float = 16
    legs: int = 4
    leg: tuple[float, float, float] = (14, 10, 84)
    leg_span: float = 112

    @property
    def height(self) -> float:
        """Over all."""
        return self.frame[2] + max(self.leg[2], self.tube_length + self.cone_height)


def build(p: P) -> Part:
    """Frame, tube, ring, cone and legs; bores the tube up to the grid, punches the grid, drills the corners."""
    thick = p.frame[2]
    body = block(p.frame) + rod(p.tube, p.tube_length, (0, 0, 0), DOWN)
    body += cone(p.tube, p.outlet, p.cone_height, (0, 0, -p.tube_length), DOWN)
    body += rod(p.ring, p.ring_height, (0, 0, p.ring_z), DOWN)
    body += [block(p.leg, (x, y, -p.leg[2])) for x, y in grid(2, 2, p.leg_span, p.leg_span)]
    inner = p.tube - 2 * p.wall
    body -= rod(inner, p.tube_length, (0, 0, 0), DOWN)
    body -= cone(inner, p.outlet - 2 * p.wall, p.cone_height, (0, 0, -p.tube_length), DOWN)
    body -= [block((p.opening, p.opening, thick), (x, y, 0)) for x, y in grid(p.openings, p.openings, p.pitch, p.pitch)]
    for x, y in grid(2, 2, p.screw_span, p.screw_span):
        body -= rod(p.screw_hole, thick, (x, y, 0))
        body -= cone(p.screw_hole + 2 * p.bevel, p.screw_hole, p.bevel, (x, y, thick), DOWN)
    return body


def questions(p: P) -> list[Item]:
    """Asked in the plain way, and by a plumber, a tiler and an architect."""
    corners = grid(2, 2, p.screw_span, p.screw_span)
    return [
        count("grid", "Number of square openings in the grid?", p.openings**2),
        length("grid", "width", "Width of a single opening of the grid?", p.opening),
        length("tube", "diameter", "Determine the outer diameter of the cylindrical tube below the frame.", p.tube),
        length("ring", "diameter", "State the outer diameter of the ring around the tube.", p.ring),
        count("hole with bevel", "Give me the number of holes with a bevel on the top face.", 4),
        lengths(
            "hole with bevel", "diameter", "Bore diameter of the bevelled holes seen from above?", [p.screw_hole] * 4
        ),
        length("cone", "height", "Height of the cone at the lower end of the tube?", p.cone_height),
        count("leg", "How many legs does the drain stand on?", p.legs),
        points(
            "hole with bevel",
            "Give the positions of the centres of the bevelled holes.",
            [(x, y, p.frame[2] / 2) for x, y in corners],
        ),
        size("object", "State width, depth and height of the complete drain.", (p.frame[0], p.frame[1], p.height)),
        length(
            "leg",
            "distance",
            "Seen from the front there are two legs. What is the clear gap between them?",
            p.leg_span - p.leg[0],
        ),
        length("tube", "thickness", "what's the wall of the drain pipe, how thick?", p.wall),
        length(
            "grid",
            "distance",
            "How thick is the bar between two neighbouring openings of the grating?",
            p.pitch - p.opening,
        ),
        length(
            "ring",
            "thickness",
            "And the sealing ring round the pipe, how thick is it from its top to its bottom?",
            p.ring_height,
        ),
    ]
