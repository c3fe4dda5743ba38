"""Patterns: like features at equal distances on a circle, in a row or in a grid."""

from __future__ import annotations

import itertools
import math
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

from querycad_contracts import Part, Vector
from querycad_segworker.features.shared.refusals import refuse
from querycad_segworker.topology import linked
from querycad_segworker.vectors import across, binned, cross, dist, dot, line_key, mean, norm, sub, unit

MIN_MEMBERS = 3
"""Two like holes are a pair; three in a line or on a circle around a feature are laid out."""
FULL_CIRCLE = 4
"""Any three points lie on a circle: without a feature in the middle, so many are needed."""
MOST_PLACES = 2 / 3
"""A bolt circle may leave out places, where something is in the way, but fills more than this share of them. Four holes
at the corners of a rectangle fill two thirds of six."""
MAX_AXES = 50
"""A bolt circle lies around one of the main features; to look at more would cost the square of their number."""
NEAR = 5e-3
"""Distances that differ by less than this share of the pitch are equal: position tolerances are far below."""


class PatternKind(StrEnum):
    """How the members lie."""

    CIRCLE = "bolt_circle"
    ROW = "row"
    GRID = "grid"
    RECTANGLE = "rectangle"
    """Four in the corners of one."""


@dataclass(frozen=True, slots=True)
class Pattern:
    """One pattern. Metres. `members` are positions in the sequence given; `pitch` is the distance of neighbours.

    `radius` is that of the pitch circle; `length` and `width` of a row or grid run between the outermost centres.
    """

    kind: PatternKind
    members: tuple[int, ...]
    center: Vector
    normal: Vector
    pitch: float
    radius: float | None = None
    length: float | None = None
    width: float | None = None


def recognise_patterns(parts: Sequence[Part], bodies: Sequence[int], centers: Sequence[Part]) -> list[Pattern]:
    """Which of `parts` form patterns? Sorted by the lowest member.

    Members are of one body, kind, size and direction, and lie in one plane. `bodies`: the body of each part. `centers`:
    round features whose axes may be the middle of a bolt circle.
    """
    axes = _Axes(centers)
    groups: dict[tuple[object, ...], list[int]] = defaultdict(list)
    for i, part in enumerate(parts):
        if (key := _key(part)) is not None:
            groups[(bodies[i], *key)].append(i)
    found: list[Pattern] = []
    for indices in groups.values():
        for level in _levels(parts, indices):
            if len(level) >= MIN_MEMBERS:
                laid_out = _of_level(parts, level, axes)
                found.extend(laid_out)
                rest = set(level).difference(*(pattern.members for pattern in laid_out))
                if len(rest) >= MIN_MEMBERS:
                    faces = (face for i in rest for face in parts[i].faces)
                    refuse("pattern", faces, f"{len(rest)} alike, but neither at equal angles nor in a row or grid")
    return sorted(found, key=lambda pattern: pattern.members)


def _key(part: Part) -> tuple[object, ...] | None:
    """What like members share: kind, sizes to a thousandth, direction whichever way it is written."""
    if part.normal is None or not (size := part.diameter or part.width):
        return None
    length = part.depth or part.height or 0.0
    return (
        part.kind,
        binned(size),
        binned(max(part.width or 0.0, part.length or 0.0)),
        binned(length),
        line_key(part.normal),
    )


def _levels(parts: Sequence[Part], indices: Sequence[int]) -> list[list[int]]:
    """The members by the plane in which they lie."""
    normal = parts[indices[0]].normal
    assert normal is not None
    near = 0.05 * (parts[indices[0]].diameter or parts[indices[0]].width or 0.0)
    levels: list[list[int]] = []
    reach = -math.inf
    for i in sorted(indices, key=lambda i: dot(parts[i].center, normal)):
        position = dot(parts[i].center, normal)
        if position - reach > near:
            levels.append([])
        levels[-1].append(i)
        reach = position
    return levels


def _of_level(parts: Sequence[Part], level: Sequence[int], axes: _Axes) -> list[Pattern]:
    """The patterns that like members in one plane form.

    A grid of all; else circles around round features, and of what is left a rectangle, a circle or a row of all, or
    rows that stand apart.
    """
    normal = parts[level[0]].normal
    assert normal is not None
    points = {i: parts[i].center for i in level}
    if len(points) > FULL_CIRCLE and (grid := _grid(points, normal)) is not None:
        return [grid]
    found: list[Pattern] = []
    reach = max(0.1 * min(dist(a, b) for a, b in itertools.pairwise(points.values())), 1e-9)
    own = {tuple(round(c / reach) for c in _flat(p, normal)) for p in points.values()}
    centers = [p for p in axes.along(normal) if tuple(round(c / reach) for c in _flat(p, normal)) not in own]
    for circle in _circles(points, normal, centers, MIN_MEMBERS):
        if points.keys() >= set(circle.members):
            found.append(circle)
            points = {i: p for i, p in points.items() if i not in circle.members}
    if len(points) < MIN_MEMBERS:
        return found
    around = _circles(points, normal, [mean(list(points.values()))], max(FULL_CIRCLE, len(points)))
    rest = [p for p in (_grid(points, normal), *around, _row(points, normal)) if p is not None]
    return [*found, *(rest[:1] or _rows(points, normal))]


def _flat(point: Vector, normal: Vector) -> tuple[float, float]:
    """The point in the plane at right angles to the normal."""
    x, y = across(normal)
    return dot(point, x), dot(point, y)


class _Axes:
    """Round features by their direction, to ask quickly which of them stand square on a plane; the widest ones only."""

    def __init__(self, parts: Sequence[Part]) -> None:
        self._by_direction: dict[Vector, list[Vector]] = defaultdict(list)
        for part in sorted(parts, key=lambda part: -(part.diameter or 0.0)):
            if part.axis is not None and len(known := self._by_direction[line_key(part.axis)]) < MAX_AXES:
                known.append(part.center)

    def along(self, direction: Vector) -> list[Vector]:
        """Through which points do axes of this direction run?"""
        return self._by_direction[line_key(direction)]


def _circles(points: dict[int, Vector], normal: Vector, centers: Sequence[Vector], needed: int) -> list[Pattern]:
    """Members at one distance and equal angles around one of the centres, `needed` of them at least; largest first."""
    x, y = across(normal)
    flat = {i: (dot(p, x), dot(p, y)) for i, p in points.items()}
    level = dot(next(iter(points.values())), normal)
    candidates = dict.fromkeys((round(dot(p, x), 9), round(dot(p, y), 9)) for p in centers)
    found = []
    for u, v in candidates:
        rings: dict[str, list[int]] = defaultdict(list)
        for i, (a, b) in flat.items():
            if (distance := math.hypot(a - u, b - v)) > 0.0:
                rings[binned(distance)].append(i)
        for ring in rings.values():
            pitch = _equal_angles([math.atan2(flat[i][1] - v, flat[i][0] - u) for i in ring])
            if len(ring) < needed or pitch is None:
                continue
            radius = sum(math.hypot(flat[i][0] - u, flat[i][1] - v) for i in ring) / len(ring)
            center = tuple(u * a + v * b + level * n for a, b, n in zip(x, y, normal, strict=True))
            found.append(
                Pattern(
                    kind=PatternKind.CIRCLE,
                    members=tuple(sorted(ring)),
                    center=(center[0], center[1], center[2]),
                    normal=normal,
                    pitch=2 * radius * math.sin(pitch / 2),
                    radius=radius,
                )
            )
    return sorted(found, key=lambda pattern: (-len(pattern.members), pattern.members))


def _equal_angles(angles: Sequence[float]) -> float | None:
    """The pitch angle when all lie at equal angles all around, but for a few places left out, else None."""
    ordered = sorted(angles)
    gaps = [b - a for a, b in zip(ordered, [*ordered[1:], ordered[0] + 2 * math.pi], strict=True)]
    if min(gaps) <= 0.0:
        return None
    places = round(2 * math.pi / min(gaps))
    pitch = 2 * math.pi / places
    if any(abs(gap - round(gap / pitch) * pitch) >= NEAR * pitch for gap in gaps):
        return None
    gapped = len(angles) > FULL_CIRCLE and len(angles) > MOST_PLACES * places
    return pitch if len(angles) == places or gapped else None


def _row(points: dict[int, Vector], normal: Vector) -> Pattern | None:
    """All on one line at equal distances."""
    ids = list(points)
    first = points[ids[0]]
    far = max(ids, key=lambda i: dist(first, points[i]))
    if dist(first, points[far]) <= 0.0:
        return None
    along = unit(sub(points[far], first))
    positions = sorted((dot(sub(points[i], first), along), i) for i in ids)
    if any(norm(cross(sub(points[i], first), along)) > NEAR * dist(first, points[far]) for i in ids):
        return None
    gaps = [b[0] - a[0] for a, b in itertools.pairwise(positions)]
    pitch = sum(gaps) / len(gaps)
    if any(abs(gap - pitch) > NEAR * pitch for gap in gaps):
        return None
    members = tuple(sorted(ids))
    return Pattern(PatternKind.ROW, members, mean([points[i] for i in members]), normal, pitch, None, sum(gaps), None)


def _rows(points: dict[int, Vector], normal: Vector) -> list[Pattern]:
    """Rows that stand apart: each member has its nearest ones in the row, and no other lies on the row's line."""
    nearest = _nearest(points, normal)
    pairs = [(i, j) for i, (_, close) in nearest.items() for j in close if i in nearest[j][1]]
    found = []
    for members in linked(sorted(points), pairs):
        row = _row({i: points[i] for i in members}, normal) if len(members) >= MIN_MEMBERS else None
        if row is None:
            continue
        along = unit(sub(points[members[-1]], points[members[0]]))
        near = NEAR * row.pitch
        others = (sub(p, row.center) for i, p in points.items() if i not in row.members)
        if all(norm(cross(other, along)) > near for other in others):
            found.append(row)
    return found


def _nearest(points: dict[int, Vector], normal: Vector) -> dict[int, tuple[float, list[int]]]:
    """How far from each point is the nearest one, and which are no farther?"""
    x, _ = across(normal)
    order = sorted((dot(p, x), i) for i, p in points.items())
    found: dict[int, tuple[float, list[int]]] = {}
    for at, (here, i) in enumerate(order):
        best, close = math.inf, list[tuple[float, int]]()
        for side in (reversed(order[:at]), order[at + 1 :]):
            for there, j in side:
                if abs(there - here) > best * (1 + NEAR):
                    break
                apart = dist(points[i], points[j])
                best = min(best, apart)
                close.append((apart, j))
        found[i] = best, [j for apart, j in close if apart <= best * (1 + NEAR)]
    return found


def _grid(points: dict[int, Vector], normal: Vector) -> Pattern | None:
    """A full rectangular grid of at least two rows and columns; of two by two a rectangle."""
    if len(points) < FULL_CIRCLE:
        return None
    ids = list(points)
    first = points[ids[0]]
    nearest = min(ids[1:], key=lambda i: dist(first, points[i]))
    u = unit(sub(points[nearest], first))
    v = cross(normal, u)
    columns = _lines([dot(points[i], u) for i in ids])
    rows = _lines([dot(points[i], v) for i in ids])
    if columns is None or rows is None or min(len(columns), len(rows)) < 2 or len(columns) * len(rows) != len(ids):
        return None
    pitches = [(line[-1] - line[0]) / (len(line) - 1) for line in (columns, rows)]
    four = len(ids) == FULL_CIRCLE
    if four and abs(pitches[0] - pitches[1]) <= NEAR * pitches[0]:
        return None  # a square: a circle as well
    sides = sorted((columns[-1] - columns[0], rows[-1] - rows[0]))
    center = mean(list(points.values()))
    kind = PatternKind.RECTANGLE if four else PatternKind.GRID
    return Pattern(kind, tuple(sorted(ids)), center, normal, min(pitches), None, sides[1], sides[0])


def _lines(values: Sequence[float]) -> list[float] | None:
    """The different values, when they lie at equal distances."""
    span = max(values) - min(values)
    lines: list[float] = []
    for value in sorted(values):
        if not lines or value - lines[-1] > 1e-3 * max(span, 1e-12):
            lines.append(value)
    gaps = [b - a for a, b in itertools.pairwise(lines)]
    if gaps and max(gaps) - min(gaps) > NEAR * max(gaps) * 2:
        return None
    return lines
