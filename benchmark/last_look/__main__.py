"""`python -m benchmark.last_look` builds the STEP files of the last look into build/last_look."""

from __future__ import annotations

import importlib
from multiprocessing import get_context
from pathlib import Path

from benchmark.build_all import PREFIX, exported
from benchmark.understanding.data import LAST_LOOK


def build(name: str) -> None:
    """Writes one model's STEP file."""
    module = importlib.import_module(f"benchmark.last_look.models.{PREFIX}{name}")
    exported(name, module.MODEL, module.build(module.P()), LAST_LOOK)


def main() -> None:
    """Builds each model in a process of its own, as the kernel numbers products through a whole process."""
    LAST_LOOK.mkdir(parents=True, exist_ok=True)
    for path in sorted((Path(__file__).parent / "models").glob(f"{PREFIX}*.py")):
        child = get_context("spawn").Process(target=build, args=(path.stem.removeprefix(PREFIX),))
        child.start()
        child.join()
        if child.exitcode:
            raise SystemExit(f"{path.name} ended with exit code {child.exitcode}")


if __name__ == "__main__":
    main()
