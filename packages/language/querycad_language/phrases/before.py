"""The noun of a phrase and what stands before it: 'the two largest blind M5 holes'."""

from __future__ import annotations

from querycad_contracts import Rank, SizeFilter
from querycad_language.lexicon import Span
from querycad_language.text import Text
from querycad_language.tokens import Kind

from .mention import GENERIC, Draft
from .sizes import size_before
from .words import ends_do_question, is_noun, is_verb, noun_follows, superlative


def before_noun(text: Text, at: int, draft: Draft) -> int:
    """Where the next piece of the phrase ends; `at` where nothing here belongs to it."""
    token = text.tokens[at]
    empty = not (draft.nouns or draft.unknown)
    match token.kind:
        case Kind.TIMES:
            draft.count = int(token.value)
            return at + 1
        case Kind.THREAD:
            draft.threads.append(token.word)
            return at + 1
        case Kind.QUANTITY:
            return size_before(text, at, draft) if empty else at
        case Kind.NUMBER:
            return _number(text, at, draft)
        case Kind.WORD:
            end = _determiner(text, at, draft) if empty else at
            return end if end > at else _word(text, at, draft)
    return at


def _determiner(text: Text, at: int, draft: Draft) -> int:
    if text.is_word(at, "one", "any") and text.is_word(at + 1, "of"):
        draft.sample = True
        return at + 2
    if span := text.find(at, "each"):
        draft.each = True
        draft.count = 2 if text.is_word(at, "both") else draft.count
        return span.end
    if span := text.find(at, "quantifier"):
        return span.end
    if (span := text.find(at, "article")) and not (text.find(at, "pronoun") and not noun_follows(text, span.end)):
        draft.definite = draft.definite or text.words[at] not in ("a", "an", "such")
        draft.article = True
        if text.is_word(at, "this", "my", "our"):  # later it points to what was said
            draft.deictic = not any(map(text.is_break, range(at)))
        return span.end
    span = text.find(at, "number")
    if span is not None and noun_follows(text, span.end):
        draft.count = {"single": 1, "one": None}.get(text.words[at], span.value)
        return span.end
    return at


def _number(text: Text, at: int, draft: Draft) -> int:
    """'4 holes' says how many; 'hole 4' names one."""
    token = text.tokens[at]
    whole = token.value == int(token.value)
    noun = text.find(at + 1, "noun")
    one = draft.definite and noun and not text.tokens[noun.end - 1].plural and not text.find(noun.end, "noun")
    if not draft.nouns and ((not whole and text.find(at + 1, "noun", "adjective")) or (one and token.value > 1)):
        draft.sizes.append(SizeFilter(low=token.value * 1e-3))  # 'the 13.5 holes', 'the 25 lug'
    elif whole and draft.nouns and not draft.unknown and draft.nouns[-1].end == at and token.value < 10_000:
        draft.ids.append(f"{draft.nouns[-1].value.name}-{int(token.value)}")
    elif whole and not draft.nouns and noun_follows(text, at + 1):
        draft.count = int(token.value)
    else:
        return at
    return at + 1


def _word(text: Text, at: int, draft: Draft) -> int:
    """An adjective, a rank, a side, a colour, a noun, or a word that is not known."""
    noun, adjective, measure = text.find(at, "noun"), text.find(at, "adjective"), text.find(at, "measure")
    if noun and text.find(at, "reach", "passing") and not (draft.article and text.find(at - 1, "article", "adjective")):
        noun = None  # 'ring sticks up': a verb, but behind an article
    if _is_over(text, at, draft, noun) or _is_measure(text, draft, noun, adjective, measure):
        return at
    if (end := _ranked(text, at, draft)) > at:
        return end
    if noun and _is_head(text, at, draft, noun, adjective):
        draft.nouns.append(noun)
        return noun.end
    if adjective and (text.is_word(at - 1, "how") or text.find(adjective.end, "article")):
        return at  # 'how deep the holes are', 'they go through the lever'
    if adjective and (draft.nouns or noun_follows(text, adjective.end)):
        if draft.nouns and not is_noun(text, adjective.end):
            return at
        phrase = " ".join(text.words[at : adjective.end])
        draft.adjectives.append(phrase if phrase in text.lexicon.adjectives else adjective.value.name)
        return adjective.end
    return _attribute(text, at, draft) or _unknown(text, at, draft, measure)


def _is_over(text: Text, at: int, draft: Draft, noun: Span | None) -> bool:
    """Is the phrase complete before this word?"""
    if draft.nouns and text.tokens[draft.nouns[-1].end - 1].plural and not draft.unknown:
        return True  # the nouns of a compound are singular: 'standoffs stand' has a verb
    if noun is None or noun.end > at + 1:
        return False
    if (draft.nouns or draft.unknown) and ends_do_question(text, at):
        return True  # 'does the axis of the bore run?'
    if draft.nouns and text.is_word(at, "cut") and text.find(at + 1, "place"):
        return True  # 'the window cut in the wall'
    return bool(draft.nouns or draft.unknown) and text.is_word(at, "inside", "interior")  # 'the board inside'


def _is_measure(text: Text, draft: Draft, noun: Span | None, adjective: Span | None, measure: Span | None) -> bool:
    """Is the word a measure, and no part that has one: 'mouth diameter'?"""
    if measure is None or (noun and noun.end > measure.end) or (adjective and adjective.end > measure.end):
        return False
    if noun is None or noun.end != measure.end or draft.article or draft.nouns:
        return True
    return text.find(noun.end, "measure") is None


def _ranked(text: Text, at: int, draft: Draft) -> int:
    """'second largest', 'deepest', 'topmost'."""
    ordinal = text.find(at, "ordinal")
    scale = superlative(text, ordinal.end if ordinal else at)
    if scale and (ordinal or text.is_word(at - 1, "the") or noun_follows(text, scale.end)):  # 'does the largest have'
        most, nth = scale.value.degree == "most", ordinal.value if ordinal else 1
        draft.ranks.append(Rank(measure=scale.value.measure, most=most, nth=nth, count=draft.count or 1))
        return scale.end
    if (extreme := text.find(at, "place_extreme")) and noun_follows(text, extreme.end):
        draft.ranks.append(Rank(side=extreme.value, count=draft.count or 1))
        return extreme.end
    return at


def _is_head(text: Text, at: int, draft: Draft, noun: Span, adjective: Span | None) -> bool:
    """Is the noun one here: no adjective of a noun that follows, and no word for the whole model?"""
    after = text.find(noun.end, "noun")  # one that adds nothing: 'ring body'
    if adjective and not (adjective.end == noun.end and after is not None and after.value.name in GENERIC):
        behind, plural = adjective.end, text.tokens[adjective.end - 1].plural
        if behind >= noun.end and is_noun(text, behind) and not plural:  # 'the counterbores visible': a noun
            return False
    whole = text.find(at, "whole")
    return whole is None or whole.end < noun.end or bool(draft.nouns or draft.adjectives)


def _attribute(text: Text, at: int, draft: Draft) -> int:
    """Where a side, a colour or a negated adjective ends; 0 where none stands here."""
    if (side := text.find(at, "side")) and not draft.nouns:
        faced = side.end + text.is_word(side.end, "side", "face", "half")
        if faced > side.end and is_noun(text, faced):  # 'the underside lugs', 'left half lugs'
            draft.seen_on([side.value], half=text.is_word(side.end, "half"))
            return faced
        if is_noun(text, side.end):
            draft.ends.append(side.value)
            return side.end
    axis = text.find(at, "axis")
    if axis and axis.value in range(3) and axis.end > at + 1 and text.find(axis.end, "noun") and not draft.nouns:
        draft.adjectives.append(f"{'xyz'[axis.value]} parallel")  # 'z direction lugs'
        return axis.end
    if (color := text.find(at, "color")) and noun_follows(text, color.end):
        draft.colors.append(color.value)
        return color.end
    if text.is_word(at, "non", "un", "not") and (negated := text.find(at + 1, "adjective")):
        draft.lacking.append(negated.value.name)
        return negated.end
    return 0


def _unknown(text: Text, at: int, draft: Draft, measure: Span | None) -> int:
    """A word that no class has may be the name of something."""
    if draft.nouns or not text.is_content(at) or measure or text.find(at, "whole", "side", "scale", "adjective"):
        return at
    if (
        text.find(at, "ground", "verbs", "reach", "passing", "fits", "aside", "side_noun")
        or text.is_word(at, "s")
        or is_verb(text, at)
    ):
        return at
    draft.unknown.append(at)
    return at + 1
