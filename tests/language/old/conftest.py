"""The guest API in plain Python over the small fixed model of `bracket.json` (millimetres there, SI here).

It is strict about descriptions: a word that is no kind, tag or name of the model fails the program.
"""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

FILLER = frozenset(
    ["with", "in", "the", "of", "a", "an", "on", "and", "for", "its", "to", "by", "that", "at", "is", "are"]
)
POINTS = ("center", "opening", "tip", "extents", "min_corner", "max_corner")
LENGTHS = ("radius", "depth", "height", "width", "length", "thickness", "edge")
MILLI = 1e-3


SIDES = ("top", "bottom", "left", "right", "front", "back")


def _is_in(part: FakePart, holder: FakePart) -> bool:
    return all(
        abs(a - b) <= half + 1e-6 for a, b, half in zip(part.center, holder.center, holder.half_extents, strict=True)
    )


class Ungrounded(Exception):
    """A description holds a word that the model's vocabulary does not know."""


class FakePart:
    """A part of the bracket: its measures in SI, AttributeError for those it does not have."""

    if TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any: ...

    def __init__(self, values: dict[str, Any]) -> None:
        self.__dict__.update(_si(values))
        if "radius" in values:
            self.diameter = 2 * self.radius
        if "tip" in values:
            self.tips = [self.tip]
        self.half_extents = tuple(v / 2 for v in self.extents)
        self.name = values.get("name", "")
        self.faces = [object()] * 3

    def __repr__(self) -> str:
        return f"<{self.id}>"

    def distance_to(self, other: FakePart) -> float:
        gaps = (
            abs(a - b) - (e + f) / 2
            for a, b, e, f in zip(self.center, other.center, self.extents, other.extents, strict=True)
        )
        return math.hypot(*(max(gap, 0.0) for gap in gaps))

    def center_distance(self, other: FakePart) -> float:
        return math.dist(self.center, other.center)

    def angle_to(self, other: FakePart) -> float:
        a, b = (getattr(p, "axis", None) or p.normal for p in (self, other))
        return math.acos(min(1.0, abs(sum(x * y for x, y in zip(a, b, strict=True)))))

    def edge_distance(self) -> float:
        return float(self.edge)

    def is_in(self, other: FakePart) -> bool:
        return _is_in(self, other)


class FakeShape:
    """The bracket as a whole."""

    if TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any: ...

    def __init__(self, values: dict[str, Any], bodies: list[dict[str, Any]]) -> None:
        self.__dict__.update(_si(values))
        self.half_extents = tuple(v / 2 for v in self.extents)
        self.width, self.depth, self.height = self.extents
        self.bodies = [FakePart(body) for body in bodies]


class FakeGuest:
    """Names that a program sees, over the bracket."""

    def __init__(self) -> None:
        data = json.loads(Path(__file__).with_name("bracket.json").read_text())
        self.parts = [FakePart(values) for values in data["parts"]]
        self.shape = FakeShape(data["shape"], data["bodies"])
        self.synonyms: dict[str, str] = data["synonyms"]
        self.kinds = {p.kind for p in self.parts}
        self.names = {word.lower() for p in self.parts for word in p.name.split()}
        self.tags = {tag for p in self.parts for tag in p.tags}

    def run(self, code: str) -> Any:
        """What does `code` assign to `solution`?"""
        names: dict[str, Any] = {
            "shape": self.shape,
            "find_parts": self.find_parts,
            "distance": math.dist,
            "different": different,
            "close": close,
        }
        names["Part"] = FakePart
        exec(compile(code, "<program>", "exec"), names)  # noqa: S102 - the code under test
        return names["solution"]

    def find_parts(self, description: str, sides: list[str] | None = None) -> list[FakePart]:
        noun, _, place = (
            re.sub(r"^\d+ | (?:near|between) .*", "", description).replace(" on ", " in ").partition(" in ")
        )
        found = self._described(noun, sides)
        if not place or place in SIDES:
            return found
        side, _, rest = place.partition(" ")
        holders = self.find_parts(rest, [side]) if side in SIDES else self.find_parts(place)
        return [p for p in found if any(_is_in(p, q) for q in holders)]

    def _described(self, description: str, sides: list[str] | None) -> list[FakePart]:
        corner = description.startswith("corner ")
        wanted, unwanted = self._ground(description.removeprefix("corner "))
        if corner:
            return [p for p in self._described(description.removeprefix("corner "), sides) if self._is_cornered(p)]
        found = [p for p in self.parts if wanted <= self._words(p) and not unwanted & self._words(p)]
        if not wanted & (self.kinds | self.names):
            raise Ungrounded(f"no kind of part in {description!r}")
        return [p for p in found if sides is None or set(sides) & set(p.sides)]

    def _is_cornered(self, part: FakePart) -> bool:
        offsets = zip(part.center[:2], self.shape.center, self.shape.half_extents, strict=False)
        return all(abs(a - b) >= 0.5 * half for a, b, half in offsets)

    def _ground(self, description: str) -> tuple[set[str], set[str]]:
        text = description.lower().replace("bolt circle", "bolt_circle")
        wanted: set[str] = set()
        unwanted: set[str] = set()
        target = wanted
        for word in re.findall(r"[\w.-]+", text):
            if word in ("without", "no"):
                target = unwanted
                continue
            if word in FILLER:
                continue
            target.add(self._canonical(word.replace("bolt_circle", "bolt circle"), description, bool(wanted)))
        return wanted, unwanted

    def _canonical(self, word: str, description: str, later: bool) -> str:
        forms = (
            word,
            self.synonyms.get(word, ""),
            word.removesuffix("s"),
            self.synonyms.get(word.removesuffix("s"), ""),
        )
        known = [form for form in forms if form in self.kinds | self.names | self.tags]
        tags = [form for form in (word, *known) if form in self.tags]
        if later and tags:
            return tags[0]
        if not known:
            raise Ungrounded(f"{word!r} in {description!r}")
        return next((form for form in known if form in self.kinds | self.names), known[0])

    def _words(self, part: FakePart) -> set[str]:
        return {part.kind, *part.tags, *(word.lower() for word in part.name.split())}


@pytest.fixture(scope="session")
def guest() -> FakeGuest:
    """The bracket, as programs see it."""
    return FakeGuest()


@pytest.fixture(scope="session")
def same() -> Callable[[Any, Any], bool]:
    """Is what a program found what was stated?"""
    return is_same


def different(values: list[float], tolerance: float = 1e-6) -> list[float]:
    kept: list[float] = []
    for value in sorted(values):
        if not kept or value - kept[-1] > tolerance:
            kept.append(value)
    return kept


def close(a: float, b: float, tolerance: float = 5e-5) -> bool:
    return abs(a - b) <= tolerance


def is_same(found: Any, stated: Any) -> bool:
    """Is what a program found what was stated? Lists in any order but points (tuples), parts by id, numbers to 1e-6."""
    if isinstance(found, FakePart):
        return bool(found.id == stated)
    if isinstance(stated, bool) or isinstance(found, bool):
        return found is stated
    if isinstance(stated, (int, float)):
        return isinstance(found, (int, float)) and math.isclose(found, stated, rel_tol=1e-6, abs_tol=1e-9)
    if isinstance(stated, list):
        if not isinstance(found, (list, tuple)) or len(found) != len(stated):
            return False
        if isinstance(found, tuple):  # a point, a direction, a size
            return all(is_same(a, b) for a, b in zip(found, stated, strict=True))
        left = list(found)
        for value in stated:
            match = next((i for i, other in enumerate(left) if is_same(other, value)), None)
            if match is None:
                return False
            left.pop(match)
        return True
    return bool(found == stated)


def _si(values: dict[str, Any]) -> dict[str, Any]:
    si = dict(values)
    for key in LENGTHS:
        if key in si:
            si[key] = si[key] * MILLI
    for key in POINTS:
        if key in si:
            si[key] = tuple(v * MILLI for v in si[key])
    if "radius" in si:
        si["radii"] = [r * MILLI for r in si.get("radii", [values["radius"]])]
        si.setdefault("width", 2 * max(si["radii"]))
    for key, power in (("area", 2), ("volume", 3)):
        if key in si:
            si[key] = si[key] * MILLI**power
    return si
