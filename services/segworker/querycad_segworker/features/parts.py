"""Feature records become parts: ids, labels, measures and reasons as users and generated code see them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from querycad_contracts import Evidence, Part, Vector
from querycad_segworker.topology import Brep
from querycad_segworker.vectors import Box, box_center, box_extents, box_union, mid

from .blends import Blend
from .bosses import Boss
from .depression import ELONGATED, Depression, DepressionKind
from .gears import Gear
from .grooves import TurnedGroove
from .holes import Hole
from .margins import edge_distance
from .prisms import Prism
from .protrusions import Protrusion
from .ribs import Rib
from .walls import Wall


def millimetres(length_m: float) -> str:
    """How is a length written in a label? Millimetres, at most three decimals: '5.5 mm'."""
    return f"{length_m * 1e3:.3f}".rstrip("0").rstrip(".") + " mm"


def faces_box(brep: Brep, faces: Iterable[int]) -> Box:
    """Which exact box holds these faces?"""
    box = box_union(brep.faces[face].box for face in faces)
    if box is None:
        raise ValueError("a part needs at least one face")
    return box


def faces_area(brep: Brep, faces: Iterable[int]) -> float:
    """How large are these faces together, in m2?"""
    return sum(brep.faces[face].area for face in faces)


ALIGNED = 0.9998
"""Cosine of one degree: what deviates less runs along an axis of the file."""
PLATE_RATIO = 0.35
"""A body thinner than this share of its smaller other extent is a plate."""

_HOLE_ADJECTIVES = ("threaded", "countersunk", "counterbored", "conical")


def hole_part(brep: Brep, hole: Hole, number: int) -> Part:
    """A hole or ring groove as a part.

    A hole's width is that of its widest step, a groove's that of the gap; the diameter is that of the bore.
    """
    kind = "groove" if hole.is_ring else "hole"
    adjective = next((tag for tag in _HOLE_ADJECTIVES if tag in hole.tags), None)
    form = "through" if hole.far_opening is not None else "blind"
    words = " ".join(word for word in (adjective, form, kind) if word)
    widest = max((hole.opening_radius, hole.radius, *hole.steps))
    box = faces_box(brep, hole.faces)
    width = widest - hole.core_radius if hole.core_radius is not None else 2 * widest
    return Part(
        id=f"{kind}-{number}",
        kind=kind,
        tags=(*tuple(t for t in hole.tags if t not in ("through", "blind")), "ring", "annular")
        if hole.is_ring
        else hole.tags,
        label=f"{words}, diameter {millimetres(2 * hole.radius)}, depth {millimetres(hole.depth)}",
        faces=hole.faces,
        center=hole.center,
        extents=box_extents(box),
        axis=hole.normal,
        normal=hole.normal,
        radius=hole.radius,
        diameter=2 * hole.radius,
        depth=hole.depth,
        width=width,
        length=2 * widest,
        opening=hole.opening,
        bottom=hole.bottom.value,
        local_size=(2 * widest, 2 * widest, hole.depth),
        area=faces_area(brep, hole.faces),
        radii=(hole.steps or (hole.radius,)) + (() if hole.core_radius is None else (hole.core_radius,)),
        edge_distance=edge_distance(brep, hole.faces, hole.opening, hole.normal, hole.opening_radius),
        evidence=_geometry(
            f"{len(hole.faces)} face(s) around one axis: concave walls of radius "
            + ", ".join(millimetres(r) for r in (hole.steps or (hole.radius,)))
            + (", open at both ends" if hole.far_opening is not None else ", open at one end")
        ),
    )


def boss_part(brep: Brep, boss: Boss, number: int, holes: Sequence[Part]) -> Part:
    """A round protrusion as a part; its height runs along its own axis from base to tip, its depth is its bore's."""
    if boss.hole is not None and "flat" not in boss.tags:
        name = "standoff"
    elif "slender" in boss.tags:
        name = "shaft"
    else:
        name = "cone" if "conical" in boss.tags else "disc" if "flat" in boss.tags else "boss"
    box = faces_box(brep, boss.faces)
    bore = None if boss.hole is None else holes[boss.hole]
    radii = (boss.radius,) if bore is None else (boss.radius, bore.radius or 0.0)
    return Part(
        id=f"boss-{number}",
        kind="boss",
        tags=boss.tags,
        label=f"{name}, diameter {millimetres(2 * boss.radius)}, height {millimetres(boss.height)}",
        faces=boss.faces,
        center=mid(boss.base, boss.tip),
        extents=box_extents(box),
        axis=boss.normal,
        normal=boss.normal,
        radius=boss.radius,
        diameter=2 * boss.radius,
        height=boss.height,
        depth=None if bore is None else bore.depth,
        width=2 * boss.radius,
        length=max(boss.height, 2 * boss.radius),
        thickness=boss.height if "flat" in boss.tags else None,
        tip=boss.tip,
        local_size=(2 * boss.radius, 2 * boss.radius, boss.height),
        area=faces_area(brep, boss.faces),
        radii=radii,
        children=() if bore is None else (bore.id,),
        evidence=_geometry(
            f"a convex {'cone' if 'conical' in boss.tags else 'cylinder'} around one axis, "
            f"radius {millimetres(boss.radius)}, one end free"
        ),
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
        evidence=_geometry(
            f"a {'convex' if wall.outward > 0 else 'concave'} cylinder of radius {millimetres(wall.radius)}"
        ),
    )


_DEPRESSION_NAMES = {DepressionKind.PASSAGE: "cutout"}


def turned_groove_part(brep: Brep, found: TurnedGroove, number: int) -> Part:
    """A groove around a shaft; its diameter is that of its bottom."""
    return Part(
        id=f"turned-groove-{number}",
        kind="groove",
        tags=("outer", "annular", "circular"),
        label=f"groove, width {millimetres(found.width)}, diameter {millimetres(2 * found.radius)} at its bottom",
        faces=found.faces,
        center=found.center,
        extents=box_extents(faces_box(brep, found.faces)),
        axis=found.axis,
        radius=found.radius,
        diameter=2 * found.radius,
        depth=found.depth,
        width=found.width,
        area=faces_area(brep, found.faces),
        radii=(found.radius,),
        evidence=_geometry("a cylinder between two wider ones on the same axis"),
    )


def depression_part(brep: Brep, found: Depression, number: int) -> Part:
    """A pocket, cutout, slot, channel, step or notch as a part; its depth goes into the material from the opening."""
    kind = _DEPRESSION_NAMES.get(found.kind, found.kind.value)
    through = found.kind is DepressionKind.PASSAGE
    tags = [found.outline, "through" if through else "blind", "open" if found.is_open else "closed"]
    if found.length >= ELONGATED * found.width:
        tags.append("elongated")
    if found.corner_radius is not None and found.outline != "obround":
        tags.append("rounded_corners")
    size = " x ".join(millimetres(v).removesuffix(" mm") for v in (found.length, found.width))
    extents = box_extents(faces_box(brep, found.faces))
    across_file = found.outline == "rectangular" and not found.is_open
    return Part(
        id=f"{kind}-{number}",
        kind=kind,
        tags=tuple(tags),
        label=f"{_outlined(found.outline, kind)}, {size} mm, depth {millimetres(found.depth)}",
        faces=found.faces,
        center=found.center,
        extents=extents,
        axis=found.normal,
        normal=found.normal,
        radius=found.corner_radius,
        depth=found.depth,
        width=_width(found.normal, extents, found.width) if across_file else found.width,
        length=found.length,
        opening=found.opening,
        bottom="through" if through else "open" if found.is_open else "flat",
        local_size=(found.length, found.width, found.depth),
        area=faces_area(brep, found.faces),
        evidence=_geometry(
            f"{len(found.faces)} faces sunk into the material, "
            + ("closed all around" if not found.is_open else "meeting in concave edges and open at a border")
        ),
    )


def protrusion_part(brep: Brep, found: Protrusion, number: int) -> Part:
    """A protrusion of any outline but a circle."""
    size = " x ".join(millimetres(v).removesuffix(" mm") for v in (found.length, found.width))
    extents = box_extents(faces_box(brep, found.faces))
    return Part(
        id=f"protrusion-{number}",
        kind="protrusion",
        tags=(found.outline, *found.tags),
        label=f"{_outlined(found.outline, 'protrusion')}, {size} mm, height {millimetres(found.height)}",
        faces=found.faces,
        center=found.center,
        extents=extents,
        axis=found.normal,
        normal=found.normal,
        height=found.height,
        width=found.width if "rib" in found.tags else _width(found.normal, extents, found.width),
        length=found.length,
        thickness=found.width if "rib" in found.tags else None,
        tip=found.tip,
        local_size=(found.length, found.width, found.height),
        area=faces_area(brep, found.faces),
        evidence=_geometry(f"{len(found.faces)} faces that rise from a face inside one of its boundary loops"),
    )


def prism_part(brep: Brep, prism: Prism, number: int) -> Part:
    """A prism as a part; its width is the smaller of its two cross dimensions: across flats, of a hexagon."""
    size = " x ".join(millimetres(v).removesuffix(" mm") for v in (prism.length, prism.width))
    flat = prism.height < PLATE_RATIO * prism.width
    return Part(
        id=f"prism-{number}",
        kind="prism",
        tags=(prism.outline, *(("plate", "flat") if flat else ())),
        label=f"{prism.outline} {'plate' if flat else 'block'}, {size} mm, height {millimetres(prism.height)}",
        faces=prism.faces,
        center=prism.center,
        extents=box_extents(faces_box(brep, prism.faces)),
        axis=prism.normal,
        normal=prism.normal,
        height=prism.height,
        width=prism.width,
        length=prism.length,
        thickness=prism.height if flat else None,
        tip=prism.tip,
        local_size=(prism.length, prism.width, prism.height),
        area=faces_area(brep, prism.faces),
        evidence=_geometry(f"{prism.sides} plane sides that meet in convex edges, all the way around one direction"),
    )


def rib_part(brep: Brep, found: Rib, number: int, is_fin: bool) -> Part:
    """A rib or fin; its width is its thickness."""
    name = "fin" if is_fin else "rib"
    return Part(
        id=f"rib-{number}",
        kind="rib",
        tags=(("fin",) if is_fin else ()) + ("rectangular",),
        label=f"{name}, thickness {millimetres(found.thickness)}, height {millimetres(found.height)}, "
        f"length {millimetres(found.length)}",
        faces=found.faces,
        center=found.center,
        extents=box_extents(faces_box(brep, found.faces)),
        axis=found.normal,
        normal=found.normal,
        height=found.height,
        width=found.thickness,
        thickness=found.thickness,
        length=found.length,
        tip=found.tip,
        local_size=(found.length, found.thickness, found.height),
        area=faces_area(brep, found.faces),
        evidence=_geometry("a narrow top face between two parallel flanks that stand on the material"),
    )


def blend_part(brep: Brep, found: Blend, number: int) -> Part:
    """A fillet, round or chamfer."""
    chamfer = found.kind == "chamfer"
    measure = f"width {millimetres(found.width)}" if chamfer else f"radius {millimetres(found.radius)}"
    return Part(
        id=f"{found.kind}-{number}",
        kind=found.kind,
        tags=("beveled",) if chamfer else ("rounded", "inner" if found.kind == "fillet" else "outer"),
        label=f"{found.kind}, {measure}",
        faces=found.faces,
        center=found.center,
        extents=box_extents(found.box),
        radius=None if chamfer else found.radius,
        diameter=None if chamfer else 2 * found.radius,
        width=found.width if chamfer else None,
        area=faces_area(brep, found.faces),
        evidence=_geometry(
            f"{len(found.faces)} narrow face(s) between two convex edges"
            if chamfer
            else f"{len(found.faces)} face(s) tangent to their neighbours, radius {millimetres(found.radius)}"
        ),
    )


def arc_part(brep: Brep, wall: Wall, number: int) -> Part:
    """A cylindrical wall that does not enclose its axis: a semicircular notch or rounded end."""
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
        depth=wall.height,
        length=wall.height,
        width=2 * wall.radius if half else None,
        area=faces_area(brep, wall.faces),
        radii=(wall.radius,),
        evidence=_geometry(
            f"a cylinder of radius {millimetres(wall.radius)} over {math.degrees(wall.sweep):.0f} degrees"
        ),
    )


def gear_part(brep: Brep, gear: Gear, number: int) -> Part:
    """A gear as a part: diameter over the tips, width along the axis; `radii` are tip and root."""
    name = "internal gear" if gear.internal else "gear"
    return Part(
        id=f"gear-{number}",
        kind="gear",
        tags=("inner",) if gear.internal else ("outer",),
        label=f"{name}, {len(gear.teeth)} teeth, tip diameter {millimetres(2 * gear.tip_radius)}",
        faces=gear.faces,
        center=gear.center,
        extents=box_extents(faces_box(brep, gear.faces)),
        axis=gear.axis.direction,
        radius=gear.tip_radius,
        diameter=2 * gear.tip_radius,
        height=gear.width,
        width=gear.width,
        thickness=gear.width,
        radii=(gear.tip_radius, gear.root_radius),
        children=tuple(f"tooth-{number}.{i}" for i in range(1, len(gear.teeth) + 1)),
        area=faces_area(brep, gear.faces),
        evidence=_geometry(f"{len(gear.teeth)} equal groups of faces at equal angles around one axis"),
    )


def tooth_parts(brep: Brep, gear: Gear, number: int) -> list[Part]:
    """The teeth of a gear as parts."""
    height = abs(gear.tip_radius - gear.root_radius)
    return [
        Part(
            id=f"tooth-{number}.{i}",
            kind="tooth",
            label=f"tooth {i} of gear {number}",
            faces=tooth.faces,
            center=box_center(faces_box(brep, tooth.faces)),
            extents=box_extents(faces_box(brep, tooth.faces)),
            height=height,
            length=gear.width,
            tip=tooth.tip,
            evidence=_geometry(f"one of {len(gear.teeth)} equal groups of faces around an axis"),
        )
        for i, tooth in enumerate(gear.teeth, start=1)
    ]


def _width(normal: Vector, extents: Vector, across: float) -> float:
    """The width of something rectangular: along x, or along y where it faces left or right.

    What stands oblique in the file has its own: `across`, the smaller of its two dimensions.
    """
    along = max(range(3), key=lambda i: abs(normal[i]))
    if abs(normal[along]) < ALIGNED:
        return across
    return extents[1] if along == 0 else extents[0]


def _outlined(outline: str, name: str) -> str:
    return name if outline == "free" else f"{outline} {name}"


def _geometry(reason: str) -> Evidence:
    return Evidence(source="geometry", confidence=1.0, reason=reason)
