"""Parts in rough steps: what they are, how large, where."""

from __future__ import annotations

from tests.made import hole, part, whole

from querycad_answering.part_traits import part_traits
from querycad_contracts import Grounded, Part

PLATE = whole(extents=(0.1, 0.06, 0.01))


def traits(*parts: Part) -> set[str]:
    return set(part_traits(Grounded(parts=parts, features={}), PLATE))


def test_a_hole_is_told_by_its_kind_its_size_and_its_place() -> None:
    told = traits(hole(1, x=-45, diameter=0.005))
    assert {"is hole", "is through", "bottom through", "number 0"} <= told
    assert {"diameter 2", "steps 1", "slender 3", "along z", "x 0", "y 2", "z 2", "sides 2"} <= told
    assert "central" not in told


def test_of_several_parts_what_they_share_counts() -> None:
    blind = hole(2, x=30, tags=("blind", "circular"), bottom="flat")
    told = traits(hole(1, x=-30), blind)
    assert {"is hole", "is circular", "number 1", "x several", "y 2", "bottom flat", "bottom through"} <= told
    assert not {"is through", "is blind"} & told
    assert "is mixed" in traits(hole(1), part("slot-1"))


def test_what_is_not_round_is_told_by_its_proportions() -> None:
    rib = part("rib-1", extents=(0.05, 0.002, 0.01), sides=("top",), normal=(0.0, 0.6, 0.8))
    told = traits(rib)
    assert {"flat 1", "long 3", "along none", "central", "sides 1", "side top"} <= told
    assert not any(trait.startswith(("diameter", "slender")) for trait in told)


def test_of_no_parts_that_alone_is_told() -> None:
    assert traits() == {"empty"}


def test_a_flat_model_and_a_point_divide_nothing_by_zero() -> None:
    point = part("face-1", extents=(0.0, 0.0, 0.0), radii=(0.0,))
    assert "x 0" in part_traits(Grounded(parts=(point,), features={}), whole(extents=(0.0, 0.0, 0.0)))
