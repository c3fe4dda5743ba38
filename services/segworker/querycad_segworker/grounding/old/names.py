"""Product names in the file: the designer's own words for the bodies come before any reading of their shape."""

from __future__ import annotations

from collections.abc import Sequence

from querycad_contracts import Part, Side

from .lexicon import singular, words_of
from .reading import SIDE_WORDS

GENERIC = frozenset(("body", "part", "component", "solid", "object", "piece", "element", "item"))
"""Nouns that may follow a name without being part of it: 'the piston rod body'."""


def name_words(name: str | None) -> list[str]:
    """Which words does a product name hold, without sizes and counters? 'Screw M8x25' holds 'screw'."""
    return [word for word in all_words(name) if word.isalpha()]


def all_words(name: str | None) -> list[str]:
    """Which words does a product name hold, sizes and standards too? 'Screw_M8x25' holds 'screw' and 'm8x25'."""
    return words_of((name or "").replace("_", " "))


def vocabulary(parts: Sequence[Part]) -> frozenset[str]:
    """All words of the names of bodies and of the model."""
    return frozenset(word for part in parts if part.kind in ("body", "model") for word in name_words(part.name))


def bodies_named(parts: Sequence[Part], words: Sequence[str], sides: Sequence[Side] | None) -> list[Part]:
    """Which bodies of an assembly do these words name? Empty in a file of one body, whose name says nothing more.

    The head noun must be the noun of the name, its last word; of several such bodies those count that share the most
    words. A side that was asked for may be part of the name instead: the 'front cap' need not be seen from the front.
    """
    bodies = [part for part in parts if part.kind == "body"]
    wanted = list(words)
    while len(wanted) > 1 and wanted[-1] in GENERIC and not any(_is_called(body.name, wanted) for body in bodies):
        wanted.pop()
    if len(bodies) < 2 or not wanted:
        return []
    asked = [word for side in sides or () for word in SIDE_WORDS[side]]
    asked += [other for said in SIDE_WORDS.values() if set(said) & set(wanted) for other in said]
    scores: dict[str, int] = {}
    for body in bodies:
        have = name_words(body.name)
        if have and same_word(have[-1], wanted[-1]):
            scores[body.id] = sum(any(same_word(h, w) for h in have) for w in [*wanted, *asked])
    best = max(scores.values(), default=0)
    found = [body for body in bodies if scores.get(body.id) == best]
    if sides is None or (found and any(word in name_words(found[0].name) for word in asked)):
        return found
    return [body for body in found if set(sides) & set(body.sides)]


def _is_called(name: str | None, wanted: Sequence[str]) -> bool:
    """Does a name end with the noun and hold the words before it, as 'Pump body' does?"""
    have = name_words(name)
    return bool(have) and same_word(have[-1], wanted[-1]) and any(same_word(h, w) for h in have for w in wanted[:-1])


def bodies_marked(bodies: Sequence[Part], words: Sequence[str]) -> list[Part]:
    """Which bodies have all these words in their names: 'iso 4762', 'm5x20', 'left'?"""
    return [body for body in bodies if words and all(_holds(body.name, word) for word in words)]


def _holds(name: str | None, word: str) -> bool:
    """Is the word in the name? 'm5' is in 'm5x20': the length of a screw follows the size of its thread."""
    return any(same_word(have, word) or (word[:1] == "m" and have.startswith(f"{word}x")) for have in all_words(name))


def is_whole(parts: Sequence[Part], words: Sequence[str]) -> Part | None:
    """Do these words name the whole model, by the name of its file or assembly?"""
    model = next((part for part in parts if part.kind == "model"), None)
    if model is None or not words:
        return None
    have = name_words(model.name)
    return model if have and all(any(same_word(h, w) for h in have) for w in words) else None


def same_word(a: str, b: str) -> bool:
    """Are these the same word, in singular or plural?"""
    return a == b or singular(a, frozenset((b,))) == b or singular(b, frozenset((a,))) == a
