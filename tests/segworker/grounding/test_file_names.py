"""The name of a file says what the whole is: by its head, not by what stands before that."""

from __future__ import annotations

import pytest
from tests.made import hole, inventory, whole

from querycad_contracts import PartQuery
from querycad_segworker.grounding.ground import ground


@pytest.mark.parametrize(
    ("name", "noun", "named"),
    [
        ("motor_bracket", "bracket", True),
        ("motor_bracket", "motor", False),
        ("BearingHousing-v2", "bearing", False),
        ("bearing_6204", "bearing", True),
        ("clamp_assembly", "clamp", True),
    ],
)
def test_a_noun_before_the_head_of_a_files_name_is_not_the_model(name: str, noun: str, named: bool) -> None:
    model = inventory(whole(name), hole(1))
    ways = ground(model, PartQuery(noun=noun, words=(noun,), definite=True))
    assert any("file_named" in way.features for way in ways) is named
