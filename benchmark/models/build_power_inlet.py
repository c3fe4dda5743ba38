"""A rear panel with a power connector: panel, connector shell, three pins, two screws, as named bodies."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Compound, Part, Pos, chamfer, fillet

from benchmark.kit import Item, Model, count, length, lengths, point, points, size
from benchmark.shapes import BACK, FRONT, assembly, block, grid, named, rod

MODEL = Model("Rear panel with power connector", "dev", bodies=7)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the panel stands upright, its front face on y = 0, its underside on z = 0."""

    panel: tuple[float, float, float] = (140, 2, 80)
    panel_holes: int = 4
    panel_hole: float = 4.2
    panel_hole_span: tuple[float, float] = (126, 66)
    center: tuple[float, float] = (-30, 40)  # the connector's middle, x and z
    flange: tuple[float, float, float] = (48, 4, 28)
    shell: tuple[float, float, float] = (30, 18, 22)  # behind the panel
    inside: tuple[float, float, float] = (24, 16, 16)
    pins: int = 3
    pin: tuple[float, float, float] = (2, 14, 4)
    pin_pitch: float = 7
    screw: float = 3
    screw_length: float = 10
    screw_head: float = 5.5
    screw_head_height: float = 2
    screw_spacing: float = 40
    vents: tuple[int, int] = (5, 6)
    vent: float = 4
    vent_pitch: float = 7
    vent_center: tuple[float, float] = (36, 40)

    def vents_at(self) -> list[tuple[float, float]]:
        """Where are the holes of the grid, x and z?"""
        return grid(*self.vents, self.vent_pitch, self.vent_pitch, self.vent_center)


def panel(p: P) -> Part:
    """Cut out for the connector's shell, drilled for its screws, for the case, and for air."""
    _, depth, height = p.panel
    body = block(p.panel, (0, depth / 2, 0))
    x, z = p.center
    tools = [block((p.shell[0], depth, p.shell[2]), (x, depth / 2, z - p.shell[2] / 2))]
    tools += [rod(p.screw, depth, (x + side * p.screw_spacing / 2, 0, z), BACK) for side in (-1, 1)]
    corners = grid(2, 2, *p.panel_hole_span, (0, height / 2))
    tools += [rod(p.panel_hole, depth, (a, 0, b), BACK) for a, b in corners]
    tools += [rod(p.vent, depth, (a, 0, b), BACK) for a, b in p.vents_at()]
    return body - tools


def connector(p: P) -> Part:
    """A flange before the panel, a shell through it, open to the front."""
    x, z = p.center
    flange = block(p.flange, (x, -p.flange[1] / 2, z - p.flange[2] / 2))
    flange = fillet(flange.edges().filter_by(Axis.Y), 3)
    body = flange + block(p.shell, (x, p.shell[1] / 2, z - p.shell[2] / 2))
    inside = block(p.inside, (x, -p.flange[1] + p.inside[1] / 2, z - p.inside[2] / 2))
    screws = [rod(p.screw, p.flange[1], (x + s * p.screw_spacing / 2, -p.flange[1], z), BACK) for s in (-1, 1)]
    return body - [inside, *screws]


def build(p: P) -> Compound:
    """Puts pins into the connector's back wall and screws through its flange."""
    x, z = p.center
    floor = -p.flange[1] + p.inside[1]
    bodies = [named(panel(p), "Rear panel", "LightGray"), named(connector(p), "Power connector", "DimGray")]
    for index in range(p.pins):
        at = (x + (index - 1) * p.pin_pitch, floor - p.pin[1] / 2, z - p.pin[2] / 2)
        bodies.append(named(block(p.pin, at), "Rectangular pin", "Gold"))
    screw = rod(p.screw, p.screw_length, along=BACK) + rod(p.screw_head, p.screw_head_height, along=FRONT)
    screw = chamfer(screw.edges().group_by(Axis.Y)[0], 0.4)
    for side in (-1, 1):
        place = Pos(x + side * p.screw_spacing / 2, -p.flange[1], z)
        bodies.append(named(place * screw, f"Screw M{p.screw:g}x{p.screw_length:g}", "Silver"))
    return assembly(bodies)


def questions(p: P) -> list[Item]:
    """Asked by people who wire the panel."""
    x, z = p.center
    floor = -p.flange[1] + p.inside[1]
    pin_y = floor - p.pin[1] / 2
    connector_depth = p.flange[1] + p.shell[1]
    return [
        size(
            "power connector", "What is the size of the power connector?", (p.flange[0], connector_depth, p.flange[2])
        ),
        length("power connector", "width", "How wide is the power connector, flange included?", p.flange[0]),
        point(
            "power connector",
            "Where is the centre of the power connector's bounding box?",
            (x, (p.shell[1] - p.flange[1]) / 2, z),
        ),
        count("rectangular pin", "How many rectangular pins are inside the power connector?", p.pins),
        lengths("rectangular pin", "width", "What is the width in x of each rectangular pin?", [p.pin[0]] * p.pins),
        points(
            "rectangular pin",
            "Where are the centers of the rectangular pins?",
            [(x + (i - 1) * p.pin_pitch, pin_y, z) for i in range(p.pins)],
        ),
        length("rectangular pin", "distance", "How far apart are the middles of two neighbouring pins?", p.pin_pitch),
        count("screw", "How many screws hold the connector?", 2),
        lengths("screw head", "diameter", "What is the diameter of the screw heads?", [p.screw_head] * 2),
        lengths(
            "screw",
            "length",
            "How long are the screws from the underside of the head to the tip?",
            [p.screw_length] * 2,
        ),
        count("grid", "Of how many holes does the ventilation grid of the panel consist?", len(p.vents_at())),
        length(
            "grid",
            "distance",
            "What is the spacing between neighbouring holes of the vent grid, centre to centre?",
            p.vent_pitch,
        ),
        lengths(
            "mounting hole",
            "diameter",
            "Diameter of the four mounting holes in the corners of the rear panel?",
            [p.panel_hole] * p.panel_holes,
        ),
        length("object", "thickness", "How thick is the sheet of the rear panel?", p.panel[1]),
        size("object", "Give the extents of the rear panel alone.", p.panel, "extents"),
        count("object", "How many separate bodies are in the model?", 7),
    ]
