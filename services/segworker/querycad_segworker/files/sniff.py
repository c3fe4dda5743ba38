"""Is this a file worth giving to the kernel? Checked as text, before anything that could crash sees it."""

from __future__ import annotations

import re
import zipfile
from pathlib import Path

from querycad_contracts import HEAD_BYTES, FileKind, file_kind, is_3mf, no_kind
from querycad_segworker.errors import FileTooLarge, IncompleteFile, NoLengthUnit, NotStep

from .archives import opened

MAX_FILE_BYTES = 512 * 2**20
"""The largest file accepted: single parts have kilobytes to a few megabytes, large assemblies some hundred."""

_MAGIC = b"ISO-10303-21"
# A repetition in a pattern has an upper limit: with none, text that almost fits is searched again from each start.
_BLANK = re.compile(rb"\s*(?:\xef\xbb\xbf\s*)?")
_END = re.compile(rb"END-ISO-10303-21\s{0,80};")
_DATA = re.compile(rb"\bDATA\s{0,80}[(;]")
_ENTITY = re.compile(rb"#\s{0,80}\d{1,20}\s{0,80}=")
_LENGTH_UNITS = (b"LENGTH_UNIT", b"LENGTH_MEASURE_WITH_UNIT", b".METRE.")
_SURFACES = (re.compile(rb"_FACE\w{0,60}\s{0,80}\("), re.compile(rb"SURFACE\w{0,60}\s{0,80}\("))
"""What every face or surface entity has in its name. Each begins with plain letters, which makes the search fast."""
_POWER = re.compile(
    rb"[(,]\s{0,20}+([+-]?(?:\d{1,400}+(?:\.\d{0,400}+)?E\+?\d{2,9}+|NAN|INF))\s{0,20}+(?=[,)])", re.IGNORECASE
)
_IN_LINE = re.compile(
    rb"(?<![^,\s])([+-]?(?:\d{1,400}+(?:\.\d{0,400}+)?[ED]\+?\d{2,9}+|NAN|INF(?:INITY)?))(?=[,;\s])", re.IGNORECASE
)
"""The same in IGES, which writes a D for the power of doubles, and in BREP, which parts numbers by blanks."""
LARGEST = 2e100
"""What the kernel takes for infinite, and some programs write for a line without end."""


def check_file(path: Path, max_bytes: int = MAX_FILE_BYTES) -> bytes | None:
    """As `check_step`, of any file that can be read: what else there is only its reader knows."""
    if path.is_file() and path.stat().st_size <= max_bytes and kind_of(path) not in (FileKind.STEP, None):
        return None
    return check_step(path, max_bytes)


def kind_of(path: Path) -> FileKind | None:
    """What kind of file is it? None where it cannot be read. Raises NotStep for an archive that is not looked into."""
    try:
        if not path.is_file():
            return None  # whoever opens a named pipe waits for its writer
        with path.open("rb") as file:
            kind = file_kind(file.read(HEAD_BYTES))
        if kind is FileKind.ZIP:
            with opened(path) as archive:
                return FileKind.THREE_MF if is_3mf(archive.namelist()) else kind
        return kind
    except zipfile.BadZipFile:
        return FileKind.ZIP
    except OSError:
        return None


def must_be_file(path: Path) -> None:
    """Raises NotStep where no file is at the path, OSError where that cannot be seen."""
    if not path.exists():
        raise NotStep(f"no such file: {path}")
    if not path.is_file():
        raise NotStep(f"not a file: {path}")


def check_step(path: Path, max_bytes: int = MAX_FILE_BYTES) -> bytes | None:
    """Raises the FileProblem that says what is wrong with the file.

    Returns None when the file can be read as it is, or the cleaned text when something before the header (a byte
    order mark, blank lines) would keep the kernel from reading it.
    """
    must_be_file(path)
    size = path.stat().st_size
    if size == 0:
        raise IncompleteFile("the file is empty")
    if size > max_bytes:
        raise FileTooLarge(f"the file has {size / 2**20:.0f} MB; at most {max_bytes / 2**20:.0f} MB are read")
    try:
        data = path.read_bytes()
    except PermissionError as error:
        raise NotStep(f"no permission to read {path}") from error
    start = _start(data)
    if b"\x00" in data[start : start + 4096]:
        raise NotStep("not a STEP file: it holds binary data after the header")
    if _holds_another(data, start):
        raise NotStep("several STEP files stand one after the other in this file; save each as a file of its own")
    end = data.rfind(b"END-ISO-10303-21")
    if not _DATA.search(data, start):
        raise IncompleteFile("the file has no DATA section: it holds a header only")
    if not _ENTITY.search(data, start):
        raise IncompleteFile("the file holds no geometry: its DATA section is empty")
    if end < 0:
        raise IncompleteFile("the file is cut short: its end mark (END-ISO-10303-21) is missing")
    refers_elsewhere = b"DOCUMENT_FILE" in data  # an assembly whose parts are files of their own
    if not refers_elsewhere and not any(pattern.search(data, start) for pattern in _SURFACES):
        raise IncompleteFile("the file holds no geometry: no surface or face in it")
    if not any(data.find(unit, start) >= 0 for unit in _LENGTH_UNITS):
        raise NoLengthUnit("the file declares no length unit, so its lengths could be millimetres, metres or inches")
    return data[start:] if start else None


def strange_number(path: Path, kind: FileKind | None = FileKind.STEP) -> str | None:
    """Which number of the file is none, or out of all bounds? Its entity and its text; None where all are fine."""
    data = path.read_bytes()
    if kind in (FileKind.IGES, FileKind.BREP):
        return _strange_in_line(data, kind)
    if not any(_is_strange(found[1]) for found in _POWER.finditer(data)):
        return None
    data = re.sub(rb"'[^']*'", b"''", data)
    for found in _POWER.finditer(data):
        if _is_strange(found[1]):
            entity = re.match(rb"\s{0,80}(#\d{1,18})", data[data.rfind(b";", 0, found.start()) + 1 : found.start()])
            return f"{entity[1].decode() if entity else 'an entity'} holds {found[1][:40].decode()}"
    return None


def _strange_in_line(data: bytes, kind: FileKind) -> str | None:
    """The same of a file in lines. Those of IGES have data in 64 columns, the entity in eight more, then a letter."""
    for found in _IN_LINE.finditer(data):
        if not _is_strange(found[1]):
            continue
        begin = data.rfind(b"\n", 0, found.start(1)) + 1
        line = data[begin : begin + 80]
        said = found[1][:40].decode()
        if kind is FileKind.BREP:
            before = data.count(b"\n", 0, begin)
            return f"line {before + 1} holds {said}"
        if line[72:73] == b"P" and found.start(1) - begin < 64:
            return f"D{line[64:72].decode('latin-1').strip()} holds {said}"
    return None


def _is_strange(number: bytes) -> bool:
    value = float(number.upper().replace(b"D", b"E"))
    return not abs(value) <= LARGEST  # no comparison holds for what is no number


def missing_entities(path: Path) -> list[int]:
    """Which entities does the file refer to without holding them? Their numbers, sorted.

    Slower than `check_step`, and kernels forgive many of them: it is asked when a file made the kernel crash.
    """
    data = re.sub(rb"'[^']*'", b"", path.read_bytes())
    held = {int(number) for number in re.findall(rb"#(\d{1,18})\s{0,80}=", data)}
    return sorted({int(number) for number in re.findall(rb"#(\d{1,18})(?!\d)", data)} - held)


def _holds_another(data: bytes, start: int) -> bool:
    """Does another STEP file begin behind an end mark? The kernel reads the first alone, and says nothing.

    An exchange structure ends with that mark; only signatures may stand behind it (ISO 10303-21).
    """
    return any(data.startswith(_MAGIC, _text(data, mark.end())) for mark in _END.finditer(data, start))


def _text(data: bytes, position: int) -> int:
    """Where does text begin from there on, behind a byte order mark and blanks?"""
    blank = _BLANK.match(data, position)
    return blank.end() if blank else position


def _start(data: bytes) -> int:
    """Where does the STEP text begin? Raises NotStep with what the file looks like instead."""
    start = _text(data, 0)
    if data.startswith(_MAGIC, start):
        return start
    raise NotStep(no_kind(data[:HEAD_BYTES]))
