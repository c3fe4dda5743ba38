"""Grounding: from a description in words to parts of one model. Deterministic; what is not understood is said."""

from __future__ import annotations

import difflib
from collections import Counter
from collections.abc import Sequence
from dataclasses import replace

from querycad_contracts import Grounding, Part, Side
from querycad_segworker.tolerances import FACING
from querycad_segworker.vectors import dot

from .choosing import Parts, is_narrowed, seen_from, turned_to
from .lexicon import Lexicon, lexicon
from .names import bodies_marked, bodies_named, is_whole, name_words, same_word, vocabulary
from .places import carries
from .reading import Reading, read
from .sizes import at_ends

AT_END_CONFIDENCE = 0.7
"""'The holes at the top' that look elsewhere are the topmost ones."""
NAME_PART_CONFIDENCE = 0.8
"""A body that has the words in its name, but not as its noun."""


def ground(parts: Sequence[Part], description: str, sides: Sequence[Side] | None) -> Grounding:
    """Which of `parts` does `description` mean, of those visible from any of `sides`?

    Names of bodies come first, then the lexicon, then the name of the whole model. What a word means is decided on the
    whole model; sides only choose among the parts it means.
    """
    words = lexicon()
    asked = tuple(Side(side) for side in sides) if sides is not None else None
    reading = read(description, words, vocabulary(parts))
    asked = asked if asked is not None or not reading.toward else tuple(reading.toward)
    model = Parts(parts, words)
    if any(adjective.whole for adjective in reading.adjectives) and reading.term is not None:
        whole = is_whole(parts, reading.phrase.split())
        if whole is not None:
            return _grounding(description, asked, [whole], reading)
    whole = is_whole(parts, reading.words) if len(reading.words) > 1 else None
    if whole is not None and not is_narrowed(reading, asked):  # 'the brake disc' of the file 'brake_disc'
        return _grounding(description, asked, [whole], reading)
    named = model.named(reading, asked)
    if named and _is_by_head_only(named, reading) and reading.term is not None:
        known = _understood(model, replace(reading, unknown=[], notes=[], places=list(reading.places)), asked)
        named = [] if known and known[0].kind not in ("body", "model") else named
    if named:
        reading.unknown.clear()
        return _grounding(description, asked, model.as_named(model.told_apart(named, reading), reading), reading)
    found: list[Part] = []
    if reading.term is not None and not reading.head_unknown:
        found = _understood(model, reading, asked)
    elif marked := model.marked(reading):
        reading.unknown.clear()
        reading.doubt("the words are taken from the names of bodies", NAME_PART_CONFIDENCE)
        found = marked
    if found:
        if seen := _there(model, found, reading, asked):
            return _grounding(description, asked, model.told_apart(seen, reading, asked), reading)
        return _missing(parts, description, asked, reading, len(found))
    whole = is_whole(parts, reading.words) or _block(model, reading)
    if whole is not None:
        return _grounding(description, asked, [whole], reading)
    return _missing(parts, description, asked, reading, 0)


def _there(model: Parts, found: list[Part], reading: Reading, sides: Sequence[Side] | None) -> list[Part]:
    """Those on the sides asked for; else those at that end, or those that face there though their body is covered."""
    seen = turned_to(seen_from(found, sides), reading.toward)
    if not seen and sides and reading.one and reading.term is not None:
        seen = model.presumed(found, reading, sides)
    if not seen and reading.toward:
        seen = at_ends(found, reading.toward, model.model)
        reading.doubt(f"none is visible from the {reading.toward[0]}: those at that end were taken", AT_END_CONFIDENCE)
    if not seen and sides and any(model.named(place.what, None) for place in reading.places):
        seen = [part for part in found if part.normal and any(dot(part.normal, s.outward) > FACING.side for s in sides)]
        if seen:  # 'on the underside of the carriage': the rail below it does not change that
            reading.doubt(f"none is visible from the {sides[0]}: what faces there was taken", AT_END_CONFIDENCE)
    return seen


def _is_by_head_only(named: Sequence[Part], reading: Reading) -> bool:
    """Do the words 'screw head' share nothing but 'head' with a body named 'cylinder head'?

    A word for a shape that the bodies have, as of a 'rectangular pin', speaks for them.
    """
    said = reading.phrase.split()
    have = [name_words(part.name) for part in named]
    shape = lexicon().adjectives.get(said[0]) if len(said) == 2 else None
    if shape is not None and all(set(shape.tags) & set(part.tags) for part in named):
        return False
    return len(said) > 1 and all(len(words) > 1 and not set(said[:-1]) & set(words) for words in have)


def _understood(model: Parts, reading: Reading, sides: Sequence[Side] | None) -> list[Part]:
    """The parts of a known noun: of several, those whose names hold the words that are not known."""
    assert reading.term is not None
    whole = is_whole(model.all, reading.words) or is_whole(model.all, reading.phrase.split())
    if reading.term.product and whole is not None and not is_narrowed(reading, sides):
        reading.ignore_unknown()
        return [whole]
    whole = is_whole(model.all, reading.words) if reading.term.product else None
    if whole is not None:
        return [whole]
    reading.unknown = [word for word in reading.unknown if is_whole(model.all, [word]) is None]
    _compound(model, reading, apart=True)
    found = model.choose(reading, sides)
    if not found and _compound(model, reading, apart=False):
        found = model.choose(reading, sides)
    if found and reading.unknown and all(part.kind == "body" for part in found):
        marked = bodies_marked(found, reading.unknown)
        if marked:
            reading.unknown.clear()
            return marked
    if found and not is_narrowed(reading, sides) and _is_one(model, reading, found):
        return [model.model] if model.model is not None else found
    reading.ignore_unknown()
    return _of_the_named(model, reading, found)


def _compound(model: Parts, reading: Reading, apart: bool) -> bool:
    """Reads 'the legs of the fork' as fork legs, where that is a term: one that is known to be said `apart`, or any.

    'The bore of the cylinder' is the cylinder bore; other nouns are read so where the model has no other legs.
    """
    for place in reading.places:
        compound = f"{place.what.phrase} {reading.phrase}"
        term = model.words.terms.get(compound)
        if apart and (term is None or not term.apart or model.named(place.what, None)):
            continue
        if place.relation in ("", "of", "in") and term is not None:
            reading.places.remove(place)
            reading.term, reading.phrase = term, compound
            reading.count = reading.count or place.what.count
            return True
    return False


def _of_the_named(model: Parts, reading: Reading, found: list[Part]) -> list[Part]:
    """'Screw heads' are those of the bodies that are called screws: what stands out is part of what carries it.

    A 'screw hole' lies elsewhere: it is for a screw.
    """
    first = reading.phrase.split()[:-1]
    if not first or not all(part.kind.stands_out for part in found):
        return found
    owners = bodies_named(model.all, first, None)
    return [part for part in found if any(carries(owner, part) for owner in owners)] or found


def _is_one(model: Parts, reading: Reading, found: Sequence[Part]) -> bool:
    """Does the noun mean the whole model? A file named after it holds one of them, whatever else it might name."""
    plain = not (reading.adjectives or reading.threads or reading.colors or reading.places)
    features = len(found) > 1 and all(part.kind != "body" for part in found)
    if not (plain and features and model.alone) or is_whole(model.all, reading.words) is None:
        return False
    called = name_words(model.model.name if model.model is not None else None)
    return same_word(called[-1], reading.words[-1])  # the pipe of a 'pipe_elbow' is part of it


def _block(model: Parts, reading: Reading) -> Part | None:
    """'the manifold block': the whole model, where a single body is called so by name and shape."""
    known = reading.term is not None and not reading.head_unknown
    if not known or not model.alone or model.model is None:
        return None
    products = [place for place in reading.places if place.relation == "" and place.what.term is not None]
    named = any(p.what.term is not None and p.what.term.product for p in products)
    named = named or any(is_whole(model.all, place.what.words) for place in products)
    return model.model if named and reading.term is not None and reading.term.name in _SHAPES else None


_SHAPES = frozenset(("pad", "plate", "disc", "cylinder", "object", "body", "hexagon", "tube", "cuboid"))
"""Shape nouns that may follow the name of a product: 'manifold block', 'cover plate', 'pump body'."""


def _missing(
    parts: Sequence[Part], description: str, sides: tuple[Side, ...] | None, reading: Reading, elsewhere: int
) -> Grounding:
    """Why nothing was found: a word that is not known, or a part that the model does not have or show there."""
    words = lexicon()
    understood = reading.term is not None and not reading.head_unknown
    if not understood:
        what = " ".join(reading.unknown) or description.removeprefix("the ").strip()
        nearest, message = _nearest(what, parts, words), f"'{what}' is not a part that is known here"
    else:
        said = description.removeprefix("the ")
        nearest, message = _present(parts), f"the model has no '{said}'"
        if elsewhere and sides:
            place = " or ".join(sides)
            message = f"the model has {elsewhere} x '{said}', but none visible from {place}"
    return Grounding(
        description=description,
        sides=sides,
        parts=(),
        understood=understood,
        nearest=nearest,
        message=message,
        warnings=tuple(dict.fromkeys(reading.notes)),
    )


def _grounding(description: str, sides: tuple[Side, ...] | None, found: Sequence[Part], reading: Reading) -> Grounding:
    notes = tuple(dict.fromkeys(reading.notes))
    if reading.confidence < 1.0:
        found = [_less_sure(part, reading.confidence, "; ".join(notes)) for part in found]
    return Grounding(description=description, sides=sides, parts=tuple(found), understood=True, warnings=notes)


def _less_sure(part: Part, confidence: float, notes: str) -> Part:
    evidence = part.evidence
    reason = f"{evidence.reason}; {notes}" if notes else evidence.reason
    changed = evidence.model_copy(update={"confidence": min(evidence.confidence, confidence), "reason": reason})
    return part.model_copy(update={"evidence": changed})


def _nearest(what: str, parts: Sequence[Part], words: Lexicon) -> tuple[str, ...]:
    """Known terms that are spelt alike, then what the model has."""
    alike = difflib.get_close_matches(what, list(words.terms), n=3, cutoff=0.6)
    names = list(dict.fromkeys(words.terms[phrase].name for phrase in alike))
    return tuple(dict.fromkeys([*names, *_present(parts)]))


def _present(parts: Sequence[Part]) -> tuple[str, ...]:
    """The kinds of part that the model has, most frequent first; 'body' last, as every model has one."""
    counts = Counter(part.kind for part in parts)
    return tuple(sorted(counts, key=lambda kind: (kind == "body", -counts[kind], kind)))
