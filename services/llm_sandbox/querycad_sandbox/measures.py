"""Which attributes of the guest API does an object of the model have? The one place that knows what stands in for what.

Everything is SI: metres, m2, m3, in the frame of the file. A measure that an object lacks is not in its mapping.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final

from querycad_contracts import Body, Bottom, Face, Outline, Part, PartKind, Shape, Vector

Measures = dict[str, Any]
"""Attribute of the guest API -> value: str, bool, int, float, a Vector, or a list of these."""

_ACROSS: Final = 1e-3
"""A direction this near to right angles to another one is across it, as a cosine: below any draft."""


@dataclass(frozen=True, slots=True)
class LocalFrame:
    """A point and three unit vectors at right angles, in the frame of the file. Metres."""

    origin: Vector
    x: Vector
    y: Vector
    z: Vector


@dataclass(frozen=True, slots=True)
class Opening:
    """Where a hole, pocket or slot meets the outside. Metres."""

    center: Vector
    normal: Vector
    outline: Outline


def part_measures(part: Part) -> Measures:
    """What does a program see of a part? Its `faces`, `frame` and `openings` come on demand.

    A hole, pocket or slot (what has an opening) has no depth but its own; what protrudes (what has a tip) no height
    but its own; for anything else depth and height are the extents along y and z, as the guest API says. What has no
    thickness of its own, and no opening, is as thick as its smallest dimension.
    """
    x, y, z = part.extents
    length, width, _ = part.local_size or (None, None, None)
    radius = part.radius if part.radius is not None or part.diameter is None else part.diameter / 2
    return _present(
        {
            "id": part.id,
            "kind": part.kind.value,
            "tags": list(part.tags),
            "label": part.label,
            "name": part.name,
            "sides": [side.value for side in part.sides],
            "center": part.center,
            "opening": part.opening,
            "tip": part.tip,
            "tips": list(part.tips) or (None if part.tip is None else [part.tip]),
            "extents": part.extents,
            "half_extents": _half(part.extents),
            "axis": part.axis,
            "normal": _first(part.normal, part.axis),
            "radius": radius,
            "diameter": _first(part.diameter, None if radius is None else 2 * radius),
            "radii": list(part.radii) or (None if radius is None else [radius]),
            "depth": _first(part.depth, y if part.opening is None else None),
            "height": _first(part.height, z if part.tip is None else None),
            "width": _first(part.width, x if part.kind == "body" else width),
            "length": _first(part.length, part.height if part.kind == "boss" else length),
            "nominal_length": part.nominal_length,
            "thickness": _first(part.thickness, min(part.local_size or part.extents) if part.opening is None else None),
            "local_size": part.local_size,
            "bottom": part.bottom and part.bottom.value,
            "pitch": part.pitch,
            "count": part.count,
            "angle": part.angle,
            "outer_diameter": part.outer_diameter,
            "inner_diameter": part.inner_diameter,
            "tube_diameter": part.tube_diameter,
            "across_flats": part.across_flats,
            "across_corners": part.across_corners,
            "center_length": part.center_length,
            "chamfer_size": part.chamfer_size,
            "draft": part.draft,
            "bend_radius": part.bend_radius,
            "bend_angle": part.bend_angle,
            "mouth_length": part.mouth_length,
            "mouth_width": part.mouth_width,
            "bottom_length": part.bottom_length,
            "bottom_width": part.bottom_width,
            "opening_area": part.opening_area,
            "bottom_thickness": part.bottom_thickness,
            "minimum_thickness": part.minimum_thickness,
            "wall_distance": part.wall_distance,
            "inclination": part.inclination,
            "developed_length": part.developed_length,
            "volume": part.volume,
            "area": part.area,
            **_mass(part),
            "approach": list(part.approach) or None,
        }
    )


def face_measures(face: Face) -> Measures:
    """What does a program see of a face? Its `neighbours`, `part` and `frame` come on demand."""
    return _present(
        {
            "id": face.id,
            "kind": face.kind.value,
            "convexity": face.convexity.value,
            "center": face.center,
            "extents": face.extents,
            "area": face.area,
            "radius": face.radius,
            "normal": face.normal,
            "axis": face.axis,
            "axis_point": face.axis_point,
            "length": face.length,
            "outline": None if face.outline is None else face.outline.value,
            "local_size": face.local_size,
            "body": face.body,
        }
    )


def body_measures(body: Body) -> Measures:
    """What does a program see of a body?"""
    return _present(
        {
            "id": body.id,
            "name": body.name,
            "color": body.color,
            "is_solid": body.is_solid,
            "center": body.center,
            "extents": body.extents,
            "half_extents": _half(body.extents),
            "volume": body.volume,
            "area": body.area,
        }
    )


def shape_measures(shape: Shape) -> Measures:
    """What does a program see of the whole model? Its `bodies` are added by the caller, who wraps them."""
    width, depth, height = shape.extents
    (cx, cy, cz), (hx, hy, hz) = shape.center, _half(shape.extents)
    return _present(
        {
            "name": shape.name,
            "center": shape.center,
            "extents": shape.extents,
            "half_extents": (hx, hy, hz),
            "min_corner": (cx - hx, cy - hy, cz - hz),
            "max_corner": (cx + hx, cy + hy, cz + hz),
            "width": width,
            "depth": depth,
            "height": height,
            "volume": shape.volume,
            "area": shape.area,
            "thickness": shape.thickness,
            "minimum_thickness": shape.minimum_thickness,
            "face_count": shape.face_count,
            "edge_count": shape.edge_count,
            "up": None if shape.up is None else shape.up.value,
            "center_of_mass": shape.center_of_mass,
        }
    )


def _mass(one: Part) -> Measures:
    """What has a centre of mass is symmetric or not; what has none is no body."""
    planes, axes = list(one.mirror_planes), list(one.rotation_axes)
    whole = one.center_of_mass is not None or bool(planes) or bool(axes)
    return {
        "center_of_mass": one.center_of_mass,
        "inertia": None if one.inertia is None else list(one.inertia),
        "mirror_planes": planes if whole else None,
        "rotation_axes": axes if whole else None,
    }


def _half(extents: Vector) -> Vector:
    x, y, z = extents
    return (x / 2, y / 2, z / 2)


def _first(own: Any, otherwise: Any) -> Any:
    return otherwise if own is None else own


def _present(measures: Mapping[str, Any]) -> Measures:
    return {name: value for name, value in measures.items() if value is not None}


def frame_measures(frame: LocalFrame) -> dict[str, Any]:
    """What does a program see of a frame?"""
    return {"origin": frame.origin, "x": frame.x, "y": frame.y, "z": frame.z}


def opening_measures(opening: Opening) -> dict[str, Any]:
    """What does a program see of an opening?"""
    return {"center": opening.center, "normal": opening.normal, "outline": opening.outline.value}


def face_frame(face: Face) -> LocalFrame | None:
    """The frame of a plane face: z out of the material, x along its length. None for other faces."""
    if face.normal is None or face.along is None:
        return None
    return _frame(face.center, face.normal, face.along)


def part_frame(part: Part, faces: Sequence[Face]) -> LocalFrame | None:
    """The frame of a part made of these faces: z along its axis or normal, x along its longest plane face across z.

    A part without such a face is round about z: any direction across does. None for a part without axis and normal.
    """
    z = part.axis or part.normal
    if z is None:
        return None
    across = [face for face in faces if face.along is not None and face.length and abs(_dot(face.along, z)) < _ACROSS]
    longest = max(across, key=lambda face: face.length or 0.0, default=None)
    helper: Vector = (1.0, 0.0, 0.0) if abs(z[0]) < 0.7 else (0.0, 1.0, 0.0)
    return _frame(part.center, z, longest.along if longest is not None and longest.along is not None else helper)


def openings_of(part: Part) -> list[Opening]:
    """The openings of what is cut in: where it begins and, of what goes through, where it ends."""
    if part.opening is None or part.normal is None:
        return []
    outline = _outline(part)
    found = [Opening(part.opening, part.normal, outline)]
    if part.bottom is Bottom.THROUGH and part.depth is not None:
        x, y, z = (c - part.depth * n for c, n in zip(part.opening, part.normal, strict=True))
        a, b, c = part.normal
        found.append(Opening((x, y, z), (-a, -b, -c), outline))
    return found


def _outline(part: Part) -> Outline:
    named = {"circular": Outline.CIRCLE, "rectangular": Outline.RECTANGLE, "obround": Outline.SLOT}
    told = [outline for tag, outline in named.items() if tag in part.tags]
    if len(told) == 1:
        return told[0]
    return Outline.CIRCLE if part.kind is PartKind.HOLE else Outline.FREE


def _frame(origin: Vector, z: Vector, toward: Vector) -> LocalFrame:
    along = _dot(toward, z)
    x = _unit((toward[0] - along * z[0], toward[1] - along * z[1], toward[2] - along * z[2]))
    y = (z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0])
    return LocalFrame(origin, x, y, z)


def _dot(a: Vector, b: Vector) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _unit(a: Vector) -> Vector:
    length = math.hypot(*a)
    return (a[0] / length, a[1] / length, a[2] / length)
