"""Gets weights: downloads them, resuming where it stopped, or copies them; keeps only files whose checksum matches."""

from __future__ import annotations

import fcntl
import shutil
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

import httpx

from querycad_segworker.segcad.engines.weights import (
    HUB,
    Check,
    Model,
    WeightFile,
    check,
    record_sum,
    sha256_of,
)

ATTEMPTS = 4
"""Tries of one file, each going on where the last one was cut."""
PAUSE_S = 1.0
"""Before the second try; twice as long before each further one."""
TIMEOUT_S = 30.0
"""Without a byte, after which a connection counts as cut."""

Progress = Callable[[str, int, int | None], None]
"""Told the file, the bytes of it that are there, and how many there will be, where the server says so."""


class PullFailed(Exception):
    """A file that could not be downloaded; `str()` is the sentence for the user."""


class _Cut(Exception):
    """The connection broke, or the server was busy: worth another try."""


class Source(Protocol):
    """Where files come from."""

    def fetch(self, model: Model, file: WeightFile, part: Path, progress: Progress) -> None:
        """Makes `part` the whole file. Raises PullFailed; what is there of it by then may stay."""
        ...


@dataclass(frozen=True, slots=True)
class LocalFolder:
    """A folder with the files: the weights folder of another machine, or a copy of the model's repository."""

    folder: Path

    def fetch(self, model: Model, file: WeightFile, part: Path, progress: Progress) -> None:
        """Copies the file. Raises PullFailed where it is in neither place."""
        places = (self.folder / model.name / file.name, self.folder / file.path)
        for place in places:
            if place.is_file():
                shutil.copyfile(place, part)
                progress(file.name, part.stat().st_size, part.stat().st_size)
                return
        raise PullFailed(f"{file.name} of {model.name} is neither {places[0]} nor {places[1]}")


@dataclass(frozen=True, slots=True)
class Download:
    """The hub that the list names, or a mirror of it."""

    client: httpx.Client
    hub: str = HUB
    pause_s: float = PAUSE_S

    def fetch(self, model: Model, file: WeightFile, part: Path, progress: Progress) -> None:
        """Downloads the rest of the file, in several tries if need be. Raises PullFailed."""
        url = model.url(file, self.hub)
        for attempt in range(ATTEMPTS):
            if attempt:
                time.sleep(self.pause_s * 2 ** (attempt - 1))
            try:
                return self._go_on(url, part, lambda done, total: progress(file.name, done, total))
            except (httpx.UnsupportedProtocol, httpx.InvalidURL) as error:
                raise PullFailed(f"{url} is no address to download from: {error}") from error
            except (httpx.TransportError, _Cut) as error:
                cause = error
            except httpx.HTTPError as error:
                raise PullFailed(f"{url}: {error}") from error
        done = part.stat().st_size if part.exists() else 0
        again = f"; {done / 1e6:.1f} MB are kept, the same command goes on from there" if done else ""
        raise PullFailed(f"{url} could not be downloaded: {str(cause) or type(cause).__name__}{again}") from cause

    def _go_on(self, url: str, part: Path, progress: Callable[[int, int | None], None]) -> None:
        """One request for what is missing (RFC 9110, section 14)."""
        start = part.stat().st_size if part.exists() else 0
        headers = {"Accept-Encoding": "identity"} | ({"Range": f"bytes={start}-"} if start else {})
        with self.client.stream("GET", url, headers=headers, follow_redirects=True, timeout=TIMEOUT_S) as response:
            if response.status_code == httpx.codes.REQUESTED_RANGE_NOT_SATISFIABLE and start:
                if response.headers.get("Content-Range") == f"bytes */{start}":
                    return  # all of it was there already
                part.unlink()
                raise _Cut("what was there of it did not fit the server's file")
            if response.status_code >= 500 or response.status_code == httpx.codes.TOO_MANY_REQUESTS:
                raise _Cut(f"the server answered {response.status_code}")
            if not response.is_success:
                raise PullFailed(f"{url}: the server answered {response.status_code} {response.reason_phrase}")
            if response.status_code != httpx.codes.PARTIAL_CONTENT:
                start = 0  # a server that knows no ranges sends all of it again
            length = response.headers.get("Content-Length")
            total = start + int(length) if length else None
            with part.open("ab" if start else "wb") as content:
                for chunk in response.iter_raw():  # as it comes: what waits to fill a piece would be lost in a cut
                    content.write(chunk)
                    start += len(chunk)
                    progress(start, total)


def pull(model: Model, weights: Path, source: Source, progress: Progress) -> list[tuple[str, Check]]:
    """Brings each file of the model into its folder under `weights`, unless it is there and right.

    Returns what is known of each file. Raises PullFailed: for a file that cannot be had, and for one whose sum is not
    the expected one, of which nothing is kept.
    """
    folder = weights / model.name
    folder.mkdir(parents=True, exist_ok=True)
    with _alone(folder):
        return [(file.name, _ensure(model, file, folder, source, progress)) for file in model.files]


def _ensure(model: Model, file: WeightFile, folder: Path, source: Source, progress: Progress) -> Check:
    there = check(folder, file)
    if there not in (Check.ABSENT, Check.WRONG):
        return there
    part = folder / f"{file.name}.part"
    source.fetch(model, file, part, progress)
    digest = sha256_of(part)
    if file.sha256 and digest != file.sha256:
        part.unlink()
        raise PullFailed(
            f"{file.name} of {model.name} has the wrong checksum and was not kept: "
            f"its SHA-256 is {digest}, {file.sha256} was expected"
        )
    record_sum(folder, file.name, digest)
    part.replace(folder / file.name)
    return Check.GOOD if file.sha256 else Check.AS_PULLED


@contextmanager
def _alone(folder: Path) -> Iterator[None]:
    """Two pulls into one file would spoil it. Raises PullFailed while another one is running."""
    with (folder / ".lock").open("w") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise PullFailed(f"another download into {folder} is running") from None
        yield
