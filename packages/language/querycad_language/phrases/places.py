"""Where parts are: 'visible from the top', 'in the flange', 'nearest to the edge', 'in the corners'."""

from __future__ import annotations

from querycad_contracts import Measure, Place, Rank, Side
from querycad_language.text import Text
from querycad_language.tokens import Kind

from .mention import MAX_DEPTH, PhraseBuilder, gather, replace_fields
from .words import is_noun, noun_follows


def seen(text: Text, at: int, build: PhraseBuilder) -> int:
    """'visible from the top', 'on the left side', 'not seen from above'."""
    if (beside := text.find(at, "place")) is not None and beside.value in ("left", "right"):
        return at  # 'to the left of the collar'
    negated = text.is_word(at, "not", "invisible", "hidden")
    start = text.skip(at + 1, "passing") if negated else at
    seeing, view = text.find(start, "seeing"), text.find(start, "view")
    start = text.skip(start, "seeing")
    view = view or text.find(start, "view")
    if view and text.find(start, "place") and (noun_follows(text, view.end) or text.find(view.end, "pronoun")):
        view = None  # 'underneath the flange' is no side
    sides, end = ([view.value], view.end) if view is not None else _sides(text, start)
    if view is None and seeing is None and (leads_away(text, start) or text.find(start, "perpendicular")):
        return at  # 'how far is the hole from the left side': a plane
    begun = text.is_word(start, "from") and text.is_word(end - 1, "face", "surface", "edge", "end", "rim")
    if begun and seeing is None and text.has("deep", "depth"):
        return end  # 'how deep is it from the front face': where a depth begins
    if sides and not negated and text.is_word(end - 1, "half"):
        build.seen_on(sides, half=True)
        return end
    if not sides or (negated and seeing is None and not text.find(start, "side_preposition")):
        return at
    at_end = seeing is None and not negated and (text.is_word(end - 1, "end") or text.is_word(start, "near"))
    other = build.within(end + 1, joined=True) if text.is_word(end, "of") else None
    if other is not None and other.query is not None:  # 'on the left side of the flange'
        build.ends += sides if at_end else []  # 'at the left end of the shaft'
        build.places.append(Place(relation="of", what=other.query, side=None if at_end else sides[0]))
        return other.end
    (build.unseen if negated else build.ends if at_end else build.sides).extend(sides)
    return other.end if other is not None else end


def leads_away(text: Text, at: int) -> bool:
    """Does a 'from' begin here that a distance is measured from?"""
    asked = "far" in text.words[:at] or any(span.end <= at for span in text.all("distance"))
    sized = any(span.end <= at for span in text.all("measure", "scale"))
    return text.is_word(at, "from") and (asked or (sized and "to" in text.words[at:]))


def _sides(text: Text, at: int) -> tuple[list[Side], int]:
    """Sides behind a preposition: 'from the top or the bottom side'."""
    leads = text.is_word(at, "to") and (text.has("from") or any(s.value is Measure.AXIS for s in text.all("measure")))
    along = text.is_word(at, "to", "from") and at in text.covered("axis")
    if leads or along or (prep := text.find(at, "side_preposition")) is None:
        return [], at  # 'from the pin to the back end of the fork' leads to an end; 'left to right' is no side
    sides: list[Side] = []
    end = prep.end
    while True:
        span = text.find(text.skip(end, "article", "each"), "side")
        if span is None or text.is_word(text.skip(span.end, "side"), "corner"):
            break
        after = text.skip(span.end, "side_noun")
        if after == span.end and is_noun(text, span.end) and not text.find(span.end, "be", "function"):
            break
        sides.append(span.value)
        end = after
        another = text.find(text.skip(end + 1, "article", "side_preposition"), "side")
        if another is None or not text.is_word(end, "and", "or", ",", "&"):
            break
        end = text.skip(end + 1, "side_preposition")
    return (sides, end) if sides else ([], at)


def sideways(text: Text, at: int, build: PhraseBuilder) -> int:
    """'from the side', 'through one of the side walls': neither from above nor from below."""
    end = text.skip(at + text.is_word(at, "come", "comes", "coming", "entering"), "passing")
    if not text.is_word(end, "from", "through", "in", "into") or build.sides:
        return at
    start, end = end, text.skip(end + 1, "side_preposition", "place", "each", "article", "number", "function")
    wall = text.skip(end + 1, "side_noun") + text.is_word(end + 1, "wall")
    if not text.is_word(end, "side", "flank") or text.is_word(end + 1, "of", "to", "half") or is_noun(text, wall):
        return at
    across = text.is_word(start, "through") and text.is_word(start + 1, "both")  # 'through both sides'
    return gather(build.adjectives, "through" if across else "horizontal", wall)


def along(text: Text, at: int, build: PhraseBuilder) -> int:
    """'along Z', 'whose axis is parallel to the z axis', 'that run in x direction': of parts that are counted."""
    named = (text.find(i, "measure") for i in range(at, at + 4))
    axes = next((span for span in named if span and span.value is Measure.AXIS), None)
    end = text.skip(at if axes is None else axes.end, "passing", "be")
    if not text.find(end, "axis_preposition", "parallel") or text.is_word(end, "by"):
        return at
    end = text.skip(end, "parallel", "axis_preposition", "function", "article")
    axis = text.find(end, "axis")
    runs = text.find(at, "passing") or axes is not None or text.any_in(range(end), "count", "parallel")
    if axis is None or axis.value > 2 or not runs or build.sizes:  # 'longer than 5 mm along z': of the size
        return at
    build.adjectives.append(f"{'xyz'[axis.value]} parallel")
    return text.skip(axis.end, "measure") if text.is_word(axis.end, "axis", "direction") else axis.end


def nearest(text: Text, at: int, build: PhraseBuilder) -> int:
    """'nearest to the edge', 'farthest from the slot'."""
    if (end := _by_coordinate(text, at, build)) > at:
        return end
    span = text.find(at, "near", "far")
    if span is None or build.depth >= MAX_DEPTH or text.is_word(at - 1, "to"):
        return at  # 'from the pin to the nearest edge': an end
    most = span.category == "far"
    start = span.end + text.is_word(span.end, "to", "from")
    inner = text.skip(start, "article")
    if edge := text.find(inner, "edge"):
        return gather(build.ranks, Rank(edge=True, most=most), edge.end)
    if text.is_word(inner, "center", "middle") and not text.is_word(inner + 1, "of"):
        return gather(build.adjectives, "farthest out" if most else "innermost", inner + 1)
    if side := text.find(inner, "side"):
        away = most and "from" in text.words[span.start : start]
        build.ranks.append(Rank(side=side.value.opposite if away else side.value))
        return text.skip(side.end, "side_noun")
    other = build.inner(start)
    return gather(build.ranks, Rank(near=other.query, most=most), other.end) if other is not None else at


def _by_coordinate(text: Text, at: int, build: PhraseBuilder) -> int:
    """'with the highest z', 'at smaller x', 'at positive y'."""
    start = text.skip(at + 1, "article") if text.is_word(at, "with", "at") else len(text)
    span, signed = text.find(start, "most", "least", "scale"), text.is_word(start, "positive", "negative")
    axis = text.find(span.end if span is not None else start + 1, "axis") if span is not None or signed else None
    degree = getattr(span.value, "degree", span.category) if span is not None else ""
    if axis is None or axis.value > 2 or degree == "positive":  # 'at large x' is no order
        return at
    sign = 1.0 if degree in ("most", "more") or text.is_word(start, "positive") else -1.0
    return gather(build.ranks, Rank(side=next(side for side in Side if side.outward[axis.value] == sign)), axis.end)


def central(text: Text, at: int, build: PhraseBuilder) -> int:
    """'in the middle of the plate', 'in the four corners'."""
    span = text.find(at, "center")
    corner = text.skip(at + 1, "article", "each", "number")
    if span is not None:
        end = span.end - text.is_word(span.end - 1, "of")
    elif text.find(at, "place") and text.is_word(text.skip(corner, "side"), "corner") and not text.find(at, "measure"):
        end = text.skip(corner, "side") + 1
        if is_noun(text, end):
            return at  # 'of the four corner lugs'
        build.ends += [side.value for i in range(corner, end) if (side := text.find(i, "side"))]  # 'top left corner'
    else:
        return at
    build.adjectives.append("corner" if text.is_word(end - 1, "corner") else "central")
    other = build.within(end + 1) if text.is_word(end, "of") else None
    if other is not None and other.query is not None:
        build.places.append(Place(relation="in", what=other.query))
    return other.end if other is not None else span.end if span is not None else end


def placed(text: Text, at: int, build: PhraseBuilder) -> int:
    """'in the flange', 'between the lugs', 'above the pocket'."""
    span = text.find(at, "place")
    longer = text.find(at, "measure", "contact", "noun")  # 'across flats', 'in contact with', 'through holes'
    if span is None or (longer and longer.end > span.end) or leads_away(text, at):
        return at
    if text.words[at].endswith("ed") and text.find(at - 1, "be") and not text.is_word(at - 2, "that", "which"):
        return at  # 'the board is carried by posts': what is said of it, not which
    start = span.end
    if text.is_kind(start, Kind.QUANTITY, Kind.NUMBER) and text.find(at, "relation"):
        return at
    inner = text.skip(start, "each", "article")
    piece = text.skip(inner, "side_noun", "edge")
    if piece > inner and text.is_word(piece, "of") and not text.is_word(at, "from"):  # 'in the side of' is in it
        start = piece + 1
    other = build.within(start, joined=span.value == "between")
    if other is None:
        return at
    if other.query is None:
        return other.end if span.value in ("in", "on", "of", "through") and not other.pronoun else at
    if text.find(other.end, "measure") and not text.is_word(other.end, "of"):
        return at  # 'holes in plate thickness direction'
    also = text.skip(other.end, "side", "ground", "side_noun")  # 'groove bottom and bore'
    second = build.inner(also + 1) if span.value == "between" and text.is_word(also, "and") else None
    if second is not None:
        both = replace_fields(other.query, also=(*other.query.also, second.part))
        return gather(build.places, Place(relation="between", what=both), second.end)
    rim = span.value == "around" and start > span.end  # 'around the edge of the plate' is on it
    return gather(build.places, Place(relation="of" if rim else span.value, what=other.query), other.end)
