"""The fitted weights that rank readings and groundings: `make fit` writes them, docs/understanding.md explains each."""

from __future__ import annotations

import tomllib
from functools import cache
from importlib.resources import files
from typing import Any

ALONE = "alone"  # the family of features whose first word no other has


@cache
def _table() -> dict[str, dict[str, Any]]:
    return tomllib.loads(files(__package__).joinpath("data").joinpath("weights.toml").read_text(encoding="utf-8"))


@cache
def weights() -> dict[str, float]:
    """The weight of each feature; a feature without one weighs nothing."""
    table: dict[str, float] = {}
    for name, weight in _table()["weights"].items():
        first = "" if name == ALONE else name
        table |= {"_".join(filter(None, (first, rest))): value for rest, value in weight.items()}
    for measure, groups in _table().get("measures", {}).items():
        for group, of in groups.items():
            table |= {f"{measure} {group} {name}": weight for name, weight in of.items()}
    return table


def calibration() -> dict[str, float]:
    """How a share of the probability becomes a confidence: weights of its log odds and of each doubt."""
    return _table().get("calibration", {})
