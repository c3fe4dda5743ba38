"""Files that nobody needs any more go; all others stay."""

from __future__ import annotations

import os
from pathlib import Path

from querycad_api.models.expiry import remove_expired
from querycad_api.store.keyspace import DAY_S

NOW_S = 1e9


def aged(path: Path, days: float) -> Path:
    os.utime(path, (NOW_S - days * DAY_S, NOW_S - days * DAY_S))
    return path


def file(path: Path, days: float) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(b"x")
    return aged(path, days)


def test_old_pictures_and_what_broke_off_go_and_nothing_else(tmp_path: Path) -> None:
    kept = [
        file(tmp_path / "pictures/new.png", 29),
        file(tmp_path / "files/ab/abcd", 400),
        file(tmp_path / "models/ab/abcd/v1/drawn/top.png", 29),
        file(tmp_path / "models/ab/abcd/v1/mesh.npz", 400),
        file(tmp_path / "upload-now", 0.9),
        file(tmp_path / "keys.json", 400),
    ]
    gone = [file(tmp_path / "pictures/old.png", 31), file(tmp_path / "upload-old", 1.1)]
    gone.append(file(tmp_path / "models/ab/abcd/v1/drawn/left.png", 31))
    gone.append(file(tmp_path / "models/ab/abcd/v1/sight/hole.png", 31))
    file(tmp_path / "draw-old/top.png", 1.1)
    gone.append(aged(tmp_path / "draw-old", 1.1))
    assert remove_expired(tmp_path, 30, NOW_S) == len(gone)
    assert all(path.exists() for path in kept)
    assert not any(path.exists() for path in gone)
    assert remove_expired(tmp_path, 30, NOW_S) == 0


def test_a_folder_that_is_not_there_yet_holds_nothing(tmp_path: Path) -> None:
    assert remove_expired(tmp_path / "none", 30, NOW_S) == 0
