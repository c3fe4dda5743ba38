"""Screws and nuts by their shape: a head on a shank, a hexagon with a bore."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence

from querycad_contracts import Part, Vector
from querycad_segworker.topology import Brep
from querycad_segworker.vectors import cross, dot, line_distance, norm, sub

HEAD_RATIO = (1.3, 2.6)
"""A head is this much wider than its shank: 1.5 times for ISO 4762 and ISO 4014 screws, less for long pins, up to 2.5
for carriage bolts (ISO 8677)."""
HEAD_HEIGHT = 1.2
"""A head is no higher than this many diameters of its shank: one for ISO 4762, 0.7 for ISO 4014."""
NUT_HEIGHT = (0.3, 1.3)
"""Height of a nut in diameters of its thread: thin nuts (ISO 4035) have 0.5, high ones (ISO 4033) 1."""
NUT_WIDTH = (1.3, 2.2)
"""Width across flats of a nut in diameters of its thread: 1.5 to 1.8 (ISO 4032), more for the smallest."""
WHOLE = 0.6
"""A body is a fastener when head and shank, or hexagon and bore, make up this share of its surface: sockets, threads
and edge breaks are the rest."""
NEAR = 0.05
"""Steps whose axes are nearer than this share of the shank's radius are one turned part."""
Z: Vector = (0.0, 0.0, 1.0)


def fasteners(parts: Sequence[Part], brep: Brep) -> dict[str, tuple[str, ...]]:
    """Which parts belong to fasteners? Tags by id.

    'head' and 'shank' of the steps; 'screw' or 'nut' of bodies, with the form of the head: 'hexagonal', 'cylindrical'
    or 'countersunk'.
    """
    bodies = {part.faces: part for part in parts if part.kind == "body"}
    owner = {record.id: bodies[record.faces] for record in brep.bodies}
    by_body: dict[int, list[Part]] = defaultdict(list)
    for part in parts:
        if part.kind in ("boss", "prism", "hole") and part.axis is not None:
            by_body[brep.faces[part.faces[0]].body].append(part)
    found: dict[str, tuple[str, ...]] = {}
    for body, members in by_body.items():
        for head, shank in _screws([part for part in members if part.kind != "hole"]):
            found[head.id] = ("head",)
            found[shank.id] = ("shank",)
            near = NEAR * (shank.radius or 0.0)
            steps = [
                part
                for part in members
                if line_distance(part.center, shank.center, shank.axis or Z) < near
                and (part.width or 0.0) <= 1.01 * (head.width or 0.0)
            ]
            if _share(steps, body, brep) > WHOLE:
                found[owner[body].id] = ("screw", _head_form(head))
        for prism in members:
            bore = _nut_bore(prism, members)
            if bore is not None and _share((prism, bore), body, brep) > WHOLE:
                found[owner[body].id] = ("nut", "hexagonal")
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
        ends = {dot(sub(step.center, shank.center), shank.axis or (0.0, 0.0, 0.0)) > 0 for step in wider}
        if len(ends) == 1:
            found.append((max(wider, key=lambda step: (step.kind == "prism", step.height or 0.0)), shank))
    return found


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
        # A washer face or an undercut lies between head and shank.
        and abs(gap) < 0.3 * shank.radius
    )


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
