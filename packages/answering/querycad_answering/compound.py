"""Two questions in one: 'How many fins are there, and how thick are they?'

Each is asked alone, the second after the first, where no reading of the whole answers both.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence

from querycad_contracts import Answer, AnswerRecord, AnswerType, Program, Status, Unit
from querycad_language.measures import SCALARS, of_several
from querycad_language.readings.question import Question

from .candidates import Candidate

Judged = Callable[[Program], Answer | None]
"""Runs a program and types what it gives."""

_JOINT = re.compile(
    r"(?:[?;,] ?(?:and )?|,? and )(?:if so,? )?(?=(?:also )?"
    r"(?:how|what|where (?:is|are|do|does)|(?:at|on|in|by|to) (?:what|which)|is|are|does|do)\b)"
    r"|,? (?:and|vs\.?|versus) (?=(?:(?:the|its) )?(?:[\w-]+ ){1,3}of\b)",  # 'and the width of the slot'
    re.IGNORECASE,
)
_EACH = re.compile(r"\beach(?= ?[?.!]?$)", re.IGNORECASE)
_LEANING = ("its", "their", "each")
_VERBS = ("ask", "where", "be", "do", "exists")
_OF_TWO = ("between", "same", "different", "operation", "comparing", "total", "minus")
"""What makes one value of two measures: 'the ratio of the width of … and the height of …'."""
_ASKED = ("measure", "scale", "count", "distance", "gap", "where")
MAX_CHARS = 300
"""Longer texts are not looked at for a second question; so three or four are answered at most, one after the other."""
MAX_JOINTS = 4
"""So many places are looked at where one question may end."""
_LEADING = 4
"""Words of a clause within which it asks."""
_ALIKE = "(value{0}[:1] if len(different(value{0}, 1e-05)) == 1 else value{0})"
"""Values of a list, those of like parts once."""
_NUMERIC = {*SCALARS, *map(of_several, SCALARS)}


def clauses(question: str, best: Candidate | None) -> tuple[str, ...]:
    """The two questions, where the best reading of both as one passes over what one of them asks; else none."""
    joints = list(_JOINT.finditer(question)) if len(question) <= MAX_CHARS else []
    whole = Question(question) if joints else None
    if whole is None:
        return ()
    one_value = whole.closed or bool(whole.text.at_phrases(*_OF_TWO))
    for joint in joints[:MAX_JOINTS]:
        first, second = (Question(one) for one in (question[: joint.start()], question[joint.end() :]))
        starts = (0, len(whole.text) - len(second.text))
        asked = [_asked(one, start, not one_value) for one, start in zip((first, second), starts, strict=True)]
        used = best.reading.used if best is not None else frozenset[int]()
        if all(asked) and any(used.isdisjoint(each) for one in asked for each in one):
            rest = _EACH.sub(r"\g<0> of them", question[joint.end() :].strip())
            return question[: joint.start()].strip(" ,;") + "?", rest
    return ()


def _asked(clause: Question, start: int, names: bool) -> list[set[int]]:
    """Where the clause says what it asks, and of which part; nowhere, if it asks nothing or names nothing.

    `names`: to name a measure of a part is to ask for it.
    """
    text = clause.text
    named = clause.mentions or text.at_words(*_LEANING)
    first = text.find(text.skip(0, "article"), "measure", "count")
    begins = names and first is not None and "of" in text.words[first.end - 1 : first.end + 1]
    if not named or not (begins or any(text.find(i, *_VERBS) for i in range(min(len(text), _LEADING)))):
        return []
    how = text.at_words("how")
    pronouns = {i for mention in clause.mentions if mention.pronoun for i in mention.used}
    asked = how or pronouns or {i for i in range(len(text)) if text.find(i, *_ASKED)}
    owner = {clause.parts[0].head} if begins and clause.parts else set()
    return [{start + i for i in one} for one in (asked, owner) if one]


def together(records: Sequence[AnswerRecord], judged: Judged) -> AnswerRecord | None:
    """One answer of several, as sure as the least sure of them; None where one has no answer.

    Numbers are one list, all else is told in words.
    """
    answers = [answer for one in records if (answer := _plain(one, judged)) is not None]
    codes = [one.code for one in records if one.code]
    if len(answers) < len(records) or len(codes) < len(records):
        return None
    text = "; ".join(dict.fromkeys(one.text for one in answers))
    answer = Answer(value=[one.text for one in answers], type=AnswerType.TEXTS, unit=Unit.NONE, text=text)
    code = None
    if all(one.type in _NUMERIC for one in answers):
        kinds = {of_several(one.type) for one in answers}
        code = _joined(codes, [isinstance(one.value, list) for one in answers])
        kind = kinds.pop() if len(kinds) == 1 and AnswerType.COUNT not in kinds else AnswerType.NUMBERS
        found = judged(Program(code=code, codegen="parser", expects=kind))
        if found is None:
            return None
        answer = found.model_copy(update={"text": text})
    first, unsure = records[0], any(one.status is Status.UNSURE for one in records)
    return first.model_copy(
        update={
            "status": Status.UNSURE if unsure else Status.ANSWERED,
            "answer": answer.model_copy(update={"text": f"perhaps {text}"}) if unsure else answer,
            "code": code,
            "codegen": first.codegen if code else None,
            "parts": tuple({part.id: part for one in records for part in one.parts}.values()),
            "warnings": tuple(dict.fromkeys(said for one in records for said in one.warnings)),
            "confidence": min((one.confidence for one in records if one.confidence is not None), default=None),
            "understood_as": "; ".join(dict.fromkeys(one.understood_as for one in records)),
            "ignored": tuple(dict.fromkeys(word for one in records for word in one.ignored)),
            "alternatives": (),
            "timings_ms": _added(one.timings_ms for one in records),
        }
    )


def _added(timings: Iterable[dict[str, float]]) -> dict[str, float]:
    """How long each step took in all, in milliseconds."""
    found: dict[str, float] = {}
    for step, took in (item for one in timings for item in one.items()):
        found[step] = round(found.get(step, 0.0) + took, 3)
    return found


def _plain(record: AnswerRecord, judged: Judged) -> Answer | None:
    """The answer without what else it may be."""
    answer = record.answer
    if answer is None or record.status is not Status.UNSURE or record.code is None:
        return answer
    return judged(Program(code=record.code, codegen="parser", expects=answer.type))


def _joined(codes: Sequence[str], lists: Sequence[bool]) -> str:
    """The programs one after the other, and all their values."""
    values = [f"*{_ALIKE.format(index)}" if several else f"value{index}" for index, several in enumerate(lists)]
    kept = [re.sub(r"^solution = ", f"value{index} = ", code, flags=re.MULTILINE) for index, code in enumerate(codes)]
    return "\n".join([*kept, f"solution = [{', '.join(values)}]"])
