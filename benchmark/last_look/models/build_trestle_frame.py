"""A welded trestle: a rectangular tube on two square posts, a tie tube between them, two flat feet with anchor holes."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Compound, Part

from benchmark.kit import Model
from benchmark.shapes import assembly, block, grid, named, rod

MODEL = Model("Trestle frame", "held_out", bodies=6)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the feet stand on z = 0, the beam runs along x, the middle is x = y = 0."""

    beam: tuple[float, float, float] = (900, 60, 80)  # length, width, height
    beam_wall: float = 4
    post: float = 50  # outside of the square tube
    post_wall: float = 3
    post_length: float = 640
    posts: float = 640  # between their middles
    tie: tuple[float, float] = (30, 50)  # width, height of the tube
    tie_wall: float = 2
    tie_z: float = 210  # of its middle
    foot: tuple[float, float, float] = (100, 420, 10)
    anchor: float = 14
    anchors_y: float = 350
    bolt: float = 11  # through both walls of the beam from the top
    bolts: int = 4
    bolt_pitch: float = 180
    drain: float = 8  # in each post, from outside, above the foot
    drain_z: float = 30


def _tube(outer: tuple[float, float, float], wall: float, start: tuple[float, float, float], upright: bool) -> Part:
    """A rectangular tube on `start`: upright along z, else along x; `outer` along x, y, z."""
    x, y, z = outer
    solid = block(outer, start)
    if upright:
        return solid - block((x - 2 * wall, y - 2 * wall, z), start)
    return solid - block((x, y - 2 * wall, z - 2 * wall), (start[0], start[1], start[2] + wall))


def build(p: P) -> Compound:
    """Saws, drills and sets the parts at their places."""
    base = p.foot[2]
    top = base + p.post_length
    beam = _tube(p.beam, p.beam_wall, (0, 0, top), upright=False)
    for at in grid(p.bolts, 1, p.bolt_pitch, 0):
        beam -= rod(p.bolt, p.beam[2], (*at, top))
    length = p.posts - p.post
    tie = _tube((length, *p.tie), p.tie_wall, (0, 0, p.tie_z - p.tie[1] / 2), upright=False)
    parts = [named(beam, "top beam", "orange"), named(tie, "tie tube", "gold")]
    for side, name in ((-1, "left"), (1, "right")):
        x = side * p.posts / 2
        post = _tube((p.post, p.post, p.post_length), p.post_wall, (x, 0, base), upright=True)
        outside = x + side * p.post / 2
        post -= rod(p.drain, p.post_wall, (outside, 0, p.drain_z), (-side, 0, 0))
        parts.append(named(post, f"{name} post", "steelblue"))
        foot = block(p.foot, (x, 0, 0))
        for y in (-1, 1):
            foot -= rod(p.anchor, p.foot[2], (x, y * p.anchors_y / 2, 0))
        parts.append(named(foot, f"{name} foot", "dimgray"))
    return assembly(parts)
