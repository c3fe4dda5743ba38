"""Which attributes does a part have by what it is to others: a radial hole, the flange of a tube?"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING

from querycad_contracts import Part, PartKind, Side, Vector
from querycad_contracts.places import TOUCH_M
from querycad_segworker.vectors import cross, dot, line_distance, norm, sub, unit

from .places import touches

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

_SQUARE = 1e-2
"""Cosine of what is still a right angle: half a degree."""
_NEAR = 0.05
"""Axes meet, and lie on one line, that pass nearer than this share of the smaller radius or extent."""


class Kinds:
    """All parts of a model by their kind."""

    def __init__(self, parts: Sequence[Part]) -> None:
        self._by_kind: dict[str, list[Part]] = {}
        self._roles: dict[tuple[str, str], bool] = {}
        for part in parts:
            self._by_kind.setdefault(part.kind, []).append(part)

    def get(self, *kinds: str) -> list[Part]:
        """The parts of these kinds."""
        return [part for kind in kinds for part in self._by_kind.get(kind, ())]

    def plays(self, part: Part, role: str) -> bool:
        """Does the part play one of ROLES among them?"""
        if (part.id, role) not in self._roles:
            self._roles[part.id, role] = ROLES[role](part, self)
        return self._roles[part.id, role]

    @cached_property
    def turned(self) -> tuple[NDArray[np.float64], ...]:
        """Bosses and holes: centres, axes and extents, (N, 3) float64 each, and radii, (N,) float64. Metres."""
        import numpy as np  # a tenth of a second, for the one word that asks for this

        found = [part for part in self.get("boss", "hole") if part.axis and part.radius]
        rows = [[part.center, part.axis, part.extents] for part in found]
        center, axis, extents = np.array(rows, dtype=np.float64).reshape(-1, 3, 3).transpose(1, 0, 2)
        return center, axis, extents, np.array([part.radius for part in found], dtype=np.float64)


_CUT = (PartKind.SLOT, PartKind.POCKET, PartKind.CUTOUT, PartKind.NOTCH, PartKind.CHANNEL)

_LONG = 1.5
"""A model has a length of its own where it is that many times as long as it is wide."""
_DOWELS_M = tuple(1e-3 * size for size in (1, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10, 12, 16, 20, 25, 30))
"""Diameters of dowel pins: ISO 8734 and ISO 2338."""
_REAMED_M = 0.03e-3
"""Widest fit that a dowel hole is drawn with: more than H8 up to 30 mm."""
_SCREWS_APART = 3.0
"""Diameters from one screw hole to the next, at least: EN 1993-1-8, table 3.3, asks for 2.2, and 3 is usual."""


def is_radial(hole: Part, kinds: Kinds) -> bool:
    """Does a hole run square to the axis of a wider round part or bore that it lies in, and through that axis?"""
    if hole.kind != "hole" or hole.axis is None or not hole.radius:
        return False
    import numpy as np

    center, axis, extents, radius = kinds.turned
    apart, along = center - np.asarray(hole.center), np.asarray(hole.axis)
    wider = (radius > hole.radius) & (np.abs(axis @ along) <= _SQUARE)
    touching = (np.abs(apart) <= (extents + np.asarray(hole.extents)) / 2 + TOUCH_M).all(axis=1)
    meeting = np.abs((apart * np.cross(along, axis)).sum(axis=1)) <= _NEAR * hole.radius
    return bool((wider & touching & meeting).any())


def is_across(hole: Part, kinds: Kinds) -> bool:
    """Does a hole run square to the length of a model that is clearly longer than it is wide, as a cross hole does?"""
    whole = next(iter(kinds.get("model")), None)
    if whole is None or hole.axis is None:
        return False
    *_, second, longest = sorted(whole.extents)
    along = whole.extents.index(longest)
    return longest >= _LONG * second and abs(hole.axis[along]) <= _SQUARE


def is_dowel_size(hole: Part, _: Kinds) -> bool:
    """Does a dowel pin fit a hole exactly? Clearance and tap drill holes are rarely of a pin's size."""
    return hole.diameter is not None and any(abs(hole.diameter - pin) <= _REAMED_M for pin in _DOWELS_M)


def is_flange(plate: Part, kinds: Kinds) -> bool:
    """Is a plate, of any outline, bolted on around a round part that stands on it, as a tube's flange is?"""
    flat = plate.kind == "prism" and "plate" in plate.tags
    return flat and any(_bolts_on(plate, pattern, kinds) for pattern in kinds.get("pattern"))


def is_holed(part: Part, kinds: Kinds) -> bool:
    """Does it carry a hole, as an ear or lug does?"""
    carried = set(part.children)
    return bool(carried) and any(hole.id in carried for hole in kinds.get("hole"))


def is_tight(hole: Part, kinds: Kinds) -> bool:
    """Is a hole one of a row or grid that leaves no room for heads of screws: for the pins of a header, or air?"""
    return any(
        hole.id in pattern.children
        and pattern.pitch is not None
        and hole.diameter is not None
        and pattern.pitch < _SCREWS_APART * hole.diameter
        for pattern in kinds.get("pattern")
    )


def is_lone(arc: Part, kinds: Kinds) -> bool:
    """Is an arc none of the round ends of a slot or pocket?"""
    faces = set(arc.faces)
    return arc.kind == "arc" and not any(faces < set(part.faces) for part in kinds.get(*_CUT))


def is_along(axis: int) -> Callable[[Part, Kinds], bool]:
    """Is a part's axis, or the direction in which it is cut in, parallel to x, y or z?"""

    def holds(part: Part, _: Kinds) -> bool:
        way = part.axis or part.normal
        return way is not None and abs(way[axis]) >= 1 - _SQUARE**2

    return holds


def is_coaxial(hole: Part, kinds: Kinds) -> bool:
    """Does another part of its kind lie on the same axis?"""
    if hole.axis is None:
        return False
    return any(
        norm(cross(part.axis, hole.axis)) <= _SQUARE
        and line_distance(part.center, hole.center, hole.axis) <= _NEAR * min(part.radius or 0, hole.radius or 0)
        for part in kinds.get(hole.kind)
        if part is not hole and part.axis is not None
    )


def is_right_through(cut: Part, kinds: Kinds) -> bool:
    """Does a cut come out on the other side: through both walls of a ring, where it meets the wider bore?

    What meets none goes right through where it goes through. One cut in each wall, alike and in line, do so together.
    """
    way, half = cut.axis or cut.normal, (cut.diameter or cut.width or 0.0) / 2
    if way is None or not cut.kind.cuts_in:
        return False
    wider = [bore for bore in kinds.get("hole") if bore is not cut and (bore.radius or 0.0) > half]
    met = [bore for bore in wider if _meets(cut, way, bore)]
    if not met:
        return "through" in cut.tags
    return all(_passes(cut, way, bore, kinds) for bore in met)


def _meets(cut: Part, way: Vector, bore: Part) -> bool:
    """Does it run into a bore that is not parallel to it, by its line and the boxes?"""
    if bore.axis is None or norm(square := cross(way, bore.axis)) <= _SQUARE:
        return False
    apart = abs(dot(sub(cut.center, bore.center), unit(square)))
    return apart < (bore.radius or 0.0) and _boxes_touch(cut, bore)


def _passes(cut: Part, way: Vector, bore: Part, kinds: Kinds) -> bool:
    """Is it, or another one in line that is as wide, on the far side of the bore's axis, too?"""
    beyond = dot(sub(bore.center, cut.center), way)
    if "through" in cut.tags and abs(beyond) < (cut.depth or 0.0) / 2:
        return True
    size = cut.diameter or cut.width or 0.0
    return any(
        abs((twin.diameter or twin.width or 0.0) - size) <= _NEAR * size
        and line_distance(twin.center, cut.center, way) <= _NEAR * size
        and dot(sub(bore.center, twin.center), way) * beyond < 0.0
        for twin in kinds.get(cut.kind)
    )


def is_crossing(hole: Part, kinds: Kinds) -> bool:
    """Does a hole take the same room as another one that is not parallel to it?"""
    others = (part for part in kinds.get("hole") if part is not hole)
    return hole.kind == "hole" and any(_cross(hole, part) for part in others)


def _cross(one: Part, other: Part) -> bool:
    """By their axes, radii and boxes."""
    if one.axis is None or other.axis is None or one.radius is None or other.radius is None:
        return False
    if norm(cross(one.axis, other.axis)) <= _SQUARE:
        return False
    between = unit(cross(one.axis, other.axis))
    apart = abs(dot(sub(one.center, other.center), between))
    return apart < one.radius + other.radius and _boxes_touch(one, other)


def _boxes_touch(one: Part, other: Part) -> bool:
    boxes = zip(one.center, other.center, one.extents, other.extents, strict=True)
    return all(abs(a - b) <= (x + y) / 2 for a, b, x, y in boxes)


def is_in_half(side: Side) -> Callable[[Part, Kinds], bool]:
    """Does the part's centre lie on this side of the middle of the model?"""

    def holds(part: Part, kinds: Kinds) -> bool:
        whole = next(iter(kinds.get("model")), None)
        return whole is not None and dot(sub(part.center, whole.center), side.outward) > TOUCH_M

    return holds


def is_facing(inwards: bool) -> Callable[[Part, Kinds], bool]:
    """Does a plane face look towards the middle of the model, as the inner faces of two walls do, or away from it?"""

    def holds(face: Part, kinds: Kinds) -> bool:
        whole = next(iter(kinds.get("model")), None)
        if face.kind != "face" or face.normal is None or whole is None:
            return False
        away = dot(sub(face.center, whole.center), face.normal)
        return away < -TOUCH_M if inwards else away > TOUCH_M

    return holds


def _bolts_on(plate: Part, pattern: Part, kinds: Kinds) -> bool:
    """Does the plate carry this pattern of holes, on one axis with a round part that stands on it?"""
    if "hole" not in pattern.tags or not set(pattern.children) <= set(plate.children):
        return False
    outside = [part for part in kinds.get("cylinder") if "outer" in part.tags]  # a bent pipe's end is no boss
    return any(
        part.axis is not None
        and plate.normal is not None
        and norm(cross(part.axis, plate.normal)) <= _SQUARE
        and line_distance(pattern.center, part.center, part.axis) <= _NEAR * min(part.extents)
        and touches(part, plate)
        for part in (*kinds.get("boss"), *outside)
    )


ROLES: Mapping[str, Callable[[Part, Kinds], bool]] = {
    "radial": is_radial,
    "across": is_across,
    "coaxial": is_coaxial,
    "crossing": is_crossing,
    "dowel_size": is_dowel_size,
    "flange": is_flange,
    "holed": is_holed,
    "inner": is_facing(inwards=True),
    "lone": is_lone,
    "outer": is_facing(inwards=False),
    "right_through": is_right_through,
    "tight": is_tight,
    **{f"along_{name}": is_along(axis) for axis, name in enumerate("xyz")},
    **{f"{side.value}_half": is_in_half(side) for side in Side},
}
"""Tags that only the other parts can give, and what decides on them. Looked at where a word asks for them: it takes a
look at many parts for each part."""
