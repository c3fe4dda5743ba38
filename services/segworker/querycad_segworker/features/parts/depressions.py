"""Records of what is cut in, and of broken or rounded edges, become parts."""

from __future__ import annotations

import math
from collections.abc import Sequence

from querycad_contracts import Bottom, Part, SurfaceKind
from querycad_segworker.features.blends.fillets_chamfers import Blend
from querycad_segworker.features.depressions.depression import ELONGATED, Depression, DepressionKind
from querycad_segworker.features.shared.frames import POLYGONS
from querycad_segworker.features.shared.part_measures import (
    ALIGNED,
    UPRIGHT,
    faces_area,
    faces_box,
    geometry,
    millimetres,
    outlined,
)
from querycad_segworker.features.shared.refusals import refuse
from querycad_segworker.features.turned.grooves import TurnedGroove
from querycad_segworker.tolerances import exceeds, reaches
from querycad_segworker.topology import Brep
from querycad_segworker.vectors import box_extents, cross

from .flat_walls import FlatWall
from .volumes import Volumes

ALONG = frozenset(("rectangular", "obround", "curved"))
"""Outlines with two sides along each other: what is longer than wide within them is a slot, as no other shape is."""
SECTIONS = {"dovetail": "dovetail", "t_slot": "T", "v_shaped": "V"}
"""What slots are called by their cross-section."""
_DEPRESSION_NAMES = {DepressionKind.PASSAGE: "cutout"}


_RUNNING = (DepressionKind.SLOT, DepressionKind.CHANNEL, DepressionKind.GROOVE)
"""What is as wide at its mouth as it is called wide."""


def without_corners_of_walls(
    depressions: Sequence[Depression], walls: Sequence[FlatWall]
) -> tuple[list[Depression], list[Depression]]:
    """Cuts, and apart from them steps that are only the inside of a corner of two walls, as of an angle bracket.

    Floor and wall of such a step are sides of walls that are thinner than it is deep, long and wide.
    """
    cuts, corners = list[Depression](), list[Depression]()
    for found in depressions:
        if found.kind is DepressionKind.STEP and _is_corner(found, walls):
            refuse("step", found.faces, "it is the inside of the corner of two walls")
            corners.append(found)
        else:
            cuts.append(found)
    return cuts, corners


def _is_corner(step: Depression, walls: Sequence[FlatWall]) -> bool:
    least = min(step.depth, step.length, step.width)
    thin = [wall.faces for wall in walls if exceeds(least, wall.thickness)]
    below = {face for faces in thin if not set(step.floor).isdisjoint(faces) for face in faces}
    beside = (faces for faces in thin if below.isdisjoint(faces))
    return bool(below) and any(not set(step.faces).isdisjoint(faces) for faces in beside)


def depression_part(brep: Brep, found: Depression, number: int, volumes: Volumes) -> Part:
    """A pocket, cutout, slot, channel, step or notch as a part; its depth goes into the material from the opening.

    That of a slot through a plate goes in from the plate's edge, as its length does.
    """
    kind = _DEPRESSION_NAMES.get(found.kind, found.kind.value)
    from_edge = "through" in found.tags
    through = from_edge or found.kind is DepressionKind.PASSAGE
    tags = [found.outline, "through" if through else "blind", "open" if found.is_open else "closed"]
    if reaches(found.length, ELONGATED * found.width) and (found.is_open or found.outline in ALONG):
        tags.append("elongated")
    if found.corner_radius is not None and found.outline in (*POLYGONS.values(), "polygonal"):
        tags.append("rounded_corners")
    tags.extend(tag for tag in found.tags if tag not in tags)
    extents = box_extents(faces_box(brep, found.faces))
    if found.kind is DepressionKind.STEP:  # its wall may end at a chamfer
        x, y, z = (
            max(size, found.depth) if abs(along) > ALIGNED else size
            for size, along in zip(extents, found.normal, strict=True)
        )
        extents = (x, y, z)
    if found.kind is DepressionKind.POCKET and found.is_open:  # its floor may run on into an outlet
        across = cross(found.normal, found.direction)
        ways = ((found.direction, found.length), (across, found.width), (found.normal, found.depth))
        x, y, z = (min(extents[i], sum(abs(way[i]) * size for way, size in ways)) for i in range(3))
        extents = (x, y, z)
    across_file = found.outline == "rectangular" and not found.is_open
    is_round = found.outline == "circular" and not found.is_open
    return Part(
        id=f"{kind}-{number}",
        kind=kind,
        tags=tuple(tags),
        label=f"{_name(found, kind)}, {millimetres(found.length, found.width)}, "
        + (f"through {millimetres(found.depth)}" if from_edge else f"depth {millimetres(found.depth)}"),
        faces=found.faces,
        center=found.center,
        extents=extents,
        axis=found.normal,
        normal=found.normal,
        radius=found.width / 2 if is_round else found.corner_radius,
        diameter=found.width if is_round else None,
        depth=found.length if from_edge else found.depth,
        width=_width(found) if across_file else found.width,
        length=found.length,
        opening=None if found.kind is DepressionKind.CAVITY else found.opening,
        bottom=_bottom(found, through),
        local_size=(found.length, found.floor_width or found.width, found.depth),
        mouth_width=found.width if found.kind in _RUNNING else None,
        bottom_width=found.floor_width,
        angle=found.angle,
        volume=volumes.of(found),
        area=faces_area(brep, found.faces),
        evidence=geometry(
            f"{len(found.faces)} faces sunk into the material, "
            + ("closed all around" if not found.is_open else "meeting in concave edges and open at a border")
        ),
    )


def _name(found: Depression, kind: str) -> str:
    """What is it called? By its cross-section where that has a name, else by its outline."""
    section = next((name for tag, name in SECTIONS.items() if tag in found.tags), None)
    return outlined(found.outline, kind) if section is None else f"{section} {kind}"


def _bottom(found: Depression, through: bool) -> Bottom | None:
    if found.kind is DepressionKind.CAVITY:
        return None
    return Bottom.THROUGH if through else Bottom.OPEN if found.is_open else Bottom.FLAT


def _width(found: Depression) -> float:
    """The width of something rectangular in an upright wall: along x, or along y where it opens left or right.

    What opens up or down, or stands oblique in the file, has its own: the smaller of its two dimensions. A groove that
    closes on itself has its own, too: from wall to wall.
    """
    if found.kind is DepressionKind.GROOVE or abs(found.normal[2]) > ALIGNED:
        return found.width
    opens_sideways = abs(found.normal[0]) > ALIGNED
    along = abs(found.direction[1 if opens_sideways else 0])
    aligned = max(abs(c) for c in found.normal) > ALIGNED
    return found.length if aligned and along > ALIGNED else found.width


def turned_groove_part(brep: Brep, found: TurnedGroove, number: int) -> Part:
    """A groove around a shaft or in a bore; its diameter is that of its bottom, its width that of its mouth."""
    section = found.section.replace("v_shaped", "V")
    name = "groove" if found.section == "rectangular" else f"{section} groove"
    place = "in a bore, " if found.inner else ""
    return Part(
        id=f"turned-groove-{number}",
        kind="groove",
        tags=("inner" if found.inner else "outer", "annular", "circular", "turned", found.section),
        label=f"{name}, {place}width {millimetres(found.width)}, bottom diameter {millimetres(2 * found.radius)}",
        faces=found.faces,
        center=found.center,
        extents=box_extents(faces_box(brep, found.faces)),
        axis=found.axis,
        radius=found.radius,
        diameter=2 * found.radius,
        depth=found.depth,
        width=found.width,
        mouth_width=found.width,
        bottom_width=found.floor_width,
        angle=found.angle,
        area=faces_area(brep, found.faces),
        radii=(found.radius,),
        evidence=geometry(
            f"a {section} neck {'wider' if found.inner else 'narrower'} than the walls on both sides of it, on one axis"
        ),
    )


def blend_part(brep: Brep, found: Blend, number: int) -> Part:
    """A fillet, round or chamfer."""
    chamfer = found.kind == "chamfer"
    measure = _chamfer_measure(found) if chamfer else f"radius {millimetres(found.radius)}"
    return Part(
        id=f"{found.kind}-{number}",
        kind=found.kind,
        tags=(*(("beveled",) if chamfer else _rounded_tags(found)), *_edge_tags(brep, found)),
        label=f"{found.kind}, {measure}",
        faces=found.faces,
        center=found.center,
        extents=box_extents(found.box),
        radius=None if chamfer else found.radius,
        diameter=None if chamfer else 2 * found.radius,
        radii=found.radii,
        width=found.width if chamfer else None,
        angle=found.angle,
        area=faces_area(brep, found.faces),
        evidence=geometry(
            f"{len(found.faces)} narrow face(s) between two convex edges"
            if chamfer
            else f"{len(found.faces)} face(s) tangent to their neighbours, radius {millimetres(found.radius)}"
        ),
    )


def _rounded_tags(found: Blend) -> tuple[str, ...]:
    side = "inner" if found.kind == "fillet" else "outer"
    return ("rounded", side, "variable") if found.radii else ("rounded", side)


def _edge_tags(brep: Brep, found: Blend) -> tuple[str, ...]:
    """'vertical', 'horizontal': the straight edges that were rounded or bevelled."""
    faces = [brep.faces[face] for face in found.faces]
    straight = SurfaceKind.PLANE if found.kind == "chamfer" else SurfaceKind.CYLINDER
    rises = [abs(face.axis[2]) for face in faces if face.kind is straight]
    if len(rises) < len(faces):
        return ()
    lying = all(rise < UPRIGHT for rise in rises)
    if found.kind == "chamfer":  # of a plane the normal, square to its edge
        return ("vertical",) if lying else ()
    return ("horizontal",) if lying else ("vertical",) if min(rises) > 1 - UPRIGHT**2 else ()


def _chamfer_measure(found: Blend) -> str:
    """As on drawings: leg and angle where it is even, else the width of the face."""
    if found.angle is not None and abs(found.angle - math.pi / 4) < math.radians(0.5):
        return f"{millimetres(found.width * math.sqrt(0.5))} x 45 degrees, width {millimetres(found.width)}"
    return f"width {millimetres(found.width)}"
