"""What restricts: colours, threads, adjectives, sizes; what cannot be checked is said."""

from __future__ import annotations

import colorsys
import math
from collections.abc import Iterator, Mapping

from querycad_contracts import Measure, Part, Relation, SizeFilter
from querycad_language.lexicon import Adjective, lexicon
from querycad_segworker.relations.roles import ROLES

from .inventory import THREAD_TOLERANCE_M, Inventory, values_of
from .names import all_words
from .ways import Request, Way, kept

DRAWN_M = 0.05e-3
"""Stated sizes are met to drawing accuracy, or to half of their last digit."""
SURFACES = ("cylinder", "cone", "sphere", "torus", "arc")
"""Kinds that are inner or outer by themselves: the outer cylinders are all of them, not those farthest out."""
THREAD_M = (0.02e-3, THREAD_TOLERANCE_M)
"""Holes of a thread have a diameter of its tables, two digits of a millimetre; where none has, one near to it."""
_COMPARED = (Relation.LESS, Relation.AT_MOST, Relation.MORE, Relation.AT_LEAST)
_WHOLES = ("model", "body")
NEAR = 0.02
"""A nominal size may differ by this share from what is modelled."""


def colored(request: Request, way: Way) -> Iterator[Way]:
    """Those of a colour: 'the red bolts'; a colour without a noun, or of a body, is one of bodies."""
    if not request.query.colors:
        yield way
        return
    hues = lexicon().hues
    color = request.query.colors[0]
    yield from kept(way, [p for p in way.parts if _has_color(p.color, color, hues)], "color", f"'{color}'")
    if request.query.noun in ("", "body", "object"):
        bodies = [b for b in request.inventory.bodies if _has_color(b.color, color, hues)]
        if bodies and not any(b in way.parts for b in bodies):
            yield way.to(bodies, "color_agrees")


def _has_color(color: str | None, name: str, hues: dict[str, tuple[float, float]]) -> bool:
    """Does a hexadecimal colour go by this name? Greys by saturation below 15 %, black and white by brightness."""
    if color is None:
        return False
    r, g, b = (int(color[i : i + 2], 16) / 255 for i in (1, 3, 5))
    hue, saturation, value = colorsys.rgb_to_hsv(r, g, b)
    if name == "black":
        return value < 0.2
    if name == "white":
        return saturation < 0.15 and value > 0.9
    if name in ("gray", "silver"):
        return saturation < 0.15 and 0.2 <= value <= 0.9
    low, high = hues[name]
    degrees = math.degrees(hue * math.tau)
    inside = low <= degrees < high if low < high else degrees >= low or degrees < high
    return saturation >= 0.15 and value >= 0.2 and inside


def threaded(request: Request, way: Way) -> Iterator[Way]:
    """Those that a thread's name marks, or that are drawn for it: 'the M5 holes'. Their labels say as which."""
    if not request.query.threads:
        yield way
        return
    name = request.query.threads[0]
    threads = lexicon().threads
    holes = threads.get(name) or threads.get(name.partition("x")[0]) or {}
    named = {
        p.id: {word.partition("x")[0] for word in all_words(p.name)} & threads.keys()
        for p in way.parts
        if p.kind == "body"
    }
    marked = [p for p in way.parts if name.partition("x")[0] in named.get(p.id, ()) and _is_long(p, name)]
    others = [p for p in way.parts if not named.get(p.id)]
    if way.parts and not marked and not others:  # a screw that is called M5 is no M6 one
        yield way.to((), "thread_empties")
        return
    exact, near = ([part for p in others if (part := _drawn_for(p, name, holes, by)) is not None] for by in THREAD_M)
    yield from kept(way, marked or exact or near, "thread", f"'{name}'")


def _is_long(part: Part, name: str) -> bool:
    """Does the body's name state the length, too, where the question does: 'M5x16'?"""
    return "x" not in name or name in all_words(part.name)


def _drawn_for(part: Part, name: str, holes: Mapping[str, float], near_m: float) -> Part | None:
    """The part, with what its diameter is to a thread in its label: 'tap drill of M6'; None where it is nothing."""
    sizes = values_of(part, Measure.DIAMETER)
    left = ("pitch",) if near_m == THREAD_M[0] else ("pitch", "core")  # cores lie near the drills of other threads
    apart = {role: min(abs(v - d) for v in sizes) for role, d in holes.items() if sizes and role not in left}
    role = min(apart, key=lambda each: apart[each], default="")
    if not role or apart[role] > near_m:
        return None
    drawn = f"{role} clearance" if role in ("close", "medium", "loose") else role
    return part.model_copy(update={"label": f"{part.label}; {drawn} of {name.upper().replace('X', 'x')}"})


def narrowed(request: Request, way: Way) -> Iterator[Way]:
    """Adjectives, and what the parts must not have; words that are not known, which the names of bodies may hold."""
    inventory, query = request.inventory, request.query
    ways = [way]
    for name in query.adjectives:
        ways = [after for one in ways for after in _adjective(inventory, one, name, query.count)]
    for name in query.lacking:
        adjective = lexicon().adjectives.get(name)
        if adjective is not None:
            tags = (*adjective.tags, *adjective.fallback[: 0 if adjective.loose else None])
            ways = [one.to([p for p in one.parts if not inventory.has(p, tags)], "lacking") for one in ways]
    for one in ways:
        if query.unknown:
            yield from _unknown(request, one)
        else:
            yield one


def _unknown(request: Request, way: Way) -> Iterator[Way]:
    """Words that are not known: names of bodies or of the file may hold them."""
    words = request.query.unknown
    marked = [p for p in way.parts if p.kind == "body" and all(word in all_words(p.name) for word in words)]
    if marked:
        yield way.to(marked, "unknown_named")
    elif request.inventory.file_named(words):
        yield way.to(way.parts, "unknown_is_file")
    else:
        yield way.to(way.parts, "unknown_words", float(len(words)), f"'{' '.join(words)}'")


def _adjective(inventory: Inventory, way: Way, name: str, count: int | None) -> Iterator[Way]:
    adjective = lexicon().adjectives.get(name)
    if adjective is None or not way.parts:
        yield way
        return
    kept = [p for p in way.parts if inventory.has(p, adjective.tags)] if adjective.tags else []
    wider = [p for p in way.parts if inventory.has(p, adjective.fallback)] if adjective.fallback else []
    if adjective.whole:
        yield way.to(way.parts, "whole_adjective" if way.features.get("whole_sense") else "adjective_nothing")
    elif kept and (not adjective.order or len(kept) < len(way.parts) or kept[0].kind in SURFACES):
        yield way.to(kept, "adjective_agrees")
    elif wider:
        yield way.to(wider, "adjective_wider")
    elif adjective.order:
        yield from _ordered(inventory, way, adjective, count, name)
    elif adjective.lacks:
        yield way.to([p for p in way.parts if not inventory.has(p, adjective.lacks)], "adjective_agrees")
    elif adjective.decided and (ROLES.keys() >= set(adjective.tags) or all(p.kind in _WHOLES for p in way.parts)):
        yield way.to((), "adjective_agrees")
    elif not adjective.tags:
        yield way.to(way.parts, "adjective_unchecked" if adjective.unchecked else "adjective_nothing")
    elif all(inventory.has(p, adjective.opposite) for p in way.parts):
        yield way.to((), "denied_empties")
        yield way.to(way.parts, "denied_dropped", unchecked=f"'{name}'")
    else:
        yield way.to(way.parts, "adjective_loose" if adjective.loose else "adjective_dropped", unchecked=f"'{name}'")
        if not adjective.loose:
            yield way.to((), "adjective_empties")


def _ordered(inventory: Inventory, way: Way, adjective: Adjective, count: int | None, name: str) -> Iterator[Way]:
    """Those that are most so: 'the large holes', 'the central hole' where none is in the middle."""
    ordered = inventory.ordered(way.parts, adjective, count)
    narrowed = len(ordered) < len(way.parts)
    yield way.to(ordered, "adjective_order" if narrowed else "adjective_nothing")
    if narrowed:
        yield way.to(way.parts, "adjective_dropped", unchecked=f"'{name}'")
    if adjective.tags:  # 'is there a central hole': the nearest to the middle is none
        yield way.to((), "adjective_empties")


def sized(request: Request, way: Way) -> Iterator[Way]:
    """Those with the stated sizes: 'the 5 mm holes'."""
    ways = [way]
    for size in request.query.sizes:
        ways = [after for one in ways for after in _of_size(one, size)]
    yield from ways


def _of_size(way: Way, size: SizeFilter) -> Iterator[Way]:
    said = f"'{size.low * 1e3:.4g} mm'"
    exact = [p for p in way.parts if any(compares(v, size) for v in values_of(p, size.measure))]
    if not exact and size.relation in _COMPARED and all(values_of(p, size.measure) for p in way.parts) and way.parts:
        yield way.to((), "size_agrees")  # that no hole is wider than 80 mm is sure
        return
    if exact or size.relation not in (Relation.EQUAL, Relation.ABOUT):
        yield from kept(way, exact, "size", said)
        return
    near = [p for p in way.parts if any(abs(v - size.low) <= NEAR * size.low for v in values_of(p, size.measure))]
    if near:
        yield way.to(near, "size_near")
        return
    yield from kept(way, [], "size", said)


def compares(value: float, size: SizeFilter) -> bool:
    """Does a value compare so with a stated size? Metres; equal is within drawing accuracy or half a per cent."""
    slack = 1e-6
    match size.relation:
        case Relation.EQUAL:
            return abs(value - size.low) <= max(DRAWN_M if size.low > 1e-3 else 0.05 * size.low, 0.002 * size.low)
        case Relation.ABOUT:
            return abs(value - size.low) <= 0.1 * size.low
        case Relation.UNEQUAL:
            return abs(value - size.low) > DRAWN_M
        case Relation.LESS:
            return value < size.low - slack
        case Relation.AT_MOST:
            return value <= size.low + slack
        case Relation.MORE:
            return value > size.low + slack
        case Relation.AT_LEAST:
            return value >= size.low - slack
        case Relation.BETWEEN:
            low, high = sorted((size.low, size.high or size.low))
            return low - slack <= value <= high + slack
