"""What a clause has elsewhere: 'Of the bores, how many are tapped?', 'The lugs, are they alike?', 'over that'."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from .tokens import Kind, Token

Finds = Callable[[int, str], bool]
"""Does a phrase of the category begin at the token?"""

_LONGEST = 12
"""Tokens of a topic; longer ones are clauses of their own."""
_COMPARING = ("than", "over", "under", "above", "below", "exceed", "beyond")
MOST_OF_NOUN = 3
"""Words of a noun behind 'which'."""
_PRONOUNS = ("it", "they", "them")
_MAIN_VERBS = ("emerging", "stopping", "passing", "fits", "reach", "measure", "scale")
"""What is said of parts without 'are': 'which emerge at the back'."""
_VERBS = ("be", "do", "have", "modal", "ask", "where", "count", "imperative", "relation")


def restored(tokens: tuple[Token, ...], finds: Finds) -> tuple[Token, ...]:
    """The tokens with what is said before put where the clause has a gap, or a pronoun for it."""
    return _pointed_at(_topics(_of_which(tokens, finds), finds), finds)


def _of_which(tokens: tuple[Token, ...], finds: Finds) -> tuple[Token, ...]:
    """'Which lug is wider, the upper one or the lower one?': 'one' is the noun behind 'which'."""
    which = next((at for at, token in enumerate(tokens) if token.word in ("which", "what")), len(tokens))
    verb = next((at for at in range(which + 1, len(tokens)) if finds(at, "be") or finds(at, "have")), which)
    noun = tokens[which + 1 : verb]
    if not noun or len(noun) > MOST_OF_NOUN or not finds(which + 1, "noun"):
        return tokens
    ones = [at for at in range(verb, len(tokens)) if tokens[at].word == "one" and tokens[at - 1].word != "which"]
    return tuple(each for at, token in enumerate(tokens) for each in (noun if at in ones else (token,)))


def _pointed_at(tokens: tuple[Token, ...], finds: Finds) -> tuple[Token, ...]:
    """'The top is next. How many slots are on that side?', 'My cutter is 5 mm. How many slots are wider than that?'"""
    found = list(tokens)
    for at in range(1, len(tokens)):
        after = tokens[at + 1] if at + 1 < len(tokens) else None
        meant: list[int] = []
        if tokens[at].word in ("that", "this") and after is not None and after.word in ("side", "face"):
            meant = [one for one in range(at - 1) if finds(one, "side")]
        elif tokens[at].word in ("that", "this") and (after is None or after.kind is Kind.SYMBOL):
            lengths = (one for one in range(at) if tokens[one].kind is Kind.QUANTITY and tokens[one].power == 1)
            meant = [one for one in lengths if tokens[at - 1].word in _COMPARING]
        if meant:
            found[at] = tokens[meant[-1]]
    return tuple(found)


def _topics(tokens: tuple[Token, ...], finds: Finds) -> tuple[Token, ...]:
    """'Of the bores, how many are tapped?', 'The lugs: are they alike?'"""
    for comma, token in enumerate(tokens):
        if token.word not in (",", ":"):
            continue
        start = max((at + 1 for at in range(comma) if tokens[at].word in (".", "?", "!", ";", ":", ",")), default=0)
        topic = tokens[start:comma]
        verbal = any(finds(at, category) for at in range(start, comma) for category in _VERBS if category != "relation")
        if not topic or len(topic) > _LONGEST or verbal or not any(finds(at, "noun") for at in range(start, comma)):
            continue
        begin = comma + 1 + (tokens[comma + 1 : comma + 2] != () and tokens[comma + 1].word == "and")
        gap = _gap(tokens, begin, finds)
        if gap is not None:
            at, end = gap
            bare = tokens[at - 1 if at == len(tokens) else at].word in _PRONOUNS or topic[0].word != "of"
            whole = topic[1:] if bare and topic[0].word in ("of", "for", "with", "about", "regarding") else topic
            return (*tokens[:start], *tokens[begin:at], *whole, *tokens[end:])
    return tokens


def _gap(tokens: Sequence[Token], begin: int, finds: Finds) -> tuple[int, int] | None:
    """Where the topic belongs, and where what it replaces ends."""
    words = [token.word for token in tokens]
    for at in range(begin, len(words)):
        if words[at] in (",", ".", "?", "!", ";", ":") or (finds(at, "noun") and words[at] not in ("one", "ones")):
            return None
        if words[at] in _PRONOUNS:
            return at, at + 1
        asks = 2 if words[at : at + 2] == ["how", "many"] else int(words[at] == "which")
        if asks == 1 and any(finds(later, "ask") for later in range(at + 1, len(words))):
            return None  # 'the screws, which are M5, how long are they?'
        if asks:
            end = at + asks + (at + asks < len(words) and words[at + asks] in ("one", "ones"))
            last = end == len(words) or words[end] in (".", "?", "!")  # 'lugs: how many?'
            if last or any(finds(end, category) for category in (*_VERBS, *_MAIN_VERBS)):
                return at + asks, end
    return None
