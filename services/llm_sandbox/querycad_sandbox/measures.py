"""Which attributes of the guest API does an object of the model have? The one place that knows what stands in for what.

Everything is SI: metres, m2, m3, in the frame of the file. A measure that an object lacks is not in its mapping.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final

from querycad_contracts import Body, Bottom, Face, Outline, Part, PartKind, Shape, Vector
from querycad_contracts.vectors import add, cross, dot, sub

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


_OF_PART: Final = (
    "id", "label", "name", "color", "center", "opening", "tip", "extents", "axis", "nominal_length", "local_size",
    "pitch", "count", "outer_diameter", "inner_diameter", "tube_diameter", "across_flats", "across_corners",
    "center_length", "chamfer_size", "draft", "bend_angle", "mouth_length", "mouth_width",
    "bottom_length", "bottom_width", "opening_area", "bottom_thickness", "minimum_thickness", "wall_distance",
    "inclination", "developed_length", "volume", "area",
)  # fmt: skip
"""What a program sees as the contract has it; and so of a face, a body and the whole model."""
_OF_FACE: Final = (
    "id", "center", "extents", "area", "radius", "normal", "axis", "axis_point", "length", "local_size", "body",
)  # fmt: skip
_OF_BODY: Final = ("id", "name", "color", "is_solid", "center", "extents", "volume", "area")
_OF_SHAPE: Final = (
    "name", "center", "extents", "volume", "area", "thickness", "minimum_thickness", "face_count", "edge_count",
    "center_of_mass",
)  # fmt: skip


def part_measures(part: Part) -> Measures:
    """What does a program see of a part? Its `faces`, `frame` and `openings` come on demand.

    A hole, pocket or slot (what has an opening) has no depth but its own; what protrudes (what has a tip) no height
    but its own; for anything else depth and height are the extents along y and z, as the guest API says. What has no
    thickness of its own, and no opening, is as thick as its smallest dimension. The full angle of what is conical is
    twice its draft.
    """
    x, y, z = part.extents
    length, width, _ = part.local_size or (None, None, None)
    radius = part.radius if part.radius is not None or part.diameter is None else part.diameter / 2
    return _present(
        part,
        _OF_PART,
        {
            "kind": part.kind.value,
            "bottom": part.bottom and part.bottom.value,
            "tags": list(part.tags),
            "sides": [side.value for side in part.sides],
            "tips": list(part.tips) or (None if part.tip is None else [part.tip]),
            "half_extents": _half(part.extents),
            "normal": _first(part.normal, part.axis),
            "radius": radius,
            "diameter": _first(part.diameter, None if radius is None else 2 * radius),
            "radii": list(part.radii) or (None if radius is None else [radius]),
            "depth": _first(part.depth, y if part.opening is None else None),
            "height": _first(part.height, z if part.tip is None else None),
            "width": _first(part.width, x if part.kind == "body" else width),
            "length": _first(part.length, part.height if part.kind == "boss" else length),
            "thickness": _first(part.thickness, min(part.local_size or part.extents) if part.opening is None else None),
            "angle": _first(part.angle, 2 * part.draft if part.draft and "conical" in part.tags else None),
            "bend_radius": _first(part.bend_radius, _middle_radius(part)),
            **_mass(part),
            "approach": list(part.approach) or None,
        },
    )


def face_measures(face: Face) -> Measures:
    """What does a program see of a face? Its `neighbours`, `part` and `frame` come on demand."""
    words = {
        "kind": face.kind.value,
        "convexity": face.convexity.value,
        "outline": None if face.outline is None else face.outline.value,
    }
    return _present(face, _OF_FACE, words)


def body_measures(body: Body) -> Measures:
    """What does a program see of a body?"""
    return _present(body, _OF_BODY, {"half_extents": _half(body.extents)})


def shape_measures(shape: Shape) -> Measures:
    """What does a program see of the whole model? Its `bodies` are added by the caller, who wraps them."""
    width, depth, height = shape.extents
    half = _half(shape.extents)
    return _present(
        shape,
        _OF_SHAPE,
        {
            "half_extents": half,
            "min_corner": sub(shape.center, half),
            "max_corner": add(shape.center, half),
            "width": width,
            "depth": depth,
            "height": height,
            "up": None if shape.up is None else shape.up.value,
        },
    )


def _middle_radius(part: Part) -> float | None:
    """Of what is cut along an arc: the radius of its middle line, the arc between its ends' centres by its angle."""
    if "curved" not in part.tags or not part.kind.cuts_in or not part.center_length or not part.angle:
        return None
    return part.center_length / part.angle


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


def _present(value: Part | Face | Body | Shape, names: Sequence[str], others: Measures) -> Measures:
    """The measures of these names as they are, and the others; those that are there."""
    measures = {name: getattr(value, name) for name in names} | others
    return {name: measure for name, measure in measures.items() if measure is not None}


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
    across = [face for face in faces if face.along is not None and face.length and abs(dot(face.along, z)) < _ACROSS]
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
    along = dot(toward, z)
    x = _unit((toward[0] - along * z[0], toward[1] - along * z[1], toward[2] - along * z[2]))
    return LocalFrame(origin, x, cross(z, x), z)


def _unit(a: Vector) -> Vector:
    length = math.hypot(*a)
    return (a[0] / length, a[1] / length, a[2] / length)
