"""The semantic parser: an English question in, a program over the guest API out; no model, no network, no guessing."""

from __future__ import annotations

import difflib
from collections.abc import Iterator
from dataclasses import replace

from querycad_contracts import Program

from .asides import Asked, explained, hinted, introduced, resolved, sentences, without_asides
from .asking import SCALARS
from .errors import EmptyQuestion, NotUnderstood
from .lexicon import LEXICON
from .meaning import Count, Get, Query, Reduce, Selection, Target, descriptions
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
    unused = tuple(dict.fromkeys(token.raw for token in text.book.unread))
    code, kind = write(meaning)
    confidence = _confidence(meaning, text, len(unused))
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
    said = explained(asked) or sentences(asked)
    if said is None:
        raise NotUnderstood("Ask one question at a time.")
    tokens = tokenize(said.question)
    if len(tokens) > MAX_TOKENS or len(tokenize(said.before)) > MAX_TOKENS:
        raise NotUnderstood(f"The question is too long: ask it in at most {MAX_TOKENS} words.")
    _refuse_foreign(tokens)
    text = Text(tokens if said.question == asked else tokenize(asked))
    if ":" in asked and (meaning := topical(without_asides(text))) is not None:
        found = hinted(meaning, asked, (), text)
        return _once(found) if once else found, text
    for reading in _readings(asked, said):
        text = resolved(Text(tokenize(reading.question)), reading.before)
        meaning = question(without_asides(text)) or _shortened(text)
        if meaning is not None:
            found = hinted(meaning, reading.question, reading.hints, text, reading.before)
            return _once(found) if once else found, text
    raise _declined(text)


def _readings(asked: str, said: Asked) -> Iterator[Asked]:
    """How may a question be taken apart? A statement before it counts where the question leans on it, or is whole."""
    stated = introduced(said.question) if not said.before else None
    if stated is not None:
        words = Text(tokenize(stated.question))
        alone = question(without_asides(words))
        leans = words.find("pronoun", 0, len(words.tokens)) is not None
        if leans or any(isinstance(one, Selection) for one in _targets(alone)):
            yield stated
    yield said
    if ":" in asked and said.before:
        yield Asked(asked, "", ())


def _targets(meaning: Query | None) -> tuple[Target, ...]:
    return (meaning.target,) if isinstance(meaning, Get | Count) else ()


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


def _confidence(meaning: Query, text: Text, unused: int) -> float:
    """How sure is the reading, 0 to 1: the used share of the words that carry meaning, less for what is unusual.

    Each corrected typing error costs 0.03, each stretch left out 0.05, each word too many in a description 0.1.
    """
    end = len(text.tokens)
    carrying = sum(not any(text.after(category, at, end) for category in _WITHOUT_MEANING) for at in range(end))
    excess = sum(max(0, len(description.split()) - LONG_DESCRIPTION) for description in descriptions(meaning))
    corrected = sum(token.corrected for token in text.tokens)
    left_out = sum(note.startswith(LEFT_OUT) for note in dict.fromkeys(text.book.notes))
    lost = unused / max(1, carrying) + 0.03 * corrected + 0.05 * left_out + 0.1 * excess
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
