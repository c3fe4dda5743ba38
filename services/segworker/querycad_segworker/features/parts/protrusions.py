"""Records of what stands out with plane sides become parts: protrusions, prisms, ribs, gears and their teeth."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Collection, Mapping, Sequence

from querycad_contracts import Part, PartKind, Vector
from querycad_segworker.features.protrusions.arms import Arm
from querycad_segworker.features.protrusions.prisms import Prism
from querycad_segworker.features.protrusions.protrusions import Protrusion
from querycad_segworker.features.protrusions.ribs import Rib
from querycad_segworker.features.shared.frames import face_points
from querycad_segworker.features.shared.part_measures import (
    PLATE_RATIO,
    UPRIGHT,
    faces_area,
    faces_box,
    geometry,
    millimetres,
    outlined,
    width_of,
)
from querycad_segworker.features.shared.refusals import refuse
from querycad_segworker.features.sheet.hollow_sections import HollowSection
from querycad_segworker.features.turned.gears import Gear
from querycad_segworker.features.turned.knurls import Knurl
from querycad_segworker.tolerances import FACING, exceeds, reaches
from querycad_segworker.topology import Brep, EdgeConvexity
from querycad_segworker.vectors import add, box_center, box_extents, box_of, dot, scale, sub

from .volumes import Volumes

HEADS = ("hexagonal", "octagonal")
"""Outlines of heads and nuts, whose height is along their own axis."""
_MADE_OF_PIECES = (PartKind.WALL, PartKind.GEAR, PartKind.TOOTH, PartKind.PIPE)
_WALLS = (PartKind.WALL, PartKind.FLOOR, PartKind.RIB)
_LEAVING = (PartKind.SLOT, PartKind.POCKET, PartKind.NOTCH)
UNDERCUT = frozenset(("t_slot", "dovetail"))
"""Slots that are wider below their mouth."""
SAME = 1e-3
"""Lengths that differ by less than this share are one: files are exact, but for what converting them rounds."""
TAKEN = 0.5
"""A ledge with more than this share of its surface, or with its largest face, in a part is that part."""
BAR_RATIO = 3.0
"""A bar is longer than three times its second dimension."""


def protrusion_part(
    brep: Brep, found: Protrusion, number: int, volumes: Volumes, kind: PartKind = PartKind.PROTRUSION
) -> Part:
    """A protrusion of any outline but a circle, or what stands out without a family."""
    extents = box_extents(_box_above_foot(brep, found))
    return Part(
        id=f"{kind}-{number}",
        kind=kind,
        tags=(found.outline, *found.tags),
        label=f"{outlined(found.outline, kind)}, {millimetres(found.length, found.width)}, "
        f"height {millimetres(found.height)}",
        faces=found.faces,
        center=found.center,
        extents=extents,
        axis=found.normal,
        normal=found.normal,
        height=found.height,
        width=found.width if "rib" in found.tags else width_of(found.normal, extents, (found.length, found.width)),
        length=found.length,
        thickness=found.width if "rib" in found.tags else None,
        tip=found.tip,
        local_size=(found.length, found.width, found.height),
        volume=volumes.of_protrusion(found),
        area=faces_area(brep, found.faces),
        evidence=geometry(f"{len(found.faces)} faces that rise from what they stand on, closed off by concave edges"),
    )


def _box_above_foot(brep: Brep, found: Protrusion) -> tuple[Vector, Vector]:
    """The box of its faces; of a hole in its top, that is deeper than it is high, no more than what lies in it."""
    box, foot = faces_box(brep, found.faces), dot(found.base, found.normal)
    points = face_points(brep, found.faces)
    if all(dot(point, found.normal) >= foot for point in points):
        return box
    return box_of(add(p, scale(found.normal, max(0.0, foot - dot(p, found.normal)))) for p in points) or box


def ledge_parts(brep: Brep, ledges: Sequence[Protrusion], parts: Sequence[Part], volumes: Volumes) -> list[Part]:
    """Ledges as elevations, numbered after those among `parts`; none that is a wall, rib or other part already.

    What has no face but those of one cut is what the cut leaves: the shaft beyond a keyway, the lip of a T slot. So is
    what rises only from the walls of slots narrower than itself, or undercut ones, and what rises along the rims of
    thin walls: their outline. A plate beyond what stands on it is that plate. A ledge is as thick as the lesser side of
    its foot.
    """
    standing = [part for part in parts if part.kind.stands_out or part.kind in _MADE_OF_PIECES]
    number = sum(part.kind is PartKind.ELEVATION for part in parts)
    cuts = [frozenset(part.faces) for part in parts if part.kind.cuts_in]
    leaving: dict[int, list[Part]] = defaultdict(list)
    for part in parts:
        for face in part.faces if part.kind in _LEAVING else ():
            leaving[face].append(part)
    rims = {face for part in parts if "planar" in part.tags and part.kind in _WALLS for face in _rims(brep, part)}
    found: list[Part] = []
    for ledge in ledges:
        if ledge.feet and rims.issuperset(ledge.feet):
            refuse("elevation", ledge.faces, "it is the outline of thin walls")
            continue
        if any(cut.issuperset(ledge.faces) for cut in cuts) or _is_left_by_slots(ledge, leaving):
            continue
        whole, largest = faces_area(brep, ledge.faces), max(ledge.faces, key=lambda face: brep.faces[face].area)
        shared = [(part, set(ledge.faces).intersection(part.faces)) for part in standing]
        same = (faces for part, faces in shared if part.kind is not PartKind.PRISM or _is_most(brep, faces, part))
        if any(largest in faces or faces_area(brep, faces) > TAKEN * whole for faces in same):
            continue
        if any(_is_strip_of(ledge, part) for part in standing if part.kind is PartKind.PRISM and "plate" in part.tags):
            continue
        part = protrusion_part(brep, ledge, number + len(found) + 1, volumes, PartKind.ELEVATION)
        found.append(part.model_copy(update={"tags": (*part.tags, "ledge"), "thickness": ledge.width}))
    return found


def _rims(brep: Brep, wall: Part) -> set[int]:
    """The faces between the two sides of a flat wall, along its border, where it is thin."""
    normal = wall.normal
    if normal is None or reaches(wall.thickness or 0.0, PLATE_RATIO * (wall.width or 0.0)):
        return set()
    sides = ({i for i in wall.faces if sign * dot(brep.faces[i].axis, normal) > FACING.alike} for sign in (1.0, -1.0))
    one, other = ({i for face in side for i in brep.beside(face, EdgeConvexity.CONVEX)} for side in sides)
    own = {i for i in wall.faces if abs(dot(brep.faces[i].facing, normal)) < UPRIGHT}  # of a gusset
    return one & other | own


def _is_left_by_slots(ledge: Protrusion, leaving: Mapping[int, Sequence[Part]]) -> bool:
    """Does it rise only from walls of slots, pockets or notches that are narrower than itself, or undercut?

    `leaving`: the slots, pockets and notches that each face belongs to.
    """
    return bool(ledge.feet) and all(
        any(
            not exceeds(cut.width or 0.0, ledge.width) or not UNDERCUT.isdisjoint(cut.tags)
            for cut in leaving.get(foot, ())
        )
        for foot in ledge.feet
    )


def _is_strip_of(ledge: Protrusion, plate: Part) -> bool:
    """Is it a strip of this plate, as thick as that and along its full length or width?"""
    if plate.local_size is None or not set(ledge.faces) <= set(plate.faces):
        return False
    *sides, thickness = plate.local_size
    whole = any(math.isclose(ledge.length, side, rel_tol=SAME) for side in sides)
    return whole and math.isclose(ledge.width, thickness, rel_tol=SAME)


def _is_most(brep: Brep, faces: Collection[int], part: Part) -> bool:
    """Are they most of the surface of a part? A block that a ledge is left of is more than that ledge."""
    return faces_area(brep, faces) > TAKEN * faces_area(brep, part.faces)


def prism_part(brep: Brep, prism: Prism, number: int) -> Part:
    """A prism as a part; its width is the smaller of its two cross dimensions: across flats, of a hexagon.

    A plate that stands upright is as high as it reaches; the head of a screw is not, whichever way the screw lies. A
    bar is as thick as its smallest dimension, a hexagon as it is along its axis where that is less than across flats.
    """
    flat = not prism.sides or not reaches(prism.height, PLATE_RATIO * prism.width)  # a base may be thicker
    upright = flat and abs(prism.normal[2]) < UPRIGHT and prism.outline not in HEADS
    thin, second, longest = sorted((prism.length, prism.width, prism.height))
    slender = exceeds(longest, BAR_RATIO * second)
    is_head = prism.outline in HEADS and prism.height < prism.width
    return Part(
        id=f"prism-{number}",
        kind="prism",
        tags=(prism.outline, *(("plate", "flat") if flat else ()), *(("slender",) if slender else ())),
        label=f"{outlined(prism.outline, 'plate' if flat else 'block')}, {millimetres(prism.length, prism.width)}, "
        f"{'thickness' if flat else 'height'} {millimetres(prism.height)}",
        faces=prism.faces,
        center=prism.center,
        extents=prism.extents,
        axis=prism.normal,
        normal=prism.normal,
        height=prism.extents[2] if upright else prism.height,
        width=prism.width,
        length=prism.length,
        thickness=prism.height if flat or is_head else thin if slender else None,
        tip=prism.tip,
        local_size=(prism.length, prism.width, prism.height),
        area=faces_area(brep, prism.faces),
        evidence=geometry(
            f"{prism.sides} plane sides that meet in convex edges, all the way around one direction"
            if prism.sides
            else "two parallel faces that look away from each other, with square walls between them"
        ),
    )


def hollow_section_part(brep: Brep, found: HollowSection, number: int) -> Part:
    """A tube with flat sides as a part: length along its axis, thickness of its wall, outer width."""
    return Part(
        id=f"tube-{number}",
        kind="prism",
        tags=(found.outline, "hollow", "tube", "slender"),
        label=f"{outlined(found.outline, 'tube')}, {millimetres(*found.size, found.wall)}, "
        f"length {millimetres(found.length)}",
        faces=found.faces,
        center=found.center,
        extents=found.extents,
        axis=found.axis,
        normal=found.axis,
        height=found.length,
        width=found.size[1],
        length=found.length,
        thickness=found.wall,
        tip=add(found.center, scale(found.axis, found.length / 2)),
        local_size=(found.length, *found.size),
        area=faces_area(brep, found.faces),
        evidence=geometry("a hollow with flat walls, each with a face of the outside at one distance behind it"),
    )


def gear_part(brep: Brep, gear: Gear, number: int) -> Part:
    """A gear as a part: diameter over the tips, width along the axis; `radii` are tip and root."""
    name = "knurl" if gear.is_knurl else "internal gear" if gear.internal else "gear"
    return Part(
        id=f"gear-{number}",
        kind="gear",
        tags=("inner" if gear.internal else "outer", *(("knurl",) if gear.is_knurl else ())),
        label=f"{name}, {len(gear.teeth)} teeth, tip diameter {millimetres(2 * gear.tip_radius)}",
        faces=gear.faces,
        center=gear.center,
        extents=box_extents(faces_box(brep, gear.faces)),
        axis=gear.axis.direction,
        radius=gear.tip_radius,
        diameter=2 * gear.tip_radius,
        height=gear.width,
        width=gear.width,
        length=gear.width,
        thickness=gear.width,
        count=len(gear.teeth),
        radii=(gear.tip_radius, gear.root_radius),
        children=tuple(f"tooth-{number}.{i}" for i in range(1, len(gear.teeth) + 1)),
        area=faces_area(brep, gear.faces),
        evidence=geometry(f"{len(gear.teeth)} equal groups of faces at equal angles around one axis"),
    )


def knurl_part(brep: Brep, knurl: Knurl, number: int) -> Part:
    """A diamond knurl as a part: diameter over the points, `count` of them around, width along the axis."""
    return Part(
        id=f"knurl-{number}",
        kind="gear",
        tags=("outer", "knurl", "diamond"),
        label=f"diamond knurl, diameter {millimetres(2 * knurl.tip_radius)}, width {millimetres(knurl.width)}",
        faces=knurl.faces,
        center=knurl.center,
        extents=box_extents(faces_box(brep, knurl.faces)),
        axis=knurl.axis.direction,
        radius=knurl.tip_radius,
        diameter=2 * knurl.tip_radius,
        height=knurl.width,
        width=knurl.width,
        length=knurl.width,
        count=knurl.count,
        radii=(knurl.tip_radius, knurl.root_radius),
        area=faces_area(brep, knurl.faces),
        evidence=geometry(f"rows of {knurl.count} low points and more around one axis"),
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
            width=gear.width,
            tip=tooth.tip,
            evidence=geometry(f"one of {len(gear.teeth)} equal groups of faces around an axis"),
        )
        for i, tooth in enumerate(gear.teeth, start=1)
    ]


def arm_part(brep: Brep, found: Arm, number: int) -> Part:
    """An arm; its normal and length run out from the hub, its height along the hub's axis."""
    name = "spoke" if found.is_spoke else "arm"
    _, second, longest = sorted((found.width, found.thickness, found.length))
    return Part(
        id=f"arm-{number}",
        kind="prism",
        tags=(
            *("rectangular", "arm"),
            *(("spoke",) if found.is_spoke else ()),
            *(("slender",) if exceeds(longest, BAR_RATIO * second) else ()),
        ),
        label=f"{name}, {millimetres(found.width)} wide, {millimetres(found.thickness)} thick, "
        f"length {millimetres(found.length)}",
        faces=found.faces,
        center=found.center,
        extents=box_extents(faces_box(brep, found.faces)),
        axis=found.direction,
        normal=found.direction,
        height=found.thickness,
        width=found.width,
        thickness=found.thickness,
        length=found.length,
        center_length=found.center_length,
        tip=found.tip,
        local_size=(found.length, found.width, found.thickness),
        area=faces_area(brep, found.faces),
        evidence=geometry("two plane sides that run out from a round hub"),
    )


def rib_part(brep: Brep, found: Rib, number: int, is_fin: bool) -> Part:
    """A rib or fin; its width is its thickness."""
    name = "fin" if is_fin else "rib"
    foot = sub(found.tip, scale(found.normal, found.height))
    own = faces_box(brep, found.faces)
    return Part(
        id=f"rib-{number}",
        kind="rib",
        tags=(("fin",) if is_fin else ()) + ("rectangular",),
        label=f"{name}, thickness {millimetres(found.thickness)}, height {millimetres(found.height)}, "
        f"length {millimetres(found.length)}",
        faces=found.faces,
        center=found.center,
        extents=box_extents(box_of((*own, foot)) or own),
        axis=found.normal,
        normal=found.normal,
        height=found.height,
        width=found.thickness,
        thickness=found.thickness,
        length=found.length,
        tip=found.tip,
        local_size=(found.length, found.thickness, found.height),
        area=faces_area(brep, found.faces),
        evidence=geometry("a narrow top face between two parallel flanks that stand on the material"),
    )
