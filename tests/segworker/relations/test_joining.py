"""What joins two parts in their corner is between them."""

from __future__ import annotations

from tests.made import inventory, part

from querycad_segworker.grounding.find import find

BASE = part("prism-1", (0.035, 0.0, 0.003), extents=(0.07, 0.04, 0.006), tags=("plate", "rectangular", "grounded"))
LEG = part("wall-1", (0.0025, 0.0, 0.032), extents=(0.005, 0.04, 0.055), tags=("planar", "upright", "leg"))


def test_a_gusset_in_the_corner_of_a_base_and_an_upright_is_between_them_and_one_beside_is_not() -> None:
    tags = ("gusset", "planar", "upright")
    joins, beside = (part("rib-1", (x, 0.0, 0.0114), extents=(0.02, 0.004, 0.02), tags=tags) for x in (0.0104, 0.05))
    asked = "gussets between the base and the upright"
    assert not find(inventory(BASE, LEG, joins), asked).unchecked
    assert find(inventory(BASE, LEG, beside), asked).unchecked
