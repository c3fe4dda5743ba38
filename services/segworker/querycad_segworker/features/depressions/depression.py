"""What a depression is: a pocket, passage, slot, channel, notch, step, groove or cavity."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from enum import StrEnum

from querycad_contracts import Vector
from querycad_segworker.features.shared.clearance import IsClear
from querycad_segworker.features.shared.frames import LocalFrame
from querycad_segworker.tolerances import exceeds
from querycad_segworker.vectors import add, scale

ELONGATED = 1.5
"""A depression this much longer than wide is called a slot rather than a pocket or cutout; keyways and mounting slots
are longer than that (DIN 6885, ISO 15071), square pockets are not."""

BEYOND = 0.1
"""So much of its width beyond its end it is open there."""


class DepressionKind(StrEnum):
    """What an engineer calls it."""

    POCKET = "pocket"
    """Closed all around, with a floor."""
    PASSAGE = "passage"
    """Closed all around, from one face to another."""
    SLOT = "slot"
    """Two walls that face each other across a floor, open at one end or both."""
    CHANNEL = "channel"
    """As a slot, but so wide that the body is a U section."""
    STEP = "step"
    """A floor with walls on one side, or on two that meet in a corner."""
    NOTCH = "notch"
    """As a slot, but shorter than wide: cut into the edge of a plate or wall, right through it."""
    GROOVE = "groove"
    """Closed on itself around an island that is level with its rim, as for an O-ring in a face."""
    CAVITY = "cavity"
    """A void inside the material, without an opening."""
    DEPRESSION = "depression"
    """None of these: closed off by convex edges, in any form."""


@dataclass(frozen=True, slots=True)
class Depression:
    """One depression. Metres, frame of the file.

    `normal` points out of its opening. `length`, `width` and `depth` are in its own frame: along it, across it and
    into the material. `outline` is 'rectangular', 'triangular', 'hexagonal', 'obround', 'circular' … or 'free'.
    """

    kind: DepressionKind
    outline: str
    normal: Vector
    opening: Vector
    center: Vector
    length: float
    width: float
    depth: float
    direction: Vector
    """Unit direction of its length."""
    floor: tuple[int, ...]
    faces: tuple[int, ...]
    body: int
    corner_radius: float | None = None
    is_open: bool = False
    """Not closed all around: it runs out at a border."""
    tags: tuple[str, ...] = ()
    """What else it is called by: 'v_shaped', 't_slot', 'dovetail', 'keyway', 'radial' …"""
    floor_width: float | None = None
    """Of a T slot or dovetail, metres: `width` is that of its mouth."""
    angle: float | None = None
    """Radians. Between the flanks of a V, between flank and floor of a dovetail."""


def depression_in(
    kind: DepressionKind,
    outline: str,
    frame: LocalFrame,
    faces: Iterable[int],
    floor: tuple[int, ...],
    body: int,
    *,
    is_open: bool = False,
) -> Depression:
    """The depression that fills the box of its own frame."""
    length, width, depth = frame.size
    return Depression(
        kind=kind,
        outline=outline,
        normal=frame.n,
        opening=frame.point(0.5, 0.5, 1.0),
        center=frame.point(0.5, 0.5, 0.5),
        length=length,
        width=width,
        depth=depth,
        direction=frame.u,
        floor=floor,
        faces=tuple(sorted(faces)),
        body=body,
        is_open=is_open,
    )


def with_open_ends(found: Depression, is_clear: IsClear) -> Depression:
    """Tagged 'open_ended' where one can leave it at both ends of its length, 'open_end' where at one."""
    if not found.is_open or not exceeds(found.length, found.width):
        return found
    ends = (scale(found.direction, side * (found.length / 2 + BEYOND * found.width)) for side in (-1.0, 1.0))
    clear = sum(is_clear(found.center, add(found.center, end)) for end in ends)
    return replace(found, tags=(*found.tags, ("open_end", "open_ended")[clear - 1])) if clear else found
