"""Which name of the guest API does a program mean by one that is none? For the type check and for hints to repairs."""

from __future__ import annotations

import tomllib
from collections.abc import Iterable, Mapping
from difflib import get_close_matches
from functools import cache
from importlib.resources import files

from .geometry import PartKind
from .guest_reference import guest_api

_NEAR = 0.6
"""Share of like letters from which a name is taken for a slip of the pen; difflib's own."""


def meant_attribute(of: str, name: str) -> str:
    """Which attribute or method of the class `of` is meant by a name that it has not? Empty where none is near."""
    return _meant(name, _members().get(of, ()), other_names()["attributes"])


def meant_function(name: str) -> str:
    """Which function or variable is meant by a name that is not defined? Empty where none is near."""
    api = guest_api()
    return _meant(name, [each.name for each in (*api.variables, *api.functions)], other_names()["functions"])


def meant_kind(name: str) -> PartKind | None:
    """Of which kind of part is this the name, in the singular or plural? `holes`: of holes. None of no kind."""
    singular = [name, *(name.removesuffix(end) for end in ("s", "es") if name.endswith(end))]
    return next((kind for kind in PartKind if kind.value in singular), None)


@cache
def other_names() -> Mapping[str, Mapping[str, tuple[str, ...]]]:
    """What are attributes and functions often called, under `attributes` and `functions` by their own names?"""
    return tomllib.loads(files(__package__).joinpath("guest_names.toml").read_text(encoding="utf-8"))


@cache
def _members() -> dict[str, tuple[str, ...]]:
    return {kind.name: tuple(each.name for each in kind.members) for kind in guest_api().classes}


def _meant(name: str, known: Iterable[str], others: Mapping[str, tuple[str, ...]]) -> str:
    known = tuple(known)
    called = [own for own, other in others.items() if name.lower() in other and own in known]
    return next(iter([*called, *get_close_matches(name, known, 1, _NEAR)]), "")
