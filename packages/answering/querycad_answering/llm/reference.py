"""The guest API as a prompt tells it: `querycad_contracts.guest_reference`, as short as it can be said."""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import cache

from querycad_contracts.guest_reference import GuestClass, GuestName, guest_api

BY_SIGHT = ("look", "picture")
"""Functions that need somebody who takes images."""


@cache
def attributes() -> dict[str, tuple[str, ...]]:
    """Which attributes and methods does each class have, but for the queries that the parser writes?"""
    return {kind.name: tuple(each.name for each in kind.members) for kind in guest_api().classes if not kind.is_query}


@cache
def functions() -> tuple[str, ...]:
    """Which names does a program find defined?"""
    api = guest_api()
    return tuple(each.name for each in (*api.variables, *api.functions))


@cache
def reference(tools: tuple[str, ...] = ()) -> str:
    """All classes, attributes and functions with their docstrings, as short as they can be said.

    Without the queries that the parser writes: words are shorter. `tools`: which functions of `BY_SIGHT` there is
    somebody for.
    """
    lines: list[str] = []
    for each in guest_api().names:
        if isinstance(each, GuestClass):
            base = f"({each.base})" if each.base else ""
            lines += [] if each.is_query else [f"class {each.name}{base}:{_comment(each)}", *_members(each.members)]
        elif each.name not in BY_SIGHT or each.name in tools:
            lines.append(f"{each.name} = {each.type}" if each.is_alias else _line(each))
    return "\n".join(lines)


def _members(members: Sequence[GuestName]) -> list[str]:
    """A class's attributes and methods; attributes of one type that need no words share a line."""
    lines: list[str] = []
    shared: list[str] = []
    shared_type = ""

    def close() -> None:
        if shared:
            lines.append(f"  {', '.join(shared)}: {_plain(shared_type)}")
            shared.clear()

    for each in members:
        alone = each.arguments is not None or bool(each.description)
        if alone or each.type != shared_type:
            close()
        if alone:
            lines.append(f"  {_line(each)}")
        else:
            shared.append(each.name)
        shared_type = each.type
    close()
    return lines


def _line(each: GuestName) -> str:
    return _plain(each.signature) + _comment(each)


def _plain(written: str) -> str:
    """Types without what only a type checker needs."""
    named = re.sub(r"'([A-Z]\w*)'", r"\1", written)
    return named.replace("str | PartQuery", "str").replace(" | None = None", " = None")


def _comment(each: GuestName | GuestClass) -> str:
    """What comes first of a docstring: its first sentence. The rest is for people."""
    first = re.split(r"(?<=[.?!])\s", " ".join(each.description.split()), maxsplit=1)[0].removesuffix(".")
    return f"  # {first}" if first else ""
