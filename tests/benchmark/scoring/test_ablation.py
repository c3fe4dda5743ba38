"""What an ablation measures, and what it says where it cannot."""

from __future__ import annotations

import io
from pathlib import Path

import pytest
from benchmark.scoring.ablation import ABLATIONS, Ablations, ablations, table
from benchmark.scoring.results import Results
from benchmark.scoring.systems import SystemOptions, UnknownSystem
from rich.console import Console

from querycad.cli import main
from querycad_answering.llm import PromptExamples
from querycad_contracts import GroundedBy

BASE = SystemOptions()


class Measured:
    """Keeps the options that were measured; refuses what needs networks or a language model."""

    def __init__(self) -> None:
        self.options: list[SystemOptions] = []

    def __call__(self, options: SystemOptions, name: str) -> Results:
        if options.grounding is not GroundedBy.GEOMETRY:
            raise UnknownSystem("no weights here")
        self.options.append(options)
        return Results(benchmark=name, options=options, results=())


def printed(option: str, base: SystemOptions = BASE) -> str:
    (ablation,) = ablations(option, None)
    stream = io.StringIO()
    rows = Ablations(base, Measured()).rows(ablation)
    Console(file=stream, width=200).print(table(ablation, rows, base))
    return stream.getvalue()


def test_a_value_that_cannot_be_measured_says_why_and_has_no_score() -> None:
    rows = {line.split()[1]: line for line in printed("grounding").splitlines() if line.startswith("│")}
    assert "0 / 0 of 0" in rows["geometry"]
    for value in ("vision", "fused"):
        assert "not measured: no weights here" in rows[value]
        assert " of " not in rows[value].partition("not measured")[0]


def test_what_only_vision_or_a_language_model_heeds_is_compared_with_them() -> None:
    assert "views, with grounding vision" in printed("views")
    assert "views, with grounding fused" in printed("views", BASE.model_copy(update={"grounding": GroundedBy.FUSED}))
    measured = Measured()
    Ablations(BASE, measured).rows(ablations("prompt_examples", None)[0])
    assert [(options.codegen, options.prompt_examples) for options in measured.options] == [
        ("llm", PromptExamples.NONE),
        ("llm", PromptExamples.SAME),
        ("llm", PromptExamples.NEAREST),
    ]


def test_no_set_of_options_is_measured_twice() -> None:
    measured = Measured()
    runs = Ablations(BASE, measured)
    for ablation in ablations(None, None):
        assert len(runs.rows(ablation)) == len(ablation.values)
    assert len(measured.options) == len(set(measured.options))
    assert BASE in measured.options


def test_the_usual_values_are_options_of_the_system() -> None:
    assert {ablation.option for ablation in ABLATIONS} <= set(SystemOptions.model_fields)
    for ablation in ABLATIONS:
        setups = {SystemOptions.model_validate({ablation.option: value}) for value in ablation.values}
        assert len(setups) == len(ablation.values) > 1


@pytest.mark.parametrize(
    ("option", "values", "reason"),
    [
        ("views", ["7"], "views cannot be '7'"),
        ("box_threshold", ["30"], "box_threshold cannot be '30'"),
        ("grounding", ["touch"], "grounding cannot be 'touch'"),
    ],
)
def test_a_value_that_no_system_has_is_refused_before_anything_is_measured(
    option: str, values: list[str], reason: str
) -> None:
    measured = Measured()
    (ablation,) = ablations(option, ["6", *values] if option == "views" else values)
    with pytest.raises(UnknownSystem, match=reason):
        Ablations(BASE, measured).rows(ablation)
    assert not measured.options


@pytest.mark.parametrize(
    ("arguments", "reason"),
    [
        (["ablate", "--option", "views"], "nothing was measured: no weights of a detector and of a segmenter"),
        (["ablate", "--option", "prompt_examples"], "nothing was measured: no language model is set up"),
        (["run", "--grounding", "vision"], "no weights of a detector and of a segmenter"),
        (["run", "--grounding", "fused"], "no weights of a detector and of a segmenter"),
        (["run", "--codegen", "both"], "no language model is set up"),
    ],
    ids=" ".join,
)
def test_without_weights_or_a_language_model_nothing_that_needs_them_is_scored(
    arguments: list[str],
    reason: str,
    folder: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setenv("QUERYCAD_HOME", str(tmp_path / "home"))
    monkeypatch.delenv("QUERYCAD_LLM_BASE_URL", raising=False)
    command, *rest = arguments
    out = tmp_path / "out"
    assert main(["bench", command, str(folder), *rest, "--jobs", "1", "--out", str(out)]) == 2
    assert reason in capsys.readouterr().err
    assert not out.exists()
