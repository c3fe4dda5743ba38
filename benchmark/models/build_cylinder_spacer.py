"""A cylinder spacer with its gasket: a bevelled bore, stud holes, kidney-shaped water passages, holes in the sides."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, CenterArc, Compound, Part, Pos, SlotArc, extrude, fillet

from benchmark.kit import Item, Model, angle, count, length, lengths, points, size, text
from benchmark.shapes import BACK, RIGHT, UP, assembly, block, cone, drill, grid, named, rod

MODEL = Model("Cylinder spacer with head gasket", "dev", bodies=2)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the spacer lies on z = 0, the cylinder's axis is z; the gasket lies on the spacer."""

    outline: tuple[float, float] = (150, 130)
    corner: float = 18
    spacer: float = 20  # thickness
    gasket: float = 1.5
    bore: float = 84
    bevel: float = 2  # of the bore's lower edge, 45 degrees
    fire_ring: float = 87  # bore of the gasket
    stud: float = 11
    studs: tuple[float, float] = (122, 102)
    passages: int = 4
    passage: float = 8  # width
    passage_circle: float = 104
    passage_angle: float = 40  # between the centres of the ends
    locating: float = 8  # blind, from the underside
    locating_depth: float = 6
    locating_x: float = 122
    sensor: float = 5  # from the front into the bore
    plug: float = 10.2  # core hole of M12, blind, from the left
    plug_depth: float = 14
    plug_y: float = 25


def sheet(p: P, thickness: float, bore: float) -> Part:
    """What spacer and gasket have in common."""
    body = block((*p.outline, thickness))
    body = fillet(body.edges().filter_by(Axis.Z), p.corner)
    body -= rod(bore, thickness)
    body -= [rod(p.stud, thickness, (x, y, 0)) for x, y in grid(2, 2, *p.studs)]
    arc = CenterArc((0, 0), p.passage_circle / 2, -p.passage_angle / 2, p.passage_angle)
    kidney = extrude(SlotArc(arc, p.passage), amount=thickness)
    return body - [kidney.rotate(Axis.Z, 45 + 360 * index / p.passages) for index in range(p.passages)]


def build(p: P) -> Compound:
    """Drills the spacer and lays the gasket on it."""
    body = sheet(p, p.spacer, p.bore)
    body -= cone(p.bore + 2 * p.bevel, p.bore, p.bevel)
    body -= [rod(p.locating, p.locating_depth, (x, 0, 0), UP) for x in (-p.locating_x / 2, p.locating_x / 2)]
    body -= rod(p.sensor, p.outline[1] / 2, (0, -p.outline[1] / 2, p.spacer / 2), BACK)
    body -= drill(p.plug, p.plug_depth, (-p.outline[0] / 2, p.plug_y, p.spacer / 2), RIGHT)
    gasket = Pos(0, 0, p.spacer) * sheet(p, p.gasket, p.fire_ring)
    return assembly([named(body, "Cylinder spacer", "Silver"), named(gasket, "Head gasket", "DarkOrange")])


def questions(p: P) -> list[Item]:
    """Asked by an engine tuner, a gasket maker, a quality inspector and a trainee."""
    return [
        length("head gasket", "thickness", "How thick is the head gasket?", p.gasket),
        size("head gasket", "Size of the head gasket in x, y, z?", (*p.outline, p.gasket)),
        length("head gasket", "diameter", "What is the diameter of the large opening in the gasket?", p.fire_ring),
        length(
            "head gasket",
            "distance",
            "By how much is the gasket's big hole larger in diameter than the bore of the spacer?",
            p.fire_ring - p.bore,
        ),
        length("hole", "diameter", "What bore diameter does the cylinder spacer have?", p.bore),
        count("mounting hole", "How many stud holes are in the spacer's corners?", 4),
        lengths("mounting hole", "diameter", "dia. of the four stud holes in the gasket?", [p.stud] * 4),
        length(
            "mounting hole",
            "distance",
            "Centre distance of the stud holes of the spacer in the width direction (x)?",
            p.studs[0],
        ),
        count("slot", "How many curved water passages (kidney slots) does the gasket have?", p.passages),
        lengths("slot", "width", "How wide are the kidney shaped slots of the gasket?", [p.passage] * p.passages),
        count("blind hole", "How many blind holes does one see from the bottom?", 2),
        lengths("blind hole", "depth", "Depth of the blind holes on the underside?", [p.locating_depth] * 2),
        points(
            "blind hole",
            "where are the two blind holes at the bottom located",
            [(x, 0, p.locating_depth / 2) for x in (-p.locating_x / 2, p.locating_x / 2)],
        ),
        lengths(
            "hole",
            "diameter",
            "List the different diameters of all round holes in the spacer (without the gasket).",
            [p.sensor, p.locating, p.plug, p.stud, p.bore],
        ),
        length(
            "threaded hole", "depth", "How deep is the hole on the left side, drill point not counted?", p.plug_depth
        ),
        length("hole", "radius", "Radius of the small hole in the front side?", p.sensor / 2),
        angle("bevel", "At what angle to the underside is the bore's lower edge chamfered?", 45),
        length("object", "radius", "What is the radius of the spacer's rounded outer corners?", p.corner),
        text("object", "What's the name of the thinner body?", "Head gasket"),
        length("object", "height", "How high are spacer and gasket together?", p.spacer + p.gasket),
    ]
