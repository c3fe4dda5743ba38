"""What a statement before a question speaks of: the parts that 'it' and 'they' will stand for."""

from __future__ import annotations

from . import modifiers
from .lexicon import LEXICON
from .meaning import NounClass, Selection, Whole
from .phrases import target
from .text import Text
from .tokens import Kind, Token, tokenize

_FINITE = ("be", "do", "have", "stating", "protrude", "sink", "finite")
_BEFORE_ARTICLE = (
    "article", "preposition", "container", "side_preposition", "axis_preposition", "place", "conjunction", "quantifier",
    "each", "relation", "negation", "light", "noise", "near", "be", "minus", "adjacent", "side",
)  # fmt: skip
"""What stands before an article without being a verb."""
_LEADING = ("round", "opposite", "behind", "above", "below", "under", "over", "off", "past", "like", "as", "till")
"""Prepositions besides."""
_COMING = ("gets", "get", "will", "must", "should", "shall", "goes", "comes")
"""Of something that is not there yet."""


def subject(sentence: str, plural: bool = False, singular: bool = False) -> tuple[Token, ...]:
    """The parts that a statement is about: what something has ('a slot'), else its subject, else its object."""
    text = Text(tokenize(sentence))
    end = clause_end(text)
    start = text.skip(0, end, "polite", "noise", "topic") if end else 0
    spoken = text.word_at(start, end, "i", "we", "you", "they", "he", "she", "it", "to", "my", "our")
    if place := _goes_into(text, start, end):
        return place
    finite = next((i for i in range(start, end) if is_finite(text, i, end) or _acts(text, i, end)), None)
    if finite is None and not spoken and isinstance(target(text, start, end), Selection):
        return text.tokens[start:end]
    stating = text.find("stating", 0, end)
    if stating is not None and not text.word_at(stating[2], end, "to"):
        seen = modifiers.sides(text, 0, stating[0])
        beside = (Token("visible", "visible"), *text.tokens[: seen[1]]) if seen is not None else ()
        noun = text.skip(stating[2], end, "quantifier")
        if not isinstance(target(text, noun, end), Whole):
            return (*text.tokens[noun:end], *beside)
    if treated := _treated(text, end):
        return treated
    aim = next((i for i in range(end) if _is_purpose(text, i, end)), None)
    if plural or aim is not None:  # 'to drive a screwdriver into the holes': 'they' are the holes
        since = 0 if plural or aim is None else aim
        for first in (i for i in range(since, end) if text.match("article", i, end) or text.number(i, end)):
            last = next((i for i in range(first + 1, end) if _acts(text, i, end)), end)
            of = target(text, first, last)
            definite = text.words[first] in ("the", "these", "those", "this")
            if isinstance(of, Selection) and (of.plural if plural else definite):
                return text.tokens[first:last]
    return _named_first(text, end, singular) or _definite(text, end)


def _definite(text: Text, end: int) -> tuple[Token, ...]:
    """'It is about the fit of the shaft': the first definite noun phrase."""
    articles = (i for i in range(end) if text.word_at(i, end, "the", "these", "those", "this"))
    return next((text.tokens[i:end] for i in articles if isinstance(target(text, i, end), Selection)), ())


def _named_first(text: Text, end: int, singular: bool) -> tuple[Token, ...]:
    """The first noun phrase of a statement; what something has ('has a keyway') before what has it."""
    named: list[tuple[bool, tuple[Token, ...]]] = []
    start = 0
    for at in range(end + 1):
        verbs = ("be", "do", "have", "verb", "light")
        if at < end and not _acts(text, at, end) and not any(text.after(category, at, end) for category in verbs):
            continue
        if start < at < end and text.match("noun_verb", at, end) and _is_noun_led(text, at):
            continue  # 'with round ends', 'at either end'
        article = next((i for i in range(start, at) if text.match("article", i, at)), start)
        of = target(text, article, at) if at > article else None
        if isinstance(of, Selection):
            had = start and (text.match("have", start - 1, end) or text.word_at(start - 1, end, "ends", "end"))
            had = had and text.word_at(article, at, "a", "an")  # what 'it ends in' is no less its own
            if had:
                return text.tokens[article:at]
            named.append((of.plural, text.tokens[article:at]))
        start = at + 1
    fitting = [tokens for several, tokens in named if not (singular and several)]
    return (fitting or [tokens for _, tokens in named] or [()])[0]


def _is_noun_led(text: Text, at: int) -> bool:
    """Does an adjective or article before it make a noun of what may be a verb?"""
    return text.word_at(at - 1, at, "either", "each", "one", "both", "other") or any(
        text.match(category, at - 1, at) for category in ("shape_adjective", "article", "side")
    )


def _is_purpose(text: Text, at: int, end: int) -> bool:
    """'to drill', 'we need', 'must grip': what is going to be done, and no part ('the bolt')."""
    led = at == 0 or text.match("modal", at - 1, end) is not None
    return led and text.match("purpose", at, end) is not None


def is_finite(text: Text, at: int, end: int) -> bool:
    """Does a verb stand here that makes a sentence of the words, and no relative clause: 'the slot that is on top'?"""
    if not any(text.match(category, at, end) for category in _FINITE) and not _is_purpose(text, at, end):
        return False
    if at and any(text.match(category, at - 1, at) for category in ("article", "shape_adjective", "whole_adjective")):
        return False  # 'the whole stand'
    return not any(text.match("relative", i, at) or text.word_at(i, at, ",") for i in range(at))


def _acts(text: Text, at: int, end: int) -> bool:
    """'The key locates the finger': does a verb stand here, as in no noun phrase a noun stands before an article?

    'The holes the screws go in' is a clause without pronoun.
    """
    if not 0 < at < end - 1 or text.tokens[at].kind is not Kind.WORD or text.words[at].endswith("ing"):
        return False
    if not text.match("article", at + 1, end) or text.word_at(at + 1, end, "that", "this", "such"):
        return False
    leads = any(text.match(category, at, at + 1) for category in _BEFORE_ARTICLE) or text.word_at(at, end, *_LEADING)
    if leads or text.match("preposition", end - 1, end):
        return False
    agrees = LEXICON.is_plural(text.words[at - 1]) is not text.words[at].endswith("s")
    return agrees and not any(text.match("relative", i, at) or text.word_at(i, at, ",") for i in range(at))


def _goes_into(text: Text, start: int, end: int) -> tuple[Token, ...]:
    """'Our foil is glued into the recess', 'a strip gets glued into the slot': where what is no part goes."""
    verb = next((i for i in range(start + 1, end) if is_finite(text, i, end)), end)
    mine = text.word_at(start, end, "my", "our", "your")
    coming = text.word_at(start, end, "a", "an", "some") and text.word_at(verb, end, *_COMING)
    into = next((i for i in range(verb + 1, end - 1) if text.words[i] in ("in", "into", "inside", "through")), end)
    if not (mine or coming) or not text.match("article", into + 1, end):
        return ()
    of = target(text, into + 1, end)
    if not isinstance(of, Selection):
        return ()
    cut = of.noun_class is NounClass.HOLE or LEXICON.match("cut_noun", (of.phrases[0].noun,), 0, 1) is not None
    return text.tokens[into + 1 : end] if cut else ()


def clause_end(text: Text) -> int:
    """Where does the first clause end: before 'and always lose track', ', but …'?"""
    end = next((i for i in range(1, len(text.tokens)) if text.words[i] == "like"), len(text.tokens))
    for at in range(1, end):
        joined = text.word_at(at, end, "and", "but", ",")
        said = any(is_finite(text, i, at) for i in range(at))
        if joined and said and text.match("new_clause", text.skip_commas(at + (text.words[at] != ","), end), end):
            return at
    return end


def _treated(text: Text, end: int) -> tuple[Token, ...]:
    """'The plate is chamfered at the corners': the chamfer at the corners of the plate."""
    verb = text.find("be", 1, end)
    made = text.match("treated", text.skip(verb[2], end, "noise"), end) if verb else None
    if verb is None or made is None:
        return ()
    start = text.skip(0, verb[0], "polite", "conjunction")
    return (Token("the", "the"), Token(made[0], made[0]), *text.tokens[made[1] : end], Token("of", "of"),
            *text.tokens[start : verb[0]])  # fmt: skip
