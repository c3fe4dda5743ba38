"""Queries on small made inventories: each restriction holds, fails, or is said not to be checked."""

from __future__ import annotations

import pytest
from tests.made import body, hole, inventory, part, whole
from tests.segworker.grounding.plate import DEAD, HOLES, LARGE, PLATE, SMALL, asked, best, ids

from querycad_contracts import Grounded, Measure, Part, PartKind, PartQuery, Place, Rank, Relation, Side, SizeFilter
from querycad_segworker.grounding import ground as grounding
from querycad_segworker.grounding.candidates import taken_for
from querycad_segworker.grounding.find import find
from querycad_segworker.grounding.ground import KEPT, ground
from querycad_segworker.grounding.inventory import Inventory


def test_a_kind_that_people_take_for_the_noun_is_a_way_too_and_said() -> None:
    notch = PartQuery(noun="notch", words=("notch",), definite=True)
    pocketed = inventory(SMALL, part("pocket-1", (0.03, 0.0, 0.0), width=0.004, length=0.02, depth=0.003))
    taken = next(way for way in ground(pocketed, notch) if ids(way) == {"pocket-1"})
    assert "kin_instead" in taken.features
    assert taken.unchecked == ("'notch', taken for a pocket",)
    assert taken_for("lip", PartKind.ELEVATION) == "'lip', taken for an elevation"
    ribs = ground(pocketed, PartQuery(noun="rib", words=("rib",), definite=True))
    assert not any("sense_kin" in way.features for way in ribs)  # what is cut in is never taken for what stands out


def test_several_that_more_is_said_of_need_not_be_all() -> None:
    groups = [way for way in ground(PLATE, asked(unknown=("grip",))) if "group_for_plural" in way.features]
    assert [ids(way) for way in groups] == [{"hole-1", "hole-3"}]
    assert not any("group_for_plural" in way.features for way in ground(PLATE, HOLES))
    assert not any("group_for_plural" in way.features for way in ground(PLATE, asked(count=3)))


def test_a_noun_finds_its_kind_and_one_that_the_model_lacks_nothing() -> None:
    assert ids(best(HOLES)) == {"hole-1", "hole-2", "hole-3"}
    none = best(PartQuery(noun="gear", words=("gear",), plural=True))
    assert none.parts == ()
    assert "nothing" in none.features


def test_an_unknown_noun_is_told_and_finds_nothing() -> None:
    none = best(PartQuery(noun="gronk", known=False, words=("gronk",), plural=True))
    assert none.parts == ()
    assert none.features["unknown_noun"] == 1.0
    assert none.unchecked == ("'gronk'",)


def test_an_unknown_english_word_may_be_any_parts_of_one_kind_and_size_and_is_said_to_be_a_guess() -> None:
    ways = ground(PLATE, PartQuery(noun="vestibule", known=False, words=("vestibule",)))
    guesses = [way for way in ways if "guessed" in way.features]
    assert {frozenset(ids(way)) for way in guesses} >= {frozenset({"slot-1"})}
    assert all(way.unchecked and "taken for a" in way.unchecked[0] for way in guesses)
    assert find(PLATE, "vestibule").parts == ()  # a program that looks for it gets none


def test_a_known_noun_may_mean_parts_of_other_kinds_too_as_a_guess_behind_all_that_it_means() -> None:
    slot = PartQuery(noun="slot", words=("slot",), known=True)
    ways = ground(PLATE, slot)
    guessed = ["guessed" in way.features for way in ways]
    assert guessed == sorted(guessed)
    assert any(ids(way) == {"hole-2"} for way, guess in zip(ways, guessed, strict=True) if guess)
    assert not any("slot-1" in ids(way) for way, guess in zip(ways, guessed, strict=True) if guess)
    assert all(way.parts for way, guess in zip(ways, guessed, strict=True) if guess)
    assert {one.id for one in find(PLATE, "gear").parts} == set()  # a program that looks for one gets none


def test_an_adjective_that_agrees_narrows_and_one_that_none_has_is_not_dropped_in_silence() -> None:
    agrees = best(asked(adjectives=("blind",)))
    assert ids(agrees) == {"hole-3"}
    assert "adjective_agrees" in agrees.features
    ways = ground(PLATE, asked(adjectives=("rectangular",)))
    assert all("adjective_dropped" in way.features or not way.parts for way in ways)
    assert all(way.unchecked for way in ways if way.parts)


@pytest.mark.parametrize("name", ["counterbored", "countersunk"])
def test_plain_holes_are_denied_what_recognition_always_finds(name: str) -> None:
    ways = ground(PLATE, asked(adjectives=(name,)))
    assert all("denied_dropped" in way.features for way in ways if way.parts and "sense_kin" not in way.features)
    chamfered = hole(4, 30, tags=("through", "circular", "chamfered"))
    wider = ground(inventory(SMALL, chamfered), asked(adjectives=("countersunk",)))
    assert ids(wider[0]) == {"hole-4"}


def test_pieces_of_holes_are_taken_for_one_another_and_for_no_other_cuts() -> None:
    sunk = PartQuery(noun="countersink", words=("countersink",), plural=True)
    assert not any("sense_kin" in way.features and way.parts for way in ground(PLATE, sunk))
    bored = inventory(SMALL, part("counterbore-1", (0.03, 0.0, 0.0), diameter=0.01))
    assert any("sense_kin" in way.features and ids(way) == {"counterbore-1"} for way in ground(bored, sunk))


def test_what_must_be_lacking_leaves_the_others() -> None:
    assert ids(best(asked(lacking=("blind",)))) == {"hole-1", "hole-2"}


@pytest.mark.parametrize(
    ("size", "found"),
    [
        (SizeFilter(measure=Measure.DIAMETER, low=0.012), {"hole-2"}),
        (SizeFilter(low=0.005), {"hole-1", "hole-3"}),
        (SizeFilter(measure=Measure.DIAMETER, relation=Relation.MORE, low=0.006), {"hole-2"}),
        (SizeFilter(measure=Measure.DIAMETER, relation=Relation.BETWEEN, low=0.004, high=0.006), {"hole-1", "hole-3"}),
    ],
)
def test_a_size_that_agrees_narrows(size: SizeFilter, found: set[str]) -> None:
    grounded = best(asked(sizes=(size,)))
    assert ids(grounded) == found
    assert "size_agrees" in grounded.features


def test_a_size_that_none_has_empties_or_is_unchecked() -> None:
    ways = ground(PLATE, asked(sizes=(SizeFilter(measure=Measure.DIAMETER, low=0.033),)))
    assert {"size_empties", "size_dropped"} <= {name for way in ways for name in way.features}
    assert all(way.unchecked for way in ways if way.parts)


def test_a_place_holds_where_parts_are_and_is_unchecked_where_there_is_none() -> None:
    carrier = part(
        "boss-1",
        (-0.02, 0.0, 0.005),
        tags=("cylindrical",),
        children=("hole-1", "hole-2"),
        extents=(0.02, 0.02, 0.01),
        faces=(50,),
    )
    of = inventory(SMALL, LARGE, DEAD, carrier)
    in_boss = asked(places=(Place(relation="in", what=PartQuery(noun="boss", words=("boss",))),))
    assert ids(best(in_boss, of)) == {"hole-1", "hole-2"}
    ways = ground(PLATE, asked(places=(Place(relation="in", what=PartQuery(noun="pinion", words=("pinion",))),)))
    assert any("place_unknown" in way.features and way.unchecked for way in ways)


def test_with_a_ring_is_with_any_of_them() -> None:
    rings = [
        part(f"boss-{i}", (x, 0.0, 0.005), tags=("cylindrical", "ring"), extents=(0.02 + i / 1e3,) * 3, faces=(50 + i,))
        for i, x in enumerate((-0.02, 0.0))
    ]
    ringed = asked(places=(Place(relation="with", what=PartQuery(noun="boss", words=("boss",))),))
    assert ids(best(ringed, inventory(SMALL, LARGE, DEAD, *rings))) == {"hole-1", "hole-2"}


def test_the_two_of_a_kind_belong_to_all_that_are_named_before_them() -> None:
    rings = [
        part(f"boss-{i}", (x, 0.0, 0.005), tags=("cylindrical",), extents=(0.02 + i / 1e3,) * 3, faces=(50 + i,))
        for i, x in enumerate((-0.02, 0.0))
    ]
    of = inventory(SMALL, LARGE, DEAD, *rings)
    boss = Place(relation="", what=PartQuery(noun="boss", words=("boss",)))
    one_each = best(asked(count=2, definite=True, places=(boss,)), of)
    assert ids(one_each) == {"hole-1", "hole-2"}
    assert "count_agrees" in one_each.features


def test_the_bore_is_the_largest_where_nothing_more_is_said_of_it() -> None:
    bore = PartQuery(noun="bore", words=("bore",), definite=True)
    of = inventory(SMALL, hole(2, 20, diameter=0.02), hole(4, 40, diameter=0.008))
    picked = [way for way in ground(of, bore) if way.features.get("sense_stretch") == 0.1]
    assert [ids(way) for way in picked] == [{"hole-2"}]
    for more in ({"adjectives": ("small",)}, {"plural": True}, {"sizes": (SizeFilter(low=0.008),)}):
        ways = ground(of, bore.model_copy(update=more))
        assert not any(way.features.get("sense_stretch") == 0.1 for way in ways)


def test_the_largest_has_the_largest_diameter_that_is_told() -> None:
    bored = hole(4, 40, diameter=0.008, radii=(0.004, 0.009))
    largest = asked(plural=False, ranks=(Rank(measure=Measure.MAGNITUDE),))
    assert ids(best(largest, inventory(SMALL, LARGE, bored))) == {"hole-2"}


def test_a_bearing_sits_in_the_wide_step_of_a_bore_else_in_the_largest_bore() -> None:
    seat = PartQuery(noun="bearing seat", words=("bearing", "seat"), definite=True)
    bore = hole(4, diameter=0.02, radii=(0.01, 0.015), tags=("through", "stepped", "circular"), faces=(4, 5))
    steps = [
        part(f"cylinder-{i}", radius=radius, diameter=2 * radius, depth=0.005, tags=("inner",), faces=(face,))
        for i, (radius, face) in enumerate(((0.01, 4), (0.015, 5)))
    ]
    assert [one.diameter for one in best(seat, inventory(SMALL, bore, *steps)).parts] == [0.03]
    sunk = part("counterbore-1", radius=0.015, diameter=0.03, depth=0.006, faces=(5, 7))  # its chamfer is part of it
    assert [one.depth for one in best(seat, inventory(SMALL, bore, *steps, sunk)).parts] == [0.006]
    assert ids(best(seat)) == {"hole-2"}


def test_a_seat_goes_on_over_a_ring_groove_and_two_seats_are_two() -> None:
    seat = PartQuery(noun="bearing seat", words=("bearing", "seat"), definite=True)
    bore = hole(4, diameter=0.02, radii=(0.01, 0.015), tags=("through", "stepped", "circular"), faces=(4, 5, 6))

    def step(i: int, radius: float, low: float, high: float) -> Part:
        size = {"radius": radius, "diameter": 2 * radius, "depth": high - low, "height": high - low}
        return part(f"cylinder-{i}", (0.0, 0.0, (low + high) / 2), **size, tags=("inner",), faces=(i,))

    for narrow, depth in (((0.0, 0.01), 0.02), ((0.016, 0.018), 0.012)):
        steps = [step(4, 0.01, *narrow), step(5, 0.015, 0.01, 0.016), step(6, 0.015, 0.018, 0.03)]
        found = best(seat, inventory(SMALL, bore, *steps)).parts
        assert [one.depth for one in found] == pytest.approx([depth])


def test_a_hub_is_what_stands_out_most_and_a_raised_face_least() -> None:
    discs = {"flange": (0.15, 0.018), "face": (0.1, 0.002), "hub": (0.08, 0.012)}
    tags = ("cylindrical", "hollow", "flat", "raised", "central")
    bosses = [
        part(f"boss-{n}", tags=(*tags, *["flange"] * (name == "flange")), diameter=across, height=high)
        for n, (name, (across, high)) in enumerate(discs.items(), 1)
    ]
    flange = inventory(*bosses)
    assert ids(best(PartQuery(noun="hub", words=("hub",), definite=True), flange)) == {"boss-3"}
    assert ids(best(PartQuery(noun="raised face", words=("raised", "face"), definite=True), flange)) == {"boss-2"}


def test_holes_for_oil_are_the_smallest_and_a_bearing_sits_in_a_bore_where_there_is_none() -> None:
    bored = inventory(hole(1, -20, diameter=0.004), hole(2, 0, diameter=0.03))
    assert ids(best(PartQuery(noun="grease hole", words=("grease", "hole"), definite=True), bored)) == {"hole-1"}
    assert ids(best(PartQuery(noun="bearing", words=("bearing",), definite=True), bored)) == {"hole-2"}


def test_a_count_agrees_chooses_a_group_or_differs() -> None:
    assert "count_agrees" in best(asked(count=3)).features
    pair = best(asked(count=2))
    assert ids(pair) == {"hole-1", "hole-3"}
    assert "count_group" in pair.features
    assert all("count_differs" in way.features for way in ground(PLATE, asked(count=9)) if way.parts)


def test_a_rank_takes_the_first_of_an_order() -> None:
    largest = Rank(measure=Measure.DIAMETER)
    assert ids(best(asked(plural=False, ranks=(largest,)))) == {"hole-2"}
    assert ids(best(asked(plural=False, ranks=(Rank(side=Side.RIGHT),)))) == {"hole-3"}
    near = Rank(near=PartQuery(noun="slot", words=("slot",)), most=False)
    assert ids(best(asked(plural=False, ranks=(near,)))) == {"hole-3"}


def test_an_ordinal_needs_so_many_and_which_one_it_is_stays_unchecked() -> None:
    there = best(asked(plural=False, ranks=(Rank(nth=2),)))
    assert there.parts
    assert "which is number 2" in there.unchecked
    ways = ground(PLATE, asked(plural=False, ranks=(Rank(nth=9),)))
    assert {bool(way.parts) for way in ways} == {True, False}
    assert all(("nth_dropped" if way.parts else "nth_empties") in way.features for way in ways)


def test_one_of_several_is_every_way_to_choose() -> None:
    ways = ground(PLATE, PartQuery(noun="hole", words=("hole",), definite=True))
    chosen = {name for way in ways for name in way.features}
    assert {"group_for_one", "several_for_one"} <= chosen


def test_exceptions_are_taken_away_and_further_kinds_added() -> None:
    assert ids(best(asked(excluded=(asked(adjectives=("blind",)),)))) == {"hole-1", "hole-2"}
    slots = PartQuery(noun="slot", words=("slot",), plural=True)
    assert "slot-1" in ids(best(asked(also=(slots,))))


def test_an_id_is_that_part_or_none() -> None:
    assert ids(best(PartQuery(noun="hole", ids=("hole-2",)))) == {"hole-2"}
    missing = best(PartQuery(noun="hole", ids=("hole-99",)))
    assert missing.parts == ()
    assert "hole-99" in missing.reason


def test_names_of_bodies_are_words_for_them() -> None:
    screw, post = body(1, "Gronk_M8x25", faces=(1,)), body(2, "Post", (0.05, 0.0, 0.0), faces=(2,))
    of = Inventory((whole("stand"), screw, post))
    named = best(PartQuery(noun="gronk", known=False, words=("gronk",)), of)
    assert ids(named) == {"body-1"}
    assert "by_name" in named.features
    other = best(PartQuery(noun="frobnicator", known=False, words=("frobnicator",), plural=True), of)
    assert other.parts == ()


def test_an_unknown_noun_may_be_a_body_of_an_assembly() -> None:
    small, large = body(1, "a", faces=(1,)), body(2, "b", (0.05, 0.0, 0.0), extents=(0.02, 0.02, 0.05), faces=(2,))
    vestibule = PartQuery(noun="vestibule", known=False, words=("vestibule",), definite=True)
    guesses = [way for way in ground(Inventory((whole("stand"), small, large)), vestibule) if "guessed" in way.features]
    assert [ids(way) for way in guesses][:2] == [{"body-2"}, {"body-1"}]


def test_screws_that_are_not_there_may_be_the_holes_of_one_size() -> None:
    screws = PartQuery(noun="screw", words=("screw",), plural=True)
    ways = ground(inventory(SMALL, LARGE, hole(3, 20)), screws)
    assert any("sense_stretch" in way.features and ids(way) == {"hole-1", "hole-3"} for way in ways)


def test_the_parts_of_a_hinge_are_no_parts_of_the_bodies_that_are_called_so() -> None:
    halves = [body(n, "hinge", extents=(n * 0.01,) * 3, faces=(n,)) for n in (1, 2, 3)]
    hinge = PartQuery(noun="hinge", known=False, words=("hinge",), definite=True)
    pieces = PartQuery(noun="body", words=("part",), plural=True, places=(Place(relation="in", what=hinge),))
    ways = ground(Inventory((whole("stand"), *halves)), pieces)
    assert ids(ways[0]) == {"body-1", "body-2", "body-3"}
    assert not any("place_holds" in way.features for way in ways)


def test_what_lies_in_another_than_is_named_may_not_be_there() -> None:
    slots = [part(f"slot-{n}", (x, 0.0, 0.0), extents=(0.02, 0.02, 0.01)) for n, x in ((1, -0.02), (2, 0.03))]
    for name, denied in (("slot-2", True), ("slot-1", False)):
        slot = PartQuery(noun="slot", words=("slot",), ids=(name,))
        ways = ground(inventory(*slots, hole(1, -20)), asked(plural=False, places=(Place(relation="in", what=slot),)))
        empty = [way for way in ways if not way.parts and "place_empties" in way.features]
        assert ["place_elsewhere" in way.features for way in empty] == [True] * denied
        assert any("place_denied" in way.features for way in ways if ids(way) == {"hole-1"}) is denied


def test_in_what_the_model_lacks_there_may_be_nothing() -> None:
    gear = Place(relation="in", what=PartQuery(noun="gear", words=("gear",)))
    assert any("place_absent" in way.features and not way.parts for way in ground(PLATE, asked(places=(gear,))))
    without = ground(PLATE, asked(places=(gear.model_copy(update={"negated": True}),)))
    assert ids(without[0]) == {"hole-1", "hole-2", "hole-3"}
    assert not without[0].unchecked
    rib = Place(relation="with", what=PartQuery(noun="rib", words=("rib",)), negated=True)
    lone = PartQuery(noun="slot", words=("slot",), places=(rib,))
    assert ground(PLATE, lone)[0].unchecked == ("'with rib'",)  # less it: the only slot is not chosen by it
    several = ground(PLATE, asked(places=(rib,)))
    assert any("trait_holds" in way.features and not way.unchecked for way in several)


def test_what_lies_in_the_other_half_is_not_at_that_end() -> None:
    for end, denied in ((Side.LEFT, True), (Side.RIGHT, False)):
        ways = ground(inventory(hole(1, 30)), asked(ends=(end,)))
        assert any("end_denied" in way.features for way in ways if way.parts) is denied
        assert any("end_empties" in way.features for way in ways) is denied


def test_no_part_lies_in_itself() -> None:
    wide = PartQuery(noun="hole", words=("hole",), ids=("hole-2",))
    inside = asked(places=(Place(relation="in", what=wide),))
    ways = [way for way in ground(inventory(hole(1, 2), LARGE), inside) if "place_holds" in way.features]
    assert [ids(way) for way in ways] == [{"hole-1"}]


def test_free_text_without_a_number_means_all() -> None:
    assert len(find(PLATE, "hole").parts) == 3
    assert len(find(PLATE, "slot").parts) == 1


@pytest.mark.parametrize(("text", "understood", "says"), [("gronk", False, "'gronk'"), ("gear", True, "no 'gear'")])
def test_what_is_not_found_is_said_with_the_kinds_that_there_are(text: str, understood: bool, says: str) -> None:
    found = find(PLATE, text)
    assert (found.parts, found.understood) == ((), understood)
    assert says in found.message
    assert set(found.nearest) == {"hole", "slot", "body"}


def test_parts_that_are_elsewhere_are_counted_in_the_message() -> None:
    found = find(PLATE, "slots", [Side.BOTTOM])
    assert found.parts == ()
    assert "1 x" in found.message


def test_ways_are_ranked_and_never_none() -> None:
    for query in (HOLES, asked(adjectives=("counterbored",)), PartQuery()):
        ways = ground(PLATE, query)
        assert ways
        assert all(isinstance(one, Part) for way in ways for one in way.parts)


def test_a_narrow_noun_may_mean_any_part_of_its_kind_where_the_words_place_it() -> None:
    seat = PartQuery(noun="bearing seat", words=("bearing", "seat"), definite=True)
    ways = ground(PLATE, seat)
    assert any("sense_wide" in way.features and ids(way) == {"hole-1", "hole-2", "hole-3"} for way in ways)


def test_a_word_before_a_noun_that_the_model_lacks_may_be_the_part() -> None:
    cutter = PartQuery(noun="pinion", words=("slot", "pinion"), plural=True)
    assert any("modifier_means" in way.features and ids(way) == {"slot-1"} for way in ground(PLATE, cutter))


def test_outer_cylinders_are_all_that_are_outer_and_no_inner_ones() -> None:
    walls = [part(f"cylinder-{n}", (n * 0.01, 0.0, 0.0), tags=("outer",)) for n in (1, 2, 3)]
    for there in (walls, [*walls, part("cylinder-4", tags=("inner",))]):
        assert [p.id for p in find(inventory(*there), "outer cylinder").parts] == [p.id for p in walls]


def test_an_upright_plate_may_be_an_upright_floor() -> None:
    floor, gusset = (part(f"{kind}-1", (0.0, 0.0, z), tags=("upright",)) for kind, z in (("floor", 0.0), ("wall", 0.1)))
    lying = part("floor-2", (0.1, 0.0, 0.0), tags=("lying",))
    found = find(inventory(floor, gusset, lying), "the vertical plates").parts
    assert [p.id for p in found] == ["floor-1", "wall-1"]


def sized_hole(number: int, diameter_mm: float, *steps_mm: float) -> Part:
    radii = tuple(size / 2e3 for size in (*steps_mm, diameter_mm))
    return hole(number, 10 * number, diameter=diameter_mm * 1e-3, radius=diameter_mm / 2e3, radii=radii)


@pytest.mark.parametrize(
    ("thread", "roles"),
    [
        ("m6", {1: "core of M6", 2: "tap drill of M6", 3: "nominal of M6", 4: "medium clearance of M6"}),
        ("m6x0.75", {3: "nominal of M6x0.75", 4: "medium clearance of M6x0.75"}),
        ("1/4-20", {5: "tap drill of 1/4-20"}),
        ("g1/4", {6: "tap drill of G1/4"}),
        ("1/4npt", {7: "tap drill of 1/4NPT"}),
        ("m8", {8: "medium clearance of M8"}),
    ],
)
def test_a_thread_finds_what_is_drawn_for_it_and_says_as_which(thread: str, roles: dict[int, str]) -> None:
    bores = ((1, 4.9175), (2, 5.0), (3, 6.0), (4, 6.6), (5, 5.1054), (6, 11.8), (7, 11.1125))
    holes = [*(sized_hole(n, d) for n, d in bores), sized_hole(8, 9.0, 16.0), sized_hole(9, 15.3)]
    found = best(asked(threads=(thread,)), inventory(*holes))
    assert {int(one.id.split("-")[1]): one.label.partition("; ")[2] for one in found.parts} == roles


def test_a_thread_that_nothing_is_drawn_for_keeps_nothing_unsaid() -> None:
    ways = ground(inventory(sized_hole(1, 15.3), sized_hole(2, 7.7)), asked(threads=("m6",)))
    assert all("'m6'" in way.unchecked for way in ways if way.parts)


def test_a_size_filter_means_any_step() -> None:
    holes = inventory(sized_hole(1, 9.0, 16.0), sized_hole(2, 12.0), sized_hole(3, 9.0, 14.0))
    for measure in (Measure.WIDTH, Measure.DIAMETER, None):
        wider = SizeFilter(measure=measure, relation=Relation.MORE, low=0.015)
        assert ids(best(asked(sizes=(wider,)), holes)) == {"hole-1"}


def test_a_body_without_the_tag_is_surely_not_symmetric() -> None:
    one, other = body(1, "left", tags=("solid", "symmetric")), body(2, "right", tags=("solid",))
    bodies = PartQuery(noun="body", words=("body",), plural=True, adjectives=("symmetric",))
    assert ids(best(bodies, inventory(one, other))) == {"body-1"}
    (only,) = ground(inventory(other, body(3, "top", tags=("solid",))), bodies)
    assert (only.parts, only.unchecked) == ((), ())


def test_that_nothing_is_so_large_is_sure_and_said() -> None:
    """A size is left out only where it may be a nominal one, or where the parts do not have it."""
    wide = asked(sizes=(SizeFilter(measure=Measure.WIDTH, relation=Relation.MORE, low=0.08),))
    made = inventory(*(hole(n, 20 * n, width=0.005) for n in (1, 2)))
    assert [way.parts for way in ground(made, wide)] == [()]
    assert find(made, wide).message == "no hole is wider than 80 mm; they have 5 mm"
    exact = asked(sizes=(SizeFilter(measure=Measure.DIAMETER, low=0.08),))
    assert any("size_dropped" in way.features for way in ground(PLATE, exact))


@pytest.mark.parametrize(
    ("query", "says"),
    [
        (asked(colors=("red",)), "no hole is red"),
        (asked(adjectives=("conical",)), "no hole is conical"),
        (asked(adjectives=("blind",), sizes=(SizeFilter(measure=Measure.DEPTH, relation=Relation.MORE, low=0.02),)),
         "no blind hole is deeper than 20 mm; they have 10 mm"),
        (asked(noun="gear", words=("gear",), colors=("red",)), "the model has no 'gear'"),
    ],
)  # fmt: skip
def test_what_restricts_is_named_where_nothing_is_so(query: PartQuery, says: str) -> None:
    none = next(number for number, way in enumerate(ground(PLATE, query)) if not way.parts)
    found = find(PLATE, query.model_copy(update={"sense": none}))
    assert not found.parts
    assert found.message == says


def test_a_query_is_grounded_once_a_model(monkeypatch: pytest.MonkeyPatch) -> None:
    made: list[PartQuery] = []
    grounds = grounding._ways

    def counted(known: Inventory, query: PartQuery, depth: int) -> list[Grounded]:
        made.append(query)
        return grounds(known, query, depth)

    monkeypatch.setattr(grounding, "_ways", counted)
    plate = inventory(*(part(f"hole-{number}", (0.01 * number, 0.0, 0.0)) for number in range(3)))
    asked = PartQuery(
        noun="hole",
        words=("hole",),
        plural=True,
        places=(Place(relation="in", what=PartQuery(noun="slot", words=("slot",), definite=True)),),
    )
    first = ground(plate, asked)
    again = asked.model_copy(update={"words": (), "sense": 2})  # as a program asks
    assert ground(plate, again) == first
    assert ground(plate, asked, limit=1) == first[:1]
    assert [query.noun for query in made] == ["hole", "slot"]
    assert ground(Inventory(plate.parts), asked) == first
    assert len(made) == 4  # another model is another one
    for count in range(2 * KEPT):
        ground(plate, asked.model_copy(update={"count": count, "places": ()}))
    assert len(plate.grounded) == KEPT


def test_what_the_speaker_points_to_may_be_the_model() -> None:
    model = inventory(whole(), body(1, "base"), body(2, "lid"), LARGE)
    pointed = PartQuery(noun="boss", words=("boss",), definite=True, deictic=True)
    assert any(way.parts and way.parts[0].kind == "model" for way in ground(model, pointed))
    plain = ground(model, pointed.model_copy(update={"deictic": False}))
    assert not any(way.parts and way.parts[0].kind == "model" for way in plain)
    placed = asked(places=(Place(relation="in", what=pointed),))
    assert any("place_whole" in way.features for way in ground(model, placed))


def test_what_is_outer_by_a_tag_is_not_what_is_inner() -> None:
    inner = [part(f"fillet-{i}", radius=0.002, tags=("rounded", "inner")) for i in (1, 2)]
    outer = [part(f"round-{i}", radius=0.005, tags=("rounded", "outer")) for i in (3, 4)]
    ways = ground(inventory(*inner, *outer), PartQuery(noun="fillet", adjectives=("outer",), plural=True))
    agreeing = [way for way in ways if "adjective_agrees" in way.features]
    assert agreeing
    assert all(one.kind == "round" for way in agreeing for one in way.parts)


def test_the_top_left_one_of_a_flat_plate_is_at_the_back() -> None:
    corners = [hole(n, x, y) for n, (x, y) in enumerate([(-20, -10), (20, -10), (-20, 10), (20, 10)], start=1)]
    query = PartQuery(noun="hole", words=("hole",), definite=True, ends=(Side.TOP, Side.LEFT))
    assert ids(best(query, inventory(*corners))) == {"hole-3"}
