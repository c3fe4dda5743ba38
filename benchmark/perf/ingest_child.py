"""One timing in a process of its own, start and imports not counted: `ingest_child kernel|ingest FILE FOLDER`.

Prints one JSON object: seconds, processor seconds, and the largest resident memory of the process in bytes.
"""

from __future__ import annotations

import importlib
import json
import os
import pkgutil
import resource
import sys
import time
from pathlib import Path

PACKAGES = ("brep", "features", "render", "visibility")
MEMORY_BYTES = 8 * 2**30


def main(what: str, file: Path, folder: Path) -> None:
    """Times the kernel's own read and tessellation, or all of ingest, whose artefacts go to `folder`."""
    report = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)  # the kernel and the stages write to standard output
    for package in PACKAGES:
        _import_all(f"querycad_segworker.{package}")
    used = time.process_time()
    seconds = _kernel_s(file) if what == "kernel" else _ingest_s(file, folder)
    cpu_seconds = time.process_time() - used
    memory_bytes = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024  # Linux counts in KiB
    json.dump({"seconds": seconds, "cpu_seconds": cpu_seconds, "memory_bytes": memory_bytes}, report)
    report.close()


def _import_all(package: str) -> None:
    """Loads every module of a package, as ingest would load them while it is timed; optional ones may be missing."""
    for module in pkgutil.walk_packages(importlib.import_module(package).__path__, f"{package}."):
        try:
            importlib.import_module(module.name)
        except ImportError:
            continue


def _kernel_s(file: Path) -> float:
    from .kernel_baseline import read_and_tessellate_s

    return read_and_tessellate_s(file)


def _ingest_s(file: Path, folder: Path) -> float:
    from querycad_segworker.ingest_child import main as ingest

    start = time.perf_counter()
    ingest(file, file.name, "0" * 64, folder, MEMORY_BYTES)
    return time.perf_counter() - start


if __name__ == "__main__":
    main(sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3]))
