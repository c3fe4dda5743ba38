"""What do processes do about one another?"""

from __future__ import annotations

import ctypes
import os
import signal
import sys
from typing import Final

_PR_SET_PDEATHSIG: Final = 1


def keep_private(mask: int = 0o077) -> int:
    """Makes folders 0700 and files 0600 from now on, here and in what is started. What was the mask before?"""
    return os.umask(mask)


def processors() -> int:
    """How many processors may this process use? A container or `taskset` may allow fewer than the machine has."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def end_with_parent(by: signal.Signals = signal.SIGTERM) -> None:
    """Asks the system to end this process when its parent is killed; Linux only, elsewhere orphans stay."""
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, by)
