"""What do the words of a description say? Head noun, adjectives, where it is, and what was not understood."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from rapidfuzz.distance import OSA

from querycad_contracts import Side

from .lexicon import FILLERS, NUMBERS, PREPOSITIONS, Adjective, Lexicon, Term, singular, words_of

TYPO_MIN_LETTERS = 4
"""Shorter words have too many neighbours: 'nut' and 'cut' differ by one letter."""
TYPO_SUBSTITUTION_LETTERS = 6
"""In shorter words one letter instead of another makes another word ('cone', 'core'); swapped, missing and doubled
letters hardly do."""
COMPOUND_MIN_LETTERS = 3
"""The shortest piece of a closed compound such as 'screwhole' or 'endplate'."""

IGNORED_CONFIDENCE = 0.5
"""What is left of the confidence when a word before the noun is not known: the noun itself is certain."""
TYPO_CONFIDENCE = 0.8
"""What is left of it when a misspelt word was read as a known one."""

GREYS = ("grey", "gray", "silver", "black", "white")
SIDE_WORDS = {
    Side.TOP: ("top", "upper", "above"),
    Side.BOTTOM: ("bottom", "lower", "underside", "below"),
    Side.LEFT: ("left",),
    Side.RIGHT: ("right",),
    Side.FRONT: ("front",),
    Side.BACK: ("back", "rear", "behind"),
}
"""How a side is said."""
SIDE_NOUNS = frozenset(("side", "face", "surface", "end", "hand", "view"))
"""What may follow: 'on the right hand side'."""
_SIDES = {word: side for side, words in SIDE_WORDS.items() for word in words}
IRREGULAR_PLURALS = frozenset(("feet", "teeth"))
_GENERIC = frozenset(("object", "body"))
"""Terms that may follow another noun without adding anything: 'the pipe piece', 'the adapter plate body'."""


@dataclass(frozen=True, slots=True)
class Place:
    """Where the head noun is: 'in the flange', or 'flange' before it (`relation` empty)."""

    relation: str
    what: Reading


@dataclass(slots=True)
class Reading:
    """What the words of a description were taken for."""

    words: list[str] = field(default_factory=list)
    """The words of the noun phrase, singular; the last one is the head noun."""
    term: Term | None = None
    phrase: str = ""
    """The words that named the term."""
    places: list[Place] = field(default_factory=list)
    adjectives: list[Adjective] = field(default_factory=list)
    without: list[Adjective] = field(default_factory=list)
    threads: list[str] = field(default_factory=list)
    colors: list[str] = field(default_factory=list)
    toward: list[Side] = field(default_factory=list)
    """Sides that they are on: 'on the top', 'at the rear end'."""
    ends: list[Side] = field(default_factory=list)
    """Sides said like an adjective: 'the left leg' is the leftmost one."""
    count: int | None = None
    """How many there are, as the description has it: 'the four holes'."""
    one: bool = False
    """One is meant, whichever stands out: 'the hole', but neither 'the holes' nor 'hole'."""
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
            self.doubt(f"not understood and not taken into account: {listed}", IGNORED_CONFIDENCE)
            self.unknown.clear()

    def doubt(self, note: str, confidence: float) -> None:
        """Keeps why the reading is not certain."""
        self.notes.append(note)
        self.confidence = min(self.confidence, confidence)


def read(description: str, words: Lexicon, names: frozenset[str] = frozenset()) -> Reading:
    """Takes a description apart. `names` are words of product names, which are never taken for misspelt ones."""
    reading = Reading()
    known = words.words | FILLERS | PREPOSITIONS | frozenset((*words.threads, *words.hues, *NUMBERS, *GREYS))
    said = _with_threads(words_of(description), words)
    tokens = [form for word in said for form in _known_forms(word, known, names, reading)]
    segments = _segments(tokens, words)
    _read_noun_phrase(segments[0][1], words, reading)
    head = reading.words[-1] if reading.words else ""
    reading.one = said[:1] == ["the"] and head in said and head not in IRREGULAR_PLURALS and not reading.count
    for marker, content in segments[1:]:
        if marker in ("with", "without"):
            _read_trait(content, marker == "without", words, reading)
        else:
            _read_place(marker, content, words, reading)
    return reading


def _with_threads(said: Sequence[str], words: Lexicon) -> list[str]:
    """Sizes of threads that came in two words are one: '1/4 20'."""
    joined: list[str] = []
    for word in said:
        if joined and f"{joined[-1]}-{word}" in words.threads:
            joined[-1] = f"{joined[-1]}-{word}"
        else:
            joined.append(word)
    return joined


def _segments(tokens: Sequence[str], words: Lexicon) -> list[tuple[str, list[str]]]:
    """The noun phrase, then what each preposition after it introduces.

    A preposition that belongs to a known phrase ('inside radius', 'through hole'), or stands where a noun is expected
    ('the rectangular inside of …'), introduces nothing.
    """
    segments: list[tuple[str, list[str]]] = [("", [])]
    at = 0
    while at < len(tokens):
        token = tokens[at]
        end, phrase = _longest_phrase(tokens, at, words, traits=segments[-1][0] in ("with", "without"))
        content = segments[-1][1]
        ends_here = at + 1 >= len(tokens) or tokens[at + 1] in PREPOSITIONS
        alone = ends_here if content else phrase in words.terms or phrase in words.adjectives
        if token not in PREPOSITIONS or end > at + 1 or (alone and phrase in (*words.terms, *words.adjectives)):
            if not (token in PREPOSITIONS and _is_feature(content, words)):  # 'the conical seat inside'
                content.extend(tokens[at:end])
        elif content or len(segments) > 1:
            segments.append((token, []))
        at = end
    return segments


def _is_feature(tokens: Sequence[str], words: Lexicon) -> bool:
    """Do the words end with the noun of a feature? The inside of a whole is a part of it, a 'seat inside' is a seat."""
    starts = range(len(tokens))
    phrase = next((" ".join(tokens[i:]) for i in starts if " ".join(tokens[i:]) in words.terms), "")
    return bool(phrase) and not words.terms[phrase].product


def _known_forms(word: str, known: frozenset[str], names: frozenset[str], reading: Reading) -> list[str]:
    """The singular; the pieces of a closed compound; for a misspelt word its likely meaning, noted."""
    form = singular(word, known | names)
    if form in known or form in names or any(c.isdigit() for c in word) or len(word) < TYPO_MIN_LETTERS:
        return [form]
    for cut in range(COMPOUND_MIN_LETTERS, len(word) - COMPOUND_MIN_LETTERS + 1):
        first, second = word[:cut], singular(word[cut:], known)
        if first in known and second in known and not {first, second} & (FILLERS | PREPOSITIONS):
            return [first, second]
    spellings = {form, form[:-1]} if form.endswith("s") else {form}
    close = [
        (min(OSA.distance(spelling, other) for spelling in spellings), other)
        for other in known
        if any(_is_typo(spelling, other) for spelling in spellings)
    ]
    if not close:
        return [form]
    meant = min(close)[1]
    reading.notes.append(f"'{word}' was read as '{meant}'")
    reading.confidence *= TYPO_CONFIDENCE
    return [meant]


def _is_typo(word: str, known: str) -> bool:
    """One slip of the keyboard away (optimal string alignment distance 1; 2 in words of ten letters and more)."""
    allowed = 2 if len(known) >= 10 else 1
    if len(known) < TYPO_MIN_LETTERS or OSA.distance(word, known, score_cutoff=allowed) > allowed:
        return False
    substituted = len(word) == len(known) and sorted(word) != sorted(known)
    return not substituted or len(known) >= TYPO_SUBSTITUTION_LETTERS


def _read_noun_phrase(tokens: Sequence[str], words: Lexicon, reading: Reading) -> None:
    """The last noun is the head; nouns before it say where it is, words that are adjectives too are that before it."""
    tokens = [token for token in tokens if token not in FILLERS]
    tokens = [word for i, word in enumerate(tokens) if word != "shaped" or _is_shaped(tokens, i, words)]
    reading.words = [token for token in tokens if token not in NUMBERS]
    nouns: list[tuple[str, Term]] = []
    shapes: list[tuple[str, Adjective]] = []
    position = 0
    while position < len(tokens):
        end, phrase = _longest_phrase(tokens, position, words)
        adjective = words.adjectives.get(phrase)
        noun_follows = any(_longest_phrase(tokens, i, words)[1] in words.terms for i in range(end, len(tokens)))
        if adjective is not None and (phrase not in words.terms or noun_follows):
            _add_adjective(adjective, phrase, reading)
            shapes.append((phrase, adjective))
        elif phrase in words.terms:
            nouns.append((phrase, words.terms[phrase]))
            reading.head_unknown = False
        elif not _read_word(tokens[position], words, reading):
            reading.head_unknown = True
        position = end
    if len(nouns) > 1 and nouns[-1][1].name in _GENERIC and not reading.head_unknown:
        nouns.pop()
    if nouns:
        reading.phrase, reading.term = nouns[-1]
    for shape, adjective in shapes:
        if (together := words.terms.get(f"{shape} {reading.phrase}")) is not None and adjective in reading.adjectives:
            reading.phrase, reading.term = f"{shape} {reading.phrase}", together  # 'the half round bar seat'
            reading.adjectives.remove(adjective)
    for phrase, term in nouns[:-1]:
        if reading.term is not None and term.name != reading.term.name:
            reading.places.append(Place("", Reading(words=phrase.split(), term=term, phrase=phrase)))


def _is_shaped(tokens: Sequence[str], at: int, words: Lexicon) -> bool:
    """Is 'shaped' a part of a known phrase here, such as 'box shaped'?"""
    starts = range(max(0, at - 2), at)
    return any(_longest_phrase(tokens, start, words)[0] > at for start in starts)


def _add_adjective(adjective: Adjective, phrase: str, reading: Reading) -> None:
    reading.adjectives.append(adjective)
    if adjective.lacks:
        reading.without.append(Adjective(adjective.name, adjective.lacks))
    if adjective.unchecked:
        reading.notes.append(f"'{phrase}' was not checked against the geometry")


def _longest_phrase(tokens: Sequence[str], position: int, words: Lexicon, traits: bool = False) -> tuple[int, str]:
    """The longest known phrase that begins here, and where it ends; a single unknown word otherwise.

    `traits`: phrases that follow 'with' count too.
    """
    for end in range(min(len(tokens), position + 6), position, -1):
        phrase = " ".join(tokens[position:end])
        if phrase in words.terms or phrase in words.adjectives or (traits and phrase in words.with_nouns):
            return end, phrase
    return position + 1, tokens[position]


def _read_word(word: str, words: Lexicon, reading: Reading) -> bool:
    """Takes a single word for a thread, a colour, a number or a filler; False when it is none of them."""
    if word in words.threads:
        reading.threads.append(word)
    elif word in words.hues or word in GREYS:
        reading.colors.append(word)
    elif word in NUMBERS or (word.isdecimal() and word.isascii() and len(word) <= len("99")):
        reading.count = NUMBERS.get(word) or int(word)
    elif word in _SIDES:
        reading.ends.append(_SIDES[word])
    elif word not in FILLERS and word not in ("shaped", "hand"):
        reading.unknown.append(word)
        return False
    return True


def _read_trait(tokens: Sequence[str], negated: bool, words: Lexicon, reading: Reading) -> None:
    """'with a ring', 'without thread': what follows is a trait of the head noun, or another part of it."""
    content = [token for token in tokens if token not in FILLERS and token not in NUMBERS]
    for end in range(len(content), 0, -1):
        phrase = " ".join(content[-end:])
        adjective = words.with_nouns.get(phrase) or words.adjectives.get(phrase)
        if adjective is not None:
            (reading.without if negated else reading.adjectives).append(adjective)
            if content[:-end]:
                _read_trait(content[:-end], negated, words, reading)
            return
    other = Reading()
    _read_noun_phrase(content, words, other)
    if other.term is not None and not other.head_unknown:
        reading.places.append(Place("without" if negated else "with", other))
    else:
        reading.unknown.extend(content)


def _read_place(relation: str, tokens: Sequence[str], words: Lexicon, reading: Reading) -> None:
    """'in the flange': where the head noun is; 'for an M5 screw': which size it has."""
    said = [token for token in tokens if token not in FILLERS and token not in SIDE_NOUNS]
    if relation in ("on", "at", "from", "to") and len(said) == 1 and (side := _SIDES.get(said[0])):
        reading.toward.append(side)
        return
    place = Reading()
    _read_noun_phrase(tokens, words, place)
    if relation == "for":
        reading.threads.extend(place.threads)
    if place.words:
        reading.places.append(Place(relation, place))
