"""Where parts are: in, on or beside others, and on which sides."""

from __future__ import annotations

from collections.abc import Iterator

from querycad_contracts import Grounded, Place
from querycad_segworker.relations.related import related

from .names import all_words
from .ways import Request, Way, pruned, score


def placed(request: Request, way: Way) -> Iterator[Way]:
    """Those that stand so to others: 'in the flange', 'between the lugs'."""
    ways = [way]
    for place in request.query.places:
        ways = pruned([after for one in ways for after in _at_place(request, one, place)])
    yield from ways


def _at_place(request: Request, way: Way, place: Place) -> Iterator[Way]:
    if place.what is None or not way.parts or request.depth > 3:
        yield way
        return
    name = _kind_of(place)
    said = f"'{place.relation} {place.what.noun}'".replace("' ", "'")
    holders = request.ground(place.what, 3)
    found = False
    for grounded in holders:
        for after in _held_by(request, way, place, grounded):
            found = True
            yield after
    if place.relation == "for":
        yield way.to(way.parts, "purpose")
        return
    known = any(grounded.parts for grounded in holders)
    yield way.to(way.parts, f"{name}_dropped" if known else f"{name}_unknown", unchecked=said)
    if not found and known:
        yield way.to((), f"{name}_empties")
    elif not known and place.relation == "with":
        yield way.to(() if not place.negated else way.parts, f"{name}_empties")


def _kind_of(place: Place) -> str:
    return "compound" if not place.relation else "trait" if place.relation == "with" else "place"


def _held_by(request: Request, way: Way, place: Place, grounded: Grounded) -> Iterator[Way]:
    """The parts that stand so to one way of grounding the place."""
    if not grounded.parts:
        return
    name = _kind_of(place)
    if grounded.parts[0].kind == "model":
        yield way.to(way.parts, f"{name}_whole", 1.0)
        return
    parts = [p for p in grounded.parts if not place.side or place.side in p.sides or request.inventory.alone]
    kept = related(way.parts, place.relation, parts or grounded.parts, request.inventory.nearby)
    if place.side is not None:
        kept = [p for p in kept if place.side in p.sides] or kept
    if place.negated:
        known = {id(p) for p in kept}
        kept = [p for p in way.parts if id(p) not in known]
    if kept:
        yield way.to(kept, f"{name}_holds").to(kept, f"{name}_score", _worth(grounded))


def _worth(grounded: Grounded) -> float:
    """What speaks for a holder, as one number that is 0 for a plain one."""
    return max(-5.0, min(1.0, score(grounded.features)))


def seen(request: Request, way: Way) -> Iterator[Way]:
    """Those visible from the sides; at that end; facing there. 'The left leg' is the leftmost one."""
    ways = [way]
    if request.query.ends and way.parts:
        named = [p for p in way.parts if any(side.value in all_words(p.name) for side in request.query.ends)]
        ends = request.inventory.at_end(way.parts, request.query.ends)
        seen = [p for p in way.parts if set(request.query.ends) & set(p.sides)]
        ways = [way.to(named, "end_named")] if named else [way.to(ends, "end_adjective")]
        if seen and not named and len(seen) < len(way.parts):
            ways.append(way.to(seen, "end_seen"))
    if request.query.sides:
        ways = [after for one in ways for after in _from_sides(request, one)]
    if request.query.unseen:
        ways = [
            one.to([p for p in one.parts if not set(request.query.unseen) & set(p.sides)], "side_agrees")
            for one in ways
        ]
    yield from ways


def _from_sides(request: Request, way: Way) -> Iterator[Way]:
    if not way.parts:
        yield way
        return
    seen = [p for p in way.parts if set(request.query.sides) & set(p.sides)]
    if seen:
        yield way.to(seen, "side_agrees")
    else:
        yield way.to((), "side_empties")
    ends = request.inventory.at_end(way.parts, request.query.sides)
    if ends and len(ends) < len(way.parts):
        yield way.to(ends, "side_end" if not seen else "side_end_instead")
