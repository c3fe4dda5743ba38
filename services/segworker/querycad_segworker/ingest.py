"""Reads a CAD file once: the kernel works in a child with limits, so that its crash is only an error message."""

from __future__ import annotations

import json
import logging
import os
import shutil
import signal
import tempfile
import threading
from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path

from . import errors
from .errors import DiskFull, FileProblem, KernelDied, KernelKilled, NotStep
from .files.sniff import MAX_FILE_BYTES, check_file, kind_of, missing_entities
from .files.unpack import unpack
from .kernel_process import MEMORY_BYTES, KernelProcess, host_missing, start_host, take_back
from .model import Artefacts, ModelStore, file_sha256

Progress = Callable[[str], None]
"""Told the stage that begins: 'read', 'measure', 'tessellate', 'look', 'recognise'."""


LOG_TAIL_BYTES = 4000
"""So much of what the child printed last is looked at when it died: a traceback fits."""
_OUT_OF_MEMORY = ("MemoryError", "bad_alloc", "OutOfMemory", "failed to map segment", "Cannot allocate memory")
"""What Python, the C++ runtime, the kernel and the loader say when the address space is used up."""

_log = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True)
class IngestLimits:
    """What reading one file may cost."""

    duration_s: float = 180.0
    """The largest of 201 ugly files needs some 10 s; a kernel that takes longer is hanging."""
    memory_bytes: int = MEMORY_BYTES


def ingest(
    path: Path,
    store: ModelStore,
    limits: IngestLimits | None = None,
    progress: Progress | None = None,
    file_name: str | None = None,
    anew: bool = False,
) -> Artefacts:
    """What does the file hold? Known content is not read again, unless `anew`: then what is kept stays as it is.

    Raises FileProblem, with a sentence for the user, and WallsMissing where nothing may be read. `file_name` is the
    name that the user knows the file by, where `path` has another.
    """
    try:
        sha256 = file_sha256(path) if path.is_file() and os.access(path, os.R_OK) else ""
    except OSError as error:
        raise NotStep(f"{path} cannot be read: {error.strerror}") from error
    known = store.find(sha256) if sha256 and not anew else None
    if known is not None:
        return known
    scratch: Path | None = None
    try:
        source = path.resolve()
        kind = kind_of(path)
        if kind is not None and kind.is_packed:
            scratch = store.scratch()
            source = scratch / "unpacked"
            unpack(path, kind, source, MAX_FILE_BYTES)
        cleaned = check_file(source)
        scratch = scratch or store.scratch()
        if cleaned is not None:
            source = scratch / "cleaned.step"
            source.write_bytes(cleaned)
        _run_child(source, file_name or path.name, sha256, scratch, limits or IngestLimits(), progress)
        for made in (scratch / "unpacked", scratch / "cleaned.step"):
            made.unlink(missing_ok=True)
        return store.keep(sha256, scratch)
    except OSError as error:
        if error.errno in DiskFull.CODES:
            raise DiskFull from error
        raise
    finally:
        if scratch is not None:
            shutil.rmtree(scratch, ignore_errors=True)


def _run_child(
    source: Path, file_name: str, sha256: str, scratch: Path, limits: IngestLimits, progress: Progress | None
) -> None:
    """Runs `ingest_child`; its standard output names the stages, its outcome is a file."""
    outcome = scratch / "outcome.json"
    start_host()  # its imports are no part of the file's time
    if progress is not None:
        progress("read")
    with tempfile.TemporaryFile() as log:
        arguments = (str(source), str(scratch), limits.memory_bytes, sha256, file_name, " ".join(host_missing()))
        with ExitStack() as after:
            after.callback(take_back, scratch)  # it may be given to the kernel's user while his process runs
            child = after.enter_context(KernelProcess("ingest", *arguments, errors=log.fileno()))
            timer = threading.Timer(limits.duration_s, child.kill)
            timer.start()
            try:
                for line in child.stdout:
                    if progress is not None and line.startswith("stage "):
                        progress(line.removeprefix("stage ").strip())
                code = child.wait()
            finally:
                timed_out = not timer.is_alive()
                timer.cancel()
        log.seek(0)
        said = log.read()[-LOG_TAIL_BYTES:].decode(errors="replace")
    result = json.loads(outcome.read_text(encoding="utf-8")) if outcome.exists() else None
    if result is None:
        last = (said.strip().splitlines() or ["it said nothing"])[-1]
        _log.warning("the kernel's process ended with code %s on %s: %s", code, file_name, last)
        _log.debug("it said: %s", said)
        if any(os.strerror(code) in said for code in DiskFull.CODES):
            raise DiskFull
        if code == -signal.SIGKILL and not timed_out:
            raise KernelKilled("the process that read this file was killed, probably for lack of memory")
        raise KernelDied(_death(code, timed_out, said, source, limits))
    outcome.unlink()
    if "problem" in result:
        if said.strip():
            _log.info("of %s: %s", file_name, said.strip().splitlines()[-1])
            _log.debug("it said: %s", said)
        kind = getattr(errors, result["problem"], FileProblem)
        raise kind(result["message"])


def _death(code: int, timed_out: bool, said: str, source: Path, limits: IngestLimits) -> str:
    if timed_out:
        return f"the CAD kernel did not finish reading this file within {limits.duration_s:.0f} s and was stopped"
    if any(words in said for words in _OUT_OF_MEMORY):
        return f"reading this file needs more memory than the {limits.memory_bytes / 2**30:.1f} GB that are allowed"
    if code < 0:
        name = signal.Signals(-code).name
        missing = missing_entities(source)
        why = "the file is damaged or uses something it cannot handle"
        if missing:
            why = f"the file is damaged: it refers to #{missing[0]}, which it does not hold"
        return f"the CAD kernel crashed on this file ({name}); {why}"
    return f"the CAD kernel gave up on this file (exit code {code})"
