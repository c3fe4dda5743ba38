"""What the commands of `querycad bench` do."""

from __future__ import annotations

import argparse
import datetime
import json
import re
import sys
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TaskID, TextColumn, TimeElapsedColumn

from benchmark.scoring.ablation import Ablations, Row, ablations, table
from benchmark.scoring.answers import score_answers
from benchmark.scoring.compare import compare, print_comparison
from benchmark.scoring.failures import read_overrides
from benchmark.scoring.floor import Fall, falls, read_floor, record
from benchmark.scoring.items import BadBenchmark, Benchmark, read_benchmark
from benchmark.scoring.own_models import own_models
from benchmark.scoring.report import write_report
from benchmark.scoring.results import Results, load_results
from benchmark.scoring.running import RESULTS, run_benchmark
from benchmark.scoring.summaries import junit, markdown, markdown_comparison
from benchmark.scoring.systems import EMBEDDED, SERVED, SystemOptions, UnknownSystem
from benchmark.scoring.tables import print_results

from .arguments import SET_UP

if TYPE_CHECKING:
    from benchmark.perf.measure import Measurements

EXIT_DONE, EXIT_BELOW_FLOOR, EXIT_BAD_INPUT = 0, 1, 2
OWN = Path("benchmark")
THEIRS = Path("../shared/cad-qa-dev")
OVERRIDES = "overrides.json"


def bench(options: argparse.Namespace) -> int:
    """Does the command `options.bench`; returns its exit code."""
    commands = {"all": _all, "run": _run, "score": _score, "ablate": _ablate, "compare": _compare}
    commands |= {"perf": _perf, "service": _service, "networks": _networks}
    console = Console(highlight=False, width=None if sys.stdout.isatty() else 140)
    try:
        return commands[options.bench](options, console)
    except (BadBenchmark, UnknownSystem) as error:
        print(f"querycad: {error}", file=sys.stderr)
        return EXIT_BAD_INPUT
    except OSError as error:
        print(f"querycad: {error.filename or 'a file'}: {error.strerror or error}", file=sys.stderr)
        return EXIT_BAD_INPUT


def _run(options: argparse.Namespace, console: Console) -> int:
    benchmark = _read(options)
    run = _measure(benchmark, Path(options.out), options, console, resume=options.resume)
    _summarise([run], [], options)
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
    if (figures := cross_validated_figures(OWN / "understanding" / "results.json")) is not None:
        console.print("cross-validated by writer and model, as `make fit` wrote it down:", highlight=False)
        console.print(figures, highlight=False)
    fallen = falls(runs, read_floor(OWN / "floor.json"))
    _summarise(runs, fallen, options)
    for fall in fallen:
        print(f"querycad: below the floor: {fall}", file=sys.stderr)
    if options.record and not fallen:
        OWN.mkdir(exist_ok=True)
        written = record(runs, OWN, datetime.datetime.now(datetime.UTC).date())
        console.print("recorded: " + ", ".join(str(path) for path in written))
    return EXIT_BELOW_FLOOR if fallen else EXIT_DONE


def cross_validated_figures(path: Path) -> str | None:
    """The table that `make fit` keeps beside the weights; None where there is none."""
    if not path.is_file():
        return None
    return "\n".join(json.loads(path.read_text(encoding="utf-8"))["table"])


def _score(options: argparse.Namespace, console: Console) -> int:
    out = Path(options.out)
    overrides = read_overrides(_overrides(options, out))
    results = score_answers(_read(options), Path(options.answers), overrides)
    results.save(out / RESULTS)
    _show(results, out, console)
    return EXIT_DONE


def _ablate(options: argparse.Namespace, console: Console) -> int:
    """One run for every value, kept in a folder of its own, and one table an option."""
    asked = ablations(options.option, options.values)
    benchmark, base = _read(options), _system_options(options)
    all_rows: list[Row] = []
    with _model_store(options, base) as ready:

        def measure(setup: SystemOptions, name: str) -> Results:
            out = Path(options.out) / re.sub(r"[^A-Za-z0-9.-]+", "_", name)
            return _asked(benchmark, setup, out, options, resume=options.resume)

        runs = Ablations(ready, measure)
        for ablation in asked:
            rows = runs.rows(ablation)
            all_rows += rows
            console.print(table(ablation, rows, ready))
    if any(row.results is not None for row in all_rows):
        return EXIT_DONE
    raise UnknownSystem("nothing was measured: " + "; ".join(dict.fromkeys(row.refused for row in all_rows)))


def _compare(options: argparse.Namespace, console: Console) -> int:
    before, after = (
        load_results(Path(given) / RESULTS if Path(given).is_dir() else Path(given))
        for given in (options.before, options.after)
    )
    print_comparison(before, after, (options.before, options.after), console)
    if options.markdown:
        _add_to(Path(options.markdown), markdown_comparison(compare(before, after)))
    return EXIT_DONE


def _summarise(runs: Sequence[Results], fallen: Sequence[Fall], options: argparse.Namespace) -> None:
    """What a merge request shows, where that is asked for."""
    if options.markdown:
        _add_to(Path(options.markdown), markdown(runs, fallen))
    if options.junit:
        junit(runs, fallen, Path(options.junit))


def _add_to(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("a", encoding="utf-8") as file:
        file.write(text)


def _perf(options: argparse.Namespace, console: Console) -> int:
    from benchmark.perf.measure import PerfOptions, measure, print_measurements

    models = tuple(Path(name) for name in options.models) or tuple(sorted(Path("examples").glob("*.step")))
    missing = next((model for model in models if not model.is_file()), None)
    if missing is not None or not models:
        raise BadBenchmark(f"{missing}: no such file" if missing else "name a STEP file: there is none in examples/")
    found = measure(
        PerfOptions(models, options.questions, options.repeat, options.only, options.limit),
        lambda name: print(f"measuring: {name} …", file=sys.stderr),
    )
    print_measurements(found, console)
    if options.out:
        Path(options.out).parent.mkdir(parents=True, exist_ok=True)
        Path(options.out).write_text(found.model_dump_json(indent=1) + "\n", encoding="utf-8")
        console.print(f"figures: {options.out}")
    return _drawn(found, Path(options.plots), console) if options.plots else EXIT_DONE


def _drawn(found: Measurements, folder: Path, console: Console) -> int:
    from benchmark.perf.figures import NotMeasured
    from benchmark.perf.plots import draw

    parts = [(part.name, part.measurements) for part in found.parts]
    try:
        written = draw(parts, [series for part in found.parts for series in part.series], folder)
    except NotMeasured as absent:
        print(f"querycad: no plots: {absent}", file=sys.stderr)
        return EXIT_BAD_INPUT
    console.print("plots: " + ", ".join(str(path) for path in written))
    return EXIT_DONE


def _service(options: argparse.Namespace, console: Console) -> int:
    from benchmark.perf.service import ServiceOptions, measure, print_report

    if not Path(options.model).is_file():
        raise BadBenchmark(f"{options.model}: no such file")
    found = measure(
        ServiceOptions(Path(options.model), options.questions, options.chaos),
        lambda name: print(f"measuring: {name} …", file=sys.stderr),
    )
    print_report(found, console)
    if options.out:
        Path(options.out).parent.mkdir(parents=True, exist_ok=True)
        Path(options.out).write_text(found.model_dump_json(indent=1) + "\n", encoding="utf-8")
        console.print(f"figures: {options.out}")
    return EXIT_DONE


def _networks(options: argparse.Namespace, console: Console) -> int:
    from benchmark.perf.measure import Measurements, PartMeasurements, print_measurements
    from benchmark.perf.networks import NetworkOptions, network_measurements
    from querycad.settings import weights_folder

    weights = Path(options.weights) if options.weights else weights_folder()
    found = network_measurements(NetworkOptions(weights, boxes=options.boxes, repeat=options.repeat))
    part = PartMeasurements(name="networks", measurements=tuple(found))
    print_measurements(Measurements(python=sys.version.split()[0], parts=(part,)), console)
    return EXIT_DONE


def _read(options: argparse.Namespace) -> Benchmark:
    return read_benchmark(Path(options.folder), Path(options.models) if options.models else None)


def _measure(
    benchmark: Benchmark, out: Path, options: argparse.Namespace, console: Console, *, resume: bool = False
) -> Results:
    with _model_store(options, _system_options(options)) as setup:
        results = _asked(benchmark, setup, out, options, resume=resume)
    _show(results, out, console)
    return results


def _asked(
    benchmark: Benchmark, setup: SystemOptions, out: Path, options: argparse.Namespace, *, resume: bool = False
) -> Results:
    overrides = read_overrides(_overrides(options, out))
    with _progress(len(benchmark.items), benchmark.name) as progress:
        return run_benchmark(
            benchmark, setup, out, jobs=options.jobs, resume=resume, overrides=overrides, progress=progress
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


def _system_options(options: argparse.Namespace) -> SystemOptions:
    system = options.system or (SERVED if options.server else EMBEDDED)
    given = {"system": system, "server": options.server, "pictures": options.pictures, "timeout_s": options.timeout}
    given |= {name: value for name in SET_UP if (value := getattr(options, name)) is not None}
    return SystemOptions.model_validate(given)


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
