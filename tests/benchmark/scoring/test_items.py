from __future__ import annotations

import json
from pathlib import Path

import pytest
from benchmark.scoring.items import BadBenchmark, literal, read_benchmark

from querycad_contracts import AnswerType

CAD_QA = Path(__file__).resolve().parents[4] / "shared" / "cad-qa-dev"


def own_folder(tmp_path: Path, **file: object) -> Path:
    folder = tmp_path / "benchmark"
    (folder / "questions").mkdir(parents=True)
    (folder / "models").mkdir()
    (folder / "models" / "flange.step").write_text("ISO-10303-21;", encoding="utf-8")
    (folder / "questions" / "flange.json").write_text(json.dumps(file), encoding="utf-8")
    return folder


def test_every_line_of_the_published_layout_is_a_question_with_its_label(folder: Path) -> None:
    benchmark = read_benchmark(folder)
    assert benchmark.name == "tiny"
    assert [(item.key, item.question, item.label, item.is_sorted) for item in benchmark.items] == [
        ("abc/001/0", "Which radii?", "[0.0025, 0.005]", True),
        ("abc/001/1", "How many holes?", "4", False),
        ("shop/bracket/0", "How wide?", "0.14662", False),
        ("shop/bracket/1", "Where is the slot?", "[0.0, 0.01, 0.0]", False),
    ]
    assert all(item.file.name == "cad.step" and item.file.is_file() for item in benchmark.items)


def test_missing_lines_of_metadata_mean_an_ordered_label(folder: Path) -> None:
    (folder / "abc" / "001" / "metadata.txt").unlink()
    assert not any(item.is_sorted for item in read_benchmark(folder).items)


def test_an_empty_line_of_metadata_belongs_to_its_question(folder: Path) -> None:
    (folder / "abc" / "001" / "metadata.txt").write_text("\nsorted\n", encoding="utf-8")
    assert [item.is_sorted for item in read_benchmark(folder).items] == [False, True, False, False]


def test_a_question_without_a_label_is_refused(folder: Path) -> None:
    (folder / "abc" / "001" / "solution.txt").write_text("4\n", encoding="utf-8")
    with pytest.raises(BadBenchmark, match="2 questions but 1 labels"):
        read_benchmark(folder)


@pytest.mark.parametrize("name", ["cad.step", "solution.txt"])
def test_a_model_without_one_of_its_files_is_refused(folder: Path, name: str) -> None:
    (folder / "abc" / "001" / name).unlink()
    with pytest.raises(BadBenchmark, match=name):
        read_benchmark(folder)


def test_a_folder_without_questions_is_refused(tmp_path: Path) -> None:
    with pytest.raises(BadBenchmark, match="neither"):
        read_benchmark(tmp_path)
    with pytest.raises(BadBenchmark, match="no such folder"):
        read_benchmark(tmp_path / "nothing")


def test_own_questions_keep_type_and_tags(tmp_path: Path) -> None:
    asked = {
        "question": "Which radii?",
        "value": [0.002, 0.001],
        "type": "lengths",
        "tags": {"part": "hole", "property": "radius"},
    }
    single = {"question": "Where?", "value": [[0.0, 0.1, 0.2]], "type": "points"}
    folder = own_folder(tmp_path, model="flange.step", title="Flange", items=[asked, single])
    first, second = read_benchmark(folder).items
    assert (first.key, first.label, first.type) == ("querycad/flange/0", "[0.002, 0.001]", AnswerType.LENGTHS)
    assert (first.part, first.measure, first.is_sorted) == ("hole", "radius", True)
    assert not second.is_sorted, "sorting one point would sort its coordinates"
    assert first.file == folder / "models" / "flange.step"


def test_models_may_lie_elsewhere(tmp_path: Path) -> None:
    folder = own_folder(tmp_path, model="flange.step", items=[{"question": "?", "value": 4, "type": "count"}])
    (folder / "models" / "flange.step").rename(tmp_path / "flange.step")
    with pytest.raises(BadBenchmark, match="--models"):
        read_benchmark(folder)
    assert read_benchmark(folder, tmp_path).items[0].file == tmp_path / "flange.step"


def test_a_split_of_the_own_questions_is_a_set(tmp_path: Path) -> None:
    item = {"question": "How many holes?", "value": 4, "type": "count"}
    folder = own_folder(tmp_path, model="flange.step", split="held_out", items=[item])
    assert [item.key for item in read_benchmark(folder).items] == ["held_out/flange/0"]


def test_own_questions_of_an_unknown_type_or_model_are_refused(tmp_path: Path) -> None:
    item = {"question": "How many holes?", "value": 4, "type": "colour"}
    with pytest.raises(BadBenchmark, match=r"flange\.json"):
        read_benchmark(own_folder(tmp_path / "a", model="flange.step", items=[item]))
    with pytest.raises(BadBenchmark, match=r"no model gear\.step"):
        read_benchmark(own_folder(tmp_path / "b", model="gear.step", items=[]))


def test_only_literals_are_values() -> None:
    assert literal(" (1, [2.5, 'a']) ") == [1, [2.5, "a"]]
    for text in ("hole", "1 +", "__import__('os')", ""):
        with pytest.raises(ValueError, match="no Python literal"):
            literal(text)


@pytest.mark.skipif(not CAD_QA.is_dir(), reason="../shared/cad-qa-dev is not beside the repository")
def test_the_development_half_of_cad_qa_is_read_whole() -> None:
    items = read_benchmark(CAD_QA).items
    assert len(items) == 48
    assert {item.set for item in items} == {"abc", "industrial"}
    assert len({(item.set, item.id) for item in items}) == 8
