"""What the commands of `querycad bench` do."""

from __future__ import annotations

import argparse
import datetime
import re
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from pydantic import ValidationError
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TaskID, TextColumn, TimeElapsedColumn

from .answers import score_answers
from .compare import print_comparison, side_by_side
from .failures import read_overrides
from .floor import falls, read_floor, record
from .items import BadBenchmark, Benchmark, read_benchmark
from .own import own_models
from .report import write_report
from .results import Results, load_results
from .running import RESULTS, run_benchmark
from .systems import EMBEDDED, SystemOptions, UnknownSystem
from .tables import print_results

EXIT_DONE, EXIT_BELOW_FLOOR, EXIT_BAD_INPUT = 0, 1, 2
OWN = Path("benchmark")
THEIRS = Path("../shared/cad-qa-dev")
OVERRIDES = "overrides.json"


def bench(options: argparse.Namespace) -> int:
    """Does the command `options.bench`; returns its exit code."""
    commands = {"all": _all, "run": _run, "score": _score, "ablate": _ablate, "compare": _compare, "perf": _perf}
    console = Console(highlight=False, width=None if sys.stdout.isatty() else 140)
    try:
        return commands[options.bench](options, console)
    except (BadBenchmark, UnknownSystem) as error:
        print(f"querycad: {error}", file=sys.stderr)
        return EXIT_BAD_INPUT


def _run(options: argparse.Namespace, console: Console) -> int:
    benchmark = _read(options)
    _measure(benchmark, Path(options.out), options, console, resume=options.resume)
    return EXIT_DONE


def _all(options: argparse.Namespace, console: Console) -> int:
    """What CI runs: both benchmarks where present, against the recorded floor."""
    if options.overrides is None and (OWN / OVERRIDES).is_file():
        options.overrides = str(OWN / OVERRIDES)
    runs = []
    for folder in (OWN, THEIRS):
        if not folder.is_dir() or (folder == OWN and not any(folder.glob("questions/*.json"))):
            console.print(f"{folder}: not here, passed over")
            continue
        models = own_models(options.jobs) if folder == OWN else None
        runs.append(_measure(read_benchmark(folder, models), Path(options.out) / folder.name, options, console))
    if not runs:
        raise BadBenchmark(f"no benchmark here: neither {OWN} nor {THEIRS}")
    fallen = falls(runs, read_floor(OWN / "floor.json"))
    for fall in fallen:
        print(f"querycad: below the floor: {fall}", file=sys.stderr)
    if options.record and not fallen:
        OWN.mkdir(exist_ok=True)
        written = record(runs, OWN, datetime.datetime.now(datetime.UTC).date())
        console.print("recorded: " + ", ".join(str(path) for path in written))
    return EXIT_BELOW_FLOOR if fallen else EXIT_DONE


def _score(options: argparse.Namespace, console: Console) -> int:
    out = Path(options.out)
    overrides = read_overrides(_overrides(options, out))
    results = score_answers(_read(options), Path(options.answers), overrides)
    results.save(out / RESULTS)
    _show(results, out, console)
    return EXIT_DONE


def _ablate(options: argparse.Namespace, console: Console) -> int:
    """One run for every value, kept in a folder of its own, and one table."""
    benchmark = _read(options)
    runs = []
    for value in options.values:
        name = f"{options.option}-{re.sub(r'[^A-Za-z0-9.]+', '_', value)}"
        setup = _system_options(options, {options.option: value})
        results = _asked(benchmark, setup, Path(options.out) / name, options)
        runs.append((f"{options.option} {value}", results))
    console.print(side_by_side(runs))
    return EXIT_DONE


def _compare(options: argparse.Namespace, console: Console) -> int:
    before, after = (
        load_results(Path(given) / RESULTS if Path(given).is_dir() else Path(given))
        for given in (options.before, options.after)
    )
    print_comparison(before, after, (options.before, options.after), console)
    return EXIT_DONE


def _perf(options: argparse.Namespace, console: Console) -> int:
    from .perf import PerfOptions, measure, print_measurements

    models = tuple(Path(name) for name in options.models) or tuple(sorted(Path("examples").glob("*.step")))
    missing = next((model for model in models if not model.is_file()), None)
    if missing is not None or not models:
        raise BadBenchmark(f"{missing}: no such file" if missing else "name a STEP file: there is none in examples/")
    found = measure(
        PerfOptions(models, options.questions, options.repeat),
        lambda name: print(f"measuring: {name} …", file=sys.stderr),
    )
    print_measurements(found, console)
    if options.out:
        Path(options.out).parent.mkdir(parents=True, exist_ok=True)
        Path(options.out).write_text(found.model_dump_json(indent=1) + "\n", encoding="utf-8")
        console.print(f"figures: {options.out}")
    return EXIT_DONE


def _read(options: argparse.Namespace) -> Benchmark:
    return read_benchmark(Path(options.folder), Path(options.models) if options.models else None)


def _measure(
    benchmark: Benchmark, out: Path, options: argparse.Namespace, console: Console, *, resume: bool = False
) -> Results:
    results = _asked(benchmark, _system_options(options), out, options, resume=resume)
    _show(results, out, console)
    return results


def _asked(
    benchmark: Benchmark, setup: SystemOptions, out: Path, options: argparse.Namespace, *, resume: bool = False
) -> Results:
    overrides = read_overrides(_overrides(options, out))
    with _model_store(options, setup) as ready, _progress(len(benchmark.items), benchmark.name) as progress:
        return run_benchmark(
            benchmark, ready, out, jobs=options.jobs, resume=resume, overrides=overrides, progress=progress
        )


def _show(results: Results, out: Path, console: Console) -> None:
    write_report(results, out / "report.html")
    print_results(results, console)
    console.print(f"results: {out / RESULTS}, report: {out / 'report.html'}")


def _overrides(options: argparse.Namespace, out: Path) -> Path:
    if options.overrides is None:
        return out / OVERRIDES
    path = Path(options.overrides)
    if not path.is_file():
        raise BadBenchmark(f"{path}: no such file")
    return path


def _system_options(options: argparse.Namespace, changed: dict[str, str] | None = None) -> SystemOptions:
    given = {"system": options.system or EMBEDDED, "codegen": options.codegen}
    given |= {"pictures": options.pictures, "timeout_s": options.timeout}
    try:
        return SystemOptions.model_validate(given | (changed or {}))
    except ValidationError as error:
        names = ", ".join(sorted(set(SystemOptions.model_fields) - {"store", "pictures", "system", "timeout_s"}))
        raise UnknownSystem(f"{options.option} is no option of the system; there are: {names}") from error


@contextmanager
def _model_store(options: argparse.Namespace, setup: SystemOptions) -> Iterator[SystemOptions]:
    """The options with an empty folder for models, unless those read before are to be used.

    Models read by an earlier version of the code would otherwise be measured as if this one had read them.
    """
    if options.reuse_models:
        yield setup
        return
    with tempfile.TemporaryDirectory(prefix="querycad-bench-") as folder:
        yield setup.model_copy(update={"store": Path(folder)})


@contextmanager
def _progress(total: int, name: str) -> Iterator[_Advance]:
    """A bar on standard error while the questions are asked; nothing where that is no terminal."""
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    console = Console(stderr=True)
    with Progress(*columns, console=console, transient=True, disable=not console.is_terminal) as progress:
        task = progress.add_task(name, total=total)
        yield _Advance(progress, task)


class _Advance:
    """Moves the bar by as many questions as are done."""

    def __init__(self, progress: Progress, task: TaskID) -> None:
        self._progress, self._task = progress, task

    def __call__(self, count: int) -> None:
        self._progress.advance(self._task, count)
