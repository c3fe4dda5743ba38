"""Grounding: from a description in words to parts of one model. Deterministic; what is not understood is said."""

from __future__ import annotations

import colorsys
import difflib
from collections import Counter
from collections.abc import Iterable, Sequence

from querycad_contracts import Grounding, Part, Side

from .lexicon import Adjective, Choice, Lexicon, lexicon, words_of
from .names import bodies_named, is_whole, vocabulary
from .reading import Reading, read

METRIC_TOLERANCE_M = 0.06e-3
"""A bore this near to a standard diameter has it: half the step between neighbouring tap drill sizes."""


def ground(parts: Sequence[Part], description: str, sides: Sequence[Side] | None) -> Grounding:
    """Which of `parts` does `description` mean, of those visible from any of `sides`?

    Names of bodies come first, then the lexicon, then the name of the whole model.
    """
    words = lexicon()
    asked = tuple(Side(side) for side in sides) if sides is not None else None
    reading = read(description, words, vocabulary(parts))
    visible = [part for part in parts if asked is None or set(asked) & set(part.sides)]
    named = _narrowed(bodies_named(parts, reading.words, asked), (), reading, words)
    if named:
        reading.unknown.clear()
        return _grounding(description, asked, named, reading)
    if reading.term is not None and not reading.head_unknown:
        reading.unknown = [word for word in reading.unknown if is_whole(parts, [word]) is None]
        reading.ignore_unknown()
        found = _choose(visible, reading, words)
        if found:
            return _grounding(description, asked, found, reading)
    whole = is_whole(parts, reading.words)
    if whole is not None:
        return _grounding(description, asked, [whole], reading)
    return _missing(parts, description, asked, reading)


def _missing(parts: Sequence[Part], description: str, sides: tuple[Side, ...] | None, reading: Reading) -> Grounding:
    """Why nothing was found: a word that is not known, or a part that the model does not have or show there."""
    words = lexicon()
    understood = reading.term is not None and not reading.head_unknown
    if not understood:
        what = " ".join(reading.unknown) or description.strip()
        nearest, message = _nearest(what, parts, words), f"'{what}' is not a part that is known here"
    else:
        elsewhere = _choose(parts, reading, words) if sides is not None else []
        nearest, message = _present(parts), f"the model has no '{description}'"
        if elsewhere and sides:
            place = " or ".join(sides)
            message = f"the model has {len(elsewhere)} x '{description}', but none visible from {place}"
    return Grounding(
        description=description,
        sides=sides,
        parts=(),
        understood=understood,
        nearest=nearest,
        message=message,
        warnings=tuple(reading.notes),
    )


def _grounding(description: str, sides: tuple[Side, ...] | None, found: Sequence[Part], reading: Reading) -> Grounding:
    if reading.confidence < 1.0:
        notes = "; ".join(reading.notes)
        found = [_less_sure(part, reading.confidence, notes) for part in found]
    return Grounding(
        description=description, sides=sides, parts=tuple(found), understood=True, warnings=tuple(reading.notes)
    )


def _less_sure(part: Part, confidence: float, notes: str) -> Part:
    evidence = part.evidence
    reason = f"{evidence.reason}; {notes}" if notes else evidence.reason
    changed = evidence.model_copy(update={"confidence": min(evidence.confidence, confidence), "reason": reason})
    return part.model_copy(update={"evidence": changed})


def _choose(parts: Sequence[Part], reading: Reading, words: Lexicon) -> list[Part]:
    """The parts of the first reading of the term that finds any."""
    assert reading.term is not None
    alone = sum(part.kind == "body" for part in parts) == 1
    # The name of a single body says what the whole is, not which of its features is meant: looked at last.
    for choice in sorted(reading.term.choices, key=lambda choice: alone and bool(choice.name)):
        found = _narrowed([part for part in parts if _fits(part, choice, words)], parts, reading, words)
        found = _pick(found, choice.pick)
        if found:
            if choice.confidence < 1.0:
                reading.confidence = min(reading.confidence, choice.confidence)
                reading.notes.append(f"'{reading.phrase}' was taken in a wider sense")
            return found
    return []


def _narrowed(found: list[Part], parts: Sequence[Part], reading: Reading, words: Lexicon) -> list[Part]:
    """Those that adjectives, threads and colours hold for, and that lie in the places named, looked for in `parts`."""
    found = [part for part in found if all(_has(part, adjective, words) for adjective in reading.adjectives)]
    found = [part for part in found if not any(set(a.tags) & set(part.tags) for a in reading.without)]
    found = [part for part in found if all(_is_metric(part, words.metric_m[name]) for name in reading.metric)]
    found = [part for part in found if all(_has_color(part.color, name, words) for name in reading.colors)]
    for term in reading.inside if found and parts else ():
        places = bodies_named(parts, [term.name], None) or _choose(parts, Reading(term=term, phrase=term.name), words)
        found = [part for part in found if any(_is_inside(part, place) for place in places if place.id != part.id)]
    return found


def _is_inside(part: Part, place: Part) -> bool:
    """Does the middle of the part lie in the box of the place?"""
    return all(
        abs(c - middle) <= extent / 2 + 1e-6
        for c, middle, extent in zip(part.center, place.center, place.extents, strict=True)
    )


def _fits(part: Part, choice: Choice, words: Lexicon) -> bool:
    tags = _tags(part, words)
    return (
        part.kind in choice.kind
        and tags.issuperset(choice.tags)
        and (not choice.any or not tags.isdisjoint(choice.any))
        and tags.isdisjoint(choice.without)
        and (not choice.name or _name_holds(part.name, choice.name))
    )


def _tags(part: Part, words: Lexicon) -> set[str]:
    """The part's own tags, and the inferred one of a standard core diameter."""
    tags = set(part.tags)
    if part.kind == "hole" and part.diameter is not None:
        cores = (diameters[0] for diameters in words.metric_m.values())
        if any(abs(part.diameter - core) <= METRIC_TOLERANCE_M for core in cores):
            tags.add("core_diameter")
    return tags


def _has(part: Part, adjective: Adjective, words: Lexicon) -> bool:
    return not adjective.tags or not _tags(part, words).isdisjoint(adjective.tags)


def _is_metric(part: Part, diameters_m: Iterable[float]) -> bool:
    return part.diameter is not None and any(abs(part.diameter - d) <= METRIC_TOLERANCE_M for d in diameters_m)


def _has_color(color: str | None, name: str, words: Lexicon) -> bool:
    """Does a hexadecimal colour go by this name? Greys by saturation below 15 %, black and white by brightness."""
    if color is None:
        return False
    r, g, b = (int(color[i : i + 2], 16) / 255 for i in (1, 3, 5))
    hue, saturation, value = colorsys.rgb_to_hsv(r, g, b)
    if name == "black":
        return value < 0.2
    if name == "white":
        return saturation < 0.15 and value > 0.9
    if name in ("grey", "gray"):
        return saturation < 0.15 and 0.2 <= value <= 0.9
    low, high = words.hues[name]
    degrees = hue * 360
    inside = low <= degrees < high if low < high else degrees >= low or degrees < high
    return saturation >= 0.15 and value >= 0.2 and inside


def _name_holds(name: str | None, wanted: Iterable[str]) -> bool:
    """Does a product name hold one of these words, or runs of words such as 'iso 4762'?"""
    text = f" {' '.join(words_of((name or '').replace('_', ' ')))} "
    return any(f" {word} " in text or f" {word}s " in text for word in wanted)


def _pick(parts: list[Part], pick: str | None) -> list[Part]:
    if not parts or pick is None:
        return parts
    if pick == "lowest":
        lowest = min(part.center[2] - part.extents[2] / 2 for part in parts)
        near = 0.02 * max(part.extents[2] for part in parts) + 1e-9
        return [part for part in parts if part.center[2] - part.extents[2] / 2 <= lowest + near]
    sizes = [part.radius or max(part.extents) for part in parts]
    limit = max(sizes) if pick == "largest" else min(sizes)
    return [part for part, size in zip(parts, sizes, strict=True) if abs(size - limit) <= 1e-3 * limit]


def _nearest(what: str, parts: Sequence[Part], words: Lexicon) -> tuple[str, ...]:
    """Known terms that are spelt alike, then what the model has."""
    alike = difflib.get_close_matches(what, list(words.terms), n=3, cutoff=0.6)
    names = list(dict.fromkeys(words.terms[phrase].name for phrase in alike))
    return tuple(dict.fromkeys([*names, *_present(parts)]))


def _present(parts: Sequence[Part]) -> tuple[str, ...]:
    """The kinds of part that the model has, most frequent first; 'body' last, as every model has one."""
    counts = Counter(part.kind for part in parts)
    return tuple(sorted(counts, key=lambda kind: (kind == "body", -counts[kind], kind)))
