"""Does throughput grow with the workers? Pictures a second of services with more and more segworkers, in turns."""

from __future__ import annotations

import statistics
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path

import psutil

from querycad.client import Client

from .figures import Measurement, NotMeasured, Series
from .service import ROUNDS, drawn_per_s, known
from .service_processes import ServiceTrouble, running

WORKERS = (1, 2, 4, 8)
EFFICIENCY = 0.6
"""Of each worker beyond the first: 1.6 times the pictures with two. Broker and API take their share."""


def workers_measurements(model: Path, scratch: Path) -> Iterator[Measurement | Series]:
    """The segworker's work alone: views drawn for four clients. No more workers than cores. Raises NotMeasured."""
    cores = len(psutil.Process().cpu_affinity())
    counts = [count for count in WORKERS if count <= cores]
    if len(counts) < 2:
        raise NotMeasured("there is one core: more workers would share it")
    rates = _rates(counts, model, scratch)
    for count in counts[1:]:
        least = 1 + EFFICIENCY * (count - 1)
        yield Measurement(
            name=f"pictures a second, {count} segworkers",
            value=rates[count],
            unit="1/s",
            baseline_name="one segworker",
            baseline=rates[1],
            limit=f"over {least:g} x",
            holds=rates[count] >= least * rates[1],
        )
    yield Series(
        name="throughput as workers are added",
        x_name="segworkers",
        y_name="pictures a second",
        x=tuple(counts),
        y=tuple(rates[count] for count in counts),
        expected_name="each as much as the first",
        expected=tuple(rates[1] * count for count in counts),
    )


def _rates(counts: list[int], model: Path, scratch: Path) -> dict[int, float]:
    """The median of rounds in turn, so that all see the same machine."""
    sizes = iter(range(64, 2048))  # no two views are of the same width, so that none is kept from before
    taken: dict[int, list[float]] = {count: [] for count in counts}
    try:
        with ExitStack() as stack:
            services = {count: stack.enter_context(running(scratch / f"workers-{count}", count)) for count in counts}
            for service in services.values():
                with Client(service.url) as client:
                    model_id = known(client, model)
                drawn_per_s(service, model_id, sizes)  # imports are done
            for _ in range(ROUNDS):
                for count, service in services.items():
                    taken[count].append(drawn_per_s(service, model_id, sizes))
    except ServiceTrouble as trouble:
        raise NotMeasured(str(trouble)) from trouble
    return {count: statistics.median(rates) for count, rates in taken.items()}
