"""Several that a phrase says may be one: whoever writes a program does not know how many there are."""

from __future__ import annotations

import pytest
from tests.made import body, hole, inventory, part

from querycad_segworker.grounding.find import find
from querycad_segworker.grounding.inventory import Inventory

PLATE = body(1, "plate", faces=(1, 2, 3, 10))
NUT = body(2, "nut", faces=(20, 4))
JOINED = inventory(PLATE, NUT, *(hole(number, 10.0 * number) for number in (1, 2, 3, 4)))
POCKETED = inventory(part("pocket-1", depth=0.003, bottom="flat"), hole(1, -20), hole(2, 20))


def found(of: Inventory, phrase: str) -> list[str]:
    return [one.id for one in find(of, phrase).parts]


@pytest.mark.parametrize(("one", "several"), [("hole in the nut", "holes in the nut"), ("nut", "nuts")])
def test_what_is_one_is_found_by_a_word_for_several(one: str, several: str) -> None:
    assert found(JOINED, several) == found(JOINED, one)
    assert len(found(JOINED, one)) == 1


def test_several_are_all_of_them() -> None:
    assert found(JOINED, "holes in the plate") == ["hole-1", "hole-2", "hole-3"]
    assert found(JOINED, "holes") == ["hole-1", "hole-2", "hole-3", "hole-4"]


def test_one_pocket_is_the_pockets_though_there_are_several_holes() -> None:
    assert found(POCKETED, "pockets") == found(POCKETED, "pocket") == ["pocket-1"]
    assert found(POCKETED, "holes") == ["hole-1", "hole-2"]
