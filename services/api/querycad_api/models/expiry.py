"""Removes what nobody needs any more: old pictures, views and sights, what broke off, and files that could not be read.

A picture that is asked for again is drawn again. What is in a bucket is expired by a rule of the bucket's own.
"""

from __future__ import annotations

import asyncio
import logging
import shutil
import time
from datetime import UTC, datetime, timedelta
from pathlib import Path

from redis.exceptions import RedisError

from querycad_api.dependencies import Application
from querycad_api.problems import ServiceUnavailable
from querycad_api.store.keyspace import DAY_S

from .service import delete

UNFINISHED = ("upload-*", "draw-*", "fetch-*")
"""Uploads, drawings and downloads that go under their own name once they are whole; a killed process leaves them."""

log = logging.getLogger(__name__)


async def expire(application: Application) -> None:
    """Looks once a day, until it is cancelled."""
    settings = application.settings
    while True:
        try:
            removed = await asyncio.to_thread(remove_expired, settings.home, settings.answers_days, time.time())
            failed = await drop_failed(application, datetime.now(UTC) - timedelta(days=settings.failed_days))
            log.info("tidied", extra={"removed": removed, "failed": failed})
        except (OSError, RedisError, ServiceUnavailable) as error:
            log.warning("not tidied: %s", error)
        await asyncio.sleep(DAY_S)


async def drop_failed(application: Application, before: datetime) -> int:
    """How many models that could not be read, and were uploaded before then, are gone now?"""
    found = await application.state.failed_models(before)
    for tenant, model in found:
        await delete(application, tenant, model)
    return len(found)


def remove_expired(home: Path, answers_days: int, now_s: float) -> int:
    """How many files and folders in `home` were too old at that time, and are gone now? Raises OSError."""
    aged = [(path, answers_days * DAY_S) for path in home.glob("pictures/*.png")]
    for made in ("drawn", "sight"):
        aged += [(path, answers_days * DAY_S) for path in home.glob(f"models/*/*/*/{made}/*")]
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
