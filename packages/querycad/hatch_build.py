"""What `pip install ./packages/querycad` needs to know: the other packages lie beside this one."""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

BESIDE = {
    "querycad-contracts": "packages/contracts",
    "querycad-language": "packages/language",
    "querycad-answering": "packages/answering",
    "querycad-api": "services/api",
    "querycad-segworker": "services/segworker",
    "querycad-sandbox": "services/llm_sandbox",
}
PIP = "PIP_BUILD_TRACKER"
"""Set by pip for what it builds. `make dist` builds with uv: its wheels name no folder."""


class TreeHook(BuildHookInterface[Any]):
    """Says where the packages are, to pip."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Called before a wheel is built; `version` is 'standard' or 'editable'."""
        del build_data
        if PIP in os.environ and version == "standard":
            for lines in (self.metadata.core.dependencies, *self.metadata.core.optional_dependencies.values()):
                lines[:] = [self._found(line) for line in lines]

    def _found(self, requirement: str) -> str:
        name = re.split(r"[^a-z-]", requirement)[0]
        folder = Path(self.root).parents[1] / BESIDE.get(name, "")
        return f"{requirement} @ {folder.as_uri()}" if name in BESIDE and folder.is_dir() else requirement
