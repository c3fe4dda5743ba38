"""A ball stud of a steering joint: threaded shank, taper, collar, hexagon, neck and ball."""

from __future__ import annotations

import math
from dataclasses import dataclass

from build123d import GeomType, Part, Pos, Sphere, chamfer, fillet

from benchmark.kit import Model
from benchmark.shapes import RIGHT, block, cone, prism, rod

MODEL = Model("Ball stud", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; turned about z, the thread's end at z = 0, the ball on top."""

    thread: float = 12  # M12
    thread_length: float = 22
    bevel: float = 1.5
    undercut: float = 9.5
    undercut_width: float = 3
    taper_small: float = 14
    taper_large: float = 17
    taper_length: float = 20
    collar: float = 28
    collar_height: float = 4
    hexagon: float = 22  # across flats
    hexagon_height: float = 7
    neck: float = 11
    neck_fillet: float = 2
    ball: float = 24
    ball_z: float = 76  # of its centre
    flat: float = 9  # diameter of the flat on the ball
    split_pin: float = 3.2  # cross hole
    split_pin_z: float = 8
    socket: float = 5  # across flats, in the thread's end
    socket_depth: float = 4


def build(p: P) -> Part:
    """Turns it, mills the hexagon, drills it."""
    z = p.thread_length
    shank = rod(p.thread, z)
    shank = chamfer(shank.edges().group_by()[0], p.bevel)
    body = shank + rod(p.undercut, p.undercut_width, (0, 0, z))
    z += p.undercut_width
    body += cone(p.taper_small, p.taper_large, p.taper_length, (0, 0, z))
    z += p.taper_length
    body += rod(p.collar, p.collar_height, (0, 0, z))
    z += p.collar_height
    body += prism(p.hexagon, p.hexagon_height, (0, 0, z))
    z += p.hexagon_height
    body += rod(p.neck, p.ball_z - z, (0, 0, z))
    body += Pos(0, 0, p.ball_z) * Sphere(p.ball / 2)
    top = p.ball_z + math.sqrt((p.ball / 2) ** 2 - (p.flat / 2) ** 2)
    body -= block((p.ball, p.ball, p.ball), (0, 0, top))
    foot = [
        e
        for e in body.edges().filter_by(GeomType.CIRCLE)
        if abs(e.center().Z - z) < 1e-6 and abs(e.radius - p.neck / 2) < 1e-6
    ]
    body = fillet(foot, p.neck_fillet)
    body -= rod(p.split_pin, p.thread * 2, (-p.thread, 0, p.split_pin_z), RIGHT)
    body -= prism(p.socket, p.socket_depth)
    return body
