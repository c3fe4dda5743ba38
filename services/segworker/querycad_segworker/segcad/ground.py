"""Grounding: from a description in words to parts of one model. Deterministic; what is not understood is said."""

from __future__ import annotations

import colorsys
import difflib
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from rapidfuzz.distance import OSA

from querycad_contracts import Grounding, Part, Side

from .lexicon import FILLERS, Adjective, Choice, Lexicon, Term, lexicon, singular, words_of

TYPO_MIN_LETTERS = 4
"""Shorter words have too many neighbours: 'nut' and 'cut' differ by one letter."""
TYPO_SUBSTITUTION_LETTERS = 6
"""In shorter words one letter instead of another makes another word ('cone', 'core'); swapped, missing and doubled
letters hardly do."""
METRIC_TOLERANCE_M = 0.06e-3
"""A bore this near to a standard diameter has it: half the step between neighbouring tap drill sizes."""


@dataclass(slots=True)
class _Reading:
    """What the words of a description were taken for."""

    term: Term | None = None
    phrase: str = ""
    """The words that named the term."""
    inside: list[Term] = field(default_factory=list)
    """Nouns before the head noun: where it is, as in 'flange hole'."""
    adjectives: list[Adjective] = field(default_factory=list)
    without: list[Adjective] = field(default_factory=list)
    metric: list[str] = field(default_factory=list)
    colors: list[str] = field(default_factory=list)
    unknown: list[str] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    confidence: float = 1.0


def ground(parts: Sequence[Part], description: str, sides: Sequence[Side] | None) -> Grounding:
    """Which of `parts` does `description` mean, of those visible from any of `sides`?"""
    words = lexicon()
    reading = _read(description, words)
    asked = tuple(sides) if sides is not None else None
    visible = [part for part in parts if asked is None or set(asked) & set(part.sides)]
    named = _named(visible, parts, description, reading)
    if named is not None:
        return _grounding(description, asked, named, reading)
    if reading.term is None or reading.unknown:
        what = " ".join(reading.unknown) or description.strip()
        nearest = _nearest(what, parts, words)
        return Grounding(
            description=description,
            sides=asked,
            parts=(),
            understood=False,
            nearest=nearest,
            message=f"'{what}' is not a part that is known here",
            warnings=tuple(reading.notes),
        )
    found = _choose(visible, reading, words)
    if not found:
        elsewhere = _choose(parts, reading, words) if asked is not None else []
        place = " or ".join(asked) if asked else ""
        message = (
            f"the model has {len(elsewhere)} x '{description}', but none visible from {place}"
            if elsewhere
            else f"the model has no '{description}'"
        )
        return Grounding(
            description=description,
            sides=asked,
            parts=(),
            understood=True,
            nearest=_present(parts),
            message=message,
            warnings=tuple(reading.notes),
        )
    return _grounding(description, asked, found, reading)


def _grounding(description: str, sides: tuple[Side, ...] | None, found: Sequence[Part], reading: _Reading) -> Grounding:
    if reading.confidence < 1.0:
        notes = "; ".join(reading.notes)
        found = [
            part.model_copy(
                update={
                    "evidence": part.evidence.model_copy(
                        update={
                            "confidence": min(part.evidence.confidence, reading.confidence),
                            "reason": part.evidence.reason + (f"; {notes}" if notes else ""),
                        }
                    )
                }
            )
            for part in found
        ]
    return Grounding(
        description=description, sides=sides, parts=tuple(found), understood=True, warnings=tuple(reading.notes)
    )


def _read(description: str, words: Lexicon) -> _Reading:
    """Takes the description apart: the longest known phrases first, the head noun last before 'with' or 'without'."""
    reading = _Reading()
    known = words.words | FILLERS | frozenset(words.metric_m) | frozenset(words.hues) | {"with", "without"}
    tokens = [_known_form(word, known, reading) for word in words_of(description)]
    head, rest = tokens, []
    for position, token in enumerate(tokens):
        if token in ("with", "without") and position > 0:
            head, rest = tokens[:position], tokens[position:]
            break
    _read_head(head, words, reading)
    while rest:
        negated, rest = rest[0] == "without", rest[1:]
        end = next((i for i, token in enumerate(rest) if token in ("with", "without")), len(rest))
        _read_with(rest[:end], negated, words, reading)
        rest = rest[end:]
    return reading


def _known_form(word: str, known: frozenset[str], reading: _Reading) -> str:
    """The singular; for a misspelt word its likely meaning, noted."""
    form = singular(word, known)
    if form in known or any(c.isdigit() for c in word) or len(word) < TYPO_MIN_LETTERS:
        return form
    spellings = {form, form[:-1]} if form.endswith("s") else {form}
    close = [other for other in sorted(known) if any(_is_typo(spelling, other) for spelling in spellings)]
    if not close:
        return form
    reading.notes.append(f"'{word}' was read as '{close[0]}'")
    reading.confidence *= 0.8
    return close[0]


def _is_typo(word: str, known: str) -> bool:
    """One slip of the keyboard away (optimal string alignment distance 1; 2 in words of ten letters and more)."""
    allowed = 2 if len(known) >= 10 else 1
    if len(known) < TYPO_MIN_LETTERS or OSA.distance(word, known, score_cutoff=allowed) > allowed:
        return False
    substituted = len(word) == len(known) and sorted(word) != sorted(known)
    return not substituted or len(known) >= TYPO_SUBSTITUTION_LETTERS


def _read_head(tokens: list[str], words: Lexicon, reading: _Reading) -> None:
    """The last noun is the head; nouns before it say where it is, words that are adjectives too are that before it."""
    position = 0
    while position < len(tokens):
        end, phrase = _longest_phrase(tokens, position, words)
        adjective = words.adjectives.get(phrase)
        noun_follows = any(_longest_phrase(tokens, i, words)[1] in words.terms for i in range(end, len(tokens)))
        if adjective is not None and (phrase not in words.terms or noun_follows):
            reading.adjectives.append(adjective)
            if adjective.unchecked:
                reading.notes.append(f"'{phrase}' was not checked against the geometry")
        elif phrase in words.terms:
            if reading.term is not None:
                reading.inside.append(reading.term)
            reading.term, reading.phrase = words.terms[phrase], phrase
        else:
            _read_word(tokens[position], words, reading)
        position = end


def _longest_phrase(tokens: Sequence[str], position: int, words: Lexicon) -> tuple[int, str]:
    """The longest known phrase that begins here, and where it ends; a single unknown word otherwise."""
    for end in range(len(tokens), position, -1):
        phrase = " ".join(tokens[position:end])
        if phrase in words.terms or phrase in words.adjectives:
            return end, phrase
    return position + 1, tokens[position]


def _read_word(word: str, words: Lexicon, reading: _Reading) -> None:
    if word in words.metric_m:
        reading.metric.append(word)
    elif word in words.hues or word in ("grey", "gray", "black", "white"):
        reading.colors.append(word)
    elif word not in FILLERS:
        reading.unknown.append(word)


def _read_with(tokens: list[str], negated: bool, words: Lexicon, reading: _Reading) -> None:
    """'with a ring', 'without thread': what follows is a trait of the head noun."""
    content = [token for token in tokens if token not in FILLERS]
    for end in range(len(content), 0, -1):
        phrase = " ".join(content[-end:])
        adjective = words.with_nouns.get(phrase) or words.adjectives.get(phrase)
        if adjective is not None:
            (reading.without if negated else reading.adjectives).append(adjective)
            for word in content[:-end]:
                _read_with([word], negated, words, reading)
            return
    reading.unknown.extend(content)


def _choose(parts: Sequence[Part], reading: _Reading, words: Lexicon) -> list[Part]:
    """The parts of the first reading of the term that finds any.

    In a file of several bodies the designer's own names come first: a body called 'shaft' is the shaft.
    """
    assert reading.term is not None
    bodies = [part for part in parts if part.kind == "body"]
    by_name = [part for part in bodies if len(bodies) > 1 and _name_holds(part.name, (reading.phrase,))]
    found = _narrowed(by_name, parts, reading, words)
    if found:
        return found
    for choice in reading.term.choices:
        found = _narrowed([part for part in parts if _fits(part, choice, words)], parts, reading, words)
        found = _pick(found, choice.pick)
        if found:
            if choice.confidence < 1.0:
                reading.confidence = min(reading.confidence, choice.confidence)
                reading.notes.append(f"'{reading.term.name}' was taken in a wider sense")
            return found
    return []


def _narrowed(found: list[Part], parts: Sequence[Part], reading: _Reading, words: Lexicon) -> list[Part]:
    """Those that all adjectives, names of threads and colours, and nouns of place hold for."""
    found = [part for part in found if all(_has(part, adjective, words) for adjective in reading.adjectives)]
    found = [part for part in found if not any(set(a.tags) & set(part.tags) for a in reading.without)]
    found = [part for part in found if all(_is_metric(part, words.metric_m[name]) for name in reading.metric)]
    found = [part for part in found if all(_has_color(part.color, name, words) for name in reading.colors)]
    for term in reading.inside if found else ():
        places = _choose(parts, _Reading(term=term, phrase=term.name), words)
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
    if not name:
        return False
    text = " " + " ".join(words_of(name.replace("_", " "))) + " "
    return any(f" {word}" in text for word in wanted)


def _named(visible: Sequence[Part], parts: Sequence[Part], description: str, reading: _Reading) -> list[Part] | None:
    """Bodies whose product name holds all the words that the lexicon does not explain; None when no word needs it."""
    wanted = [word for word in words_of(description) if word not in FILLERS]
    if not wanted or (reading.term is not None and not reading.unknown and not reading.colors):
        return None
    generic = reading.term is not None and reading.term.choices[0].kind == ("body",)
    needed = reading.unknown if generic and reading.unknown else wanted
    if not any(_all_words_in(part.name, needed) for part in parts if part.kind == "body"):
        return None
    reading.unknown.clear()
    return [part for part in visible if part.kind == "body" and _all_words_in(part.name, needed)]


def _all_words_in(name: str | None, wanted: Sequence[str]) -> bool:
    if not name or not wanted:
        return False
    have = words_of(name.replace("_", " "))
    return all(any(word == w or singular(word, frozenset(have)) == w for w in have) for word in wanted)


def _pick(parts: list[Part], pick: str | None) -> list[Part]:
    if not parts or pick is None:
        return parts
    if pick == "lowest":
        lowest = min(part.center[2] - part.extents[2] / 2 for part in parts)
        near = 0.02 * max(part.extents[2] for part in parts) + 1e-9
        return [part for part in parts if part.center[2] - part.extents[2] / 2 <= lowest + near]
    sizes = [part.radius or 0.0 for part in parts]
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
