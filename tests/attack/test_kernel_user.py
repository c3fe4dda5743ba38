"""The user of the kernel's processes: nobody else's, and what he made is given back."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import psutil
import pytest

from querycad_segworker.ingest import ingest
from querycad_segworker.kernel_process import USER, KernelProcess, _host, start_host, take_back, user_of_work
from querycad_segworker.model import Artefacts, ModelStore

EXAMPLE = Path("examples/flange.step")
NAMES = {"model.json", "faces.json", "refused.json", "mesh.npz", "face_pairs.npy", "faces.bin"}
pytestmark = pytest.mark.skipif(os.geteuid() != 0, reason="who is not root has no other user to become")
WITHOUT_SETUID = """
import ctypes, os, sys
ctypes.CDLL(None).prctl(24, 7, 0, 0, 0)  # PR_CAPBSET_DROP, CAP_SETUID
os.execv(sys.executable, [sys.executable, "-c", sys.argv[1], *sys.argv[2:]])
"""
READS = """
import sys
from pathlib import Path
from querycad_segworker.ingest import ingest
from querycad_segworker.model import ModelStore
print(ingest(Path(sys.argv[1]), ModelStore(Path(sys.argv[2]))).load_model().warnings)
"""


@pytest.fixture(scope="module")
def kept(tmp_path_factory: pytest.TempPathFactory) -> Artefacts:
    """What is kept of a file that nobody else may open, in a folder that nobody else may enter."""
    folder = tmp_path_factory.mktemp("private")
    folder.chmod(0o700)
    source = folder / "part.step"
    source.write_bytes(EXAMPLE.read_bytes())
    source.chmod(0o600)
    return ingest(source, ModelStore(folder / "store"))


def test_the_work_is_done_by_a_user_who_has_nothing_else(kept: Artefacts) -> None:
    start_host()
    with KernelProcess("measure", str(kept.kernel_faces)) as process:
        process.say(json.dumps({"what": "distance", "first": [0], "second": [1]}))
        assert "value" in process.stdout.readline()
        (worker,) = psutil.Process(_host._process.pid).children()  # type: ignore[union-attr]
        status = Path(f"/proc/{worker.pid}/status").read_text()
    said = dict(line.split(":", 1) for line in status.splitlines())
    assert said["Uid"].split() == said["Gid"].split() == [str(USER)] * 4
    assert said["Groups"].split() == []
    assert int(said["CapEff"], 16) == int(said["CapPrm"], 16) == 0


def test_he_reads_what_he_may_not_open_and_what_he_made_is_given_back(kept: Artefacts) -> None:
    paths = [kept.folder, *kept.folder.rglob("*")]
    assert {path.name for path in paths[1:]} == NAMES  # and no copy of the file
    assert {(path.stat().st_uid, path.stat().st_gid) for path in paths} == {(0, os.getegid())}
    assert {path.stat().st_mode & 0o7777 for path in paths} == {0o700, 0o600}


def test_a_file_that_is_refused_leaves_nothing_of_his(tmp_path: Path) -> None:
    (tmp_path / "bad.brep").write_text("DBRep_DrawableShape\n" + "x" * 200)
    with pytest.raises(Exception, match="BREP"):
        ingest(tmp_path / "bad.brep", ModelStore(tmp_path / "store"))
    assert list((tmp_path / "store").iterdir()) == []


def test_what_was_planted_is_harmless_or_gone(tmp_path: Path) -> None:
    secret = tmp_path / "secret"
    secret.write_text("root's")
    secret.chmod(0o600)
    given = tmp_path / "given"
    (given / "deep").mkdir(parents=True)
    (given / "link").symlink_to(secret)
    (given / "deep" / "folder").symlink_to(tmp_path)
    os.mkfifo(given / "pipe")
    (given / "deep" / "program").write_text("#!/bin/sh")
    for path in (given, given / "deep", given / "deep" / "program"):
        os.chown(path, USER, USER)
    (given / "deep" / "program").chmod(0o6777)
    take_back(given)
    assert {path.name for path in given.rglob("*")} == {"deep", "program"}
    assert {path.stat().st_uid for path in (given, *given.rglob("*"))} == {0}
    assert (given / "deep" / "program").stat().st_mode & 0o7777 == 0o600
    assert secret.read_text() == "root's"


def test_root_who_may_not_become_another_reads_no_file_unless_it_is_said_so(tmp_path: Path) -> None:
    command = [sys.executable, "-c", WITHOUT_SETUID, READS, str(EXAMPLE), str(tmp_path)]
    for walls, code in (("required", 1), ("available", 0)):
        environment = os.environ | {"QUERYCAD_WALLS": walls}
        done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False, env=environment)
        assert done.returncode == code, done.stderr
        assert "unprivileged_user" in (done.stdout if code == 0 else done.stderr.splitlines()[-1])


def test_who_is_not_root_does_the_work_himself() -> None:
    told, tell = os.pipe()
    child = os.fork()
    if not child:
        try:
            os.setresuid(65532, 65532, 65532)
            os.write(tell, repr(user_of_work()).encode())
        finally:
            os._exit(0)
    os.waitpid(child, 0)
    os.close(tell)
    with os.fdopen(told) as answer:
        assert answer.read() == "None"
