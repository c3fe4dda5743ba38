"""The plane faces of a model as such, whatever features they belong to: direction, outline, length, width, area.

Flats on round shafts and in D-shaped bores have the depth that they are milled to.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from querycad_contracts import Part, SurfaceKind, Vector
from querycad_segworker.features.shared.frames import frame_of_edges, outline_of
from querycad_segworker.features.shared.part_measures import geometry, inclination, millimetres, outlined, stance
from querycad_segworker.features.shared.regular import UPRIGHT, depth_of_flat
from querycad_segworker.tolerances import FACING, Tolerances
from querycad_segworker.topology import Brep, EdgeKind, EdgeRecord, FaceRecord
from querycad_segworker.vectors import box_center, box_extents, dist, dot, sub

MOST_FACES = 2000
"""Nobody asks for one face of so many; lists of parts stay short."""


def plane_face_parts(brep: Brep, parts: Iterable[Part], tolerances: Tolerances) -> list[Part]:
    """Which plane faces does the model have? By face id; none where there are more than anybody would ask about.

    The sides of the regular ones among `parts`, as hexagons, are flats as those on shafts are.
    """
    planes = [face for face in brep.faces if face.kind is SurfaceKind.PLANE and face.loops]
    if len(planes) > MOST_FACES:
        return []
    regular = [part for part in parts if part.across_corners]
    sides = {i for part in regular if part.normal for i in _upright(brep, part.faces, part.normal)}
    found = [_part(brep, face, number, face.id in sides, tolerances) for number, face in enumerate(planes, start=1)]
    across = _across({part.id: face for part, face in zip(found, planes, strict=True) if "milled" in part.tags})
    return [part.model_copy(update={"across_flats": across.get(part.id)}) for part in found]


def _across(flats: Mapping[str, FaceRecord]) -> dict[str, float]:
    """How far is it over each flat to the nearest one that looks the other way, in metres?"""
    found = dict[str, float]()
    for name, one in flats.items():
        opposed = (o for o in flats.values() if o.body == one.body and dot(o.axis, one.axis) < -FACING.parallel)
        gaps = [gap for other in opposed if (gap := dot(sub(one.point, other.point), one.axis)) > 0]
        found |= {name: min(gaps)} if gaps else {}
    return found


def _upright(brep: Brep, faces: Iterable[int], normal: Vector) -> list[int]:
    return [i for i in faces if abs(dot(brep.faces[i].axis, normal)) < UPRIGHT]


def _part(brep: Brep, face: FaceRecord, number: int, is_side: bool, tolerances: Tolerances) -> Part:
    rim = face.loops[0]
    outline, _ = outline_of(brep, rim, tolerances)
    frame = frame_of_edges(brep, set(rim.edges), face.axis, None)
    length, width, _ = frame.size
    first = brep.edges[rim.edges[0]]
    round_rim = outline == "circular" and first.kind is EdgeKind.CIRCLE and first.radius is not None
    diameter = 2 * first.radius if round_rim and first.radius is not None else None
    bores = [brep.edges[loop.edges[0]] for loop in face.loops[1:]]
    inner = [edge.radius for edge in bores if edge.radius and edge.center and _on_one_axis(edge, first, tolerances)]
    bore = 2 * max(inner) if diameter is not None and inner else None
    cut = depth_of_flat(brep, face)
    return Part(
        id=f"face-{number}",
        kind="face",
        tags=("planar", outline, stance(face.axis), *(("milled",) if is_side or cut is not None else ())),
        label=f"plane face, {outlined(outline, 'outline')}, {millimetres(length, width)}",
        faces=(face.id,),
        center=box_center(face.box),
        extents=box_extents(face.box),
        normal=face.axis,
        depth=cut,
        diameter=diameter,
        outer_diameter=diameter,
        inner_diameter=bore,
        length=length,
        width=width,
        local_size=(length, width, 0.0),
        area=face.area,
        inclination=inclination(face.axis),
        evidence=geometry("a plane face"),
    )


def _on_one_axis(bore: EdgeRecord, rim: EdgeRecord, tolerances: Tolerances) -> bool:
    """Is it a circle about the middle of the rim: are both the edges of a ring?"""
    if bore.kind is not EdgeKind.CIRCLE or rim.kind is not EdgeKind.CIRCLE or bore.center is None or rim.center is None:
        return False
    return dist(bore.center, rim.center) < 3 * tolerances.length
