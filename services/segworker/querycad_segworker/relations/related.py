"""Which of some parts stand so to one of others: in them, on them, beside, between or around them?"""

from __future__ import annotations

from collections.abc import Sequence

from querycad_contracts import DRAWING_M, Part, PartKind
from querycad_contracts.places import RING_M, carries, is_inside
from querycad_segworker.vectors import dot

from .between import lying_between
from .nearby import Nearby, to_nearest
from .places import coaxial, encloses, surrounding, touches

STANDING_OUT = frozenset(kind for kind in PartKind if kind.stands_out) | {PartKind.BODY}
_JOINS = frozenset(kind for kind in PartKind if kind.breaks_edge) | {PartKind.RIB, PartKind.WALL, PartKind.BEND}
DIRECTIONS = {"above": (2, 1), "below": (2, -1), "left": (0, -1), "right": (0, 1), "front": (1, -1), "behind": (1, 1)}
"""(axis, sign) of words for places beside others."""


def related(found: Sequence[Part], relation: str, holders: Sequence[Part], nearby: Nearby) -> list[Part]:  # noqa: PLR0911 - one case a relation
    """Those that stand so to one of the holders; none where the relation is not known."""
    match relation:
        case "with":
            pairs = nearby.pairs(holders, found)
            having = {p.id for h, near in pairs for p in near if h.id != p.id and is_inside(h, p)}
            return [p for p in found if p.id in having] or next_to(found, holders, nearby)
        case "near":
            return next_to(found, holders, nearby) or nearest(found, holders)
        case "between":
            ids = {h.id for h in holders}
            apart = lying_between([p for p in found if p.id not in ids], holders)
            return lying_between(apart, holders, whole=True) or apart or _joining(found, holders, nearby)
        case "around":
            around = [p for p in found if any(encloses(p, h) for h in holders)]
            edges = [p for p in found if p.kind.breaks_edge]
            return around or next_to(edges, holders, nearby) or _ringed(found, holders)
        case _ if relation in DIRECTIONS:
            axis, sign = DIRECTIONS[relation]
            first = min((sign * h.center[axis] for h in holders), default=float("inf"))
            return [p for p in found if sign * p.center[axis] - first > DRAWING_M]
        case "opposite":
            normals = {h.normal for h in holders if h.normal}
            return [p for p in found if p.normal and any(dot(p.normal, normal) < -0.9 for normal in normals)]
        case "through":
            return held(found, "in", holders, nearby) or [
                p for p, near in nearby.pairs(found, holders) if any(touches(p, h) for h in near)
            ]
        case "":
            own = held(found, "", holders, nearby)
            pairs = nearby.pairs(found, holders)
            return (
                own
                or [p for p, near in pairs if any(coaxial(p, h) and touches(p, h) for h in near)]
                or next_to(found, holders, nearby)
            )
        case _:
            own = held(found, "of" if relation == "for" else relation, holders, nearby)
            ids = {h.id for h in holders}
            return own or [p for p in found if not ids.isdisjoint(p.children)]


def _joining(found: Sequence[Part], holders: Sequence[Part], nearby: Nearby) -> list[Part]:
    """Those that meet two of the holders in their corner: the gusset of a base and an upright, the fillet there."""
    own = {holder.id for holder in holders}
    able = [part for part in found if part.kind in _JOINS and part.id not in own]
    return [part for part, near in nearby.pairs(able, holders) if sum(touches(part, one) for one in near) > 1]


def next_to(found: Sequence[Part], holders: Sequence[Part], nearby: Nearby) -> list[Part]:
    """Those whose boxes meet that of a holder."""
    return [p for p, near in nearby.pairs(found, holders) if any(h.id != p.id and touches(p, h) for h in near)]


def nearest(found: Sequence[Part], holders: Sequence[Part]) -> list[Part]:
    """Those that are nearest to a holder, where none meets one: 'the hole next to the slot'."""
    ids = {h.id for h in holders}
    others = [p for p in found if p.id not in ids]
    apart = list(map(to_nearest(holders), others))
    least = min(apart, default=0.0)
    return [p for p, gap in zip(others, apart, strict=True) if gap <= least + RING_M]


def _ringed(found: Sequence[Part], holders: Sequence[Part]) -> list[Part]:
    """Those that stand in a ring around one of the holders: 'the holes around the hub'."""
    ids = {p.id for h in holders for p in surrounding(found, h)}
    return [p for p in found if p.id in ids]


def held(found: Sequence[Part], relation: str, holders: Sequence[Part], nearby: Nearby) -> list[Part]:
    """Those that a holder carries; else those in its box; of what stands out or breaks edges, those that touch it."""
    pairs = nearby.pairs(found, holders)
    on = relation == "on"
    if carried := [p for p, near in pairs if any(carries(h, p) and not (on and _is_of(p, h)) for h in near)]:
        return carried
    if on:
        standing = [(p, near) for p, near in pairs if p.kind in STANDING_OUT or p.kind == "cylinder"]
        if upon := [p for p, near in standing if any(touches(p, h) and not is_inside(p, h) for h in near)]:
            return upon
    ids = {h.id for h in holders}
    own = {p.id for p in found if p.kind == "pattern" and not ids.isdisjoint(p.children)}
    inside = [p for p, near in pairs if p.id in own or any(is_inside(p, h) for h in near)]
    beside = all(p.kind in STANDING_OUT or p.kind.breaks_edge for p in found)
    return inside or (next_to(found, holders, nearby) if beside else [])


def _is_of(part: Part, place: Part) -> bool:
    """Is what stands out made of the place itself, so that it is not on it: the outer cylinder of a disc?"""
    raised = part.kind in STANDING_OUT or part.kind == "cylinder"
    return raised and place.kind.stands_out and set(part.faces) <= set(place.faces)
