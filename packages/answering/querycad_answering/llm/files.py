"""The prompt's files, in a folder for each version."""

from __future__ import annotations

import tomllib
from functools import cache
from importlib.resources import files
from typing import Any

VERSION = "v1"
"""The folder of prompt files in use."""


def prompt_text(name: str) -> str:
    """What is in the file of this name?"""
    return files(__package__).joinpath("prompts", VERSION, name).read_text(encoding="utf-8")


@cache
def prompt_data(name: str) -> dict[str, Any]:
    """What is in the TOML file of this name?"""
    return tomllib.loads(prompt_text(name))
