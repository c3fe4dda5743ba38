"""How fast is recognition, against another open recogniser and as models grow?

`python -m benchmark.recognition_speed versus [DIR]` times QueryCAD and quiddity on every STEP file below DIR (default:
the development half of CAD-Q&A), each file and system in a process of its own that may crash or run out of time.
`python -m benchmark.recognition_speed scaling [PICTURE]` times solids of 100 to 20,000 faces and draws the growth.
`python -m benchmark.recognition_speed sieve` times plates of 250 to 4,000 faces, all openings in one face.
`querycad bench perf` has both, on fewer and smaller files.

Processor seconds are compared, as they hardly depend on what else the machine does. Ours is everything after the file
is read: the face table with canonical surfaces, tessellation, the ray scene, thickness and recognition. Quiddity's is
its framed recognition of the imported part. Reading the file is left out on both sides.
"""

from __future__ import annotations

import argparse
import json
import math
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, fields
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from build123d import Part

DEFAULT_FILES = Path(__file__).parents[2] / "shared" / "cad-qa-dev"
TIMEOUT_S = 300.0
FACES_A_TILE = 92
OPENINGS = (100, 200, 400, 800, 1600)
TILES = (1, 3, 8, 24, 72, 220)  # 92 to about 20,000 faces


@dataclass(frozen=True, slots=True)
class Run:
    """What a system needed for a file, and how many records of which kind it gave; `failure` is empty if it ended."""

    system: str
    file: str
    seconds: float = math.nan
    faces: int = 0
    found: dict[str, int] | None = None
    failure: str = ""


def run(system: str, file: Path) -> Run:
    """One file in a process of its own."""
    name = str(file.parent.name if file.stem == "cad" else file.stem)
    command = [sys.executable, "-m", "benchmark.recognition_speed", "child", system, str(file)]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=TIMEOUT_S, check=False)
    except subprocess.TimeoutExpired:
        return Run(system, name, failure=f"no end within {TIMEOUT_S:g} s")
    if done.returncode:
        last = (done.stderr.strip().splitlines() or [""])[-1]
        return Run(system, name, failure=f"exit code {done.returncode}: {last}"[:160])
    return Run(system, name, **json.loads(done.stdout.strip().splitlines()[-1]))


def child(system: str, file: Path) -> None:
    """Prints seconds, faces and what was found as one JSON object."""
    seconds, faces, found = {"querycad": _ours, "quiddity": _quiddity}[system](file)
    print(json.dumps({"seconds": seconds, "faces": faces, "found": found}))


def _ours(file: Path) -> tuple[float, int, dict[str, int]]:
    from querycad_segworker.brep.extract import extract
    from querycad_segworker.brep.step import read_step
    from querycad_segworker.brep.tessellate import tessellate
    from querycad_segworker.features.recognise import recognise
    from querycad_segworker.features.sheet.material_thickness import material_thickness
    from querycad_segworker.vectors import dist
    from querycad_segworker.visibility.raycast import Scene

    content = read_step(file)
    start = time.process_time()
    extracted = extract(content)
    mesh = tessellate(extracted.faces, dist(*extracted.brep.box))
    scene = Scene(mesh)
    thickness = material_thickness(extracted.brep, mesh, scene)
    found = recognise(extracted.brep, scene.is_clear, thickness, mesh, scene.ahead)
    seconds = time.process_time() - start
    return seconds, len(extracted.brep.faces), dict(Counter(part.kind for part in found.parts))


def _quiddity(file: Path) -> tuple[float, int, dict[str, int]]:
    from quiddity import FramedRecognitionResult, build_framed_recognition_result, import_step_geometry

    part = import_step_geometry(str(file))
    start = time.process_time()
    framed = build_framed_recognition_result(part)
    seconds = time.process_time() - start
    if not isinstance(framed, FramedRecognitionResult):
        raise SystemExit(f"no result: {type(framed).__name__}")
    records = {field.name: getattr(framed.result, field.name) for field in fields(framed.result)}
    found = {name: len(value) for name, value in records.items() if isinstance(value, list | tuple) and value}
    return seconds, len(part.faces()), found


def versus(folder: Path) -> list[Run]:
    """Both systems on every file, one after the other."""
    files = sorted([*folder.rglob("*.step"), *folder.rglob("*.stp")])
    return [run(system, file) for file in files for system in ("querycad", "quiddity")]


def versus_table(runs: Sequence[Run]) -> str:
    """A Markdown table: seconds of both, their ratio, and what the other could not do."""
    lines = ["| model | faces | QueryCAD, s | quiddity, s | times | parts / records |", "|---|--:|--:|--:|--:|---|"]
    pairs = list(zip(runs[::2], runs[1::2], strict=True))
    for ours, theirs in pairs:
        times = f"{theirs.seconds / ours.seconds:.1f}" if not (ours.failure or theirs.failure) else "–"
        found = f"{_total(ours)} / {theirs.failure or _total(theirs)}"
        lines.append(f"| {ours.file} | {ours.faces} | {_s(ours)} | {_s(theirs)} | {times} | {found} |")
    both = [(a, b) for a, b in pairs if not (a.failure or b.failure)]
    ours_s, theirs_s = sum(a.seconds for a, _ in both), sum(b.seconds for _, b in both)
    total = f"**{theirs_s / ours_s:.1f}**" if both else "–"
    lines.append(f"| all that both came through | | {ours_s:.2f} | {theirs_s:.2f} | {total} | |")
    return "\n".join(lines)


def _total(one: Run) -> int:
    return sum((one.found or {}).values())


def _s(one: Run) -> str:
    return "–" if one.failure else f"{one.seconds:.2f}"


def terrace(tiles: int, file: Path) -> Path:
    """One solid of tiles in a row, higher and lower in turn, each with 12 square pockets and 13 blind holes: 92 faces.

    No face has more than 26 loops: the kernel's reading and meshing grow with their square.
    """
    from build123d import Align, Box, Circle, Plane, Pos, Rectangle, Sketch, export_step, extrude

    pitch, cells = 12.0, 5
    side = pitch * cells
    places = [((x + 0.5) * pitch, (y + 0.5) * pitch) for x in range(cells) for y in range(cells)]

    def tile(height: float) -> Part:
        squares = Sketch() + [Pos(x, y) * Rectangle(6, 6) for x, y in places[1::2]]
        circles = Sketch() + [Pos(x, y) * Circle(3) for x, y in places[::2]]
        top = Plane.XY.offset(height)
        block = Box(side, side, height, align=(Align.MIN, Align.MIN, Align.MIN))
        return block - extrude(top * squares, -8) - extrude(top * circles, -12)

    kinds = (tile(20), tile(26))
    placed = [Pos(side * number, 0, 0) * kinds[number % 2] for number in range(tiles)]
    body = placed[0].fuse(*placed[1:]) if tiles > 1 else placed[0]
    export_step(body, str(file))
    return file


def sieve(openings: int) -> Part:
    """A plate with round and square openings in turn, all in one face: 2.5 faces each."""
    from build123d import Edge, Face, Plane, Wire, extrude

    pitch, cells = 12.0, math.ceil(math.sqrt(openings))
    end = cells * pitch
    rims = []
    for number in range(openings):
        x, y = ((number % cells + 0.5) * pitch, (number // cells + 0.5) * pitch)
        square = [(x - 3, y - 3), (x + 3, y - 3), (x + 3, y + 3), (x - 3, y + 3)]
        circle = Edge.make_circle(3, Plane((x, y, 0)))
        rims.append(Wire([circle]) if number % 2 else Wire.make_polygon(square, close=True))
    outline = Wire.make_polygon([(0, 0), (end, 0), (end, end), (0, end)], close=True)
    return extrude(Face(outline, rims), 5, dir=(0, 0, 1))


def sieves(most: int) -> list[Run]:
    """Recognition alone on plates of ever more openings in one face, up to `most` faces.

    The kernel's reading and meshing of such a face grow with the square of its openings, and are left out.
    """
    from querycad_segworker.brep.extract import extract
    from querycad_segworker.brep.step import StepContent
    from querycad_segworker.brep.tessellate import tessellate
    from querycad_segworker.features.recognise import recognise
    from querycad_segworker.vectors import dist
    from querycad_segworker.visibility.raycast import Scene

    runs = []
    for openings in OPENINGS:
        if 2.5 * openings > most:
            break
        extracted = extract(StepContent(sieve(openings).wrapped, "sieve", ()))
        mesh = tessellate(extracted.faces, dist(*extracted.brep.box))
        scene = Scene(mesh)
        start = time.process_time()
        found = recognise(extracted.brep, scene.is_clear, mesh=mesh, ahead=scene.ahead)
        seconds = time.process_time() - start
        kinds = dict(Counter(str(part.kind) for part in found.parts))
        runs.append(Run("querycad", f"{openings} openings", seconds, len(extracted.brep.faces), kinds))
    return runs


def scaling(most: int = TILES[-1] * FACES_A_TILE) -> list[Run]:
    """Ours on one solid of a growing number of faces, up to `most`."""
    with tempfile.TemporaryDirectory(prefix="querycad-scaling-") as scratch:
        sizes = [tiles for tiles in TILES if tiles * FACES_A_TILE <= most]
        return [run("querycad", terrace(tiles, Path(scratch) / f"{tiles}.step")) for tiles in sizes]


def exponent(runs: Sequence[Run], power: Callable[[float], float] = lambda n: n * math.log(n)) -> float:
    """Which exponent of n log n fits the times best, least squares in logarithms? 1 is n log n, less is better."""
    points = [(math.log(power(one.faces)), math.log(one.seconds)) for one in runs if not one.failure]
    mean_x = sum(x for x, _ in points) / len(points)
    mean_y = sum(y for _, y in points) / len(points)
    return sum((x - mean_x) * (y - mean_y) for x, y in points) / sum((x - mean_x) ** 2 for x, _ in points)


def draw(runs: Sequence[Run], picture: Path) -> None:
    """Times over faces, both logarithmic, beside n log n through the first point."""
    import matplotlib as mpl

    mpl.use("svg")
    mpl.rcParams.update({"svg.hashsalt": "querycad", "font.size": 9})
    from matplotlib import pyplot as plt

    came = [one for one in runs if not one.failure]
    faces = [one.faces for one in came]
    first = came[0]
    scale = first.seconds / (first.faces * math.log(first.faces))
    figure, axes = plt.subplots(figsize=(5.6, 3.6))
    axes.loglog(faces, [one.seconds for one in came], "o-", label="recognition, reading left out")
    axes.loglog(faces, [scale * n * math.log(n) for n in faces], "--", color="0.5", label="n log n through the first")
    axes.set(xlabel="faces", ylabel="processor seconds")
    axes.grid(visible=True, which="major", color="0.9")
    axes.legend(frameon=False)
    figure.tight_layout()
    figure.savefig(picture, metadata={"Date": None})


def _as_json(one: Run) -> str:
    return json.dumps({**asdict(one), "seconds": 0.0 if one.failure else one.seconds})


def main(arguments: Sequence[str] | None = None) -> int:
    """Prints the table that was asked for; 1 when a file of ours did not come through."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    versus_parser = commands.add_parser("versus", help="against quiddity")
    versus_parser.add_argument("folder", type=Path, nargs="?", default=DEFAULT_FILES)
    scaling_parser = commands.add_parser("scaling", help="as models grow")
    scaling_parser.add_argument("picture", type=Path, nargs="?", help="an SVG file")
    scaling_parser.add_argument("--most", type=int, default=TILES[-1] * FACES_A_TILE, help="faces (default: all)")
    scaling_parser.add_argument("--json", action="store_true", help="the figures as one JSON object")
    sieve_parser = commands.add_parser("sieve", help="as openings in one face become more")
    sieve_parser.add_argument("--most", type=int, default=math.ceil(2.5 * OPENINGS[-1]), help="faces (default: all)")
    time_parser = commands.add_parser("time", help="one file and system, as one JSON object")
    child_parser = commands.add_parser("child", help="one file, used by the other two")
    for each in (time_parser, child_parser):
        each.add_argument("system", choices=("querycad", "quiddity"))
        each.add_argument("file", type=Path)
    options = parser.parse_args(arguments)
    if options.command == "child":
        child(options.system, options.file)
        return 0
    if options.command == "time":
        print(_as_json(run(options.system, options.file)))
        return 0
    if options.command == "versus":
        if not options.folder.is_dir():
            parser.error(f"{options.folder} is no folder")
        runs = versus(options.folder)
        print(versus_table(runs))
        return int(any(one.failure for one in runs if one.system == "querycad"))
    runs = sieves(options.most) if options.command == "sieve" else scaling(options.most)
    if options.command != "sieve" and options.json:
        print(f'{{"runs": [{", ".join(map(_as_json, runs))}], "exponent": {exponent(runs)}}}')
        return 0
    for one in runs:
        print(f"{one.faces:6} faces {one.seconds:8.2f} s {one.failure}")
    print(f"time grows as (n log n)^{exponent(runs):.2f}")
    if options.command != "sieve" and options.picture:
        draw(runs, options.picture)
    return int(any(one.failure for one in runs))


if __name__ == "__main__":
    sys.exit(main())
