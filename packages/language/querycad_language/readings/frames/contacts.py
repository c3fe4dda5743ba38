"""Which bodies touch, carry or hold which: what stands beside each other in an assembly."""

from __future__ import annotations

from collections.abc import Iterator

from querycad_contracts import Measure, PartQuery
from querycad_language.forms import Get, Touching
from querycad_language.phrases import placed_in, replace_fields
from querycad_language.readings.parses import Parse
from querycad_language.readings.question import Question

VERBS = ("contact", "carry", "fasten")
BODIES = PartQuery(noun="body", words=("body",), plural=True)


def contacts(question: Question) -> Iterator[Parse]:
    """'Which discs does the spindle touch?', 'What do the bolts hold together?': what fasteners hold is no fastener."""
    text = question.text
    asks = next((i for i in range(*question.asking) if text.is_word(i, "which", "what")), None)
    if asks is None or any(text.find(i, "noun", "measure", "count") for i in range(question.asking[0], asks)):
        return  # 'the number of nuts which hold the wheel'
    named = [mention for mention in question.parts if mention.start > asks][:2]
    asked = named[0] if len(named) > 1 and named[0].start == asks + 1 else None
    other = next((mention for mention in named if mention is not asked), None)
    begin = asked.end if asked is not None else asks + 1
    helped = text.find(begin, "do", "be") is not None
    if other is None:
        return
    after = other.end if helped and other.start == begin + 1 else begin + helped
    if asked is not None and text.find(begin, "have", "carry") and other.start == begin + 1:  # 'which body has it'
        noun, used = text.lexicon.nouns.get(asked.part.noun), {asks, begin, *asked.used, *other.used}
        if noun is not None and noun.senses[0].kind in (("body",), ("model",)):
            body = asked.part if noun.senses[0].kind == ("body",) else PartQuery(noun="body", words=("body",))
            yield Parse(Get((Measure.NAME,), placed_in(body, "with", other.part)), {"asked_noun": 1.0}, used)
    verb = next((span for at in range(after, after + 2) if (span := text.find(at, *VERBS))), None)
    if verb is None or (other.start > verb.start and other.start > verb.end + 1):
        return
    held = verb.category == "fasten" and (helped or other.start < verb.start)  # 'what holds the disc' asks for bolts
    target = asked.part if asked is not None and asked.part.noun != "part" else BODIES
    if verb.category == "fasten" and not held and target is BODIES:
        target = PartQuery(noun="screw", words=("screw",), plural=True)
    denied = {at for at in range(begin, verb.start) if text.find(at, "negation")}
    used = {asks, *verb.tokens, *denied, *other.used, *(asked.used if asked is not None else ())}
    several = replace_fields(target, plural=True)  # 'which disc' may be two
    yield Parse(Touching(several, other.part, held, bool(denied)), used=used)
