"""Everything that geometry says about a model: its shape and every part that recognition knows."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Sequence, Set
from dataclasses import dataclass
from typing import Concatenate, ParamSpec, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from querycad_contracts import Part, PartKind, Refusal, Shape, SurfaceKind, Weighed
from querycad_segworker.mesh import Mesh
from querycad_segworker.tolerances import Tolerances, exceeds
from querycad_segworker.topology import Brep, EdgeConvexity
from querycad_segworker.vectors import box_center, box_extents, dist

from .assemblies.bearings import Bearing, recognise_bearings
from .assemblies.bodies import (
    bearing_part,
    body,
    body_part,
    mass_of,
    model_part,
    weighed,
    with_bearing_bores,
    with_bearing_roles,
    with_gear_measures,
    with_pipe_measures,
)
from .blends.fillets_chamfers import recognise_blends
from .depressions.clevises import recognise_clevises
from .depressions.depression import Depression, DepressionKind, with_open_ends
from .depressions.dimples import Dimple, recognise_dimples
from .depressions.outlets import recognise_outlets
from .depressions.recognise import recognise_depressions
from .faces import likely_up
from .holes.hole import Hole
from .holes.recognise import recognise_holes
from .parts.bent_arcs import bent_arc_part, recognise_bent_arcs
from .parts.depressions import blend_part, depression_part, turned_groove_part, without_corners_of_walls
from .parts.flat_walls import flat_wall_part, recognise_flat_walls
from .parts.holes import dimple_part, hole_part, hole_section_parts, pattern_part
from .parts.joined_holes import with_joined_counterbores
from .parts.material_left import with_material_left
from .parts.own_measures import with_own_measures
from .parts.patterns import recognise_patterns
from .parts.plane_faces import plane_face_parts
from .parts.protrusions import (
    arm_part,
    gear_part,
    hollow_section_part,
    knurl_part,
    ledge_parts,
    prism_part,
    protrusion_part,
    rib_part,
    tooth_parts,
)
from .parts.regions import region_parts
from .parts.relations import with_relations
from .parts.turned import arc_part, boss_break_parts, boss_part, cylinder_part, pipe_parts, surface_parts
from .parts.turned_pieces import crossbars
from .parts.volumes import Volumes
from .parts.walls_as_ribs import besides_fins, is_in_wall, sides_of_boxes, with_fins
from .parts.wheels import wheel_parts
from .protrusions.arms import Arm, recognise_arms, without_arms
from .protrusions.pads import recognise_pads
from .protrusions.prisms import Prism, recognise_prisms
from .protrusions.protrusions import Protrusion, recognise_protrusions
from .protrusions.ribs import Rib, fins, recognise_lugs, recognise_ribs
from .shared.clearance import Ahead, IsClear
from .shared.merged_faces import United, united
from .shared.refusals import gathering, left_refused, refuse
from .shared.walls import Wall, walls
from .sheet.body_thickness import with_body_thickness
from .sheet.hollow_sections import beside_sections, recognise_hollow_sections
from .sheet.material_thickness import NO_THICKNESS, Thickness
from .sheet.plates import recognise_plates, without_edgewise
from .turned.bosses import Boss, recognise_bosses
from .turned.gears import Gear, recognise_gears
from .turned.grooves import TurnedGroove, recognise_turned_grooves
from .turned.knurls import Knurl, recognise_knurls
from .turned.pipes import Pipe, beside_pipes, ending_in_bends, recognise_pipes
from .turned.round_bodies import TurnedBody, tips_of, turned_body, with_free_tips

T = TypeVar("T")
P = ParamSpec("P")
R = TypeVar("R", Boss, Hole, Gear)
SPIDER = 4
"""A face between so many sides of spokes, those of two, is that of a spider, which is no plate."""
PATTERNED = frozenset((PartKind.HOLE, PartKind.CUTOUT, PartKind.POCKET, PartKind.SLOT, PartKind.DIMPLE))
"""Kinds that are laid out in patterns."""


@dataclass(frozen=True, slots=True)
class Recognised:
    """The whole shape, and its parts without the sides they are visible from."""

    shape: Shape
    parts: tuple[Part, ...]
    refused: tuple[Refusal, ...] = ()
    """What looked like a part, and why it is none."""


def recognise(
    brep: Brep,
    is_clear: IsClear,
    thickness: Thickness = NO_THICKNESS,
    mesh: Mesh | None = None,
    ahead: Ahead | None = None,
) -> Recognised:
    """Which parts does the model have? `is_clear` tells whether a straight way is free of material.

    `thickness`: of the walls of the model and its bodies, where they have one. Without the `mesh`, depressions with
    curved floors have no volume. `ahead` tells what a ray meets; without it no part says how much material is left.
    """
    tolerances = Tolerances.for_diagonal(dist(*brep.box))
    whole = united(brep, tolerances)
    shape = _shape(brep, thickness, brep if whole is None else whole.brep)
    with gathering() as refused:
        if whole is None:
            parts = _parts(brep, shape, tolerances, is_clear, Volumes(brep, mesh), thickness)
            parts = with_material_left(parts, brep, mesh, ahead)
        else:
            own = None if mesh is None else mesh.renumbered(whole.owner)
            parts = _parts(
                whole.brep, shape, tolerances, is_clear, Volumes(whole.brep, own), thickness.renumbered(whole.owner)
            )
            parts = with_material_left(parts, whole.brep, own, None if ahead is None else _renumbered(ahead, whole))
    left = left_refused(refused, parts)
    if whole is not None:
        parts = [part.model_copy(update={"faces": whole.faces_of_file(part.faces)}) for part in parts]
        left = tuple(one.model_copy(update={"faces": whole.faces_of_file(one.faces)}) for one in left)
    return Recognised(shape, tuple(parts), left)


def _renumbered(ahead: Ahead, whole: United) -> Ahead:
    """The same of the model whose pieces of faces were put together."""
    owner = np.array([*whole.owner, -1], dtype=np.int32)  # -1, nothing, stays

    def renumbered(points_m: ArrayLike, directions: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
        distances, faces = ahead(points_m, directions)
        return distances, owner[faces]

    return renumbered


@dataclass(frozen=True, slots=True)
class _Round:
    """What is round: the walls of the model about axes, and what they make."""

    walls: list[Wall]
    holes: list[Hole]
    pipes: list[Pipe]
    bosses: list[Boss]
    knurls: list[Knurl]
    gears: list[Gear]

    @property
    def taken(self) -> set[int]:
        """The faces of holes, bosses and pipes."""
        return {face for own in (self.holes, self.standing, self.pipes) for record in own for face in record.faces}

    @property
    def standing(self) -> list[Boss]:
        """Its bosses, without the broken corners of nuts and heads."""
        return [boss for boss in self.bosses if not boss.is_broken_edge]


def _parts(
    brep: Brep, shape: Shape, tolerances: Tolerances, is_clear: IsClear, volumes: Volumes, thickness: Thickness
) -> list[Part]:
    """All parts, made of faces of `brep`."""
    round_ = _round(brep, tolerances, is_clear)
    holes, pipes, bosses, gears = round_.holes, round_.pipes, round_.standing, round_.gears
    cylinders = [wall for wall in round_.walls if wall.kind is SurfaceKind.CYLINDER]
    hole_parts = _numbered(brep, holes, hole_part)
    dimples = recognise_dimples(brep, {face for hole in holes for face in hole.faces})
    blends = recognise_blends(brep, round_.taken, tolerances)
    chamfers = {face for blend in blends if blend.kind == "chamfer" for face in blend.faces}
    blend_faces = {face for blend in blends for face in blend.faces}
    pointed = {face for knurl in round_.knurls for face in knurl.faces}
    ribs = recognise_ribs(brep, tolerances)
    fin_numbers = {i + 1 for i in fins(ribs, tolerances)}
    depressions = _cut_in(brep, round_, dimples, chamfers, tolerances, is_clear)
    grooves = _turned_in(brep, round_, depressions, tolerances)
    standing_out = _standing_out(brep, round_.taken, ribs, chamfers, tolerances)
    prisms = standing_out.prisms
    sections = recognise_hollow_sections(brep, depressions)
    flat_walls = with_fins(
        recognise_flat_walls(brep, thickness.opposite_m2, depressions, tolerances),
        [frozenset(ribs[n - 1].flanks) for n in fin_numbers],
    )
    depressions, corners = without_corners_of_walls(depressions, flat_walls)
    wheels = wheel_parts(brep, holes, bosses)
    hubs = {face for part in wheels if "hub" in part.tags for face in part.faces}
    standing = [boss for boss in beside_pipes(brep, bosses, pipes) if not _is_island(boss, holes, hubs, tolerances)]
    edges = [section for hole in holes for section in hole.sections] + [b for boss in standing for b in boss.breaks]
    parts = [
        *hole_parts,
        *(part for n, hole in enumerate(holes, start=1) for part in hole_section_parts(brep, hole, n)),
        *_numbered(brep, dimples, dimple_part),
        *_numbered(brep, standing, boss_part, hole_parts),
        *(part for n, boss in enumerate(standing, start=1) for part in boss_break_parts(brep, boss, n)),
        *(part for n, pipe in enumerate(pipes, start=1) for part in pipe_parts(brep, pipe, n)),
        *wheels,
        *_numbered(brep, grooves, turned_groove_part),
        *_numbered(brep, depressions, depression_part, volumes),
        *_numbered(brep, standing_out.protrusions, protrusion_part, volumes),
        *_numbered(brep, beside_sections(prisms, sections), prism_part),
        *_numbered(brep, standing_out.arms, arm_part),
        *_numbered(brep, sections, hollow_section_part),
        *(rib_part(brep, r, n, n in fin_numbers) for n, r in enumerate(ribs, 1) if not is_in_wall(r, flat_walls)),
        *_numbered(brep, recognise_bent_arcs(brep, round_.walls, tolerances), bent_arc_part),
        *_numbered(brep, [wall for wall in flat_walls if "fin" not in wall.tags], flat_wall_part),
        *_numbered(brep, [found for found in blends if not pointed.issuperset(found.faces)], blend_part),
        *_numbered(brep, [wall for wall in cylinders if wall.encloses], cylinder_part),
        *_numbered(brep, [w for w in cylinders if not w.encloses and not blend_faces.issuperset(w.faces)], arc_part),
        *surface_parts(brep, round_.walls, edges),
        *_numbered(brep, gears, gear_part),
        *_numbered(brep, round_.knurls, knurl_part),
        *(tooth for n, gear in enumerate(gears, start=1) for tooth in tooth_parts(brep, gear, n)),
    ]
    of_corners = {face for cut in corners for face in cut.faces}
    caps = {face for arm in standing_out.arms for face in arm.caps}
    parts += region_parts(brep, parts, volumes, tolerances, corners=of_corners, caps=caps)
    parts += ledge_parts(brep, standing_out.ledges, parts, volumes)
    bearings = recognise_bearings(brep, tolerances)
    turned = _turned(brep, round_.bosses, holes, gears)
    bodies = with_bearing_roles(_bodies(brep, shape.bodies, turned, tolerances, is_clear), bearings)
    walled = sides_of_boxes(flat_walls) | besides_fins(thickness.bodies, flat_walls)
    bodies = with_body_thickness(bodies, brep, prisms, turned, walled, thickness.least)
    bodies = with_gear_measures(with_pipe_measures(bodies, brep, pipes), brep, gears, holes)
    shown = _numbered(brep, bearings, bearing_part, bodies)
    parts = [*with_bearing_bores(parts, brep, bearings), *bodies, *shown, model_part(brep, shape, _only(bodies))]
    parts += _patterns(brep, parts, bearings)
    parts = with_joined_counterbores(with_own_measures(parts, brep), brep, tolerances)
    parts += [*crossbars(parts, brep), *plane_face_parts(brep, parts, tolerances)]
    return with_relations(parts, shape, brep)


def _round(brep: Brep, tolerances: Tolerances, is_clear: IsClear) -> _Round:
    """Holes, pipes, bosses and what is toothed."""
    found = walls(brep, tolerances)
    pipes = recognise_pipes(brep, found, tolerances)
    holes = ending_in_bends(recognise_holes(brep, found, tolerances, is_clear), pipes)
    bosses = with_free_tips(recognise_bosses(brep, found, holes, tolerances), is_clear, dist(*brep.box))
    knurls = recognise_knurls(brep, found, tolerances)
    pointed = {face for knurl in knurls for face in knurl.faces}
    gears = [gear for gear in recognise_gears(brep, found, tolerances) if pointed.isdisjoint(gear.faces)]
    return _Round(found, holes, pipes, bosses, knurls, gears)


def _cut_in(
    brep: Brep,
    round_: _Round,
    dimples: Sequence[Dimple],
    chamfers: Set[int],
    tolerances: Tolerances,
    is_clear: IsClear,
) -> list[Depression]:
    """Depressions; what a ball leaves is none, nor where chamfers meet, nor gaps between teeth slots of their own."""
    hole_faces = {face for hole in round_.holes for face in hole.faces}
    found = recognise_depressions(brep, hole_faces, tolerances, is_clear, round_.walls)
    found = _outside("cutout", found, [frozenset(dimple.faces) for dimple in dimples], "it is what a ball leaves")
    found = [cut for cut in found if not (chamfers >= set(cut.faces) and _is_corner(brep, cut))]
    found += [with_open_ends(outlet, is_clear) for outlet in recognise_outlets(brep, found)]
    found += recognise_clevises(brep, recognise_lugs(brep, tolerances), found, is_clear)
    toothed = [frozenset(record.faces) for own in (round_.gears, round_.knurls) for record in own]
    return _outside("slot", found, toothed, "it is the gap between two teeth")


def _is_corner(brep: Brep, cut: Depression) -> bool:
    """Is it a step, or do its faces meet? Not the flanks of a V that a relief slot parts."""
    own = set(cut.faces)
    return cut.kind is DepressionKind.STEP or any(
        not own.isdisjoint(brep.beside(f, EdgeConvexity.CONCAVE)) for f in own
    )


def _turned_in(
    brep: Brep, round_: _Round, depressions: Sequence[Depression], tolerances: Tolerances
) -> list[TurnedGroove]:
    """Turned grooves; the turns of a thread are none of their own."""
    threads = [frozenset(hole.faces) for hole in round_.holes if "threaded" in hole.tags]
    grooves = _not_voids(recognise_turned_grooves(brep, round_.walls, tolerances), depressions)
    return _outside("groove", grooves, threads, "it is a turn of a thread")


@dataclass(frozen=True, slots=True)
class _StandingOut:
    protrusions: list[Protrusion]
    ledges: list[Protrusion]
    arms: list[Arm]
    prisms: list[Prism]


def _standing_out(
    brep: Brep, round_faces: Set[int], ribs: Sequence[Rib], chamfers: Set[int], tolerances: Tolerances
) -> _StandingOut:
    """Pads, arms, blocks and plates; what an arm is made of is no other part."""
    arms = recognise_arms(brep, [frozenset(rib.flanks) for rib in ribs], tolerances)
    protrusions = without_arms(recognise_protrusions(brep, round_faces, tolerances), arms)
    known = {f for p in protrusions for f in p.faces} | {rib.top for rib in ribs}
    pads, ledges = recognise_pads(brep, known, tolerances)
    sides = {face for arm in arms for face in arm.sides}
    prisms = [prism for prism in recognise_prisms(brep, chamfers) if sides.isdisjoint(prism.faces)]
    spokes = {face for arm in arms if arm.is_spoke for face in arm.sides}
    plates = recognise_plates(brep, prisms, ribs, tolerances)
    plates = [plate for plate in plates if len(spokes.intersection(plate.faces)) < SPIDER]
    return _StandingOut([*protrusions, *pads], ledges, arms, [*without_edgewise(prisms, plates), *plates])


def _only(bodies: Sequence[Part]) -> Part | None:
    return bodies[0] if len(bodies) == 1 else None


D = TypeVar("D", Depression, TurnedGroove)


def _outside(kind: str, found: Sequence[D], larger: Sequence[frozenset[int]], reason: str) -> list[D]:
    """Those that are not made of the faces of something larger; `reason`: why the others are not parts of their own."""
    kept = []
    for record in found:
        if any(faces.issuperset(record.faces) for faces in larger):
            refuse(kind, record.faces, reason)
        else:
            kept.append(record)
    return kept


def _not_voids(grooves: Sequence[TurnedGroove], depressions: Sequence[Depression]) -> list[TurnedGroove]:
    """Without those that are a closed void by themselves: a groove opens at the surface that it is turned into."""
    voids = {found.faces for found in depressions if found.kind is DepressionKind.CAVITY}
    return [groove for groove in grooves if groove.faces not in voids]


def _is_island(boss: Boss, holes: Sequence[Hole], hubs: Set[int], tolerances: Tolerances) -> bool:
    """Is it what an annular groove leaves standing, level with the groove's rim?

    Around a bore it is a boss nevertheless where the groove is wider than its wall, a recess, unless it is an end of a
    hub. `hubs`: faces of hubs.
    """
    around = [hole for hole in holes if hole.is_ring and not set(hole.faces).isdisjoint(boss.faces)]
    around = [hole for hole in around if abs(boss.height - hole.depth) < 10 * tolerances.length]
    if boss.bore_radius is not None and hubs.isdisjoint(boss.faces):
        wall = boss.radius - boss.bore_radius
        around = [hole for hole in around if not exceeds(hole.radius - boss.radius, wall)]
    if around:
        refuse("boss", boss.faces, "an annular groove leaves it, level with its rim")
    return bool(around)


def _turned(
    brep: Brep, bosses: Sequence[Boss], holes: Sequence[Hole], gears: Sequence[Gear]
) -> list[TurnedBody | None]:
    own_bosses, own_holes, own_gears = _by_body(bosses), _by_body(holes), _by_body(gears)
    return [turned_body(brep, one, own_bosses[one.id], own_holes[one.id], own_gears[one.id]) for one in brep.bodies]


def _bodies(
    brep: Brep,
    masses: Sequence[Weighed],
    turned: Sequence[TurnedBody | None],
    tolerances: Tolerances,
    is_clear: IsClear,
) -> list[Part]:
    model_m = dist(*brep.box)
    parts = []
    for number, (record, form) in enumerate(zip(brep.bodies, turned, strict=True), start=1):
        tips = tips_of(form, is_clear, model_m) if form is not None and form.slender else ()
        parts.append(body_part(brep, record, number, tolerances, masses[number - 1], form, tips))
    return parts


def _by_body(records: Sequence[R]) -> dict[int, list[R]]:
    own: dict[int, list[R]] = defaultdict(list)
    for record in records:
        own[record.body].append(record)
    return own


def _patterns(brep: Brep, parts: Sequence[Part], bearings: Sequence[Bearing]) -> list[Part]:
    """Patterns of what is cut in and of what stands out, around whatever is round; and of what rolls in a bearing."""
    members = [part for part in parts if part.kind in PATTERNED or (part.kind == "boss" and "raised" in part.tags)]
    centers = [part for part in parts if part.kind in (PartKind.HOLE, PartKind.BOSS, PartKind.BODY)]
    bodies = [brep.faces[part.faces[0]].body for part in members]
    by_faces = {part.faces: part for part in parts if part.kind == "body"}
    for bearing in bearings:
        rolling = [body for i in bearing.rolling if (body := by_faces.get(brep.bodies[i].faces)) is not None]
        along = {"normal": bearing.axis.direction}
        members += [body.model_copy(update=along) for body in rolling if body.diameter or body.width]
        bodies += [bearing.rings[0]] * (len(members) - len(bodies))
    found = recognise_patterns(members, bodies, centers)
    return [pattern_part(one, n, [members[i] for i in one.members]) for n, one in enumerate(found, start=1)]


def _numbered(
    brep: Brep,
    records: Sequence[T],
    make: Callable[Concatenate[Brep, T, int, P], Part],
    *more: P.args,
    **named: P.kwargs,
) -> list[Part]:
    """What each record makes as a part, counted from 1; `more`: what making it needs besides."""
    return [make(brep, record, number, *more, **named) for number, record in enumerate(records, start=1)]


def _shape(brep: Brep, thickness: Thickness, whole: Brep) -> Shape:
    """`whole`: the same with pieces of one surface united, which symmetry is told by."""
    masses = [weighed(whole, [record]) for record in whole.bodies]
    together = masses[0] if len(masses) == 1 else weighed(whole, whole.bodies)
    return Shape(
        name=brep.name,
        center=box_center(brep.box),
        extents=box_extents(brep.box),
        volume=sum(record.volume for record in brep.bodies),
        area=sum(record.area for record in brep.bodies),
        thickness=thickness.model,
        minimum_thickness=thickness.of_all(len(brep.bodies)),
        bodies=tuple(body(brep, record, mass) for record, mass in zip(brep.bodies, masses, strict=True)),
        face_count=len(brep.faces),
        edge_count=sum(edge.convexity is not EdgeConvexity.SEAM for edge in brep.edges),
        up=likely_up(brep),
        **mass_of(together),
    )
