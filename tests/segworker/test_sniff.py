"""Each kind of bad file gets a sentence of its own, before the kernel sees it."""

from __future__ import annotations

from pathlib import Path

import pytest

from querycad_segworker.errors import FileProblem, FileTooLarge, IncompleteFile, NoLengthUnit, NotStep
from querycad_segworker.files.sniff import check_step

HEADER = "ISO-10303-21;\nHEADER;\nFILE_NAME('SURFACE','',(''),(''),'','','');\nENDSEC;\n"
UNIT = "#1=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n"
FACE = "#2=ADVANCED_FACE('',(#3),#4,.T.);\n"
END = "ENDSEC;\nEND-ISO-10303-21;\n"
GOOD = f"{HEADER}DATA;\n{UNIT}{FACE}{END}"


def checked(tmp_path: Path, content: bytes) -> bytes | None:
    path = tmp_path / "file.step"
    path.write_bytes(content)
    return check_step(path)


def test_a_good_file_is_read_as_it_is(tmp_path: Path) -> None:
    assert checked(tmp_path, GOOD.encode()) is None


@pytest.mark.parametrize("before", [b"\xef\xbb\xbf", b"\n\r\n  ", b"\xef\xbb\xbf\n"])
def test_what_stands_before_the_header_is_taken_away(tmp_path: Path, before: bytes) -> None:
    assert checked(tmp_path, before + GOOD.encode()) == GOOD.encode()


BAD: dict[str, tuple[bytes, type[FileProblem], str]] = {
    "empty": (b"", IncompleteFile, "the file is empty"),
    "UTF-16": (GOOD.encode("utf-16"), NotStep, "UTF-16"),
    "HTML": (b"<!DOCTYPE html><html></html>", NotStep, "HTML or XML"),
    "STL": (b"solid cube\nfacet normal 0 0 1\n", NotStep, "begins like an STL file"),
    "binary": (bytes(range(256)) * 20, NotStep, "binary data"),
    "text": (b"hello", NotStep, "does not begin with ISO-10303-21"),
    "binary after the header": (b"ISO-10303-21;\n\x00\x01\x02", NotStep, "binary data after the header"),
    "header only": (f"{HEADER}END-ISO-10303-21;".encode(), IncompleteFile, "no DATA section"),
    "empty DATA": (f"{HEADER}DATA;\n{END}".encode(), IncompleteFile, "DATA section is empty"),
    "cut short": (f"{HEADER}DATA;\n{UNIT}{FACE}".encode(), IncompleteFile, "cut short"),
    "no faces": (f"{HEADER}DATA;\n{UNIT}{END}".encode(), IncompleteFile, "no surface or face"),
    "two files": (f"{GOOD}\n{GOOD}".encode(), NotStep, "one after the other"),
    "no unit": (f"{HEADER}DATA;\n{FACE}{END}".encode(), NoLengthUnit, "no length unit"),
}


@pytest.mark.parametrize(("content", "kind", "words"), BAD.values(), ids=BAD.keys())
def test_a_bad_file_is_refused_with_a_sentence_of_its_own(
    tmp_path: Path, content: bytes, kind: type[FileProblem], words: str
) -> None:
    with pytest.raises(kind, match=words) as problem:
        checked(tmp_path, content)
    assert type(problem.value) is kind
    assert "\n" not in str(problem.value)


@pytest.mark.parametrize(
    "second", [GOOD, f"\n\n{GOOD}", f"\ufeff{GOOD}", "ISO-10303-21;\nHEADER;"], ids=["at once", "lines", "mark", "cut"]
)
def test_a_file_behind_the_first_one_is_not_passed_over(tmp_path: Path, second: str) -> None:
    with pytest.raises(NotStep, match="several STEP files"):
        checked(tmp_path, (GOOD + second).encode())


@pytest.mark.parametrize("behind", ["\r\n\x1a", "\n/* END-ISO-10303-21; */\n", "\nSIGNATURE;\nMIAG\nENDSEC;\n"])
def test_what_else_stands_behind_the_end_mark_is_no_second_file(tmp_path: Path, behind: str) -> None:
    assert checked(tmp_path, (GOOD + behind).encode()) is None
    named = GOOD.replace("HEADER;", "HEADER;\n/* made of ISO-10303-21; and END-ISO-10303-21; texts */", 1)
    assert checked(tmp_path, named.encode()) is None


def test_no_two_kinds_of_bad_file_share_a_sentence(tmp_path: Path) -> None:
    sentences = []
    for content, _, _ in BAD.values():
        with pytest.raises(FileProblem) as problem:
            checked(tmp_path, content)
        sentences.append(str(problem.value))
    assert len(set(sentences)) == len(BAD)


def test_a_missing_file_a_folder_and_a_large_file(tmp_path: Path) -> None:
    with pytest.raises(NotStep, match="no such file"):
        check_step(tmp_path / "nothing.step")
    with pytest.raises(NotStep, match="not a file"):
        check_step(tmp_path)
    path = tmp_path / "large.step"
    path.write_bytes(GOOD.encode())
    with pytest.raises(FileTooLarge, match="at most"):
        check_step(path, max_bytes=100)


def test_an_assembly_whose_parts_are_other_files_is_left_to_the_kernel(tmp_path: Path) -> None:
    content = f"{HEADER}DATA;\n{UNIT}#5=DOCUMENT_FILE('part.stp','',$,$,'',$);\n{END}"
    assert checked(tmp_path, content.encode()) is None
