"""What restricts: colours, threads, adjectives, sizes; what cannot be checked is said."""

from __future__ import annotations

import colorsys
from collections.abc import Mapping, Sequence
from functools import partial

from querycad_contracts import DRAWING_M, Measure, Part, PartKind, Relation, SizeFilter
from querycad_language.lexicon import Adjective, lexicon
from querycad_segworker.relations.orders import ordered
from querycad_segworker.relations.roles import ROLES

from .candidates import Candidate, Request, kept, through
from .inventory import THREAD_TOLERANCE_M, Inventory, values_of
from .names import all_words

SURFACES = frozenset(kind for kind in PartKind if kind.is_surface) - {PartKind.FACE}
"""Kinds that are inner or outer by themselves: the outer cylinders are all of them, not those farthest out."""
THREAD_M = (0.02e-3, THREAD_TOLERANCE_M)
"""Holes of a thread have a diameter of its tables, two digits of a millimetre; where none has, one near to it."""
_COMPARED = (Relation.LESS, Relation.AT_MOST, Relation.MORE, Relation.AT_LEAST)
NEAR = 0.02  # a nominal size may differ by this share from what is modelled


def colored(request: Request, way: Candidate) -> Sequence[Candidate]:
    """Those of a colour: 'the red bolts'; a colour without a noun, or of a body, is one of bodies."""
    if not request.query.colors:
        return [way]
    color = request.query.colors[0]
    ways = kept(way, [p for p in way.parts if _has_color(p, color)], "color", f"'{color}'")
    if request.query.noun in ("", "body", "object"):
        bodies = [b for b in request.inventory.bodies if _has_color(b, color)]
        if bodies and not any(b in way.parts for b in bodies):
            ways = [*ways, way.to(bodies, "color_agrees")]
    return ways


def _has_color(part: Part, name: str) -> bool:
    """Does a part's colour go by this name? Greys by saturation below 15 %, black and white by brightness."""
    if part.color is None:
        return False
    hue, saturation, value = colorsys.rgb_to_hsv(*(int(part.color[i : i + 2], 16) / 255 for i in (1, 3, 5)))
    gray = saturation < 0.15
    if name == "black":
        return value < 0.2
    if name == "white":
        return gray and value > 0.9
    if name in ("gray", "silver"):
        return gray and 0.2 <= value <= 0.9
    low, high = lexicon().hues[name]
    inside = low <= hue * 360 < high if low < high else hue * 360 >= low or hue * 360 < high
    return not gray and value >= 0.2 and inside


def threaded(request: Request, way: Candidate) -> Sequence[Candidate]:
    """Those that a thread's name marks, or that are drawn for it: 'the M5 holes'. Their labels say as which."""
    if not request.query.threads:
        return [way]
    name, threads = request.query.threads[0], lexicon().threads
    plain, long, _ = name.partition("x")
    bodies = {p.id: all_words(p.name) for p in way.parts if p.kind == "body"}
    named = {i: {word.partition("x")[0] for word in words} & threads.keys() for i, words in bodies.items()}
    # the body's name states the length, too, where the question does: 'M5x16'
    marked = [p for p in way.parts if plain in named.get(p.id, ()) and (not long or name in bodies[p.id])]
    others = [p for p in way.parts if not named.get(p.id)]
    if way.parts and not marked and not others:  # a screw that is called M5 is no M6 one
        return [way.to((), "thread_empties")]
    holes = threads.get(name) or threads.get(plain) or {}
    exact, near = ([part for p in others if (part := _drawn_for(p, name, holes, by)) is not None] for by in THREAD_M)
    return kept(way, marked or exact or near, "thread", f"'{name}'")


def _drawn_for(part: Part, name: str, holes: Mapping[str, float], near_m: float) -> Part | None:
    """The part, with what its diameter is to a thread in its label: 'tap drill of M6'; None where it is nothing."""
    sizes = values_of(part, Measure.DIAMETER)
    left = ("pitch",) if near_m == THREAD_M[0] else ("pitch", "core")  # cores lie near the drills of other threads
    apart = {role: min(abs(v - d) for v in sizes) for role, d in holes.items() if sizes and role not in left}
    role = min(apart, key=apart.__getitem__, default="")
    if not role or apart[role] > near_m:
        return None
    drawn = f"{role} clearance" if role in ("close", "medium", "loose") else role
    return part.model_copy(update={"label": f"{part.label}; {drawn} of {name.upper().replace('X', 'x')}"})


def narrowed(request: Request, way: Candidate) -> Sequence[Candidate]:
    """Adjectives, and what the parts must not have; words that are not known, which the names of bodies may hold."""
    inventory, query = request.inventory, request.query
    ways = through([way], query.adjectives, partial(_adjective, request))
    for adjective in (lexicon().adjectives[name] for name in query.lacking if name in lexicon().adjectives):
        tags = (*adjective.tags, *adjective.fallback[: 0 if adjective.loose else None])
        left = [(one, [p for p in one.parts if not inventory.has(p, tags)]) for one in ways]
        ways = [one.to(kept, "lacking" if kept else "adjective_empties") for one, kept in left]
    return [_unknown(inventory, one, query.unknown) for one in ways] if query.unknown else ways


def _unknown(inventory: Inventory, way: Candidate, words: Sequence[str]) -> Candidate:
    """Words that are not known: names of bodies or of the file may hold them."""
    marked = [p for p in way.parts if p.kind == "body" and all(word in all_words(p.name) for word in words)]
    if marked:
        return way.to(marked, "unknown_named")
    if inventory.file_named(words):
        return way.to(way.parts, "unknown_is_file")
    return way.to(way.parts, "unknown_words", float(len(words)), f"'{' '.join(words)}'")


def _adjective(request: Request, way: Candidate, name: str) -> Sequence[Candidate]:
    inventory, adjective = request.inventory, lexicon().adjectives.get(name)
    if adjective is None or not way.parts:
        return [way]
    able = [p for p in way.parts if not inventory.has(p, adjective.lacks)]
    having = [p for p in able if inventory.has(p, adjective.tags)]
    wider = [p for p in able if inventory.has(p, adjective.fallback)]
    if adjective.whole:
        return [way.to(way.parts, "whole_adjective" if way.features.get("whole_sense") else "adjective_nothing")]
    told = len(way.parts) == 1 or request.query.sample  # what one is, and all that are so, its tags tell
    if having and (not adjective.order or told or len(having) < len(way.parts) or having[0].kind in SURFACES):
        return [way.to(having, "adjective_agrees")]
    if wider:
        return [way.to(wider, "adjective_wider")]
    several = not (told and adjective.tags)
    if adjective.order and several and not all(inventory.has(p, adjective.opposite) for p in way.parts):
        return _ordered(request, way, adjective, name)
    only_lacks = adjective.lacks and not adjective.tags
    return [way.to(able, "adjective_agrees")] if only_lacks else _lacked(inventory, way, adjective, name)


def _lacked(inventory: Inventory, way: Candidate, adjective: Adjective, name: str) -> Sequence[Candidate]:
    """None of the parts is so: it is sure that there is none, or the word is left unchecked."""
    if adjective.decided and (ROLES.keys() >= set(adjective.tags) or all(p.kind.is_whole for p in way.parts)):
        return [way.to((), "adjective_agrees")]
    if not adjective.tags:
        return [way.to(way.parts, "adjective_unchecked" if adjective.unchecked else "adjective_nothing")]
    if adjective.loose:
        return [way.to(way.parts, "adjective_loose", unchecked=f"'{name}'")]
    denied = all(inventory.has(p, adjective.opposite + adjective.lacks) for p in way.parts)
    return kept(way, (), "denied" if denied else "adjective", f"'{name}'")


def _ordered(request: Request, way: Candidate, adjective: Adjective, name: str) -> Sequence[Candidate]:
    """Those that are most so: 'the large holes', 'the central hole' where none is in the middle."""
    order, model, parts = adjective.order, request.inventory.model, list(way.parts)
    if order is not None and model is not None:
        parts = ordered(way.parts, order, adjective.most, request.query.count, model)
    empty = [way.to((), "adjective_empties")] if adjective.tags else []  # the nearest to the middle is not 'central'
    if len(parts) == len(way.parts):
        return [way.to(parts, "adjective_nothing"), *empty]
    dropped = way.to(way.parts, "adjective_dropped", unchecked=f"'{name}'")
    return [way.to(parts, "adjective_order"), dropped, *empty]


def sized(request: Request, way: Candidate) -> Sequence[Candidate]:
    """Those with the stated sizes: 'the 5 mm holes'."""
    return through([way], request.query.sizes, _of_size)


def _of_size(way: Candidate, size: SizeFilter) -> Sequence[Candidate]:
    values = [(p, values_of(p, size.measure)) for p in way.parts]
    every = size.relation is Relation.UNEQUAL  # of a stepped hole that is no 16 mm hole no step has 16 mm
    exact = [p for p, own in values if (all if every else any)(compares(v, size) for v in own)]
    if not exact and size.relation in _COMPARED and values and all(own for _, own in values):
        return [way.to((), "size_agrees")]  # that no hole is wider than 80 mm is sure
    if not exact and size.relation in (Relation.EQUAL, Relation.ABOUT):
        near = [p for p, own in values if any(abs(v - size.low) <= NEAR * size.low for v in own)]
        if near:
            return [way.to(near, "size_near")]
    return kept(way, exact, "size", f"'{size.low * 1e3:.4g} mm'")


def compares(value: float, size: SizeFilter) -> bool:
    """Does a value compare so with a stated size? Metres; equal is to drawing accuracy or a fifth of a per cent."""
    low, slack = size.low, min(1e-6, 1e-3 * abs(size.low))
    apart, (least, most) = abs(value - low), sorted((low, size.high or low))
    return {
        Relation.EQUAL: apart <= max(DRAWING_M if low > 1e-3 else 0.05 * low, 0.002 * low),
        Relation.ABOUT: apart <= 0.1 * low,
        Relation.UNEQUAL: apart > DRAWING_M,
        Relation.LESS: value < low - slack,
        Relation.AT_MOST: value <= low + slack,
        Relation.MORE: value > low + slack,
        Relation.AT_LEAST: value >= low - slack,
        Relation.BETWEEN: least - slack <= value <= most + slack,
    }[size.relation]
