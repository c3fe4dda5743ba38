"""A printed part-cooling duct: socket for a radial blower, tapering throat, slit nozzle with vanes, fixing ear."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Part, Polyline, Shell, Solid, make_face

from benchmark.kit import Model
from benchmark.shapes import BACK, Vector, block, rod

MODEL = Model("Blower duct", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; air comes in at the top of the socket and leaves downwards, shifted towards -y."""

    inlet: tuple[float, float] = (20.4, 15.4)  # opening: x, y
    wall: float = 1.6
    socket: float = 12  # height over the throat
    drop: float = 32  # height of the throat
    shift: float = 14  # of the nozzle towards -y
    outlet: tuple[float, float] = (28, 5)  # opening
    nozzle: float = 6  # height of the straight nozzle
    vanes: int = 2
    vane: float = 0.8  # thickness
    vane_height: float = 12  # from the mouth upwards
    ear: tuple[float, float, float] = (12, 5, 14)  # x, y, z over the socket's top; behind the inlet, +y
    ear_hole: float = 4.3
    ear_hole_z: float = 8  # over the socket's top
    clip: tuple[float, float, float] = (8, 10, 3)  # tab on the +x side of the socket: x, y, z
    clip_hole: float = 3.2
    snap: float = 2.5  # holes through both x walls for a latch
    snap_z: float = 8  # over the throat
    notch: tuple[float, float] = (6, 4)  # in the socket's front wall, -y: x, depth from the top


def _ring(x: float, y: float, middle: float, z: float) -> list[Vector]:
    """The corners of a level rectangle."""
    return [(i * x / 2, middle + j * y / 2, z) for i, j in ((1, 1), (-1, 1), (-1, -1), (1, -1))]


def build(p: P) -> Part:
    """Joins flat throat walls outside and inside; z = 0 is where socket and throat meet."""
    w = 2 * p.wall

    def channel(grow: float) -> Part:
        top = _ring(p.inlet[0] + grow, p.inlet[1] + grow, 0, 0)
        low = _ring(p.outlet[0] + grow, p.outlet[1] + grow, -p.shift, -p.drop)
        sides = [(low[i - 1], low[i], top[i], top[i - 1]) for i in range(4)]
        faces = [make_face(Polyline(*loop, close=True)).faces()[0] for loop in (*sides, low, top)]
        throat = Part() + Solid(Shell(faces))
        over = block((p.inlet[0] + grow, p.inlet[1] + grow, p.socket))
        end = (p.outlet[0] + grow, p.outlet[1] + grow, p.nozzle)
        return throat + over + block(end, (0, -p.shift, -p.drop - p.nozzle))

    inner = channel(0)
    back = p.inlet[1] / 2 + p.wall
    body = channel(w)
    body += block((p.ear[0], p.ear[1], p.ear[2] + p.socket), (0, back + p.ear[1] / 2, 0))
    side = p.inlet[0] / 2 + p.wall
    body += block((p.clip[0], p.clip[1], p.clip[2]), (side + p.clip[0] / 2, 0, p.socket - p.clip[2]))
    body -= inner
    cell = (p.outlet[0] + p.vane) / (p.vanes + 1)
    for index in range(p.vanes):
        x = (index - (p.vanes - 1) / 2) * cell
        base = (x, -p.shift, -p.drop - p.nozzle)
        body += block((p.vane, 60, p.vane_height), base).intersect(inner)
    body -= rod(p.ear_hole, 20, (0, back - 5, p.socket + p.ear_hole_z), BACK)
    body -= rod(p.clip_hole, p.clip[2], (side + p.clip[0] / 2, 0, p.socket - p.clip[2]))
    for sign in (-1, 1):
        body -= rod(p.snap, w, (sign * (side - p.wall * 1.5), 0, p.snap_z - 5), (sign, 0, 0))
    body -= block((p.notch[0], w, p.notch[1]), (0, -back, p.socket - p.notch[1]))
    return body
