"""Everything that geometry says about a model: its shape and every part that recognition knows."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeVar

from querycad_contracts import Face, Part, Shape, SurfaceKind
from querycad_segworker.tolerances import Tolerances
from querycad_segworker.topology import Brep
from querycad_segworker.vectors import box_center, box_extents, dist

from .blends import recognise_blends
from .bodies import body, body_part, model_part
from .bosses import recognise_bosses
from .depressions import recognise_depressions
from .gears import recognise_gears
from .grooves import recognise_turned_grooves
from .holes import IsClear, recognise_holes
from .parts import (
    arc_part,
    blend_part,
    boss_part,
    cylinder_part,
    depression_part,
    gear_part,
    hole_part,
    prism_part,
    protrusion_part,
    rib_part,
    tooth_parts,
    turned_groove_part,
)
from .prisms import recognise_prisms
from .protrusions import recognise_protrusions
from .relations import with_relations
from .ribs import fins, recognise_ribs
from .walls import walls

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Recognised:
    """The whole shape, and its parts without the sides they are visible from."""

    shape: Shape
    parts: tuple[Part, ...]


def recognise(brep: Brep, is_clear: IsClear, thickness_m: float | None = None) -> Recognised:
    """Which parts does the model have? `is_clear` tells whether a straight way is free of material."""
    tolerances = Tolerances.for_diagonal(dist(*brep.box))
    found_walls = walls(brep, tolerances)
    holes = recognise_holes(brep, found_walls, tolerances, is_clear)
    bosses = recognise_bosses(brep, found_walls, holes, tolerances)
    hole_parts = _numbered(holes, lambda hole, n: hole_part(brep, hole, n))
    round_faces = {face for hole in holes for face in hole.faces} | {face for boss in bosses for face in boss.faces}
    hole_faces = {face for hole in holes for face in hole.faces}
    blends = recognise_blends(brep, round_faces, tolerances)
    blend_faces = {face for blend in blends for face in blend.faces}
    ribs = recognise_ribs(brep)
    gears = recognise_gears(brep, found_walls, tolerances)
    fin_indices = fins(ribs, tolerances)
    depressions = recognise_depressions(brep, hole_faces, tolerances, is_clear)
    parts = [
        *hole_parts,
        *_numbered(bosses, lambda boss, n: boss_part(brep, boss, n, hole_parts)),
        *_numbered(
            recognise_turned_grooves(brep, found_walls, tolerances), lambda g, n: turned_groove_part(brep, g, n)
        ),
        *_numbered(depressions, lambda found, n: depression_part(brep, found, n)),
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
        *_numbered(gears, lambda gear, n: gear_part(brep, gear, n)),
        *(tooth for n, gear in enumerate(gears, start=1) for tooth in tooth_parts(brep, gear, n)),
        *_numbered(brep.bodies, lambda record, n: body_part(brep, record, n, tolerances, bosses, holes)),
    ]
    shape = _shape(brep, thickness_m)
    parts.append(model_part(brep, shape))
    return Recognised(shape, tuple(with_relations(parts, shape)))


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
