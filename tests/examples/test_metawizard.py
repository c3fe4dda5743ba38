"""The gear and the shaft: parameters make a program that a kinematic check accepts, and wrong ones are rejected."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from querycad.runtime import EmbeddedRuntime
from querycad_contracts import ParameterSet, ParametersRequest, ParameterValue

EXAMPLES = Path(__file__).parents[2] / "examples"
sys.path.append(str(EXAMPLES))

from metawizard.kinematics import Rejected, check  # noqa: E402
from metawizard.scene import BLOCK, BLOCK_IN_WORLD, FOLDER, GEAR, Matrix, at  # noqa: E402
from metawizard.synthesise import NotKnown, Program, Step, asked_for, program_of  # noqa: E402


class Embedded:
    """Answers as a service does, without one."""

    def __init__(self, runtime: EmbeddedRuntime) -> None:
        self._runtime = runtime
        self._files: dict[str, Path] = {}

    def upload(self, path: Path, wait_s: float) -> Any:
        assert wait_s
        model = f"{len(self._files):064x}"
        self._files[model] = path
        return type("Uploaded", (), {"id": model})

    def parameters(self, model: str, asked: ParametersRequest) -> ParameterSet:
        other = self._files[asked.other] if asked.other is not None else None
        return self._runtime.parameters(self._files[model], asked, other)


@pytest.fixture(scope="module")
def known() -> Iterator[dict[str, Any]]:
    with EmbeddedRuntime() as runtime:
        yield asked_for(Embedded(runtime))  # type: ignore[arg-type]


@pytest.fixture
def program(known: dict[str, Any]) -> Program:
    return program_of(known)


def test_the_parameters_are_what_the_scene_was_built_from(known: dict[str, Any]) -> None:
    tip = (BLOCK_IN_WORLD @ [BLOCK.shaft_x / 1e3, BLOCK.shaft_y / 1e3, (BLOCK.height + BLOCK.shaft_length) / 1e3, 1])[
        :3
    ]
    assert known["shaft_axis"]["point"] == pytest.approx(tip)
    assert known["shaft_axis"]["direction"] == pytest.approx(-BLOCK_IN_WORLD[:3, 2])
    assert known["shaft_diameter"] == pytest.approx(BLOCK.shaft / 1e3)
    assert known["bore_diameter"] == pytest.approx(GEAR.bore / 1e3)
    (mate,) = known["mates"]
    assert mate["clearance"] == pytest.approx((GEAR.bore - BLOCK.shaft) / 1e3)
    assert any(grasp["distance"] == pytest.approx(GEAR.flats / 1e3) for grasp in known["gear_grasps"])


def test_the_program_is_accepted(program: Program) -> None:
    check(program)
    assert [step.do for step in program].count("straight") == 4


def moved(program: Program, by: Callable[[int, Matrix], Matrix]) -> Program:
    return tuple(replace(step, pose=None if step.pose is None else by(n, step.pose)) for n, step in enumerate(program))


def shifted(x: float, y: float, z: float, steps: range) -> Callable[[int, Matrix], Matrix]:
    return lambda n, pose: at(x, y, z) @ pose if n in steps else pose


def turned(about: str, degrees: float, steps: range) -> Callable[[int, Matrix], Matrix]:
    def by(n: int, pose: Matrix) -> Matrix:
        changed = pose.copy()
        if n in steps:
            changed[:3, :3] = at(0, 0, 0, about, degrees)[:3, :3] @ pose[:3, :3]
        return changed

    return by


INSERTING = range(5, 9)
PICKING = range(1, 5)


@pytest.mark.parametrize(
    ("wrong", "why"),
    [
        (lambda p: moved(p, shifted(0, 0.0002, 0, INSERTING)), "touches the bore"),
        (lambda p: moved(p, turned("y", 3, INSERTING)), "touches the bore"),
        (lambda p: moved(p, turned("z", 180, INSERTING)), "."),
        (lambda p: moved(p, shifted(-0.03, 0, 0, INSERTING)), "runs into the block"),
        (lambda p: moved(p, shifted(0.05, 0, 0, INSERTING)), "not far enough"),
        (lambda p: moved(p, turned("z", 90, PICKING)), "do not close across"),
        (lambda p: moved(p, shifted(0, 0, -0.02, PICKING)), "beside the flats"),
        (lambda p: moved(p, shifted(0.001, 0, 0, PICKING)), "beside the flats"),
        (lambda p: tuple(replace(s, width=0.03) if s.do == "close" else s for s in p), "apart"),
        (lambda p: tuple(replace(s, width=0.02) if s.do == "open" else s for s in p), "too narrow"),
        (lambda p: tuple(replace(s, width=0.2) if s.do == "open" else s for s in p), "does not open"),
        (lambda p: (*p[:5], *p[6:]), "."),
        (lambda p: p[:5], "not on the shaft"),
        (lambda p: (*p[:5], Step("straight", p[6].pose), *p[7:]), "turns the gripper"),
    ],
)
def test_a_wrong_program_is_rejected(program: Program, wrong: Callable[[Program], Program], why: str) -> None:
    with pytest.raises(Rejected, match=why):
        check(wrong(program))


def test_without_what_is_not_sure_there_is_no_program(known: dict[str, Any]) -> None:
    tight = {**known, "mates": [{**known["mates"][0], "clearance": 0.0}]}
    with pytest.raises(NotKnown, match="clearance"):
        program_of(tight)
    along = [{**grasp, "closing": known["bore_insertion"]["direction"]} for grasp in known["gear_grasps"]]
    with pytest.raises(NotKnown, match="across"):
        program_of({**known, "gear_grasps": along})


def test_a_person_is_asked_for_what_is_not_sure(monkeypatch: pytest.MonkeyPatch) -> None:
    from metawizard import synthesise

    unsure = [{**synthesise.BLOCK[0], "type": "point", "question": "Where is the bolt hole?"}, *synthesise.BLOCK[1:]]
    monkeypatch.setattr(synthesise, "BLOCK", unsure)
    asked: list[ParameterValue] = []

    def person(parameter: ParameterValue) -> Any:
        asked.append(parameter)
        return parameter.alternatives[0].value

    with EmbeddedRuntime() as runtime:
        found = asked_for(Embedded(runtime), person)  # type: ignore[arg-type]
        with pytest.raises(NotKnown, match="shaft_axis: it may be"):
            asked_for(Embedded(runtime))  # type: ignore[arg-type]
    assert [each.name for each in asked] == ["shaft_axis"]
    assert np.shape(found["shaft_axis"]) == (3,)


def test_the_scene_is_rebuilt_byte_for_byte(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "metawizard.scene", str(tmp_path)]
    subprocess.run(command, env={"PYTHONPATH": str(EXAMPLES)}, check=True)
    for name in ("gear.step", "engine_block.step"):
        assert (tmp_path / name).read_bytes() == (FOLDER / name).read_bytes()
