"""A rocker arm in an oblique position: pivot boss, forked end, threaded end with a nut hole, pocket, pad."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Part, Pos, Rot

from benchmark.kit import Item, Model, Triple, count, length, point
from benchmark.shapes import DOWN, block, prism, rod

MODEL = Model("Rocker arm in an oblique position", "dev")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres and degrees; not yet turned, the arm lies along x, the pivot's axis is z, the arm's middle z = 0."""

    width: float = 22
    thickness: float = 16
    boss: float = 38
    boss_height: float = 26
    pivot: float = 20
    fork: float = 60  # from the pivot to the roller's pin
    fork_slot: tuple[float, float] = (26, 7)  # length from the pin's axis on to the pivot and beyond; width
    roller_pin: float = 8
    screw: float = 70  # from the pivot to the adjusting screw
    end: float = 28  # diameter of the threaded end
    core: float = 8.5  # core hole of M10
    flats: float = 16  # of the nut hole (ISO 4032)
    nut_depth: float = 6
    pocket: tuple[float, float, float] = (20, 12, 4)
    pocket_x: float = 38
    pad: tuple[float, float, float] = (14, 12, 5)  # below, for the valve spring
    pad_x: float = 40
    turn: Triple = (28, 17, -35)  # about x, y and z, each about the turned axes

    def turned(self, at: Triple) -> Triple:
        """Where does a point go?"""
        place = (Rot(*self.turn) * Pos(*at)).position
        return (place.X, place.Y, place.Z)


def build(p: P) -> Part:
    """Forges arm, ends and boss, mills fork, pocket and nut hole, drills, turns into place."""
    top = p.thickness / 2
    body = block((p.fork + p.screw, p.width, p.thickness), ((p.screw - p.fork) / 2, 0, -top))
    body += rod(p.width, p.thickness, (-p.fork, 0, -top)) + rod(p.end, p.thickness, (p.screw, 0, -top))
    body += rod(p.boss, p.boss_height, (0, 0, -p.boss_height / 2)) + block(p.pad, (p.pad_x, 0, -top - p.pad[2]))
    reach, gap = p.fork_slot
    left = p.fork + p.width / 2
    body -= block((reach, p.width, gap), (reach / 2 - left, 0, -gap / 2))
    body -= rod(p.pivot, p.boss_height, (0, 0, -p.boss_height / 2))
    body -= rod(p.roller_pin, p.thickness, (-p.fork, 0, -top))
    body -= rod(p.core, p.thickness, (p.screw, 0, -top)) + prism(p.flats, p.nut_depth, (p.screw, 0, top), DOWN)
    return Rot(*p.turn) * (body - block(p.pocket, (p.pocket_x, 0, top - p.pocket[2])))


def questions(p: P) -> list[Item]:
    """Asked in the plain way, and by an engine builder, a caster and an Italian designer."""
    return [
        count("hole", "How many holes does the object have?", 3),
        length("hole", "diameter", "What is the diameter of the largest hole?", p.pivot),
        length("semicircle", "radius", "What is the radius of the semicircle at the forked end?", p.width / 2),
        length("nut hole", "width", "What is the width across flats of the nut hole?", p.flats),
        length("rectangular indentation", "depth", "What is the depth of the rectangular indentation?", p.pocket[2]),
        length("rectangular protrusion", "height", "What is the height of the rectangular protrusion?", p.pad[2]),
        length("circular protrusion", "diameter", "What is the outer diameter of the pivot boss?", p.boss),
        length("slot", "width", "fork width, I mean the slot for the roller?", p.fork_slot[1]),
        length(
            "threaded hole",
            "distance",
            "Centre distance from the pivot bore to the M10 threaded hole",
            p.screw,
        ),
        length("through hole", "distance", "and from pivot bore to the 8 mm roller pin hole?", p.fork),
        point("through hole", "Where is the center of the 8 mm roller pin hole?", p.turned((-p.fork, 0, 0))),
        length("threaded hole", "diameter", "Tap drill size of the thread at the end of the arm?", p.core),
        length("nut hole", "depth", "How deep does the hexagon nut sink into the arm?", p.nut_depth),
        length("through hole", "depth", "How long is the bore of the pivot through the boss, please?", p.boss_height),
    ]
