"""Sides: what is seen from where, of parts, of what holds them, and of a model that lies."""

from __future__ import annotations

from typing import Any

from tests.made import body, hole, inventory, part, whole
from tests.segworker.grounding.plate import DEAD, LARGE, PLATE, SMALL, asked, best, ids

from querycad_contracts import Measure, PartQuery, Place, Rank, Side
from querycad_segworker.grounding.find import find
from querycad_segworker.grounding.ground import ground


def test_a_side_keeps_what_is_seen_from_there() -> None:
    assert ids(best(asked(sides=(Side.BOTTOM,)))) == {"hole-1", "hole-2"}
    away = ground(PLATE, asked(sides=(Side.LEFT,)))
    assert any("side_empties" in way.features and not way.parts for way in away)
    assert ids(best(asked(unseen=(Side.BOTTOM,)))) == {"hole-3"}


def test_a_side_that_tells_no_holder_from_others_says_where_its_parts_are_seen() -> None:
    """'The holes on the boss visible from the bottom': there is one boss."""
    round_: dict[str, Any] = {"tags": ("cylindrical",)}
    boss = part("boss-1", (-0.02, 0.0, 0.005), children=("hole-1", "hole-3"), faces=(50,), sides=tuple(Side), **round_)
    on_boss = Place(relation="on", what=PartQuery(noun="boss", words=("boss",), definite=True, sides=(Side.BOTTOM,)))
    assert ids(best(asked(places=(on_boss,)), inventory(SMALL, LARGE, DEAD, boss))) == {"hole-1"}
    other = part("boss-2", (0.04, 0.0, 0.005), children=("hole-2",), faces=(51,), sides=(Side.TOP,), **round_)
    two = inventory(SMALL, LARGE, DEAD, boss, other)  # now it says which boss
    assert ids(best(asked(places=(on_boss,)), two)) == {"hole-1", "hole-3"}


def test_the_back_of_a_plate_that_lies_is_its_underside_where_nothing_is_seen_from_the_back() -> None:
    sunk = part("pocket-1", (0.0, 0.0, -0.004), sides=(Side.BOTTOM,))
    behind = PartQuery(noun="pocket", words=("pocket",), definite=True, sides=(Side.BACK,))
    (turned,) = [way for way in ground(inventory(sunk), behind) if "side_turned" in way.features]
    assert ids(turned) == {"pocket-1"}
    assert turned.unchecked == ("'back', taken for the bottom",)
    upright = inventory(sunk, whole(extents=(0.1, 0.01, 0.06)))
    assert not any("side_turned" in way.features for way in ground(upright, behind))
    seen = part("pocket-2", (0.0, 0.03, 0.0), sides=(Side.BACK,))
    assert not any("side_turned" in way.features for way in ground(inventory(sunk, seen), behind))


def test_what_is_named_like_a_body_may_be_the_only_one() -> None:
    plug = PartQuery(noun="power connector", words=("plug",), definite=True)
    (all_of_it,) = [way for way in ground(inventory(SMALL), plug) if "whole_generic" in way.features]
    assert [one.kind for one in all_of_it.parts] == ["model"]
    two = inventory(SMALL, body(1, "plate"), body(2, "pin"))
    assert not any("whole_generic" in way.features for way in ground(two, plug))
    assert not any(
        "whole_generic" in way.features for way in ground(inventory(SMALL), plug.model_copy(update={"plural": True}))
    )


def test_a_side_of_what_is_the_whole_restricts_as_one_that_is_said_alone() -> None:
    plate = PartQuery(noun="plate", words=("plate",), definite=True)
    on_top = asked(places=(Place(relation="of", what=plate, side=Side.TOP),))
    below = asked(places=(Place(relation="of", what=plate, side=Side.BOTTOM),))
    one_body = inventory(SMALL, LARGE, DEAD, whole("plate"))
    assert ids(best(on_top, one_body)) == {"hole-1", "hole-2", "hole-3"}
    assert ids(best(below, one_body)) == {"hole-1", "hole-2"}


def test_a_side_port_opens_sideways() -> None:
    ports = (hole(1), hole(2, 20, tags=("through", "circular", "horizontal")))
    assert [p.id for p in find(inventory(*ports), "side ports").parts] == ["hole-2"]


def test_the_one_beside_another_part_is_the_nearest_there() -> None:
    near, far = part("slot-1", (0.01, 0.0, 0.0)), part("slot-2", (0.03, 0.0, 0.0), extents=(0.02, 0.01, 0.01))
    beside = Place(relation="right", what=PartQuery(noun="boss", words=("boss",), definite=True))
    slot = PartQuery(noun="slot", words=("slot",), definite=True, places=(beside,))
    model = inventory(part("boss-1"), near, far, part("slot-3", (-0.03, 0.0, 0.0)))
    assert ids(next(way for way in ground(model, slot) if "place_next" in way.features)) == {"slot-1"}
    several = slot.model_copy(update={"plural": True})
    assert ids(next(way for way in ground(model, several) if "place_holds" in way.features)) == {"slot-1", "slot-2"}


def test_the_lowest_cut_is_the_one_that_lies_lowest() -> None:
    high, low = part("groove-1", (0.0, 0.0, 0.02)), part("groove-2", (0.0, 0.0, -0.02), extents=(0.01, 0.01, 0.03))
    lowest = PartQuery(noun="groove", definite=True, ranks=(Rank(measure=Measure.HEIGHT, most=False),))
    assert ids(ground(inventory(high, low), lowest)[0]) == {"groove-2"}


def test_no_neck_is_a_collar() -> None:
    flat = ("cylindrical", "circular", "flat")
    neck = part("boss-1", tags=(*flat, "undercut", "neck"), radius=0.01, diameter=0.02)
    disc = part("boss-2", (0.02, 0.0, 0.0), tags=flat, radius=0.02, diameter=0.04)
    collar = PartQuery(noun="collar", words=("collar",), definite=True)
    assert ids(ground(inventory(neck, disc), collar)[0]) == {"boss-2"}


def test_the_collar_of_a_screw_is_not_its_head() -> None:
    flat = ("cylindrical", "circular", "flat")
    head = part("boss-1", tags=(*flat, "land", "head"), radius=0.02, diameter=0.04)
    below = part("boss-2", (0.0, 0.0, 0.02), tags=flat, radius=0.01, diameter=0.02)
    collar = PartQuery(noun="collar", words=("collar",), definite=True)
    assert ids(ground(inventory(head, below), collar)[0]) == {"boss-2"}
    land = head.model_copy(update={"tags": (*flat, "land")})
    assert ids(ground(inventory(land, below), collar)[0]) == {"boss-1"}
