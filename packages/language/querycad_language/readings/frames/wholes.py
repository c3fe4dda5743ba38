"""The whole model against the box around it: how much of it is material, what is cut off, its longest axis."""

from __future__ import annotations

from collections.abc import Iterator

from querycad_contracts import Measure
from querycad_language.forms import Get
from querycad_language.phrases import replace_fields
from querycad_language.readings.parses import Parse
from querycad_language.readings.question import Question

_LONG = (Measure.LENGTH, Measure.MAGNITUDE, Measure.SIZE)
_CORNERS = (Measure.DIAGONAL, Measure.ACROSS_CORNERS)
_SAYS_BOX = ("box", "block", "volume", "much", "size", "part")


def wholes(question: Question) -> Iterator[Parse]:
    """'Which share of the box around it does it take up?', 'Which direction is the model largest in, x, y or z?'"""
    yield from _against_box(question)
    text = question.text
    named = {i for m in question.mentions if m.query is None for i in m.used}
    scales = [span for span in text.all("scale") if span.value.degree == "most" and span.value.measure in _LONG]
    longest = text.at_words("furthest").union(*(span.tokens for span in scales))
    axes = text.at_phrases("axis") | text.at_words("axis", "direction")
    asks = any(text.is_word(i, "which", "what", "name", "or") for i in range(*question.asking))
    used = longest | axes | named | text.at_phrases("measure", "ask", "axis_preposition", "passing")
    if longest and axes and asks and not question.parts:
        yield Parse(Get((Measure.LONG_AXIS,), None), {"along_axis": 1.0, "asked_noun": 1.0}, used)
    led = text.at_words("along", "parallel", "run", "lie", "coordinate")
    either = text.has("or") and len({span.value for span in text.all("axis")}) > 1
    which = any(text.is_word(i + 1 + text.is_word(i + 1, "coordinate"), "axis") for i in text.at_phrases("ask"))
    for mention in question.parts[:2] if led and (which or either) else ():
        bare = tuple(name for name in mention.part.adjectives if "parallel" not in name)  # 'does it run along x or y?'
        form = Get((Measure.LONG_AXIS,), replace_fields(mention.part, adjectives=bare))
        said = used | led | mention.used | text.at_words("or")
        yield Parse(form, {"along_axis": 1.0, "asked_noun": 1.0}, said)


def _against_box(question: Question) -> Iterator[Parse]:
    """'What volume goes into chips, from a block of that size?', 'corner to corner of its box'."""
    text = question.text
    boxes = text.covered("boxes")
    shares = {i for span in text.all("operation") if span.value == "share" for i in span.tokens}
    for measure, said in (
        (Measure.FILL, shares | text.covered("filling")),
        (Measure.REMOVED, text.covered("cutting")),
        (Measure.DIAGONAL, {i for span in text.all("measure") if span.value in _CORNERS for i in span.tokens}),
    ):
        if boxes and said and not question.closed:
            named = {i for m in question.mentions if m.query is None for i in m.used}
            around = boxes | named | text.covered("stuff") | text.at_words(*_SAYS_BOX)
            around |= text.at_words("opposite", "long") if measure is Measure.DIAGONAL else set()
            yield Parse(Get((measure,), None), {"asked_noun": 1.0}, said | around)
