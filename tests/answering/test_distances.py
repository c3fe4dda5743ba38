"""Distances of one part between its own centres, and along the level that parts lie on."""

from __future__ import annotations

import pytest
from tests.made import hole, part, whole

from querycad_answering.programs import Unwritable, write
from querycad_contracts import PartQuery
from querycad_language.forms import HORIZONTAL, VERTICAL, Distance

ARM = PartQuery(noun="arm", definite=True)
HOLES = PartQuery(noun="hole", plural=True)


def test_one_part_has_a_distance_between_its_own_centres_and_no_gap() -> None:
    grounds = {ARM: ((part("prism-1", center_length=0.08),), 0)}
    assert "p.center_length" in write(Distance(ARM, "each other", "centers"), grounds, whole()).code
    for mode in ("surfaces", "usual"):
        with pytest.raises(Unwritable):
            write(Distance(ARM, "each other", mode), grounds, whole())
    with pytest.raises(Unwritable):
        write(Distance(ARM, "each other", "centers"), {ARM: ((part("prism-1"),), 0)}, whole())


def test_vertical_is_along_y_on_one_level_and_along_z_otherwise() -> None:
    level = (hole(1), hole(2, 20.0), hole(3, 0.0, 30.0))
    wall = (part("hole-1"), part("hole-2", (0.02, 0.0, 0.0)), part("hole-3", (0.0, 0.0, 0.03)))
    for holes, across, up in ((level, 0, 1), (wall, 0, 2)):
        for axis, along in ((HORIZONTAL, across), (VERTICAL, up)):
            code = write(Distance(HOLES, "each other", "centers", axis), {HOLES: (holes, 0)}, whole()).code
            assert f"a.center[{along}] - b.center[{along}]" in code
