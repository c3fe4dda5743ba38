"""Bodies of the file: by name, colour, outline and, where they are round, by radius and axis."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from querycad_contracts import Body, Evidence, Part, Shape, SurfaceKind
from querycad_segworker.tolerances import Tolerances
from querycad_segworker.topology import BodyRecord, Brep
from querycad_segworker.vectors import box_center, box_extents, cross, dot, mid, perpendicular

from .bosses import Boss
from .frames import outline_of
from .hole import Bottom, Hole
from .parts import PLATE_RATIO, faces_box
from .walls import Axis

RING_RATIO = 0.3
"""The hole of a ring or tube takes at least this share of its diameter: a third in washers of the large series
(ISO 7093), a half in those of the normal one (ISO 7089), more in sleeves."""
WASHER_RATIO = 0.25
"""A plain ring thinner than this share of its diameter is a washer: ISO 7089 has 0.1 to 0.2, spring washers 0.25."""


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


@dataclass(frozen=True, slots=True)
class _Turned:
    """A body that is round about one axis: its widest step, its length along the axis, and its coaxial hole."""

    widest: Boss
    length: float
    bore: Hole | None
    steps: int
    walled: bool
    """A step of it is a tube."""

    @property
    def tags(self) -> tuple[str, ...]:
        """What kinds of turned part is it?"""
        diameter = 2 * self.widest.radius
        tags = ["circular", "cylindrical"]
        slender = self.length > diameter
        if slender:
            tags.append("slender")
        if self.bore is not None:
            tags.append("hollow")
        through = self.bore is not None and self.bore.bottom is Bottom.THROUGH
        wide = through and self.bore is not None and self.bore.radius >= RING_RATIO * self.widest.radius
        if wide and self.length < 0.5 * diameter:
            tags.extend(("ring", "washer") if self.steps == 1 and self.length < WASHER_RATIO * diameter else ("ring",))
        elif through and (wide or self.walled):
            tags.append("tube")
        elif slender and self.steps > 1:
            tags.append("shaft")
        elif slender:
            tags.extend(("shaft", "rod"))
        elif self.length < 0.5 * diameter:
            tags.append("disc")
        return tuple(tags)


def _turned(brep: Brep, record: BodyRecord, bosses: Sequence[Boss], holes: Sequence[Hole]) -> _Turned | None:
    """Is the whole body round? It is when no edge lies further from a boss's axis than that boss's wall."""
    widest = max(bosses, key=lambda boss: boss.radius, default=None)
    if widest is None or "conical" in widest.tags:
        return None
    axis = Axis(widest.base, widest.normal)
    edges = {e for face in record.faces for e in brep.face_edges[face]}
    points = [p for e in edges for p in (brep.edges[e].start, brep.edges[e].mid, brep.edges[e].end)]
    if max(axis.radius_of(p) for p in points) > 1.005 * widest.radius:
        return None
    steps = [b for b in bosses if axis.radius_of(mid(b.base, b.tip)) < 0.01 * widest.radius]
    ends = [axis.position(p) for p in points] + [axis.position(p) for b in steps for p in (b.base, b.tip)]
    coaxial = [h for h in holes if not h.is_ring and axis.radius_of(h.center) < 0.01 * widest.radius]
    bore = max(coaxial, key=lambda h: (h.bottom is Bottom.THROUGH, h.radius), default=None)
    return _Turned(widest, max(ends) - min(ends), bore, len(steps), any("tube" in b.tags for b in steps))


def body_part(
    brep: Brep,
    record: BodyRecord,
    number: int,
    tolerances: Tolerances,
    bosses: Sequence[Boss] = (),
    holes: Sequence[Hole] = (),
) -> Part:
    """A body of the file as a part, so that names and colours find it. A round one has radii, axis and length too.

    `bosses` and `holes` are those of this body. A ring or disc is as thick as it is long, a tube as its wall is.
    """
    box = faces_box(brep, record.faces)
    extents = box_extents(box)
    tags, thickness = _outline(brep, record, tolerances)
    measures: dict[str, object] = {} if thickness is None else {"thickness": thickness}
    turned = _turned(brep, record, bosses, holes)
    ball = None if turned is not None else _ball(brep, record)
    if ball is not None:
        tags = (*tags, "ball", "spherical")
        measures |= {"radius": ball, "diameter": 2 * ball, "radii": (ball,)}
    if turned is not None:
        radius, bore = turned.widest.radius, turned.bore
        measures |= {
            "axis": turned.widest.normal,
            "radius": radius,
            "diameter": 2 * radius,
            "length": turned.length,
            "radii": (radius,) if bore is None else (radius, bore.radius),
        }
        tags = (*tags, *turned.tags)
        if "slender" in tags:
            measures["height"] = turned.length
        if "tube" in tags and bore is not None:
            measures["thickness"] = radius - bore.radius
        elif turned.length < radius:
            measures["thickness"] = turned.length
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


def _ball(brep: Brep, record: BodyRecord) -> float | None:
    """The radius of a body whose surface is nothing but one sphere."""
    faces = [brep.faces[f] for f in record.faces]
    first = faces[0]
    if any(f.kind is not SurfaceKind.SPHERE or abs(f.radius - first.radius) > 1e-3 * first.radius for f in faces):
        return None
    return first.radius if first.outward > 0 else None


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
