"""A screwed thermowell with a hexagon, a tapered pipe thread, a stepped stem and a long blind bore; drawn in inches."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, GeomType, Part, fillet

from benchmark.kit import INCH, Model
from benchmark.shapes import DOWN, cone, prism, rod

MODEL = Model("Thermowell", "held_out", unit="in")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres, from inches; the tip is at z = 0, the hexagon at the top, the axis is z."""

    tip: float = 0.5 * INCH  # diameter of the thin end of the stem
    tip_length: float = 2.25 * INCH
    tip_round: float = 0.0625 * INCH
    reducer: float = 0.5 * INCH  # length of the cone between thin and thick stem
    shank: float = 0.875 * INCH  # diameter of the thick end of the stem
    shank_length: float = 1.75 * INCH
    thread_end: float = 1.0 * INCH  # lower diameter of the pipe thread (modelled as a smooth cone, 1 in 16)
    thread: float = 1.05 * INCH  # upper diameter
    thread_length: float = 0.8 * INCH
    hexagon: float = 1.25 * INCH  # across flats
    hexagon_height: float = 0.75 * INCH
    cap: float = 1.125 * INCH  # round collar above the hexagon
    cap_height: float = 0.5 * INCH
    bore: float = 0.26 * INCH
    end_wall: float = 0.25 * INCH  # between the bore's flat ground and the tip
    socket: float = 0.72 * INCH  # for the head's thread, from the top
    socket_depth: float = 0.75 * INCH


def build(p: P) -> Part:
    """Turns the well from the tip up."""
    body = rod(p.tip, p.tip_length)
    body = fillet(body.edges().filter_by(GeomType.CIRCLE).sort_by(Axis.Z)[0], p.tip_round)
    z = p.tip_length
    body += cone(p.tip, p.shank, p.reducer, (0, 0, z))
    z += p.reducer
    body += rod(p.shank, p.shank_length, (0, 0, z))
    z += p.shank_length
    body += cone(p.thread_end, p.thread, p.thread_length, (0, 0, z))
    z += p.thread_length
    body += prism(p.hexagon, p.hexagon_height, (0, 0, z))
    z += p.hexagon_height
    body += rod(p.cap, p.cap_height, (0, 0, z))
    z += p.cap_height
    body -= rod(p.bore, z - p.end_wall, (0, 0, p.end_wall))
    body -= rod(p.socket, p.socket_depth, (0, 0, z), DOWN)
    return body
