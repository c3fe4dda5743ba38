"""Screws and nuts by their shape: a head on a shank, a hexagon with a bore, with or without a flange."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass, field

from querycad_contracts import Part, PartKind, Vector
from querycad_segworker.features.shared.part_measures import faces_box, millimetres
from querycad_segworker.features.shared.refusals import refuse
from querycad_segworker.topology import Brep
from querycad_segworker.vectors import add, box_extents, cross, dist, dot, line_distance, norm, scale, sub, unit

HEAD_RATIO = (1.3, 2.6)
"""A head is this much wider than its shank: 1.5 times for ISO 4762 and ISO 4014 screws, less for long pins, up to 2.5
for carriage bolts (ISO 8677)."""
HEAD_HEIGHT = 1.2
"""A head is no higher than this many diameters of its shank: one for ISO 4762, 0.7 for ISO 4014."""
HEAD_GAP = 0.3
"""Share of the shank's radius that a washer face or an undercut takes between head and shank."""
NUT_HEIGHT = (0.3, 1.3)
"""Height of a nut in diameters of its thread: thin nuts (ISO 4035) have 0.5, high ones (ISO 4033) 1."""
NUT_FLANGE = 1.5
"""A flange at one end of a nut is no more than so many times as wide as the hexagon across flats: 1.38 for M8 and 1.43
for M20 in ISO 4161. A wider one is that of a fitting or a bush."""
NUT_WIDTH = (1.3, 2.2)
"""Width across flats of a nut in diameters of its thread: 1.5 to 1.8 (ISO 4032), more for the smallest."""
WHOLE = 0.6
"""A body is a fastener when head and shank, or hexagon and bore, make up this share of its surface: sockets, threads
and edge breaks are the rest."""
NEAR = 0.05
"""Steps whose axes are nearer than this share of the shank's radius are one turned part."""
Z: Vector = (0.0, 0.0, 1.0)


@dataclass(frozen=True, slots=True)
class Fastened:
    """What a part is to a fastener: its tags, and the measures of a screw, which are those of its shank."""

    tags: tuple[str, ...]
    measures: dict[str, object] = field(default_factory=dict)


def fasteners(parts: Sequence[Part], brep: Brep) -> dict[str, Fastened]:
    """Which parts belong to fasteners? By id.

    'head' and 'shank' of the steps; 'screw' or 'nut' of bodies, with the form of the head: 'hexagonal', 'cylindrical'
    or 'countersunk'.
    """
    bodies = {part.faces: part for part in parts if part.kind == "body"}
    owner = {record.id: bodies[record.faces] for record in brep.bodies}
    by_body: dict[int, list[Part]] = defaultdict(list)
    for part in parts:
        if part.kind in (PartKind.BOSS, PartKind.PRISM, PartKind.HOLE) and part.axis is not None:
            by_body[brep.faces[part.faces[0]].body].append(part)
    found: dict[str, Fastened] = {}
    for body, members in by_body.items():
        for head, shank in _screws([part for part in members if part.kind != "hole"]):
            face = _washer_face(members, head, shank)
            found[head.id] = Fastened(("head",), {} if face is None else _with_washer_face(head, face, brep))
            if face is not None:
                found[face.id] = Fastened(("washer_face",))
            found[shank.id] = Fastened(("shank",))
            near = NEAR * (shank.radius or 0.0)
            steps = [
                part
                for part in members
                if line_distance(part.center, shank.center, shank.axis or Z) < near
                and (part.width or 0.0) <= 1.01 * (head.width or 0.0)
            ]
            if _share(steps, body, brep) <= WHOLE:
                refuse("screw", (*head.faces, *shank.faces), "head and shank are not most of the body")
            else:
                measures, above = _screw_measures(head, shank, face, owner[body], brep)
                found[owner[body].id] = Fastened(("screw", _head_form(head)), measures)
                if head.kind == "prism" and face is None:  # its corners are chamfered
                    found[head.id] = Fastened(("head",), {"height": max(above, head.height or 0.0)})
        for prism in members:
            bore = _nut_bore(prism, members)
            flange = _nut_flange(prism, members)
            if bore is not None and _share((prism, bore, *flange), body, brep) <= WHOLE:
                refuse("nut", (*prism.faces, *bore.faces), "hexagon, bore and flange are not most of the body")
            elif bore is not None:
                found[owner[body].id] = Fastened(("nut", "hexagonal"))
    return found


def _share(members: Sequence[Part], body: int, brep: Brep) -> float:
    """Which share of the body's surface do these parts make up?"""
    faces = {face for part in members for face in part.faces}
    return sum(brep.faces[face].area for face in faces) / max(brep.bodies[body].area, 1e-30)


def _screws(steps: Sequence[Part]) -> list[tuple[Part, Part]]:
    """Heads, each with the shank that it sits on: the one clearly wider step at one end of a slender one."""
    found = []
    for shank in steps:
        if shank.kind != "boss" or not {"cylindrical", "slender"} <= set(shank.tags) or "hollow" in shank.tags:
            continue
        wider = [step for step in steps if step.id != shank.id and _caps(step, shank)]
        ends = {dot(sub(step.center, shank.center), shank.axis or Z) > 0 for step in wider}
        if len(ends) == 2:
            refuse("screw", shank.faces, "wider steps on both ends")
        elif ends and any(_is_beyond_head(step, shank, ends == {True}) for step in steps):
            refuse("screw", shank.faces, "the shaft goes on beyond what could be the head")
        elif ends:
            found.append((max(wider, key=lambda step: (step.kind == "prism", step.height or 0.0)), shank))
    return found


def _is_beyond_head(step: Part, shank: Part, upwards: bool) -> bool:
    """Does a step on the shank's axis reach further out than a head would, as the next journal of a shaft does?

    Or is one out there longer than it is wide? A head ends in a button or a washer face at most.
    """
    assert shank.axis is not None
    radius, height = shank.radius or 0.0, shank.height or 0.0
    if line_distance(step.center, shank.center, shank.axis) > NEAR * radius:
        return False
    along = dot(sub(step.center, shank.center), shank.axis) * (1.0 if upwards else -1.0)
    if along > height / 2 and "cylindrical" in step.tags and (step.height or 0.0) > (step.width or 0.0):
        return True
    return along + (step.height or 0.0) / 2 > height / 2 + (HEAD_HEIGHT * 2 + HEAD_GAP) * radius


def _caps(head: Part, shank: Part) -> bool:
    """Does this step sit on the end of the shank as a head does?"""
    assert shank.axis is not None
    assert head.axis is not None
    if head.width is None or head.height is None or not shank.radius or shank.height is None:
        return False
    low, high = HEAD_RATIO
    coaxial = line_distance(head.center, shank.center, shank.axis) < 0.05 * shank.radius
    aligned = norm(cross(head.axis, shank.axis)) < 0.02
    gap = abs(dot(sub(head.center, shank.center), shank.axis)) - (shank.height + head.height) / 2
    return (
        coaxial
        and aligned
        and low * 2 * shank.radius < head.width < high * 2 * shank.radius
        and head.height < min(HEAD_HEIGHT * 2 * shank.radius, shank.height)
        and abs(gap) < HEAD_GAP * shank.radius
    )


def _screw_measures(
    head: Part, shank: Part, face: Part | None, body: Part, brep: Brep
) -> tuple[dict[str, object], float]:
    """A screw is as thick as its shank and as long as its body reaches along it, edge breaks and domed head included.

    Its tip is the end of the shank away from the head. Its nominal length is that below the head and the washer face
    under it (ISO 4014, ISO 4762), of a countersunk one all of it (ISO 7046). Also how far it reaches above that.
    """
    assert shank.axis is not None
    assert shank.radius is not None
    away = unit(sub(shank.center, head.center))
    axis = scale(shank.axis, 1.0 if dot(shank.axis, away) > 0 else -1.0)
    edges = brep.edges_of(body.faces)
    points = [point for e in edges for point in brep.edge_points[e]] + [brep.faces[face].point for face in body.faces]
    ends = [step.tip for step in (head, shank) if step.tip is not None]
    reach = [dot(sub(point, shank.center), axis) for point in (*points, *ends)]
    tip = add(shank.center, scale(axis, max(reach)))
    length = max(reach) - min(reach)
    under = (
        dot(sub(head.center, shank.center), axis) + (head.height or 0.0) / 2 + ((face.height or 0.0) if face else 0.0)
    )
    measures: dict[str, object] = {
        "axis": axis,
        "radius": shank.radius,
        "diameter": 2 * shank.radius,
        "length": length,
        "nominal_length": length if "conical" in head.tags else max(reach) - under,
        "height": length,
        "tip": tip,
        "tips": (tip,),
    }
    return measures, under - min(reach)


def _washer_face(members: Sequence[Part], head: Part, shank: Part) -> Part | None:
    """The low round step between a hexagon and its shank (ISO 4014), which belongs to the head."""
    assert shank.axis is not None
    for step in members if head.kind == "prism" else ():
        if step.kind != "boss" or step.id in (head.id, shank.id) or not step.height or not shank.radius:
            continue
        between = dot(sub(step.center, head.center), sub(shank.center, step.center)) > 0
        coaxial = line_distance(step.center, shank.center, shank.axis) < NEAR * shank.radius
        narrower = 2 * shank.radius < (step.width or 0.0) <= 1.01 * (head.width or 0.0)
        if between and coaxial and narrower and step.height <= HEAD_GAP * shank.radius:
            return step
    return None


def _with_washer_face(head: Part, face: Part, brep: Brep) -> dict[str, object]:
    """The head with its washer face: higher by it, and its middle between both ends."""
    assert head.height is not None
    assert face.height is not None
    towards = unit(sub(face.center, head.center))
    faces = tuple(sorted({*head.faces, *face.faces}))
    center = add(head.center, scale(towards, face.height / 2))
    height = head.height + face.height
    label = f"{_head_form(head)} head with washer face, height {millimetres(height)}"
    extents = box_extents(faces_box(brep, faces))
    measures: dict[str, object] = {
        "height": height,
        "center": center,
        "faces": faces,
        "label": label,
        "extents": extents,
    }
    if head.local_size is not None:
        measures["local_size"] = (*head.local_size[:2], height)
    return measures


def _head_form(head: Part) -> str:
    if head.kind == "prism":
        return next((tag for tag in head.tags if tag == "hexagonal"), "polygonal")
    return "countersunk" if "conical" in head.tags else "cylindrical"


def _nut_bore(prism: Part, members: Sequence[Part]) -> Part | None:
    """The bore of a nut whose hexagon this prism is, by the proportions of nuts."""
    if prism.kind != "prism" or "hexagonal" not in prism.tags or not prism.width or not prism.height:
        return None
    (low, high), (narrow, wide) = NUT_HEIGHT, NUT_WIDTH
    for hole in members:
        if hole.kind != "hole" or "through" not in hole.tags or not hole.diameter:
            continue
        coaxial = line_distance(hole.center, prism.center, prism.axis or Z) < 0.02 * prism.width
        if coaxial and low < prism.height / hole.diameter < high and narrow < prism.width / hole.diameter < wide:
            return hole
    return None


def _nut_flange(prism: Part, members: Sequence[Part]) -> tuple[Part, ...]:
    """The round flange at one end of a nut's hexagon, lower than that: none or one."""
    if prism.kind != "prism" or not prism.width or not prism.height:
        return ()
    for step in members:
        if step.kind != "boss" or "cylindrical" not in step.tags or not step.width or not step.height:
            continue
        off = line_distance(step.center, prism.center, prism.axis or Z)
        apart = dist(step.center, prism.center) - (step.height + prism.height) / 2
        wide = prism.width < step.width <= NUT_FLANGE * prism.width
        if wide and off < 0.02 * prism.width and apart < NEAR * prism.width and step.height < prism.height:
            return (step,)
    return ()
