"""Asks every question of a benchmark: the models in parallel processes, the results kept after each."""

from __future__ import annotations

import multiprocessing
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from itertools import groupby
from pathlib import Path
from time import perf_counter

from querycad_contracts.infrastructure import end_with_parent

from .failures import Override
from .items import BadBenchmark, Benchmark, Item
from .results import Result, Results, load_results, overruled, result_of
from .systems import OpenSystem, Reply, System, SystemOptions, open_system
from .time_limit import TookTooLong, time_limit

RESULTS = "results.json"
PICTURES = "pictures"

Progress = Callable[[int], None]
"""Told how many more questions are done."""


def run_benchmark(
    benchmark: Benchmark,
    options: SystemOptions,
    out: Path,
    *,
    jobs: int = 1,
    resume: bool = False,
    overrides: Mapping[str, Override] | None = None,
    progress: Progress = lambda _: None,
    opener: OpenSystem = open_system,
) -> Results:
    """What comes of all questions? Writes `results.json` into `out` after every model.

    With `resume`, questions that `out` has results of, with the same label and options, are not asked again. With one
    job all happens in this process. Raises UnknownSystem, and BadBenchmark when a worker process dies or the earlier
    results are of other options.
    """
    items = benchmark.items
    known = _known(out / RESULTS, items, options, overrides or {}) if resume else {}
    progress(len(known))
    pending = [item for item in items if item.key not in known]
    by_model = [tuple(group) for _, group in groupby(pending, key=lambda item: (item.set, item.id, item.file))]
    done = dict(known)
    kept = options.model_copy(update={"store": None})

    def collected() -> Results:
        results = tuple(done[item.key] for item in items if item.key in done)
        return Results(benchmark=benchmark.name, options=kept, results=results)

    for results in _asked(by_model, options, overrides or {}, out, jobs, opener):
        done.update({result.key: result for result in results})
        progress(len(results))
        collected().save(out / RESULTS)
    collected().save(out / RESULTS)
    return collected()


def _known(
    path: Path, items: Sequence[Item], options: SystemOptions, overrides: Mapping[str, Override]
) -> dict[str, Result]:
    if not path.is_file():
        return {}
    earlier = load_results(path)
    if earlier.options is None or earlier.options != options.model_copy(update={"store": None}):
        raise BadBenchmark(f"{path}: these results are of other options; choose another --out, or run without --resume")
    asked = {(item.key, item.question, item.label) for item in items}
    return {r.key: overruled(r, overrides) for r in earlier.results if (r.key, r.question, r.label) in asked}


def _asked(
    by_model: Sequence[tuple[Item, ...]],
    options: SystemOptions,
    overrides: Mapping[str, Override],
    out: Path,
    jobs: int,
    opener: OpenSystem,
) -> Iterator[tuple[Result, ...]]:
    if jobs <= 1:
        for items in by_model:
            yield ask_model(items, options, overrides, out, opener)
        return
    # Spawned, not forked: the sandbox's processes must start after the fork.
    context = multiprocessing.get_context("spawn")
    workers = min(jobs, max(len(by_model), 1))
    with ProcessPoolExecutor(workers, context, initializer=end_with_parent) as pool:
        tasks = [pool.submit(ask_model, items, options, overrides, out, opener) for items in by_model]
        try:
            for task in as_completed(tasks):
                yield task.result()
        except BrokenProcessPool as error:
            raise BadBenchmark("a worker process died; --resume goes on with what is left") from error
        finally:
            pool.shutdown(cancel_futures=True)


def ask_model(
    items: Iterable[Item],
    options: SystemOptions,
    overrides: Mapping[str, Override],
    out: Path,
    opener: OpenSystem = open_system,
) -> tuple[Result, ...]:
    """What comes of one model's questions?"""
    system = opener(options)
    try:
        results = []
        for item in items:
            start = perf_counter()
            try:
                with time_limit(options.limit_s):
                    reply = _reply(system, item)
            except TookTooLong as error:
                reply = Reply(failure="limit", message=str(error))
                system.close()  # it was stopped anywhere
                system = opener(options)
            seconds = perf_counter() - start if reply.seconds is None else reply.seconds
            picture = _keep(reply.picture_png, item, out) if reply.picture_png else None
            result = result_of(item, reply, overrides, picture)
            results.append(result.model_copy(update={"seconds": round(seconds, 6)}))
        return tuple(results)
    finally:
        system.close()


def _reply(system: System, item: Item) -> Reply:
    """The system's reply; what it raises is its own failure, and no reason to leave the other questions unasked."""
    try:
        return system.ask(item.file, item.question)
    except Exception as error:
        return Reply(failure="internal", message=f"{type(error).__name__}: {error}")


def _keep(picture_png: bytes, item: Item, out: Path) -> str:
    path = Path(PICTURES) / f"{item.key.replace('/', '-')}.png"
    (out / PICTURES).mkdir(parents=True, exist_ok=True)
    (out / path).write_bytes(picture_png)
    return path.as_posix()
