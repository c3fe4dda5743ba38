"""What a noun means on one model: the senses that it has parts for, names of bodies, the whole."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from querycad_contracts import PartKind, PartQuery
from querycad_language.lexicon import Noun, Sense, lexicon
from querycad_language.measures import WHOLE
from querycad_language.tokens import is_english

from .candidates import Candidate, Request, taken_for, true_of
from .inventory import Inventory
from .names import share

SOLID = frozenset((PartKind.BODY, PartKind.PIPE, PartKind.RING_SECTOR, PartKind.TORUS, PartKind.GEAR))
"""Kinds that all of a model can be: a pin, a nut, a ring. No model is a keyway or a head."""
PIECES = (PartKind.COUNTERBORE, PartKind.COUNTERSINK, PartKind.SPOTFACE)
"""Pieces of holes: who says 'the holes' does not mean them, nor other cuts who says 'the counterbores'."""
KIN = (
    PIECES,
    tuple(kind for kind in PartKind if kind.cuts_in),
    (*(kind for kind in PartKind if kind.stands_out), PartKind.WALL, PartKind.TOOTH),
    (*(kind for kind in PartKind if kind.breaks_edge), PartKind.TORUS),
)
"""Kinds that people take for one another: a pocket may be called a notch, a rib a lug."""
GUESSES = 32  # so many groups of like parts may be what a noun means
_GENERIC = {"whole_generic": 1.0, "whole_sense": 1.0}
NAMELESS = frozenset((PartKind.DEPRESSION, PartKind.ELEVATION))
"""Kinds of what no family has taken: a word means them where it means nothing else."""


def bases(request: Request) -> Iterator[Candidate]:
    """Every sense of the noun that the model has parts for, names of bodies, and the whole model."""
    inventory, query = request.inventory, request.query
    noun = lexicon().nouns.get(query.noun) if query.known else None
    words = [word for word in query.words if word not in {"the", *lexicon().wholes}] or query.noun.split()
    named = list(_by_name(inventory, words, query.noun.split()))
    yield from named
    if lexicon().wholes & set(query.adjectives) and inventory.model is not None:
        yield Candidate((inventory.model,), _GENERIC)  # 'the complete dish'
    if noun is not None:
        found = list(_senses(inventory, noun, query, query.noun))
        yield from found
        if all(not way.parts or "kin_instead" in way.features for way in found):
            yield from _others(inventory, query, words)  # 'counterbore cutter'
        if not (named or request.depth):
            yield from _guessed(inventory, query, [kind for sense in noun.senses for kind in sense.kind])  # 'the latch'
        others = query.plural or query.places or query.sides or query.ends or query.ranks or query.sizes
        solid = any(not SOLID.isdisjoint(sense.kind) and not sense.name for sense in noun.senses)
        generic = query.deictic or (query.definite and not others and solid and inventory.alone)
        nearest = any(way.features.get("sense_rank") == 0 for way in found)
        thing = bool(noun.senses and noun.senses[0].name) and not (nearest or others or request.depth)
        generic = generic or (thing and inventory.alone)
        if generic and not noun.product and not query.plural and inventory.model is not None:
            yield Candidate((inventory.model,), _GENERIC)  # 'the pin', 'the plug' is all there is, 'this pin' may be
    elif not query.noun:
        yield Candidate(tuple(inventory.kinds.get("hole") or inventory.parts), {"no_noun": 1.0})
    elif not named:
        yield from _unknown(inventory, query, words)


def _by_name(inventory: Inventory, words: Sequence[str], noun: Sequence[str]) -> Iterator[Candidate]:
    """Bodies that are called so, and the model where its file is."""
    called, bodies = False, [] if inventory.alone else inventory.bodies
    for body_words in dict.fromkeys((tuple(words), tuple(noun))):
        shares = [share(body.name, body_words) for body in bodies]
        best = max(shares, default=0.0)
        if best > 0:
            called = called or best == 1.0
            named = tuple(body for body, own in zip(bodies, shares, strict=True) if own == best)
            yield Candidate(named, {"by_name": 1.0, "name_share": best, "name_all": float(best == 1.0)})
    if inventory.model is not None and inventory.file_named(words) and not called:  # 'cap' in 'bottle with cap'
        features = {"file_named": 1.0, "whole_sense": 1.0, "named_words": float(len(words) > 1)}
        yield Candidate((inventory.model,), features)


def _others(inventory: Inventory, query: PartQuery, words: Sequence[str]) -> Iterator[Candidate]:
    """What other words of a phrase mean whose noun the model lacks."""
    for word in words[:-1]:
        if (noun := lexicon().nouns.get(word)) is not None and not noun.product:
            found = _senses(inventory, noun, query, word)
            yield from (way.to(way.parts, "modifier_means") for way in found if way.parts)


def _unknown(inventory: Inventory, query: PartQuery, words: Sequence[str]) -> Iterator[Candidate]:
    """Nothing is known of the noun: its last word may be one, or it is what the whole model is."""
    last = lexicon().nouns.get(words[-1]) if words else None
    if last is not None and len(words) > 1:
        for way in _senses(inventory, last, query, words[-1]):
            yield way.to(way.parts, "unknown_words", float(len(words) - 1), f"'{' '.join(words[:-1])}'")
    if inventory.model is not None and not query.plural:
        yield Candidate((inventory.model,), {"unknown_whole": 1.0, "whole_sense": 1.0})
    yield from _guessed(inventory, query)
    yield Candidate((), {"unknown_noun": 1.0}, (f"'{query.noun}'",))


def _guessed(inventory: Inventory, query: PartQuery, own: Sequence[str] = ()) -> Iterator[Candidate]:
    """Parts of one kind and size, of other kinds than the noun's `own`: 'a cell' may be any of the fifteen pockets."""
    if not all(map(is_english, query.noun.split())):
        return
    but = (*own, *PIECES) if PartKind.HOLE in own else own
    groups = [group for group in inventory.alike if group[0].kind not in but and (len(group) > 1 or not query.plural)]
    for group in groups[:GUESSES]:
        yield Candidate(tuple(group), {"guessed": 1.0}, (taken_for(query.noun, group[0].kind),))


def _senses(inventory: Inventory, noun: Noun, query: PartQuery, said: str) -> Iterator[Candidate]:
    """The parts of each sense; any of the kind, or of a kind like it; of a product the whole. `said`: the noun."""
    picked = query.plural or query.adjectives or query.sizes or query.ranks or query.threads or query.places
    plain = {_unpicked(sense): sense.stretch for sense in noun.senses if sense.pick is None and picked}
    seen: set[tuple[str, ...]] = set()
    for sense in noun.senses:
        if sense.pick is not None and plain.get(_unpicked(sense), 1.0) < sense.stretch:
            continue  # the largest is meant where nothing else is said that picks: 'the bore'
        parts = inventory.of_sense(sense)
        key = tuple(part.id for part in parts)
        if not parts or key in seen or (seen and NAMELESS.issuperset(sense.kind)):
            continue
        whole = parts[0].kind == "model"
        rank = {"sense_stretch": sense.stretch, "sense_rank": float(len(seen))}
        told = true_of(sense_named=bool(sense.name), whole_sense=whole, whole_alone=whole and inventory.alone)
        seen.add(key)
        yield Candidate(tuple(parts), rank | told)
    own = len(seen)
    for way in _wider(inventory, noun.senses, said):
        key = tuple(part.id for part in way.parts)
        if key and key not in seen:
            seen.add(key)
            yield way if own else way.to(way.parts, "kin_instead")
    if noun.product and inventory.model is not None and not any("model" in sense.kind for sense in noun.senses):
        yield Candidate((inventory.model,), {"whole_sense": 1.0, "sense_stretch": 0.5})
    if not own:
        yield Candidate((), {"nothing": 1.0})


def _unpicked(sense: Sense) -> Sense:
    return replace(sense, pick=None, stretch=0.0)


def _wider(inventory: Inventory, senses: Sequence[Sense], said: str) -> Iterator[Candidate]:
    """Any hole, where a bearing seat is asked for; then those of each kind that people take for it."""
    own = next((sense.kind for sense in senses if not sense.name), ())
    if not WHOLE.isdisjoint(own):
        return
    yield Candidate(tuple(inventory.kinds.get(*own)), {"sense_wide": 1.0})
    kinds = next((kin for kin in KIN if not set(own).isdisjoint(kin)), ())
    for kind in kinds:
        if kind in PIECES and PartKind.HOLE in own:
            continue
        hole = {"kin_hole": 1.0} if kind is PartKind.HOLE else {}
        yield Candidate(tuple(inventory.kinds.get(kind)), {"sense_kin": 1.0, **hole}, (taken_for(said, kind),))
