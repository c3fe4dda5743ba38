"""What only the whole model has: how full its bounding box is, what is cut away of it."""

from __future__ import annotations

from collections.abc import Iterator

from querycad_contracts import Measure
from querycad_language.forms import Get
from querycad_language.readings.drafts import Draft
from querycad_language.readings.question import Question

_FILLING = ("fill", "fills", "filled", "full", "occupy", "occupies", "occupied", "material", "solid")


def wholes(question: Question) -> Iterator[Draft]:
    """'How much of its bounding box is material, in percent?'"""
    text = question.text
    boxes = text.at_phrases("boxes") | {i for i in text.at_words("bounding") if text.is_word(i + 1, "box")}
    boxes |= text.at_words("block", "blank", "stock", "bbox", "billet")
    named = {i for m in question.mentions if m.query is None for i in m.used}
    if boxes:
        shares = {i for span in text.all("operation") if span.value == "share" for i in span.tokens}
        filling, cutting = text.at_words(*_FILLING), text.at_phrases("cutting")
        around = boxes | named | text.at_phrases("stuff") | text.at_words("much", "volume")
        around |= {i + 1 for i in boxes if text.is_word(i, "bounding")}
        if shares or filling:
            yield Draft(Get((Measure.FILL,), None), {"whole_box": 1.0, "asked_noun": 1.0}, around | shares | filling)
        if cutting:
            yield Draft(Get((Measure.REMOVED,), None), {"whole_box": 1.0, "asked_noun": 1.0}, around | cutting)
