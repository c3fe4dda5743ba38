"""Shared files: a folder, or an S3-compatible bucket with the folder as its cache, behave alike."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Iterator
from pathlib import Path

import httpx
import pytest

from querycad_contracts.infrastructure import BucketStore, FileStore, FolderStore, StorageSettings, file_store

FILE = "files/ab/abcd"
FOLDER = "models/ab/abcd/v1"
Opened = Callable[[str], FileStore]


@pytest.fixture(scope="session")
def bucket(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """Address of an S3-compatible server of this machine."""
    from moto.server import ThreadedMotoServer

    server = ThreadedMotoServer(ip_address="127.0.0.1", port=0, verbose=False)
    server.start()
    host, port = server.get_host_and_port()
    yield f"http://{host}:{port}"
    server.stop()


@pytest.fixture(params=["folder", "bucket"])
def opened(request: pytest.FixtureRequest, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Opened:
    """Opens the store as one of several machines sees it."""
    if request.param == "folder":
        return lambda _machine: FolderStore(tmp_path / "shared")
    endpoint = request.getfixturevalue("bucket")
    settings = {"ENDPOINT": endpoint, "ALLOW_HTTP": "true", "REGION": "us-east-1"}
    settings |= {"ACCESS_KEY_ID": "someone", "SECRET_ACCESS_KEY": "secret"}
    for name, value in settings.items():
        monkeypatch.setenv(f"AWS_{name}", value)
    httpx.post(f"{endpoint}/moto-api/reset").raise_for_status()
    httpx.put(f"{endpoint}/bucket").raise_for_status()
    return lambda machine: BucketStore(tmp_path / machine, "s3://bucket/some/prefix")


def put(store: FileStore, name: str, content: bytes) -> None:
    store.home.mkdir(parents=True, exist_ok=True)
    unfinished = store.home / "unfinished"
    unfinished.write_bytes(content)
    store.keep(name, unfinished)


def make_folder(store: FileStore) -> None:
    folder = store.home / FOLDER
    folder.mkdir(parents=True)
    for name in ("model.json", "mesh.npz", "z.bin"):
        (folder / name).write_text(name)


def test_a_kept_file_is_found_by_every_machine(opened: Opened) -> None:
    put(opened("one"), FILE, b"x" * 100_000)
    for machine in ("one", "two", "two"):
        path = opened(machine).fetch(FILE)
        assert path is not None
        assert path.read_bytes() == b"x" * 100_000
    assert not (opened("one").home / "unfinished").exists()


def test_a_file_that_is_not_there_is_none(opened: Opened) -> None:
    assert opened("one").fetch(FILE) is None
    assert not opened("one").fetch_folder(FOLDER)


def test_a_file_that_another_machine_removed_is_gone_for_all(opened: Opened) -> None:
    one, two = opened("one"), opened("two")
    put(one, FILE, b"x")
    assert two.fetch(FILE) is not None
    assert one.exists(FILE)
    assert two.exists(FILE)
    one.remove(FILE)
    assert not two.exists(FILE)


def test_a_folder_comes_whole_or_not_at_all(opened: Opened) -> None:
    one, two = opened("one"), opened("two")
    make_folder(one)
    put(one, f"{FOLDER}/drawn/top.png", b"picture")
    one.keep_folder(FOLDER)
    assert two.fetch_folder(FOLDER)
    found = sorted(path.name for path in (two.home / FOLDER).iterdir() if path.is_file())
    assert found == ["mesh.npz", "model.json", "z.bin"]
    drawn = two.fetch(f"{FOLDER}/drawn/top.png")
    assert drawn is not None
    assert drawn.read_bytes() == b"picture"


def test_a_folder_that_is_not_complete_is_not_taken(opened: Opened) -> None:
    one, two = opened("one"), opened("two")
    if isinstance(one, FolderStore):
        pytest.skip("a folder appears by a rename")
    make_folder(one)
    (one.home / FOLDER / "model.json").unlink()
    one.keep_folder(FOLDER)
    assert not two.fetch_folder(FOLDER)


def test_what_is_removed_is_gone_for_who_has_not_fetched_it(opened: Opened) -> None:
    one = opened("one")
    put(one, FILE, b"x")
    make_folder(one)
    one.keep_folder(FOLDER)
    one.remove(FILE)
    one.remove("models/ab/abcd")
    one.remove("models/ab/abcd")
    for machine in ("one", "two"):
        assert opened(machine).fetch(FILE) is None
        assert not opened(machine).fetch_folder(FOLDER)


def test_a_cache_that_is_deleted_is_filled_again(opened: Opened) -> None:
    one = opened("one")
    if isinstance(one, FolderStore):
        pytest.skip("a folder is no cache")
    put(one, FILE, b"x")
    shutil.rmtree(one.home)
    found = opened("one").fetch(FILE)
    assert found is not None
    assert found.read_bytes() == b"x"


def test_the_store_is_a_folder_unless_a_bucket_is_set(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert isinstance(file_store(StorageSettings(home=tmp_path)), FolderStore)
    monkeypatch.setenv("AWS_REGION", "us-east-1")
    assert isinstance(file_store(StorageSettings(home=tmp_path, files_url="s3://bucket")), BucketStore)
    with pytest.raises(ValueError, match="files_url"):
        StorageSettings(home=tmp_path, files_url="ftp://bucket")
