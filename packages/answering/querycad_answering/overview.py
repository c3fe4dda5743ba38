"""Questions about the model as such: 'what is this part', 'list all features', 'what can I ask'."""

from __future__ import annotations

import re

from querycad_language.text import Text
from querycad_language.tokens import Kind

from .addressing import Addressed

_AROUND = (
    "ask", "article", "be", "chatter", "courtesy", "do", "each", "function", "have", "imperative", "modal", "pronoun",
    "quantifier", "side_preposition", "whole_adjective",
)  # fmt: skip
"""Classes of words that name no part and no measure."""
_YES_OR_NO = ("be", "do", "have")


def asks_for_overview(question: str) -> bool:
    """Is the question about the model as such, and about no part or measure of it?

    'What is this part?' 'Describe the model.' It is where no word of it says anything else.
    """
    text = Text(question)
    if len(text.sentences) > 1:  # 'This file came without a word. What sort of part is it?'
        start = text.sentences[-1][0]
        last = Text(" ".join(token.raw for token in text.tokens[start:]))
        text = last if last.at_phrases("overview") and last.at_phrases("whole", "pronoun") else text
    if any(token.kind not in (Kind.WORD, Kind.SYMBOL) for token in text.tokens):
        return False
    words = [at for at, token in enumerate(text.tokens) if token.kind is Kind.WORD]
    if not words or text.find(words[0], *_YES_OR_NO) or text.at_phrases("count"):
        return False
    topics = text.at_phrases("overview")
    if not all(at in topics or text.find(at, "whole", *_AROUND) for at in words):
        return False
    told = text.find(words[-1], "whole", "pronoun") or text.is_word(words[-1], "is")  # '… what this part is'
    if not told or "do" in text.words:  # 'what do you think of it?'
        return bool(topics)
    return bool(topics) or text.is_word(words[0], "what", "tell", "show")


def asks_what_parts_are(addressed: Addressed) -> bool:
    """Is asked what the parts are that the question names: 'what is hole 4', 'describe face 36'?"""
    if not addressed.names:
        return False
    names = "|".join(map(str, addressed.names))
    text = Text(re.sub(rf"\b(?:ring )?[a-z]+ (?:{names})\b", " ", addressed.texts[0]))
    words = [at for at, token in enumerate(text.tokens) if token.kind is Kind.WORD]
    asked = text.is_word(words[0], "what", "tell", "show") or bool(text.at_phrases("overview")) if words else False
    return asked and all(text.find(at, "overview", *_AROUND) and not text.find(at, "where", "verbs") for at in words)
