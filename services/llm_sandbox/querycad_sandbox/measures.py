"""Which attributes of the guest API does an object of the model have? The one place that knows what stands in for what.

Everything is SI: metres, m2, m3, in the frame of the file. A measure that an object lacks is not in its mapping.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from querycad_contracts import Body, Face, Part, Shape, Vector

Measures = dict[str, Any]
"""Attribute of the guest API -> value: str, bool, int, float, a Vector, or a list of these."""


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
            "thickness": _first(part.thickness, min(part.local_size or part.extents) if part.opening is None else None),
            "local_size": part.local_size,
            "bottom": part.bottom,
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
            "volume": part.volume,
            "area": part.area,
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
            "face_count": shape.face_count,
            "edge_count": shape.edge_count,
            "up": None if shape.up is None else shape.up.value,
        }
    )


def _half(extents: Vector) -> Vector:
    x, y, z = extents
    return (x / 2, y / 2, z / 2)


def _first(own: Any, otherwise: Any) -> Any:
    return otherwise if own is None else own


def _present(measures: Mapping[str, Any]) -> Measures:
    return {name: value for name, value in measures.items() if value is not None}
