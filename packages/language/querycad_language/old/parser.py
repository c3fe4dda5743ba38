"""The semantic parser: an English question in, a program over the guest API out; no model, no network, no guessing."""

from __future__ import annotations

import difflib
from collections.abc import Iterator
from dataclasses import replace

from querycad_contracts import Program

from .asides import hinted, without_asides
from .asking import SCALARS
from .context import (
    Asked,
    aside_before,
    completed,
    explained,
    fronted,
    in_brackets,
    introduced,
    labelled,
    mentioned,
    preceded,
    resolved,
    says_it,
    seen_from,
    sentences,
    telegram,
)
from .errors import EmptyQuestion, NotUnderstood
from .exceptions import exception, without
from .lexicon import LEXICON
from .meaning import Count, Get, Query, Reduce, Selection, Target, Whole, descriptions
from .phrases import target
from .questions import question, topical
from .text import LEFT_OUT, Text
from .tokens import Kind, Token, tokenize
from .wording import asks_each_once, plainly
from .writer import write

CODEGEN = "parser"
LEAST_CONFIDENCE = 0.7
"""Below this a question is declined: a third of the words that carry meaning went unused, or worse."""
LONG_DESCRIPTION = 6
"""Names of parts have fewer words than this; longer ones are rather a sentence that was not understood."""
MAX_TOKENS = 80
"""Longer than any question; the time to parse grows with the cube of the length."""
SHORTEST = 4
"""Fewer words before a comma are no question."""
_NEVER_LEFT_OUT = frozenset(("or", "than", "if", "between", "same", "one", "ones", "not", "how", "what", "which"))
"""Words of a clause that changes what is asked, or asks something else."""
_WITHOUT_MEANING = ("article", "light", "noise")


def parse(question: str) -> Program:
    """Which program answers an English question about a CAD model? Raises EmptyQuestion or NotUnderstood."""
    meaning, text = understand(question)
    unused = _unused(text)
    code, kind = write(meaning)
    confidence = _confidence(meaning, text)
    if confidence < LEAST_CONFIDENCE:
        raise NotUnderstood(f"The question was not understood; not used: {', '.join(unused)}.", unused)
    return Program(
        code=code,
        codegen=CODEGEN,
        expects=kind,
        confidence=confidence,
        unused_words=unused,
        notes=tuple(dict.fromkeys(text.book.notes)),
    )


def understand(asked: str) -> tuple[Query, Text]:
    """What does a question mean? With the text that keeps its notes. Raises EmptyQuestion or NotUnderstood."""
    if not asked.strip():
        raise EmptyQuestion
    once, asked = asks_each_once(asked), plainly(asked)
    passed = aside_before(asked)
    meaning, text = _understood(plainly(asked[len(passed) :]) if passed else asked)
    if passed:
        text.note(f"{LEFT_OUT} {passed.strip()}")
    return _once(meaning) if once else meaning, text


def _understood(asked: str) -> tuple[Query, Text]:
    """The meaning of a question in plain words, less the parts that it excepts."""
    if (said := exception(asked)) is not None:
        try:
            meaning, text = _meant_by(said[0])
        except NotUnderstood:
            return _meant_by(asked)
        if (rest := without(meaning, said[1], text)) is not None:
            return rest, text
    return _meant_by(asked)


def _meant_by(asked: str) -> tuple[Query, Text]:
    """The meaning of a question in plain words, with what is said around it."""
    said = explained(asked) or sentences(asked)
    if said is None:
        raise NotUnderstood("Ask one question at a time.")
    tokens = tokenize(said.question)
    if len(tokens) > MAX_TOKENS or len(tokenize(said.before)) > MAX_TOKENS:
        raise NotUnderstood(f"The question is too long: ask it in at most {MAX_TOKENS} words.")
    _refuse_foreign(tokens)
    if (short := telegram(asked)) is not None:
        asked = plainly(short)
        said = Asked(asked, "", ())
    text = Text(tokenize(asked))
    if ":" in asked and (meaning := topical(without_asides(text))) is not None:
        return hinted(meaning, asked, (), text), text
    unsure: tuple[Query, Text] | None = None
    declined: Text | None = None
    for reading in _readings(asked, said):
        text, meaning = _meant(Text(tokenize(reading.question)), reading.before)
        declined = declined or text
        if meaning is None and reading.correction:  # 'What box does it fit into? I mean the overall size'
            text, meaning = _meant(Text(tokenize(f"what is {reading.correction}?")), reading.before)
            reading = replace(reading, correction="")
        if meaning is None:
            continue
        meant = _corrected(meaning, reading.correction, text) if reading.correction else None
        whole = f"{reading.before}, {reading.question}"
        found = meant or hinted(meaning, whole, reading.hints, text, reading.before)
        if _confidence(found, text) >= LEAST_CONFIDENCE:
            return found, text
        unsure = unsure or (found, text)
    if unsure is not None:
        return unsure
    raise _declined(declined or Text(tokens))


def _unused(text: Text) -> tuple[str, ...]:
    return tuple(dict.fromkeys(token.raw for token in text.book.unread))


def _meant(text: Text, before: str) -> tuple[Text, Query | None]:
    """What does a question mean behind a statement? With the text as it was read."""
    if found := (seen_from(text, before) or resolved(text, before) or mentioned(text, before)) if before else None:
        return found, question(without_asides(found)) or _shortened(found)
    meaning = text.attempt(_alone)
    if before and (meaning is None or _leans(meaning, text)):
        whole = Text(text.tokens)
        full = completed(whole, before)
        of_stated = question(without_asides(full)) if full is not None else None
        if full is not None and of_stated is not None:
            return full, of_stated
    if before and _says_something(before):
        text.note(f"{LEFT_OUT} {before}")
    return text, meaning or _shortened(text)


def _alone(text: Text) -> Query | None:
    return question(without_asides(text))


def _says_something(before: str) -> bool:
    words = Text(tokenize(before))
    return words.skip(0, len(words.tokens), "polite", "noise", "light") < len(words.tokens)


def _leans(meaning: Query, text: Text) -> bool:
    """Is a measure asked for without saying of what: 'which diameter?', and not 'the overall height'?"""
    of_whole = isinstance(meaning, Get) and isinstance(meaning.target, Whole)
    end = len(text.tokens)
    said = any(text.find(category, 0, end) for category in ("whole", "whole_adjective", "material"))
    return of_whole and not said


def _readings(asked: str, said: Asked) -> Iterator[Asked]:
    """How may a question be taken apart? A statement before it counts where the question leans on it, or is whole."""
    if (bracket := in_brackets(asked)) is not None:
        yield bracket
    if not said.before:
        yield from fronted(said.question)
    stated = introduced(said.question) if not said.before else None
    if stated is not None:
        words = Text(tokenize(stated.question))
        alone = question(without_asides(words))
        leans = words.find("pronoun", 0, len(words.tokens)) is not None
        if leans or any(isinstance(one, Selection) for one in _targets(alone)):
            yield stated
    leaning = [one for one in preceded(said.question) if says_it(one.question)] if not said.before else []
    yield from leaning
    if not said.before:
        yield from labelled(said.question)
    yield said
    if ":" in asked and said.before:
        yield Asked(asked, "", ())
    if not said.before:
        yield from preceded(said.question)


def _targets(meaning: Query | None) -> tuple[Target, ...]:
    return (meaning.target,) if isinstance(meaning, Get | Count) else ()


def _corrected(meaning: Query, said: str, text: Text) -> Query | None:
    """'The fork's width, I mean the slot for the roller': the same asked of what was said last."""
    if not isinstance(meaning, Get | Count) or not isinstance(meaning.target, Selection):
        return None
    words = Text(tokenize(said), text.book)
    of = target(words, 0, len(words.tokens), meaning.target)
    if not isinstance(of, Selection):
        return None
    text.note(f"{LEFT_OUT} what is corrected by '{said}'.")
    return replace(meaning, target=of)


def _once(meaning: Query) -> Query:
    """Every value once: the different ones."""
    each = isinstance(meaning, Get) and meaning.reduce is Reduce.EACH and set(meaning.measures) <= SCALARS
    return replace(meaning, reduce=Reduce.DIFFERENT) if isinstance(meaning, Get) and each else meaning


def _shortened(text: Text) -> Query | None:
    """The meaning without the last clause behind a comma, where the whole is not understood; it is left out aloud."""
    words = text.words
    commas = [i for i, word in enumerate(words) if word == ","]
    if not commas or commas[-1] < SHORTEST or any(text.match("unanswerable", i, len(words)) for i in range(len(words))):
        return None
    at = commas[-1]
    if any(words[i] in _NEVER_LEFT_OUT for i in range(at, len(words))):
        return None
    meaning = question(without_asides(text.rearranged(range(at))))
    if meaning is not None:
        text.leave_out(at, len(words))
        text.book.unread.extend(text.tokens[i] for i in range(at + 1, len(words)) if text.tokens[i].kind is Kind.WORD)
    return meaning


def _confidence(meaning: Query, text: Text) -> float:
    """How sure is the reading, 0 to 1: the used share of the words that carry meaning, less for what is unusual.

    Each corrected typing error costs 0.03, each stretch left out 0.05, each word too many in a description 0.1.
    """
    end = len(text.tokens)
    carrying = sum(not any(text.after(category, at, end) for category in _WITHOUT_MEANING) for at in range(end))
    excess = sum(max(0, len(description.split()) - LONG_DESCRIPTION) for description in descriptions(meaning))
    corrected = sum(token.corrected for token in text.tokens)
    left_out = sum(note.startswith(LEFT_OUT) for note in dict.fromkeys(text.book.notes))
    lost = len(_unused(text)) / max(1, carrying) + 0.03 * corrected + 0.05 * left_out + 0.1 * excess
    return round(max(0.0, 1 - lost), 2)


def _refuse_foreign(tokens: tuple[Token, ...]) -> None:
    """Raise NotUnderstood when two words, or half of them, are of another language and no words of the grammar."""
    raw = {token.raw.lower() for token in tokens if token.kind is Kind.WORD}
    for language, known in LEXICON.foreign.items():
        found = (raw & known) - LEXICON.words
        if len(found) >= 2 or (found and 2 * len(raw & known) >= len(raw)):
            raise NotUnderstood(f"The question seems to be {language}; ask in English.", tuple(sorted(found)))
    if raw and not any(word.isascii() for word in raw):
        raise NotUnderstood("The question is not in English; ask in English.", tuple(sorted(raw)))


def _declined(text: Text) -> NotUnderstood:
    """The refusal: what was not understood, and which terms are near."""
    end = len(text.tokens)
    for at in range(end):
        if reason := text.match("unanswerable", at, end):
            return NotUnderstood(reason[0], (text.tokens[at].raw,))
    words = [token.raw for token in text.tokens if token.kind is Kind.WORD and token.word not in LEXICON.words]
    unknown = tuple(dict.fromkeys(words))
    terms = LEXICON.wordings("property")
    nearest = [term for word in unknown for term in difflib.get_close_matches(word.lower(), terms, n=2, cutoff=0.6)]
    message = "The question was not understood; ask for a count, a measure, a position or a distance of a part."
    if unknown:
        message += f" Words that were not understood: {', '.join(unknown)}."
    return NotUnderstood(message, unknown, tuple(dict.fromkeys(nearest)))
