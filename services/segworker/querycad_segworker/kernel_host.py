"""Forks a process for every piece of the CAD kernel's work: `python -m querycad_segworker.kernel_host DESCRIPTOR`.

The kernel and what goes with it take 1.5 to 2 s of processor time to import, more than most files take to read. The
host imports them once and starts no thread, so that its forks are whole; each does one piece of work and ends. Who asks
is told first which walls are missing, as a JSON list. It sends one byte with four descriptors over the socket
DESCRIPTOR: a line, standard input, output and error. The first line of standard input is JSON, the name of the work and
its arguments, of which the first is a file's path; the fork opens it and shuts itself in before it looks into it. Over
the line the host tells the exit code, negative for a signal; who closes it has the process killed. When the socket
closes, the host ends, and its forks.
"""

from __future__ import annotations

import contextlib
import encodings
import gc
import importlib
import json
import os
import pkgutil
import selectors
import signal
import socket
import sys
import traceback
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any, BinaryIO, Final

from querycad_contracts.infrastructure import end_with_parent

from . import ingest_child
from .brep import measure
from .errors import UnreadableFile
from .kernel_process import Reach, missing_walls, shut_in, user_of_work
from .meshes import measure as mesh_measure


def _answer(measurer: Callable[[BinaryIO], Callable[[dict[str, Any]], float]], kept: BinaryIO, *_: str) -> None:
    """Answers requests about what is kept, which is open, one JSON object a line, until standard input ends.

    {"what": "distance" | "overlap" | "edge_distance" | "extent", "first": [face ids], "second": [face ids],
    "direction": [x, y, z]} is answered by {"value": number} or {"problem": sentence}.
    """
    measure = measurer(kept)
    for line in sys.stdin:
        try:
            answer: dict[str, float | str] = {"value": measure(json.loads(line))}
        except UnreadableFile as problem:
            answer = {"problem": str(problem)}
        sys.stdout.write(json.dumps(answer) + "\n")
        sys.stdout.flush()


WORK: Final[dict[str, Callable[..., None]]] = {
    "ingest": ingest_child.work,
    "measure": partial(_answer, measure.measurer),
    "measure_mesh": partial(_answer, mesh_measure.measurer),
}
"""By name: what is done with an open file and with arguments, which begin with those of `Reach`."""


class _Host:
    def __init__(self, control: socket.socket) -> None:
        self._control = control
        self._lines: dict[int, socket.socket] = {}  # by process
        self._selector = selectors.DefaultSelector()
        self._ended, self._signalled = socket.socketpair()
        self._missing = missing_walls()

    def serve(self) -> None:
        """Forks until the other end of the socket is closed."""
        signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C reaches all at a terminal; who asked decides
        signal.signal(signal.SIGCHLD, lambda *_: None)
        for end in (self._ended, self._signalled):
            end.setblocking(False)
        signal.set_wakeup_fd(self._signalled.fileno(), warn_on_full_buffer=False)
        self._selector.register(self._control, selectors.EVENT_READ)
        self._selector.register(self._ended, selectors.EVENT_READ)
        if "unprivileged_user" not in self._missing and user_of_work() is not None:
            _load_codecs()
        gc.collect()
        gc.freeze()  # forks share these pages as long as nobody counts in them
        self._control.sendall(json.dumps(self._missing).encode())
        while True:
            for key, _ in self._selector.select():
                if key.fileobj is self._control:
                    if not self._fork():
                        self._kill_all()
                        signal.set_wakeup_fd(-1)  # the socket goes before the last of them is reaped
                        return
                elif key.fileobj is self._ended:
                    self._tell_ended()
                elif self._lines.get(key.data) is key.fileobj:  # not one that has ended and was let go in this moment
                    self._selector.unregister(key.fileobj)
                    os.kill(key.data, signal.SIGKILL)  # not reaped yet, so it is still this process

    def _fork(self) -> bool:
        """Begins the work that was asked for; False when nobody will ask any more."""
        asked, descriptors, _, _ = socket.recv_fds(self._control, 1, 4)
        if not asked:
            return False
        line, *standard = descriptors
        process = 0
        try:
            process = os.fork()
            if not process:
                self._become_worker(line, standard)
            self._lines[process] = socket.socket(fileno=line)
            self._selector.register(self._lines[process], selectors.EVENT_READ, process)
        except OSError:  # no more processes: the closed line tells
            traceback.print_exc()
            os.close(line)
        for descriptor in standard:
            os.close(descriptor)
        return True

    def _become_worker(self, line: int, standard: list[int]) -> None:
        """Does the work in the forked process, and ends it."""
        code = 1
        try:
            end_with_parent(signal.SIGKILL)
            signal.set_wakeup_fd(-1)
            signal.signal(signal.SIGCHLD, signal.SIG_DFL)
            self._selector.close()
            for each in (self._control, self._ended, self._signalled, *self._lines.values()):
                each.close()
            for number, descriptor in enumerate(standard):
                os.dup2(descriptor, number)
                os.close(descriptor)
            os.close(line)
            name, *arguments = json.loads(sys.stdin.readline())
            with Path(arguments[0]).open("rb") as opened:  # the user that it becomes may not
                shut_in(Reach(*arguments[:3]), self._missing)
                WORK[name](opened, *arguments)
            code = 0
        except BaseException:
            traceback.print_exc()
        finally:
            with contextlib.suppress(OSError):
                sys.stdout.flush()
                sys.stderr.flush()
            os._exit(code)

    def _tell_ended(self) -> None:
        """Tells of each process that has ended how it did."""
        with contextlib.suppress(BlockingIOError):
            self._ended.recv(4096)
        with contextlib.suppress(ChildProcessError):  # there is none
            while (found := os.waitpid(-1, os.WNOHANG))[0]:
                process, status = found
                line = self._lines.pop(process)
                with contextlib.suppress(KeyError):  # it was killed
                    self._selector.unregister(line)
                with line, contextlib.suppress(OSError):
                    line.sendall(str(os.waitstatus_to_exitcode(status)).encode())

    def _kill_all(self) -> None:
        for process in self._lines:
            os.kill(process, signal.SIGKILL)


def _load_codecs() -> None:
    """Imports what Python imports only when a file names it: another user may not be able to reach the installation."""
    for codec in pkgutil.iter_modules(encodings.__path__):
        with contextlib.suppress(ImportError):  # of another system
            importlib.import_module(f"encodings.{codec.name}")


if __name__ == "__main__":
    _Host(socket.socket(fileno=int(sys.argv[1]))).serve()
