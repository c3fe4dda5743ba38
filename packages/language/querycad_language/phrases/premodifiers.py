"""The noun of a phrase and what stands before it: 'the two largest blind M5 holes'."""

from __future__ import annotations

from querycad_contracts import Rank, SizeFilter
from querycad_language.lexicon import Span
from querycad_language.text import Text
from querycad_language.tokens import Kind

from .mention import GENERIC, PhraseBuilder, gather
from .sizes import size_before
from .words import ends_do_question, is_noun, is_verb, noun_follows, scale_at, superlative


def before_noun(text: Text, at: int, build: PhraseBuilder) -> int:
    """Where the next piece of the phrase ends; `at` where nothing here belongs to it."""
    token = text.tokens[at]
    empty = not (build.nouns or build.unknown)
    adjective = text.find(at, "adjective")
    if adjective and adjective.end > at + 1 and (token.kind is Kind.NUMBER or text.find(at, "number")):
        return _word(text, at, build)  # 'six sided': no count
    match token.kind:
        case Kind.TIMES:
            build.count = int(token.value)
            return at + 1
        case Kind.THREAD:
            return gather(build.threads, token.word, at + 1)
        case Kind.QUANTITY:
            return size_before(text, at, build) if empty else at
        case Kind.NUMBER:
            return _number(text, at, build)
        case Kind.WORD:
            end = _determiner(text, at, build) if empty else at
            return end if end > at else _word(text, at, build)
    return at


def _determiner(text: Text, at: int, build: PhraseBuilder) -> int:
    if text.is_word(at, "one", "any") and text.is_word(at + 1, "of"):
        build.sample = True
        return at + 2
    if span := text.find(at, "each"):
        build.each = True
        build.count = 2 if text.is_word(at, "both") else build.count
        return span.end
    if span := text.find(at, "quantifier"):
        return span.end
    if (span := text.find(at, "article")) and not (text.find(at, "pronoun") and not _determines(text, at, span.end)):
        build.definite = build.definite or text.words[at] not in ("a", "an", "such")
        build.article = True
        if text.is_word(at, "this", "my", "our"):  # later it points to what was said
            build.deictic = not any(map(text.is_break, range(at)))
        return span.end
    span = text.find(at, "number")
    if span is not None and noun_follows(text, span.end):
        build.count = {"single": 1, "one": None}.get(text.words[at], span.value)
        return span.end
    return at


def _determines(text: Text, at: int, end: int) -> bool:
    """Does the noun of 'this' follow: 'is this washer …', but not 'is this a washer', 'is this hollow?'"""
    trait = text.find(end, "adjective")
    said = trait and text.is_word(trait.end, "?") and text.find(at - 1, "be") and not text.any_in(range(at), "ask")
    return noun_follows(text, end) and not (text.is_word(end, "a", "an") or said)


def _number(text: Text, at: int, build: PhraseBuilder) -> int:
    """'4 holes' says how many; 'hole 4' names one."""
    token = text.tokens[at]
    whole = token.value == int(token.value)
    noun = text.find(at + 1, "noun")
    sized = scale_at(text, at + 1, "positive") or text.is_word(at + 1, "time")  # 'is it 8 wide'
    one = build.definite and noun and not text.tokens[noun.end - 1].plural and not text.find(noun.end, "noun")
    if not build.nouns and ((not whole and text.find(at + 1, "noun", "adjective")) or (one and token.value > 1)):
        build.sizes.append(SizeFilter(low=token.value * 1e-3))  # 'the 13.5 holes', 'the 25 lug'
    elif whole and token.value < 10_000 and build.nouns and build.nouns[-1].end == at and not (build.unknown or sized):
        build.ids.append(f"{build.nouns[-1].value.name}-{int(token.value)}")
    elif whole and not build.nouns and noun_follows(text, at + 1):
        build.count = int(token.value)
    else:
        return at
    return at + 1


def _word(text: Text, at: int, build: PhraseBuilder) -> int:
    """An adjective, a rank, a side, a colour, a noun, or a word that is not known."""
    noun, adjective, measure = text.find(at, "noun"), text.find(at, "adjective"), text.find(at, "measure")
    if noun and text.find(at, "reach", "passing") and not _names(text, at, build.article):
        noun = None  # 'ring sticks up': a verb
    if _is_over(text, at, build, noun) or _is_measure(text, build, noun, adjective, measure):
        return at
    if (end := _ranked(text, at, build)) > at:
        return end
    if noun and _is_head(text, at, build, noun, adjective):
        return gather(build.nouns, noun, noun.end)
    if adjective and (text.is_word(at - 1, "how") or text.find(adjective.end, "article")):
        return at  # 'how deep the holes are', 'they go through the lever'
    if adjective and (build.nouns or noun_follows(text, adjective.end) or _goes_alone(text, adjective, build)):
        if build.nouns and not is_noun(text, adjective.end):
            return at
        phrase = " ".join(text.words[at : adjective.end])
        build.adjectives.append(phrase if phrase in text.lexicon.adjectives else adjective.value.name)
        return adjective.end
    return _attribute(text, at, build) or _unknown(text, at, build, measure)


def _goes_alone(text: Text, adjective: Span, build: PhraseBuilder) -> bool:
    """'The big and the small end', with the noun of both; 'the larger of the two'."""
    if text.is_word(adjective.end, "of"):
        return build.article and scale_at(text, adjective.start, "more", "less") is not None
    article = text.is_word(adjective.end, "and") and text.find(adjective.end + 1, "article")
    return bool(article and build.article and text.find(adjective.end + 2, "adjective"))


def _names(text: Text, at: int, article: bool) -> bool:
    """Is a word that can be a verb a noun here: 'the recess', 'the seal recess', but 'do the rings recess'?"""
    if (article and text.find(at - 1, "article", "adjective")) or at - 1 in text.covered("count"):
        return True
    acts = text.find(at, "adjective") or (text.find(at, "passing") and not article)
    acts = acts or text.tokens[at].plural or (at > 0 and text.tokens[at - 1].plural)
    return not acts and not text.any_in(range(at - 12, at), "do")


def _is_over(text: Text, at: int, build: PhraseBuilder, noun: Span | None) -> bool:
    """Is the phrase complete before this word?"""
    if build.nouns and text.tokens[build.nouns[-1].end - 1].plural and not build.unknown:
        return True  # the nouns of a compound are singular: 'standoffs stand' has a verb
    if noun is None or noun.end > at + 1:
        return False
    if build.nouns and text.is_word(at, "cut") and text.find(at + 1, "place"):
        return True  # 'the window cut in the wall'
    last = ends_do_question(text, at) or text.is_word(at, "inside", "interior")
    return last and bool(build.nouns or build.unknown)  # 'does the axis of the bore run?', 'the board inside'


def _is_measure(
    text: Text, build: PhraseBuilder, noun: Span | None, adjective: Span | None, measure: Span | None
) -> bool:
    """Is the word a measure, and no part that has one: 'mouth diameter'?"""
    if measure is None or (noun and noun.end > measure.end) or (adjective and adjective.end > measure.end):
        return False
    if adjective and text.is_word(measure.start, "middle") and text.find(measure.end, "noun"):
        return False  # 'the middle step'
    others = [one for one in text.all("measure", "scale") if one.start not in measure.tokens]
    if others and superlative(text, measure.start):  # 'how long is the thinnest section', 'the smallest-diameter disc'
        if text.find(measure.end - 1, "noun") or (noun_follows(text, measure.end) and not build.nouns):
            return False
    if noun is not None and text.tokens[noun.end - 1].plural:
        return False  # 'the cogs'
    apart = noun is None or noun.end != measure.end or build.article or build.nouns
    return bool(apart) or text.find(measure.end, "measure") is None


def _ranked(text: Text, at: int, build: PhraseBuilder) -> int:
    """'second largest', 'deepest', 'topmost'; 'the second bore' in no order that is said."""
    ordinal = text.find(at, "ordinal")
    scale = superlative(text, ordinal.end if ordinal else at)
    of = text.find(scale.end, "measure") if scale and not ordinal else None
    of = of if of and noun_follows(text, of.end) else None  # 'the smallest-diameter disc'
    alone = ordinal or text.is_word(at - 1, "the")  # 'does the largest have'
    if scale and (of or alone or noun_follows(text, scale.end)):
        measure, nth = of.value if of else scale.value.measure, ordinal.value if ordinal else 1
        build.ranks.append(Rank(measure=measure, most=scale.value.degree == "most", nth=nth, count=build.count or 1))
        return of.end if of else scale.end
    noun = text.find(ordinal.end, "noun") if ordinal else None
    counted = ordinal and (ordinal.value > 1 or (noun and text.is_word(noun.end, "from")))  # 'first slot from the top'
    if ordinal and counted and is_noun(text, ordinal.end) and not text.is_word(at, "next"):
        return gather(build.ranks, Rank(nth=ordinal.value), ordinal.end)
    if (extreme := text.find(at, "place_extreme")) and noun_follows(text, extreme.end):
        return gather(build.ranks, Rank(side=extreme.value, count=build.count or 1), extreme.end)
    return at


def _is_head(text: Text, at: int, build: PhraseBuilder, noun: Span, adjective: Span | None) -> bool:
    """Is the noun one here: no adjective of a noun that follows, and no word for the whole model?"""
    after = text.find(noun.end, "noun")  # one that adds nothing: 'ring body'
    if adjective and not (adjective.end == noun.end and after is not None and after.value.name in GENERIC):
        behind, plural = adjective.end, text.tokens[adjective.end - 1].plural
        of_it = text.find(behind, "measure")  # 'chamfer outer radius'
        if behind >= noun.end and is_noun(text, behind) and not plural and not of_it:  # 'the counterbores visible'
            return False
    whole = text.find(at, "whole")
    return whole is None or whole.end < noun.end or bool(build.nouns or build.adjectives or build.lacking)


def _attribute(text: Text, at: int, build: PhraseBuilder) -> int:
    """Where a side, a colour or what is lacking ends; 0 where none stands here."""
    if not build.nouns and text.is_word(at, "non") and (denied := text.find(at + 1, "adjective")):
        return gather(build.lacking, denied.value.name, denied.end)  # 'the non-chamfered hole'
    if (side := text.find(at, "side")) and not build.nouns:
        many = text.find(side.end, "number")
        if many is not None and many.value > 1 and noun_follows(text, many.end):  # 'the upper two holes'
            return gather(build.ranks, Rank(side=side.value, count=int(many.value)), many.end)
        faced = side.end + text.is_word(side.end, "side", "face", "half")
        if faced > side.end and is_noun(text, faced):  # 'the underside lugs', 'left half lugs'
            build.seen_on([side.value], half=text.is_word(side.end, "half"))
            return faced
        other = text.find(text.skip(side.end + text.is_word(side.end, "and", "or"), "article"), "side")
        if is_noun(text, side.end) or (other and is_noun(text, other.end) and not text.find(other.end, "side_noun")):
            return gather(build.ends, side.value, side.end)  # 'the top left hole', 'the upper and the lower hole'
    if (color := text.find(at, "color")) and noun_follows(text, color.end):
        return gather(build.colors, color.value, color.end)
    return 0


def _unknown(text: Text, at: int, build: PhraseBuilder, measure: Span | None) -> int:
    """A word that no class has may be the name of something."""
    if build.nouns or not text.is_content(at) or measure or text.find(at, "whole", "side", "scale", "adjective"):
        return at
    known = text.find(at, "ground", "verbs", "reach", "passing", "emerging", "fits", "aside", "side_noun")
    if known or text.is_word(at, "s") or is_verb(text, at):
        return at
    return gather(build.unknown, at, at + 1)
