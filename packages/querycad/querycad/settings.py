"""Where QueryCAD keeps its files, and how much it may use: from the environment."""

from __future__ import annotations

import os
from pathlib import Path


def home() -> Path:
    """Where are artefacts kept? `QUERYCAD_HOME`, else `querycad` in the user's cache folder (XDG base directories)."""
    chosen = os.environ.get("QUERYCAD_HOME")
    if chosen:
        return Path(chosen).expanduser()
    cache = os.environ.get("XDG_CACHE_HOME")
    return (Path(cache) if cache else Path.home() / ".cache") / "querycad"


def model_store() -> Path:
    """Where are the artefacts of known models?"""
    return home() / "models"


def weights_folder() -> Path:
    """Where are the weights of the vision path?"""
    return home() / "weights"
