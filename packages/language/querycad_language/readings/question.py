"""A question as the frames see it: its words, its mentions of parts, and the sentence that asks."""

from __future__ import annotations

import math
from collections.abc import Iterable
from functools import cached_property
from itertools import pairwise
from typing import NamedTuple

from querycad_contracts import Place
from querycad_language.phrases import Mention, Phrases
from querycad_language.text import Text


class Holder(NamedTuple):
    """A place of parts that is said apart from them, with its tokens."""

    place: Place
    used: frozenset[int]
    feature: str = "held_topic"
    noun: str | None = None  # of the parts that are there; none where any may be


class Question:
    """One question. `names`: words of product names in the file."""

    def __init__(self, question: str, names: Iterable[str] = ()) -> None:
        self.text = Text(question, frozenset(names))
        self.phrases = Phrases(self.text)
        self.unit_words = {at for stretch, _ in self.units_asked for at in stretch}
        self.mentions = [mention for mention in self.phrases.mentions() if not mention.used <= self.unit_words]
        self.asking, self.claims = _asking_sentence(self.text)

    @cached_property
    def parts(self) -> list[Mention]:
        """The mentions that name parts: no pronouns, and not the whole model."""
        return [mention for mention in self.mentions if mention.query is not None]

    @cached_property
    def views(self) -> list[Mention]:
        """Sides that are said apart from a part: 'Looking from the left, …', '… do you see on the top?'"""
        found: list[Mention] = []
        for at in sorted({*range(len(self.text))}.difference(*(range(one.start, one.end) for one in self.mentions))):
            if (not found or at >= found[-1].end) and (view := self.phrases.view(at)) is not None:
                found.append(view)
        return found

    @cached_property
    def holders(self) -> list[Holder]:
        """What was named before as what has the parts: 'Small boss: bore?', 'The hub has a bore. How broad is it?'"""
        text = self.text
        topics = [m for m in self.parts[:1] if text.skip(0, "article") >= m.start and text.is_word(m.end, ":", ",")]
        found = [Holder(Place(relation="of", what=topic.part), topic.used) for topic in topics]
        for start, _ in text.sentences:  # 'On the flange, how deep is …?', 'In it there are holes. …'
            place, end = self.phrases.place(start)
            leads = text.is_word(end, ",", ":", "-", "there") or text.find(end, "ask", "count", "be", "do")
            found += [Holder(place, frozenset(range(start, end)), "held_place")] if place is not None and leads else []
        for one, other in pairwise(self.parts):
            joined = text.find(one.end, "have") and text.skip(one.end, "have", "article") >= other.start
            asked = self.in_question(one.start) or any(text.find(i, "ask") for i in range(one.start))
            if joined and not asked:
                found.append(Holder(Place(relation="of", what=one.part), one.used, "held_of", other.part.noun))
                found.append(Holder(Place(relation="with", what=other.part), other.used, "held_with", one.part.noun))
        return found

    @cached_property
    def hardness(self) -> dict[str, float]:
        """What makes a question hard to read: its length, as the logarithm of its tokens, and words not known here."""
        text = self.text
        strange = sum(text.is_content(at) and not text.spans[at] for at in {*range(len(text))} - self.unit_words)
        return {"words": math.log(max(1, len(text))), "strange_words": float(strange)}

    @cached_property
    def closed(self) -> bool:
        """Is yes or no asked for, and nothing else: 'Is …?', 'Check whether …', '…, isn't it?'"""
        text, (start, end) = self.text, self.asking
        inside = range(start, end)
        if any(text.find(i, "ask", "where", "count") or text.is_word(i, *_OPEN) for i in inside):
            return False
        if self.claims or self.whether is not None or self.offers_yes_no:
            return True
        either = text.has("or") and len(text.at_phrases("side")) > 1  # 'on the left or on the right?'
        return not either and any(map(self._asks_yes_no, [start, *(i + 1 for i in inside if text.is_word(i, ","))]))

    @cached_property
    def chooses(self) -> bool:
        """Is one of two asked for: 'Which is longer, the spindle or the lever?'"""
        text = self.text
        two = sum(self.in_question(part.start) for part in self.parts) == 2  # 'which is longer: the pin or the rod?'
        asks = any(text.is_word(i, "which", "what") for i in range(0 if two else self.asking[0], self.asking[1]))
        offered = any(a.end <= at < b.start for at in text.at_words("or") for a, b in pairwise(self.parts))
        return asks and offered and not text.has("than")

    def antecedent(self, start: int) -> Mention | None:
        """'The block has a hole. Is it threaded?': what is named last before a clause with a pronoun for it."""
        said = any(m.pronoun and m.start >= start for m in self.mentions)
        return next((m for m in reversed(self.parts) if m.end <= start), None) if said else None

    @property
    def offers_yes_no(self) -> bool:
        """'keyway full length, y/n', 'yes or no?', 'true or false?'; and 'slots all alike?'"""
        text, (start, end) = self.text, self.asking
        if any(text.is_word(i + 2, "n", "no", "false") for i in text.at_words("y", "yes", "true")):
            return True
        same = {i for i in text.at_phrases("same") if self.in_question(i) and not text.is_word(i - 2, "on", "in", "at")}
        alike = bool(same) and not any(text.find(i, *_ASKING) for i in range(start, end))
        return text.is_word(end, "?") and (alike or self._declares)

    @property
    def _declares(self) -> bool:
        """Is it said with a question mark: 'Lugs are on both sides?', 'It goes right through?', 'Lug bored?'"""
        text, start, inside = self.text, self.asking[0], range(*self.asking)
        subject = next((m for m in self.parts if start <= m.start <= start + 1), None)
        if subject is None or any(text.find(i, *_ASKS) or text.is_word(i, "how", "or") for i in inside):
            return False
        verb = next((i for i in range(subject.head + 1, subject.end + 1) if text.is_word(i, *_SAYING)), None)
        trait = text.find(subject.head + 1, "adjective") if not text.find(start, "be", "do", "modal") else None
        if trait is not None and trait.value.tags and not text.find(trait.end, "noun", "measure", "article"):
            return not any(text.find(i, "measure", "scale") for i in inside)
        return verb is not None and not any(text.is_word(i, "that", "which", "who") for i in range(subject.head, verb))

    def _asks_yes_no(self, begin: int) -> bool:
        """Does a clause begin here with its verb: 'so is the bore …', 'will a pin …'? Not: 'would you …'."""
        text = self.text
        lead = next((i for i in range(begin, len(text)) if not text.is_word(i, *_BEFORE_VERB)), begin)
        if text.is_word(lead + 1, "i", "we") and text.is_word(lead + 2, *_REQUESTS):
            return False
        verb = text.find(lead, "be", "do", "modal") or text.is_word(lead, *_MAIN_VERBS)
        return bool(verb) and not text.is_word(lead, "be") and not text.is_word(lead + 1, "you", "anyone", "anybody")

    @cached_property
    def whether(self) -> int | None:
        """Where the clause begins that is asked for: 'check whether …', 'tell me if …'; none where a value is, too."""
        text, (start, end) = self.text, self.asking
        for at in range(start, end):
            said = text.is_word(at, "whether") or (text.is_word(at, "if") and text.is_word(at - 1, *_ASKS_IF))
            confirms = text.is_word(at - 1, *_CONFIRMS) and not text.is_word(at - 2, "to")  # 'in order to verify that'
            said = said or (text.is_word(at, "that") and confirms)
            apart = any(text.is_word(i, ",") and text.find(i + 1, "be", "do", "modal") for i in range(at, end))
            if said and not apart and not any(text.find(i, "measure") for i in range(start, at)):
                return at
        return None

    def in_question(self, at: int) -> bool:
        """Is the token in the sentence that asks?"""
        return self.asking[0] <= at < self.asking[1]

    def sentence_of(self, at: int) -> int:
        """Which sentence is the token in? -1 between two."""
        return next((i for i, (start, end) in enumerate(self.text.sentences) if start <= at < end), -1)

    def unit(self, at: int) -> tuple[int, int] | None:
        """The unit of measure that begins here: where it ends, and its power: 1 of lengths, 2 of areas, 0 of angles."""
        units = self.text.lexicon.units
        for end in (at + 2, at + 1):
            name = " ".join(token.raw.lower() for token in self.text.tokens[at:end])
            if name in units:
                return min(end, len(self.text)), units[name][1]
        return None

    @cached_property
    def units_asked(self) -> list[tuple[set[int], int]]:
        """The units that the answer shall have, their tokens and powers: 'in cm', 'in square millimetres'."""
        units = ((at, self.unit(at + 1)) for at in sorted(self.text.at_words("in")))
        return [(set(range(at, unit[0])), unit[1]) for at, unit in units if unit is not None]

    @cached_property
    def in_degrees(self) -> bool:
        """Is an angle asked for: 'how many degrees apart', 'how far in degrees'?"""
        counted = [self.unit(at + 2) for at in self.text.at_words("how") if self.text.is_word(at + 1, "many")]
        return any(unit is not None and unit[1] == 0 for unit in (*counted, self.unit_asked))

    @property
    def unit_asked(self) -> tuple[set[int], int] | None:
        """The unit that says what is asked for: areas, volumes and angles have others than lengths."""
        return next((unit for unit in self.units_asked if unit[1] != 1), None)


def used_by(*mentions: Mention | None) -> set[int]:
    """The tokens that name them, of those that there are."""
    return {at for mention in mentions if mention is not None for at in mention.used}


def _asking_sentence(text: Text) -> tuple[tuple[int, int], bool]:
    """The last sentence with a question word or an order, else the last; and is it a claim: '…. Is that correct?'"""
    best: tuple[int, int, int] = (-1, 0, len(text))
    for start, end in text.sentences:
        words = range(start, end)
        answers = all(text.is_word(i, *_YES_OR_NO) for i in words)  # 'slots: yes or no?'
        named = any(text.is_content(i) or text.is_word(i, "how") for i in words) or text.any_in(words, *_NAMING)
        echoes = len(words) <= LONGEST_ECHO and text.any_in(words, "ask") and not named
        if start > 0 and (answers or echoes):  # 'Do any cross? Which ones?', 'If so, what are they?'
            continue
        asks = text.any_in(words, *_ASKS, "exists")
        names = text.any_in(words, "measure", "distance", "gap")
        best = max(best, (4 * text.is_word(end, "?") + 3 * asks + 2 * names, start, end))
    _, start, end = best
    begin = _tag(text, start, end)
    if start < begin < end:
        return (start, begin), True
    before = [sentence for sentence in text.sentences if sentence[1] <= start and begin == start]
    return (before[-1], True) if before else ((start, end), False)


LONGEST_ECHO = 6  # words of a question that only asks which of those before are meant
_NAMING = ("noun", "measure", "scale", "count", "side", "verbs", "reach", "distance", "gap")
_IN_TAGS = ("confirm", "be", "do", "modal", "negation", "pronoun", "article", "function", "whole")
_TOLD = (",", "you", "we", "number", "value", "dimension", "count", "with")
_ASKS_IF = (
    "me", "true", "yes", "check", "know", "see", "wonder", "sure", "say", "ask", "confirm", "verify", "out", "us",
    "test", "look",
)  # fmt: skip
"""Words before an 'if' that asks: 'tell me if …'. Others state a condition."""
_CONFIRMS = ("confirm", "verify", "check", "ensure", "true", "correct", "right", "sure")
"""Words before a 'that' that asks: 'confirm that …', 'is it true that …'."""
_ASKS = ("ask", "where", "count", "imperative")
_ASKING = (*_ASKS, "be", "do", "modal", "have", "distance")
"""What a question without a verb that asks for yes or no has none of."""
_SAYING = ("is", "are", "go", "goe", "pass", "run", "has", "have", "come", "reach", "open")
"""Verbs of what is said, and asked by a question mark alone; 'goe' is 'goes' as words are folded."""
_REQUESTS = ("ask", "trouble", "have", "get", "know", "request", "bother")
_BEFORE_VERB = ("and", "but", "so", "please", "now", "then")
_MAIN_VERBS = ("has", "have", "go", "goes", "exist", "exists")
_YES_OR_NO = ("yes", "no", "true", "false", "y", "n", "or", "/")
_OPEN = ("give", "possible")
"""Words of a clause that asks for more than yes or no, though it begins so: 'is it possible to give me …'."""


def _tag(text: Text, start: int, end: int) -> int:
    """Where a tag such as ', right?' or 'is this correct?' begins; the sentence's end where there is none."""
    begin = end
    while begin > start and (text.find(begin - 1, *_IN_TAGS) or text.is_word(begin - 1, *_TOLD)):
        begin -= 1
    if begin > start:  # within a sentence the tag stands behind a comma
        begin = next((i for i in range(begin, end) if text.words[i] == ","), end)
    return begin if any(text.find(i, "confirm", "negation") for i in range(begin, end)) else end
