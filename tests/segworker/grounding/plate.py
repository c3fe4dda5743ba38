"""A plate with three holes and a slot, made by hand, and queries about it."""

from __future__ import annotations

from typing import Any

from tests.made import hole, inventory, part

from querycad_contracts import Grounded, PartQuery, Side
from querycad_segworker.grounding.ground import ground
from querycad_segworker.grounding.inventory import Inventory

BLIND: dict[str, Any] = {"tags": ("blind", "circular", "vertical"), "sides": (Side.TOP,), "bottom": "flat"}
SMALL, LARGE, DEAD = hole(1, -20), hole(2, 0, diameter=0.012), hole(3, 20, **BLIND)
SLOT = part("slot-1", (0.03, 0.0, 0.0), width=0.004, length=0.02, depth=0.003, sides=(Side.TOP,), tags=("open",))
PLATE = inventory(SMALL, LARGE, DEAD, SLOT)
HOLES = PartQuery(noun="hole", words=("hole",), plural=True)


def best(query: PartQuery, of: Inventory = PLATE) -> Grounded:
    return ground(of, query)[0]


def ids(grounded: Grounded) -> set[str]:
    return {one.id for one in grounded.parts}


def asked(**fields: Any) -> PartQuery:
    return HOLES.model_copy(update=fields)
