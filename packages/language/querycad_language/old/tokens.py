"""From text to tokens: words folded to one spelling, numbers with their units in SI, typing errors corrected."""

from __future__ import annotations

import re
import unicodedata
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import lru_cache

from .lexicon import LEXICON

MAX_CHARS = 2000
"""Longer texts are no question; the grammar reads only so much."""

_NUMBER = r"\d+\s+\d+/\d+(?![\d.,/])|\d+/\d+(?![\d.,/])|\d{1,3}(?:,\d{3})+(?![\d,])(?:\.\d+)?|\d*[.,]?\d+(?:e[+-]?\d+)?"
_UNIT_AFTER_NUMBER = re.compile(r"\s*-?\s*(\"|''|”|″|°|[a-zµμ]+(?:\^?[23]|[²³])?)(?![\w])", re.IGNORECASE)
_TOKEN = re.compile(
    rf"(?P<number>(?<![\w.])(?:{_NUMBER}))"
    r"|(?P<word>[^\W\d_](?:[\w/]|[-‐](?=\w)|\.(?=\d))*)"
    r"|(?P<possessive>['’]s?(?!\w))"
    r"|(?P<symbol><=|>=|==|!=|±|\+/-|[<>=≤≥≠≈~\"”″°,;:&+⌀()–—-])",
    re.IGNORECASE,
)


_FRACTIONS = {"half": "1/2", "three[ -]quarters?": "3/4", "quarter": "1/4", "eighth": "1/8"}


class Kind(StrEnum):
    """What a token is."""

    WORD = "word"
    NUMBER = "number"
    SYMBOL = "symbol"
    POSSESSIVE = "possessive"


@dataclass(frozen=True, slots=True)
class Token:
    """One word, number or symbol of the question.

    `word` is folded: lower case, American, corrected. `raw` is as typed. A number carries its `value` in SI when it has
    a unit, as typed when it has none; `power` is 1 for lengths, 2 for areas, 3 for volumes, 0 for angles, None without.
    """

    word: str
    raw: str
    kind: Kind = Kind.WORD
    value: float = 0.0
    power: int | None = None
    corrected: bool = False


def tokenize(text: str) -> tuple[Token, ...]:
    """What are the tokens of a question?"""
    text = unicodedata.normalize("NFC", text[:MAX_CHARS]).replace("’", "'").replace("´", "'")
    text = re.sub(r"\b(what|where|how|which|who|that|there|it|here)'s\b", r"\1 is", text, flags=re.IGNORECASE)
    text = re.sub(r"\b(is|are|do|does|has|have|was|were|ca|wo)n't\b", r"\1 not", text, flags=re.IGNORECASE)
    text = re.sub(r"[Øø⌀]\s*(?=\d)", " diameter ", text)
    text = re.sub(r"\bR\s?(?=\d)", "radius ", text)
    for words, value in _FRACTIONS.items():
        text = re.sub(rf"\b{words}(?: of)?(?: an?)?[ -](?=inch\b)", f"{value} ", text, flags=re.IGNORECASE)
    tokens: list[Token] = []
    position = 0
    while match := _TOKEN.search(text, position):
        position = match.end()
        if match["number"]:
            token, position = _number(match["number"], text, position)
            tokens.append(token)
        elif match["word"]:
            tokens.extend(_words(match["word"]))
        elif match["possessive"]:
            tokens.append(Token("'s", match["possessive"], Kind.POSSESSIVE))
        elif match["symbol"] != "-" or (tokens and tokens[-1].kind is Kind.NUMBER):
            tokens.append(_symbol(match["symbol"]))
    return _share_units(tuple(tokens))


def _symbol(raw: str) -> Token:
    folded = {"–": "-", "—": "-", "+/-": "±", "(": ",", ")": ",", ";": ",", ":": ","}.get(raw, raw)
    if folded in LEXICON.spelling:
        return Token(LEXICON.spelling[folded], raw)
    return Token(folded, raw, Kind.SYMBOL)


def _number(text: str, rest: str, position: int) -> tuple[Token, int]:
    """A number with the unit that follows it, and where it ends."""
    value = _value(text)
    unit = _UNIT_AFTER_NUMBER.match(rest, position)
    unit = None if unit and re.fullmatch("M[23]", unit[1]) else unit  # '2 M3 screws': a thread, no volume
    name = unit and LEXICON.match("unit", [unit[1].lower()], 0, 1)
    if unit and name and not (name[0] == "in" and unit[1].lower() == "in"):
        return _quantity(text + unit[0], value, name[0]), unit.end()
    words = re.match(r"\s*-?\s*((?:square|cubic|sq)\.?\s+\w+)", rest[position:], re.IGNORECASE)
    name = words and LEXICON.match("unit", words[1].lower().replace(".", "").split(), 0, 2)
    if words and name:
        return _quantity(text + words[0], value, name[0]), position + words.end()
    inch = re.match(r"\s*-?in\b\.?", rest[position:], re.IGNORECASE)
    if inch and _is_inch(rest[position + inch.end() :]):
        return _quantity(text + inch[0], value, "in"), position + inch.end()
    if re.match(r"(?:st|nd|rd|th)\b", rest[position:]):  # 2nd: an ordinal, a word
        return Token(text + rest[position : position + 2], text + rest[position : position + 2]), position + 2
    if re.match(r"[a-zA-Z]", rest[position:]):  # 3d, 2x: no number
        word = re.match(r"\w+", rest[position:])
        assert word is not None
        return Token((text + word[0]).lower(), text + word[0]), position + word.end()
    return Token(text, text, Kind.NUMBER, value), position


def _quantity(raw: str, value: float, unit: str) -> Token:
    factor, power = LEXICON.units[unit]
    return Token(raw, raw, Kind.NUMBER, float(f"{value * factor:.12g}"), power)


def _is_inch(after: str) -> bool:
    """Is 'in' behind a number the unit? Not where it opens a phrase: '5 in the plate', '5.5 in diameter'."""
    words = re.findall(r"[a-z]+", after.lower())[:1]
    return not words or words[0] not in ("the", "this", "a", "total", "it", "all", *LEXICON.wordings("property"))


def _value(text: str) -> float:
    if "/" in text:
        *whole, fraction = text.split()
        upper, lower = fraction.split("/")
        return sum(map(float, whole)) + (float(upper) / float(lower) if float(lower) else 0.0)
    if re.fullmatch(r"[1-9]\d{0,2}(?:,\d{3})+(?:\.\d+)?", text):
        return float(text.replace(",", ""))
    return min(float(text.replace(",", ".", 1)), 1e30)


def _words(raw: str) -> list[Token]:
    """The tokens of a word; a hyphenated one is split where all its pieces are words of the grammar."""
    pieces = re.split(r"[-‐/]", raw)
    if len(pieces) > 1 and (all(_fold(piece) in LEXICON.words for piece in pieces) or "/" in raw):
        return [token for piece in pieces if piece for token in _words(piece)]
    folded = _fold(raw)
    if (number := LEXICON.match("number", [folded], 0, 1)) and folded != "one":
        return [Token(folded, raw, Kind.NUMBER, float(number[0]))]
    corrected = _correct(folded)
    return [Token(corrected, raw, corrected=corrected != folded)]


def _fold(raw: str) -> str:
    word = raw.lower()
    return LEXICON.spelling.get(word, word)


@lru_cache(maxsize=4096)
def _correct(word: str) -> str:
    """The word of the grammar that a typing error was made in: one edit from five letters, two from eight."""
    if len(word) < 5 or not word.isalpha() or word in LEXICON.words or word in LEXICON.never_corrected:
        return word
    if LEXICON.singular(word) in LEXICON.words | LEXICON.never_corrected:
        return word
    allowed = 1 if len(word) < 8 else 2
    candidates = (
        (distance, other)
        for other in LEXICON.corrected_to
        if len(other) >= 5 and abs(len(other) - len(word)) <= allowed and other[0] in word[:2]
        if not _inflected(word, other)
        if (distance := edit_distance(word, other)) <= allowed
    )
    return min(candidates, default=(0, word))[1]


def _inflected(word: str, other: str) -> bool:
    """Is it another form of a verb ('locating', 'location') and no slip?"""
    return any(word.endswith(ending) and not other.endswith(ending) for ending in ("ing", "ed"))


def edit_distance(a: str, b: str) -> int:
    """How many insertions, deletions, substitutions and swaps of neighbours part two words (OSA distance)?"""
    before: list[int] = []
    row = list(range(len(b) + 1))
    for i, letter in enumerate(a, 1):
        before, previous, row = row, before, [i]
        for j, other in enumerate(b, 1):
            cost = min(before[j] + 1, row[j - 1] + 1, before[j - 1] + (letter != other))
            if i > 1 and j > 1 and letter == b[j - 2] and a[i - 2] == other:
                cost = min(cost, previous[j - 2] + 1)
            row.append(cost)
    return row[-1]


def _share_units(tokens: tuple[Token, ...]) -> tuple[Token, ...]:
    """Give the first number of a range the unit of the second: '4 to 6 mm', 'between 1/4 and 1/2 inch'."""
    shared = list(tokens)
    for i, (first, between, second) in enumerate(zip(tokens, tokens[1:], tokens[2:], strict=False)):
        joined = between.word in ("to", "and", "-", "or", "±", "till", "until")
        if joined and first.kind is second.kind is Kind.NUMBER and first.power is None and second.power is not None:
            factor = second.value / _unitless(second)
            shared[i] = replace(first, value=float(f"{first.value * factor:.12g}"), power=second.power)
    return tuple(shared)


def _unitless(token: Token) -> float:
    match = re.match(_NUMBER, token.raw, re.IGNORECASE)
    return (_value(match[0]) if match else 1.0) or 1.0
