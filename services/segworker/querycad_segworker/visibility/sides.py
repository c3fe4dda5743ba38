"""From which sides is a part visible?"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from querycad_contracts import Bottom, Part, PartKind, Side, SurfaceKind, Vector
from querycad_segworker.mesh import Mesh
from querycad_segworker.tolerances import FACING
from querycad_segworker.topology import Brep, EdgeConvexity
from querycad_segworker.vectors import around, dot, scale, sub

from .faces import FaceVisibility
from .raycast import Scene

SEEN_SHARE = 0.03
"""A face counts as seen when its visible projected area is more than this share of its area. The views are turned by
one degree, so that faces seen edge-on show sin(1 degree) = 1.7 % of themselves."""
FACING_SHARE = 0.2
"""A plane face that is turned to the viewer counts as seen when this share of it is: one degree of azimuth lets so much
of what stands exactly behind something else peep out, eleven times its own width away."""
GLIMPSE_SHARE = 0.05
"""Of what stands out, so much of what its faces would show if nothing stood before them: less is a glimpse through the
holes of something else. The end of a shaft that sticks out of a housing shows more."""
OPENING_SHARE = 0.25
"""An opening counts as seen when at least this share of the points spread over it is."""
OPENING_ANGLE_RAD = math.radians(75.0)
"""An opening turned away by more than this shows less than a quarter of its area."""
TOLD_APART = 0.5
"""A hole narrower than this share of the one that it is seen through is a hole of its own to anybody who looks."""
_ROUND = frozenset((PartKind.BOSS, PartKind.CYLINDER, PartKind.CONE, PartKind.ARC, PartKind.GEAR))
_RUNNING_OUT = frozenset((PartKind.SLOT, PartKind.CHANNEL, PartKind.STEP, PartKind.NOTCH))
_SQUARE = 0.99
_NEAR = 0.05
"""Of the radius: holes that lie on one axis, or begin in one plane."""

_Opening = tuple[int, Vector, Vector, list[Vector]]


def with_sides(parts: Sequence[Part], brep: Brep, scene: Scene, visibility: FaceVisibility) -> list[Part]:
    """The same parts, each with the sides it is visible from.

    What has an opening is visible where one looks into that opening; anything else, and what is open at a border,
    where its faces own pixels; a slot cut through from an edge both ways. A tube or standoff is visible as well where
    one looks into its bore from its tip.
    """
    visible_m2 = visibility.pixels * (visibility.pixel_m**2)[:, None]
    free_m2 = projected_areas(scene.mesh, len(brep.faces))
    seen_faces = faces_seen([face.area for face in brep.faces], visibility) & ~_peeping(brep, visibility)
    openings = _openings(parts)
    points = [p for _, _, normal, disc in openings for p in disc]
    normals = [normal for _, _, normal, disc in openings for _ in disc]
    seen = scene.sees(points, normals) if points else np.zeros((len(Side), 0), dtype=np.bool_)
    opening_sides: dict[int, set[Side]] = {}
    start = 0
    for (index, _, normal, disc), behind in zip(openings, _behind(openings, parts), strict=True):
        share = (seen[:, start : start + len(disc)] & ~behind).mean(axis=1)
        start += len(disc)
        found = opening_sides.setdefault(index, set())
        for row, side in enumerate(Side):
            if share[row] >= OPENING_SHARE and dot(normal, side.outward) > math.cos(OPENING_ANGLE_RAD):
                found.add(side)
    hidden = [index for index, found in opening_sides.items() if not found and parts[index].kind != "hole"]
    for index, found in _over_floors([parts[i] for i in hidden], scene).items():
        opening_sides[hidden[index]] = found
    result = []
    for index, part in enumerate(parts):
        sides = opening_sides.get(index, set())
        if index not in opening_sides or _is_open(part):
            into = sides
            sides = {side for row, side in enumerate(Side) if bool(seen_faces[row, list(part.faces)].any())}
            ends = end_faces(part, brep)
            turned = [(face, brep.faces[face].axis) for face in ends]
            sides |= {side for row, side in enumerate(Side) for face, normal in turned
                      if seen_faces[row, face] and dot(normal, side.outward) > FACING.viewer}  # fmt: skip
            if part.kind == "arc" and part.axis is not None:  # through a curved wall: where that wall shows its mouth
                walls = _walls_around(part, brep)
                sides |= {side for row, side in enumerate(Side) if abs(dot(part.axis, side.outward)) > FACING.along_view
                          and any(seen_faces[row, wall] for wall in walls)}  # fmt: skip
            if part.kind.stands_out:
                faces = [*part.faces, *(ends - set(part.faces))]
                shown, free = (areas[:, faces].sum(axis=1) for areas in (visible_m2, free_m2))
                sides = {
                    side for row, side in enumerate(Side) if side in sides and shown[row] >= GLIMPSE_SHARE * free[row]
                }
            sides |= into
        result.append(part.model_copy(update={"sides": tuple(side for side in Side if side in sides)}))
    return _with_members(_with_bores(result))


def _over_floors(parts: Sequence[Part], scene: Scene) -> dict[int, set[Side]]:
    """From which sides does one look into openings whose middle is filled, as around a boss that stands out of them?

    Asked of points above the floor, at the level of the opening: by position in `parts`.
    """
    found: dict[int, set[Side]] = {}
    for index, part in enumerate(parts):
        if part.normal is None or part.opening is None:
            continue
        floor = scene.mesh.of_faces(np.array(part.faces))
        a, b, c = (floor.vertices_m[floor.triangles[:, i]] for i in range(3))
        normal, doubled = np.array(part.normal), np.cross(b - a, c - a)
        area = np.linalg.norm(doubled, axis=1) / 2
        lies = np.abs(doubled @ normal) > 2 * FACING.opposed * area
        if not lies.any():
            continue
        points = ((a + b + c) / 3)[lies]
        points += ((np.array(part.opening) - points) @ normal)[:, None] * normal
        seen = scene.sees(points, np.tile(normal, (len(points), 1)))
        share = seen @ area[lies] / area[lies].sum()
        found[index] = {
            side
            for row, side in enumerate(Side)
            if share[row] >= OPENING_SHARE and dot(part.normal, side.outward) > math.cos(OPENING_ANGLE_RAD)
        }
    return found


def _walls_around(part: Part, brep: Brep) -> set[int]:
    """The curved faces that the part meets in convex edges."""
    others = {i for f in part.faces for i in brep.beside(f, EdgeConvexity.CONVEX)} - set(part.faces)
    return {f for f in others if brep.faces[f].kind is not SurfaceKind.PLANE}


def end_faces(part: Part, brep: Brep) -> set[int]:
    """Which plane faces show a part end-on: the ends of a round one, those that a slot or step runs out at?

    They meet it in convex edges, square to the axis of its cylinders and cones, or to the opening of what is open.
    """
    found = set()
    for index in part.faces:
        face = brep.faces[index]
        axis = part.axis if part.kind == "gear" else face.axis
        round_face = face.kind in (SurfaceKind.CYLINDER, SurfaceKind.CONE) or part.kind == "gear"
        turned = round_face and part.kind in _ROUND and axis is not None
        if not turned and not (part.kind in _RUNNING_OUT and part.normal is not None):
            continue
        beside = set(brep.beside(index, EdgeConvexity.CONVEX)) - set(part.faces)
        for other in brep.of_kind(SurfaceKind.PLANE, beside):
            along = abs(dot(other.axis, (axis if turned else part.normal) or face.axis))
            if along > _SQUARE if turned else along < 1.0 - _SQUARE:
                found.add(other.id)
    return found


def _with_bores(parts: Sequence[Part]) -> list[Part]:
    """Hollow bosses, seen where one looks into their bores from the tip, too."""
    holes = {part.id: part for part in parts if part.kind == "hole"}
    result = []
    for part in parts:
        if part.kind == "boss" and "hollow" in part.tags and part.normal is not None and part.children:
            bore, normal = holes.get(part.children[0]), part.normal
            into = {s for s in (bore.sides if bore else ()) if dot(s.outward, normal) > math.cos(OPENING_ANGLE_RAD)}
            part = part.model_copy(update={"sides": tuple(s for s in Side if s in into or s in part.sides)})
        result.append(part)
    return result


def _with_members(parts: Sequence[Part]) -> list[Part]:
    """Patterns, which have no openings of their own, seen where all of their members are."""
    seen = {part.id: set(part.sides) for part in parts}
    result = []
    for part in parts:
        if part.kind == "pattern" and part.children:
            shared = set(Side).intersection(*(seen.get(child, set()) for child in part.children))
            part = part.model_copy(update={"sides": tuple(s for s in Side if s in shared or s in part.sides)})
        result.append(part)
    return result


def _peeping(brep: Brep, visibility: FaceVisibility) -> NDArray[np.bool_]:
    """Which plane faces are turned to a side and all but hidden by others? (6, F) bool, rows in the order of `Side`."""
    planes = [face.axis if face.kind is SurfaceKind.PLANE else (0.0, 0.0, 0.0) for face in brep.faces]
    towards = np.array([[dot(normal, side.outward) for normal in planes] for side in Side])
    visible_m2 = visibility.pixels * (visibility.pixel_m**2)[:, None]
    projected_m2 = towards * np.array([face.area for face in brep.faces])
    hidden: NDArray[np.bool_] = (towards > FACING.viewer) & (visible_m2 < FACING_SHARE * projected_m2)
    return hidden


def projected_areas(mesh: Mesh, face_count: int) -> NDArray[np.float64]:
    """How much would each face show from each side, with nothing before it? (6, F) float64, m2, rows as in `Side`."""
    a, b, c = (mesh.vertices_m[mesh.triangles[:, i]] for i in range(3))
    doubled = np.cross(b - a, c - a)
    towards = np.array([side.outward for side in Side]) @ doubled.T / 2
    return np.array([np.bincount(mesh.triangle_face, np.maximum(row, 0.0), face_count) for row in towards])


def faces_seen(areas_m2: Sequence[float], visibility: FaceVisibility) -> NDArray[np.bool_]:
    """Which faces are seen from which side? (6, F) bool, rows in the order of `Side`."""
    visible_m2 = visibility.pixels * (visibility.pixel_m**2)[:, None]
    seen: NDArray[np.bool_] = visible_m2 > SEEN_SHARE * np.maximum(areas_m2, 1e-30)
    return seen


def _behind(openings: Sequence[_Opening], parts: Sequence[Part]) -> list[NDArray[np.bool_]]:
    """Which points of each opening are seen through another hole on the same axis, which is the one that one sees?

    (N,) bool an opening; false for what is no hole. The eye takes holes in a row for one, as in plates that are screwed
    together or the walls of a housing; a hole less than half as wide as the one before it is told apart.
    """
    radii = np.array([(parts[i].radius or 0.0) if parts[i].kind == "hole" else 0.0 for i, *_ in openings])
    owners = np.array([i for i, *_ in openings])
    centers = np.array([center for _, center, _, _ in openings]).reshape(-1, 3)
    normals = np.array([normal for _, _, normal, _ in openings]).reshape(-1, 3)
    found = []
    for row, (_, _, _, disc) in enumerate(openings):
        hidden = np.zeros(len(disc), dtype=np.bool_)
        ahead = centers - centers[row]
        along = ahead @ normals[row]
        aside = np.linalg.norm(ahead - along[:, None] * normals[row], axis=1)
        before = (owners != owners[row]) & (normals @ normals[row] > FACING.parallel) & (aside < _NEAR * radii[row])
        before &= (along > _NEAR * radii[row]) & (radii > 0) & (radii[row] >= TOLD_APART * radii)
        for other in np.nonzero(before)[0]:
            offsets = np.asarray(disc) - centers[other]
            offsets -= (offsets @ normals[row])[:, None] * normals[row]
            hidden |= np.linalg.norm(offsets, axis=1) <= radii[other]
        found.append(hidden)
    return found


def _is_open(part: Part) -> bool:
    """Is it open at a border of what it is cut into, rather than closed in or between the walls of a fork?"""
    return "open" in part.tags and "fork" not in part.tags


def _openings(parts: Sequence[Part]) -> list[_Opening]:
    """(index of the part, centre, outward normal, points spread over the opening) for each opening of each part."""
    found = []
    for index, part in enumerate(parts):
        if part.opening is None or part.normal is None or (_is_open(part) and "through" not in part.tags):
            continue
        ends = [(part.opening, part.normal)]
        if part.bottom is Bottom.THROUGH:
            far = sub(scale(part.center, 2.0), part.opening)
            ends.append((far, scale(part.normal, -1.0)))
        reach = part.radius or min(part.width or 0.0, part.length or part.width or 0.0) / 2
        for center, normal in ends:
            found.append((index, center, normal, [center, *around(center, normal, 0.7 * reach, 6)]))
    return found
