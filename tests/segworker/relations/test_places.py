"""Where parts are: of many places few pairs are looked at, and the same is found as of all pairs."""

from __future__ import annotations

import itertools
import random
from collections.abc import Callable, Sequence
from functools import cache
from pathlib import Path

import pytest
from tests.made import hole, part, whole

from querycad_contracts import Part
from querycad_contracts.places import RING_M, TOUCH_M, carries, is_inside
from querycad_segworker.ingest import ingest
from querycad_segworker.model import ModelStore
from querycad_segworker.relations.between import lying_between
from querycad_segworker.relations.nearby import Nearby, to_nearest
from querycad_segworker.relations.places import coaxial, encloses, surrounding, touches
from querycad_segworker.relations.related import related
from querycad_segworker.relations.roles import ROLES, Kinds
from querycad_segworker.vectors import dot, norm, sub

EXAMPLES = [Path(__file__).parents[3] / f"examples/{name}.step" for name in ("bearing_assembly", "bracket", "housing")]
RELATIONS = ("in", "on", "of", "", "with", "near", "through", "around", "left", "opposite", "between")
SOME = 70
"""More than the places whose pairs are all looked at."""


def test_pairs_of_a_tree_hold_all_that_meet_lie_in_or_are_carried() -> None:
    for seed in range(3):
        parts = scattered(seed)
        near = {one.id: {other.id for other in some} for one, some in Nearby(parts).pairs(parts, parts)}
        for a, b in itertools.product(parts, parts):
            assert b.id in near[a.id] or not (touches(a, b) or is_inside(a, b) or carries(b, a)), (a.id, b.id)


@pytest.mark.parametrize("relation", RELATIONS)
def test_parts_at_scattered_places_are_those_of_all_pairs(relation: str) -> None:
    for seed in range(2):
        assert_like_all_pairs(scattered(seed), relation)


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_parts_of_the_examples_are_those_of_all_pairs(path: Path, tmp_path: Path) -> None:
    parts = ingest(path, ModelStore(tmp_path)).load_model().parts
    for relation in RELATIONS:
        assert_like_all_pairs(parts, relation)


def test_three_and_more_stand_around_the_axis_that_their_middle_is_on() -> None:
    middle = hole(1, diameter=0.03)
    ring = [hole(2, 20), hole(3, -20), hole(4, 0, 20), hole(5, 0, -20)]
    assert surrounding([middle, *ring, hole(6, 40)], middle) == ring
    assert surrounding([hole(2, 20), hole(3, -20)], middle) == []  # beside it
    assert surrounding([hole(2, 20), hole(3, 0, 20), hole(4, 12, 16)], middle) == []  # on one side of it
    assert surrounding(ring, part("slot-1")) == []  # around no axis
    odd = [hole(2, 20.05), hole(3, -20.05 - 1e-9), hole(4, 0, 20.05 + 1e-9), hole(5, 0, -20.05)]
    assert surrounding(odd, middle) == odd  # as far from it but for rounding


def test_in_a_body_is_what_has_faces_of_it_whatever_its_box_holds() -> None:
    body = part("body-1", extents=(0.1, 0.1, 0.01), faces=(1, 2, 3))
    assert is_inside(hole(1, faces=(2,)), body)
    assert is_inside(hole(2, faces=(3, 9)), body)  # through two bodies
    assert not is_inside(hole(3, faces=(7,)), body)  # in the middle of its box, in another body
    assert is_inside(part("body-2", faces=(7,)), body)  # a body in a body shares no face with it


def test_in_a_ring_is_what_reaches_into_its_wall_or_lies_on_its_axis() -> None:
    ring = part("boss-1", extents=(0.1, 0.1, 0.01), axis=(0.0, 0.0, 1.0), radius=0.05, radii=(0.03, 0.05))
    assert is_inside(hole(1, 40), ring)
    assert is_inside(hole(2, diameter=0.06), ring)  # its bore
    assert not is_inside(hole(3, 15), ring)  # within the bore
    assert not is_inside(hole(4, 45, 45), ring)  # in a corner of its box


def test_next_to_is_what_meets_else_what_is_nearest() -> None:
    slot, close, far = part("slot-1"), hole(1, 30), hole(2, 60)
    assert related([close, far], "near", [slot], Nearby([slot, close, far])) == [close]
    touching = hole(3, 5)
    assert related([touching, close], "near", [slot], Nearby([slot, close, touching])) == [touching]


def assert_like_all_pairs(parts: Sequence[Part], relation: str) -> None:
    """Each kind of part against each, and all against all."""
    kinds = [[one for one in parts if one.kind == kind] for kind in dict.fromkeys(one.kind for one in parts)]
    nearby = Nearby(parts)
    for found, holders in [*itertools.product(kinds, kinds), (parts, parts)]:
        own = [one.id for one in related(found, relation, holders, nearby)]
        assert own == [one.id for one in of_all_pairs(found, relation, holders)], (found[0].kind, holders[0].kind)


def of_all_pairs(found: Sequence[Part], relation: str, holders: Sequence[Part]) -> list[Part]:  # noqa: C901, PLR0911
    """Part by part and place by place, whatever lies where."""

    def those(holds: Callable[[Part, Part], bool], some: Sequence[Part] = found) -> list[Part]:
        return [p for p in some if any(holds(p, h) for h in holders)]

    ids = {h.id for h in holders}
    raised = ("boss", "protrusion", "elevation", "prism", "rib", "body")

    def made_of(p: Part, h: Part) -> bool:
        standing = p.kind in (*raised, "cylinder") and h.kind in raised[:-1]
        return relation == "on" and standing and set(p.faces) <= set(h.faces)

    def held() -> list[Part]:
        if carried := those(lambda p, h: carries(h, p) and not made_of(p, h)):
            return carried
        standing = [p for p in found if relation == "on" and p.kind in (*raised, "cylinder")]
        if on := those(lambda p, h: touches(p, h) and not is_inside(p, h), standing):
            return on
        inside = those(lambda p, h: is_inside(p, h) or (p.kind == "pattern" and h.id in p.children))
        beside = all(p.kind in (*raised, "fillet", "round", "chamfer") for p in found)
        return inside or (next_to() if beside else [])

    def next_to(some: Sequence[Part] = found) -> list[Part]:
        return those(lambda p, h: h.id != p.id and touches(p, h), some)

    match relation:
        case "with":
            return those(lambda p, h: h.id != p.id and is_inside(h, p)) or next_to()
        case "near":
            others = [p for p in found if p.id not in ids]
            gaps = [min(norm(sub(p.center, h.center)) for h in holders) for p in others]
            return next_to() or [p for p, gap in zip(others, gaps, strict=True) if gap <= min(gaps) + RING_M]
        case "between":
            apart = [p for p in found if p.id not in ids and lies_between(p, holders)]
            able = [
                p for p in found if p.kind in ("rib", "wall", "bend", "fillet", "round", "chamfer") and p.id not in ids
            ]
            meeting = [p for p in able if sum(touches(p, h) for h in holders) > 1]
            return [p for p in apart if lies_between(p, holders, whole=True)] or apart or meeting
        case "around":
            ring = {p.id for h in holders for p in surrounding(found, h)}
            edges = [p for p in found if p.kind in ("fillet", "round", "chamfer")]
            return those(encloses) or next_to(edges) or [p for p in found if p.id in ring]
        case "left":
            return those(lambda p, h: h.id != p.id and h.center[0] - p.center[0] > 5e-5)
        case "opposite":
            return those(lambda p, h: bool(p.normal and h.normal) and dot(p.normal, h.normal) < -0.9)  # type: ignore[arg-type]
        case "through":
            return held() or those(touches)
        case "":
            return held() or those(lambda p, h: coaxial(p, h) and touches(p, h)) or next_to()
        case _:
            return held() or those(lambda p, h: h.id in p.children)


def lies_between(one: Part, others: Sequence[Part], whole: bool = False) -> bool:
    for a, b in itertools.combinations(others, 2):
        apart, ahead = sub(b.center, a.center), sub(one.center, a.center)
        length = norm(apart)
        reach = sum(e * abs(c) for e, c in zip(one.extents, apart, strict=True))
        if length < TOUCH_M or not 0.0 < dot(ahead, apart) < length**2 or (whole and reach > length**2):
            continue
        if all(
            min(a.center[i] - a.extents[i] / 2, b.center[i] - b.extents[i] / 2) - TOUCH_M
            <= one.center[i]
            <= max(a.center[i] + a.extents[i] / 2, b.center[i] + b.extents[i] / 2) + TOUCH_M
            for i in range(3)
        ):
            return True
    return False


@pytest.mark.parametrize("whole", [False, True])
def test_what_lies_between_many_is_what_lies_between_two_of_them(whole: bool) -> None:
    for seed, step in itertools.product(range(3), (0.0, 0.01)):
        places = scattered(seed, step)
        walls = [one.model_copy(update={"extents": (0.05, 0.002, 0.05)}) for one in scattered(seed + 10, step, 0.07)]
        own = {one.id for one in lying_between(walls, places, whole)}
        assert own == {one.id for one in walls if lies_between(one, places, whole)}
        assert 0 < len(own) < len(walls)


def test_the_nearest_place_is_the_nearest_of_all() -> None:
    parts, places = scattered(1), scattered(2)
    nearest = to_nearest(places)
    assert [nearest(one) for one in parts] == [min(norm(sub(one.center, p.center)) for p in places) for one in parts]


@cache
def scattered(seed: int, step: float = 0.005, reach: float = 0.05) -> tuple[Part, ...]:
    """Boxes of many sizes, with centres on a grid where there is a step, so that some only just meet."""
    of = random.Random(seed)
    kinds = ("hole", "boss", "slot", "pattern", "cylinder", "rib", "body", "fillet")

    def at() -> tuple[float, float, float]:
        x, y, z = (of.uniform(-reach, reach) for _ in range(3))
        return (round(x / step) * step, round(y / step) * step, round(z / step) * step) if step else (x, y, z)

    parts = []
    for number in range(SOME):
        radius = of.choice((None, 0.002, 0.003, 0.005))
        center, axis = at(), of.choice(((1.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.0, 0.0, -1.0)))
        parts.append(
            part(
                f"{of.choice(kinds)}-{number}",
                center,
                extents=tuple(of.choice((0.0, 0.005, 0.01, 0.03)) for _ in range(3)),
                faces=tuple(sorted(of.sample(range(60), of.choice((0, 1, 1, 2, 20)) if number % 9 == 0 else 1))),
                children=tuple(f"hole-{of.randrange(SOME)}" for _ in range(of.choice((0, 0, 0, 3)))),
                opening=of.choice((None, at())),
                axis=axis,
                normal=axis,
                radius=radius,
            )
        )
    return tuple(parts)


def test_inner_faces_look_towards_the_middle_of_the_model_and_outer_ones_away() -> None:
    left, right = (-1.0, 0.0, 0.0), (1.0, 0.0, 0.0)
    inner, outer = part("face-1", (-0.03, 0.0, 0.0), normal=right), part("face-2", (-0.04, 0.0, 0.0), normal=left)
    middle, bore = part("face-3", (0.0, 0.0, 0.0), normal=right), hole(1, -30, normal=right)
    kinds = Kinds((whole(), inner, outer, middle, bore))
    told = {
        role: [one.id for one in (inner, outer, middle, bore) if ROLES[role](one, kinds)] for role in ("inner", "outer")
    }
    assert told == {"inner": ["face-1"], "outer": ["face-2"]}
