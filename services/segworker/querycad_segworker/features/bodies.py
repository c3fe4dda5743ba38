"""Bodies of the file: by name, colour, outline and, where they are round, by radius and axis."""

from __future__ import annotations

from collections.abc import Sequence

from querycad_contracts import Body, Evidence, Part, Shape, SurfaceKind, Vector
from querycad_segworker.tolerances import Tolerances
from querycad_segworker.topology import BodyRecord, Brep
from querycad_segworker.vectors import box_center, box_extents, cross, dot, perpendicular

from .bosses import Boss
from .frames import outline_of
from .holes import Hole
from .parts import PLATE_RATIO, faces_box
from .walls import Axis


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


def _round_body(record: BodyRecord, bosses: Sequence[Boss], extents: Vector) -> Boss | None:
    """The boss whose cylinder is as wide as the whole body: then the body is round, a shaft, ring or disc."""
    own = [boss for boss in bosses if boss.body == record.id]
    widest = max(own, key=lambda boss: boss.radius, default=None)
    if widest is None:
        return None
    across = [e for e, n in zip(extents, widest.normal, strict=True) if abs(n) < 0.1]
    return widest if len(across) == 2 and all(abs(e - 2 * widest.radius) < 0.01 * e for e in across) else None


def body_part(
    brep: Brep,
    record: BodyRecord,
    number: int,
    tolerances: Tolerances,
    bosses: Sequence[Boss] = (),
    holes: Sequence[Hole] = (),
) -> Part:
    """A body of the file as a part, so that names and colours find it. A round one has radii, axis and length too."""
    box = faces_box(brep, record.faces)
    extents = box_extents(box)
    tags, thickness = _outline(brep, record, tolerances)
    round_boss = _round_body(record, bosses, extents)
    measures: dict[str, object] = {} if thickness is None else {"thickness": thickness}
    if round_boss is not None:
        axis = Axis(round_boss.base, round_boss.normal)
        along = sum(e * abs(n) for e, n in zip(extents, round_boss.normal, strict=True))
        bores = [h for h in holes if h.body == record.id and axis.radius_of(h.center) < 0.01 * round_boss.radius]
        bore = max(bores, key=lambda h: h.radius, default=None)
        measures |= {
            "axis": round_boss.normal,
            "radius": round_boss.radius,
            "diameter": 2 * round_boss.radius,
            "length": along,
            "radii": (round_boss.radius,) if bore is None else (round_boss.radius, bore.radius),
        }
        slender = along > 2 * round_boss.radius
        if slender:
            measures["height"] = along
        elif along < round_boss.radius:
            measures["thickness"] = along
        tags = (*tags, "circular", "cylindrical", *(("hollow",) if bore else ()), *(("slender",) if slender else ()))
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


def model_part(brep: Brep, shape: Shape) -> Part:
    """The whole model as a part, so that its name finds it."""
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
    )
