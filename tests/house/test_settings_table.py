"""docs/service.md tells of every setting, and of none that is not there."""

from __future__ import annotations

import re
from pathlib import Path

from querycad_api.settings import ApiSettings
from querycad_contracts.infrastructure import Settings
from querycad_sandbox.settings import SandboxSettings
from querycad_segworker.settings import SegworkerSettings

DOCUMENT = Path(__file__).parents[2] / "docs/service.md"
SERVICES: tuple[type[Settings], ...] = (ApiSettings, SandboxSettings, SegworkerSettings)


def rows() -> dict[str, str]:
    """The default that the document gives for each variable."""
    found: dict[str, str] = {}
    table = DOCUMENT.read_text(encoding="utf-8").partition("\n## Settings\n")[2]
    for line in table.splitlines():
        if line.startswith("| `QUERYCAD_"):
            names, defaults = line.split("|")[1:3]
            found |= dict(zip(re.findall(r"`(\w+)`", names), re.findall(r"`([^`]+)`", defaults), strict=True))
    return found


def test_every_setting_is_told_and_nothing_else() -> None:
    assert rows().keys() == {kind.variable(field) for kind in SERVICES for field in kind.model_fields}


def test_the_defaults_told_are_the_defaults() -> None:
    told = rows()
    told.pop("QUERYCAD_HOME")  # depends on the user
    for kind in SERVICES:
        read = kind.read(
            {
                name: value
                for name, value in told.items()
                if value != "unset" and name in {*map(kind.variable, kind.model_fields)}
            }
        )
        assert read == kind.read({})


def test_every_setting_is_described() -> None:
    undescribed = [name for kind in SERVICES for name, field in kind.model_fields.items() if not field.description]
    assert undescribed == []
