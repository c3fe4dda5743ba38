"""The scripts: what they build is what they say, and the committed question files are theirs."""

from __future__ import annotations

from pathlib import Path

import pytest
from benchmark.build_all import QUESTIONS, load, names, question_file, write
from build123d import import_step

BUILT = ("manifold", "tie_rod", "centring_cone", "vent_cover")
"""One in inches, one oblique and of B-splines, one of loose surfaces, one of several bodies: all quick to build."""


@pytest.mark.parametrize("name", names())
def test_a_question_file_is_what_its_script_gives(name: str) -> None:
    assert (QUESTIONS / f"{name}.json").read_text() == question_file(load(name, build=False))


def test_every_question_file_has_its_script() -> None:
    assert sorted(path.stem for path in QUESTIONS.glob("*.json")) == names()


@pytest.mark.parametrize("name", BUILT)
def test_a_script_builds_the_valid_solids_it_names(name: str) -> None:
    script = load(name)
    assert script.shape.is_valid
    assert len(script.shape.solids()) == script.model.bodies
    assert all(solid.volume > 0 for solid in script.shape.solids())


@pytest.mark.parametrize("name", BUILT)
def test_the_file_holds_the_model_in_the_stated_form_and_unit(name: str, tmp_path: Path) -> None:
    script = load(name)
    step = write(name, tmp_path)
    text = step.read_text()
    read_back = import_step(step)
    solids = {"loose surfaces": 0}.get(script.model.form, script.model.bodies)
    assert len(read_back.solids()) == solids
    assert ("'INCH'" in text) == (script.model.unit == "in")
    assert ("B_SPLINE_SURFACE" in text) == (script.model.form == "b-spline")
    assert ("CYLINDRICAL_SURFACE" in text) == (script.model.form != "b-spline")
    rel = 3e-3 if script.model.form == "b-spline" else 1e-6  # the kernel's quadrature over B-splines is coarse
    assert read_back.area == pytest.approx(script.shape.area, rel=rel)
    for mine, theirs in zip(script.shape.bounding_box().size, read_back.bounding_box().size, strict=True):
        assert theirs == pytest.approx(mine, rel=1e-3)


def test_the_same_parameters_give_the_same_bytes(tmp_path: Path) -> None:
    first, second = tmp_path / "1", tmp_path / "2"
    for folder in (first, second):
        folder.mkdir()
        write("centring_cone", folder)
    assert (first / "centring_cone.step").read_bytes() == (second / "centring_cone.step").read_bytes()


@pytest.mark.parametrize(
    ("name", "part", "measure"), [("manifold", "object", "size"), ("vent_cover", "object", "extents")]
)
def test_the_stated_size_is_the_shapes(name: str, part: str, measure: str) -> None:
    script = load(name)
    (item,) = (i for i in script.items if (i.tags.part, i.tags.property) == (part, measure))
    assert isinstance(item.value, list)
    assert [value * 1000 for value in item.value] == pytest.approx(list(script.shape.bounding_box().size), abs=1e-5)


def test_the_stated_volume_is_the_shapes() -> None:
    script = load("clamp_block")
    (item,) = (i for i in script.items if i.type == "volume")
    assert item.value == pytest.approx(script.shape.volume * 1e-9, rel=1e-9)
