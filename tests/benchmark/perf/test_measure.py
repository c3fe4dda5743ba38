from __future__ import annotations

import io
import json
import subprocess
import sys
from pathlib import Path

import pytest
from benchmark.perf.figures import Measurement, NotMeasured, Series
from benchmark.perf.measure import PARTS, Measurements, PartMeasurements, PerfOptions, measure, print_measurements
from benchmark.perf.plots import draw
from benchmark.scoring.items import BadBenchmark
from PIL import Image
from rich.console import Console

EXAMPLES = Path(__file__).resolve().parents[3] / "examples"


def test_a_measurement_is_told_as_a_ratio_to_its_baseline() -> None:
    one = Measurement(name="a", value=6.0, unit="ms", baseline_name="b", baseline=4.0, limit="under 5 ms", holds=False)
    assert one.ratio == 1.5
    stream = io.StringIO()
    part = PartMeasurements(name="p", measurements=(one,), left_out="the time was up")
    print_measurements(Measurements(python="3", parts=(part,)), Console(file=stream, width=160))
    assert "1.50" in stream.getvalue()
    assert "under 5 ms no" in stream.getvalue()
    assert "not measured: the time was up" in stream.getvalue()


@pytest.mark.skipif(not (EXAMPLES / "bracket.step").is_file(), reason="examples/bracket.step is not built")
def test_every_part_is_measured_against_a_baseline_of_the_same_run(tmp_path: Path) -> None:
    out = tmp_path / "perf.json"
    arguments = ["--questions", "4", "--repeat", "1", "--only", "questions,sandbox,ingest,memory", "--out", str(out)]
    command = [sys.executable, "-m", "querycad.cli", "bench", "perf", str(EXAMPLES / "bracket.step"), *arguments]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    parts = json.loads(out.read_text(encoding="utf-8"))["parts"]
    assert [part["name"] for part in parts] == ["questions", "sandbox", "ingest", "memory"]
    found = {one["name"].strip(): one for part in parts for one in part["measurements"]}
    for name in (
        "question on a known model, p50",
        "sandbox overhead, p50",
        "ingest of bracket",
        "memory of ingest, bracket",
    ):
        assert found[name]["value"] > 0
        assert found[name]["ratio"] == pytest.approx(found[name]["value"] / found[name]["baseline"])
    stages = [one["value"] for name, one in found.items() if name.startswith("stage ")]
    assert sum(stages) == pytest.approx(found["stage 'recognise', all models"]["baseline"])


def test_a_file_that_cannot_be_read_is_named(tmp_path: Path) -> None:
    path = tmp_path / "empty.step"
    path.write_text("", encoding="utf-8")
    with pytest.raises(BadBenchmark, match=r"empty\.step: "):
        measure(PerfOptions((path,), 1, 1))


def test_when_the_time_is_up_no_part_is_begun_and_each_says_so(tmp_path: Path) -> None:
    begun: list[str] = []
    found = measure(PerfOptions((tmp_path / "never read.step",), limit_s=-1.0), begun.append)
    assert begun == []
    assert [part.name for part in found.parts] == list(PARTS)
    assert all(part.left_out.startswith("the time was up") and not part.measurements for part in found.parts)


def test_a_part_that_nobody_knows_is_refused_with_those_there_are() -> None:
    with pytest.raises(BadBenchmark, match=r"no part 'speed'.*questions, sandbox, ingest, memory, recognition"):
        measure(PerfOptions((), only=("speed",)))


HALF = Measurement(name="half", value=1.0, unit="s", baseline_name="b", baseline=2.0, limit="under 1 x", holds=True)
GROWTH = Series(
    name="Time as models grow",
    x_name="faces",
    y_name="s",
    x=(10, 100),
    y=(1, 11),
    expected_name="n",
    expected=(1, 10),
    is_logarithmic=True,
)


def test_every_part_and_every_growth_is_drawn(tmp_path: Path) -> None:
    zero = HALF.model_copy(update={"baseline": 0.0})
    written = draw([("speed", [HALF]), ("nothing", [zero])], [GROWTH], tmp_path / "plots")
    assert [path.name for path in written] == ["speed.png", "time-as-models-grow.png"]
    with Image.open(written[0]) as picture:
        colors = {color for _, color in picture.convert("RGB").getcolors(1 << 24) or ()}
    assert (26, 127, 55) in colors, "a figure that holds is green"
    assert (198, 40, 40) not in colors


def test_plots_without_matplotlib_are_refused_in_a_sentence(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    with pytest.raises(NotMeasured, match="matplotlib, which draws, is not installed"):
        draw([("speed", [HALF])], [], tmp_path / "plots")
    assert not (tmp_path / "plots").exists()
