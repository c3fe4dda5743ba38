"""From text to tokens: words folded and corrected, numbers with their units in SI."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import cache, lru_cache, partial

from rapidfuzz.distance import OSA
from spellchecker import SpellChecker

from querycad_contracts import Measure, Side

from .lexicon import INCH, lexicon
from .spoken import written

MAX_CHARS = 2000  # longer texts are no question; the rest is not read
MAX_TOKENS = 120
TYPO_MIN_LETTERS = 5  # shorter words have too many neighbours: 'nut' and 'cut' differ by one letter
TYPO_MAX_LETTERS = 40  # longer ones are no words

_NUMBER = r"\d{1,4}[ -]\d{1,3}/\d{1,3}|\d{1,3}/\d{1,3}|\d{1,3}(?:,\d{3}){1,3}(?:\.\d{1,9})?|\d{0,9}[.,]\d{1,9}|\d{1,9}"
_THREAD = (
    r"\bM\d{1,2}(?:\.\d)?(?:\s?[x×]\s?\d{1,3}(?:\.\d{1,2})?(?!\d))?(?![\w.]\w)"
    r"|\b(?:[12][ -])?\d{1,2}(?:/\d{1,2})?\"?(?:-\d{1,2})?\s?NPT\b|\bG\s?(?:(?:1[ -])?\d/\d{1,2}|[12])(?![\w/.-])"
    r"|(?:\b\d{1,2}/\d{1,2}\"?-\d{1,2}|(?<![\w#])#?(?:\d{1,2}-(?:24|28|32|36|40)|[0-5]-(?:44|48|56|64|72|80)))(?!\s?mm|\w)"
)
_MINUS = re.compile(r"(?<![^\s(=:])[-−–]\Z")
"""Of a number that follows at once; a dash between numbers, or with blanks around it, is none."""
_DENSITY = re.compile(r"\s?(k?g|(?:kilo)?grams?|kilos?)\s?(?:/|per)\s?((?:cubic\s)?[a-z]+(?:\^?3)?)(?!\w)", re.I)
_TOKEN = re.compile(
    rf"(?P<thread>{_THREAD})"
    r"|(?P<times>(?<![x×] )(?<![x×])\b\d{1,4}\s?[x×](?![\w.])(?!\s?\d{1,4}(?:\.\d{1,3})?\s?(?:mm\s?)?[x×]\s?\d))"
    rf"|(?P<number>(?<![\w.])(?:{_NUMBER}))"
    r"|(?P<word>[^\W\d_][\w]*(?:['’](?!s\b)\w+)?)"
    r"|(?P<possessive>['’]s?(?!\w))"
    r"|(?P<symbol><=|>=|!=|\+/-|[<>=≤≥≠≈~\"”″°,;:?!.&+()±⌀ℛ×/–—-])",
    re.IGNORECASE,
)
_UNIT = re.compile(r"\s?-?(\"|''|”|″|°|[a-zµμ]+(?:\^?[23])?)(?!\w)", re.IGNORECASE)
_POWER_UNIT = re.compile(r"\s?((?:square|cubic)\s[a-z]+)\b", re.IGNORECASE)
_OPENING = re.compile(r"\W{0,3}(?:the|this|a|total|it|all|diameter|width|length|depth|height)(?![a-z])", re.IGNORECASE)
"""Words before which 'in' is no unit."""
_LETTERS = {"l": "length", "w": "width", "b": "width", "h": "height", "d": "depth", "t": "thickness", "⌀": "diameter"}
_DECIMAL = r"\d+(?:[.,]\d+)?"
_OUTWARD = {
    side.value: ("[+]" if sum(side.outward) > 0 else "[-−]") + "xyz"[list(map(abs, side.outward)).index(1)]
    for side in Side
}
"""The sign and the axis of the file's frame towards each side."""


def _fitted(found: re.Match[str]) -> str:
    """'the press-in bush' is a bush; a lead-in is a part."""
    return found[0] if found[0].replace("-", " ").lower() in lexicon().nouns else ""


def _sided(side: str, axis: re.Match[str]) -> str:
    """'the +X lug': the side that an axis points to, before what has sides."""
    lex, word = lexicon(), axis[1].lower()
    return side if word in ("side", "half") or lex.singular(word) in lex.nouns else axis[0]


def _unslashed(found: re.Match[str]) -> str:
    """'c'bore' and 'c/bore' are counterbores."""
    return lexicon().spelling.get(re.sub("['’]", "/", found[0].lower()), found[0])


def _unlettered(found: re.Match[str]) -> str:
    """'L x W' is 'length x width'."""
    return " x ".join(_LETTERS[letter[0]] for letter in re.split(r"\s*[x×]\s*", found[0].lower()))


_ECHO = r"(?<=\w)(?: ?[-,;:?.–—] ?(?:and )?| and )(?:if (?:so|yes),? )?which(?: ones?)?(?: are they)? ?\?$"
"""'…, and if so, which ones?': those that make it so are evidence of the answer."""
_FRAME = r"[,(]?\s?(?:in )?(?:the )?\b(?:model|file|part)(?:['’]s)? coordinate(?:s| system)\b(?! of\b)\)?"
"""'…, in model coordinates': there are no others."""
_PLAINER: tuple[tuple[str, str | Callable[[re.Match[str]], str]], ...] = (
    (r"\b(?-i:R)\s?(?=\d)", " ℛ "),
    (r"^(?:\d+\)\s|[\"“])", ""),
    (r"\b(what|where|how|which|who|that|there|it|here)['’]s\b", r"\1 is"),
    (r"\b(is|are|do|does|has|have|was|were|did|could|would|should)n['’]t\b", r"\1 not"),
    (r"\bcan['’]t\b|\bcannot\b", "can not"),
    (r"\b(i|we|you|they|it|he|she)['’](?:d|ll|ve|re|m)\b", r"\1"),
    (r"\bi\.\s?e\.?(?!\w)", "that is"),
    (r"\be\.\s?g\.?(?!\w)", "for example"),
    (r"(?:\bno\.|#)(?=\s?of\b)", "number"),
    (r"\bw/o\b", "without"),
    (r"^(confirm|verify|check)(?: this)?:", r"\1 that"),
    (r"\bhow proud\b", "how far out"),
    (_ECHO, "?"),
    (_FRAME, " "),
    (r"\b(top|upper|bottom|lower|left|right|front|rear|back) end (?=faces?\b)", r"\1 "),
    (r"\b(?:outer|free) (?=end faces?\b)", ""),  # no tip
    (r"\b(?:twice|double(?= the\b))", "2 times"),
    (r"\bhalf (?=as [a-z]+ as\b)", "0.5 times "),
    (r"(\bdo(?:es)? [^?.]{1,60}) overhang(?= (?:the|its|it)\b)", r"\1 project beyond"),
    (r"\b(what|which)(?: bolt| pitch| hole)? circle(?= (?:do|are)\b)", r"\1 diameter circle"),
    (r" (?:are there|do(?:es)? \w{1,12} (?:have|see))(?= (?:that|which|whose|where)\b)", ""),
    (r"\b([xyz])([+−-])(?=[ -](?:side|face|end|half|wall)\b)", r"\2\1"),
    *((rf"(?<![\w+-]){axis}(?=[ -]([a-z]+))", partial(_sided, to)) for to, axis in _OUTWARD.items()),
    (r"(?<=[a-z])\((e?s)\)", r"\1"),
    (r"(\b(?:each|both) of (?:the|its|these)) (?:two|three|four|five|six|\d)(?= [a-z])", r"\1"),
    (r"\b(?:(?:what is )?(?:the|what) (?:amount|distance) by which|by what amount)\b", "by how much"),
    (r"\|\|", " parallel to "),
    (r"\bright through(?= to\b)", "fully through"),  # no side
    (r"\bl\s?/\s?d\b", "length to diameter ratio"),
    (r"\b([xyz])-(?=axis|direction)", r"\1 "),
    (r"(?<=[a-z])_(?=[a-z])", " "),
    (r"\bw/\s?(?=[a-z])", "with "),
    (r"\b[acou]['’/](?:all|line|bore|sink|sunk|side|cut|[acfl])(?=e?[ds]?\b)", _unslashed),
    (r"(?<=[a-z] )round (?=(?:the|its|a|an|each|this|that)\b)", "around "),
    (r"\b[a-z]+-(?:in|on|fit)(?= [a-z])", _fitted),
    (r"\bthro(?:['’]|\b)", "through"),
    (r"\bacross (?:the )?(\w+)['’]s? (corners|flats)\b", r"across \2 of the \1"),
    (r"\bc-c\b", "center to center"),
    (r"\b(?-i:C[oO]?[GM])\b", "center of mass"),  # a cog is a gear
    (r"(?:⌀|\b[lwbhdt](?:ength|idth|hk)?)(?:\s{0,2}[x×]\s{0,2}(?:l|w|b|h|dp|d|t|thk)\b)+", _unlettered),
    (r"(?<!\d)(\d{1,3}(?:[.,]\d+)?)\s?(?-i:[EFGHJKNPSefghjknps]|JS|js)[1-9]\d?\b(?! ?(?-i:mm))", r"\1"),  # '8H7'
    (r"\b(?-i:(?:[dD](?:\s?=\s?)?|[dD]ia(?:m|meter)?\.? )(?=\d+(?:[.,]\d+)?(?: ?mm)? [a-z]{3}))", "⌀ "),
    (rf"(?<![\d.,⌀])({_DECIMAL})\s?dia(?:m\.?|meter(?= [a-z]{{3}}))?\b\.?", r"⌀ \1"),
    (r"(\bdo(?:es)? [^?.]{1,60}) stand(?= (?:out|up|off|proud|above|over|from)\b)", r"\1 protrude"),
    (rf"({_DECIMAL})\s?[x×]\s?(?={_DECIMAL}(?:\s?[x×]\s?{_DECIMAL})?\s?(mm|cm|inch)\b)", r"\1 \2 x "),
    (r"\b(?-i:M) (?=\d)", "M"),
    (r"\bo\.\s?d\.?(?!\w)", "outer diameter"),
    (r"\bi\.\s?d\.?(?!\w)", "inner diameter"),
)
_CONTRACTIONS = tuple((re.compile(pattern, re.IGNORECASE), plain) for pattern, plain in _PLAINER)
_SYMBOLS = str.maketrans({
    "Ø": " ⌀ ", "ø": " ⌀ ", "∅": " ⌀ ", "℄": " centerline ", "↧": " depth ", "⌴": " counterbore ", "⌵": " countersink ",
    "□": " square ", "⊥": " perpendicular to ", "∥": " parallel to ",
    "→": " to ", "↔": " to ", "∠": " angle ", "²": "2", "³": "3",
})  # fmt: skip
"""ISO 129-1 and ASME Y14.5."""
_MARKS = {"⌀": Measure.DIAMETER, "ℛ": Measure.RADIUS}
DENSITY = -3  # the power of lengths in kilograms per cubic metre


class Kind(StrEnum):
    """What a token is."""

    WORD = "word"
    QUANTITY = "quantity"
    """A number with a unit, or behind a symbol such as 'Ø' that says of what it is."""
    NUMBER = "number"
    TIMES = "times"
    """How many: '4x'."""
    THREAD = "thread"
    SYMBOL = "symbol"
    POSSESSIVE = "possessive"


@dataclass(frozen=True, slots=True)
class Token:
    """One word, number or symbol.

    `word` is folded: lower case, American, singular, corrected. `raw` is as typed. Quantities carry `value` in SI;
    `power` is 1 for lengths, 2 for areas, 3 for volumes, 0 for angles. `measure` is what a symbol says the number is.
    """

    word: str
    raw: str
    kind: Kind = Kind.WORD
    value: float = 0.0
    power: int | None = None
    measure: Measure | None = None
    plural: bool = False


def tokenize(text: str, names: frozenset[str] = frozenset()) -> tuple[Token, ...]:
    """What are the tokens of a question? `names`: words of product names, which are never taken for misspelt ones."""
    text = written(unicodedata.normalize("NFC", " ".join(text[: 2 * MAX_CHARS].split())[:MAX_CHARS]))
    text = text.translate(_SYMBOLS)[:MAX_CHARS]
    for pattern, plain in _CONTRACTIONS:
        text = pattern.sub(plain, text)
    tokens: list[Token] = []
    position = 0
    while len(tokens) < MAX_TOKENS and (match := _TOKEN.search(text, position)):
        position = match.end()
        raw = match[0]
        match match.lastgroup:
            case "thread":
                name = re.sub(r'[\s"#]', "", re.sub(r"(\d) (?=\d)", r"\1-", raw.lower()).replace("×", "x"))
                tokens.append(Token(re.sub(r"-\d+(?=npt)", "", name), raw, Kind.THREAD))
            case "times":
                tokens.append(Token("x", raw, Kind.TIMES, float(raw.rstrip(" xX×"))))
            case "number":
                token, position = _number(raw, text, position)
                tokens.append(token)
            case "word":
                tokens += _words(raw, names)
            case "possessive":
                tokens.append(Token("'s", raw, Kind.POSSESSIVE))
            case _ if raw == "." and tokens and _shortened(tokens[-1]) and re.match(r"\s[a-z]", text[position:]):
                pass  # 'ext. dia. of the eye'
            case _ if not re.fullmatch(r"\w-\w", text[max(0, position - 2) : position + 1]):  # a hyphen parts words
                plain = {"–": "-", "—": "-", "×": "x"}.get(raw, raw)
                tokens.append(Token(_MARKS[raw].value, raw) if raw in _MARKS else Token(plain, raw, Kind.SYMBOL))
    return _joined(tokens)


def _shortened(token: Token) -> bool:
    """Is a word written shorter than it is spelt?"""
    return len(lexicon().spelling.get(token.raw.lower(), "")) > len(token.raw) + 1


def _number(text: str, rest: str, position: int) -> tuple[Token, int]:
    """A number with the unit that follows it, and where it ends."""
    units = lexicon().units
    value = _value(text)
    if per := _DENSITY.match(rest, position):
        volume, power = units.get({"l": "liter"}.get(per[2].lower(), per[2].lower()), (0.0, 0))
        if power == 3:
            sign = -1.0 if _MINUS.search(rest, 0, position - len(text)) else 1.0
            density = sign * value * (1.0 if per[1][0] in "kK" else 1e-3) / volume
            return Token("density", text + per[0], Kind.QUANTITY, float(f"{density:.12g}"), DENSITY), per.end()
    unit = _POWER_UNIT.match(rest, position) or _UNIT.match(rest, position)
    if unit and unit[1].lower() in units and not re.fullmatch(r"M[23]", unit[1]):
        factor, power = units[unit[1].lower()]
        if unit[1].lower() != "in" or not _OPENING.match(rest, unit.end()):  # '5 in the plate', '5.5 in diameter'
            raw = text + unit[0]
            return Token(raw, raw, Kind.QUANTITY, float(f"{value * factor:.12g}"), power), unit.end()
    word = re.match(r"[a-zA-Z]\w*", rest[position:])
    if word and (text.isdecimal() or word[0] in ("st", "nd", "rd", "th")):  # '3d', '1/2nd'
        return Token((text + word[0]).lower(), text + word[0]), position + word.end()
    return Token(text, text, Kind.NUMBER, value), position


def _value(text: str) -> float:
    if "/" in text:
        *whole, fraction = re.split(r"[ -]", text)
        upper, lower = fraction.split("/")
        return sum(map(float, whole)) + (float(upper) / float(lower) if float(lower) else 0.0)
    if re.fullmatch(r"[1-9]\d{0,2}(?:,\d{3})+(?:\.\d+)?", text):
        return float(text.replace(",", ""))
    return float(text.replace(",", ".", 1))


def _words(raw: str, names: frozenset[str]) -> list[Token]:
    lex, lower = lexicon(), raw.lower()
    spelt = lex.spelling.get(lower, lower)
    if " " in spelt:
        return [Token(lex.fold(word), raw) for word in spelt.split()]
    known, folded = lex.vocabulary, lex.singular(spelt)
    if folded not in known and spelt in known:
        folded = spelt
    if folded not in known and folded[:2] == "un" and folded[2:] in lex.adjectives:  # 'unchamfered'
        return [Token("non", raw), Token(folded[2:], raw)]
    spellable = TYPO_MIN_LETTERS <= len(folded) <= TYPO_MAX_LETTERS and folded.isalpha()
    misspelt = spellable and folded not in known and names.isdisjoint((folded, lower))
    pieces = (_compound(folded) or (_correct(folded),)) if misspelt else (folded,)
    return [Token(piece, raw, plural=folded != spelt) for piece in pieces]


@cache
def _pieces() -> frozenset[str]:
    """Nouns of parts and adjectives of one word; no 'thing', which any word may end in."""
    lex = lexicon()
    return frozenset(phrase for phrase in (*lex.nouns, *lex.adjectives) if " " not in phrase) - {*lex.words("whole")}


@lru_cache(maxsize=4096)
def _compound(word: str) -> tuple[str, ...] | None:
    """The pieces of a closed compound such as 'screwhole', both of them nouns of parts or adjectives."""
    known = _pieces()
    inflected = word.endswith(("ing", "ed")) and is_english(word)  # 'webbed' is no bed
    for cut in range(3, 0 if inflected else len(word) - 2):
        second = lexicon().singular(word[cut:])
        if word[:cut] in known and second in known:
            return word[:cut], second
    return None


@cache
def _spelt_with(first: str) -> tuple[str, ...]:
    """Known words that begin with a letter, those apart that are too short to be misspelt."""
    known = lexicon().vocabulary
    return tuple(word for word in known if word[0] == first and len(word) >= TYPO_MIN_LETTERS and word.isalpha())


@lru_cache(maxsize=4096)
def _correct(word: str) -> str:
    """The known word that a typing error was made in: one edit, two from nine letters; else the word itself."""
    allowed = 1 if len(word) < 9 else 2
    best = (allowed + 1, word)
    for known in (*_spelt_with(word[0]), *_spelt_with(word[1])):
        if abs(len(known) - len(word)) > allowed or (known[0] != word[0] and known[:2] != word[1::-1]):
            continue
        if word.startswith(known) and word[len(known) :] in ("ed", "d", "er", "r", "ly", "y", "al"):
            continue  # another form of the word is no slip
        substituted = len(word) == len(known) and sorted(word) != sorted(known)
        if not (substituted and len(word) < 6):
            best = min(best, (int(OSA.distance(word, known, score_cutoff=allowed)), known))
    return word if best[0] > allowed or is_english(word) else best[1]  # 'closer' is no slip of 'closed'


def is_english(word: str) -> bool:
    """Does a dictionary of English have the word?"""
    return word in _english()


@cache
def _english() -> SpellChecker:
    return SpellChecker(language="en", distance=1)


_UP_TO = ("at", "most", "less", "no", "more", "than", "under", "below", "to", "and", "including")
"""Words before the upper end of a range."""


def _joined(tokens: Sequence[Token]) -> tuple[Token, ...]:
    """Symbols and the numbers that they explain become one; ranges and tolerances share their unit."""
    joined: list[Token] = []
    inches = {token.word for token in tokens}.intersection(("inch", "mm", "millimeter", "cm", "centimeter")) == {"inch"}
    for token in tokens:
        mark = joined[-1].raw if joined else ""
        if mark in _MARKS and token.kind in (Kind.NUMBER, Kind.QUANTITY):
            # ASME Y14.5: less than one inch is written without a zero before the point, less than 1 mm with it
            scale = INCH if inches or token.raw.startswith(".") else 1e-3
            length = replace(token, value=token.value * scale, power=1) if token.kind is Kind.NUMBER else token
            joined[-1] = replace(length, kind=Kind.QUANTITY, measure=_MARKS[mark], raw=mark + token.raw)
        else:
            joined.append(token)
    for i in reversed(range(len(joined) - 2)):
        first, between, second = joined[i : i + 3]
        ranged = between.word in ("to", "and", "-", "or", "±", "x", "by", "but", "up", "through")
        if between.word in ("and", "but", "up"):  # 'at least 4 and at most 8 mm'
            second = next((one for one in joined[i + 2 : i + 6] if one.word not in _UP_TO), second)
        if ranged and first.kind is Kind.NUMBER and second.kind is Kind.QUANTITY:
            number = re.match(_NUMBER, second.raw)
            scale = second.value / (_value(number[0]) or 1.0) if number else 1e-3
            value = float(f"{first.value * scale:.12g}")
            joined[i] = replace(first, kind=Kind.QUANTITY, value=value, power=second.power)
    return tuple(joined)
