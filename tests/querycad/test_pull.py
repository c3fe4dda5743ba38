"""Weights come onto the machine whole and right, or not at all."""

from __future__ import annotations

import hashlib
import threading
from collections.abc import Iterator
from dataclasses import dataclass, field
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import httpx
import pytest

from querycad.pull import Download, LocalFolder, PullFailed, pull
from querycad_segworker.segcad.engines.weights import RECORD, Check, Model, Role, WeightFile, check

CONTENT = bytes(range(256)) * 8192  # 2 MiB: more than one piece
DIGEST = hashlib.sha256(CONTENT).hexdigest()
PATH = "/team/net/resolve/abc/onnx/model.onnx"


@dataclass
class Hub:
    """A server that may cut its answers, know no ranges, or be busy."""

    files: dict[str, bytes] = field(default_factory=dict)
    cut_after: list[int] = field(default_factory=list)
    """Bytes after which each of the next answers breaks off."""
    ranges: bool = True
    busy: int = 0
    """Answers of 503 before the first real one."""
    asked: list[tuple[str, str | None]] = field(default_factory=list)
    url: str = ""

    def answer(self, handler: BaseHTTPRequestHandler) -> None:
        wanted = handler.headers.get("Range")
        self.asked.append((handler.path, wanted))
        if self.busy:
            self.busy -= 1
            handler.send_error(503)
            return
        content = self.files.get(handler.path)
        if content is None:
            handler.send_error(404)
            return
        start = int(wanted.removeprefix("bytes=").rstrip("-")) if wanted and self.ranges else 0
        if start >= len(content) > 0:
            handler.send_response(416)
            handler.send_header("Content-Range", f"bytes */{len(content)}")
            handler.send_header("Content-Length", "0")
            handler.end_headers()
            return
        handler.send_response(206 if start else 200)
        handler.send_header("Content-Length", str(len(content) - start))
        handler.end_headers()
        end = start + self.cut_after.pop(0) if self.cut_after else len(content)
        handler.wfile.write(content[start:end])
        if end < len(content):
            handler.close_connection = True


@pytest.fixture
def hub() -> Iterator[Hub]:
    hub = Hub({PATH: CONTENT})

    class Handler(BaseHTTPRequestHandler):
        protocol_version = "HTTP/1.1"

        def do_GET(self) -> None:
            hub.answer(self)

        def log_message(self, *args: object) -> None:
            pass

    server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    thread = threading.Thread(target=server.serve_forever, args=(0.01,), daemon=True)
    thread.start()
    hub.url = f"http://127.0.0.1:{server.server_address[1]}"
    yield hub
    server.shutdown()
    thread.join()
    server.server_close()


@pytest.fixture
def client() -> Iterator[httpx.Client]:
    with httpx.Client(trust_env=False) as client:
        yield client


def model(sha256: str | None = DIGEST) -> Model:
    file = WeightFile(name="model.onnx", path="onnx/model.onnx", size_mb=2, sha256=sha256)
    return Model(
        name="net", role=Role.DETECTOR, licence="MIT", repository="team/net", revision="abc", note="", files=(file,)
    )


def silent(name: str, done: int, total: int | None) -> None:
    pass


def test_a_file_is_downloaded_and_checked(hub: Hub, client: httpx.Client, tmp_path: Path) -> None:
    told: list[tuple[str, int, int | None]] = []
    outcome = pull(model(), tmp_path, Download(client, hub.url), lambda *step: told.append(step))
    assert outcome == [("model.onnx", Check.GOOD)]
    assert (tmp_path / "net/model.onnx").read_bytes() == CONTENT
    assert told[-1] == ("model.onnx", len(CONTENT), len(CONTENT))
    assert [done for _, done, _ in told] == sorted({done for _, done, _ in told})


def test_a_cut_download_goes_on_where_it_was_cut(hub: Hub, client: httpx.Client, tmp_path: Path) -> None:
    hub.cut_after = [700_000, 400_000]
    pull(model(), tmp_path, Download(client, hub.url, pause_s=0), silent)
    assert (tmp_path / "net/model.onnx").read_bytes() == CONTENT
    starts = [int(wanted[6:-1]) if wanted else 0 for _, wanted in hub.asked]
    assert len(starts) == 3
    assert 0 == starts[0] < starts[1] < starts[2] <= 1_100_000


def test_a_pull_that_gave_up_is_gone_on_with_by_the_next(hub: Hub, client: httpx.Client, tmp_path: Path) -> None:
    hub.cut_after = [100_000] * 4
    with pytest.raises(PullFailed, match="the same command goes on from there"):
        pull(model(), tmp_path, Download(client, hub.url, pause_s=0), silent)
    kept = (tmp_path / "net/model.onnx.part").stat().st_size
    assert 0 < kept <= 400_000
    assert not (tmp_path / "net/model.onnx").exists()
    hub.asked.clear()
    pull(model(), tmp_path, Download(client, hub.url), silent)
    assert hub.asked == [(PATH, f"bytes={kept}-")]
    assert (tmp_path / "net/model.onnx").read_bytes() == CONTENT


def test_a_server_without_ranges_sends_all_of_it_again(hub: Hub, client: httpx.Client, tmp_path: Path) -> None:
    hub.ranges, hub.cut_after = False, [700_000]
    pull(model(), tmp_path, Download(client, hub.url, pause_s=0), silent)
    assert (tmp_path / "net/model.onnx").read_bytes() == CONTENT


def test_a_part_that_was_whole_already_is_not_asked_for_again(hub: Hub, client: httpx.Client, tmp_path: Path) -> None:
    (tmp_path / "net").mkdir()
    (tmp_path / "net/model.onnx.part").write_bytes(CONTENT)
    pull(model(), tmp_path, Download(client, hub.url), silent)
    assert (tmp_path / "net/model.onnx").read_bytes() == CONTENT


def test_a_part_longer_than_the_file_is_thrown_away(hub: Hub, client: httpx.Client, tmp_path: Path) -> None:
    (tmp_path / "net").mkdir()
    (tmp_path / "net/model.onnx.part").write_bytes(CONTENT + b"more")
    pull(model(), tmp_path, Download(client, hub.url, pause_s=0), silent)
    assert (tmp_path / "net/model.onnx").read_bytes() == CONTENT


def test_a_busy_server_is_asked_again(hub: Hub, client: httpx.Client, tmp_path: Path) -> None:
    hub.busy = 2
    assert pull(model(), tmp_path, Download(client, hub.url, pause_s=0), silent) == [("model.onnx", Check.GOOD)]


def test_a_file_with_another_sum_is_refused_and_nothing_is_kept(hub: Hub, client: httpx.Client, tmp_path: Path) -> None:
    hub.files[PATH] = CONTENT[:-1] + b"\0"
    with pytest.raises(PullFailed, match="was not kept"):
        pull(model(), tmp_path, Download(client, hub.url), silent)
    assert [path.name for path in (tmp_path / "net").iterdir()] == [".lock"]


def test_a_part_of_something_else_is_noticed(hub: Hub, client: httpx.Client, tmp_path: Path) -> None:
    (tmp_path / "net").mkdir()
    (tmp_path / "net/model.onnx.part").write_bytes(b"something else")
    with pytest.raises(PullFailed, match="was not kept"):
        pull(model(), tmp_path, Download(client, hub.url), silent)
    assert pull(model(), tmp_path, Download(client, hub.url), silent) == [("model.onnx", Check.GOOD)]


def test_a_file_that_the_hub_has_not_is_said(hub: Hub, client: httpx.Client, tmp_path: Path) -> None:
    del hub.files[PATH]
    with pytest.raises(PullFailed, match=r"resolve/abc/onnx/model.onnx: the server answered 404"):
        pull(model(), tmp_path, Download(client, hub.url), silent)
    assert len(hub.asked) == 1


def test_no_server_is_said(client: httpx.Client, tmp_path: Path) -> None:
    with pytest.raises(PullFailed, match="could not be downloaded"):
        pull(model(), tmp_path, Download(client, "http://127.0.0.1:9", pause_s=0), silent)


@pytest.mark.parametrize("mirror", ["mirror.example/hub", "ftp://mirror.example", "http://[::1"])
def test_what_is_no_address_is_said_at_once(client: httpx.Client, tmp_path: Path, mirror: str) -> None:
    with pytest.raises(PullFailed, match="is no address to download from"):
        pull(model(), tmp_path, Download(client, mirror, pause_s=1e6), silent)


def test_what_is_there_and_right_is_not_asked_for(hub: Hub, client: httpx.Client, tmp_path: Path) -> None:
    pull(model(), tmp_path, Download(client, hub.url), silent)
    hub.asked.clear()
    assert pull(model(), tmp_path, Download(client, hub.url), silent) == [("model.onnx", Check.GOOD)]
    assert hub.asked == []


def test_a_spoilt_file_is_fetched_anew(hub: Hub, client: httpx.Client, tmp_path: Path) -> None:
    pull(model(), tmp_path, Download(client, hub.url), silent)
    (tmp_path / "net/model.onnx").write_bytes(b"spoilt")
    assert check(tmp_path / "net", model().files[0]) is Check.WRONG
    pull(model(), tmp_path, Download(client, hub.url), silent)
    assert (tmp_path / "net/model.onnx").read_bytes() == CONTENT


def test_a_sum_that_nobody_knows_is_recorded_and_compared_with_later(
    hub: Hub, client: httpx.Client, tmp_path: Path
) -> None:
    unknown = model(sha256=None)
    assert pull(unknown, tmp_path, Download(client, hub.url), silent) == [("model.onnx", Check.AS_PULLED)]
    assert (tmp_path / "net" / RECORD).read_text() == f"{DIGEST}  model.onnx\n"
    (tmp_path / "net/model.onnx").write_bytes(CONTENT + b"\0")
    assert check(tmp_path / "net", unknown.files[0]) is Check.WRONG


@pytest.mark.parametrize("place", ["net/model.onnx", "onnx/model.onnx"])
def test_a_local_folder_serves_as_well(tmp_path: Path, place: str) -> None:
    source = tmp_path / "source" / place
    source.parent.mkdir(parents=True)
    source.write_bytes(CONTENT)
    pull(model(), tmp_path / "weights", LocalFolder(tmp_path / "source"), silent)
    assert (tmp_path / "weights/net/model.onnx").read_bytes() == CONTENT


def test_a_local_folder_without_the_file_says_where_it_looked(tmp_path: Path) -> None:
    with pytest.raises(PullFailed) as raised:
        pull(model(), tmp_path / "weights", LocalFolder(tmp_path), silent)
    assert str(tmp_path / "net/model.onnx") in str(raised.value)
    assert str(tmp_path / "onnx/model.onnx") in str(raised.value)


def test_two_pulls_of_one_model_do_not_meet(hub: Hub, client: httpx.Client, tmp_path: Path) -> None:
    class Nested:
        def fetch(self, model: Model, file: WeightFile, part: Path, progress: object) -> None:
            pull(model, tmp_path, Download(client, hub.url), silent)

    with pytest.raises(PullFailed, match="another download"):
        pull(model(), tmp_path, Nested(), silent)
