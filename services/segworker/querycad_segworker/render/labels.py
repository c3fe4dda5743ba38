"""Where do the numbered balloons go? Around the model, close to their parts, leaders that never cross."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Point = tuple[float, float]

GAP = 1.15
"""Distance of neighbouring balloons' centres, in diameters."""
DIRECTIONS = 180
"""Directions in which a hull is touched: over a thousand pixels, two degrees miss it by 0.2 at most."""


@dataclass(frozen=True, slots=True)
class Balloon:
    """One label: a circle around a number, and the line from its rim to the part."""

    part: int
    anchor: Point
    """Where the leader ends, on the part."""
    rim: Point
    """Where the leader leaves the circle."""
    center: Point
    radius: float


@dataclass(frozen=True, slots=True, eq=False)
class Ring:
    """The places where balloons of one radius fit around an outline."""

    radius: float
    rims: NDArray[np.float64]
    """(S, 2): where the leaders begin, on the convex hull of the outline."""
    centers: NDArray[np.float64]
    """(S, 2), outside the hull, at least a diameter apart."""


def ring_around(outline: NDArray[np.float64], radius: float) -> Ring:
    """Where do balloons fit around the convex hull of these points? `outline`: (N, 2) pixels, at least one.

    Their centres lie on the curve at `radius` from the hull. For a normal direction u that curve runs through the
    hull's support point in that direction, moved by radius * u.
    """
    angles = np.linspace(0, 2 * np.pi, DIRECTIONS, endpoint=False)
    normals = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    touched = outline[(outline @ normals.T).argmax(axis=0)]
    rims, centers = _filled_in(touched, touched + radius * normals)
    kept: list[int] = []
    for index, center in enumerate(centers):
        if not kept or np.linalg.norm(centers[kept] - center, axis=1).min() >= 2 * radius * GAP:
            kept.append(index)
    return Ring(radius, rims[kept], centers[kept])


def place_balloons(anchors: dict[int, Point], ring: Ring) -> tuple[Balloon, ...]:
    """Where does the balloon of each part go? `anchors`: by part, inside the outline of the ring.

    Balloons sit just outside the hull of the outline and touch neither each other nor a leader; leaders run inside it
    and do not cross: first each takes the nearest free place; as long as two leaders cross, they swap their places,
    which shortens both together (triangle inequality), so this ends. Raises ValueError when there are more parts than
    places.
    """
    if len(anchors) > len(ring.rims):
        raise ValueError(f"{len(anchors)} balloons, but only {len(ring.rims)} fit")
    if not anchors:
        return ()
    parts = list(anchors)
    points = np.array([anchors[part] for part in parts], dtype=np.float64)
    place_of = _nearest_free(points, ring.rims)
    _uncross(points, ring.rims, place_of)
    return tuple(
        Balloon(part, anchors[part], _point(ring.rims[place]), _point(ring.centers[place]), ring.radius)
        for part, place in zip(parts, place_of, strict=True)
    )


def _filled_in(
    rims: NDArray[np.float64], centers: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The closed line through the centres with a point every pixel at most, and the rims that go with them."""
    following = np.roll(np.arange(len(rims)), -1)
    counts = np.maximum(1, np.ceil(np.linalg.norm(centers[following] - centers, axis=1))).astype(np.intp)
    start = np.repeat(np.arange(len(rims)), counts)
    share = ((np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)) / counts[start])[:, None]
    end = following[start]
    return rims[start] * (1 - share) + rims[end] * share, centers[start] * (1 - share) + centers[end] * share


def _nearest_free(points: NDArray[np.float64], rims: NDArray[np.float64]) -> list[int]:
    """The slot of each point: of all pairs still free, the closest first."""
    distances = np.linalg.norm(points[:, None] - rims[None], axis=-1)
    slot_of = [-1] * len(points)
    for _ in points:
        point, slot = np.unravel_index(int(distances.argmin()), distances.shape)
        slot_of[point] = int(slot)
        distances[point, :] = np.inf
        distances[:, slot] = np.inf
    return slot_of


def _uncross(points: NDArray[np.float64], rims: NDArray[np.float64], slot_of: list[int]) -> None:
    """Swaps slots until no swap shortens: then no two leaders cross."""
    lengths = np.linalg.norm(points[:, None] - rims[None], axis=-1).tolist()
    improved = True
    while improved:
        improved = False
        for a in range(len(points)):
            for b in range(a):
                kept = lengths[a][slot_of[a]] + lengths[b][slot_of[b]]
                swapped = lengths[a][slot_of[b]] + lengths[b][slot_of[a]]
                if swapped < kept * (1 - 1e-9):
                    slot_of[a], slot_of[b] = slot_of[b], slot_of[a]
                    improved = True


def _point(array: NDArray[np.float64]) -> Point:
    return (float(array[0]), float(array[1]))
