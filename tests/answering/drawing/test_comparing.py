"""What changed between two models, part by part: on real geometry, read from files."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import pytest
from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import box, cut, cylinder, fuse, plate, shifted, write_step

from querycad import EmbeddedRuntime
from querycad.cli import main
from querycad_answering.drawing.comparing import compare
from querycad_contracts import ChangeKind, Comparison

BORE = cylinder(5, 30, (0, 0, -25))


def pin(x: float, y: float, radius: float = 2) -> TopoDS_Shape:
    return cylinder(radius, 30, (x, y, -25))


SHAPES = {
    "before": cut(plate(), BORE, pin(20, 10), pin(-20, 10), pin(-20, -10, 3)),
    "after": cut(plate(), cylinder(6, 30, (0, 0, -25)), pin(20, 12), pin(-20, 10), box((8, 6, 5), (10, -14, -5))),
    "shifted": shifted(cut(plate(), BORE, pin(20, 10), pin(-20, 10), pin(-20, -10, 3)), (100, 0, 7)),
    "slotted": cut(plate(), box((12, 5, 30), (-6, -15, -25))),
    "slotted and bored": cut(plate(), BORE, box((12, 5, 30), (-6, -15, -25))),
    "higher": fuse(cut(plate(), BORE, pin(20, 10), pin(-20, 10), pin(-20, -10, 3)), box((5, 5, 5), (20, -15, 0))),
}


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    folder = tmp_path_factory.mktemp("files")
    return {name: write_step(folder / f"{name}.step", shape) for name, shape in SHAPES.items()}


@pytest.fixture(scope="module")
def runtime(tmp_path_factory: pytest.TempPathFactory) -> Iterator[EmbeddedRuntime]:
    with EmbeddedRuntime(tmp_path_factory.mktemp("models")) as made:
        yield made


def compared(runtime: EmbeddedRuntime, files: dict[str, Path], before: str, after: str) -> Comparison:
    return runtime.open(files[before]).compare(runtime.open(files[after]))


def told(found: Comparison) -> set[tuple[ChangeKind, str, str]]:
    return {(each.kind, each.before, each.after) for each in found.changes}


def test_each_part_is_the_same_changed_moved_added_or_removed(runtime: EmbeddedRuntime, files: dict[str, Path]) -> None:
    found = compared(runtime, files, "before", "after")
    assert {
        (ChangeKind.CHANGED, "Ø10 THRU", "Ø12 THRU"),
        (ChangeKind.MOVED, "Ø4 THRU", "Ø4 THRU"),
        (ChangeKind.REMOVED, "Ø6 THRU", ""),
    } < told(found)
    (added,) = (each for each in found.changes if each.kind is ChangeKind.ADDED)
    assert added.after == "rectangular pocket 6 x 8 depth 5"
    (moved,) = (each for each in found.changes if each.kind is ChangeKind.MOVED)
    assert moved.by == pytest.approx((0, 0.002, 0))
    assert found.same == 1
    assert found.shift is None
    for text in ("Ø10 THRU -> Ø12 THRU", "Ø4 THRU by (0, 2, 0)", "1 part is the same", "mm³"):
        assert text in found.text


def test_the_way_back_is_the_reverse(runtime: EmbeddedRuntime, files: dict[str, Path]) -> None:
    turned = {ChangeKind.ADDED: ChangeKind.REMOVED, ChangeKind.REMOVED: ChangeKind.ADDED}
    there, back = compared(runtime, files, "before", "after"), compared(runtime, files, "after", "before")
    assert told(back) == {(turned.get(kind, kind), after, before) for kind, before, after in told(there)}


def test_a_model_is_the_same_as_itself_and_as_itself_elsewhere(
    runtime: EmbeddedRuntime, files: dict[str, Path]
) -> None:
    same = compared(runtime, files, "before", "before")
    assert (same.changes, same.shift, same.text) == ((), None, "no difference: 4 parts are the same")
    moved = compared(runtime, files, "before", "shifted")
    assert (moved.changes, moved.same) == ((), 4)
    assert moved.shift == pytest.approx((0.1, 0, 0.007))


def test_what_goes_through_does_not_move_as_its_way_in_is_told_from_the_other_side(
    runtime: EmbeddedRuntime, files: dict[str, Path]
) -> None:
    before, after = (runtime.open(files[name]) for name in ("slotted", "slotted and bored"))
    turned = [
        part.model_copy(update={"opening": (*part.center[:2], -0.02), "normal": (0.0, 0.0, -1.0)})
        if part.bottom == "through" and part.opening is not None
        else part
        for part in after.parts
    ]
    found = compare((before.summary, before.parts), (after.summary, turned))
    assert [each.kind for each in found.changes] == [ChangeKind.ADDED]


def test_a_mesh_is_said_to_be_approximate(runtime: EmbeddedRuntime, files: dict[str, Path]) -> None:
    model = runtime.open(files["before"])
    mesh = model.summary.model_copy(update={"warnings": ("read from a mesh: approximate",)})
    found = compare((model.summary, model.parts), (mesh, model.parts))
    assert found.warnings == ("after: read from a mesh: approximate",)
    assert found.text.endswith("note: after: read from a mesh: approximate")


def test_a_size_that_differs_is_told(runtime: EmbeddedRuntime, files: dict[str, Path]) -> None:
    found = compared(runtime, files, "before", "higher")
    assert "size 60 x 40 x 20 -> 60 x 40 x 25 mm" in found.text
    assert [each.kind for each in found.changes] == [ChangeKind.ADDED]
    assert found.same == 4


def test_the_command_prints_text_or_json(
    files: dict[str, Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("QUERYCAD_HOME", str(tmp_path))
    pair = [str(files["before"]), str(files["after"])]
    assert main(["compare", *pair, "--unit", "in"]) == 0
    assert "changed, in inches" in capsys.readouterr().out
    assert main(["compare", *pair, "--json"]) == 0
    assert Comparison.model_validate(json.loads(capsys.readouterr().out)).same == 1
    assert main(["compare", pair[0], str(tmp_path / "none.step")]) == 2
    assert "none.step" in capsys.readouterr().err
