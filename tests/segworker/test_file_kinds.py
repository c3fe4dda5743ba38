"""Files other than STEP: what is in them is the same, and archives are unpacked within bounds."""

from __future__ import annotations

import gzip
import zipfile
from pathlib import Path

import pytest
from OCP.BRepTools import BRepTools
from OCP.IGESControl import IGESControl_Writer
from tests.segworker.shapes import cut, cylinder, plate, write_step

from querycad_contracts import FileKind
from querycad_segworker.errors import FileProblem, FileTooLarge, IncompleteFile, NotStep
from querycad_segworker.files.unpack import unpack
from querycad_segworker.ingest import ingest
from querycad_segworker.model import ModelStore

SHAPE = cut(plate(), cylinder(5, 30, (0, 0, -25)))


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """The same drilled plate in every form."""
    folder = tmp_path_factory.mktemp("files")
    made = {"step": write_step(folder / "part.step", SHAPE)}
    made["brep"] = folder / "part.brep"
    BRepTools.Write_s(SHAPE, str(made["brep"]))
    made["iges"] = folder / "part.igs"
    writer = IGESControl_Writer("MM", 1)  # 1: solids
    writer.AddShape(SHAPE)
    writer.ComputeModel()
    assert writer.Write(str(made["iges"]))
    made["stpz"] = folder / "part.stpz"
    made["stpz"].write_bytes(gzip.compress(made["step"].read_bytes()))
    made["zip"] = folder / "part.zip"
    with zipfile.ZipFile(made["zip"], "w", zipfile.ZIP_DEFLATED) as archive:
        archive.write(made["step"], "../../folder/part.step")
        archive.writestr("readme.txt", "the part")
    return made


@pytest.fixture(scope="module")
def store(tmp_path_factory: pytest.TempPathFactory) -> ModelStore:
    return ModelStore(tmp_path_factory.mktemp("store"))


@pytest.mark.parametrize("form", ["step", "brep", "iges", "stpz", "zip"])
def test_the_same_part_is_recognised_in_every_form(files: dict[str, Path], store: ModelStore, form: str) -> None:
    artefacts = ingest(files[form], store)
    model = artefacts.load_model()
    (hole,) = (part for part in model.parts if part.kind == "hole")
    assert model.shape.extents == pytest.approx((0.06, 0.04, 0.02))
    assert model.shape.volume == pytest.approx(0.06 * 0.04 * 0.02 - 3.141592653589793 * 0.005**2 * 0.02)
    assert hole.diameter == pytest.approx(0.01)
    assert hole.depth == pytest.approx(0.02)
    assert "through" in hole.tags
    assert not (artefacts.folder / "unpacked").exists()
    if form in ("brep", "iges"):
        assert model.shape.name == "part"
    if form == "brep":
        assert any("no unit" in each for each in model.warnings)
    if form == "iges":
        assert model.units == ("millimetre",)
    assert len([body for body in model.shape.bodies if body.is_solid]) == 1


@pytest.mark.parametrize(
    ("members", "said"),
    [
        ({"a.txt": b"no model"}, "no CAD file"),
        ({"a.step": b"ISO-10303-21;", "b.step": b"ISO-10303-21;"}, r"2 CAD files .* a\.step, b\.step"),
        ({"a\x1b[31m.step": b"ISO-10303-21;", "b.step": b"ISO-10303-21;"}, r"a \[31m\.step"),
        ({"a.zip": b"PK\x03\x04"}, "archive in an archive"),
        ({f"{number}.txt": b"" for number in range(1001)}, "1001 files"),
    ],
)
def test_an_archive_without_one_model_is_refused_with_what_is_in_it(
    members: dict[str, bytes], said: str, tmp_path: Path, store: ModelStore
) -> None:
    path = tmp_path / "a.zip"
    with zipfile.ZipFile(path, "w") as archive:
        for name, data in members.items():
            archive.writestr(name, data)
    with pytest.raises(NotStep, match=said):
        ingest(path, store)
    assert not list(store.root.glob("ingest-*"))


@pytest.mark.parametrize("kind", [FileKind.GZIP, FileKind.ZIP])
def test_an_archive_ends_where_a_file_would_be_too_large(kind: FileKind, tmp_path: Path) -> None:
    """Whatever it says of itself: what is written is bounded."""
    path, target = tmp_path / "bomb", tmp_path / "out"
    data = b"ISO-10303-21;" + b"0" * (8 * 2**20)
    if kind is FileKind.GZIP:
        path.write_bytes(gzip.compress(data))
    else:
        with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
            archive.writestr("a.step", data)
    assert path.stat().st_size < 2**17
    with pytest.raises(FileTooLarge, match="unpacked"):
        unpack(path, kind, target, 2**21)
    assert target.stat().st_size <= 2**21
    unpack(path, kind, target, 2**24)
    assert target.read_bytes() == data


@pytest.mark.parametrize("form", ["stpz", "zip"])
def test_an_archive_that_is_cut_short_is_incomplete(files: dict[str, Path], form: str, tmp_path: Path) -> None:
    path = tmp_path / "cut"
    path.write_bytes(files[form].read_bytes()[:400])
    with pytest.raises(IncompleteFile, match="damaged or cut short"):
        ingest(path, ModelStore(tmp_path / "store"))


def test_an_encrypted_archive_says_so(files: dict[str, Path], tmp_path: Path) -> None:
    path = tmp_path / "locked.zip"
    data = bytearray(files["zip"].read_bytes())
    for mark, flags in ((b"PK\x03\x04", 6), (b"PK\x01\x02", 8)):
        at = data.find(mark)
        while at >= 0:
            data[at + flags] |= 1
            at = data.find(mark, at + 4)
    path.write_bytes(data)
    with pytest.raises(NotStep, match="encrypted"):
        ingest(path, ModelStore(tmp_path / "store"))


@pytest.mark.parametrize(
    "head", [b" " * 72 + b"S      1\n" + b"x" * 72, b"DBRep_DrawableShape\nrubbish", b"CASCADE Topology V9"]
)
def test_a_file_that_only_begins_like_one_is_a_sentence(head: bytes, tmp_path: Path) -> None:
    path = tmp_path / "part"
    path.write_bytes(head)
    with pytest.raises(FileProblem):
        ingest(path, ModelStore(tmp_path / "store"))
