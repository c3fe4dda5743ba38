"""A question that leans on what was pointed at, or asked before, as one that stands alone.

'And how deep is it?' 'The same in inches.' 'Only the ones on top.' 'And the slots?' Parts that are pointed at, or that
the question before was about, are put in by their ids; what is asked of others is asked in the words of before.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from querycad_contracts import Failure, FailureCategory, LengthUnit, Part, PartKind, Selection
from querycad_language.readings.question import Question

from .addressing import GROUP, folded
from .drawing.asked_units import asked_unit
from .drawing.describing import SURFACES

Parts = Callable[[], Sequence[Part]]
"""All parts of the model."""
Before = Callable[[str], Sequence[str] | None]
"""Ids of the parts that a question, which stands alone, is answered by; None where it is about the whole model."""

_UNITS = {LengthUnit.MM: "mm", LengthUnit.CM: "cm", LengthUnit.M: "metres", LengthUnit.IN: "inches"}
_LEAD = r"(?:(?:and|but|so|ok|okay|now|then|also|what about|how about|what of)[\s,]{1,4}){0,6}"
_FOLLOWS = re.compile(r"(?:and|but|so|also|what about|how about|what of)\b", re.IGNORECASE)
_SAME = frozenset((
    "and", "but", "the", "same", "thing", "question", "answer", "value", "it", "that", "this", "what", "is", "be",
    "would", "about", "again", "please", "now", "convert", "converted", "to", "show", "give", "me", "in", "mm", "inch",
    "inches", "cm", "millimetre", "millimetres", "millimeter", "millimeters", "metre", "metres", "meter", "meters", "m",
    "how", "much", "as", "ok", "can", "could", "you", "i", "have", "repeat", "express", "expressed",
))  # fmt: skip
_ONLY = re.compile(
    rf"{_LEAD}(?:only|just|restrict(?:ed)? (?:it |that |this |them )?to|limit(?:ed)? (?:it |that |this |them )?to)\s+"
    r"(?:for |count |of )?(?P<rest>.+)",
    re.IGNORECASE,
)
_ORDINALS = ("first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth", "ninth", "tenth")
_NTH = re.compile(
    rf"\b(?:the )?(?:(?P<word>{'|'.join(_ORDINALS)}|last)|(?P<digits>\d{{1,3}})(?:st|nd|rd|th)) "
    r"(?:one\b|of (?:them|these|those)\b)|\b(?:mark|balloon|label|number) ?#?(?P<mark>\d{1,4})\b",
    re.IGNORECASE,
)
_ITS = re.compile(r"\b(?:its|their)\b", re.IGNORECASE)
_THEIR = re.compile(r"\btheir ((?:(?!from\b|to\b)[\w-]+ ?){1,3})(?=[?.!,]|$)", re.IGNORECASE)
_PICKED = r"the (?:selected|clicked|marked|highlighted|chosen|picked)"
_THIS = re.compile(
    rf"\b(?:this|these|those|that|{_PICKED}) (?P<noun>one|ones|part|parts|feature|features|selection|[a-z]+)\b",
    re.IGNORECASE,
)
_IT = re.compile(rf"\b(?:it|they|them|these|those|this|{_PICKED}|that(?=\s*(?:[?.!,]|$|is\b)))\b", re.IGNORECASE)
_ONES = re.compile(r"\b(?:ones?|those|that)\b", re.IGNORECASE)
_ARTICLE = re.compile(r"^(?:the|a|an|all|any|every|each|many) ", re.IGNORECASE)
_HOW_MANY = re.compile(
    rf"{_LEAD}how many(?: of (?:them|those|these))?(?: are there| is that| are they)?", re.IGNORECASE
)
_FACES = re.compile(r"\b(?:faces?|surfaces?)\b", re.IGNORECASE)
_NO_FEATURE = frozenset(kind for kind in PartKind if not kind.is_feature) - {PartKind.REGION}
_PLAIN_NOUNS = ("one", "ones", "part", "parts", "feature", "features", "selection")


@dataclass(frozen=True, slots=True)
class Turn:
    """A question that stands alone. `frame` has a {} for what it is about, `noun` says what that is, without article.

    `frame` is empty where the question is about several things, or none.
    """

    text: str
    frame: str = ""
    noun: str = ""


class NotFollowed(Exception):
    """A question leans on others in a way that is not understood, or on what is not there; `str()` says so."""


def stands_alone(
    question: str, context: Sequence[str], selection: Selection | None, parts: Parts, before: Before
) -> str:
    """The question with what it leans on put in. Raises NotFollowed.

    `context`: the questions asked before, the oldest first. `selection`: what is pointed at now.
    """
    turn: Turn | None = None
    for earlier in map(folded, context):
        try:
            turn = _turn(earlier, turn, (), before) if earlier else turn
        except NotFollowed:
            turn = _plain(earlier)
    selected = _selected(selection, question, parts) if selection is not None else ()
    if turn is None and not selected:
        if (nth := _NTH.search(question)) and not any(one.query for one in Question(question).mentions):
            raise NotFollowed(f"'{nth[0]}' counts what was answered before, and nothing was")
        return question
    return _turn(question, turn, selected, before).text


def _turn(question: str, last: Turn | None, selected: Sequence[str], before: Before) -> Turn:
    """The question, after the last one and with what is pointed at, as one that stands alone."""
    if last is not None and (found := _in_words_of(question, last)) is not None:
        return found
    if selected:
        return _pointed(question, selected)
    if last is not None and last.noun and Question(question).text.at_phrases("distance", "center_to_center"):
        noun = last.noun  # of all from each other: 'their pitch'
        alone = f"{question.rstrip(' ?.!')} of the {noun}?" if _measure_alone(question) else question
        question = _THEIR.sub(lambda match: f"the {match[1]} of the {noun}", alone)
    leans = _NTH.search(question) or _ITS.search(question) or _IT.search(question) or _measure_alone(question)
    ids = before(last.text) if last is not None and leans else None
    if last is None or ids is None or not (ids or last.noun):
        return _plain(question)
    if not ids:
        raise NotFollowed(f"the question before was about '{last.noun}', and no such part was found")
    found = _pointed(question, ids)
    return replace(found, noun=last.noun) if found.frame else found


def _in_words_of(question: str, last: Turn) -> Turn | None:
    """The last question in another unit, about fewer parts or about others; None where that is not asked."""
    said = question.strip().rstrip("?.! ")
    unit = asked_unit(question)
    if unit is not None and all(word in _SAME for word in re.findall(r"[a-z]+", question.lower())):
        return replace(last, text=f"{last.text.rstrip(' ?.!')} in {_UNITS[unit]}?")
    if (only := _ONLY.fullmatch(said)) is not None:
        return _narrowed(only["rest"], last)
    if last.noun and _HOW_MANY.fullmatch(said):
        return Turn(f"How many {last.noun} are there?", "How many {} are there?", last.noun)
    noun = _bare_noun(question)
    return None if noun is None else _asked_of(noun, last)


def _plain(question: str) -> Turn:
    """A question that leans on nothing, with the noun that it is about, where there is one alone."""
    asked = Question(question)
    mentions = [mention for mention in asked.mentions if mention.query is not None and not mention.pronoun]
    if len(mentions) != 1:
        return Turn(question)
    raw = [token.raw for token in asked.text.tokens]
    words = map(re.escape, raw[mentions[0].start : mentions[0].end])
    found = re.search(r"[\s-]*".join(words), question, re.IGNORECASE)  # 'T-slots' are two words
    if found is None or not found[0]:
        return Turn(question)
    at, said = found.start(), found[0]
    article = _ARTICLE.match(said)
    noun = said[article.end() :] if article else said
    frame = question[:at].replace("{", "").replace("}", "") + (article[0] if article else "")
    return Turn(question, frame + "{}" + question[at + len(said) :].replace("{", "").replace("}", ""), noun)


def _narrowed(rest: str, last: Turn) -> Turn:
    """'Only the blind ones', 'only the largest', 'just those on top': the last question about fewer parts."""
    if not last.frame or not last.noun:
        raise NotFollowed("it is not clear which parts of the question before are meant: ask in full")
    rest = _ARTICLE.sub("", rest)
    if _ONES.search(rest):
        noun = _ONES.sub(lambda _: last.noun, rest, count=1)
    elif any(mention.query is not None and mention.query.noun for mention in Question(rest).mentions):
        noun = rest
    elif re.match(r"(?:on|in|at|from|with|without|visible|of|near|above|below|inside|between)\b", rest, re.IGNORECASE):
        noun = f"{last.noun} {rest}"
    else:
        noun = f"{rest} {last.noun}"
    return _asked_of(noun, last)


def _asked_of(noun: str, last: Turn) -> Turn:
    """The last question, asked of other parts."""
    if not last.frame:
        raise NotFollowed("the question before is about several parts: ask in full")
    bare = _ARTICLE.sub("", noun)
    article = "" if re.search(r"\b(?:the|a|an|all|any|every|each|many|which|what|of) \{\}", last.frame) else "the "
    wanted = bare if re.search(r"\b(?:many|which|the) \{\}", last.frame) or _is_id(bare) else article + bare
    return Turn(last.frame.replace("{}", wanted), last.frame, bare)


def _is_id(text: str) -> bool:
    return bool(re.fullmatch(r"[A-Za-z][\w-]*[- ]?\d[\w.]*", text))


def _bare_noun(question: str) -> str | None:
    """The parts that a question is nothing but: 'and the slots?', 'what about hole 6?'"""
    if not _FOLLOWS.match(question):
        return None
    rest = re.sub(rf"^{_LEAD}", "", question, flags=re.IGNORECASE).strip(" ?.!,")
    asked = Question(rest)
    if len(asked.mentions) != 1 or asked.mentions[0].query is None or asked.mentions[0].pronoun:
        return None
    mention = asked.mentions[0]
    if not (mention.query and ((mention.query.known and mention.query.noun) or mention.query.ids)) or _IT.search(rest):
        return None
    outside = [i for i in range(len(asked.text)) if not mention.start <= i < mention.end and asked.text.is_content(i)]
    measures = any(asked.text.find(i, "measure", "ask", "count", "distance") for i in range(len(asked.text)))
    return rest if not outside and not measures else None


def _measure_alone(question: str) -> bool:
    """Does a question that goes on ask for a measure, and of nothing: 'and the depth?'"""
    if not _FOLLOWS.match(question):
        return False
    asked = Question(question)
    return not any(mention.query is not None for mention in asked.mentions)


def _pointed(question: str, ids: Sequence[str]) -> Turn:
    """The question with the ids for 'it', 'these', 'this hole', 'the third one'; else they go behind it."""
    named = " and ".join(ids) if len(ids) <= 2 else GROUP.join(ids)

    def nth(match: re.Match[str]) -> str:
        word = (match["word"] or "").lower()
        number = (
            len(ids) if word == "last" else _ORDINALS.index(word) + 1 if word else int(match["digits"] or match["mark"])
        )
        if not 1 <= number <= len(ids):
            raise NotFollowed(f"there is no number {number} among {len(ids)} part{'s' if len(ids) > 1 else ''}")
        return ids[number - 1]

    text, found = _NTH.subn(nth, question)
    if found:
        return Turn(text)
    if _ITS.search(question):
        text = _ITS.sub(f"{named}'s", question, count=1)
        return Turn(text, _ITS.sub("the {}'s", question, count=1))
    for pattern in (_THIS, _IT):
        match = next((each for each in pattern.finditer(question) if _stands_for_parts(each)), None)
        if match is not None:
            before, after = question[: match.start()], question[match.end() :]
            return Turn(f"{before}{named}{after}", f"{before}{{}}{after}")
    if any(mention.query is not None and not mention.pronoun for mention in Question(question).mentions):
        return _plain(question)
    bare = question.rstrip(" ?.!")
    joined = " is " if re.fullmatch(rf"{_LEAD}how [a-z]+", bare, re.IGNORECASE) else " of "
    return Turn(f"{bare}{joined}{named}?", f"{bare}{joined}{{}}?")


def _stands_for_parts(match: re.Match[str]) -> bool:
    """Is the word behind 'this' a noun, as in 'this hole', or does 'this' stand alone?"""
    noun = match.groupdict().get("noun")
    if noun is None or noun.lower() in _PLAIN_NOUNS:
        return True
    return any(mention.query is not None and mention.query.known for mention in Question(noun).mentions)


def _selected(selection: Selection, question: str, parts: Parts) -> tuple[str, ...]:
    """Ids of the parts that are pointed at. Faces stand for the feature that has them all, else each for its own.

    Where the question speaks of faces, they stand for themselves. Raises NotFollowed for what the model lacks.
    """
    if not selection.parts and not selection.faces:
        return ()
    known = {part.id: part for part in parts()}
    found, numbers = [], list(selection.faces)
    for name in selection.parts:
        part = name.strip().lower().replace(" ", "-")  # 'hole 4'
        if part in known:
            found.append(part)
        elif face := re.fullmatch(r"face-(\d{1,9})", part):
            numbers.append(int(face[1]))
        else:
            raise NotFollowed(f"the model has no {name}, which is selected")
    faces = frozenset(numbers)
    features = [part for part in known.values() if part.kind not in _NO_FEATURE]
    said = {match["noun"].lower() for match in _THIS.finditer(question)}
    of_kind = [part for part in features if {part.kind.value, f"{part.kind.value}s"} & said and set(part.faces) & faces]
    features = of_kind or features
    if faces and not _FACES.search(question):
        whole = min(
            (part for part in features if faces <= set(part.faces)), key=lambda part: len(part.faces), default=None
        )
        if whole is not None:
            return (*dict.fromkeys((*found, whole.id)),)
    found += [_part_of(face, known, [] if _FACES.search(question) else features) for face in numbers]
    return tuple(dict.fromkeys(found))


def _part_of(face: int, known: dict[str, Part], features: Sequence[Part]) -> str:
    """The smallest feature that has the face, else the surface that it is."""
    of = [part for part in features if face in part.faces]
    of = of or [part for part in known.values() if part.kind in SURFACES and part.faces == (face,)]
    if not of:
        last = max((each for part in known.values() for each in part.faces), default=0)
        raise NotFollowed(f"nothing is known of face {face}, which is selected; faces have the numbers 0 to {last}")
    return min(of, key=lambda part: len(part.faces)).id


def not_followed(error: NotFollowed) -> Failure:
    """What is said where a question leans on what is not there."""
    return Failure(category=FailureCategory.NOT_UNDERSTOOD, message=str(error))
