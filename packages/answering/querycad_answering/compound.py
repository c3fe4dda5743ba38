"""Several questions in one: 'How many fins are there, and how thick are they?', 'Boss: height, bore and wall?'

Each is asked alone, the later ones after the first, where no reading of the whole answers all.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Sequence, Set
from dataclasses import dataclass, field
from itertools import groupby

from querycad_contracts import Answer, AnswerRecord, AnswerType, Measure, PartKind, Program, Status, Unit
from querycad_language.forms import Count, Distance, Several
from querycad_language.lexicon import lexicon
from querycad_language.measures import SCALARS, of_several
from querycad_language.phrases import Mention
from querycad_language.readings.frames.distances import REACHES
from querycad_language.readings.question import Question
from querycad_language.readings.requested_measures import asked_in
from querycad_language.tokens import Kind

from .candidates import Candidate
from .value_order import stands_first

Judged = Callable[[Program], Answer | None]
"""Runs a program and types what it gives."""

_JOINTS = (",", "and", "&", "+", "/", "x", ";", ":", "?", "!", ".", "-", "plus", "then", "vs", "versus")
_JOINING = ("as well as", "along with", "together with")
_TOPIC_ENDS = (":", "-", ".", "?", ",", ";")
_IF_SO = re.compile(r"^if so,? ", re.IGNORECASE)
_EACH = re.compile(r"\beach$", re.IGNORECASE)
_THIS = re.compile(r"\bthis\b(?= \w)", re.IGNORECASE)
"""'The length of this bracket' is that of the model, not of what a clause before asked about."""
_AXES = re.compile(
    r"(?:along|in) (?:the )?([xyz])(?:[ -](?:axis|direction))?,? (?:and|&)"
    r" (?:along |in )?(?:the )?([xyz])\b(?:[ -](?:axis|direction)s?)?",
    re.IGNORECASE,
)
_LEANING = ("its", "their", "each")
_VERBS = ("ask", "where", "be", "do", "exists")
_EXPLAINING = (
    "as", "namely", "meaning", "measured", "counting", "to", "from", "over", "across", "along", "not", "past"
)  # fmt: skip
"""Words that a stretch begins with which says more of what was asked before it."""
_WISHES = ("need", "want", "wish", "would", "must", "should", "like", "also")
_SUMMED = ("together", "altogether", "combined")
_OFF = ("from", "above", "below", "off", "over", "past", "beyond", "out")
"""Words behind a measure or 'projection' that say from where it is taken, which no measure beside it is."""
_WHERE = ("of", "on", "in", "at", "between")
_OF_TWO = ("same", "different", "operation", "comparing", "minus")
"""What makes one value of two measures: 'the ratio of the width of … and the height of …'."""
_POINTS = (Measure.POSITION, Measure.OPENING, Measure.TIP)
_SIZES = (Measure.SIZE, Measure.MAGNITUDE)
_SIDES = (Measure.LENGTH, Measure.WIDTH, Measure.HEIGHT, Measure.THICKNESS)
MAX_CHARS = 300
"""Longer texts are not looked at for a second question."""
MAX_CLAUSES = 5
"""So many questions in one are answered; who lists more asks for a table."""
_PARTED = -1
"""The token of what is asked again, that no reading of the whole uses."""
_ALIKE = "(answer{0}[:1] if len(different(answer{0}, 1e-05)) == 1 else answer{0})"
"""Values of a list, those of like parts once."""
_ONE_MEASURE = re.compile(r"^solution = \[.+ for p in \w+\]$", re.MULTILINE)
"""What a program ends with that lists one measure of several parts; 'width and depth' may be alike, and stay two."""
_NUMERIC = {*SCALARS, *map(of_several, SCALARS)}


@dataclass(slots=True)
class _Clause:
    """A stretch of the question. `asks`: the tokens of each measure, number or distance that is asked for in it."""

    start: int
    end: int
    asks: list[set[int]] = field(default_factory=list)
    mentions: list[Mention] = field(default_factory=list)
    lead: str = ""
    """What it is asked of, or for, that stands elsewhere."""
    tail: str = ""
    """What it is of, that is said behind a later one: 'the head and the shank of the screw'."""


def clauses(asked: Question, best: Candidate | None) -> tuple[str, ...]:
    """The single questions, where the best reading of all as one passes over what one of them asks; else none.

    The later ones may lean on the first: 'How many ribs are there?', 'and how thick are they?'
    """
    text = asked.text
    if len(text.question) > MAX_CHARS:
        return ()
    axes = _AXES.search(text.question)  # 'the spacing along x and along y?'
    if (
        axes is not None
        and best is not None
        and any(word.lower() == axes[2].lower() for _, word in best.reading.skipped)
    ):
        return tuple(
            f"{text.question[: axes.start()]}along {axis}{text.question[axes.end() :]}" for axis in axes.groups()
        )
    topic, found = _listed(asked)
    used = best.reading.used if best is not None else frozenset[int]()
    named = [[{m.head} for m in one.mentions if not m.pronoun] for one in found]
    passed = any(all(map(used.isdisjoint, group)) for group in (*(one.asks for one in found), *filter(None, named)))
    numbers = {at for one in found for each in one.asks for at in each if text.find(at, "count")}
    spaces = [one for one in found if any(text.find(min(each), "distance", "gap") for each in one.asks)]
    form = best.reading.form if best is not None else None
    passed = passed or bool(numbers and form and not _counts(form)) or (isinstance(form, Distance) and len(spaces) > 1)
    if isinstance(form, Several):
        found = _merged(found, used - numbers)
    if not 1 < len(found) <= MAX_CLAUSES or not passed:
        return ()
    return tuple(_worded(asked, topic, found, index) for index in range(len(found)))


def _merged(found: Sequence[_Clause], used: Set[int]) -> list[_Clause]:
    """The clauses, those that are answered together as one: 'spacing along the block, spacing across it'."""
    kept: list[_Clause] = []
    for one in found:
        last = kept[-1] if kept else None
        if last is not None and not any(map(used.isdisjoint, (*last.asks, *one.asks))):
            last.end = one.end
            last.asks += one.asks
            last.mentions += one.mentions
        else:
            kept.append(one)
    return kept


def _counts(form: object) -> bool:
    """Does a number of parts, or of what they have, come out?"""
    own = (form, getattr(form, "left", None), getattr(form, "right", None))
    return any(isinstance(one, Count) or Measure.COUNT in getattr(one, "measures", ()) for one in own)


def _listed(asked: Question) -> tuple[str, list[_Clause]]:
    """What the question begins with, 'Boss:', and its stretches between commas and the like that ask for something."""
    text = asked.text
    topic, start, found = "", 0, list[_Clause]()
    asks = _asks(asked)
    if asked.chooses:
        return topic, []
    apart = asked.closed or text.at_phrases(*_OF_TWO) or any(text.is_word(s.end, "of") for s in text.all("total"))
    for begin, end, after in _stretches(asked, asks):
        one = _Clause(
            begin,
            end,
            [each for each in asks if begin <= min(each) < end],
            [m for m in asked.mentions if begin <= m.start < end and not text.is_word(m.head, "inside", "outside")],
        )
        verb = _verb(asked, one)
        one.asks = one.asks or verb
        if found and any(text.is_word(i, "order") or stands_first(text, i) for i in range(begin, end)):
            continue  # 'longer side first'
        if (apart and found and not verb) or _only_says_how(asked, one, found):
            one.asks = []
        elif not one.asks and not apart and after not in _TOPIC_ENDS[:2]:
            _borrow(asked, one, found[-1] if found else None)
        if one.asks:
            one.start = one.start if found else start
            found.append(one)
        elif found:
            found[-1].end = end
        elif one.mentions and after in _TOPIC_ENDS:
            topic, start = _text(asked, start, end), end + 1
    return topic, found


def _only_says_how(asked: Question, one: _Clause, found: Sequence[_Clause]) -> bool:
    """Does a stretch ask for nothing: a statement, the width and height that a size consists of?"""
    text = asked.text
    second = range(one.start + 1, one.start + 2)
    explains = text.is_word(one.start, *_EXPLAINING) or " ".join(text.words[one.start : second.stop]) == "that is"
    tells = text.is_word(one.start, "i", "we") and not any(text.is_word(i, *_WISHES) for i in second)
    sums = text.is_word(one.start, "all", "both") and text.is_word(one.end - 1, *_SUMMED)  # 'all sizes together'
    within = text.words[: one.start].count("(") > text.words[: one.start].count(")")
    _, end = text.sentences[asked.sentence_of(one.start)]
    asks = text.is_word(end, "?", ";") or (end == len(text) and text.any_in(range(one.start, one.end), "ask"))
    asks = asks or (text.is_word(end, "-") and text.is_word(end + 1, *_WHERE))
    if explains or tells or sums or within or not (asked.in_question(one.start) or asks):
        return True
    sizes = [span for span in text.all("measure", "scale") if found and found[-1].start <= span.start < one.end]
    said = [(span.start < one.start, getattr(span.value, "measure", span.value)) for span in sizes]
    wide = any(before and measure in _SIZES for before, measure in said)
    sides = [measure for before, measure in said if not before]
    return wide and not one.mentions and set(sides) <= {*_SIDES, Measure.DEPTH} and not {*_SIDES}.isdisjoint(sides)


def _before_articles(asked: Question, at: int) -> int:
    """The token before those articles that stand before this one."""
    at -= 1
    while asked.text.find(at, "article"):
        at -= 1
    return at


def _stretches(asked: Question, asks: Sequence[set[int]]) -> Iterator[tuple[int, int, str]]:
    """The stretches between joints, and the joint behind each. What one phrase says is not parted."""
    text = asked.text
    axes = {i for i in text.at_words("x") if text.find(i - 1, "axis_preposition", "side_preposition")}  # 'along x'
    joints = {i for i in text.at_words(*_JOINTS) if text.tokens[i].kind is not Kind.TIMES} - axes
    joints -= {i for i in text.at_words("-") if text.is_word(i + 1, *_WHERE)}  # 'wall thickness - at the rim …'
    for phrase in _JOINING:
        size = len(phrase.split())
        begins = (i for i in range(len(text)) if " ".join(text.words[i : i + size]) == phrase)
        joints.update(i + k for i in begins for k in range(size))
    asking, parting = {min(one) for one in asks}, set[int]()
    for at in text.at_words("between"):  # 'between the lugs and their thickness' is between the lugs
        joining = next((i for i in sorted(text.at_words("and", "&")) if i > at), len(text))
        parting |= {joining} if asking & {*range(joining + 1, joining + 4)} else set()
        joints -= {joining} - parting
    before = {span.start for span in text.all("measure") if text.tokens[span.end - 1].plural}
    parting |= {i for i in text.at_words("and", "&") if text.is_word(i + 1, *_WHERE) and before & {*range(i)}}
    for within in (*(range(m.start, m.end) for m in asked.mentions), *(range(min(one), max(one)) for one in asks)):
        words = [i for i in within if i not in joints]
        joints.difference_update({*range(words[0], words[-1])} - parting if words else ())
    start = 0
    for joint, run in groupby(range(len(text)), joints.__contains__):
        places = list(run)
        if not joint:
            start = places[0]
            behind = places[-1] + 1
            yield start, behind, text.words[behind] if behind < len(text) else "?"


def _asks(asked: Question) -> list[set[int]]:
    """The tokens of every measure, number and distance that is asked for."""
    text = asked.text
    named = {i for m in asked.mentions for i in m.used if not m.pronoun}
    before_noun = {m.start for m in asked.mentions}  # 'center hole'
    apart = text.at_phrases("distance")
    found: list[set[int]] = []
    for one in asked_in(asked):
        point = one.measures[0] in _POINTS and (one.end in before_noun or text.is_word(one.end, "to"))
        point = point or (one.how == "where" and not text.find(one.start + 1, "be", "do"))  # 'where the rail sits'
        point = point or one.start in asked.phrases.included
        cut = next((i for i in range(one.start + 1, one.end) if i in apart), one.end)  # 'width and spacing'
        last = max((i for i in range(one.start + 2, one.end) if text.find(i, "measure")), default=cut)
        if cut == one.end and one.end <= last + 2 and text.is_word(one.end, *_OFF):
            cut = last  # 'width, and height above the seat'
        if not (point or _is_place(asked, one.start)):
            found += [set(each) for each in (range(one.start, cut - (cut < one.end)), range(cut, one.end)) if each]
    ahead = [at for at in text.at_words(*REACHES) if text.is_word(at + 1, *_OFF)]
    amounts = [at for at in text.at_words("how") if text.is_word(at + 1, "much")]
    ahead += amounts if len(amounts) > 1 else ()  # 'how much … under the slot, how much under the pad'
    ahead += [at for at in text.at_words("how") if text.is_word(at + 1, "far", "close")]
    found += [{at} for at in ahead if not any(at in each for each in found)]
    for span in text.all("count", "distance", "gap", "center_to_center"):
        if span.category == "count" and text.find(span.start - 1, "number"):
            continue  # 'just one number'
        known = found if span.category in ("count", "gap") else [named, *found]
        adds = span.category == "center_to_center" and text.sentences[asked.sentence_of(span.start)][0] != span.start
        if not (adds or any(each & set(span.tokens) for each in known) or _is_place(asked, span.start)):
            found.append({span.start} if span.category == "count" else set(span.tokens))
    return found


def _is_place(asked: Question, at: int) -> bool:
    """Does a measure say where, or along what: 'along the long side', 'from the hub's axis'?"""
    text = asked.text
    if text.find(at - 1, "axis"):
        return True  # 'in x and y direction'
    owned = at - text.is_possessive(at - 1)
    owner = next((m.start for m in asked.mentions if m.end == owned), at - 2 if owned < at else at)
    lead = _before_articles(asked, owner)
    told = text.find(lead, "place", "axis_preposition", "side_preposition")
    return told is not None and not text.is_word(lead, "of", "for", "with", "through")


def _verb(asked: Question, one: _Clause) -> list[set[int]]:
    """What a clause asks that begins with its verb or its question word: '… and is it through?'"""
    text = asked.text
    begin = next((i for i in range(one.start, one.end) if not text.is_word(i, "also", "if", "so", ",")), one.end)
    lead = text.find(begin, *_VERBS) or (text.find(begin, "place") and text.find(begin + 1, *_VERBS))
    lead = lead if not text.is_word(begin, "where") or text.find(begin + 1, "be", "do") else None
    if not lead or not (one.mentions or any(text.is_word(i, *_LEANING) for i in range(one.start, one.end))):
        return []
    pronouns = {i for m in one.mentions if m.pronoun for i in m.used}
    return [pronouns or {one.mentions[0].head}] if one.mentions else []


def _borrow(asked: Question, one: _Clause, before: _Clause | None) -> None:
    """'Bore, outer diameter': the diameter of it. 'Radius on the long leg, on the short leg?': the radius there."""
    text = asked.text
    begin = text.skip(one.start, "article")
    mention = one.mentions[0] if one.mentions else None
    joined = text.is_word(one.start - 1, "and", "&", "plus")
    if mention is None and joined and before is not None and text.is_word(one.start, *_WHERE):
        _place_apart(asked, one, before)
    if mention is None or mention.query is None:
        return
    noun = lexicon().nouns.get(mention.query.noun)
    last = text.find(mention.end - 1, "measure")
    if last is not None and last.value not in _POINTS and not _is_place(asked, mention.start):
        one.asks = [{mention.head}]  # 'lug end radius'
    elif mention.end == one.end and mention.start <= begin and noun and noun.senses[0].kind[0] == PartKind.HOLE:
        if not mention.query.plural and not mention.query.places and not mention.query.adjectives:
            one.asks, one.lead = [{mention.head}], "diameter of"
    behind = range(begin + 1, text.skip(begin + 1, "article") + 1)
    if before is None or not before.mentions:
        return  # 'the angle, seen from above, between the lugs'
    if text.is_word(begin + 1, "both", "all"):
        return  # 'in total, on both faces'
    if joined and mention.start == one.start:
        _share(asked, one, before)
    again = not text.is_word(begin, "between") or text.is_word(before.start, "between") or "between" in before.lead
    if text.is_word(begin, *_WHERE) and again and mention.part.known and mention.start in behind:
        one.asks, one.lead = (
            [{mention.head}],
            (before.lead or _text(asked, min(before.asks[-1]), max(before.asks[-1]) + 1)),
        )


def _place_apart(asked: Question, one: _Clause, before: _Clause) -> None:
    """'Diameters of the boss on the left and of the rib on the right': asked of both, though one phrase reads so."""
    text, end = asked.text, max(i for each in before.asks for i in each) + 1
    lead = next((i for i in range(end, before.end) if text.is_word(i, *_WHERE)), None)
    if text.any_in(range(one.start, one.end), "noun") and (lead or before.lead):
        one.asks, one.lead = [{_PARTED}], before.lead or _text(asked, before.start, lead or end)


def _share(asked: Question, one: _Clause, before: _Clause) -> None:
    """'How thick are the web and the rim', 'diameters of the head and the shank of the screw': asked of both."""
    text, last, own = asked.text, before.mentions[-1], one.mentions[0]
    asks = {i for each in before.asks for i in each}
    apart = any(text.find(i, "distance", "gap", "count", "where") or text.is_word(i, "angle", "axis") for i in asks)
    bare = last.query is not None and not last.query.places and own.part.known  # no 'slot of the web and the rim'
    alone = len(before.mentions) == 1  # no 'how thick is the plate that the lug and the rib stand on'
    if apart or not (bare and alone) or last.end != one.start - 1 or max(asks) >= last.start:
        return
    one.asks, one.lead = [{own.head}], _text(asked, before.start, last.start)
    of = next((i for i in range(own.start, own.end) if text.is_word(i, "of")), own.end)
    begin = of if text.find(last.head, "noun") else own.head  # 'the left and the right leg'
    before.tail = _text(asked, begin, own.end + text.is_word(own.end, "have", "has"))


def _worded(asked: Question, topic: str, found: Sequence[_Clause], index: int) -> str:
    """One of the clauses as a question: with what it is asked of where that stands before all, or only behind."""
    text, one = asked.text, found[index]
    said = _IF_SO.sub("", " ".join(filter(None, (one.lead, _text(asked, one.start, one.end), one.tail))))
    said = _THIS.sub("the", _EACH.sub("each of them", said)) if index else said
    leans = any(text.is_word(i, *_LEANING) for i in range(one.start, one.end))
    if topic:
        return f"{topic}: {said}?"
    if one.mentions or leans or (index and any(text.find(i, "over_all") for i in range(one.start, one.end))):
        return f"{said}?"
    if any(each.mentions for each in found[:index]):
        return f"and {said}?"
    for mention in (m for later in found[index + 1 :] for m in later.mentions):
        lead = _before_articles(asked, mention.start)
        if text.is_word(lead, "of", "for", "on", "in", "at"):
            return f"{said} {_text(asked, lead, mention.end)}?"
    return f"{said}?"


def _text(asked: Question, start: int, end: int) -> str:
    """What is said from one token to another, as it was typed."""
    said = [raw for raw, _ in groupby(token.raw for token in asked.text.tokens[start:end])]  # 'PCD' is three tokens
    return re.sub(r" (?=['’])", "", " ".join(said))


def together(records: Sequence[AnswerRecord], judged: Judged) -> AnswerRecord | None:
    """One answer of several, as sure as the least sure of them; None where one has no answer.

    Numbers are one list, all else is told in words. The number of the same parts twice is one: 'how many screws, that
    is, how many bolt holes'.
    """
    answers = [answer for one in records if (answer := _plain(one, judged)) is not None]
    counted = all(one.type is AnswerType.COUNT for one in answers) and len(answers) == len(records)
    parts = {tuple(sorted(part.id for part in one.parts)) for one in records}
    if counted and len(parts) == 1 and len({str(one.value) for one in answers}) == 1:
        return min(records, key=lambda one: one.confidence or 0.0)
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
    alike = [_ALIKE if _ONE_MEASURE.search(code) else "answer{0}" for code in codes]
    values = [f"*{alike[index].format(index)}" if several else f"answer{index}" for index, several in enumerate(lists)]
    kept = [re.sub(r"^solution = ", f"answer{index} = ", code, flags=re.MULTILINE) for index, code in enumerate(codes)]
    return "\n".join([*kept, f"solution = [{', '.join(values)}]"])
