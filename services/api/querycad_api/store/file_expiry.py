"""Removes files that nobody needs any more: pictures of answers that are not kept any longer, and what broke off.

A picture that is asked for again is drawn again. What is in a bucket is expired by a rule of the bucket's own.
"""

from __future__ import annotations

import asyncio
import logging
import shutil
import time
from pathlib import Path

from querycad_api.settings import ApiSettings

from .keyspace import DAY_S

UNFINISHED = ("upload-*", "draw-*", "fetch-*")
"""Uploads, drawings and downloads that go under their own name once they are whole; a killed process leaves them."""

log = logging.getLogger(__name__)


async def expire_files(settings: ApiSettings) -> None:
    """Looks once a day, until it is cancelled."""
    while True:
        try:
            removed = await asyncio.to_thread(remove_expired, settings.home, settings.answers_days, time.time())
            log.info("tidied", extra={"removed": removed})
        except OSError as error:
            log.warning("not tidied: %s", error)
        await asyncio.sleep(DAY_S)


def remove_expired(home: Path, answers_days: int, now_s: float) -> int:
    """How many files and folders in `home` were too old at that time, and are gone now? Raises OSError."""
    aged = [(path, answers_days * DAY_S) for path in home.glob("pictures/*.png")]
    aged += [(path, DAY_S) for pattern in UNFINISHED for path in home.glob(pattern)]
    old = [path for path, age_s in aged if _changed_s(path) < now_s - age_s]
    for path in old:
        if path.is_dir():
            shutil.rmtree(path, ignore_errors=True)
        else:
            path.unlink(missing_ok=True)
    return len(old)


def _changed_s(path: Path) -> float:
    try:
        return path.stat().st_mtime
    except FileNotFoundError:  # another process was faster
        return float("inf")
