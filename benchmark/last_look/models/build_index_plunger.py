"""An indexing plunger: sleeve with hexagon, pin, pull knob, closing bush and lock nut."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Compound, Part, chamfer, fillet

from benchmark.kit import Model
from benchmark.shapes import assembly, named, prism, rod

MODEL = Model("Indexing plunger", "held_out", bodies=5)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is z, the sleeve's lower end is z = 0, the pin looks out below."""

    shank: float = 16  # diameter of the sleeve, M16 x 1.5 shown plain
    shank_length: float = 28
    hexagon: float = 19  # across flats, of the sleeve
    hexagon_height: float = 8
    neck: float = 18  # diameter above the hexagon
    neck_height: float = 9
    shank_chamfer: float = 1.2
    guide: float = 8.1  # bore for the pin
    guide_length: float = 8
    chamber: float = 12  # bore for the spring
    pin: float = 8  # diameter
    reach: float = 10  # of the pin below the sleeve
    tip_chamfer: float = 1.5
    collar: float = 11.6  # diameter of the pin's collar
    collar_height: float = 3
    stem: float = 5  # diameter of the pin's upper part
    bush: float = 5.2  # bore of the closing bush
    bush_height: float = 5
    knob: float = 25  # diameter
    knob_height: float = 20
    knob_gap: float = 0.5  # above the sleeve
    waist: float = 17  # diameter of the knob's lower part
    waist_height: float = 7
    knob_fillet: float = 3  # round the top
    socket: float = 12  # depth of the knob's bore for the stem
    nut: float = 24  # across flats, of the lock nut
    nut_height: float = 8
    nut_z: float = 17  # underside of the lock nut

    @property
    def sleeve_height(self) -> float:
        return self.shank_length + self.hexagon_height + self.neck_height

    @property
    def knob_z(self) -> float:
        return self.sleeve_height + self.knob_gap


def _sleeve(p: P) -> Part:
    body = rod(p.shank, p.shank_length)
    body = chamfer(body.edges().sort_by(Axis.Z)[0], p.shank_chamfer)
    body += prism(p.hexagon, p.hexagon_height, (0, 0, p.shank_length))
    body += rod(p.neck, p.neck_height, (0, 0, p.shank_length + p.hexagon_height))
    body -= rod(p.guide, p.guide_length)
    return body - rod(p.chamber, p.sleeve_height - p.guide_length, (0, 0, p.guide_length))


def _pin(p: P) -> Part:
    low = rod(p.pin, p.reach + p.guide_length, (0, 0, -p.reach))
    low = chamfer(low.edges().sort_by(Axis.Z)[0], p.tip_chamfer)
    body = low + rod(p.collar, p.collar_height, (0, 0, p.guide_length))
    foot = p.guide_length + p.collar_height
    return body + rod(p.stem, p.knob_z + p.socket - foot, (0, 0, foot))


def _knob(p: P) -> Part:
    body = rod(p.knob, p.knob_height - p.waist_height, (0, 0, p.knob_z + p.waist_height))
    body = fillet(body.edges().sort_by(Axis.Z)[-1], p.knob_fillet)
    body += rod(p.waist, p.waist_height, (0, 0, p.knob_z))
    return body - rod(p.stem, p.socket, (0, 0, p.knob_z))


def build(p: P) -> Compound:
    """Turns the five parts and puts them together, the pin out."""
    bush_z = p.sleeve_height - p.bush_height
    bush = rod(p.chamber, p.bush_height, (0, 0, bush_z)) - rod(p.bush, p.bush_height, (0, 0, bush_z))
    nut = prism(p.nut, p.nut_height, (0, 0, p.nut_z)) - rod(p.shank, p.nut_height, (0, 0, p.nut_z))
    return assembly(
        [
            named(_sleeve(p), "sleeve", "steelblue"),
            named(_pin(p), "pin", "silver"),
            named(bush, "closing bush", "goldenrod"),
            named(_knob(p), "knob", "black"),
            named(nut, "lock nut", "gray"),
        ]
    )
