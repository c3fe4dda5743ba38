"""What all Celery workers have in common."""

from __future__ import annotations

import subprocess
import sys

import pytest

PROGRAM = """
import gc, os, sys
from celery.signals import worker_before_create_process
from querycad_contracts import Queue
from querycad_contracts.infrastructure import WorkerSettings
from querycad_contracts.infrastructure.workers import worker_app

def private_kib():
    with open("/proc/self/smaps_rollup") as file:
        return sum(int(line.split()[1]) for line in file if line.startswith("Private"))

worker_app("test", WorkerSettings(), [Queue.SEGCAD], processes=1, memory_mib=99, longest_s=9, store_tries=1)
kept = [[] for _ in range(300_000)]
worker_before_create_process.send(sender=None)
if os.fork() == 0:
    before = private_kib()
    gc.collect()
    print(private_kib() - before, flush=True)
    os._exit(0)
os.wait()
"""


@pytest.mark.skipif(sys.platform != "linux", reason="private pages are counted as on Linux")
def test_a_forked_process_that_collects_garbage_does_not_copy_what_it_inherits() -> None:
    """300,000 empty lists have 21 MiB, which a pass over them makes the fork's own."""
    done = subprocess.run([sys.executable, "-c", PROGRAM], capture_output=True, text=True, check=True, timeout=120)
    assert int(done.stdout) < 4096
