"""How much could more segworkers draw here? The same work in plain processes: no service, no queue, no client."""

from __future__ import annotations

import itertools
import multiprocessing
import os
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from pathlib import Path

from querycad_contracts import ViewName
from querycad_contracts.infrastructure import end_with_parent
from querycad_segworker.kernel_process import ONE_THREAD

HEIGHT = 400
"""Pixels; the widths differ, as those do that services are asked for."""
PICTURES = 8

Drawing = Callable[[int], float]
"""Pictures a second, by that many processes."""


@contextmanager
def plain_drawing(mesh: Path, most: int) -> Iterator[Drawing]:
    """Processes that draw this mesh as a segworker draws a view; up to `most` of them."""
    sizes = itertools.cycle(range(600, 1000))
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(most, context, initializer=_begin) as pool:

        def draw(processes: int) -> float:
            start = time.perf_counter()
            shares = [[next(sizes) for _ in range(PICTURES)] for _ in range(processes)]
            list(pool.map(_draw, [mesh] * processes, shares))
            return processes * PICTURES / (time.perf_counter() - start)

        list(pool.map(_draw, [mesh] * most, [[100]] * most))
        yield draw


def _begin() -> None:
    end_with_parent()
    os.environ.update(ONE_THREAD)  # as segworkers do; NumPy, which reads it, is not imported yet


def _draw(mesh: Path, widths: list[int]) -> None:
    from querycad_segworker.mesh import Mesh
    from querycad_segworker.render.plain import picture_of

    for width in widths:
        picture_of(Mesh.load(mesh), ViewName.ISOMETRIC, (width, HEIGHT))
