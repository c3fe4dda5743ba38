"""Records of what is round become parts: bosses, and cylinders and arcs as such."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Sequence

from querycad_contracts import Part, SurfaceKind, Vector
from querycad_segworker.features.holes.hole import RIM, Section, SectionKind
from querycad_segworker.features.shared.part_measures import faces_area, faces_box, geometry, millimetres
from querycad_segworker.features.shared.walls import Wall
from querycad_segworker.features.turned.bosses import Boss
from querycad_segworker.features.turned.pipes import Bend, Pipe, bent_measures
from querycad_segworker.topology import Brep, EdgeConvexity, EdgeKind
from querycad_segworker.vectors import OFF_ROUND, binned, box_center, box_extents, coordinate_axis, mid

from .holes import section_part

CONE_ROLES = (SectionKind.DRILL_POINT, SectionKind.CHAMFER)
"""What a cone is named by before it is named a cone."""
SPHERE_SHARE = 0.2
"""More than this share of a whole sphere is no rounded corner of a block, which is an eighth."""
WHOLE_CIRCLE, SHARP = 0.9, 0.5
"""Nor is what a whole circle bounds, but for this share, or what more than this share of its rim parts sharply."""


def boss_part(brep: Brep, boss: Boss, number: int, holes: Sequence[Part]) -> Part:
    """A round protrusion as a part; its height runs along its own axis from base to tip, its depth is its bore's.

    Its thickness is its height where it is flat, or the distance of parallel oblique ends; that of its wall where it is
    hollow and does not taper. The length of a shaft's step runs along the axis; that of a boss is its longer dimension.
    A rim is as wide as it is high.
    """
    bore = None if boss.hole is None else holes[boss.hole]
    flat, axial = "flat" in boss.tags, "stepped" in boss.tags or "slender" in boss.tags
    return Part(
        id=f"boss-{number}",
        kind="boss",
        tags=boss.tags,
        label=f"{_boss_name(boss)}, diameter {millimetres(2 * boss.radius)}, height {millimetres(boss.height)}",
        faces=boss.faces,
        center=mid(boss.base, boss.tip),
        extents=_to_its_ends(boss, box_extents(faces_box(brep, boss.faces))),
        axis=boss.normal,
        normal=boss.normal,
        radius=boss.radius,
        diameter=2 * boss.radius,
        height=boss.height,
        depth=None if bore is None else bore.depth,
        width=boss.height if RIM in boss.tags else 2 * boss.radius,
        length=boss.height if axial else max(boss.height, 2 * boss.radius),
        thickness=(boss.between_planes or boss.height) if flat else boss.wall,
        tip=boss.tip,
        tips=boss.tips or (boss.tip,),
        pitch=boss.pitch,
        local_size=(2 * boss.radius, 2 * boss.radius, boss.height),
        area=faces_area(brep, boss.faces),
        draft=boss.lean if "conical" in boss.tags else None,
        radii=(boss.radius,) if boss.bore_radius is None else (boss.radius, boss.bore_radius),
        children=(
            *((bore.id,) if bore is not None else ()),
            *(_break_id(number, i) for i in range(1, len(boss.breaks) + 1)),
        ),
        evidence=geometry(
            f"a convex {'cone' if 'conical' in boss.tags else 'cylinder'} around one axis, "
            f"radius {millimetres(boss.radius)}, "
            + ("with both ends free" if "free" in boss.tags else "standing on the material")
        ),
    )


def _to_its_ends(boss: Boss, walls: Vector) -> Vector:
    """The box of its walls, along its axis from base to tip.

    A fillet at its foot belongs to neither wall; jaws on a disc, level with its rim, are no part of it.
    """
    along = coordinate_axis(boss.normal)
    is_square = "flat" in boss.tags and boss.between_planes is None
    x, y, z = (
        (boss.height if is_square else max(size, boss.height)) if i == along else size for i, size in enumerate(walls)
    )
    return x, y, z


def _boss_name(boss: Boss) -> str:
    """What would a drawing call it?"""
    if "conical" in boss.tags:
        return "conical boss"
    if RIM in boss.tags:
        return "rim"
    if boss.hole is not None and "flat" in boss.tags:
        return "flange" if "flange" in boss.tags else "ring" if "raised" in boss.tags else "disc"
    if {"tube", "slender"} <= set(boss.tags):
        return "tube"
    if boss.hole is not None and not {"slender", "free"} <= set(boss.tags):
        return "standoff"
    return "shaft" if "slender" in boss.tags else "disc" if "flat" in boss.tags else "boss"


def boss_break_parts(brep: Brep, boss: Boss, number: int) -> list[Part]:
    """The chamfers at the ends of a boss or shaft as parts of their own; the boss carries them."""
    return [
        section_part(brep, section, _break_id(number, i), f"boss {number}", outer=True)
        for i, section in enumerate(boss.breaks, start=1)
    ]


def _break_id(number: int, i: int) -> str:
    return f"chamfer-b{number}.{i}"


def surface_parts(brep: Brep, walls: Sequence[Wall], sections: Sequence[Section] = ()) -> list[Part]:
    """The cones, spheres and tori of the model as such, inner and outer, whatever features they belong to.

    `sections`: those of holes and bosses; cones that are their drill points and chamfers say so by a tag.
    """
    roles = {face: section.kind.value for section in sections for face in section.faces if section.kind in CONE_ROLES}
    cones = [wall for wall in walls if wall.kind is SurfaceKind.CONE and wall.encloses]
    tori = [wall for wall in walls if wall.kind is SurfaceKind.TORUS and wall.sweep > math.radians(350.0)]
    return [
        *(_revolved_part(brep, wall, "cone", n, roles.get(wall.faces[0])) for n, wall in enumerate(cones, start=1)),
        *(_revolved_part(brep, wall, "torus", n) for n, wall in enumerate(tori, start=1)),
        *(_sphere_part(brep, group, n) for n, group in enumerate(_spheres(brep), start=1)),
    ]


def _revolved_part(brep: Brep, wall: Wall, kind: str, number: int, role: str | None = None) -> Part:
    """A cone has the radii of both ends, the wider first and as its radius, and a tip; a torus its two radii."""
    side = "outer" if wall.outward > 0 else "inner"
    record = brep.faces[wall.faces[0]]
    torus = kind == "torus"
    radii = (record.radius, record.minor_radius) if torus else (wall.radius, min(wall.radius_low, wall.radius_high))
    wide = 2 * (record.radius + record.minor_radius) if torus else 2 * wall.radius
    narrow = wall.low if wall.radius_low < wall.radius_high else wall.high
    return Part(
        id=f"{kind}-{number}",
        kind=kind,
        tags=(side, "circular", "toroidal" if torus else "conical", *((role,) if role else ())),
        label=f"{side} {kind}, diameter {millimetres(wide)}, height {millimetres(wall.height)}",
        faces=wall.faces,
        center=record.origin if torus else wall.axis.at((wall.low + wall.high) / 2),
        extents=box_extents(faces_box(brep, wall.faces)),
        axis=wall.axis.direction,
        tip=None if torus else wall.axis.at(narrow),
        radius=radii[0],
        diameter=wide,
        height=wall.height,
        depth=wall.height if wall.outward < 0 else None,
        length=wall.height,
        width=wide,
        area=faces_area(brep, wall.faces),
        radii=radii,
        angle=None if torus else 2 * record.half_angle,
        evidence=geometry(f"a {'convex' if wall.outward > 0 else 'concave'} {kind} around one axis"),
    )


def _spheres(brep: Brep) -> list[list[int]]:
    """The faces of each sphere that is no rounded corner, those of one centre and radius together."""
    groups: dict[tuple[object, ...], list[int]] = defaultdict(list)
    for face in brep.faces:
        if face.kind is SurfaceKind.SPHERE:
            place = tuple(round(c * OFF_ROUND / (1e-3 * face.radius)) for c in face.origin)
            groups[(face.body, face.outward, place, binned(face.radius, 4))].append(face.id)
    corner = SPHERE_SHARE * 4 * math.pi
    return [
        ids
        for ids in groups.values()
        if faces_area(brep, ids) > corner * brep.faces[ids[0]].radius ** 2 or not _is_corner(brep, ids)
    ]


def _is_corner(brep: Brep, faces: Sequence[int]) -> bool:
    """Do they run on into what is around them, and does no whole circle bound them, as a turned end or seat?"""
    rim = [edge for edge in (brep.edges[i] for i in brep.edges_of(faces)) if not set(edge.faces) <= set(faces)]
    turns: dict[tuple[float, ...], float] = defaultdict(float)
    for edge in rim:
        if edge.kind is EdgeKind.CIRCLE and edge.center and edge.radius:
            place = tuple(round(c * OFF_ROUND / (1e-3 * edge.radius)) for c in edge.center)
            turns[place] += edge.length / (2 * math.pi * edge.radius)
    sharp = sum(edge.length for edge in rim if edge.convexity is not EdgeConvexity.SMOOTH)
    return sharp < SHARP * sum(edge.length for edge in rim) and max(turns.values(), default=0.0) < WHOLE_CIRCLE


def _sphere_part(brep: Brep, faces: Sequence[int], number: int) -> Part:
    """A ball, dome or spherical hollow; its centre is that of the ball, also where only a part of that is there."""
    record = brep.faces[faces[0]]
    side = "outer" if record.outward > 0 else "inner"
    whole = faces_area(brep, faces) > 0.75 * 4 * math.pi * record.radius**2
    return Part(
        id=f"sphere-{number}",
        kind="sphere",
        tags=(side, "spherical", "ball" if whole else "dome"),
        label=f"{side} sphere, diameter {millimetres(2 * record.radius)}",
        faces=tuple(faces),
        center=record.origin,
        extents=box_extents(faces_box(brep, faces)),
        radius=record.radius,
        diameter=2 * record.radius,
        area=faces_area(brep, faces),
        radii=(record.radius,),
        evidence=geometry(f"a {'convex' if record.outward > 0 else 'concave'} sphere"),
    )


def cylinder_part(brep: Brep, wall: Wall, number: int) -> Part:
    """A cylindrical wall as such, inner or outer, whatever feature it belongs to."""
    side = "outer" if wall.outward > 0 else "inner"
    box = faces_box(brep, wall.faces)
    return Part(
        id=f"cylinder-{number}",
        kind="cylinder",
        tags=(side, "circular", "cylindrical"),
        label=f"{side} cylinder, diameter {millimetres(2 * wall.radius)}, length {millimetres(wall.height)}",
        faces=wall.faces,
        center=wall.axis.at((wall.low + wall.high) / 2),
        extents=box_extents(box),
        axis=wall.axis.direction,
        radius=wall.radius,
        diameter=2 * wall.radius,
        height=wall.height,
        depth=wall.height if wall.outward < 0 else None,
        width=2 * wall.radius,
        length=wall.height,
        area=faces_area(brep, wall.faces),
        radii=(wall.radius,),
        evidence=geometry(
            f"a {'convex' if wall.outward > 0 else 'concave'} cylinder of radius {millimetres(wall.radius)}"
        ),
    )


def pipe_parts(brep: Brep, pipe: Pipe, number: int) -> list[Part]:
    """A bent pipe, bar or bore as a part, with its bends as parts of their own, which it carries.

    `radii` of the pipe: outer, then inner; a bend's radius is that of the pipe's middle line.
    """
    radii = tuple(radius for radius in (pipe.outer, pipe.inner) if radius is not None)
    wall = None if pipe.outer is None or pipe.inner is None else pipe.outer - pipe.inner
    name, tags = ("pipe", ("hollow", "tube")) if wall is not None else ("bar", ("rod", "slender"))
    if pipe.outer is None:
        name, tags = "bore", ("inner", "hollow")
    bends = [_bend_part(brep, bend, radii[0], f"bend-{number}.{i}", name) for i, bend in enumerate(pipe.bends, 1)]
    box = faces_box(brep, pipe.faces)
    part = Part(
        id=f"pipe-{number}",
        kind="pipe",
        tags=(*tags, "bent", "cylindrical", "circular"),
        label=f"bent {name}, diameter {millimetres(2 * radii[0])}, length {millimetres(pipe.length)}",
        faces=pipe.faces,
        center=box_center(box),
        extents=box_extents(box),
        radius=radii[0],
        diameter=2 * radii[0],
        width=2 * radii[0],
        length=pipe.length,
        thickness=wall,
        area=faces_area(brep, pipe.faces),
        radii=radii,
        children=tuple(bend.id for bend in bends),
        **bent_measures(pipe),
        evidence=geometry(f"{len(bends)} bend(s) and the straight lengths that run into them, of one cross-section"),
    )
    return [part, *bends]


def _bend_part(brep: Brep, bend: Bend, radius: float, part_id: str, owner: str) -> Part:
    """`radius`: of the cross-section; the bend's inner and outer diameters are those of its inside and outside."""
    box = faces_box(brep, (bend.face,))
    return Part(
        id=part_id,
        kind="bend",
        tags=("outer" if bend.outward > 0 else "inner", "bent"),
        label=f"{owner} bend, radius {millimetres(bend.radius)}",
        faces=(bend.face,),
        center=box_center(box),
        extents=box_extents(box),
        axis=bend.axis.direction,
        radius=bend.radius,
        length=bend.radius * bend.angle,
        area=faces_area(brep, (bend.face,)),
        radii=(bend.radius,),
        angle=bend.angle,
        bend_radius=bend.radius,
        bend_angle=bend.angle,
        inner_diameter=2 * (bend.radius - radius),
        outer_diameter=2 * (bend.radius + radius),
        evidence=geometry("part of a torus that whole cross-sections bound"),
    )


def arc_part(brep: Brep, wall: Wall, number: int) -> Part:
    """A cylindrical wall that does not enclose its axis: a semicircular notch or rounded end.

    Its length and height run along its axis, its depth is how far a hollow one goes in below its two edges.
    """
    side = "outer" if wall.outward > 0 else "inner"
    half = math.radians(170.0) <= wall.sweep <= math.radians(190.0)
    return Part(
        id=f"arc-{number}",
        kind="arc",
        tags=(side, "semicircular") if half else (side,),
        label=f"{side} {'semicircle' if half else 'arc'}, radius {millimetres(wall.radius)}",
        faces=wall.faces,
        center=wall.axis.at((wall.low + wall.high) / 2),
        extents=box_extents(faces_box(brep, wall.faces)),
        axis=wall.axis.direction,
        radius=wall.radius,
        diameter=2 * wall.radius,
        height=wall.height,
        depth=wall.radius * (1 - math.cos(wall.sweep / 2)) if wall.outward < 0 else None,
        length=wall.height,
        width=2 * wall.radius if half else None,
        area=faces_area(brep, wall.faces),
        radii=(wall.radius,),
        evidence=geometry(
            f"a cylinder of radius {millimetres(wall.radius)} over {math.degrees(wall.sweep):.0f} degrees"
        ),
    )
