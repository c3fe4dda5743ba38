"""Bodies of the file: by name, colour, outline and, where they are round, by radius and axis."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from querycad_contracts import Body, Evidence, Part, Shape, SurfaceKind, Vector, Weighed
from querycad_segworker.features.holes.hole import Hole
from querycad_segworker.features.shared.axes import Axis
from querycad_segworker.features.shared.frames import outline_of
from querycad_segworker.features.shared.part_measures import faces_box, millimetres
from querycad_segworker.features.sheet.body_thickness import is_flat, largest_plane
from querycad_segworker.features.turned.gears import Gear
from querycad_segworker.features.turned.pipes import Pipe, bent_measures
from querycad_segworker.features.turned.round_bodies import COAXIAL, ROUND, TurnedBody
from querycad_segworker.tolerances import Tolerances, exceeds
from querycad_segworker.topology import BodyRecord, Brep, together
from querycad_segworker.vectors import box_center, box_extents

from .bearings import Bearing
from .symmetry import symmetry, symmetry_tags

_OF_TURNED = (
    *("axis", "radius", "diameter", "radii", "tip", "tips", "outer_diameter", "inner_diameter", "tube_diameter"),
    "developed_length",
)
"""What a model that is one round body has of it."""
MOSTLY = 0.5
"""A body with more than this share of its surface in one pipe is that pipe, with flanges or ports."""
HALF = 0.5
"""A disc whose hole takes more than this share of its diameter is a ring or washer, no plate."""
RINGS_ALONE = 0.8
"""How surely two rings of one width, one in the other, are a bearing drawn in a simple way."""


def weighed(brep: Brep, records: Sequence[BodyRecord]) -> Weighed:
    """How the bodies are as one mass, and how they are symmetric together. Pieces of one surface are one face here."""
    moments = together([record.moments for record in records if record.moments is not None])
    found = symmetry([brep.faces[f] for record in records for f in record.faces])
    return Weighed(
        center_of_mass=moments.center if moments.amount else None,
        inertia=moments.inertia if moments.amount else None,
        mirror_planes=found.planes,
        rotation_axes=found.axes,
    )


def body(brep: Brep, record: BodyRecord, mass: Weighed) -> Body:
    """A body of the file, for `Shape.bodies`."""
    box = faces_box(brep, record.faces)
    return Body(
        id=record.id,
        name=record.name,
        color=record.color,
        is_solid=record.is_solid,
        center=box_center(box),
        extents=box_extents(box),
        volume=record.volume,
        area=record.area,
        face_count=len(record.faces),
        **mass_of(mass),
    )


def mass_of(one: Weighed) -> dict[str, Any]:
    """What it has as a mass, by name."""
    return {name: getattr(one, name) for name in Weighed.model_fields}


def _outline(brep: Brep, record: BodyRecord, tolerances: Tolerances) -> tuple[str, ...]:
    """Tags for the outline of the body's largest plane face; 'plate' where it is flat along it."""
    material = "solid" if record.is_solid else "sheet"
    largest = largest_plane(brep, record)
    if largest is None:
        return (material,)
    outline, _ = outline_of(brep, largest.loops[0], tolerances)
    return (material, *(("plate",) if is_flat(brep, record) else ()), outline)


def body_part(
    brep: Brep,
    record: BodyRecord,
    number: int,
    tolerances: Tolerances,
    mass: Weighed,
    turned: TurnedBody | None = None,
    tips: tuple[Vector, ...] = (),
) -> Part:
    """A body of the file as a part, so that names and colours find it. A round one has radii, axis and length too.

    `tips`: the free ends of a `turned` body. How thick it is, `with_body_thickness` says.
    """
    box = faces_box(brep, record.faces)
    extents = box_extents(box)
    tags = _outline(brep, record, tolerances)
    measures: dict[str, object] = {}
    ball = None if turned is not None else _ball(brep, record)
    if ball is not None:
        tags = (*tags, "ball", "spherical")
        measures |= {"radius": ball, "diameter": 2 * ball, "radii": (ball,)}
    if turned is not None:
        wide_bore = turned.bore is not None and exceeds(turned.bore.radius, HALF * turned.outer_radius)
        mostly_hole = wide_bore or turned.spoked
        tags = (*(tag for tag in tags if not (mostly_hole and tag == "plate")), *turned.tags)
        measures |= _turned_measures(turned, tips)
    return Part(
        id=f"body-{number}",
        kind="body",
        tags=tuple(dict.fromkeys((*tags, *symmetry_tags(mass)))),
        label=record.name or ("solid" if record.is_solid else "surface"),
        faces=record.faces,
        center=box_center(box),
        extents=extents,
        **{
            "width": extents[0],
            "depth": extents[1],
            "height": extents[2],
            "length": max(extents),
            **measures,
            **mass_of(mass),
        },
        volume=record.volume if record.is_solid else None,
        area=record.area,
        name=record.name or None,
        color=record.color,
        evidence=Evidence(
            source="name" if record.name else "geometry",
            confidence=1.0,
            reason=f"body {number} of the file" + (f", named '{record.name}'" if record.name else ""),
        ),
    )


def with_bearing_roles(bodies: Sequence[Part], bearings: Sequence[Bearing]) -> list[Part]:
    """The same bodies, tagged with what they are in a bearing: 'inner_ring', 'outer_ring', 'rolling'."""
    roles: dict[int, str] = {}
    for bearing in bearings:
        roles |= dict.fromkeys(bearing.rolling, "rolling")
        names = ("washer", "washer") if bearing.axial else ("inner_ring", "outer_ring")
        roles |= dict(zip(bearing.rings, names, strict=True))
    tags = {i: (*bodies[i].tags, role) for i, role in roles.items()}
    return [part.model_copy(update={"tags": tags[i]}) if i in tags else part for i, part in enumerate(bodies)]


def with_bearing_bores(parts: Sequence[Part], brep: Brep, bearings: Sequence[Bearing]) -> list[Part]:
    """The same parts; the hole of each inner ring, which takes the shaft, is tagged 'bearing_bore'."""
    inner = {one.rings[0]: one.inner_radius for one in bearings if not one.axial}
    return [
        part.model_copy(update={"tags": (*part.tags, "bearing_bore")})
        if part.kind == "hole" and part.radius and _is_near(part.radius, inner.get(brep.faces[part.faces[0]].body))
        else part
        for part in parts
    ]


def _is_near(radius: float, other: float | None) -> bool:
    return other is not None and abs(radius - other) <= COAXIAL * radius


def with_gear_measures(bodies: Sequence[Part], brep: Brep, gears: Sequence[Gear], holes: Sequence[Hole]) -> list[Part]:
    """The same bodies; one that a gear is the widest of, but that is no shaft, has its diameter over the tips.

    Its `radii` are those of tips, roots and of the bore; it is as thick as its teeth are wide.
    """
    result = []
    for part, record in zip(bodies, brep.bodies, strict=True):
        own = [gear for gear in gears if gear.body == record.id and not gear.internal]
        widest = max(own, key=lambda gear: gear.tip_radius, default=None)
        if (
            widest is not None
            and part.radius is None
            and _reach_of(brep, record, widest.axis) < ROUND * widest.tip_radius
        ):
            near = COAXIAL * widest.tip_radius
            bores = [h.radius for h in holes if h.body == record.id and widest.axis.radius_of(h.center) < near]
            part = part.model_copy(
                update={
                    "axis": widest.axis.direction,
                    "radius": widest.tip_radius,
                    "diameter": 2 * widest.tip_radius,
                    "radii": (widest.tip_radius, widest.root_radius, *bores),
                    "thickness": widest.width,
                }
            )
        result.append(part)
    return result


def _reach_of(brep: Brep, record: BodyRecord, axis: Axis) -> float:
    """How far from an axis does the body reach?"""
    edges = (brep.edges[e] for face in record.faces for e in brep.face_edges[face])
    return max(axis.radius_of(p) for edge in edges for p in edge.points)


def with_pipe_measures(bodies: Sequence[Part], brep: Brep, pipes: Sequence[Pipe]) -> list[Part]:
    """The same bodies; one that mostly is a bent pipe or bar has the radii of its cross-section, and a pipe's wall."""
    result = []
    for part, record in zip(bodies, brep.bodies, strict=True):
        own = [pipe for pipe in pipes if pipe.body == record.id and pipe.outer is not None]
        if len(own) == 1 and own[0].outer is not None and part.radius is None:
            pipe, outer, inner = own[0], own[0].outer, own[0].inner
            if sum(brep.faces[f].area for f in pipe.faces) > MOSTLY * record.area:
                update: dict[str, object] = {"radius": outer, "diameter": 2 * outer, "radii": (outer,)}
                update["tags"] = (*part.tags, "bent", "tube" if inner is not None else "rod")
                update |= {"outer_diameter": 2 * outer, "developed_length": pipe.length, **bent_measures(pipe)}
                if inner is not None:
                    update |= {"radii": (outer, inner), "thickness": outer - inner, "inner_diameter": 2 * inner}
                part = part.model_copy(update=update)
        result.append(part)
    return result


def bearing_part(brep: Brep, found: Bearing, number: int, bodies: Sequence[Part]) -> Part:
    """A rolling bearing of an assembly: diameter over the outer ring, `radii` of outer ring and bore, width of both."""
    members = (*found.rings, *found.rolling, *found.others)
    faces = tuple(sorted(face for body in members for face in brep.bodies[body].faces))
    direction = "axial" if found.axial else "radial"
    rolling = ("ball" if found.balls else "roller",) if found.rolling else ()
    name = " ".join((*rolling, "bearing"))
    what = f"{len(found.rolling)} {rolling[0]}s between" if rolling else "nothing but a gap between"
    return Part(
        id=f"bearing-{number}",
        kind="bearing",
        tags=(direction, *rolling, "circular", "ring", "hollow"),
        label=f"{name}, {millimetres(2 * found.inner_radius)} x {millimetres(2 * found.outer_radius)} x "
        f"{millimetres(found.width)}",
        faces=faces,
        center=found.center,
        extents=box_extents(faces_box(brep, faces)),
        axis=found.axis.direction,
        radius=found.outer_radius,
        diameter=2 * found.outer_radius,
        width=found.width,
        height=found.width,
        length=found.width,
        thickness=found.width,
        radii=(found.outer_radius, found.inner_radius),
        count=len(found.rolling) or None,
        children=tuple(bodies[body].id for body in members),
        evidence=Evidence(
            source="geometry",
            confidence=1.0 if rolling else RINGS_ALONE,
            reason=f"two rings on one axis with {what}",
        ),
    )


def _turned_measures(turned: TurnedBody, tips: tuple[Vector, ...]) -> dict[str, object]:
    """What a shaft, rod, tube, ring or disc has beyond its box; only what is longer than wide has tips."""
    measures: dict[str, object] = {
        "axis": turned.axis.direction,
        "radius": turned.radius,
        "diameter": 2 * turned.radius,
        "length": turned.length,
        "radii": turned.radii,
        "outer_diameter": 2 * turned.outer_radius,
    }
    if turned.bore is not None:
        measures["inner_diameter"] = 2 * turned.bore.radius
    if turned.slender:
        measures |= {"height": turned.length, "tip": tips[0] if tips else None, "tips": tips}
    return measures


def _ball(brep: Brep, record: BodyRecord) -> float | None:
    """The radius of a body whose surface is nothing but one sphere."""
    faces = [brep.faces[f] for f in record.faces]
    first = faces[0]
    if any(f.kind is not SurfaceKind.SPHERE or abs(f.radius - first.radius) > 1e-3 * first.radius for f in faces):
        return None
    return first.radius if first.outward > 0 else None


def model_part(brep: Brep, shape: Shape, only: Part | None = None) -> Part:
    """The whole model as a part, so that its name finds it; a round one has the radii and axis of its `only` body."""
    turned = {} if only is None else {name: getattr(only, name) for name in _OF_TURNED}
    return Part(
        id="model-1",
        kind="model",
        tags=symmetry_tags(shape),
        label=shape.name or "the whole model",
        faces=tuple(face.id for face in brep.faces),
        center=shape.center,
        extents=shape.extents,
        width=shape.extents[0],
        depth=shape.extents[1],
        height=shape.extents[2],
        length=max(shape.extents),
        thickness=shape.thickness if shape.thickness is not None or only is None else only.thickness,
        minimum_thickness=shape.minimum_thickness,
        volume=shape.volume or None,
        area=shape.area,
        name=shape.name or None,
        evidence=Evidence(source="geometry", confidence=1.0, reason="all faces of the file"),
        **turned,
        **mass_of(shape),
    )
