"""How thick is a body? As its wall where it has one, else as the plate that it is, else as it is long or high."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence

from querycad_contracts import Part, SurfaceKind
from querycad_segworker.features.protrusions.prisms import Prism
from querycad_segworker.features.shared.frames import frame_of
from querycad_segworker.features.shared.part_measures import PLATE_RATIO, faces_box
from querycad_segworker.features.turned.round_bodies import TurnedBody
from querycad_segworker.tolerances import reaches
from querycad_segworker.topology import BodyRecord, Brep, FaceRecord
from querycad_segworker.vectors import box_extents, cross, dot, span, sub

SAME = 0.01
"""Thicknesses that differ by less than this share are one."""
HOLLOW = 0.35
"""An open box fills less than this share of its block; a nut fills 0.4 of it and more (ISO 4032)."""
MOST = 0.5
"""A body that is a plate, or joined of plates of one thickness, has more than this share of its volume in them."""


def with_body_thickness(
    bodies: Sequence[Part],
    brep: Brep,
    prisms: Sequence[Prism],
    turned: Sequence[TurnedBody | None],
    walls: Mapping[int, float],
    least: Mapping[int, float],
) -> list[Part]:
    """The same bodies with their thickness, and that of their thinnest wall, where they have one.

    `prisms`: those of the model, plates among them; `turned`: what each body is as a turned one; `walls`: thicknesses
    that most of a body's surface, or the sides of a box, share, by body id; `least`: those of the thinnest ones.
    """
    result = []
    own: dict[int, list[Prism]] = defaultdict(list)
    for prism in prisms:
        own[prism.body].append(prism)
    for part, record, form in zip(bodies, brep.bodies, turned, strict=True):
        thickness = _thickness(brep, record, own[record.id], form, walls.get(record.id))
        found = {"thickness": thickness, "minimum_thickness": least.get(record.id)}
        result.append(part.model_copy(update={name: value for name, value in found.items() if value is not None}))
    return result


def _thickness(
    brep: Brep, record: BodyRecord, prisms: Sequence[Prism], turned: TurnedBody | None, wall: float | None
) -> float | None:
    if turned is not None and "tube" in turned.tags and turned.wall is not None:
        return turned.wall
    if turned is not None and turned.steps == 1 and turned.length < turned.outer_radius:
        return turned.disc or turned.length
    joined = _of_plates(record, prisms)
    if joined is not None or wall is not None:
        return joined or wall
    if turned is not None:
        return (turned.disc or turned.length) if turned.length < turned.outer_radius else None
    return _flat_thickness(brep, record) or _low_prism(brep, record, prisms)


def _of_plates(record: BodyRecord, prisms: Sequence[Prism]) -> float | None:
    """The thickness of the plates that a body is bent or joined of, as an L-bracket is."""
    plates = [prism for prism in prisms if not reaches(prism.height, PLATE_RATIO * prism.width)]
    if len(plates) < 2:
        return None
    thickness = plates[0].height
    alike = all(abs(plate.height - thickness) <= SAME * thickness for plate in plates)
    made_of = sum(plate.length * plate.width * plate.height for plate in plates) > MOST * record.volume
    return thickness if alike and made_of else None


def largest_plane(brep: Brep, record: BodyRecord) -> FaceRecord | None:
    """Which is the largest plane face of a body?"""
    planes = [face for face in brep.of_kind(SurfaceKind.PLANE, record.faces) if face.loops]
    return max(planes, key=lambda face: face.area, default=None)


def is_flat(brep: Brep, record: BodyRecord) -> bool:
    """Is a body a plate: low square to its largest plane face, against its width along it?"""
    size = _size(brep, record)
    return size is not None and not reaches(size[2], PLATE_RATIO * size[1])


def _size(brep: Brep, record: BodyRecord) -> tuple[float, float, float] | None:
    """Length and width along its largest plane face, and height square to it."""
    largest = largest_plane(brep, record)
    return None if largest is None else frame_of(brep, record.faces, largest.axis, largest.loops[0]).size


def _flat_thickness(brep: Brep, record: BodyRecord) -> float | None:
    """How thick is a body that is flat, but for what stands on it and makes it no higher than wide?"""
    size, between = _size(brep, record), _between_largest(brep, record)
    if size is None:
        return None
    _, width, height = size
    if between is not None and not reaches(between, PLATE_RATIO * width) and height < width:
        return between
    return None if reaches(height, PLATE_RATIO * width) else height


def _reach(brep: Brep, record: BodyRecord, direction: tuple[float, float, float]) -> float:
    low, high = span((brep.edges[e].mid for e in brep.edges_of(record.faces)), direction)
    return high - low


def _between_largest(brep: Brep, record: BodyRecord) -> float | None:
    """How far is the largest plane face from the largest one that looks the other way, where most of the body is there?

    What stands on a plate or is sunk into it is not counted; of an open box, most is in its walls.
    """
    largest = largest_plane(brep, record)
    if largest is None:
        return None
    planes = brep.of_kind(SurfaceKind.PLANE, record.faces)
    others = [face for face in planes if dot(face.axis, largest.axis) < SAME - 1]
    other = max(others, key=lambda face: face.area, default=None)
    if other is None:
        return None
    gap = dot(sub(largest.point, other.point), largest.axis)
    return gap if largest.area * gap > MOST * record.volume else None


def _low_prism(brep: Brep, record: BodyRecord, prisms: Sequence[Prism]) -> float | None:
    """The height of the prism that a body is as a whole, such as a nut, where it is lower than wide."""
    extents = box_extents(faces_box(brep, record.faces))
    for prism in prisms:
        fills = all(abs(a - b) <= SAME * max(extents) for a, b in zip(prism.extents, extents, strict=True))
        solid = record.volume > HOLLOW * prism.length * prism.width * prism.height  # no open box
        if fills and solid and prism.height < (1 - SAME) * prism.width and _is_whole(brep, record, prism):
            return prism.height
    return None


def _is_whole(brep: Brep, record: BodyRecord, prism: Prism) -> bool:
    """Does nothing of the body reach beyond the prism?"""
    u = prism.direction
    whole = [_reach(brep, record, d) for d in (u, cross(prism.normal, u), prism.normal)]
    own = (prism.length, prism.width, prism.height)
    return all(abs(a - b) <= SAME * b for a, b in zip(own, whole, strict=True))
