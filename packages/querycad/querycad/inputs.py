"""What callers give: names of a closed set, one where several may be given, parameters in each of their forms."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from difflib import get_close_matches
from enum import StrEnum
from typing import Any, TypeAlias, TypeVar

from querycad_contracts import ParameterRequest, ParametersRequest

E = TypeVar("E", bound=StrEnum)
T = TypeVar("T", bound=str)
Parameters: TypeAlias = ParametersRequest | Mapping[str, Any] | Sequence[ParameterRequest | Mapping[str, Any]]
"""A whole request, its fields, or its parameters alone."""


def named(kind: type[E], given: str, what: str) -> E:
    """The member of this name. Raises ValueError, which says which `what` there are."""
    try:
        return kind(given)
    except ValueError:
        names = [each.value for each in kind]
        near = get_close_matches(str(given).lower(), names, 1)
        meant = f", perhaps {near[0]!r} is meant" if near else ""
        raise ValueError(f"{given!r} is no {what}{meant}; there are {', '.join(names)}") from None


def listed(given: T | Sequence[T]) -> tuple[T, ...]:
    """Several texts, or the only one."""
    return (given,) if isinstance(given, str) else tuple(given)


def request_fields(asked: Parameters) -> dict[str, Any]:
    """The fields of a request for parameters, those that were set."""
    if isinstance(asked, ParametersRequest):
        return {name: getattr(asked, name) for name in asked.model_fields_set}
    return dict(asked) if isinstance(asked, Mapping) else {"parameters": asked}
