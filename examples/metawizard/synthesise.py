"""Writes the skeleton of a robot program: pick the gear, bring it before the shaft, insert it along the axis.

    python -m metawizard.synthesise http://127.0.0.1:8000

What the program needs to know of the two models it asks over REST, by named parameters. What is not sure has no value:
then a person is asked, and without one there is no program. Metres, in the world's coordinates.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from metawizard.scene import BLOCK_IN_WORLD, FOLDER, GEAR_IN_WORLD, Matrix
from querycad import Client
from querycad_contracts import ParametersRequest, ParameterValue

OPENS = 0.06
"""How far the gripper opens."""
ROOM = 0.10
"""Before the gear, and before the shaft, where straight motions begin."""
SQUARE = 0.02
"""Sine of an angle: fingers that close along the insertion would stand in the shaft's way."""

Vector = NDArray[np.float64]
Person = Callable[[ParameterValue], Any]
"""Asked for what is not sure: the value, or None."""


class NotKnown(Exception):
    """Parameters that neither the models nor a person told; `str()` says which, and why."""


@dataclass(frozen=True, slots=True)
class Step:
    """One command. `pose` of the gripper: z the way that it looks, x the way that it closes; `width` of its fingers."""

    do: str
    pose: Matrix | None = None
    width: float | None = None

    def as_data(self) -> dict[str, Any]:
        """For JSON."""
        pose = None if self.pose is None else self.pose.round(9).tolist()
        return {"do": self.do} | ({"pose": pose} if pose else {}) | ({"width": self.width} if self.width else {})


Program = tuple[Step, ...]
GEAR: list[dict[str, Any]] = [
    {"name": "gear_center", "type": "point", "question": "What is the center of the object?"},
    {"name": "bore_insertion", "type": "insertion", "question": "Where is the bore?", "side": "bottom"},
    {"name": "bore_diameter", "type": "length"},
    {"name": "gear_grasps", "type": "grasps", "question": "Where is the object?", "at_most": OPENS},
]
BLOCK: list[dict[str, Any]] = [
    {"name": "shaft_axis", "type": "approach", "question": "Where is the tip of the shaft?"},
    {"name": "shaft_diameter", "type": "length"},
    {"name": "shaft_length", "type": "length", "description": "how far the shaft stands out"},
    {"name": "mates", "type": "mates", "description": "which bore of the gear takes the shaft"},
]


def nobody(_: ParameterValue) -> None:
    """There is no person to be asked."""


def asked_for(client: Client, person: Person = nobody) -> dict[str, Any]:
    """The parameters of both models, by name. Raises NotKnown, and the client's errors."""
    gear, block = (client.upload(FOLDER / f"{name}.step", wait_s=120).id for name in ("gear", "engine_block"))
    found = _filled(client, gear, GEAR, GEAR_IN_WORLD)
    found |= _filled(client, block, BLOCK, BLOCK_IN_WORLD, other=gear)
    values = {name: each.value if each.status == "answered" else person(each) for name, each in found.items()}
    missing = [f"{name}: {found[name].reason}" for name, value in values.items() if value is None]
    if missing:
        raise NotKnown("; ".join(missing))
    return values


def _filled(
    client: Client, model: str, parameters: list[dict[str, Any]], pose: Matrix, other: str | None = None
) -> dict[str, ParameterValue]:
    """Parameters in the world's coordinates, in which the model has that pose."""
    world = {"of": "given", "matrix": np.linalg.inv(pose).tolist()}
    asked = ParametersRequest.model_validate({"parameters": parameters, "unit": "m", "frame": world, "other": other})
    return {each.name: each for each in client.parameters(model, asked).parameters}


def program_of(known: Mapping[str, Any]) -> Program:
    """The program. Raises NotKnown where the values do not make one."""
    if not any(mate["clearance"] > 0 for mate in known["mates"]):
        raise NotKnown("the shaft has no clearance in the bore")
    lead, gear_way = (np.array(known["bore_insertion"][name]) for name in ("point", "direction"))
    tip, shaft_way = (np.array(known["shaft_axis"][name]) for name in ("point", "direction"))
    grasp = next((each for each in known["gear_grasps"] if abs(np.dot(each["closing"], gear_way)) < SQUARE), None)
    if grasp is None:
        raise NotKnown("no faces are opposite across the axis of the bore")
    depth = min(known["shaft_length"], known["mates"][0]["depth"])
    hold = _looking(np.array(grasp["center"]), gear_way, np.array(grasp["closing"]))
    held = np.linalg.inv(hold) @ np.append(lead, 1.0)  # the leading end of the bore, as the gripper has it

    def leading_at(place: Vector) -> Matrix:
        turned = _looking(np.zeros(3), shaft_way, np.array([0.0, 0.0, 1.0]))
        turned[:3, 3] = place - (turned @ held)[:3]
        return turned

    width, away = grasp["distance"], min(OPENS, 2 * grasp["distance"])
    return (
        Step("open", width=away),
        Step("move", _back(hold)),
        Step("straight", hold),
        Step("close", width=width),
        Step("straight", _back(hold)),
        Step("move", leading_at(tip - ROOM * shaft_way)),
        Step("straight", leading_at(tip + depth * shaft_way)),
        Step("open", width=away),
        Step("straight", _back(leading_at(tip + depth * shaft_way))),
    )


def _looking(place: Vector, z: Vector, x: Vector) -> Matrix:
    """The pose that looks along z, its x axis as near to `x` as can be."""
    if np.linalg.norm(np.cross(z, x)) < SQUARE:
        x = np.array([0.0, 1.0, 0.0]) if abs(z[1]) < 0.9 else np.array([1.0, 0.0, 0.0])
    x = x - np.dot(x, z) * z
    x = x / np.linalg.norm(x)
    pose = np.eye(4)
    pose[:3, :] = np.column_stack((x, np.cross(z, x), z, place))
    return pose


def _back(pose: Matrix) -> Matrix:
    """Away from where the gripper looks."""
    back = pose.copy()
    back[:3, 3] -= ROOM * pose[:3, 2]
    return back


def main() -> int:
    """Prints the program as JSON, a line a step."""
    if len(sys.argv) != 2:
        print(f"usage: python -m metawizard.{Path(__file__).stem} URL", file=sys.stderr)
        return 2
    with Client(sys.argv[1]) as client:
        try:
            program = program_of(asked_for(client))
        except NotKnown as error:
            print(f"a person has to be asked: {error}", file=sys.stderr)
            return 1
    for step in program:
        print(json.dumps(step.as_data()))
    return 0


if __name__ == "__main__":
    sys.exit(main())
