"""Where QueryCAD keeps its files, and how much it may use: from the environment."""

from __future__ import annotations

import os
from pathlib import Path

from querycad_contracts.infrastructure.settings import default_home


def home() -> Path:
    """Where are artefacts kept? `QUERYCAD_HOME`, else `querycad` in the user's cache folder (XDG base directories)."""
    chosen = os.environ.get("QUERYCAD_HOME")
    return Path(chosen).expanduser() if chosen else default_home()


def model_store() -> Path:
    """Where are the artefacts of known models?"""
    return home() / "models"


def weights_folder() -> Path:
    """Where are the weights of the vision path?"""
    return home() / "weights"
