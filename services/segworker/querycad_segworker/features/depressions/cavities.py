"""Cavities: closed voids inside a solid, which no opening leads to."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import replace

from querycad_contracts import SurfaceKind, Vector
from querycad_segworker.features.shared.frames import LocalFrame, frame_of
from querycad_segworker.features.shared.part_measures import faces_box
from querycad_segworker.topology import BodyRecord, Brep, parted
from querycad_segworker.vectors import Box

from .depression import Depression, DepressionKind, depression_in

UP: Vector = (0.0, 0.0, 1.0)


def recognise_cavities(brep: Brep) -> list[Depression]:
    """Which voids do the model's solids enclose? Sorted by lowest face id.

    The faces of a solid hang together by shared edges, but for those of its voids, each of which lies inside the
    box of the outermost ones.
    """
    found: list[Depression] = []
    for body in brep.bodies:
        if not body.is_solid:
            continue
        shells = [(shell, faces_box(brep, shell)) for shell in _shells(brep, body)]
        outer = max(shells, key=lambda shell: _size(shell[1]))
        found.extend(_cavity(brep, shell, body.id) for shell, box in shells if _inside(box, outer[1]))
    return sorted(found, key=lambda cavity: cavity.faces[0])


def _shells(brep: Brep, body: BodyRecord) -> Iterator[set[int]]:
    """Faces of a body that hang together by shared edges."""
    links = {face: [other for _, other in brep.neighbours(face)] for face in body.faces}
    return parted(body.faces, lambda face: links.get(face, ()))


def _cavity(brep: Brep, shell: Collection[int], body: int) -> Depression:
    """Its length, width and depth are those of its box; upright walls turn that box, as those of a room do."""
    frame = _upright_frame(brep, shell)
    kinds = {brep.faces[face].kind for face in shell}
    sphere = kinds == {SurfaceKind.SPHERE}
    outline = "spherical" if sphere else "rectangular" if kinds == {SurfaceKind.PLANE} and len(shell) == 6 else "free"
    found = depression_in(DepressionKind.CAVITY, outline, frame, shell, (), body)
    return replace(found, corner_radius=brep.faces[min(shell)].radius if sphere else None)


def _upright_frame(brep: Brep, shell: Collection[int]) -> LocalFrame:
    low, high = faces_box(brep, shell)
    planes = brep.of_kind(SurfaceKind.PLANE, shell)
    if planes:
        largest = max(face.area for face in planes)
        floor = max(planes, key=lambda face: (round(face.area / largest, 3), face.axis[2]))
        return frame_of(brep, shell, floor.axis, None)
    size = (high[0] - low[0], high[1] - low[1], high[2] - low[2])
    return LocalFrame((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), UP, low, size)


def _size(box: Box) -> float:
    return sum((b - a) ** 2 for a, b in zip(*box, strict=True))


def _inside(box: Box, other: Box) -> bool:
    return all(a > c and b < d for a, b, c, d in zip(box[0], box[1], other[0], other[1], strict=True))
