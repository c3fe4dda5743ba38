"""Where are the models of the project's own benchmark? Built by its scripts where they are missing or out of date."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterable
from pathlib import Path

from .items import BadBenchmark

MODELS = Path("build/benchmark")
LAST_LOOK = Path("build/last_look")
_SCRIPT = Path("benchmark/build_all.py")
BUILD_TIMEOUT_S = 600.0


def own_models(jobs: int, last_look: bool = False) -> Path | None:
    """The folder with the models of ./benchmark, built now if need be; None where no script builds them.

    `last_look`: those of benchmark/last_look instead. Raises BadBenchmark when the script fails.
    """
    folder, scripts = (LAST_LOOK, "benchmark/last_look/models") if last_look else (MODELS, "benchmark/models")
    if not _SCRIPT.is_file():
        return None
    if _is_stale(folder, Path(scripts)):
        print(f"building the models of {scripts} …", file=sys.stderr)
        command = [sys.executable, "-m", "benchmark.build_all", str(folder), "--jobs", str(jobs)]
        command += ["--last-look"] if last_look else []
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
    return folder


def _is_stale(folder: Path, source: Path) -> bool:
    """Is a model missing, or older than a script that models are built with?"""
    scripts = [*source.glob("build_*.py")]
    models = [folder / f"{path.stem.removeprefix('build_')}.step" for path in scripts]
    if not all(model.is_file() for model in models):
        return True
    shared = [*Path("benchmark").glob("*.py"), *Path("examples").glob("_*.py")]
    return min(_times(models), default=0.0) < max(_times([*scripts, *shared]), default=0.0)


def _times(paths: Iterable[Path]) -> list[float]:
    return [path.stat().st_mtime for path in paths]
