"""Are the recognised parts there? Points and rays in the model say so, without labels.

`python -m benchmark.part_probes FILE ... [--share 0.2] [--store FOLDER]` takes files of one body, STEP or packed, and
probes what is recognised: the axis of a hole runs free, its wall is all around, behind its bottom is material and
behind a way through none; around a boss is nothing, inside it material; rays across a wall are as long as it is thick;
on the axis behind a bottom is no less material than the part says. What contradicts is printed, a line each: to be
looked at, since a notch in a rim or an island in a pocket contradict, too.
"""

from __future__ import annotations

import argparse
import random
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
import trimesh
from numpy.typing import NDArray

from querycad_contracts import Bottom, Part, PartKind
from querycad_segworker.brep.step import quiet
from querycad_segworker.errors import FileProblem
from querycad_segworker.ingest import ingest
from querycad_segworker.mesh import Mesh
from querycad_segworker.model import ModelStore
from querycad_segworker.vectors import around

Reals = NDArray[np.float64]
MM = 1e3
ALONG = (0.15, 0.35, 0.5, 0.65, 0.85)
"""Shares of a depth or height where rings of points are probed."""
POINTS = 16
"""Points of a ring."""
NEAR, BEYOND = 0.95, 1.04
"""Shares of a radius that lie clearly inside and outside."""
PAST = 1.02
"""Share of a depth behind which a bottom has begun."""
STEP_M = 2e-5
"""What is so far off lies beyond a surface, whatever the size."""
LITTLE, MOST = 0.1, 0.5
"""At most, and at least, this share of the points of rings is material."""
SAMPLES, ALIKE, SHARE = 80, 0.06, 0.25
"""Points in the box of a wall; rays that differ from its thickness by less than this share, and how many of all."""


class Body:
    """A closed mesh to be probed, in millimetres about its middle: rays are traced in single precision."""

    def __init__(self, mesh: Mesh) -> None:
        self._middle = mesh.vertices_m.mean(axis=0)
        self._mesh = trimesh.Trimesh((mesh.vertices_m - self._middle) * MM, mesh.triangles, process=False)
        self._mesh.merge_vertices()

    def inside(self, points_m: Reals) -> NDArray[np.bool_]:
        """Which of the points, (N, 3), lie in the material?"""
        return np.asarray(self._mesh.contains((np.atleast_2d(points_m) - self._middle) * MM), dtype=np.bool_)

    def ahead(self, points_m: Reals, ways: Reals) -> Reals:
        """How far is the next surface from each point along each unit direction, (N,) metres? Infinite: none."""
        starts = (np.atleast_2d(points_m) - self._middle) * MM
        places, rays, _ = self._mesh.ray.intersects_location(starts, np.atleast_2d(ways), multiple_hits=False)
        found = np.full(len(starts), np.inf)
        found[rays] = np.linalg.norm(places - starts[rays], axis=1) / MM
        return found


def contradictions(part: Part, body: Body) -> Iterator[str]:
    """What in the body speaks against the part?"""
    if part.kind is PartKind.HOLE:
        yield from _of_hole(part, body)
    elif part.kind is PartKind.BOSS and "conical" not in part.tags:
        yield from _of_boss(part, body)
    elif part.kind is PartKind.WALL:
        yield from _of_wall(part, body)
    if part.bottom_thickness and part.bottom is Bottom.FLAT and part.opening and part.normal and part.depth:
        out = np.array(part.normal)
        floor = np.array(part.opening) - (part.depth + STEP_M) * out
        left = body.ahead(floor, -out)[0] + STEP_M
        if body.inside(floor)[0] and left < part.bottom_thickness / PAST:
            yield f"{left * MM:.4g} mm of material behind its middle, not {part.bottom_thickness * MM:.4g}"


def _rings(middle: Reals, axis: Reals, radius: float, reach: float) -> Reals:
    """Points around an axis, from `middle` by `reach`."""
    rings = (around(tuple(middle + share * reach * axis), tuple(axis), radius, POINTS) for share in ALONG)
    return np.array([point for ring in rings for point in ring])


def _of_hole(part: Part, body: Body) -> Iterator[str]:
    if not (part.opening and part.normal and part.depth and part.radius) or len(part.radii) > 1:
        return
    out, mouth = np.array(part.normal), np.array(part.opening)
    if body.inside(np.array([mouth - share * part.depth * out for share in ALONG])).any():
        yield "material on its axis"
    if "conical" not in part.tags:
        if body.inside(_rings(mouth, -out, NEAR * part.radius, part.depth)).mean() > LITTLE:
            yield "material inside its wall"
        wall = body.inside(_rings(mouth, -out, BEYOND * part.radius, part.depth)).reshape(len(ALONG), POINTS)
        if wall.mean(axis=1).max() < MOST:
            yield "no wall around it"
    behind = body.inside(mouth - (PAST * part.depth + STEP_M) * out)[0]
    if part.bottom is Bottom.FLAT and not behind:
        yield "nothing behind its bottom"
    if part.bottom is Bottom.THROUGH and behind:
        yield "material behind its end"


def _of_boss(part: Part, body: Body) -> Iterator[str]:
    if not (part.axis and part.height and part.radius):
        return
    axis = np.array(part.axis)
    low = np.array(part.center) - part.height / 2 * axis
    if body.inside(_rings(low, axis, NEAR * part.radius, part.height)).mean() < MOST:
        yield "nothing inside its wall"
    if body.inside(_rings(low, axis, BEYOND * part.radius, part.height)).mean() > MOST:
        yield "material around it"


def _of_wall(part: Part, body: Body) -> Iterator[str]:
    if not (part.normal and part.thickness):
        return
    across = np.tile(np.array(part.normal), (SAMPLES, 1))
    spread = np.random.default_rng(7).random((SAMPLES, 3)) - 0.5
    points = np.array(part.center) + NEAR * spread * np.array(part.extents)
    inside = body.inside(points)
    points, across = points[inside], across[inside]
    thick = body.ahead(points, across) + body.ahead(points, -across)
    if not len(thick) or np.isclose(thick, part.thickness, rtol=ALIKE).mean() < SHARE:
        least = f"{np.median(thick) * MM:.4g} mm across" if len(thick) else "nothing"
        yield f"{least} where it lies, not {part.thickness * MM:.4g} mm"


def _probed(file: Path, store: ModelStore) -> tuple[int, list[str]]:
    """How many parts were probed, and what contradicts."""
    try:
        artefacts = ingest(file, store)
    except FileProblem as problem:
        return 0, [f"{file.name}: {problem}"]
    parts, mesh = artefacts.load_model().parts, Mesh.load(artefacts.mesh)
    if sum(part.kind is PartKind.BODY for part in parts) != 1 or not mesh.closed:
        return 0, []
    body = Body(mesh)
    told = ((part, told) for part in parts for told in contradictions(part, body))
    return len(parts), [f"{file.name}: {part.id}, {part.label}: {text}" for part, text in told]


def main(arguments: Sequence[str] | None = None) -> int:
    """Probes and prints; returns the exit code."""
    parser = argparse.ArgumentParser(prog="python -m benchmark.part_probes", description=__doc__)
    parser.add_argument("files", nargs="+", type=Path, help="STEP files, packed or not")
    parser.add_argument("--share", type=float, default=1.0, help="of the files, drawn by seed")
    parser.add_argument("--store", type=Path, default=Path("build/understanding"), help="where models are kept")
    options = parser.parse_args(arguments)
    quiet()
    files = random.Random(7).sample(options.files, round(options.share * len(options.files)))  # noqa: S311 - no secret
    counts = Counter[str]()
    for file in files:
        parts, told = _probed(file, ModelStore(options.store))
        counts.update(parts=parts, contradicted=len(told), models=int(parts > 0))
        for line in told:
            print(line)
    print(", ".join(f"{name}: {count}" for name, count in counts.items()))
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
