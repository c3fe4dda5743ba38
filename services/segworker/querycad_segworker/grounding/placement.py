"""Where parts are: in, on or beside others, and on which sides."""

from __future__ import annotations

from collections.abc import Sequence

from querycad_contracts import Grounded, Part, PartQuery, Place, Side
from querycad_segworker.relations.orders import at_end, beyond_middle
from querycad_segworker.relations.related import DIRECTIONS, nearest, related

from .candidates import Candidate, Request, pruned, score
from .names import all_words

_LYING = {Side.FRONT: Side.TOP, Side.BACK: Side.BOTTOM}
"""What people call front and back of a flange or plate that lies."""
MOST_DEEP = 3  # places are looked at in queries that stand in no more others than that


def placed(request: Request, way: Candidate) -> Sequence[Candidate]:
    """Those that stand so to others: 'in the flange', 'between the lugs'."""
    ways: Sequence[Candidate] = [way]
    for place in request.query.places:
        if place.what is not None and request.depth <= MOST_DEEP:
            several = place.relation == "with" or (not place.relation and request.query.count)
            both = place.relation == "between" and place.what.also  # 'between the base and the upright'
            any_of = {"plural": True} if both or (several and not place.what.definite) else {}
            holders = request.ground(place.what.model_copy(update=any_of), 3)  # 'with a ring', 'the two eye bores'
            ways = pruned([after for one in ways for after in _at_place(request, one, place, holders)])
    return ways


def _at_place(request: Request, way: Candidate, place: Place, holders: Sequence[Grounded]) -> Sequence[Candidate]:
    if not way.parts or place.what is None:
        return [way]
    name = "compound" if not place.relation else "trait" if place.relation == "with" else "place"
    there = [grounded for grounded in holders if grounded.parts]
    ways = [list(_held_by(request, way, place, grounded, name)) for grounded in there]
    held = [after for one in ways for after in one]
    if place.what.sides and _says_nothing_of(request, place.what, holders):  # 'on the plate visible from the top'
        held = [after for one in held for after in _from_sides(request, one, place.what.sides)]
    if place.relation == "for":
        return [*held, way.to(way.parts, "purpose")]
    said = f"'{place.relation} {place.what.noun}'".replace("' ", "'")
    none = way.to(way.parts, f"{name}_holds") if place.negated else way.to((), "place_absent")
    less = place.negated and len(way.parts) == 1 and not request.query.plural  # 'the rack without teeth': less them
    absent = [] if less or (holders and holders[0].parts) else [none]  # all are without a thread where there is none
    if not there:
        return [way.to(way.parts, f"{name}_unknown", unchecked=said), *absent]
    dropped = way.to(way.parts, f"{name}_dropped", unchecked=said)
    if ways[0] or _are_among(way, place, there[0].parts):
        return [*held, dropped, *absent]
    empty = way.to((), f"{name}_empties").to((), f"{name}_score", _worth(there[0]))
    empty = empty.to((), "place_elsewhere") if _is_elsewhere(request, way, place, there[0].parts) else empty
    return [*(one.to(one.parts, "place_denied") for one in (*held, dropped)), empty, *absent]


def _are_among(way: Candidate, place: Place, holders: Sequence[Part]) -> bool:
    """Are the holders some of these bodies: 'the parts of this hinge' are no parts of the bodies that are called so."""
    return place.relation in ("in", "of") and all(part.kind == "body" and part in way.parts for part in holders)


def _is_elsewhere(request: Request, way: Candidate, place: Place, holders: Sequence[Part]) -> bool:
    """Do the parts stand so to others of the holders' kind: 'the slot in the left leg' that is in the right one?"""
    kinds, ids = {p.kind for p in holders}, {p.id for p in holders}
    others = [p for p in request.inventory.parts if p.kind in kinds and p.id not in ids]
    return bool(others and related(way.parts, place.relation, others, request.inventory.nearby))


def _says_nothing_of(request: Request, what: PartQuery, holders: Sequence[Grounded]) -> bool:
    """Do the sides of a holder not tell it from others? Then what it holds is visible from them."""
    plain = request.ground(what.model_copy(update={"sides": ()}), 1)
    return bool(plain and holders) and plain[0].parts == holders[0].parts


def _held_by(request: Request, way: Candidate, place: Place, grounded: Grounded, name: str) -> Sequence[Candidate]:
    """The parts that stand so to one way of grounding the place."""
    if grounded.parts[0].kind == "model":
        whole = way.to(way.parts, f"{name}_whole")
        return [whole] if place.side is None else _from_sides(request, whole, [place.side])  # 'from its top'
    floor = place.side is Side.BOTTOM and grounded.parts[0].kind.cuts_in  # 'at the bottom of the pocket' is in it
    side = None if floor else place.side
    parts = [p for p in grounded.parts if not side or side in p.sides or request.inventory.alone]
    if _are_among(way, place, grounded.parts):
        return []
    kept = related(way.parts, place.relation, parts or grounded.parts, request.inventory.nearby)
    if place.relation:  # nothing is in itself, but 'a flange plate' may be both
        kept = [p for p in kept if p not in grounded.parts] or kept
    if place.negated:
        known = {id(p) for p in kept}
        kept = [p for p in way.parts if id(p) not in known]
    if not kept:
        return []
    sided = [p for p in kept if side is None or side in p.sides]
    holding = way.to(sided or kept, f"{name}_holds").to(sided or kept, f"{name}_score", _worth(grounded))
    if place.relation in DIRECTIONS and len(kept) > 1 and not request.query.plural:  # 'the section left of the collar'
        return [holding.to(nearest(kept, grounded.parts), "place_next"), holding]
    return [holding] if sided or side is None else _from_sides(request, holding, [side])


def _worth(grounded: Grounded) -> float:
    """What speaks for a holder, as one number that is 0 for a plain one."""
    return max(-5.0, min(1.0, score(grounded.features)))


def seen(request: Request, way: Candidate) -> Sequence[Candidate]:
    """Those visible from the sides; at that end; facing there. 'The left leg' is the leftmost one."""
    query = request.query
    ways = _at_ends(request, way, query.ends) if query.ends and way.parts else [way]
    if query.sides:
        ways = [after for one in ways for after in _from_sides(request, one, query.sides)]
    if query.unseen:
        unseen = set(query.unseen)
        ways = [one.to([p for p in one.parts if unseen.isdisjoint(p.sides)], "side_agrees") for one in ways]
    return ways


def _at_ends(request: Request, way: Candidate, ends: Sequence[Side]) -> Sequence[Candidate]:
    named = [p for p in way.parts if not set(all_words(p.name)).isdisjoint(ends)]
    if named:
        return [way.to(named, "end_named")]
    farthest = way.to(at_end(way.parts, ends, request.inventory.near), "end_adjective")
    model, near = request.inventory.model, request.inventory.near
    if model is not None and beyond_middle(
        farthest.parts, ends, model, near
    ):  # 'the hole in the left end' that is at the right one
        return [farthest.to(farthest.parts, "end_denied"), way.to((), "end_empties")]
    seen = _seen(way, ends)
    return [farthest, way.to(seen, "end_seen")] if 0 < len(seen) < len(way.parts) else [farthest]


def _from_sides(request: Request, way: Candidate, sides: Sequence[Side]) -> Sequence[Candidate]:
    if not way.parts:
        return [way]
    seen, ends = _seen(way, sides), at_end(way.parts, sides, request.inventory.near)
    ways = [way.to(seen, "side_agrees" if seen else "side_empties")]
    reversible = not seen and request.inventory.lies and _LYING.keys() >= set(sides)
    if reversible and (turned := _seen(way, [_LYING[side] for side in sides])):
        ways.append(way.to(turned, "side_turned", unchecked=f"'{sides[0]}', taken for the {_LYING[sides[0]]}"))
    return [*ways, way.to(ends, "side_end_instead" if seen else "side_end")] if len(ends) < len(way.parts) else ways


def _seen(way: Candidate, sides: Sequence[Side]) -> list[Part]:
    return [p for p in way.parts if not set(p.sides).isdisjoint(sides)]
