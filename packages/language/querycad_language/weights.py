"""The fitted weights that rank readings and groundings: `make fit` writes them, docs/understanding.md explains each."""

from __future__ import annotations

import tomllib
from functools import cache
from importlib.resources import files
from typing import Any

ALONE = "alone"
"""The family of features whose first word no other has."""


@cache
def _table() -> dict[str, dict[str, Any]]:
    return tomllib.loads(files(__package__).joinpath("data").joinpath("weights.toml").read_text(encoding="utf-8"))


@cache
def _fitted() -> dict[str, float]:
    table: dict[str, float] = {}
    for name, weight in _table()["weights"].items():
        first = "" if name == ALONE else name
        table |= {"_".join(filter(None, (first, rest))): value for rest, value in weight.items()}
    for measure, groups in _table().get("measures", {}).items():
        for group, of in groups.items():
            table |= {f"{measure} {group} {name}": weight for name, weight in of.items()}
    return table


_used: dict[str, float] | None = None


def weights() -> dict[str, float]:
    """The weight of each feature; a feature without one weighs nothing."""
    if _used is not None:
        return _used
    return _fitted()


def calibration() -> dict[str, float]:
    """How a share of the probability becomes a confidence: weights of its log odds and of each doubt."""
    return _table().get("calibration", {})


def use(table: dict[str, float] | None) -> None:
    """Ranks with these weights from now on, for fitting; None: the ones in the repository."""
    global _used  # noqa: PLW0603 - fitting tries many tables in one process
    _used = table
