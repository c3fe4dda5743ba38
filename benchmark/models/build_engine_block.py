"""The block of a small two-cylinder engine with head gasket and studs, as named bodies."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Compound, Part

from benchmark.kit import Item, Model, count, exists, length, lengths, points, size
from benchmark.shapes import BACK, DOWN, RIGHT, assembly, block, drill, grid, named, rod

MODEL = Model("Two-cylinder engine block", "dev", bodies=8)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the block stands on z = 0, the crankshaft's axis is x, the middle is x = y = 0."""

    block: tuple[float, float, float] = (190, 100, 110)
    cylinders: int = 2
    bore: float = 60
    pitch: float = 84
    crank: float = 25  # radius of the half-round channel below
    gasket: float = 2
    gasket_bore: float = 62
    gasket_stud: float = 11
    water: float = 8  # holes in gasket and block, in the middle plane
    water_depth: float = 40  # in the block
    water_x: float = 80
    stud: float = 10
    stud_depth: float = 40
    stud_length: float = 82
    stud_span: tuple[float, float] = (84, 82)  # three by two
    plugs: int = 3
    plug: float = 25
    plug_depth: float = 8
    plug_pitch: float = 52
    plug_z: float = 50
    flange: float = 5  # core hole of M6, in the left
    flange_depth: float = 15
    flange_span: tuple[float, float] = (60, 60)
    flange_z: float = 52
    pad: tuple[float, float, float] = (5, 50, 36)  # milled into the right
    pad_z: float = 50
    lug: tuple[float, float, float] = (50, 30, 22)  # at front and back
    lug_hole: float = 13
    lug_y: float = 66

    @property
    def channel(self) -> float:
        """Diameter of the half-round channel."""
        return 2 * self.crank


def casting(p: P) -> Part:
    """The block with its lugs, bored, drilled, milled."""
    width, depth, height = p.block
    body = block(p.block)
    for side in (-1, 1):
        body += block(p.lug, (0, side * (depth + p.lug[1]) / 2, 0))
        body -= rod(p.lug_hole, p.lug[2], (0, side * p.lug_y, 0))
    body -= [rod(p.bore, height, (x, 0, 0)) for x in (-p.pitch / 2, p.pitch / 2)]
    body -= rod(p.channel, width, (-width / 2, 0, 0), RIGHT)
    body -= [rod(p.stud, p.stud_depth, (x, y, height), DOWN) for x, y in grid(3, 2, *p.stud_span)]
    body -= [rod(p.water, p.water_depth, (x, 0, height), DOWN) for x in (-p.water_x, p.water_x)]
    for index in range(p.plugs):
        x = (index - (p.plugs - 1) / 2) * p.plug_pitch
        body -= rod(p.plug, p.plug_depth, (x, -depth / 2, p.plug_z), BACK)
    body -= [
        drill(p.flange, p.flange_depth, (-width / 2, y, z), RIGHT)
        for y, z in grid(2, 2, *p.flange_span, (0, p.flange_z))
    ]
    return body - block(p.pad, ((width - p.pad[0]) / 2, 0, p.pad_z))


def gasket(p: P) -> Part:
    """A sheet as large as the block, punched for cylinders, studs and water."""
    top = p.block[2]
    sheet = block((*p.block[:2], p.gasket), (0, 0, top))
    holes = [(p.gasket_bore, x, 0.0) for x in (-p.pitch / 2, p.pitch / 2)]
    holes += [(p.gasket_stud, x, y) for x, y in grid(3, 2, *p.stud_span)]
    holes += [(p.water, x, 0.0) for x in (-p.water_x, p.water_x)]
    return sheet - [rod(diameter, p.gasket, (x, y, top)) for diameter, x, y in holes]


def build(p: P) -> Compound:
    """Lays the gasket on, screws the studs in."""
    bodies = [named(casting(p), "Engine block", "LightSlateGray"), named(gasket(p), "Head gasket", "Peru")]
    low = p.block[2] - p.stud_depth
    for number, (x, y) in enumerate(grid(3, 2, *p.stud_span), start=1):
        bodies.append(named(rod(p.stud, p.stud_length, (x, y, low)), f"Stud M10 {number}", "DimGray"))
    return assembly(bodies)


def questions(p: P) -> list[Item]:
    """Asked in the plain way, and by an engine restorer, an American machinist and a Polish student."""
    return [
        length("head gasket", "thickness", "What is the thickness of the head gasket?", p.gasket),
        count("head gasket", "How many holes does the head gasket have?", p.cylinders + 6 + 2),
        lengths(
            "cylinder", "diameter", "What is the diameter of the cylinder bores of the engine block?", [p.bore] * 2
        ),
        count("rod", "How many studs are visible from the top?", 6),
        length("semicircle", "radius", "What is the radius of the semicircle visible from the left?", p.crank),
        size(
            "rectangular indentation",
            "What is the size of the rectangular indentation on the right?",
            p.pad,
        ),
        count("blind hole", "How many blind holes are visible from the front?", p.plugs),
        points(
            "blind hole",
            "What are the centers of the blind holes visible from the front?",
            [
                ((index - (p.plugs - 1) / 2) * p.plug_pitch, (p.plug_depth - p.block[1]) / 2, p.plug_z)
                for index in range(p.plugs)
            ],
        ),
        exists("cooling fin", "Are there any cooling fins on this engine?", False),
        length("cylinder", "distance", "Bore spacing of the two cylinders", p.pitch),
        lengths(
            "rod",
            "height",
            "How much of the studs is above the gasket?",
            [p.stud_length - p.stud_depth - p.gasket] * 6,
        ),
        length("object", "height", "Height of the engine block alone please, without gasket and studs", p.block[2]),
        lengths("threaded hole", "depth", "How deep are threaded holes on the left side?", [p.flange_depth] * 4),
        length(
            "mounting hole",
            "distance",
            "My engine mounts bolt to the 13 mm holes in the two lugs, how far apart are these holes?",
            2 * p.lug_y,
        ),
    ]
