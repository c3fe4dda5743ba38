"""Where is what the services share on disk: uploaded files, artefacts, pictures?

A `FileStore` knows files by names such as `files/ab/abcd…`. `FolderStore` keeps them in a folder that all services see,
`BucketStore` in an S3-compatible bucket, with the folder as this machine's cache. What has a name does not change:
names hold the SHA-256 of the content, or the id of an answer.
"""

from __future__ import annotations

import os
import shutil
import tempfile
import time
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from datetime import timedelta
from pathlib import Path
from typing import Any, Protocol, TypeVar

from .settings import StorageSettings

RETRIES, RETRY_S = 3, 30.0
"""How often a request to a bucket is repeated, and for how long: as long as the library waits for one answer. A bucket
that takes connections and says nothing is given up after that, and not after the library's own three minutes."""
FETCH_S = 120.0
"""What one file, one folder or one list may take altogether, so long as something comes: 512 MiB at 5 MB/s."""
T = TypeVar("T")


class FileStore(Protocol):
    """Files by name. Raises OSError when the store cannot be reached or written."""

    home: Path

    def keep(self, name: str, unfinished: Path) -> None:
        """Gives a finished file, which is in `home` under another name, its own: all at once, or not at all."""
        ...

    def fetch(self, name: str) -> Path | None:
        """Where can the file be read now? None when there is none."""
        ...

    def exists(self, name: str) -> bool:
        """Is there such a file for all services, whatever is left of it here?"""
        ...

    def keep_folder(self, name: str) -> None:
        """Shares a folder that is complete under its name in `home`."""
        ...

    def fetch_folder(self, name: str) -> bool:
        """Is the folder under its name in `home`, now at the latest?"""
        ...

    def remove(self, name: str) -> None:
        """Removes a file or folder, if it is there."""
        ...


class FolderStore:
    """Files in a folder that all services see."""

    def __init__(self, home: Path) -> None:
        self.home = home

    def keep(self, name: str, unfinished: Path) -> None:
        """Gives a finished file its name."""
        target = self.home / name
        target.parent.mkdir(parents=True, exist_ok=True)
        unfinished.replace(target)

    def fetch(self, name: str) -> Path | None:
        """Where can the file be read now? None when there is none."""
        path = self.home / name
        return path if path.is_file() else None

    def exists(self, name: str) -> bool:
        """Is there such a file?"""
        return (self.home / name).is_file()

    def keep_folder(self, name: str) -> None:
        """Everybody sees it already."""

    def fetch_folder(self, name: str) -> bool:
        """Is the folder there?"""
        return (self.home / name).is_dir()

    def remove(self, name: str) -> None:
        """Removes a file or folder, if it is there."""
        path = self.home / name
        if path.is_dir():
            shutil.rmtree(path, ignore_errors=True)
        else:
            path.unlink(missing_ok=True)


class BucketStore:
    """Files in an S3-compatible bucket; the folder is this machine's cache of it.

    Address and credentials of the bucket are those of the usual variables: AWS_ENDPOINT, AWS_REGION, AWS_ACCESS_KEY_ID,
    AWS_SECRET_ACCESS_KEY; AWS_ALLOW_HTTP=true for one without TLS.
    """

    def __init__(self, home: Path, url: str) -> None:
        from obstore.store import from_url  # an optional dependency

        self.home = home
        self._cache = FolderStore(home)
        self._bucket: Any = from_url(
            url, retry_config={"max_retries": RETRIES, "retry_timeout": timedelta(seconds=RETRY_S)}
        )

    def keep(self, name: str, unfinished: Path) -> None:
        """Uploads a finished file, and keeps it in the cache."""
        self._upload(name, unfinished)
        self._cache.keep(name, unfinished)

    def fetch(self, name: str) -> Path | None:
        """Where can the file be read now? Downloads it unless it is in the cache; None when the bucket has none."""
        cached = self._cache.fetch(name)
        if cached is not None:
            return cached
        if not self._download(name, self.home / name, time.monotonic() + FETCH_S):
            return None
        return self._cache.fetch(name)

    def exists(self, name: str) -> bool:
        """Is there such a file in the bucket? What is in the cache may have been deleted by another machine."""
        try:
            with _reached():
                self._bucket.head(name)
        except FileNotFoundError:
            return False
        return True

    def keep_folder(self, name: str) -> None:
        """Uploads all files directly in the folder; the one that says that it is complete is the last."""
        paths = sorted((path for path in (self.home / name).iterdir() if path.is_file()), key=_complete_last)
        for path in paths:
            self._upload(f"{name}/{path.name}", path)

    def fetch_folder(self, name: str) -> bool:
        """Downloads a complete folder unless it is in the cache; is it there now?"""
        target = self.home / name
        if target.is_dir():
            return True
        end = time.monotonic() + FETCH_S
        names = self._names(name)
        if f"{name}/{COMPLETE}" not in names:
            return False
        self.home.mkdir(parents=True, exist_ok=True)
        scratch = Path(tempfile.mkdtemp(prefix="fetch-", dir=self.home))
        try:
            for each in names:
                if Path(each).parent == Path(name):  # what is in its folders is fetched when it is asked for
                    self._download(each, scratch / Path(each).name, end)
            target.parent.mkdir(parents=True, exist_ok=True)
            scratch.rename(target)
        except OSError:
            if not target.is_dir():  # else another process was faster
                raise
        finally:
            shutil.rmtree(scratch, ignore_errors=True)
        return True

    def remove(self, name: str) -> None:
        """Removes a file or folder from bucket and cache, if it is there."""
        with suppress(FileNotFoundError), _reached():
            self._bucket.delete([*self._names(name), name])
        self._cache.remove(name)

    def _names(self, folder: str) -> list[str]:
        with _reached():
            pages = _until(time.monotonic() + FETCH_S, self._bucket.list(prefix=folder))
            return [str(each["path"]) for page in pages for each in page]

    def _upload(self, name: str, path: Path) -> None:
        with _reached():
            self._bucket.put(name, path)

    def _download(self, name: str, target: Path, end: float) -> bool:
        target.parent.mkdir(parents=True, exist_ok=True)
        handle, unfinished = tempfile.mkstemp(prefix="unfinished-", dir=target.parent)
        try:
            with os.fdopen(handle, "wb") as file, _reached():
                for chunk in _until(end, self._bucket.get(name).stream(min_chunk_size=1)):  # as it comes
                    file.write(chunk)
            Path(unfinished).replace(target)
        except FileNotFoundError:
            return False
        finally:
            Path(unfinished).unlink(missing_ok=True)
        return True


@contextmanager
def _reached() -> Iterator[None]:
    """What a bucket's library raises is an OSError; that there is no such file stays FileNotFoundError."""
    from obstore.exceptions import BaseError

    try:
        yield
    except FileNotFoundError:
        raise
    except BaseError as error:
        raise OSError(str(error)) from error


def _until(end: float, pieces: Iterable[T]) -> Iterator[T]:
    """What comes until then. Raises OSError for more: a bucket that trickles would be waited for without end."""
    for piece in pieces:
        if time.monotonic() > end:
            raise OSError("the object store takes too long")
        yield piece


COMPLETE = "model.json"
"""A folder of artefacts is complete when it has this file."""


def _complete_last(path: Path) -> tuple[bool, str]:
    return path.name == COMPLETE, path.name


def file_store(settings: StorageSettings) -> FileStore:
    """Where do these settings say that files are?"""
    if settings.files_url:
        return BucketStore(settings.home, settings.files_url)
    return FolderStore(settings.home)
