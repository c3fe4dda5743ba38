"""The kernel's process: what a file that takes it over would find, and what of a file's names gets out of it."""

from __future__ import annotations

import re
from pathlib import Path

import psutil
import pytest
from OCP.BRepTools import BRepTools
from OCP.IGESControl import IGESControl_Writer
from tests.segworker.shapes import cut, cylinder, plate

from querycad_segworker.errors import UnreadableFile
from querycad_segworker.ingest import IngestLimits, ingest
from querycad_segworker.kernel_process import _host, start_host
from querycad_segworker.model import ModelStore

EXAMPLE = Path("examples/flange.step")


def test_the_kernels_process_knows_no_password_of_the_services(monkeypatch: pytest.MonkeyPatch) -> None:
    _host.stop()
    monkeypatch.setenv("QUERYCAD_REDIS_URL", "redis://:hunter2@store:6379/0")
    monkeypatch.setenv("QUERYCAD_LLM_API_KEY", "hunter2")
    monkeypatch.setenv("AWS_SECRET_ACCESS_KEY", "hunter2")
    start_host()
    assert _host._process is not None
    environment = psutil.Process(_host._process.pid).environ()
    assert "PATH" in environment
    assert not [name for name, value in environment.items() if "hunter2" in value]


def test_control_characters_of_a_name_are_left_behind(tmp_path: Path) -> None:
    text = EXAMPLE.read_text(encoding="utf-8")
    name = text.split("PRODUCT('", 1)[1].split("'", 1)[0]
    evil = "a\\X2\\001B\\X0\\]0;owned\\X2\\0007\\X0\\\\X2\\202E\\X0\\b"
    (tmp_path / "evil.step").write_text(text.replace(f"'{name}'", f"'{evil}'"), encoding="utf-8")
    model = ingest(tmp_path / "evil.step", ModelStore(tmp_path / "store")).model.read_text(encoding="utf-8")
    assert "owned" in model
    assert not [char for char in ("\x1b", "\\u001b", "\x07", "\\u0007", "\u202e", "\\u202e") if char in model]


def test_memory_of_the_kernels_process_is_limited_as_a_rule(tmp_path: Path) -> None:
    assert IngestLimits().memory_bytes == 4 * 2**30
    assert ingest(EXAMPLE, ModelStore(tmp_path)).model.is_file()


@pytest.mark.parametrize("number", ["1.E300", "NaN", "-1.E400", "INF", "1.E150", "1.E+0300"])
@pytest.mark.parametrize("entity", ["CARTESIAN_POINT", "CYLINDRICAL_SURFACE"])
def test_a_number_that_is_none_is_refused_with_its_entity(number: str, entity: str, tmp_path: Path) -> None:
    """They hung the kernel, were written as null, or became lengths of 1E297 m."""
    places = list(
        re.finditer(rf"#(\d+) ?= ?{entity}\('',.*?([\d.Ee+-]+)\){{1,2}};", EXAMPLE.read_text(encoding="utf-8"))
    )
    place = places[len(places) // 2]
    text = EXAMPLE.read_text(encoding="utf-8")
    (tmp_path / "a.step").write_text(text[: place.start(2)] + number + text[place.end(2) :], encoding="utf-8")
    with pytest.raises(UnreadableFile, match=rf"#{place[1]} holds {re.escape(number)}"):
        ingest(tmp_path / "a.step", ModelStore(tmp_path / "store"))


@pytest.fixture(scope="module")
def others(tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    """A drilled plate in IGES and BREP."""
    folder = tmp_path_factory.mktemp("others")
    shape = cut(plate(), cylinder(5.123456, 30, (0, 0, -25)))
    BRepTools.Write_s(shape, str(folder / "a.brep"))
    writer = IGESControl_Writer("MM", 1)
    writer.AddShape(shape)
    writer.ComputeModel()
    assert writer.Write(str(folder / "a.iges"))
    return {path.suffix: path.read_bytes() for path in folder.iterdir()}


@pytest.mark.parametrize("number", ["1.E300", "NaN", "INF", "-inf", "1.D+300", "1E400"])
@pytest.mark.parametrize(("kind", "where"), [(".iges", r"D\d+"), (".brep", r"line \d+")])
def test_a_number_that_is_none_is_refused_in_other_files_too(
    kind: str, where: str, number: str, others: dict[str, bytes], tmp_path: Path
) -> None:
    """NaN in IGES was read as if nothing were wrong with it; others hung the kernel or crashed it."""
    text = others[kind]
    places = list(re.finditer(rb"(?<=,)\d\.\d{5,}(?=,)" if kind == ".iges" else rb"(?<=\d )\d+(?= \d)", text))
    place = places[len(places) // 2]
    data = number.encode().ljust(place.end() - place.start())  # lines of IGES have columns
    path = tmp_path / f"a{kind}"
    path.write_bytes(text[: place.start()] + data + text[place.end() :])
    with pytest.raises(UnreadableFile, match=rf"damaged: {where} holds {re.escape(number)}"):
        ingest(path, ModelStore(tmp_path / "store"))


@pytest.mark.parametrize("kind", [".iges", ".brep"])
def test_numbers_of_a_sound_file_are_fine(kind: str, others: dict[str, bytes], tmp_path: Path) -> None:
    (tmp_path / f"a{kind}").write_bytes(others[kind])
    assert ingest(tmp_path / f"a{kind}", ModelStore(tmp_path / "store")).model.is_file()


def test_a_measure_beyond_all_bounds_is_refused(tmp_path: Path) -> None:
    text = EXAMPLE.read_text(encoding="utf-8")
    place = next(re.finditer(r"CARTESIAN_POINT\('',\(([^,]*),", text))
    (tmp_path / "a.step").write_text(text[: place.start(1)] + "1.E90" + text[place.end(1) :], encoding="utf-8")
    with pytest.raises(UnreadableFile, match="beyond all bounds"):
        ingest(tmp_path / "a.step", ModelStore(tmp_path / "store"))


def test_a_name_may_hold_such_a_number(tmp_path: Path) -> None:
    text = EXAMPLE.read_text(encoding="utf-8")
    name = text.split("PRODUCT('", 1)[1].split("'", 1)[0]
    (tmp_path / "a.step").write_text(text.replace(f"'{name}'", "'a(1.E300,NaN)'"), encoding="utf-8")
    assert ingest(tmp_path / "a.step", ModelStore(tmp_path / "store")).model.is_file()
