"""How thick are the walls of the bodies of an assembly?"""

from __future__ import annotations

import pytest
from tests.segworker.shapes import box, compound, cut, find


def test_each_body_of_an_assembly_has_the_thickness_of_its_own_walls() -> None:
    case = cut(box((80, 60, 30)), box((74, 54, 27.1), (3, 3, 3)))
    foot = box((10, 10, 10), (5, 5, -10))
    bodies = [part for part in find(compound(case, foot)).parts if part.kind == "body"]
    assert bodies[0].thickness == pytest.approx(0.003)
    assert bodies[1].thickness is None
