"""Words that a reading passes over: which are they, and of what class?"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import NamedTuple

from querycad_language.forms import AtBothEnds, Check, Either, Every, Exists, Facing, Parallel, Uniform, Which
from querycad_language.text import Text
from querycad_language.tokens import Kind

from .parses import Parse, Reading
from .question import Question

_CLASSES: tuple[tuple[str, set[str]], ...] = (
    ("courtesy", {"courtesy"}), ("side", {"side", "view"}), ("axis", {"axis"}), ("negation", {"negation", "except"}),
    ("noun", {"noun"}), ("function", {"whole", "pronoun", "ask"}),
    ("measure", {"measure", "distance", "gap", "engagement"}),
    ("comparison", {"scale", "same", "most", "least", "different", "operation", "comparing", "emerging", "arithmetic"}),
    ("function", {"function", "be", "side_preposition"}),
    ("chatter", {"chatter", "imperative", "have", "relation", "place", "quantifier", "each", "radially"}),
    ("adjective", {"adjective"}), ("function", {"side_noun", "article", "axis_preposition", "total"}),
)  # fmt: skip
"""The class of a word by the categories that the lexicon has it in; the first that fits."""
CLOSED = AtBothEnds | Check | Either | Every | Exists | Facing | Parallel | Uniform | Which
"""Forms whose answer is yes or no, or the one of two."""


class Passable(NamedTuple):
    """A word that counts where a reading passes over it."""

    at: int
    kind: str
    raw: str
    feature: str  # of its class


def passable(question: Question) -> list[Passable]:
    """Which words count where a reading passes over them? Those of other sentences than the asking one apart."""
    text = question.text
    found: list[Passable] = []
    depth = 0
    aside = question.phrases.included | question.unit_words
    aside |= {i for span in text.all("aside") for i in range(span.start - 3, span.end + 3)}
    for at in text.at_phrases("axis_preposition") - text.at_words("in", "by"):  # 'along its axis' says how it is taken
        end = next((i for i in range(at + 1, at + 5) if text.is_word(i, "axis", "centerline")), at - 1)
        aside |= {*range(at, end + 1)}
    for at, token in enumerate(text.tokens):
        depth += text.is_word(at, "(") - text.is_word(at, ")")
        if token.kind is Kind.SYMBOL or at in aside:
            continue
        kind = _class(text, at)
        if kind not in ("function", "courtesy"):
            where = "skip" if question.in_question(at) and depth <= 0 else "aside"
            found.append(Passable(at, kind, token.raw, f"{where}_{kind}"))
    return found


def finished(question: Question, parse: Parse, words: Sequence[Passable]) -> Reading:
    """The reading with what it skips, by class. `words` are the passable ones."""
    features = {**parse.features, **question.hardness}
    skipped = [word for word in words if word.at not in parse.used]
    for feature, count in Counter([word.feature for word in skipped]).items():
        features[feature] = features.get(feature, 0.0) + count
    if (question.closed or question.chooses) and not isinstance(parse.form, CLOSED):
        features["value_for_yes_no"] = 1.0
    return Reading(parse.form, features, tuple([(word.kind, word.raw) for word in skipped]), frozenset(parse.used))


def _class(text: Text, at: int) -> str:
    """Which class has a word that is passed over?"""
    if (kind := text.tokens[at].kind) is not Kind.WORD:
        return "function" if kind is Kind.POSSESSIVE else "number"
    own = {span.category for span in text.spans[at]}
    longer = {span.category for spans in text.spans[max(0, at - 3) : at] for span in spans if span.end > at}
    own |= longer - {"noun", "measure", "adjective", "arithmetic"}  # inside a longer phrase that begins before
    unclassed = "chatter" if own else "unknown"
    if not text.is_word(at, "except", "excluding"):
        own.discard("except")
    name = next((name for name, categories in _CLASSES if own & categories), unclassed)
    share = text.is_word(at, "per") or (text.is_word(at, "each", "every") and text.find(at - 1, "side_preposition"))
    share = share or (text.is_word(at, "side") and text.is_word(at - 1, "each", "every"))
    if share or (text.is_word(at, "far") and text.is_word(at - 1, "how")):  # 'on each side', 'how far'
        return "comparison"
    if name == "side" and "chatter" in own and text.is_word(at, "back", "right"):
        return "function"
    adjectives = [span.value for span in text.spans[at] if span.category == "adjective"]
    if name == "adjective" and not any(one.tags or one.order for one in adjectives):
        return "chatter"
    return name
