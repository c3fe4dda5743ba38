"""Which question does a parameter ask? Its own, else what its description or its name makes."""

from __future__ import annotations

import re

from querycad_contracts.parameters import ParameterRequest, ParameterType

PLACED = frozenset(
    (ParameterType.POINT, ParameterType.POSE, ParameterType.APPROACH, ParameterType.INSERTION, ParameterType.GRASPS)
)
"""What is asked by 'where'."""
PHRASE = 8
"""Words; what is longer and no question is a sentence."""
_COUNTING = re.compile(r"^(?:the )?(?:number|count|num|n) of (?:the )?|^(?:num|n) | (?:count|number)$", re.IGNORECASE)
_PLACES = "pose|place|position|location|frame|grasps?|(?:approach|insertion)(?: axis)?"
_PLACING = re.compile(rf"^(?:the )?(?:{_PLACES}) (?:of|at|for) | (?:{_PLACES})$", re.IGNORECASE)
_HAVING = re.compile(r"^(?:has|have|with) (?:a |an )?", re.IGNORECASE)
_CAMEL = re.compile(r"(?<=[a-z0-9])(?=[A-Z])")


def question_of(asked: ParameterRequest) -> str:
    """Its question as it stands; words for a part become one. Without any, what its description says, else its name."""
    if asked.question is not None:
        text = asked.question.strip()
        is_phrase = asked.type in PLACED and not text.endswith("?") and len(text.split()) <= PHRASE
        return _question(text, asked.type) if is_phrase else text
    named = _CAMEL.sub(" ", re.sub(r"[_.\-]+", " ", asked.name)).strip().lower()
    said = asked.description.strip().rstrip(".") or named
    return said if said.endswith("?") else _question(said, asked.type)


def _question(text: str, kind: ParameterType) -> str:
    bare = _bare(text, kind)
    if kind is ParameterType.COUNT:
        return f"How many {bare} are there?"
    if kind is ParameterType.BOOLEAN:
        return f"Is there a {_HAVING.sub('', bare)}?"
    if kind is ParameterType.PARTS:
        return f"Which are {_with_article(bare)}?"
    if kind in PLACED:
        return f"Where is {_with_article(bare)}?"
    return f"What is {_with_article(bare)}?"


def _bare(text: str, kind: ParameterType) -> str:
    """The phrase without the words that only say its type."""
    if kind is ParameterType.COUNT:
        return _COUNTING.sub("", text) or text
    return _PLACING.sub("", text) or text if kind in PLACED else text


def _with_article(text: str) -> str:
    return text if re.match(r"(?:the|a|an|its|this|each|all)\b", text, re.IGNORECASE) else f"the {text}"
