"""A cable gland lying along x: body with hexagon, lock nut and O-ring on the entry side, seal insert and cap nut on the cable's side."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Compound, Pos, Rot, Torus

from benchmark.kit import Model
from benchmark.shapes import RIGHT, assembly, named, prism, rod

MODEL = Model("Cable gland", "held_out", bodies=5)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is x, the hexagon's face towards the panel lies on x = 0, the cable leaves to +x."""

    entry: float = 20  # M20 thread, drawn plain
    entry_length: float = 12
    flats: float = 24
    hexagon: float = 6  # its thickness
    spigot: float = 18  # under the cap nut
    spigot_length: float = 9
    bore: float = 13
    seat: float = 15  # counterbore for the seal
    seat_depth: float = 8
    seal_bore: float = 10
    seal_length: float = 11
    nut_start: float = 7  # x
    nut_flats: float = 22
    nut_hex: float = 10  # length of its hexagon
    collar: float = 20  # round part of the cap nut
    nut_end: float = 22  # x
    opening: float = 12
    ring_cord: float = 3
    lock_flats: float = 26
    lock_thickness: float = 5
    lock_start: float = -10  # x

    @property
    def body_end(self) -> float:
        """Where does the body end? x."""
        return self.hexagon + self.spigot_length

    @property
    def seal_start(self) -> float:
        """Where does the seal begin? x."""
        return self.body_end - self.seat_depth

    @property
    def seal_end(self) -> float:
        """Where does the seal end? x."""
        return self.seal_start + self.seal_length


def build(p: P) -> Compound:
    """Turns the parts and lines them up on the axis."""
    body = rod(p.entry, p.entry_length, (-p.entry_length, 0, 0), RIGHT)
    body += prism(p.flats, p.hexagon, (0, 0, 0), RIGHT)
    body += rod(p.spigot, p.spigot_length, (p.hexagon, 0, 0), RIGHT)
    body -= rod(p.bore, p.entry_length + p.body_end, (-p.entry_length, 0, 0), RIGHT)
    body -= rod(p.seat, p.seat_depth, (p.seal_start, 0, 0), RIGHT)
    seal = rod(p.seat, p.seal_length, (p.seal_start, 0, 0), RIGHT)
    seal -= rod(p.seal_bore, p.seal_length, (p.seal_start, 0, 0), RIGHT)
    nut = prism(p.nut_flats, p.nut_hex, (p.nut_start, 0, 0), RIGHT)
    hexed = p.nut_start + p.nut_hex
    nut += rod(p.collar, p.nut_end - hexed, (hexed, 0, 0), RIGHT)
    nut -= rod(p.spigot, p.seal_end - p.nut_start, (p.nut_start, 0, 0), RIGHT)
    nut -= rod(p.opening, p.nut_end - p.seal_end, (p.seal_end, 0, 0), RIGHT)
    ring = Pos(-p.ring_cord / 2, 0, 0) * Rot(0, 90, 0) * Torus((p.entry + p.ring_cord) / 2, p.ring_cord / 2)
    lock = prism(p.lock_flats, p.lock_thickness, (p.lock_start, 0, 0), RIGHT)
    lock -= rod(p.entry, p.lock_thickness, (p.lock_start, 0, 0), RIGHT)
    return assembly(
        [
            named(body, "Gland body", "Silver"),
            named(seal, "Seal insert", "Black"),
            named(nut, "Cap nut", "Goldenrod"),
            named(ring, "O-ring", "DimGray"),
            named(lock, "Lock nut", "SteelBlue"),
        ]
    )
