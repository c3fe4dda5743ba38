"""Everything that geometry says about a model: its shape and every part that recognition knows."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeVar

from querycad_contracts import Face, Part, Shape, SurfaceKind
from querycad_segworker.mesh import Mesh
from querycad_segworker.tolerances import Tolerances
from querycad_segworker.topology import Brep
from querycad_segworker.vectors import box_center, box_extents, dist

from .blends import recognise_blends
from .block_parts import gear_part, prism_part, protrusion_part, tooth_parts
from .bodies import body, body_part, model_part
from .bosses import Boss, recognise_bosses
from .clevises import recognise_clevises
from .depression_parts import blend_part, depression_part, turned_groove_part
from .depressions import recognise_depressions
from .dimples import recognise_dimples
from .forks import IsClear
from .gears import recognise_gears
from .grooves import recognise_turned_grooves
from .hole import Hole
from .hole_parts import dimple_part, hole_part, hole_section_parts, pattern_part
from .holes import recognise_holes
from .parts import rib_part
from .patterns import recognise_patterns
from .prisms import recognise_prisms
from .protrusions import recognise_protrusions
from .relations import with_relations
from .ribs import fins, recognise_ribs
from .round_parts import arc_part, boss_break_parts, boss_part, cylinder_part, surface_parts
from .volumes import Volumes
from .walls import walls

T = TypeVar("T")
PATTERNED = frozenset(("hole", "cutout", "pocket", "slot", "dimple"))
"""Kinds that are laid out in patterns."""


@dataclass(frozen=True, slots=True)
class Recognised:
    """The whole shape, and its parts without the sides they are visible from."""

    shape: Shape
    parts: tuple[Part, ...]


def recognise(brep: Brep, is_clear: IsClear, thickness_m: float | None = None, mesh: Mesh | None = None) -> Recognised:
    """Which parts does the model have? `is_clear` tells whether a straight way is free of material.

    Without the `mesh`, depressions with curved floors have no volume.
    """
    tolerances = Tolerances.for_diagonal(dist(*brep.box))
    found_walls = walls(brep, tolerances)
    holes = recognise_holes(brep, found_walls, tolerances, is_clear)
    bosses = recognise_bosses(brep, found_walls, holes, tolerances)
    hole_parts = _numbered(holes, lambda hole, n: hole_part(brep, hole, n))
    round_faces = {face for hole in holes for face in hole.faces} | {face for boss in bosses for face in boss.faces}
    hole_faces = {face for hole in holes for face in hole.faces}
    blends = recognise_blends(brep, round_faces, tolerances)
    blend_faces = {face for blend in blends for face in blend.faces}
    ribs = recognise_ribs(brep, tolerances)
    gears = recognise_gears(brep, found_walls, tolerances)
    fin_indices = fins(ribs, tolerances)
    depressions = recognise_depressions(brep, hole_faces, tolerances, is_clear, found_walls)
    depressions += recognise_clevises(brep, ribs, depressions, is_clear)
    volumes = Volumes(brep, mesh)
    # Gaps between teeth and turns of a thread are no slots and grooves of their own.
    toothed = [frozenset(gear.faces) for gear in gears]
    depressions = [found for found in depressions if not any(faces.issuperset(found.faces) for faces in toothed)]
    threads = [frozenset(hole.faces) for hole in holes if "threaded" in hole.tags]
    grooves = recognise_turned_grooves(brep, found_walls, tolerances)
    grooves = [found for found in grooves if not any(faces.issuperset(found.faces) for faces in threads)]
    parts = [
        *hole_parts,
        *(part for n, hole in enumerate(holes, start=1) for part in hole_section_parts(brep, hole, n)),
        *_numbered(recognise_dimples(brep, hole_faces), lambda dimple, n: dimple_part(brep, dimple, n)),
        *_numbered(bosses, lambda boss, n: boss_part(brep, boss, n, hole_parts)),
        *(part for n, boss in enumerate(bosses, start=1) for part in boss_break_parts(brep, boss, n)),
        *_numbered(grooves, lambda found, n: turned_groove_part(brep, found, n)),
        *_numbered(depressions, lambda found, n: depression_part(brep, found, n, volumes)),
        *_numbered(recognise_protrusions(brep, round_faces, tolerances), lambda p, n: protrusion_part(brep, p, n)),
        *_numbered(recognise_prisms(brep), lambda prism, n: prism_part(brep, prism, n)),
        *_numbered(ribs, lambda rib, n: rib_part(brep, rib, n, n - 1 in fin_indices)),
        *_numbered(blends, lambda blend, n: blend_part(brep, blend, n)),
        *_numbered(
            [w for w in found_walls if w.kind is SurfaceKind.CYLINDER and w.encloses],
            lambda wall, n: cylinder_part(brep, wall, n),
        ),
        *_numbered(
            [
                w
                for w in found_walls
                if w.kind is SurfaceKind.CYLINDER and not w.encloses and not blend_faces.issuperset(w.faces)
            ],
            lambda wall, n: arc_part(brep, wall, n),
        ),
        *surface_parts(brep, found_walls),
        *_numbered(gears, lambda gear, n: gear_part(brep, gear, n)),
        *(tooth for n, gear in enumerate(gears, start=1) for tooth in tooth_parts(brep, gear, n)),
        *_bodies(brep, bosses, holes, tolerances),
    ]
    shape = _shape(brep, thickness_m)
    parts.append(model_part(brep, shape))
    parts.extend(_patterns(brep, parts))
    return Recognised(shape, tuple(with_relations(parts, shape, brep)))


def _bodies(brep: Brep, bosses: Sequence[Boss], holes: Sequence[Hole], tolerances: Tolerances) -> list[Part]:
    own_bosses: dict[int, list[Boss]] = defaultdict(list)
    own_holes: dict[int, list[Hole]] = defaultdict(list)
    for boss in bosses:
        own_bosses[boss.body].append(boss)
    for hole in holes:
        own_holes[hole.body].append(hole)
    return _numbered(
        brep.bodies, lambda body, n: body_part(brep, body, n, tolerances, own_bosses[body.id], own_holes[body.id])
    )


def _patterns(brep: Brep, parts: Sequence[Part]) -> list[Part]:
    """Patterns of what is cut in and of what stands out, around whatever is round."""
    members = [part for part in parts if part.kind in PATTERNED or (part.kind == "boss" and "raised" in part.tags)]
    centers = [part for part in parts if part.kind in ("hole", "boss", "body")]
    bodies = [brep.faces[part.faces[0]].body for part in members]
    found = recognise_patterns(members, bodies, centers)
    return _numbered(found, lambda pattern, n: pattern_part(pattern, n, [members[i] for i in pattern.members]))


def _numbered(records: Sequence[T], make: Callable[[T, int], Part]) -> list[Part]:
    return [make(record, number) for number, record in enumerate(records, start=1)]


def _shape(brep: Brep, thickness_m: float | None) -> Shape:
    return Shape(
        name=brep.name,
        center=box_center(brep.box),
        extents=box_extents(brep.box),
        volume=sum(record.volume for record in brep.bodies),
        area=sum(record.area for record in brep.bodies),
        thickness=thickness_m,
        bodies=tuple(body(brep, record) for record in brep.bodies),
        face_count=len(brep.faces),
    )


def faces_of(brep: Brep) -> list[Face]:
    """The faces as users and generated code see them, in order of their ids."""
    faces = []
    for record in brep.faces:
        revolved = record.kind in (SurfaceKind.CYLINDER, SurfaceKind.CONE, SurfaceKind.TORUS)
        radius = record.minor_radius if record.kind is SurfaceKind.TORUS else record.radius
        faces.append(
            Face(
                id=record.id,
                body=record.body,
                kind=record.kind,
                center=box_center(record.box),
                extents=box_extents(record.box),
                area=record.area,
                convexity=record.convexity,
                radius=radius if revolved or record.kind is SurfaceKind.SPHERE else None,
                normal=record.axis if record.kind is SurfaceKind.PLANE else None,
                axis=record.axis if revolved else None,
            )
        )
    return faces
