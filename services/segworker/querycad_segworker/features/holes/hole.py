"""What a hole is: its record, and its sections along the axis."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from querycad_contracts import Bottom, Vector


class SectionKind(StrEnum):
    """What one wall of a hole or shaft is to the rest."""

    BORE = "bore"
    COUNTERBORE = "counterbore"
    SEAT = "seat"
    """A step too narrow for the head of a screw: of a bearing, seal or lens."""
    SPOTFACE = "spotface"
    COUNTERSINK = "countersink"
    CHAMFER = "chamfer"
    DRILL_POINT = "drill_point"


@dataclass(frozen=True, slots=True)
class Section:
    """One wall of a hole, or edge break of a shaft, between two points on its axis. Metres.

    `start` is the end nearer to a surface: to the hole's opening, or to its far opening for what was cut from there.
    `radius` is that at `start`, `end_radius` that at `end`; `normal` points from `end` to `start`.
    """

    kind: SectionKind
    start: Vector
    end: Vector
    radius: float
    end_radius: float
    normal: Vector
    faces: tuple[int, ...]
    is_fillet: bool = False
    """A torus between a wall and a floor or shoulder: no taper, and no stage of its own."""


RIM = "rim"
"""Tag of what is no hole but the inside of a rim, with a hub in it, as of a wheel with spokes."""


@dataclass(frozen=True, slots=True)
class Hole:
    """One hole. Metres, frame of the file.

    `normal` points out of the opening; `far_opening` is where its other end opens, through the material or into
    another bore, as `bottom` says. `radius` is the bore's: the narrowest cylinder (or cone end). `steps` are the
    cylinders' radii from the opening inwards, neighbours of one radius counted once; `sections` all walls, likewise.
    `depth` runs from the opening to the bottom at full diameter: a drill point is not counted.
    """

    opening: Vector
    far_opening: Vector | None
    normal: Vector
    center: Vector
    radius: float
    opening_radius: float
    steps: tuple[float, ...]
    depth: float
    bottom: Bottom
    tags: tuple[str, ...]
    faces: tuple[int, ...]
    body: int
    sections: tuple[Section, ...] = ()
    pitch: float | None = None
    """Of a modelled thread, along the axis."""
    core_radius: float | None = None
    """Of a boss that stands inside: the walls bound a ring-shaped groove."""

    @property
    def is_ring(self) -> bool:
        """Is it a ring-shaped groove rather than a hole?"""
        return self.core_radius is not None
