"""Product names in the file: the designer's own words for the bodies."""

from __future__ import annotations

import re
from collections.abc import Sequence

from querycad_contracts import Part
from querycad_language.lexicon import lexicon

_CAMEL = re.compile(r"(?<=[a-z])(?=[A-Z])")
_WORD = re.compile(r"[^\W_]+(?:[./-]\d+)*")


def all_words(name: str | None) -> list[str]:
    """The words of a product name, folded, sizes and standards too: 'Screw_M8x25' holds 'screw' and 'm8x25'."""
    lex = lexicon()
    return [lex.fold(word) for word in _WORD.findall(_CAMEL.sub(" ", name or ""))]


def name_words(name: str | None) -> list[str]:
    """The same without sizes and counters."""
    return [word for word in all_words(name) if word.isalpha()]


def vocabulary(parts: Sequence[Part]) -> frozenset[str]:
    """All words of the names of bodies and of the model."""
    return frozenset(word for part in parts if part.kind.is_whole for word in name_words(part.name))


def share(name: str | None, words: Sequence[str]) -> float:
    """How much of a phrase does a name hold, 0 to 1? The head noun, the last word, must be in it; 0 without it."""
    have = all_words(name)
    if not have or not words or words[-1] not in have:
        return 0.0
    known = sum(word in have for word in words)
    last = 0.5 if name_words(name)[-1:] == [words[-1]] else 0.0
    return (known / len(words) + last) / 1.5


def holds(name: str | None, words: Sequence[str]) -> bool:
    """Does a name hold one of these words, or runs of words such as 'iso 4762'?"""
    text = f" {' '.join(all_words(name))} "
    return any(f" {word} " in text for word in words)
