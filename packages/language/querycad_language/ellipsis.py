"""What a clause has elsewhere: 'Of the bores, how many are tapped?', 'The lugs, are they alike?', 'over that'."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from .tokens import Token

Finds = Callable[..., object]
"""Given a token and categories: does a phrase of one of them begin there?"""

_LONGEST = 12  # tokens of a topic; longer ones are clauses of their own
MOST_OF_NOUN = 3  # words of a noun behind 'which'
_TELLING = ("side", "adjective", "most", "least", "ordinal")  # what tells parts of one name apart
_PRONOUNS = ("it", "they", "them")
_MAIN_VERBS = ("emerging", "stopping", "passing", "fits", "reach", "measure", "scale", "relation")
"""What is said of parts without 'are': 'which emerge at the back'."""
_VERBS = ("be", "do", "have", "modal", "ask", "where", "count", "imperative")
_STOPS = (",", ".", "?", "!", ";", ":")


def restored(tokens: tuple[Token, ...], finds: Finds) -> tuple[Token, ...]:
    """The tokens with what is said before put where the clause has a gap, or a pronoun for it."""
    return _topics(_ones(tokens, finds), finds)


def _ones(tokens: tuple[Token, ...], finds: Finds) -> tuple[Token, ...]:
    """'From the left lug to the right one', 'which lug is wider, the upper one or …': 'one' for the noun before."""
    found: list[Token] = []
    which: tuple[Token, ...] = ()
    told: dict[str | None, tuple[Token, ...]] = {}
    ends = ("or", "?") if any(token.word == "or" for token in tokens) else ()
    for at, token in enumerate(tokens):
        way = next((category for category in _TELLING if finds(at - 1, category)), None)
        end = next((end for end in range(at + 1, at + 1 + MOST_OF_NOUN) if not finds(end, "noun")), at)
        if finds(at, "noun") and token.word != "one":
            if way is not None and not finds(at - 1, "noun"):
                told[way] = tokens[at:end]
            lead = [before.word for before in tokens[max(0, at - 4) : at]]
            if not which and (lead[-1:] in (["which"], ["what"]) or lead[:2] == ["which", "of"]):
                which = tuple(replace(one, raw=one.word, plural=False) for one in tokens[at:end])  # 'of the two lugs'
        elif token.word in ends and way is not None and tokens[at - 2].word == "the":
            found += which  # 'the upper or the lower one'
        meant = told.get(way, which) if token.word == "one" and found and found[-1].word != "which" else ()
        found += (*meant[:-1], replace(meant[-1], plural=token.plural)) if meant else (token,)
    return tuple(found)


def _topics(tokens: tuple[Token, ...], finds: Finds) -> tuple[Token, ...]:
    """'Of the bores, how many are tapped?', 'The lugs: are they alike?'"""
    for comma, token in enumerate(tokens):
        if token.word not in (",", ":"):
            continue
        start = max((at + 1 for at in range(comma) if tokens[at].word in _STOPS), default=0)
        topic, where = tokens[start:comma], range(start, comma)
        begin = comma + 1 + any(one.word == "and" for one in tokens[comma + 1 : comma + 2])
        no_topic = ("measure", *_VERBS) if begin > comma + 1 else _VERBS  # 'hub width, and how long is it'
        said = any(finds(at, *no_topic) or tokens[at].word in ("along", "across") for at in where)
        named = any(finds(at, "noun") for at in where) and not said
        if named and len(topic) <= _LONGEST and (gap := _gap(tokens, begin, finds)):
            at, end = gap
            bare = tokens[at - 1 if at == len(tokens) else at].word in _PRONOUNS or topic[0].word != "of"
            whole = topic[1:] if bare and topic[0].word in ("of", "for", "with", "about", "regarding") else topic
            return (*tokens[:start], *tokens[begin:at], *whole, *tokens[end:])
    return tokens


def _gap(tokens: Sequence[Token], begin: int, finds: Finds) -> tuple[int, int] | None:
    """Where the topic belongs, and where what it replaces ends."""
    words = [token.word for token in tokens]
    for at in range(begin, len(words)):
        if words[at] in _STOPS or (finds(at, "noun") and words[at] not in ("one", "ones")):
            return None
        if words[at] in _PRONOUNS:
            return at, at + 1
        asks = 2 if words[at : at + 2] == ["how", "many"] else int(words[at] == "which")
        if asks == 1 and any(finds(later, "ask") for later in range(at + 1, len(words))):
            return None  # 'the screws, which are M5, how long are they?'
        if asks:
            end = at + asks + (at + asks < len(words) and words[at + asks] in ("one", "ones"))
            last = end == len(words) or words[end] in (".", "?", "!")  # 'lugs: how many?'
            if last or finds(end, *_VERBS, *_MAIN_VERBS):
                return at + asks, end
    return None
