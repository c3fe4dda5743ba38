"""The workflows run what a developer runs: `.ci/run`, and `make bench` against the base, from what is pinned."""

from __future__ import annotations

import os
import re
import subprocess
from pathlib import Path
from typing import Any

import pytest
import yaml

ROOT = Path(__file__).parents[2]
GITHUB = ROOT / ".github/workflows/checks.yml"
GITLAB = ROOT / ".gitlab-ci.yml"
SCRIPT = (ROOT / "scripts/bench_change.sh").read_text(encoding="utf-8")


def github_jobs() -> dict[str, dict[str, Any]]:
    return dict(yaml.safe_load(GITHUB.read_text(encoding="utf-8"))["jobs"])


def github_commands(job: str) -> list[str]:
    return [step["run"] for step in github_jobs()[job]["steps"] if "run" in step]


def gitlab() -> dict[str, Any]:
    return dict(yaml.safe_load(GITLAB.read_text(encoding="utf-8")))


def test_every_action_is_pinned_by_its_commit() -> None:
    used = [step["uses"] for job in github_jobs().values() for step in job["steps"] if "uses" in step]
    assert len(used) >= 4
    assert [each for each in used if not re.fullmatch(r"[\w-]+/[\w-]+@[0-9a-f]{40}", each)] == []
    lines = [line for line in GITHUB.read_text(encoding="utf-8").splitlines() if "uses:" in line]
    assert all(re.search(r"# v\d+\.\d+\.\d+$", line) for line in lines)


def test_checks_and_tests_are_those_of_ci_run() -> None:
    assert github_commands("tests") == [".ci/run"] == gitlab()["tests"]["script"]
    runs = (ROOT / ".ci/run").read_text(encoding="utf-8")
    assert "make check" in runs
    assert "make test" in runs


def test_the_benchmark_is_that_of_make_bench_and_is_compared_with_the_base() -> None:
    (theirs,) = gitlab()["benchmark"]["script"]
    ours = github_commands("benchmark")[0]
    assert ours.split()[0] == theirs.split()[0] == "scripts/bench_change.sh"
    assert "make bench" in SCRIPT
    assert "querycad bench compare" in SCRIPT
    assert os.access(ROOT / "scripts/bench_change.sh", os.X_OK)
    done = subprocess.run(
        ["make", "--no-print-directory", "--dry-run", "bench", "ARGS=--junit x"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stdout.splitlines()[-1].endswith("querycad bench --junit x")
    assert github_jobs()["benchmark"]["steps"][0]["with"]["fetch-depth"] == 0  # the base has to be there
    assert gitlab()["benchmark"]["variables"]["GIT_DEPTH"] == "0"


def test_what_the_script_writes_is_what_is_shown() -> None:
    assert "--markdown $out/summary.md --junit $out/junit.xml" in SCRIPT
    assert re.search(r"^out=(.*)$", SCRIPT, re.MULTILINE)[1] == "build/bench"  # type: ignore[index]
    assert "build/bench/summary.md" in github_commands("benchmark")[1]
    assert gitlab()["benchmark"]["artifacts"]["reports"]["junit"] == "build/bench/junit.xml"
    assert gitlab()["benchmark"]["artifacts"]["paths"] == ["build/bench"]


@pytest.mark.parametrize("schema", ["vendor.github-workflows", "vendor.gitlab-ci"])
def test_a_workflow_is_as_its_service_has_it(schema: str) -> None:
    path = GITHUB if "github" in schema else GITLAB
    command = [str(ROOT / ".venv/bin/check-jsonschema"), "--builtin-schema", schema, str(path)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


def test_they_may_read_and_nothing_else() -> None:
    assert yaml.safe_load(GITHUB.read_text(encoding="utf-8"))["permissions"] == {"contents": "read"}
