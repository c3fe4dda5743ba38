"""Where are the models of the project's own benchmark? Built by its scripts where they are missing or out of date."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterable
from pathlib import Path

from .items import BadBenchmark

MODELS = Path("build/benchmark")
_SCRIPT = Path("benchmark/build_all.py")
BUILD_TIMEOUT_S = 600.0


def own_models(jobs: int) -> Path | None:
    """The folder with the models of ./benchmark, built now if need be; None where no script builds them.

    Raises BadBenchmark when the script fails.
    """
    if not _SCRIPT.is_file():
        return None
    if _is_stale():
        print("building the models of benchmark/ …", file=sys.stderr)
        command = [sys.executable, "-m", "benchmark.build_all", str(MODELS), "--jobs", str(jobs)]
        try:
            subprocess.run(
                command,
                check=True,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.PIPE,
                text=True,
                timeout=BUILD_TIMEOUT_S,
            )
        except subprocess.CalledProcessError as error:
            last = (error.stderr.strip().splitlines() or ["no message"])[-1]
            raise BadBenchmark(f"{_SCRIPT} failed: {last}") from error
        except subprocess.TimeoutExpired as error:
            raise BadBenchmark(f"{_SCRIPT} did not end within {BUILD_TIMEOUT_S:.0f} s") from error
    return MODELS


def _is_stale() -> bool:
    """Is a model missing, or older than a script that models are built with?"""
    scripts = [*Path("benchmark/models").glob("build_*.py")]
    models = [MODELS / f"{path.stem.removeprefix('build_')}.step" for path in scripts]
    if not all(model.is_file() for model in models):
        return True
    shared = [*Path("benchmark").glob("*.py"), *Path("examples").glob("_*.py")]
    return min(_times(models), default=0.0) < max(_times([*scripts, *shared]), default=0.0)


def _times(paths: Iterable[Path]) -> list[float]:
    return [path.stat().st_mtime for path in paths]
