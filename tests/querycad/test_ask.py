"""`querycad ask` as a user runs it: answers, JSON lines, units, pictures, and one clear line for bad input."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from querycad.cli import main
from querycad_answering.answering import SURE

EXAMPLES = Path(__file__).parents[2] / "examples"
FLANGE = str(EXAMPLES / "flange.step")


@pytest.fixture(autouse=True, scope="module")
def _home(tmp_path_factory: pytest.TempPathFactory) -> object:
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("QUERYCAD_HOME", str(tmp_path_factory.mktemp("home")))
        yield


def run(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, str, str]:
    code = main(["ask", *arguments])
    out, err = capsys.readouterr()
    return code, out, err


def test_an_answer_comes_with_its_parts_and_program(capsys: pytest.CaptureFixture[str]) -> None:
    code, out, err = run(capsys, FLANGE, "How many counterbored holes are there?", "--show-code")
    assert (code, err) == (0, "")
    assert out.startswith("8\n")
    assert "8x Ø16 THRU, counterbore Ø26 depth 8  hole-1..3, hole-5, hole-7..10" in out
    assert "parts = find_parts(" in out


@pytest.mark.parametrize(("unit", "text"), [("mm", "54 mm"), ("m", "0.054 m"), ("in", "2.12598 in")])
def test_the_unit_is_the_one_asked_for(capsys: pytest.CaptureFixture[str], unit: str, text: str) -> None:
    code, out, _ = run(capsys, FLANGE, "What is the diameter of the largest hole?", "--unit", unit)
    assert code == 0
    assert out.splitlines()[0] == text


def test_json_is_one_object_a_line_in_si_whatever_the_unit(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    questions = tmp_path / "questions.txt"
    asked = ["What is the diameter of the largest hole?", "How many holes are there?"]
    questions.write_text("\r\n\r\n".join(asked), encoding="utf-8-sig")  # as Windows writes it
    code, out, _ = run(capsys, FLANGE, "--questions", str(questions), "--json", "--unit", "in")
    records = [json.loads(line) for line in out.splitlines()]
    assert code == 0
    assert [record["question"] for record in records] == asked
    assert [record["answer"]["value"] for record in records] == [pytest.approx(0.054), 11]
    assert records[0]["answer"]["unit"] == "m"
    assert records[0]["parts"][0]["faces"]


def test_a_picture_is_written_where_it_was_asked_for(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    picture = tmp_path / "new folder" / "holes.png"
    code, out, _ = run(capsys, FLANGE, "How many holes are there?", "--picture", str(picture))
    assert code == 0
    assert picture.read_bytes().startswith(b"\x89PNG")
    assert str(picture) in out


@pytest.mark.parametrize(
    ("content", "says"),
    [
        (b"", "empty"),
        (b"<html></html>", "HTML"),
        (b"\x1f\x8b\x08rubbish", "gzip"),
        (b"ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n#1=PLANE('',#2);\n", "cut short"),
        (b"ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\nENDSEC;\nEND-ISO-10303-21;\n", "no geometry"),
        (b"ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n#1=ADVANCED_FACE('',#2);\nENDSEC;\nEND-ISO-10303-21;\n", "unit"),
    ],
)
def test_a_bad_file_is_one_clear_line_and_exit_code_2(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, content: bytes, says: str
) -> None:
    file = tmp_path / "bad.step"
    file.write_bytes(content)
    code, out, err = run(capsys, str(file), "How many holes are there?")
    assert (code, out) == (2, "")
    assert len(err.splitlines()) == 1
    assert says in err


@pytest.mark.parametrize(
    ("question", "says"),
    [
        ("", "empty"),
        ("How many bananas are there?", "banana"),
        ("What is the radius of the keyway?", "no 'keyway'"),
        ("qwertz uiop", "not understood"),
    ],
)
def test_a_question_that_cannot_be_answered_is_one_line_with_what_is_known(
    capsys: pytest.CaptureFixture[str], question: str, says: str
) -> None:
    code, out, err = run(capsys, FLANGE, question)
    assert (code, out) == (2, "")
    assert len(err.splitlines()) == 1
    assert says in err


def test_a_missing_file_and_a_missing_list_of_questions_are_said(capsys: pytest.CaptureFixture[str]) -> None:
    assert (
        run(capsys, "nowhere.step", "How many holes?")[2]
        == f"querycad: no such file: {Path('nowhere.step').resolve()}\n"
    )
    assert "nowhere.txt" in run(capsys, FLANGE, "--questions", "nowhere.txt")[2]
    assert run(capsys, FLANGE)[0] == 2


def test_a_file_that_crashes_the_kernel_is_an_error_message(capsys: pytest.CaptureFixture[str]) -> None:
    file = EXAMPLES.parents[1] / "shared" / "robustness" / "dodgy" / "Twi044.stp"
    if not file.exists():
        pytest.skip("../shared/robustness is not beside the repository")
    code, out, err = run(capsys, str(file), "How many holes are there?")
    assert (code, out) == (2, "")
    assert "crashed" in err


def test_a_picture_that_cannot_be_written_is_told_by_the_exit_code(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    (tmp_path / "file").touch()
    code, out, err = run(capsys, FLANGE, "How many holes are there?", "--picture", str(tmp_path / "file" / "a.png"))
    assert code == 2
    assert out.startswith("11\n")
    assert "the picture cannot be written" in err


@pytest.mark.parametrize(
    ("question", "value"),
    [
        ("distance between hole 4 and hole 6", 0.134),
        ("What is the distance between hole-4 and hole-6?", 0.134),
        ("How far apart are holes 4 and 6?", 0.134),
        ("diameter of counterbore-h1.1", 0.026),
        ("area of face 36", 0.008991),
    ],
)
def test_what_is_printed_can_be_asked_for_and_is_certain(
    capsys: pytest.CaptureFixture[str], question: str, value: float
) -> None:
    code, out, _ = run(capsys, FLANGE, question, "--json")
    record = json.loads(out)
    assert (code, record["status"]) == (0, "answered")
    assert record["confidence"] >= SURE
    assert record["answer"]["value"] == pytest.approx(value, rel=1e-3)


def test_a_part_is_told_as_on_a_drawing(capsys: pytest.CaptureFixture[str]) -> None:
    out = run(capsys, FLANGE, "What is hole 1?")[1]
    assert out.splitlines()[0] == "Ø16 THRU, counterbore Ø26 depth 8 (hole-1), in mm"


def test_an_id_that_the_model_lacks_is_refused_with_those_it_has(capsys: pytest.CaptureFixture[str]) -> None:
    code, out, err = run(capsys, FLANGE, "How deep is hole 99?")
    assert (code, out) == (2, "")
    assert "the model has no hole-99; it has hole-1..11" in err


def test_what_is_counted_is_not_the_whole_unless_that_is_called_so(capsys: pytest.CaptureFixture[str]) -> None:
    for question in ("How many propellers are there?", "Is there a propeller?"):
        code, out, err = run(capsys, FLANGE, question)
        assert (code, out) == (2, "")
        assert "the model has no 'propeller" in err
    assert run(capsys, FLANGE, "How many parts are there?")[1].startswith("1\n")


def test_of_two_that_are_named_the_larger_is_told_with_both_sizes(capsys: pytest.CaptureFixture[str]) -> None:
    record = json.loads(run(capsys, FLANGE, "Which is larger, hole 4 or hole 11?", "--json")[1])
    assert (record["status"], record["answer"]["text"]) == ("answered", "hole-11")
    assert [note.rpartition(": ")[2] for note in record["warnings"]] == ["8.5 mm", "54 mm"]


@pytest.mark.parametrize("question", ["hole 1 hole 2 hole 3 depth width"])
def test_an_id_is_never_passed_over_surely(capsys: pytest.CaptureFixture[str], question: str) -> None:
    record = json.loads(run(capsys, FLANGE, question, "--json")[1])
    named = set(re.findall(r"hole-\d+", question.replace("hole ", "hole-")))
    rests_on = {part["id"] for part in record["parts"]}
    assert record["status"] != "answered" or named <= rests_on


@pytest.mark.parametrize(
    ("question", "text"),
    [
        ("Is hole 1 counterbored?", "yes"),
        ("Is hole 4 counterbored?", "no"),
        ("Are hole 1 and hole 2 counterbored?", "yes"),
        ("Is hole 4 larger than hole 11?", "no"),
        ("depth of the counterbored hole 1", "22 mm"),
    ],
)
def test_what_is_said_of_a_part_by_its_id_is_checked(
    capsys: pytest.CaptureFixture[str], question: str, text: str
) -> None:
    assert run(capsys, FLANGE, question)[1].splitlines()[0] == text


@pytest.mark.parametrize("question", ["depth of the blind hole 4", "Is hole 4 threaded?"])
def test_what_a_part_is_not_makes_the_answer_unsure(capsys: pytest.CaptureFixture[str], question: str) -> None:
    assert run(capsys, FLANGE, question)[1].startswith("perhaps ")


def test_distances_of_three_parts_are_not_answered_with_one(capsys: pytest.CaptureFixture[str]) -> None:
    record = json.loads(run(capsys, FLANGE, "how far apart are hole 1, hole 2 and hole 3", "--json")[1])
    assert record["status"] != "answered"


def test_questions_follow_one_another(capsys: pytest.CaptureFixture[str]) -> None:
    first = ["--context", "How many counterbored holes are there?"]
    out = run(capsys, FLANGE, "And how deep are they?", *first)[1]
    assert out.startswith("22 mm (each of 8)\n")
    assert "depth of hole-1..3, hole-5, hole-7..10" in out
    out = run(capsys, FLANGE, "the same in inches", *first, "--context", "And how deep are they?")[1]
    assert out.splitlines()[0].startswith("0.866142 in")


def test_a_follow_up_is_no_surer_than_the_question_that_it_follows(capsys: pytest.CaptureFixture[str]) -> None:
    context = "What is the diameter of the holes visible from the top?"
    before = json.loads(run(capsys, FLANGE, context, "--json")[1])
    after = json.loads(run(capsys, FLANGE, "and how deep are they?", "--context", context, "--json")[1])
    assert len(after["parts"]) == len(before["parts"]) == 11
    assert after["confidence"] <= before["confidence"]


def test_what_is_selected_is_what_it_means(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(capsys, FLANGE, "What is its diameter?", "--select", "hole-4")[1].startswith("8.5 mm\n")
    assert run(capsys, FLANGE, "How deep is it?", "--select", "25")[1].startswith("8 mm\n")
    code, _, err = run(capsys, FLANGE, "How deep is it?", "--select", "hole-44")
    assert code == 2
    assert "no hole-44" in err
