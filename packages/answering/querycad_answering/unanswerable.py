"""Why a question is not answered: it asks for what no STEP file holds, for nothing, or for a part that is not there."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

from querycad_contracts import Failure, FailureCategory, Measure, PartQuery
from querycad_language.describe import none_such, noun_phrase, place_phrase
from querycad_language.forms import Check, Get
from querycad_language.lexicon import Span, lexicon
from querycad_language.readings import Reader
from querycad_language.text import Text
from querycad_language.tokens import DENSITY, Kind

from .candidates import Absence, Candidate
from .drawing.meaning import describe

BEHIND_ASKING = 4
"""So far before what is asked for may the word that asks stand: 'how much does it cost'."""
TAKEN_FOR_WHOLE = ("unknown_whole", "whole_generic")
"""Features of a noun that the model has no part for, and that may stand for the whole of it."""
_AMOUNTS = ("measure", "distance", "gap", "scale", "cannot_know", "reach")
_MEASURED = ("measure", "count", "exists", "distance", "gap")

_WEIGHED = frozenset((Measure.MASS, Measure.INERTIA))
_CANNOT_KNOW = {
    "price": "a STEP file holds no price",
    "tolerance": "a STEP file of this kind holds no tolerance and no surface finish: it is the nominal shape",
    "density": "a STEP file holds no density: state one, such as 7850 kg/m3, or name one of "
    f"{', '.join(sorted(lexicon().words('material')))}; or ask for the volume",
    "material": "a STEP file does not say which material the part is made of",
    "strength": "a STEP file holds no load and no strength",
    "author": "who designed the part, and with what, is not read from the file",
    "process": "a STEP file does not say how the part is to be made",
}


_LEVELS = ("below", "above", "beyond", "beneath")
"""'How much is the groove cut below the face?' asks for no price."""
_LEAD = r"^(?:(?:and|but|so|hi|hello|please|sorry)[\s,]+)*"
_BEYOND = tuple(
    (re.compile(pattern, re.IGNORECASE), message)
    for pattern, message in (
        (_LEAD + r"when (?:is|are|was|were|did|does|will|has|have)\b", "a STEP file says nothing of dates and times"),
        (
            _LEAD + r"why (?:is|are|was|were|did|do|does|has|have|not)\b",
            "a STEP file holds the shape of a part, not the reasons for it",
        ),
        (r"\bhow long (?:does|do|did|will|would)\b.*\btakes?\b", "a STEP file does not say how long anything takes"),
        (
            r"\bdo you (?:like|love|hate|enjoy|prefer)\b|\bdo you (?:think|feel|say) (?:of|about)\b",
            "that is a matter of opinion: ask for a measure, a number or a place",
        ),
    )
)
"""What no shape answers, by the words that ask: a time, a reason, an opinion."""
_HOW_MUCH = re.compile(
    _LEAD + r"how much (?:is|are|for) (?:the|this|that|these|those|a|an|one|it|they)\b[^.?!,;]*[.?!\s]*$", re.IGNORECASE
)
_ENGLISH = 0.25
"""A question is in another language, or none, where less than this share of its words is known here."""


@dataclass(frozen=True, slots=True)
class Refused:
    """A question that may have to be refused."""

    reader: Reader
    """The words, which sentence asks, and all that can be meant."""
    kinds: tuple[str, ...]
    """Kinds of part that the model has."""

    def absent(self, missing: Absence) -> Failure:
        """The part is not there: which word is missing, and which kinds of part there are?"""
        query, grounded = missing.query, missing.grounded
        noun = query.noun or "part"
        said = noun_phrase(query).removeprefix("the ")
        if "unknown_noun" in grounded.features:
            return self.not_grounded(f"'{noun}' is not a part that is known here")
        if "nothing" not in grounded.features and (none := none_such(query)):
            return Failure(category=FailureCategory.NOT_GROUNDED, message=none)
        if elsewhere := _elsewhere(query, grounded.features):
            return self.not_grounded(elsewhere)
        narrowed = any(name.endswith("_empties") for name in grounded.features)
        return self.not_grounded((not narrowed and grounded.reason) or f"the model has no '{said}'")

    def not_grounded(self, message: str) -> Failure:
        """The failure, with the kinds of part that there are."""
        return Failure(category=FailureCategory.NOT_GROUNDED, message=message, nearest=self.kinds)


def _elsewhere(query: PartQuery, features: Mapping[str, float]) -> str:
    """What the model has in another place than is said, or which place it lacks; '' where it is something else."""
    if "place_absent" in features and len(query.places) == 1:
        return f"the model has no '{noun_phrase(query.places[0].what).removeprefix('the ')}'"
    left = "places" if "place_elsewhere" in features else "ends" if "end_empties" in features else ""
    if not left:
        return ""
    plain = noun_phrase(query.model_copy(update={left: ()})).removeprefix("the ")
    where = map(place_phrase, query.places) if left == "places" else ("at the", *query.ends, "end")
    return f"the model has '{plain}', but not {' '.join(where)}"


def cannot_know(asked: Refused, best: Candidate | None) -> Failure | None:
    """Does the question ask for what no STEP file holds? Not where a density is stated, or another thing is asked."""
    text = asked.reader.text
    beyond = next((message for pattern, message in _BEYOND if pattern.search(text.question)), None)
    if beyond is not None:
        return Failure(category=FailureCategory.NOT_GROUNDED, message=beyond)
    if _HOW_MUCH.search(text.question) and not any(text.all(*_AMOUNTS)) and not text.has(*_LEVELS):
        message = f"{_CANNOT_KNOW['price']}; for an amount name its measure, such as the volume"
        return Failure(category=FailureCategory.NOT_GROUNDED, message=message)
    if any(token.power == DENSITY and token.value > 0 for token in text.tokens):
        return None
    first = next(iter(asked.reader.readings), None)
    form = first.form if first is not None else None
    weighed = form.left if isinstance(form, Check) else form
    weighs = isinstance(weighed, Get) and weighed.density is None and bool(_WEIGHED & set(weighed.measures))
    if weighs and not _weighs_nothing(text):
        return Failure(category=FailureCategory.NOT_GROUNDED, message=_CANNOT_KNOW["density"])
    start, end = asked.reader.asking
    unknowable = [span for span in text.all("cannot_know") if start <= span.start < end]
    inside = {i for span in unknowable for i in range(span.start, span.end)}
    measured = any(text.find(i, *_MEASURED) for i in range(start, end) if i not in inside)
    for span in unknowable:
        if span.value == "tolerance" and text.is_word(span.start, "run") and text.find(start, "do", "modal"):
            continue  # 'does the slot run out through the end?'
        noun = text.find(span.start, "noun")  # 'surface finish' is no surface
        is_used = best is not None and span.start in best.reading.used and noun is not None and noun.end >= span.end
        if not is_used and (not measured or _asks_for(asked, span.start, start)):
            return Failure(category=FailureCategory.NOT_GROUNDED, message=_CANNOT_KNOW[span.value])
    return None


def _weighs_nothing(text: Text) -> bool:
    """Does every word for a weight name something else: 'the volume for the weight estimate', 'size of the weights'?"""
    spans = [one for one in text.all("measure") if getattr(one.value, "measure", one.value) in _WEIGHED]
    other = [one.start for one in text.all("measure") if one not in spans]

    def names(span: Span) -> bool:
        estimate = span.end < len(text) and text.is_content(span.end) and not text.spans[span.end]
        weights = text.tokens[span.start].plural and text.any_in(range(max(0, span.start - 3), span.start), "article")
        return (estimate or weights) and any(at < span.start for at in other)

    return bool(spans) and all(map(names, spans))


def _asks_for(asked: Refused, at: int, start: int) -> bool:
    """Does a word that asks lead to this one, with no measure in between: 'what is the usual tolerance'?"""
    text = asked.reader.text
    for i in range(at, max(start, at - BEHIND_ASKING) - 1, -1):
        if text.find(i, "measure", "distance", "gap"):
            return False
        if text.find(i, "ask") or text.is_word(i, "how"):
            return True
    return False


def nothing_asked(asked: Refused, best: Candidate | None) -> Failure | None:
    """Is nothing asked, or of nothing that is known at all?"""
    if best is None:
        return None if asked.reader.readings else unread(asked)
    if "named_only" not in best.features:
        return None
    unknown = any(
        {"unknown_whole", "unknown_noun", "guessed"} & set(grounded.features) for grounded in best.grounds.values()
    )
    return unread(asked) if unknown else None


def unread(asked: Refused) -> Failure:
    """What is said where there is no reading, or none that makes sense of the model's parts."""
    if not asked.reader.readings:
        message = "I can't find a question in this: ask for a measure, a number or a place of a part"
        return Failure(category=FailureCategory.NOT_UNDERSTOOD, message=message)
    words = [i for i, token in enumerate(asked.reader.text.tokens) if token.kind is Kind.WORD]
    known = sum(bool(asked.reader.text.spans[i]) for i in words)
    if known < _ENGLISH * len(words):
        message = "hardly a word of this is known here: ask in English for a measure, a number or a place of a part"
        return Failure(category=FailureCategory.NOT_UNDERSTOOD, message=message)
    best = asked.reader.readings[0]
    meant = describe(best.form)
    if "named_only" in best.features:
        return Failure(
            category=FailureCategory.NOT_UNDERSTOOD, message=f"nothing is asked that can be answered: '{meant}'"
        )
    return asked.not_grounded(f"'{meant}' is unknown in this model")
