"""What is said around a question: sentences before and behind it, what it leans on, and what 'it' stands for."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace

from . import modifiers
from .asides import axes, without_asides
from .asking import asked_measures
from .lexicon import LEXICON
from .meaning import Count, Get, Selection
from .phrases import target
from .questions import question
from .subjects import clause_end, is_finite, subject
from .text import Text
from .tokens import Kind, Token, tokenize

_SENTENCE = re.compile(
    r"(?<=[.!?])\s+(?=[A-Z](?:[a-z]|\s|'))"
    r"|;\s+(?=(?:how|what|which|where|its|their)\b)"
    r"|(?:[:—–]|\s-)\s+(?=(?:how|what|which|where|who|is|are|does|do|give|list|name|state|count)\b)"
    r"|,\s+so\s+(?=(?:how|what|which|where)\b)"
    r"|,\s+and\s+(?=(?:how|where)\b[^,]*\b(?:it|they)\b)",
    re.IGNORECASE,
)
_THAT_IS = re.compile(
    r",?\s+\(?(?:i\.\s?e\.|that is to say|that is,|i mean|or rather|in other words|namely)[,:]?\s+", re.IGNORECASE
)
_STATED = re.compile(
    r"(.*\b(?:there\s+(?:is|are)|there['’]s|(?:i|you|we|one)\s+(?:can\s+|could\s+)?(?:see|have|got|need|want|pick|take|choose|"
    r"consider|notice|find)|(?:it|part|object|model|body|piece)\s+has)\b[^,]*),\s+(?:then\s+|and\s+|so\s+)?"
    r"((?:how|what|which|where|can\s+you|could\s+you|please|give|tell)\b.*)",
    re.IGNORECASE | re.DOTALL,
)
_OPENING = re.compile(
    r"(?:\s*,\s*(?:(?:so|but|and|then|now|hence|therefore|anyway|thus)\b,?\s*)*|\s+(?:but|so)\s+)"
    r"(?=(?:how|what|which|where|whose|who|(?:can|could|would|will)\s+(?:you|i|we|one)|is|are|does|do|has|tell|give|"
    r"please|i\s+(?:need|want|would|wonder))\b)",
    re.IGNORECASE,
)
_BRACKET = re.compile(r"([^()]+)\(([^()]+)\)\s*([^()]*)")
_FIRST_SENTENCE = re.compile(r"\s*([^.!?:;]{3,}[a-z)][.!])\s+(?=\w)", re.IGNORECASE)
_MEASURING = ("property", "scale.positive", "count", "distance", "spacing", "alignment", "exists", "at_which")
_TELEGRAM = re.compile(r"([^:?.]+?)(?:\s*[:,]|\s+[-–—]+|\s*[–—]+)\s*([a-z][a-z ]*?)\s*[?.]*", re.IGNORECASE)
_LABEL = re.compile(r"([^:?.,–—]{3,40}?)(?::|\s+[-–—]+)\s+([^:–—]+)")
_CONDITION = re.compile(r"\b(?:if|unless|without|except|excluding|only|not counting|apart from)\b", re.IGNORECASE)
_MEANT = re.compile(r"^\W*(?:i mean|or rather|rather)\b", re.IGNORECASE)
_PRONOUNS = ("it", "they", "them")
_PRONOUN = re.compile(r"\b(?:it|they|them)\b", re.IGNORECASE)
_POSSESSIVES = ("its", "their")
_WH = ("how", "what", "which", "where", "whose")


@dataclass(frozen=True, slots=True)
class Asked:
    """The sentence that asks, what was stated before it, and the sentences that explain it."""

    question: str
    before: str
    hints: tuple[str, ...]
    correction: str = ""
    """'… I mean the slot': the parts that are meant instead."""


def sentences(text: str) -> Asked | None:
    """Which sentence asks, and what do the others say? None when more than one asks."""
    found = [part.strip() for part in _SENTENCE.split(text) if re.search(r"\w", part)] or [text]
    asking = [i for i, part in enumerate(found) if _asks(part)] if len(found) > 1 else [0]
    if len(asking) == 2 and (chosen := _elaborated(found[asking[0]], found[asking[1]])) is not None:
        asking = [asking[chosen]]
    if not asking:  # 'I am working on a lid. Thickness of the rim'
        measured = [i for i, part in enumerate(found) if _measures(part)]
        asking = measured[-1:]
    if len(asking) != 1 or len([part for part in found[asking[0]].split("?") if re.search(r"\w", part)]) > 1:
        return None
    at = asking[0]
    return Asked(found[at], " ".join(found[:at]), tuple(found[at + 1 :]))


def aside_before(text: str) -> str | None:
    """'I am working on this lid. …': the first sentence, where it speaks of no parts, sides or measures."""
    found = _FIRST_SENTENCE.match(text)
    if found is None or _CONDITION.search(found[1]) or _measures(found[1]) or _asks(found[1]):
        return None
    nothing = seen_from(Text(()), found[1]) is None and not subject(found[1])
    return found[0] if nothing else None


def _measures(sentence: str) -> bool:
    """Does a sentence name a measure or a number of parts?"""
    text = Text(tokenize(sentence))
    return any(text.find(category, 0, len(text.tokens)) is not None for category in _MEASURING)


def explained(text: str) -> Asked | None:
    """'How thick is the shaft, i.e. what is its diameter?', '… I mean their diameter': what is said last is asked."""
    parts = _THAT_IS.split(text, maxsplit=1)
    if len(parts) < 2 or not parts[0].strip():
        return None
    first, last = parts[0].strip(), parts[1].strip().rstrip(")?. ")
    opening = last.split(maxsplit=1)[0].lower() if last else ""
    if opening in _POSSESSIVES:
        return Asked(f"what is {last}?", first, ())
    pronoun = any(word in last.lower().split() for word in (*_PRONOUNS, *_POSSESSIVES))
    if opening in _WH and pronoun:
        return Asked(f"{last}?", first, ())
    meant = opening in ("the", "this", "that", "these", "those") and _MEANT.search(text[len(parts[0]) :]) is not None
    return Asked(first, "", (last,), last if meant else "")


def introduced(text: str) -> Asked | None:
    """'There is a slot at the back, how wide is it?': what is stated first, and the question about it."""
    found = _STATED.fullmatch(text.strip())
    return None if found is None else Asked(found[2], found[1], ())


def fronted(text: str) -> Iterator[Asked]:
    """'The pocket underneath, how deep is it?': the parts come first, and a pronoun takes them up."""
    if (last := _dislocated(text)) is not None:
        yield last
    for comma in _OPENING.finditer(text):
        before, asked = text[: comma.start()].strip(), text[comma.end() :].strip()
        words = Text(tokenize(before))
        end = len(words.tokens)
        start = words.skip(0, end, "polite", "noise", "topic")
        leads = any(words.match(c, start, end) for c in ("side_word", "side_preposition", "place", "relational"))
        finite = any(is_finite(words, i, end) for i in range(start, end))
        said = Text(tokenize(asked))
        if before and not leads and not finite and said.find("pronoun", 0, len(said.tokens)) is not None:
            if isinstance(target(words, start, end), Selection):
                yield Asked(asked, before, ())
            elif _measures(before) and _PRONOUN.search(asked):  # 'The gap between the fins, how wide is it?'
                named = " ".join(token.raw for token in words.tokens[start:])
                yield Asked(_PRONOUN.sub(named, asked, count=1), "", ())


def _dislocated(text: str) -> Asked | None:
    """'How many spokes does it have, the wheel?': the parts come last."""
    found = re.fullmatch(r"\s*((?:how|what|which|where)\b[^,?]*),\s*(the\s+[^,?]+?)\s*\??\s*", text, re.IGNORECASE)
    if found is None or not _PRONOUN.search(found[1]):
        return None
    words = Text(tokenize(found[2]))
    end = len(words.tokens)
    finite = any(is_finite(words, i, end) for i in range(end))
    of = None if finite else target(words, 0, end)
    return Asked(f"{found[1]}?", found[2], ()) if isinstance(of, Selection) else None


def telegram(text: str) -> str | None:
    """'Slot on top, length?', 'shaft - diameter': the measure of the parts; None where it is no such."""
    found = _TELEGRAM.fullmatch(text.strip())
    if found is None:
        return None
    measure = Text(tokenize(found[2]))
    named = asked_measures(measure, 0, len(measure.tokens))
    parts = Text(tokenize(found[1]))
    end = len(parts.tokens)
    start = parts.skip(0, end, "polite", "topic")
    finite = any(is_finite(parts, i, end) for i in range(start, end))
    if named is None or named[1] < len(measure.tokens) or finite or target(parts, start, end) is None:
        return None
    bare = re.sub(r"^\W*(?:the|its|their|what|which)\s+", "", found[2], flags=re.IGNORECASE)
    said = " ".join(token.raw for token in parts.tokens[start:])
    return f"{bare} of {said}?"


def says_it(asked: str) -> bool:
    """Does a question speak of 'it' or 'them', which something before it must tell?"""
    words = Text(tokenize(asked))
    return any(words.word_at(i, len(words.tokens), *_PRONOUNS, *_POSSESSIVES) for i in range(len(words.tokens)))


def in_brackets(text: str) -> Asked | None:
    """'Key width (keyway in the bore)?': the bracket names the part; 'Aperture (the smallest diameter)?': it asks."""
    found = _BRACKET.fullmatch(text.strip())
    if found is None:
        return None
    outside, inside = Text(tokenize(f"{found[1]} {found[3]}")), Text(tokenize(found[2]))
    where = outside.word_at(0, len(outside.tokens), "where")
    if not where and not any(outside.find(category, 0, len(outside.tokens)) for category in _MEASURING):
        measured = inside.find("property", 0, len(inside.tokens)) is not None
        return Asked(f"{found[2]}?", "", (found[1],)) if measured else None
    named = asked_measures(outside, outside.skip(0, len(outside.tokens), "polite"), len(outside.tokens))
    bare = named is not None and outside.skip(named[1], len(outside.tokens), "light") >= len(outside.tokens)
    return Asked(f"{found[1]} {found[3]}", found[2], ()) if bare and subject(found[2]) else None


def preceded(text: str) -> Iterator[Asked]:
    """'My caliper is too short, can you tell me how deep the bore is?': a statement, a comma or 'but', and a question.

    Not where the statement sets a condition, which would change the answer.
    """
    for comma in _OPENING.finditer(text):
        before, asked = text[: comma.start()].strip(), text[comma.end() :].strip()
        if before and not _CONDITION.search(before):
            yield Asked(asked, before, ())
    before, colon, asked = text.partition(": ")
    if colon and asked.strip() and not _CONDITION.search(before):
        yield Asked(asked, before, ())


def labelled(text: str) -> Iterator[Asked]:
    """'Drill list: diameters of the holes', 'quote request - volume of the housing': what it is for, and a measure.

    What stands before it takes no part in the question where that names a measure and its parts by itself.
    """
    found = _LABEL.fullmatch(text.strip())
    if found is None or _measures(found[1]) or _CONDITION.search(found[1]):
        return
    words = Text(tokenize(found[2]))
    end = len(words.tokens)
    start = words.skip(0, end, "polite", "article", "whole_adjective", "imperative")
    named = asked_measures(words, start, end)
    own = question(without_asides(Text(words.tokens))) if named is not None else None
    led = named is not None and words.word_at(named[1], end, "of")
    placed = modifiers.sides(Text(tokenize(found[1])), 0, len(tokenize(found[1]))) is not None
    if led and not placed and isinstance(own, Get) and isinstance(own.target, Selection):
        yield Asked(found[2], found[1], ())


def _elaborated(first: str, second: str) -> int | None:
    """Which of two sentences asks, where the second only says how the first is to be answered? None when neither does.

    'Where must the screws go? Give the centres of the round holes.': the second. 'At which positions are the holes?
    Give the centres.': the first. 'Is there a logo? How many of them?': the second. 'Which spanner fits, so what is the
    width of the head?': the second, as the first names no measure.
    """
    text = Text(tokenize(second))
    end = len(text.tokens)
    start = text.skip(0, end, "polite", "light", "noise")
    if text.after("imperative", start, end) is not None:
        names_parts = any(text.word_at(i, end, "of", "for") for i in range(start, end))
        measured = any(text.match("property", i, end) for i in range(start, end))
        pronoun = any(text.word_at(i, end, *_PRONOUNS, *_POSSESSIVES) for i in range(start, end))
        own = question(without_asides(Text(tokenize(second))))
        names_parts = names_parts or (isinstance(own, Get) and isinstance(own.target, Selection))
        return (1 if names_parts or pronoun else 0) if measured else None
    if any(text.word_at(i, end, *_PRONOUNS) for i in range(start, end)):
        stated = Text(tokenize(first))
        asks_value = any(stated.match(c, i, len(stated.tokens)) for c in ("property", "count", "scale.positive")
                         for i in range(len(stated.tokens)))  # fmt: skip
        return None if asks_value else 1
    stated = Text(tokenize(first))
    spoken = any(stated.match(c, i, len(stated.tokens)) for c in ("property", "count", "scale.positive", "distance")
                 for i in range(len(stated.tokens)))  # fmt: skip
    return None if spoken or not stated.word_at(0, len(stated.tokens), "which", "what") else 1


def _asks(sentence: str) -> bool:
    """Is a sentence a question or a request of its own? 'List it for all of them' and 'Count … too' explain one."""
    if sentence.endswith("?"):
        return True
    text = Text(tokenize(sentence))
    end = len(text.tokens)
    start = text.skip(0, end, "polite", "light", "noise")
    if text.word_at(start, end, *_WH) or text.word_at(text.skip(0, end, "polite"), end, *_WH):
        return True
    if text.word_at(start, end, "its", "their") and asked_measures(text, start, end) is not None:
        return True
    after = text.after("imperative", start, end) or text.after("count", start, end)
    if after is None or after >= end or text.words[-1] in ("too", "also", "well"):
        return False
    if text.word_at(text.skip(after, end, "each"), end, *_PRONOUNS, "one"):
        return False
    return axes(text, text.skip(after, end, "article"), end) != end


def resolved(text: Text, before: str) -> Text | None:
    """The question with 'it', 'they', 'its', 'their' replaced by what the sentence before speaks of."""
    at = next((i for i, word in enumerate(text.words) if word in (*_PRONOUNS, *_POSSESSIVES)), None)
    if at is not None and _is_within(text, at):
        return None
    several = at is not None and text.words[at] in ("they", "them", "their")
    stated = subject(before, several, not several) if before and at is not None else ()
    if at is None or not stated:
        return None
    mark = (Token("'s", "'s", Kind.POSSESSIVE),) if text.words[at] in _POSSESSIVES else ()
    text.note(f"'{text.tokens[at].raw}' is read as '{' '.join(token.raw for token in stated)}'.")
    return Text((*text.tokens[:at], *stated, *mark, *text.tokens[at + 1 :]), text.book)


def _is_within(text: Text, at: int) -> bool:
    """Is the pronoun's noun in the question itself: 'holes with a ring around them', 'the cone at its wide end'?"""
    end = len(text.tokens)
    led = any(text.match(category, at - 1, at) for category in ("be", "do", "have", "modal", "verb")) or at == 0
    if text.words[at] in ("it", "they") or led or text.words[at - 1] == "for":  # 'the holes for them'
        return False
    meaning = question(without_asides(Text(text.tokens)))
    before = any(modifiers.starts_noun(text, i, end) for i in range(at))
    return before and isinstance(meaning, Get | Count) and isinstance(meaning.target, Selection)


def mentioned(text: Text, before: str) -> Text | None:
    """'(It bolts to the 13 mm holes in the lugs.) How far apart are these holes?': the parts as first named."""
    said = Text(tokenize(before))
    stop = clause_end(said)
    for at in range(len(text.words) - 1):
        noun = LEXICON.singular(text.words[at + 1])
        bare = at + 2 >= len(text.words) or not modifiers.starts_noun(text, at + 2, len(text.words))
        if not text.word_at(at, len(text.words), "the", "these", "those", "this", "that") or not bare:
            continue
        for first in (i for i in range(stop) if said.match("article", i, stop) or said.number(i, stop)):
            last = next((i for i in range(first + 1, stop) if is_finite(said, i, stop)), stop)
            of = target(said, first, last)
            if isinstance(of, Selection) and of.phrases[0].noun == noun and last - first > 2:
                named = said.tokens[first:last]
                text.note(f"'{text.tokens[at + 1].raw}' is read as '{' '.join(token.raw for token in named)}'.")
                return Text((*text.tokens[:at], *named, *text.tokens[at + 2 :]), text.book)
    return None


def seen_from(text: Text, before: str) -> Text | None:
    """'(Seen from the front.) How many holes are there?': from where it is looked at, if that is all that was said."""
    said = Text(tokenize(before))
    end = len(said.tokens)
    start = said.skip(0, end, "polite", "light", "noise", "comma")
    named = modifiers.sides(said, start, end)
    if named is None or said.skip(named[1], end, "noise", "comma") < end:
        return None
    lead = () if named[0].prepositional else (Token("from", "from"),)
    return Text((*text.tokens, Token("visible", "visible"), *lead, *said.tokens[start : named[1]]), text.book)


def completed(text: Text, before: str) -> Text | None:
    """'(The shaft has a keyway.) What width?', '… How many?', '… How wide is the larger one?': with what is left out.

    None when the question leans on nothing, or the sentence before speaks of no parts.
    """
    end = len(text.tokens)
    several = text.after("count", 0, end) is not None or text.word_at(end - 1, end, "ones")
    stated = subject(before, several)
    if not stated:
        return None
    start = text.skip(0, end, "polite")
    while start < end and text.words[start] in (",", "then"):
        start += 1
    named = " ".join(token.raw for token in stated)
    one = next((i for i in range(start + 1, end) if text.words[i] in ("one", "ones") and not _counts(text, i)), None)
    if one is not None and text.after("count", start, end) is not None:
        return None  # 'how many are in the upper one' counts what is in it
    if one is not None:
        several = text.words[one] == "ones"
        text.note(f"'{text.tokens[one].raw}' is read as '{named}'.")
        return Text((*text.tokens[:one], *_named_again(stated, several), *text.tokens[one + 1 :]), text.book)
    count = text.after("count", start, end)
    if count is not None and text.skip(count, end, "light", "pronoun", "of_them", "noise", "verb", "comma") >= end:
        text.note(f"Asked of '{named}'.")
        return Text((*text.tokens[start:count], *_named_again(stated, True)), text.book)
    if text.word_at(start, end, "what", "which") and (measure := text.match("property", start + 1, end)):
        start += measure[1] >= end  # 'which width?' names the measure
    text.note(f"Asked of '{named}'.")
    return Text((*text.tokens[start:end], Token("of", "of"), *stated), text.book)


def _counts(text: Text, at: int) -> bool:
    """Is 'one' a number here: 'one value', 'how far is one of them from the other'?"""
    return text.word_at(at + 1, len(text.tokens), "of", "value", "number", "figure") or text.word_at(at - 1, at, "the")


def _named_again(stated: tuple[Token, ...], several: bool) -> tuple[Token, ...]:
    """'four holes in the lid' as 'holes in the lid', or 'hole in the lid' where one is meant."""
    text = Text(stated)
    at = text.skip(0, len(stated), "article", "quantifier", "number", "sample")
    while at < len(stated) - 1 and text.number(at, len(stated)):
        at += 1
    rest = list(stated[at:])
    plural = next((i for i, token in enumerate(rest) if LEXICON.is_plural(token.word)), None)
    if plural is not None and not several:
        rest[plural] = replace(rest[plural], word=LEXICON.singular(rest[plural].word))
    return tuple(rest)
