"""What `parts` and `faces` are asked for, read strictly from a program's arguments, and applied: nothing is guessed."""

from __future__ import annotations

import json
import math
from collections import Counter
from collections.abc import Sequence
from enum import StrEnum
from typing import Final, TypeVar

from pydantic import ValidationError

from querycad_contracts import (
    Body,
    Convexity,
    Face,
    FaceQuery,
    Line,
    Part,
    PartKind,
    PartQuery,
    Side,
    SurfaceKind,
    Vector,
    as_drawn,
)

DESCRIPTION_CHARS: Final = 300
"""Longest description of a part; a phrase of a question has a few dozen characters."""
WORD_CHARS: Final = 40
"""Of a wrong word of the program's, in what is said of it."""
TOLD: Final = 30
"""Kinds or tags of the model told where another was asked for."""
WRONG: Final = 5
"""Fields told of a query that is none."""

W = TypeVar("W", bound=StrEnum)


def description_of(description: object) -> str | PartQuery:
    """The words or the query of a find_parts call. Raises TypeError and ValueError."""
    if isinstance(description, dict):
        try:
            return PartQuery.model_validate_json(json.dumps(description))
        except ValidationError as problem:
            wrong = "; ".join(f"{'.'.join(map(str, one['loc']))}: {one['msg']}" for one in problem.errors()[:WRONG])
            raise ValueError(f"find_parts() takes no such query: {wrong}") from None
        except (TypeError, ValueError) as problem:
            raise ValueError(f"find_parts() takes no such query: {str(problem)[:200]}") from None
    if not isinstance(description, str):
        raise TypeError("find_parts() takes a description as text, such as 'through hole', or a query as a dict")
    if not description.strip() or len(description) > DESCRIPTION_CHARS:
        raise ValueError(f"a description has 1 to {DESCRIPTION_CHARS} characters")
    return description.strip()


def sides_of(sides: object, function: str = "find_parts") -> tuple[Side, ...] | None:
    """The sides asked for, in the order of `Side`; None for every side. Raises TypeError and ValueError."""
    if sides is None:
        return None
    words = [sides] if isinstance(sides, str) else sides
    if not isinstance(words, (list, tuple, set, frozenset)) or not all(isinstance(word, str) for word in words):
        raise TypeError(f"{function}() takes its sides as a list such as ['top', 'left'], or None for every side")
    unknown = sorted(set(words) - set(Side))
    if unknown or not words:
        problem = f"no side is called {unknown[0][:WORD_CHARS]!r}" if unknown else "no side given"
        raise ValueError(f"{problem}: use {', '.join(Side)}")
    return tuple(side for side in Side if side in words)


def chosen_parts(known: Sequence[Part], kind: object, tags: object, side: object, diameter: object) -> list[Part]:
    """The parts that are so, in the order known. Raises TypeError and ValueError for what the model does not know."""
    wanted, sides = _kind(known, kind), sides_of(side, "parts")
    of_kind = [part for part in known if wanted is None or part.kind is wanted]
    all_tags = _tags(known, of_kind, tags)
    size = number_of(diameter, "diameter")
    return [
        part
        for part in of_kind
        if all_tags.issubset(part.tags)
        and (sides is None or not set(sides).isdisjoint(part.sides))
        and (size is None or any(as_drawn(one, size) for one in diameters(part)))
    ]


def diameters(part: Part) -> list[float]:
    """All diameters that a part is measured by: its own, and that of every step."""
    own = [] if part.diameter is None else [part.diameter]
    return own + [2 * radius for radius in (part.radius, *part.radii) if radius is not None]


def face_query(
    kind: object, convexity: object, facing: object, radius: object, coaxial_with: object, body: object
) -> FaceQuery:
    """The query of a faces call. Raises TypeError and ValueError."""
    return FaceQuery(
        kind=_word(SurfaceKind, kind, "kind"),
        convexity=_word(Convexity, convexity, "convexity"),
        facing=_word(Side, facing, "facing"),
        radius=number_of(radius, "radius"),
        coaxial_with=None if coaxial_with is None else axis_of(coaxial_with),
        body=_body(body),
    )


def axis_of(value: object) -> Line:
    """The axis of a part or face. Raises TypeError, and ValueError where it has none."""
    if not isinstance(value, Part | Face):
        raise TypeError("coaxial_with takes a part or a face")
    if value.axis is None:
        raise ValueError(f"{'part' if isinstance(value, Part) else 'face'} {value.id!r} has no axis")
    point = value.axis_point if isinstance(value, Face) else value.center
    return Line(point=point or value.center, direction=value.axis)


def center_of(value: object) -> Vector:
    """The point that `near` means. Raises TypeError."""
    if isinstance(value, Part | Face):
        return value.center
    if isinstance(value, list | tuple) and len(value) == 3 and all(isinstance(each, int | float) for each in value):
        return (float(value[0]), float(value[1]), float(value[2]))
    raise TypeError("near takes a part, a face or a point of three numbers")


def by_distance(parts: Sequence[Part], point: Vector) -> list[Part]:
    """The parts, those with the nearest centre first."""
    return sorted(parts, key=lambda part: math.dist(part.center, point))


def number_of(value: object, name: str) -> float | None:
    """A length above zero, or None. Raises TypeError and ValueError."""
    if value is None:
        return None
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise TypeError(f"{name} takes a length in metres")
    if not value > 0 or math.isinf(value):
        raise ValueError(f"{name} takes a length above 0")
    return float(value)


def call_text(function: str, **arguments: object) -> str:
    """The call as a person reads it, of the arguments that were given: "parts(kind='hole', side='top')"."""
    given = (f"{name}={_short(value)}" for name, value in arguments.items() if value is not None)
    return f"{function}({', '.join(given)})"


def _short(value: object) -> str:
    return str(value.id) if isinstance(value, Part | Face | Body) else repr(value)


def _kind(known: Sequence[Part], kind: object) -> PartKind | None:
    if kind is None:
        return None
    if not isinstance(kind, str):
        raise TypeError("kind takes a word such as 'hole'")
    if kind not in set(PartKind):
        there = Counter(part.kind.value for part in known)
        raise ValueError(f"no kind of part is called {kind[:WORD_CHARS]!r}; this model has {_most(there)}")
    return PartKind(kind)


def _tags(known: Sequence[Part], of_kind: Sequence[Part], tags: object) -> frozenset[str]:
    words = [tags] if isinstance(tags, str) else [] if tags is None else tags
    if not isinstance(words, list | tuple | set | frozenset) or not all(isinstance(word, str) for word in words):
        raise TypeError("tags takes a word or a list of words, such as ['through', 'counterbored']")
    unknown = sorted(set(words) - {tag for part in known for tag in part.tags})
    if unknown:
        there = Counter(tag for part in of_kind for tag in part.tags)
        raise ValueError(f"no part of this model has the tag {unknown[0][:WORD_CHARS]!r}; there are {_most(there)}")
    return frozenset(words)


def _word(words: type[W], value: object, name: str) -> W | None:
    if value is None:
        return None
    if not isinstance(value, str):
        raise TypeError(f"{name} takes a word")
    if value not in set(words):
        raise ValueError(f"no {name} is called {value[:WORD_CHARS]!r}: use {', '.join(words)}")
    return words(value)


def _body(body: object) -> int | None:
    if isinstance(body, Body):
        return body.id
    if body is None or (isinstance(body, int) and not isinstance(body, bool)):
        return body
    raise TypeError("body takes one of shape.bodies, or its id")


def _most(there: Counter[str]) -> str:
    return ", ".join(name for name, _ in there.most_common(TOLD)) or "none"
