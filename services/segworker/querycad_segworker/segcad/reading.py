"""What do the words of a description say? Head noun, adjectives, where it is, and what was not understood."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from rapidfuzz.distance import OSA

from .lexicon import FILLERS, PREPOSITIONS, Adjective, Lexicon, Term, singular, words_of

TYPO_MIN_LETTERS = 4
"""Shorter words have too many neighbours: 'nut' and 'cut' differ by one letter."""
TYPO_SUBSTITUTION_LETTERS = 6
"""In shorter words one letter instead of another makes another word ('cone', 'core'); swapped, missing and doubled
letters hardly do."""

IGNORED_CONFIDENCE = 0.5
"""What is left of the confidence when a word before the noun is not known: the noun itself is certain."""
TYPO_CONFIDENCE = 0.8
"""What is left of it when a misspelt word was read as a known one."""

_GREYS = ("grey", "gray", "black", "white")


@dataclass(slots=True)
class Reading:
    """What the words of a description were taken for."""

    words: list[str] = field(default_factory=list)
    """The words of the noun phrase, singular; the last one is the head noun."""
    term: Term | None = None
    phrase: str = ""
    """The words that named the term."""
    inside: list[Term] = field(default_factory=list)
    """Other nouns, which say where it is: 'flange hole', 'hole in the flange'."""
    adjectives: list[Adjective] = field(default_factory=list)
    without: list[Adjective] = field(default_factory=list)
    metric: list[str] = field(default_factory=list)
    colors: list[str] = field(default_factory=list)
    unknown: list[str] = field(default_factory=list)
    """Words that nothing is known about."""
    head_unknown: bool = False
    """The head noun itself is one of them."""
    notes: list[str] = field(default_factory=list)
    confidence: float = 1.0

    def ignore_unknown(self) -> None:
        """Goes on without the unknown words, and says so."""
        if self.unknown:
            listed = ", ".join(f"'{word}'" for word in self.unknown)
            self.notes.append(f"not understood and not taken into account: {listed}")
            self.confidence = min(self.confidence, IGNORED_CONFIDENCE)
            self.unknown.clear()


def read(description: str, words: Lexicon, names: frozenset[str] = frozenset()) -> Reading:
    """Takes a description apart. `names` are words of product names, which are never taken for misspelt ones."""
    reading = Reading()
    known = words.words | FILLERS | PREPOSITIONS | frozenset(words.metric_m) | frozenset(words.hues) | frozenset(_GREYS)
    tokens = [_known_form(word, known, names, reading) for word in words_of(description)]
    segments = _segments(tokens)
    _read_noun_phrase(segments[0][1], words, reading)
    for marker, content in segments[1:]:
        if marker in ("with", "without"):
            _read_trait(content, marker == "without", words, reading)
        else:
            _read_place(content, words, reading)
    return reading


def _segments(tokens: Sequence[str]) -> list[tuple[str, list[str]]]:
    """The noun phrase, then what each preposition after it introduces."""
    segments: list[tuple[str, list[str]]] = [("", [])]
    for token in tokens:
        if token in PREPOSITIONS and (segments[0][1] or len(segments) > 1):
            segments.append((token, []))
        elif token not in PREPOSITIONS:
            segments[-1][1].append(token)
    return segments


def _known_form(word: str, known: frozenset[str], names: frozenset[str], reading: Reading) -> str:
    """The singular; for a misspelt word its likely meaning, noted."""
    form = singular(word, known | names)
    if form in known or form in names or any(c.isdigit() for c in word) or len(word) < TYPO_MIN_LETTERS:
        return form
    spellings = {form, form[:-1]} if form.endswith("s") else {form}
    close = [other for other in sorted(known) if any(_is_typo(spelling, other) for spelling in spellings)]
    if not close:
        return form
    reading.notes.append(f"'{word}' was read as '{close[0]}'")
    reading.confidence *= TYPO_CONFIDENCE
    return close[0]


def _is_typo(word: str, known: str) -> bool:
    """One slip of the keyboard away (optimal string alignment distance 1; 2 in words of ten letters and more)."""
    allowed = 2 if len(known) >= 10 else 1
    if len(known) < TYPO_MIN_LETTERS or OSA.distance(word, known, score_cutoff=allowed) > allowed:
        return False
    substituted = len(word) == len(known) and sorted(word) != sorted(known)
    return not substituted or len(known) >= TYPO_SUBSTITUTION_LETTERS


def _read_noun_phrase(tokens: list[str], words: Lexicon, reading: Reading) -> None:
    """The last noun is the head; nouns before it say where it is, words that are adjectives too are that before it."""
    reading.words = [token for token in tokens if token not in FILLERS]
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
            if reading.term is not None and reading.term.name != words.terms[phrase].name:
                reading.inside.append(reading.term)
            reading.term, reading.phrase, reading.head_unknown = words.terms[phrase], phrase, False
        elif not _read_word(tokens[position], words, reading):
            reading.head_unknown = True
        position = end


def _longest_phrase(tokens: Sequence[str], position: int, words: Lexicon) -> tuple[int, str]:
    """The longest known phrase that begins here, and where it ends; a single unknown word otherwise."""
    for end in range(len(tokens), position, -1):
        phrase = " ".join(tokens[position:end])
        if phrase in words.terms or phrase in words.adjectives:
            return end, phrase
    return position + 1, tokens[position]


def _read_word(word: str, words: Lexicon, reading: Reading) -> bool:
    """Takes a single word for a thread, a colour or a filler; False when it is none of them."""
    if word in words.metric_m:
        reading.metric.append(word)
    elif word in words.hues or word in _GREYS:
        reading.colors.append(word)
    elif word not in FILLERS:
        reading.unknown.append(word)
        return False
    return True


def _read_trait(tokens: list[str], negated: bool, words: Lexicon, reading: Reading) -> None:
    """'with a ring', 'without thread': what follows is a trait of the head noun."""
    content = [token for token in tokens if token not in FILLERS]
    for end in range(len(content), 0, -1):
        phrase = " ".join(content[-end:])
        adjective = words.with_nouns.get(phrase) or words.adjectives.get(phrase)
        if adjective is not None:
            (reading.without if negated else reading.adjectives).append(adjective)
            if content[:-end]:
                _read_trait(content[:-end], negated, words, reading)
            return
    reading.unknown.extend(content)


def _read_place(tokens: list[str], words: Lexicon, reading: Reading) -> None:
    """'in the flange': where the head noun is; a place that is not known is only noted."""
    place = Reading()
    _read_noun_phrase(tokens, words, place)
    if place.term is not None and not place.head_unknown:
        reading.inside.append(place.term)
    else:
        reading.unknown.extend(place.unknown)
