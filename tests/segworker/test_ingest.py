"""Reading a file: once, in a child whose death is only a sentence."""

from __future__ import annotations

import logging
import os
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import psutil
import pytest
from tests.segworker.shapes import box, cut, cylinder, plate, write_step

from querycad_segworker.errors import FileProblem, IncompleteFile, KernelDied, KernelKilled, NotStep
from querycad_segworker.ingest import IngestLimits, ingest
from querycad_segworker.kernel_process import start_host
from querycad_segworker.mesh import Mesh
from querycad_segworker.model import ModelStore, file_sha256

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def drilled(tmp_path_factory: pytest.TempPathFactory) -> Path:
    shape = cut(plate(), cylinder(5, 30, (0, 0, -25)))
    return write_step(tmp_path_factory.mktemp("models") / "drilled.step", shape)


@pytest.fixture(scope="module")
def store(tmp_path_factory: pytest.TempPathFactory) -> ModelStore:
    return ModelStore(tmp_path_factory.mktemp("store"))


@pytest.fixture(scope="module")
def stages(drilled: Path, store: ModelStore) -> list[str]:
    """The stages of the one real reading that this module's tests share."""
    found: list[str] = []
    ingest(drilled, store, progress=found.append)
    return found


def left_over(store: ModelStore) -> list[str]:
    return [path.name for path in store.root.glob("ingest-*")]


def test_the_stages_are_told_as_they_begin(stages: list[str]) -> None:
    assert stages == ["read", "measure", "tessellate", "look", "recognise"]


def test_the_artefacts_hold_the_model_its_faces_and_its_triangles(
    drilled: Path, store: ModelStore, stages: list[str]
) -> None:
    artefacts = ingest(drilled, store)
    model, faces, mesh = artefacts.load_model(), artefacts.load_faces(), Mesh.load(artefacts.mesh)
    assert model.sha256 == file_sha256(drilled)
    assert model.file_name == "drilled.step"
    assert model.shape.extents == pytest.approx((0.06, 0.04, 0.02))
    assert sum(part.kind == "hole" for part in model.parts) == 1
    assert [face.id for face in faces] == list(range(7)) == sorted(set(mesh.triangle_face.tolist()))
    assert set(model.timings_ms) == set(stages)
    assert artefacts.kernel_faces.stat().st_size > 0
    assert left_over(store) == []


@pytest.mark.parametrize("file_name", ["gear-rack.step", "gear-rack.step.gz"])
def test_a_file_that_holds_no_name_is_called_as_it_is_called(file_name: str, drilled: Path, tmp_path: Path) -> None:
    """'The rack' is then all of it."""
    model = ingest(drilled, ModelStore(tmp_path / "store"), file_name=file_name).load_model()
    assert model.shape.name == "gear-rack"


def test_a_known_file_is_not_read_again(drilled: Path, store: ModelStore, stages: list[str]) -> None:
    again: list[str] = []
    ingest(drilled, store, IngestLimits(duration_s=0.0), again.append)
    assert again == []


def test_the_same_content_under_another_name_is_not_read_again(
    drilled: Path, store: ModelStore, stages: list[str], tmp_path: Path
) -> None:
    copy = tmp_path / "other name.step"
    copy.write_bytes(drilled.read_bytes())
    again: list[str] = []
    assert ingest(copy, store, IngestLimits(duration_s=0.0), again.append) == ingest(drilled, store)
    assert again == []


SECOND_PROCESS = """
import sys
from pathlib import Path
from querycad_segworker.ingest import ingest, IngestLimits
from querycad_segworker.model import ModelStore
artefacts = ingest(Path(sys.argv[1]), ModelStore(Path(sys.argv[2])), IngestLimits(duration_s=0.0))
print(artefacts.load_model().shape.face_count, "OCP" in sys.modules)
"""


def test_a_new_process_finds_what_another_has_read_and_needs_no_kernel(
    drilled: Path, store: ModelStore, stages: list[str]
) -> None:
    command = [sys.executable, "-c", SECOND_PROCESS, str(drilled), str(store.root)]
    assert subprocess.run(command, capture_output=True, text=True, check=True).stdout.split() == ["7", "False"]


def test_two_who_read_one_file_at_once_get_the_same(tmp_path: Path) -> None:
    path = write_step(tmp_path / "block.step", box((10, 20, 30)))
    store = ModelStore(tmp_path / "store")
    with ThreadPoolExecutor(2) as pool:
        first, second = pool.map(lambda _: ingest(path, store), range(2))
    assert first == second
    assert first.load_model().shape.volume == pytest.approx(6e-6)
    assert left_over(store) == []


def test_a_crash_of_the_kernel_is_one_sentence(drilled: Path, tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    """A vector that refers to a direction which is not there kills the kernel."""
    text = drilled.read_text(encoding="ascii")
    direction = re.search(r"VECTOR\(''\s*,#(\d+)", text)
    assert direction is not None
    damaged = tmp_path / "damaged.step"
    damaged.write_text(re.sub(rf"#{direction[1]} = DIRECTION[^;]*;", "", text), encoding="ascii")
    store = ModelStore(tmp_path / "store")
    with pytest.raises(KernelDied, match=f"crashed.*refers to #{direction[1]},") as problem:
        ingest(damaged, store)
    assert "\n" not in str(problem.value)
    assert left_over(store) == []
    told = [record.getMessage() for record in caplog.records if record.levelno >= logging.INFO]
    assert len(told) == 1
    assert "code -11 on damaged.step" in told[0]
    assert "\n" not in told[0]


def test_a_kernel_that_does_not_finish_is_stopped(drilled: Path, tmp_path: Path) -> None:
    store = ModelStore(tmp_path)
    with pytest.raises(KernelDied, match="did not finish"):
        ingest(drilled, store, IngestLimits(duration_s=0.05))
    assert left_over(store) == []
    assert store.find(file_sha256(drilled)) is None


def test_a_kernel_that_needs_too_much_memory_is_stopped(drilled: Path, tmp_path: Path) -> None:
    store = ModelStore(tmp_path)
    with pytest.raises(KernelDied, match="more memory"):
        ingest(drilled, store, IngestLimits(memory_bytes=200 * 2**20))
    assert left_over(store) == []


def test_a_reading_that_is_killed_from_outside_is_not_blamed_on_the_file(tmp_path: Path) -> None:
    start_host()
    (host,) = (child for child in psutil.Process().children() if "querycad_segworker.kernel_host" in child.cmdline())

    def kill(stage: str) -> None:
        if stage == "measure":
            for reader in host.children():
                reader.kill()

    with pytest.raises(KernelKilled, match="was killed") as problem:
        ingest(ROOT / "examples/gear_shaft.step", ModelStore(tmp_path), progress=kill)
    assert problem.value.retryable


def test_a_problem_found_by_the_child_keeps_its_kind(tmp_path: Path) -> None:
    path = tmp_path / "units.step"
    text = write_step(tmp_path / "block.step", box((1, 1, 1))).read_text(encoding="ascii")
    path.write_text(text.replace("ADVANCED_BREP_SHAPE_REPRESENTATION", "SHAPE_REPRESENTATION_X"), encoding="ascii")
    with pytest.raises(FileProblem, match=r"kernel|no face") as problem:
        ingest(path, ModelStore(tmp_path / "store"))
    assert type(problem.value) is not FileProblem


def test_what_the_text_check_refuses_never_reaches_the_kernel(tmp_path: Path) -> None:
    path = tmp_path / "page.step"
    path.write_text("<html></html>", encoding="ascii")
    told: list[str] = []
    with pytest.raises(NotStep, match="HTML"):
        ingest(path, ModelStore(tmp_path / "store"), progress=told.append)
    assert told == []
    with pytest.raises(NotStep, match="no such file"):
        ingest(tmp_path / "nothing.step", ModelStore(tmp_path / "store"))


def test_a_file_with_a_byte_order_mark_is_read(drilled: Path, tmp_path: Path) -> None:
    path = tmp_path / "marked.step"
    path.write_bytes(b"\xef\xbb\xbf" + drilled.read_bytes())
    assert ingest(path, ModelStore(tmp_path / "store")).load_model().shape.face_count == 7


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="there are no named pipes")
def test_a_pipe_that_nobody_writes_to_is_not_waited_for(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe.step")
    with pytest.raises(NotStep, match="not a file"):
        ingest(tmp_path / "pipe.step", ModelStore(tmp_path / "store"))


@pytest.mark.skipif(os.geteuid() == 0, reason="the superuser may read every file")
def test_a_file_that_may_not_be_read_is_said_to_be_so(tmp_path: Path) -> None:
    path = write_step(tmp_path / "secret.step", box((1, 1, 1)))
    path.chmod(0)
    with pytest.raises(NotStep, match="no permission"):
        ingest(path, ModelStore(tmp_path / "store"))


def test_a_file_without_geometry_is_incomplete(tmp_path: Path) -> None:
    path = tmp_path / "empty.step"
    path.write_bytes(b"")
    with pytest.raises(IncompleteFile):
        ingest(path, ModelStore(tmp_path / "store"))
