"""What a program means by a name that the guest API has not."""

from __future__ import annotations

import pytest

from querycad_contracts import PartKind
from querycad_contracts.guest_names import meant_attribute, meant_function, meant_kind, other_names
from querycad_contracts.guest_reference import guest_api


def test_every_name_that_is_led_to_exists() -> None:
    api = guest_api()
    assert set(other_names()["attributes"]) <= {each.name for kind in api.classes for each in kind.members}
    assert set(other_names()["functions"]) <= {each.name for each in (*api.variables, *api.functions)}


@pytest.mark.parametrize(
    ("of", "name", "meant"),
    [
        ("Part", "position", "center"),
        ("Part", "diametre", "diameter"),
        ("Part", "mass", "volume"),
        ("Shape", "size", "extents"),
        ("Shape", "position", "center"),
        ("Face", "position", "center"),
        ("Part", "xyzzy", ""),
        ("Opening", "diameter", ""),
        ("tuple", "x", ""),
    ],
)
def test_an_attribute_is_meant_by_another_name_or_by_a_slip(of: str, name: str, meant: str) -> None:
    assert meant_attribute(of, name) == meant


def test_a_function_is_meant_by_another_name_and_none_by_an_unlike_one() -> None:
    assert [meant_function(name) for name in ("find_holes", "dist", "np")] == ["find_parts", "distance", ""]


def test_a_kind_is_meant_in_the_singular_and_plural_and_none_by_another_word() -> None:
    assert [meant_kind(name) for name in ("holes", "boss", "bosses", "s", "wombats")] == [
        PartKind.HOLE,
        PartKind.BOSS,
        PartKind.BOSS,
        None,
        None,
    ]
