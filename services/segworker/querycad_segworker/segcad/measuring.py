"""New measurements by the CAD kernel, in a process of its own that is started once a model and asked line by line."""

from __future__ import annotations

import contextlib
import json
import math
import subprocess
import sys
import threading
import weakref
from collections.abc import Sequence
from pathlib import Path

from querycad_segworker.errors import KernelDied

TIMEOUT_S = 60.0
"""One distance takes milliseconds after the kernel's start of about 2 s; very large freeform faces take seconds."""


class Kernel:
    """Measures the faces of one model. The process starts with the first request and ends with this object."""

    def __init__(self, kernel_faces: Path) -> None:
        self._path = kernel_faces
        self._lock = threading.Lock()
        self._process: subprocess.Popen[str] | None = None
        self._known: dict[str, float] = {}

    def measure(self, what: str, first: Sequence[int], second: Sequence[int] = ()) -> float:
        """What is this distance, in metres? Raises KernelDied when the kernel cannot tell."""
        request = json.dumps({"what": what, "first": list(first), "second": list(second)})
        with self._lock:
            if request not in self._known:
                self._known[request] = self._ask(request)
            return self._known[request]

    def _ask(self, request: str) -> float:
        process = self._running()
        timer = threading.Timer(TIMEOUT_S, process.kill)
        timer.start()
        try:
            assert process.stdin is not None and process.stdout is not None  # noqa: PT018 - both are pipes
            process.stdin.write(request + "\n")
            process.stdin.flush()
            line = process.stdout.readline()
        except OSError:
            line = ""
        finally:
            timer.cancel()
        if not line:
            self._process = None
            _end(process)
            raise KernelDied("the CAD kernel could not measure this: it crashed or took too long")
        answer = json.loads(line)
        if "problem" in answer:
            raise KernelDied(answer["problem"])
        metres = float(answer["metres"])
        if not math.isfinite(metres):
            raise KernelDied("the CAD kernel found no such distance")
        return metres

    def _running(self) -> subprocess.Popen[str]:
        if self._process is None:
            self._process = subprocess.Popen(
                [sys.executable, "-m", "querycad_segworker.brep.measure", str(self._path)],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL,
                text=True,
            )
            weakref.finalize(self, _end, self._process)
        return self._process


def _end(process: subprocess.Popen[str]) -> None:
    """Ends the process and lets go of its pipes."""
    process.kill()
    process.wait()
    for pipe in (process.stdin, process.stdout):
        if pipe is not None:
            with contextlib.suppress(OSError):  # what was not written yet has nobody to read it
                pipe.close()
