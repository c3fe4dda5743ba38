"""The fitted weights that rank readings and groundings: `make fit` writes them, docs/understanding.md explains each."""

from __future__ import annotations

import tomllib
from functools import cache
from importlib.resources import files
from pathlib import Path


def weights_file() -> Path:
    """Where the table lies in a checkout."""
    return Path(str(files(__package__).joinpath("data").joinpath("weights.toml")))


@cache
def _table() -> dict[str, dict[str, float]]:
    return tomllib.loads(files(__package__).joinpath("data").joinpath("weights.toml").read_text(encoding="utf-8"))


_used: dict[str, float] | None = None


def weights() -> dict[str, float]:
    """The weight of each feature; a feature without one weighs nothing."""
    if _used is not None:
        return _used
    return _table()["weights"]


def calibration() -> dict[str, float]:
    """How a share of the probability becomes a confidence: weights of its log odds and of each doubt."""
    return _table().get("calibration", {})


def use(table: dict[str, float] | None) -> None:
    """Ranks with these weights from now on, for fitting; None: the ones in the repository."""
    global _used  # noqa: PLW0603 - fitting tries many tables in one process
    _used = table
