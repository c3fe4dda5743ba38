from __future__ import annotations

import io
import json
import subprocess
import sys
from pathlib import Path

import pytest
from rich.console import Console

from querycad.bench.items import BadBenchmark
from querycad.bench.perf import Measurement, Measurements, PerfOptions, measure, print_measurements

EXAMPLES = Path(__file__).resolve().parents[3] / "examples"


def test_a_measurement_is_told_as_a_ratio_to_its_baseline() -> None:
    one = Measurement(name="a", value=6.0, unit="ms", baseline_name="b", baseline=4.0, limit="under 5 ms", holds=False)
    assert one.ratio == 1.5
    stream = io.StringIO()
    print_measurements(Measurements(python="3", measurements=(one,)), Console(file=stream, width=160))
    assert "1.50" in stream.getvalue()
    assert "no" in stream.getvalue()


@pytest.mark.skipif(not (EXAMPLES / "bracket.step").is_file(), reason="examples/bracket.step is not built")
def test_every_part_is_measured_against_a_baseline_of_the_same_run(tmp_path: Path) -> None:
    out = tmp_path / "perf.json"
    arguments = ["--questions", "4", "--repeat", "1", "--out", str(out)]
    command = [sys.executable, "-m", "querycad.cli", "bench", "perf", str(EXAMPLES / "bracket.step"), *arguments]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    found = {one["name"].strip(): one for one in json.loads(out.read_text(encoding="utf-8"))["measurements"]}
    for name in ("question on a known model, p50", "sandbox overhead, p50", "ingest of bracket"):
        assert found[name]["value"] > 0
        assert found[name]["ratio"] == pytest.approx(found[name]["value"] / found[name]["baseline"])
    stages = [one["value"] for name, one in found.items() if name.startswith("stage ")]
    assert sum(stages) == pytest.approx(found["stage 'recognise', all models"]["baseline"])


def test_a_file_that_cannot_be_read_is_named(tmp_path: Path) -> None:
    path = tmp_path / "empty.step"
    path.write_text("", encoding="utf-8")
    with pytest.raises(BadBenchmark, match=r"empty\.step: "):
        measure(PerfOptions((path,), 1, 1))
