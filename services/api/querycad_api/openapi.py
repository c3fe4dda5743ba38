"""Writes openapi.yaml at the repository's root: `python -m querycad_api.openapi [FILE]`"""

from __future__ import annotations

import sys
from pathlib import Path

import yaml

from .app import make_app
from .settings import ApiSettings


class _Plain(yaml.SafeDumper):
    """Writes what is said twice twice, as people read it."""

    def ignore_aliases(self, _data: object) -> bool:
        return True


DEFAULT = Path(__file__).parents[3] / "openapi.yaml"


def openapi_yaml() -> str:
    """The interface's description as YAML; the same code gives the same text."""
    schema = make_app(ApiSettings()).openapi()
    return yaml.dump(schema, Dumper=_Plain, sort_keys=False, allow_unicode=True, width=120)


def main() -> None:
    """Writes the file."""
    path = Path(sys.argv[1]) if len(sys.argv) > 1 else DEFAULT
    path.write_text(openapi_yaml(), encoding="utf-8")


if __name__ == "__main__":
    main()
