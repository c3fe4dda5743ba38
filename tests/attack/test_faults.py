"""Faults of processes, disk and shared store under load: what was accepted is answered once, and nothing is left."""

from __future__ import annotations

import os
import stat
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from functools import partial
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

import psutil
import pytest
from benchmark.perf.service import Chaos, chaos_under_load, known
from benchmark.perf.service_processes import Service, running
from tests.api.fakes import STEP

from querycad.client import Client
from querycad_api.app import make_app
from querycad_api.settings import ApiSettings
from querycad_contracts.infrastructure import FileStore, StorageSettings, file_store, files

EXAMPLE = Path("examples/flange.step")
END_S = 30.0
SILENT_S = 40.0
"""Longer than a request may take."""
WHOLE = os.environ.get("QUERYCAD_ATTACK") == "whole"
ROOM_MIB = 4
LISTED = 1000
"""Pages of a list without end; then it ends after all, so that the test does."""
MADE = "<LastModified>2026-11-22T10:00:00.000Z</LastModified><ETag>a</ETag>"

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="processes are stopped and looked up as on Linux")


@pytest.fixture(scope="module")
def service(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Service]:
    with running(tmp_path_factory.mktemp("faults") / "home") as service:
        yield service


@pytest.mark.skipif(not WHOLE, reason="takes minutes: `make attack` has it")
def test_what_is_accepted_while_processes_are_stopped_and_killed_is_answered_once(service: Service) -> None:
    """SIGSTOP for three seconds, which no process notices, of each; SIGKILL of each; the store is restarted."""
    with Client(service.url) as client:
        found: Chaos = chaos_under_load(service, known(client, EXAMPLE), 120)
    assert len(found.blows) == 10
    assert (found.lost, found.changed, found.failed) == (0, 0, 0), found
    assert found.accepted == found.answered >= 60


@pytest.mark.skipif(not WHOLE, reason="takes minutes: `make attack` has it")
def test_what_processes_have_started_may_be_stopped_and_killed_as_well(service: Service) -> None:
    """Processes of tasks, interpreters, the kernel's: each as it is then found, stopped for two seconds, or killed."""

    def stop(process: psutil.Process) -> None:
        with suppress(psutil.Error):
            process.suspend()
            time.sleep(2)
            process.resume()

    def kill(process: psutil.Process) -> None:
        with suppress(psutil.Error):
            process.kill()

    with Client(service.url) as client:
        model = known(client, EXAMPLE)
        blows = [(f"{each.pid} stopped", partial(stop, each)) for each in service.inner()]
        blows += [(f"{each.pid} killed", partial(kill, each)) for each in service.inner()]
        found = chaos_under_load(service, model, 60, blows)
    assert len(found.blows) >= 12
    assert (found.lost, found.changed, found.failed) == (0, 0, 0), found
    assert found.accepted == found.answered >= 60


def test_files_of_the_service_are_its_users_alone(service: Service) -> None:
    with Client(service.url) as client:
        known(client, EXAMPLE)
    open_to_others = [
        path
        for path in service.home.rglob("*")
        if path.name != "serve.log"  # the test's own
        and not path.is_symlink()
        and stat.S_IMODE(path.lstat().st_mode) & 0o077
    ]
    assert list((service.home / "models").rglob("model.json"))
    assert open_to_others == []


def test_nothing_outlives_a_service_whose_first_process_is_killed(tmp_path: Path) -> None:
    with running(tmp_path / "home") as service:
        with Client(service.url) as client:
            known(client, EXAMPLE)
        main = psutil.Process(service.main_pid)
        started = main.children(recursive=True)
        assert len(started) >= 10
        main.kill()
        _, left = psutil.wait_procs(started, timeout=END_S)
        assert [process.cmdline() for process in left if process.status() != psutil.STATUS_ZOMBIE] == []


@contextmanager
def small_disk(place: Path) -> Iterator[Path]:
    """A file system of `ROOM_MIB` MiB."""
    place.mkdir()
    command = ["mount", "-t", "tmpfs", "-o", f"size={ROOM_MIB}m", "tmpfs", str(place)]
    if os.geteuid() != 0 or subprocess.run(command, capture_output=True, check=False).returncode != 0:
        pytest.skip("only the superuser may make a small file system here")
    try:
        yield place
    finally:
        subprocess.run(["umount", "--lazy", str(place)], check=True)


def test_an_upload_to_a_full_disk_is_507_leaves_nothing_and_may_be_tried_again(
    tmp_path: Path, redis_url: str, serving: Any
) -> None:
    with small_disk(tmp_path / "disk") as home:
        settings = ApiSettings(redis_url=redis_url, home=home, sandbox_url="http://127.0.0.1:1")
        (home / "filler").write_bytes(b"x" * (ROOM_MIB - 1) * 2**20)
        with serving(make_app(settings)) as client:
            large = {"file": ("a.step", STEP + b" " * 2 * 2**20)}
            full = client.post("/v1/models", files=large)
            assert (full.status_code, full.json()["title"]) == (507, "Disk full")
            assert (full.json()["retryable"], int(full.headers["retry-after"]) > 0) == (True, True)
            assert not list(home.glob("upload-*"))
            assert client.get("/v1/models").json()["total"] == 0
            (home / "filler").unlink()
            assert client.post("/v1/models", files=large).status_code == 202


class Bucket(BaseHTTPRequestHandler):
    """An object store that is `how`.

    'dead' (500), 'silent', 'slow' (stops half way), 'lying' (half of its promise), 'trickling' (a byte now and then),
    'endless' (a list that has always one page more).
    """

    how = "dead"
    asked = sent = 0

    def do_GET(self) -> None:
        type(self).asked += 1
        if self.how == "silent":
            time.sleep(SILENT_S)
            return
        if self.how == "dead":
            self.send_error(500)
            return
        if self.how == "endless":
            self._list()
            return
        self.send_response(200)
        self.send_header("Content-Length", "1000")
        self.send_header("Last-Modified", "Sun, 22 Nov 2026 10:00:00 GMT")
        self.send_header("ETag", '"a"')
        self.end_headers()
        if self.how == "trickling":
            with suppress(OSError):  # the other end has had enough
                for _ in range(500):
                    time.sleep(0.1)
                    self.wfile.write(b"x")
                    type(self).sent += 1
            return
        self.wfile.write(b"x" * 500)
        self.wfile.flush()
        if self.how == "slow":
            time.sleep(SILENT_S)
        self.close_connection = True

    def _list(self) -> None:
        names = [f"<Contents><Key>models/{self.asked}-{n}</Key><Size>1</Size>{MADE}</Contents>" for n in range(100)]
        more = f"<IsTruncated>true</IsTruncated><NextContinuationToken>{self.asked}</NextContinuationToken>"
        if self.asked >= LISTED:
            more = "<IsTruncated>false</IsTruncated>"
        time.sleep(0.01)
        body = f"<ListBucketResult>{more}{''.join(names)}</ListBucketResult>".encode()
        self.send_response(200)
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    do_HEAD = do_PUT = do_GET  # noqa: N815 - names that the library looks for

    def log_message(self, *_: object) -> None:
        """Nothing."""


@contextmanager
def bucket_that_is(how: str, home: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[FileStore]:
    """Files in such an object store."""
    monkeypatch.setattr(Bucket, "how", how)
    monkeypatch.setattr(Bucket, "asked", 0)
    monkeypatch.setattr(Bucket, "sent", 0)
    with ThreadingHTTPServer(("127.0.0.1", 0), Bucket) as server:
        server.daemon_threads, server.block_on_close = True, False
        threading.Thread(target=server.serve_forever, daemon=True).start()
        for name, value in {
            "AWS_ENDPOINT": f"http://127.0.0.1:{server.server_port}",
            "AWS_ALLOW_HTTP": "true",
            "AWS_REGION": "nowhere",
            "AWS_ACCESS_KEY_ID": "a",
            "AWS_SECRET_ACCESS_KEY": "b",
        }.items():
            monkeypatch.setenv(name, value)
        yield file_store(StorageSettings(home=home, files_url="s3://bucket"))
        server.shutdown()
    assert [path for path in home.rglob("*") if path.is_file()] == []


@pytest.mark.parametrize("how", ["dead", "lying", *(["slow", "silent"] if WHOLE else [])])
def test_an_object_store_that_fails_or_lies_is_an_error_and_keeps_no_half_a_file(
    how: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with bucket_that_is(how, tmp_path, monkeypatch) as store:
        with pytest.raises(OSError, match=r".+"):
            store.fetch("files/ab/abcd")
        assert 1 <= Bucket.asked <= 2 * (1 + files.RETRIES)


def test_an_object_store_that_trickles_without_end_is_given_up(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(files, "FETCH_S", 1.0)
    with bucket_that_is("trickling", tmp_path, monkeypatch) as store:
        with pytest.raises(OSError, match="takes too long"):
            store.fetch("files/ab/abcd")
        assert Bucket.sent < 100  # it offers one every tenth of a second


def test_a_list_without_end_is_given_up(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(files, "FETCH_S", 1.0)
    with bucket_that_is("endless", tmp_path, monkeypatch) as store:
        with pytest.raises(OSError, match="takes too long"):
            store.fetch_folder("models")
        assert 1 < Bucket.asked < LISTED
