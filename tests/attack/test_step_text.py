"""STEP text as an attack: what is looked at before the limited process is looked at once, whatever it repeats."""

from __future__ import annotations

import contextlib
import errno
import os
import time
from pathlib import Path

import pytest

from querycad_segworker import ingest as ingesting
from querycad_segworker.errors import DiskFull, FileProblem
from querycad_segworker.files.sniff import check_step, missing_entities
from querycad_segworker.ingest import ingest
from querycad_segworker.model import ModelStore

HEAD = b"ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n#1=(LENGTH_UNIT());\n"
END = b"ENDSEC;\nEND-ISO-10303-21;\n"
PIECES = (
    b"_FACE", b"SURFACE", b"DATA(", b"DATA ", b"DATA", b" ", b"\n", b"#", b"# ", b"#1", b"#1 ", b"'", b"''", b"(",
    b"/*",    b"_FACE ", b"SURFACE_", b"ISO-10303-21", b"\xef\xbb\xbf", b"\xff", b"9",
)  # fmt: skip


def seconds(path: Path, content: bytes) -> float:
    path.write_bytes(content)
    times = []
    for _ in range(4):
        start = time.thread_time()
        with contextlib.suppress(FileProblem):
            check_step(path)
        missing_entities(path)
        times.append(time.thread_time() - start)
    return min(times)


@pytest.mark.parametrize("head", [HEAD, b"ISO-10303-21;", b""], ids=["whole", "header", "nothing"])
@pytest.mark.parametrize("piece", PIECES, ids=ascii)
def test_twice_the_text_takes_twice_the_time(piece: bytes, head: bytes, tmp_path: Path) -> None:
    size = 60_000

    def text(size: int) -> bytes:
        return head + (piece * (size // len(piece))) + END

    small, large = seconds(tmp_path / "file.step", text(size)), seconds(tmp_path / "file.step", text(4 * size))
    assert large < 8 * small + 0.01  # four times the text: 4 where it is looked at once, 16 where again and again


def test_a_reference_of_5000_digits_is_no_reference(tmp_path: Path) -> None:
    path = tmp_path / "file.step"
    path.write_bytes(HEAD + b"#2=ADVANCED_FACE('',(#" + b"1" * 5000 + b"),#3,.T.);\n" + END)
    assert missing_entities(path) == [3]


def test_a_file_that_gives_an_error_is_refused_in_one_line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(_: Path) -> str:
        raise OSError(errno.EIO, os.strerror(errno.EIO))

    monkeypatch.setattr(ingesting, "file_sha256", broken)
    (tmp_path / "file.step").write_bytes(HEAD + END)
    with pytest.raises(FileProblem, match="cannot be read: Input/output error"):
        ingest(tmp_path / "file.step", ModelStore(tmp_path / "store"))


def test_a_full_disk_is_said_to_be_one_and_may_be_tried_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    store = ModelStore(tmp_path / "store")

    def full() -> Path:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(store, "scratch", full)
    with pytest.raises(DiskFull, match="disk of the service is full") as refused:
        ingest(Path("examples/flange.step"), store)
    assert refused.value.retryable


def test_a_disk_that_is_full_for_the_kernels_process_is_said_to_be_full(tmp_path: Path) -> None:
    """The child's own write fails: /dev/full in the place of what it keeps."""
    store = ModelStore(tmp_path / "store")
    scratch = store.scratch()
    (scratch / "mesh.npz").symlink_to("/dev/full")
    for name in ("faces.json", "model.json", "kernel_faces.bin"):
        (scratch / name).symlink_to("/dev/full")
    store.scratch = lambda: scratch  # type: ignore[method-assign]
    with pytest.raises(DiskFull):
        ingest(Path("examples/flange.step"), store)
