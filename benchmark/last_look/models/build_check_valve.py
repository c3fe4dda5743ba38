"""An in-line check valve, shut: hexagon body, screwed end cap, seat ring, guided poppet, spring."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Circle, Compound, Helix, Plane, sweep

from benchmark.kit import Model
from benchmark.shapes import LEFT, RIGHT, assembly, circle, cone, named, prism, rod

MODEL = Model("Check valve", "held_out", bodies=5)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is x, the inlet face of the body is x = 0; the oil runs to +x."""

    flats: float = 41  # body across flats
    length: float = 70  # body
    port: float = 18.6  # core of G1/2, inlet
    port_depth: float = 16
    passage: float = 14  # from the inlet port to the seat
    chamber: float = 27  # bore that takes seat, poppet and cap spigot
    chamber_from: float = 22  # x of its ground
    seat_bore: float = 12
    seat_length: float = 10
    seat_bevel: float = 1.5  # 45 degrees, on the downstream edge
    poppet: float = 20  # diameter of the head
    poppet_head: float = 8  # cylindrical length
    poppet_stem: float = 9
    poppet_stem_length: float = 24  # from the head's back
    wire: float = 1.8
    coil: float = 15  # mean diameter of the spring
    turns: float = 4
    cap_flats: float = 36
    cap_hex: float = 20  # length of its hexagon
    cap_spigot: float = 10  # how deep it screws into the body
    cap_bore: float = 9.4  # guide for the stem
    cap_port: float = 18.6
    cap_port_depth: float = 16
    cross_holes: int = 6  # flow holes round the guide
    cross_hole: float = 3.4
    cross_pcd: float = 14.8  # bolt circle


def build(p: P) -> Compound:
    """Five bodies on one axis."""
    body = prism(p.flats, p.length, (0, 0, 0), RIGHT)
    body -= rod(p.port, p.port_depth, (0, 0, 0), RIGHT)
    body -= rod(p.passage, p.chamber_from, (0, 0, 0), RIGHT)
    body -= rod(p.chamber, p.length - p.chamber_from, (p.chamber_from, 0, 0), RIGHT)

    x = p.chamber_from + p.seat_length
    b = p.seat_bevel
    seat = rod(p.chamber, p.seat_length, (p.chamber_from, 0, 0), RIGHT) - rod(p.seat_bore, p.seat_length, (p.chamber_from, 0, 0), RIGHT)
    seat -= cone(p.seat_bore, p.seat_bore + 2 * b, b, (x - b, 0, 0), RIGHT)

    # 45 degree nose that lies on the seat's bevel and is cut off flat at the bore's diameter
    poppet = cone(p.seat_bore, p.seat_bore + 2 * b, b, (x - b, 0, 0), RIGHT)
    nose = (p.poppet - p.seat_bore - 2 * b) / 2
    poppet += cone(p.seat_bore + 2 * b, p.poppet, nose, (x, 0, 0), RIGHT)
    back = x + nose + p.poppet_head
    poppet += rod(p.poppet, p.poppet_head, (x + nose, 0, 0), RIGHT)
    poppet += rod(p.poppet_stem, p.poppet_stem_length, (back, 0, 0), RIGHT)

    start = back + p.wire / 2
    end = p.length - p.cap_spigot - p.wire / 2
    path = Helix(pitch=(end - start) / p.turns, height=end - start, radius=p.coil / 2)
    section = Plane(origin=path @ 0, z_dir=path % 0) * Circle(p.wire / 2)
    spring = Plane(origin=(start, 0, 0), x_dir=(0, 1, 0), z_dir=(1, 0, 0)).location * sweep(section, path=path, is_frenet=True)

    inner = p.length - p.cap_spigot
    cap = rod(p.chamber, p.cap_spigot, (inner, 0, 0), RIGHT) + prism(p.cap_flats, p.cap_hex, (p.length, 0, 0), RIGHT)
    out = p.length + p.cap_hex
    cap -= rod(p.cap_port, p.cap_port_depth, (out, 0, 0), LEFT)
    cap -= rod(p.cap_bore, p.cap_spigot + p.cap_hex, (inner, 0, 0), RIGHT)
    for y, z in circle(p.cross_holes, p.cross_pcd):
        cap -= rod(p.cross_hole, p.cap_spigot + p.cap_hex - p.cap_port_depth, (inner, y, z), RIGHT)
    return assembly([
        named(body, "body", "silver"),
        named(seat, "seat ring", "gold"),
        named(poppet, "poppet", "firebrick"),
        named(spring, "spring", "black"),
        named(cap, "end cap", "steelblue"),
    ])
