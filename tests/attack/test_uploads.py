"""Uploads as an attack: archives that grow, files of two kinds, names, sizes, and bodies that break off."""

from __future__ import annotations

import contextlib
import gzip
import io
import json
import random
import socket
import struct
import time
import tracemalloc
import zipfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import httpx
import psutil
import pytest
from tests.api.fakes import STEP

from querycad_api.app import make_app
from querycad_api.models.uploads import NAME_CHARS
from querycad_api.settings import ApiSettings
from querycad_segworker import ingest as ingesting
from querycad_segworker.errors import FileProblem
from querycad_segworker.ingest import ingest
from querycad_segworker.model import ModelStore

EXAMPLE = Path("examples/flange.step")
ARCHIVE_BYTES = 16 * 2**20
"""What looking into an archive may take of the segworker's own memory: reading goes on in a process with limits."""
MOST_UNPACKED = 64 * 2**20
LARGE = 100 * 2**20
LARGE_BYTES = 48 * 2**20


def packed(method: int, size: int, name: str = "a.step") -> bytes:
    """A zip with one member that begins as STEP and then is blank."""
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", method) as archive, archive.open(name, "w", force_zip64=True) as member:
        member.write(b"ISO-10303-21;\n")
        for _ in range(size // 2**20):
            member.write(b" " * 2**20)
    return file.getvalue()


def crowded(count: int) -> bytes:
    """A zip whose directory names one member of 30 bytes so many times."""
    name = b"a"
    first = struct.pack("<4s5H3L2H", b"PK\x03\x04", 20, 0, 0, 0, 0, 0, 0, 0, len(name), 0) + name
    entry = struct.pack("<4s4B4HL2L5H2L", b"PK\x01\x02", 20, 0, 20, 0, 0, 0, 0, 0, 0, 0, 0, len(name), 0, 0, 0, 0, 0, 0)
    names = (entry + name) * count
    at, size = len(first), len(names)
    end64 = struct.pack("<4sQ2H2L4Q", b"PK\x06\x06", 44, 45, 45, 0, 0, count, count, size, at)
    place = struct.pack("<4sLQL", b"PK\x06\x07", 0, at + size, 1)
    end = struct.pack("<4s4H2LH", b"PK\x05\x06", 0, 0, 0xFFFF, 0xFFFF, 0xFFFFFFFF, 0xFFFFFFFF, 0)
    return first + names + end64 + place + end


def nested(depth: int) -> bytes:
    content = EXAMPLE.read_bytes()
    for _ in range(depth):
        content = gzip.compress(content)
    return content


def overlapping() -> bytes:
    """A zip of which two members are the same bytes, and one says that it is larger than it is."""
    content = bytearray(packed(zipfile.ZIP_DEFLATED, 2**20))
    at = content.rindex(b"PK\x01\x02")
    content[at + 24 : at + 28] = struct.pack("<L", 0xFFFFFFFE)
    return bytes(content)


ARCHIVES: dict[str, Callable[[], bytes]] = {
    "bzip2": lambda: packed(zipfile.ZIP_BZIP2, MOST_UNPACKED),
    "LZMA": lambda: packed(zipfile.ZIP_LZMA, MOST_UNPACKED),
    "deflate": lambda: packed(zipfile.ZIP_DEFLATED, MOST_UNPACKED),
    "3MF in bzip2": lambda: packed(zipfile.ZIP_BZIP2, MOST_UNPACKED, "3D/3dmodel.model"),
    "60,000 members": lambda: crowded(60_000),
    "2,000 members": lambda: crowded(2_000),
    "gzip in gzip": lambda: nested(2),
    "a size that is a lie": overlapping,
    "a zip of nothing": lambda: b"PK\x03\x04" + bytes(100),
    "a directory alone": lambda: b"PK\x03\x04" + struct.pack("<4s4H2LH", b"PK\x05\x06", 0, 0, 9, 9, 2**31, 4, 0),
}


@pytest.mark.parametrize("name", ARCHIVES)
def test_an_archive_is_refused_in_one_line_and_costs_no_memory(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """1.6 KB in bzip2 took 4 GB of the segworker, outside all limits; a directory of 45 MB took 360 MB."""
    monkeypatch.setattr(ingesting, "MAX_FILE_BYTES", MOST_UNPACKED)
    path = tmp_path / "a.zip"
    path.write_bytes(ARCHIVES[name]())
    tracemalloc.start()
    try:
        with pytest.raises(FileProblem) as refused:
            ingest(path, ModelStore(tmp_path / "store"))
        most = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert most < ARCHIVE_BYTES
    assert "\n" not in str(refused.value)
    assert not list((tmp_path / "store").glob("ingest-*"))


def _zip_behind(content: bytes) -> bytes:
    """A file with a zip behind it, which programs that look at the end take for the zip."""
    return content + packed(zipfile.ZIP_DEFLATED, 2**20)


def _step_behind(head: bytes) -> bytes:
    return head + EXAMPLE.read_bytes()


POLYGLOTS: dict[str, Callable[[], bytes]] = {
    "STEP and zip": lambda: _zip_behind(EXAMPLE.read_bytes()),
    "STEP and a page": lambda: EXAMPLE.read_bytes().replace(b"'", b"'<script>alert(1)</script>", 1),
    "STEP and a shell script": lambda: EXAMPLE.read_bytes() + b"\n#!/bin/sh\ntouch /tmp/owned\n",
    "PDF and STEP": lambda: _step_behind(b"%PDF-1.7\n"),
    "GIF and STEP": lambda: _step_behind(b"GIF89a"),
    "executable and STEP": lambda: _step_behind(b"\x7fELF"),
    "page and STEP": lambda: _step_behind(b"<!DOCTYPE html><script>alert(1)</script>"),
    "STL and STEP": lambda: _step_behind(b"solid a\nfacet normal 0 0 1\n"),
    "OBJ and STEP": lambda: _step_behind(b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
    "BREP and STEP": lambda: _step_behind(b"DBRep_DrawableShape\n\nCASCADE Topology V1\n"),
    "IGES and STEP": lambda: _step_behind(b" " * 72 + b"S      1\n"),
    "STEP twice": lambda: EXAMPLE.read_bytes() * 2,
    "STEP in UTF-16": lambda: EXAMPLE.read_text(encoding="utf-8").encode("utf-16"),
    "gzip with a tail": lambda: gzip.compress(EXAMPLE.read_bytes()) + b"ISO-10303-21;",
    "zip with a head": lambda: b"ISO-10303-21;\n" + packed(zipfile.ZIP_DEFLATED, 2**20),
    "nothing but a mark": lambda: b"\xef\xbb\xbf",
}


@pytest.mark.parametrize("name", POLYGLOTS)
def test_a_file_of_two_kinds_is_read_as_one_or_refused_in_one_line(name: str, tmp_path: Path) -> None:
    path = tmp_path / "a.step"
    path.write_bytes(POLYGLOTS[name]())
    try:
        told = ingest(path, ModelStore(tmp_path / "store")).model.read_text(encoding="utf-8")
        assert json.loads(told)["parts"]
    except FileProblem as refused:
        told = str(refused)
        assert "\n" not in told
        assert len(told) < 400
    assert not list((tmp_path / "store").glob("ingest-*"))


@pytest.fixture
def settings(redis_url: str, tmp_path: Path) -> ApiSettings:
    return ApiSettings(redis_url=redis_url, home=tmp_path / "home", upload_mib=128, sandbox_url="http://127.0.0.1:1")


@pytest.fixture
def client(settings: ApiSettings, serving: Any) -> Iterator[httpx.Client]:
    with serving(make_app(settings)) as client:
        yield client


def kept(settings: ApiSettings) -> int:
    """Bytes of what lies in the home."""
    return sum(path.stat().st_size for path in settings.home.rglob("*") if path.is_file())


def _letters(seed: int) -> str:
    rng = random.Random(seed)
    return "".join(rng.choices("./\\ %:;\"'<>|*?\x00\x1b\r\n\t\u202e\u2066\ufeff\U0001f525éa\x7f~$&", k=60)) + ".step"


NAMES = (
    "../../../../etc/passwd", "..\\..\\windows\\win.ini", "/etc/passwd", "a/../../b.step", "con", "nul.step", ".", "..",
    "", " ", "-rf", "$(touch /tmp/owned).step", "`id`.step", "a\x00.step", "a\r\nSet-Cookie: x=1.step",
    "\x1b]0;x\x07.step", "<img src=x onerror=alert(1)>.step", "\u202epets.step", "a" * 5000 + ".step", "é" * 300,
    "a\ud800.step", "%2e%2e%2f.step",
    *(_letters(seed) for seed in range(12)),
)  # fmt: skip


def test_a_name_leads_nowhere_and_is_shown_clean(client: httpx.Client, settings: ApiSettings) -> None:
    for number, name in enumerate(NAMES):
        quoted = name.encode("utf-8", "surrogatepass").replace(b'"', b"%22")
        body = b'--b\r\nContent-Disposition: form-data; name="file"; filename="' + quoted + b'"\r\n\r\n'
        body += STEP + str(number).encode() + b"\r\n--b--\r\n"
        response = client.post("/v1/models", content=body, headers={"Content-Type": "multipart/form-data; boundary=b"})
        assert response.status_code in (202, 400, 422), name
        assert "set-cookie" not in response.headers
        if response.status_code == 202:
            shown = response.json()["file_name"]
            assert shown.isprintable() or not shown.isascii()
            assert 0 < len(shown) <= NAME_CHARS
            assert not {"/", "\\", "\x00", "\x1b", "\r", "\n", "\u202e", "\ufeff"} & set(shown)
    assert {path.name for path in settings.home.parent.iterdir()} == {"home"}
    assert not Path("/tmp/owned").exists()  # noqa: S108 - what a name above would make


def test_100_mb_are_taken_and_the_api_keeps_none_of_it_in_memory(client: httpx.Client, settings: ApiSettings) -> None:
    client.post("/v1/models", files={"file": ("a.step", STEP + b"1")})
    before = psutil.Process().memory_info().rss

    def body() -> Iterator[bytes]:
        yield b'--b\r\nContent-Disposition: form-data; name="file"; filename="a.step"\r\n\r\n' + STEP
        for _ in range(LARGE // 2**20):
            yield b" " * 2**20
        yield b"\r\n--b--\r\n"

    headers = {"Content-Type": "multipart/form-data; boundary=b"}
    assert client.post("/v1/models", content=body(), headers=headers).status_code == 202
    assert psutil.Process().memory_info().rss - before < LARGE_BYTES
    assert kept(settings) >= LARGE


def test_more_than_is_accepted_leaves_nothing_however_it_comes(client: httpx.Client, settings: ApiSettings) -> None:
    def body() -> Iterator[bytes]:
        yield b'--b\r\nContent-Disposition: form-data; name="file"; filename="a.step"\r\n\r\n' + STEP
        for _ in range(140):
            yield b" " * 2**20

    headers = {"Content-Type": "multipart/form-data; boundary=b"}
    with contextlib.suppress(httpx.WriteError):  # it is refused before all has been sent
        assert client.post("/v1/models", content=body(), headers=headers).status_code == 413
    assert kept(settings) < 2**20


@pytest.mark.parametrize("how", ["half of it", "all of it", "gone"])
def test_a_client_that_closes_its_half_leaves_no_half_a_file(
    how: str, client: httpx.Client, settings: ApiSettings
) -> None:
    head = b"POST /v1/models HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Type: multipart/form-data; boundary=b\r\n"
    part = b'--b\r\nContent-Disposition: form-data; name="file"; filename="a.step"\r\n\r\n' + STEP + b" " * 2**21
    whole = part + b"\r\n--b--\r\n"
    sent = whole if how == "all of it" else part
    with socket.create_connection((client.base_url.host, client.base_url.port or 80), timeout=10) as connection:
        connection.sendall(head + b"Content-Length: %d\r\n\r\n" % len(whole) + sent)
        if how != "gone":
            connection.shutdown(socket.SHUT_WR)
            while connection.recv(65536):
                pass

    def settled() -> bool:
        """Is the file there with its model, or neither of them, and nothing half done?"""
        models = client.get("/v1/models").json()["total"]
        return not list(settings.home.glob("upload-*")) and (kept(settings) > 2**20) == bool(models)

    for _ in range(100):
        time.sleep(0.1)
        if settled():
            break
    assert settled()
    if sent is part:
        assert client.get("/v1/models").json()["total"] == 0
