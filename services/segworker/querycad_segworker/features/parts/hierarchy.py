"""Which part carries which? A hole is in the parts whose faces it opens on, a boss on that whose face it stands on."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Sequence

from querycad_contracts import Part, PartKind
from querycad_segworker.topology import Brep, EdgeConvexity
from querycad_segworker.vectors import parallel

_NARROW = {PartKind.HOLE, PartKind.DIMPLE, PartKind.COUNTERBORE, PartKind.COUNTERSINK}
CARRIERS = frozenset(kind for kind in PartKind if kind.stands_out or kind.cuts_in) - _NARROW | {PartKind.GEAR}
"""Kinds with faces of their own that others open on or stand on; bodies hold all parts whose faces are theirs."""


def carried(parts: Sequence[Part], brep: Brep) -> dict[str, list[str]]:
    """Which parts does each part carry? Ids by id of the carrier, in order of `parts`; only the exact faces decide."""
    carriers: dict[int, list[Part]] = defaultdict(list)
    for part in parts:
        if part.kind in CARRIERS:
            for face in part.faces:
                carriers[face].append(part)
    faces_of = {part.id: frozenset(part.faces) for part in parts if part.kind in CARRIERS}
    found: dict[str, list[str]] = defaultdict(list)
    for part in parts:
        if not (part.kind.cuts_in or _joins_faces(part) or part.kind.stands_out):
            continue
        own = frozenset(part.faces)
        hosts = {host.id for face in _touched(part, own, brep) for host in carriers[face]}
        # What a carrier grew around, such as the bore in a protrusion, is its own as well.
        inner = {host.id for host in carriers[part.faces[0]] if own < faces_of[host.id]}
        for host in sorted(hosts | inner):
            if host != part.id and not faces_of[host] <= own:
                found[host].append(part.id)
    return found


def _joins_faces(part: Part) -> bool:
    """Does it belong to every part whose faces it joins? What is cut in belongs to those that it breaks through."""
    return part.kind.breaks_edge or part.kind is PartKind.SPOTFACE


def _touched(part: Part, own: frozenset[int], brep: Brep) -> Iterable[int]:
    """The faces that a part opens on, joins, or stands on."""
    if part.kind.cuts_in or _joins_faces(part):
        return {
            other
            for face in own
            for edge, other in brep.neighbours(face)
            if other not in own and (_joins_faces(part) or edge.convexity is not EdgeConvexity.CONCAVE)
        }
    if part.kind.stands_out and part.normal is not None:
        return {
            other
            for face in own
            for edge, other in brep.neighbours(face)
            if other not in own
            and edge.convexity is EdgeConvexity.CONCAVE
            and brep.faces[other].outward == 0
            and parallel(brep.faces[other].axis, part.normal, 1e-2)
        }
    return ()
