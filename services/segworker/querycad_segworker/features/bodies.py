"""Bodies of the file: by name, colour, outline and, where they are round, by radius and axis."""

from __future__ import annotations

from collections.abc import Sequence

from querycad_contracts import Body, Evidence, Part, Shape, SurfaceKind, Vector
from querycad_segworker.tolerances import Tolerances
from querycad_segworker.topology import BodyRecord, Brep
from querycad_segworker.vectors import box_center, box_extents, cross, dot, perpendicular

from .bearings import Bearing
from .frames import outline_of
from .parts import PLATE_RATIO, faces_box, millimetres
from .turned_bodies import TurnedBody

_OF_TURNED = ("axis", "radius", "diameter", "radii", "tip", "tips")
"""What a model that is one round body has of it."""
RINGS_ALONE = 0.8
"""How surely two rings of one width, one in the other, are a bearing drawn in a simple way."""


def body(brep: Brep, record: BodyRecord) -> Body:
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
    )


def _outline(brep: Brep, record: BodyRecord, tolerances: Tolerances) -> tuple[tuple[str, ...], float | None]:
    """Tags for the outline of the body's largest plane face, and the body's thickness where it is a plate along it."""
    tags = ["solid" if record.is_solid else "sheet"]
    planes = [brep.faces[f] for f in record.faces if brep.faces[f].kind is SurfaceKind.PLANE]
    largest = max(planes, key=lambda face: face.area, default=None)
    if largest is None or not largest.loops:
        return tuple(tags), None
    outline, _ = outline_of(brep, largest.loops[0], tolerances)
    points = [brep.edges[e].mid for f in record.faces for e in brep.face_edges[f]]
    x = perpendicular(largest.axis)
    reach = [
        max(dot(p, d) for p in points) - min(dot(p, d) for p in points)
        for d in (largest.axis, x, cross(largest.axis, x))
    ]
    flat = reach[0] < PLATE_RATIO * min(reach[1:])
    return (*tags, *(("plate",) if flat else ()), outline), reach[0] if flat else None


def body_part(
    brep: Brep,
    record: BodyRecord,
    number: int,
    tolerances: Tolerances,
    turned: TurnedBody | None = None,
    tips: tuple[Vector, ...] = (),
) -> Part:
    """A body of the file as a part, so that names and colours find it. A round one has radii, axis and length too.

    `tips`: the free ends of a `turned` body. A ring or disc is as thick as it is long, a tube as its wall is.
    """
    box = faces_box(brep, record.faces)
    extents = box_extents(box)
    tags, thickness = _outline(brep, record, tolerances)
    measures: dict[str, object] = {} if thickness is None else {"thickness": thickness}
    ball = None if turned is not None else _ball(brep, record)
    if ball is not None:
        tags = (*tags, "ball", "spherical")
        measures |= {"radius": ball, "diameter": 2 * ball, "radii": (ball,)}
    if turned is not None:
        tags = (*tags, *turned.tags)
        measures |= _turned_measures(turned, tips)
    return Part(
        id=f"body-{number}",
        kind="body",
        tags=tuple(dict.fromkeys(tags)),
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
    }
    if turned.slender:
        measures |= {"height": turned.length, "tip": tips[0] if tips else None, "tips": tips}
    if "tube" in turned.tags and turned.bore is not None:
        measures["thickness"] = turned.radius - turned.bore.radius
    elif turned.length < turned.outer_radius:
        measures["thickness"] = turned.length
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
        label=shape.name or "the whole model",
        faces=tuple(face.id for face in brep.faces),
        center=shape.center,
        extents=shape.extents,
        width=shape.extents[0],
        depth=shape.extents[1],
        height=shape.extents[2],
        length=max(shape.extents),
        thickness=shape.thickness,
        volume=shape.volume or None,
        area=shape.area,
        name=shape.name or None,
        evidence=Evidence(source="geometry", confidence=1.0, reason="all faces of the file"),
        **turned,
    )
