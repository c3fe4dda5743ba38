"""What does looking cost, networks apart? Beside casting all rays through trimesh and Embree, in the same run."""

from __future__ import annotations

import statistics
import subprocess
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
from pydantic import BaseModel

from benchmark import ROOT
from benchmark.scoring.items import BadBenchmark
from querycad_segworker.mesh import Mesh
from querycad_segworker.model import Artefacts
from querycad_segworker.segcad.ports import VisionOptions
from querycad_segworker.segcad.prune import FaceGraph
from querycad_segworker.visibility.renderer import make_renderer

from .face_recovery import recovery
from .figures import Measurement

TIMEOUT_S = 300.0
BASELINE = "trimesh/embree, a ray for every pixel"
MOST_PARTS = 500
"""Of a model whose parts are looked for: all parts of a kind have their masks, of 2 MB each, at the same time."""
LIMIT_S, FASTER, SMALLER, FACE_IOU = 1.0, 5, 10, 0.95


class VisionChild(BaseModel):
    """What `perf_vision_child` prints."""

    seconds: float
    cpu_seconds: float
    memory_bytes: int


def vision_measurements(models: Sequence[tuple[str, Artefacts]], repeat: int) -> Iterator[Measurement]:
    """Six views of the model with the most triangles, and how much of known parts comes back from all models."""
    name, largest = max(models, key=lambda model: len(Mesh.load(model[1].mesh).triangles))
    taken: dict[str, list[VisionChild]] = {"views": [], "rays": []}
    for _ in range(repeat):  # alternating, so that both see the same machine
        for what, children in taken.items():
            children.append(vision_child(what, largest))
    yield from _beside_rays(name, taken["views"], taken["rays"])
    yield from _recovered(models)


def _beside_rays(name: str, views: Sequence[VisionChild], rays: Sequence[VisionChild]) -> Iterator[Measurement]:
    seconds, baseline_s = (statistics.median(child.seconds for child in of) for of in (views, rays))
    yield Measurement(
        name=f"6 views and 20 masks a view, {name}",
        value=seconds,
        unit="s",
        baseline_name=BASELINE,
        baseline=baseline_s,
        limit=f"under {LIMIT_S:g} s, {FASTER} x faster",
        holds=seconds < LIMIT_S and FASTER * seconds <= baseline_s,
    )
    cpu_s, baseline_cpu_s = (statistics.median(child.cpu_seconds for child in of) for of in (views, rays))
    yield Measurement(
        name="  processor time",
        value=cpu_s,
        unit="s",
        baseline_name=BASELINE,
        baseline=baseline_cpu_s,
    )
    memory, baseline_b = (max(child.memory_bytes for child in of) for of in (views, rays))
    yield Measurement(
        name="  memory that it takes on top of the model's",
        value=memory / 2**20,
        unit="MiB",
        baseline_name=BASELINE,
        baseline=baseline_b / 2**20,
        limit=f"a {SMALLER}th",
        holds=SMALLER * memory <= baseline_b,
    )


def _recovered(models: Sequence[tuple[str, Artefacts]]) -> Iterator[Measurement]:
    """How much comes back of the parts that the stages are meant to give back, and of all that is seen."""
    meant: dict[str, list[float]] = {}
    seen: list[float] = []
    for name, artefacts in models:
        model = artefacts.load_model()
        if len(model.parts) > MOST_PARTS:
            continue
        renderer, graph = make_renderer(Mesh.load(artefacts.mesh)), FaceGraph(np.load(artefacts.face_pairs))
        found = recovery(renderer, graph, model.shape.face_count, model.parts, VisionOptions()).values()
        seen.extend(one.face_iou for one in found)
        meant[f"{len(meant) + 1} ({name})"] = [one.face_iou for one in found if one.is_meant]
    means = {name: statistics.fmean(values) for name, values in meant.items() if values}
    if not means:
        return
    lowest = min(means, key=lambda name: means[name])
    every = [value for values in meant.values() for value in values]
    yield _face_iou(f"face IoU of {len(every)} parts, perfect networks", statistics.fmean(every))
    yield _face_iou(f"  lowest mean of a model: number {lowest}", means[lowest])
    yield _face_iou(
        f"  {len(seen)} parts, also those in pieces or most of the model", statistics.fmean(seen), has_limit=False
    )


def _face_iou(name: str, value: float, *, has_limit: bool = True) -> Measurement:
    return Measurement(
        name=name,
        value=value,
        unit="",
        baseline_name="all faces and no others",
        baseline=1.0,
        limit=f"at least {FACE_IOU:g}" if has_limit else "",
        holds=value >= FACE_IOU if has_limit else None,
    )


def vision_child(what: str, artefacts: Artefacts) -> VisionChild:
    """One measurement in a process of its own: 'views' or 'rays'. Raises BadBenchmark."""
    command = [sys.executable, "-m", "benchmark.perf.vision_child", what, str(Path(artefacts.folder).resolve())]
    try:
        done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=TIMEOUT_S, check=True)
    except subprocess.CalledProcessError as error:
        last = (error.stderr.strip().splitlines() or [f"exit code {error.returncode}"])[-1]
        raise BadBenchmark(f"{what} could not be measured: {last}") from error
    except subprocess.TimeoutExpired as error:
        raise BadBenchmark(f"{what} could not be measured: {error}") from error
    return VisionChild.model_validate_json(done.stdout.splitlines()[-1])
