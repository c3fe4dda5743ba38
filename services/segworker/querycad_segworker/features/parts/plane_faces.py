"""The plane faces of a model as such, whatever features they belong to: direction, outline, length, width, area."""

from __future__ import annotations

import math

from querycad_contracts import Part, SurfaceKind
from querycad_segworker.features.shared.frames import frame_of_edges, outline_of
from querycad_segworker.features.shared.part_measures import geometry, millimetres, outlined
from querycad_segworker.tolerances import Tolerances
from querycad_segworker.topology import Brep, EdgeKind, FaceRecord
from querycad_segworker.vectors import box_center, box_extents

UPRIGHT = 0.05
"""Sine of the angle by which an upright or lying face may lean: 3 degrees."""
MOST_FACES = 2000
"""Nobody asks for one face of so many; lists of parts stay short."""


def plane_face_parts(brep: Brep, tolerances: Tolerances) -> list[Part]:
    """Which plane faces does the model have? By face id; none where there are more than anybody would ask about."""
    planes = [face for face in brep.faces if face.kind is SurfaceKind.PLANE and face.loops]
    if len(planes) > MOST_FACES:
        return []
    return [_part(brep, face, number, tolerances) for number, face in enumerate(planes, start=1)]


def _part(brep: Brep, face: FaceRecord, number: int, tolerances: Tolerances) -> Part:
    rim = face.loops[0]
    outline, _ = outline_of(brep, rim, tolerances)
    frame = frame_of_edges(brep, set(rim.edges), face.axis, None)
    length, width, _ = frame.size
    first = brep.edges[rim.edges[0]]
    round_rim = outline == "circular" and first.kind is EdgeKind.CIRCLE and first.radius is not None
    diameter = 2 * first.radius if round_rim and first.radius is not None else None
    rise = abs(face.axis[2])
    place = "lying" if rise > 1 - UPRIGHT**2 else "upright" if rise < UPRIGHT else "inclined"
    size = " x ".join(millimetres(v).removesuffix(" mm") for v in (length, width))
    return Part(
        id=f"face-{number}",
        kind="face",
        tags=("planar", outline, place),
        label=f"plane face, {outlined(outline, 'outline')}, {size} mm",
        faces=(face.id,),
        center=box_center(face.box),
        extents=box_extents(face.box),
        normal=face.axis,
        diameter=diameter,
        length=length,
        width=width,
        local_size=(length, width, 0.0),
        area=face.area,
        inclination=math.atan2(math.hypot(face.axis[0], face.axis[1]), rise),
        evidence=geometry("a plane face"),
    )
