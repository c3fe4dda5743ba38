"""New measurements, by the CAD kernel or on a mesh, in a process that is started once a model and asked by lines."""

from __future__ import annotations

import json
import math
import threading
import weakref
from collections.abc import Sequence

from querycad_contracts import NoSuchMeasure, Vector

from .errors import KernelDied
from .kernel_process import KernelProcess
from .model import Artefacts

TIMEOUT_S = 60.0
"""One distance takes milliseconds; very large freeform faces take seconds."""


class Kernel:
    """Measures the faces of one model. The process starts with the first request and ends with this object."""

    def __init__(self, artefacts: Artefacts) -> None:
        self._artefacts = artefacts
        self._lock = threading.Lock()
        self._process: KernelProcess | None = None
        self._known: dict[str, float] = {}

    def measure(
        self, what: str, first: Sequence[int], second: Sequence[int] = (), direction: Vector | None = None
    ) -> float:
        """What is this distance, or extent along `direction`, in metres, or overlap in m3?

        Raises KernelDied, and NoSuchMeasure where these faces have none.
        """
        request = json.dumps({"what": what, "first": list(first), "second": list(second), "direction": direction})
        with self._lock:
            if request not in self._known:
                self._known[request] = self._ask(request)
            return self._known[request]

    def _ask(self, request: str) -> float:
        process = self._running()
        timer = threading.Timer(TIMEOUT_S, process.kill)
        timer.start()
        try:
            process.say(request)
            line = process.stdout.readline()
        finally:
            timer.cancel()
        if not line:
            self._process = None
            process.close()
            raise KernelDied("the CAD kernel could not measure this: it crashed or took too long")
        answer = json.loads(line)
        if "problem" in answer:
            raise NoSuchMeasure(answer["problem"])
        value = float(answer["value"])
        if not math.isfinite(value):
            raise NoSuchMeasure("the CAD kernel found no such measure")
        return value

    def _running(self) -> KernelProcess:
        if self._process is None:
            exact = self._artefacts.kernel_faces.exists()
            work, path = ("measure", self._artefacts.kernel_faces) if exact else ("measure_mesh", self._artefacts.mesh)
            self._process = KernelProcess(work, str(path))
            weakref.finalize(self, self._process.close)
        return self._process
