"""Reads STL, OBJ and 3MF: triangles in metres, the objects they belong to, and what the file says of its unit."""

from __future__ import annotations

import re
from array import array
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from querycad_contracts import FileKind
from querycad_segworker.errors import FileTooLarge, IncompleteFile, UnreadableFile

from .three_mf import read_3mf
from .triangles import MOST_TRIANGLES, Array, Named

MILLIMETRE_M = 1e-3
"""What programs mean by a number in a file that declares no unit."""
NO_SHADE = -1
CHUNK_BYTES = 2**24
_HEAD_BYTES = 84
_RECORD = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_NUMBER = rb"[ \t]+([^\s]{1,40})"
_VERTEX = re.compile(rb"^[ \t]*vertex" + 3 * _NUMBER, re.IGNORECASE | re.MULTILINE)
_FACET = re.compile(rb"^[ \t]*endfacet", re.IGNORECASE | re.MULTILINE)
_SOLID = re.compile(rb"^[ \t]*endsolid", re.IGNORECASE | re.MULTILINE)


@dataclass(frozen=True, slots=True, eq=False)
class MeshFile:
    """What a file of a mesh holds. corners: (T, 3, 3) metres; objects: theirs in turn."""

    corners: Array
    objects: tuple[Named, ...]
    units: tuple[str, ...] = ()
    warnings: tuple[str, ...] = ()


def read_mesh_file(path: Path, kind: FileKind) -> MeshFile:
    """Which triangles does the file hold? Raises FileProblem with what is wrong with it."""
    if kind is FileKind.THREE_MF:
        corners, objects, unit = read_3mf(path)
        found = MeshFile(corners, objects, (unit,))
    else:
        corners, objects = _read_stl(path) if kind is FileKind.STL else _read_obj(path)
        said = f"an {kind} file declares no unit: its lengths are taken as millimetres"
        found = MeshFile(corners * MILLIMETRE_M, objects, (), (said,))
    if not len(found.corners):
        raise IncompleteFile("the file holds no geometry: no triangle is in it")
    if not np.isfinite(found.corners).all():
        raise UnreadableFile("the file is damaged: it holds a coordinate that is not a finite number")
    return found


def must_be_few(count: int) -> None:
    """Raises FileTooLarge for more triangles than are read."""
    if count > MOST_TRIANGLES:
        raise FileTooLarge(f"the mesh has {count:,} triangles; at most {MOST_TRIANGLES:,} are read")


def _read_stl(path: Path) -> tuple[Array, tuple[Named, ...]]:
    size = path.stat().st_size
    with path.open("rb") as file:
        head = file.read(_HEAD_BYTES)
    count = int.from_bytes(head[80:84], "little")
    room = (size - _HEAD_BYTES) // _RECORD.itemsize
    if size != _HEAD_BYTES + count * _RECORD.itemsize and _is_text(path):
        return _read_stl_text(path)
    if count > room:
        raise IncompleteFile(
            f"the file is cut short: it says that it holds {count:,} triangles, and has room for {room:,}"
        )
    if count < room:
        raise UnreadableFile(
            f"the file is damaged: it says that it holds {count:,} triangles, and has room for {room:,}"
        )
    must_be_few(count)
    records = np.fromfile(path, dtype=_RECORD, offset=_HEAD_BYTES, count=count)
    return records["corners"].astype(np.float64), (Named("", None, count),)


def _is_text(path: Path) -> bool:
    with path.open("rb") as file:
        return b"\x00" not in file.read(4096)


def _read_stl_text(path: Path) -> tuple[Array, tuple[Named, ...]]:
    pieces: list[Array] = []
    facets = solids = vertices = 0
    for text in _chunks(path, b"endfacet"):
        found = _VERTEX.findall(text)
        facets += len(_FACET.findall(text))
        solids += len(_SOLID.findall(text))
        vertices += len(found)
        must_be_few(facets)
        pieces.append(_numbers(found))
    if vertices != 3 * facets:
        raise UnreadableFile(f"the file is damaged: its {facets:,} facets have {vertices:,} corners, not three each")
    if not solids:
        raise IncompleteFile("the file is cut short: its end mark (endsolid) is missing")
    return np.concatenate([np.zeros((0, 3)), *pieces]).reshape(-1, 3, 3), (Named("", None, facets),)


def _chunks(path: Path, mark: bytes) -> Iterator[bytes]:
    """The file in pieces that end with a line, after a mark where there is one."""
    with path.open("rb") as file:
        left = b""
        while chunk := file.read(CHUNK_BYTES):
            left += chunk
            at = max(left.rfind(mark), left.rfind(mark.upper()))
            end = left.find(b"\n", at) + 1 if at >= 0 else 0
            if end:
                yield left[:end]
                left = left[end:]
            elif len(left) > 4 * CHUNK_BYTES:
                raise UnreadableFile("the file is damaged: a line of it has no end")
        yield left


def _numbers(found: list[tuple[bytes, ...]]) -> Array:
    try:
        return np.array(found, dtype="S40").astype(np.float64).reshape(-1, 3)
    except ValueError as error:
        raise UnreadableFile("the file is damaged: a coordinate in it is no number") from error


def _read_obj(path: Path) -> tuple[Array, tuple[Named, ...]]:
    """Vertices and faces; what smooths them is passed over. A polygon is cut into a fan, which must fit.

    Colours are those that vertices state behind their places; those of materials stand in a file of their own.
    """
    places, corners, fans, shades = array("d"), array("q"), array("q"), array("q")
    names: list[tuple[str, int]] = []
    with path.open("rb") as file:
        try:
            for line in file:
                word, _, rest = line.lstrip().partition(b" ")
                if word == b"v":
                    said = rest.split()
                    places.extend((float(said[0]), float(said[1]), float(said[2])))
                    shades.append(_shade(said[3:6]) if len(said) > 5 else NO_SHADE)
                elif word == b"f":
                    count = len(places) // 3
                    ids = [int(each.split(b"/", 1)[0]) for each in rest.split()]
                    ids = [each - 1 if each > 0 else count + each for each in ids]
                    for second, third in pairwise(ids[1:]):
                        corners.extend((ids[0], second, third))
                    if len(ids) > 2:
                        fans.append(len(ids) - 2)
                elif word == b"o":
                    names.append((rest.decode("utf-8", errors="replace").strip(), len(corners) // 3))
                if len(corners) > 3 * MOST_TRIANGLES:
                    must_be_few(len(corners) // 3)
        except (ValueError, IndexError, OverflowError) as error:
            raise UnreadableFile("the file is damaged: a vertex or face in it is not made of numbers") from error
    points = np.frombuffer(places, dtype=np.float64).reshape(-1, 3) if places else np.zeros((0, 3))
    index = np.frombuffer(corners, dtype=np.int64).reshape(-1, 3) if corners else np.zeros((0, 3), dtype=np.int64)
    if index.size and not 0 <= index.min() <= index.max() < len(points):
        raise UnreadableFile("the file is damaged: a face in it names a vertex that it does not hold")
    _must_be_convex(points[index], np.frombuffer(fans, dtype=np.int64) if fans else np.zeros(0, dtype=np.int64))
    if not names or names[0][1] > 0:
        names.insert(0, ("", 0))
    ends = [begin for _, begin in names[1:]] + [len(index)]
    painted = np.frombuffer(shades, dtype=np.int64)
    objects = tuple(
        Named(name, _one_color(painted[index[begin:end]]), end - begin)
        for (name, begin), end in zip(names, ends, strict=True)
        if end > begin
    )
    return points[index], objects


def _shade(said: list[bytes]) -> int:
    """Red, green and blue from 0 to 1 as one number."""
    red, green, blue = (min(max(round(255 * float(each)), 0), 255) for each in said)
    return red << 16 | green << 8 | blue


def _one_color(shades: NDArray[np.int64]) -> str | None:
    """The colour that all vertices state, '#rrggbb'; None where one states none, or another."""
    first = int(shades.flat[0])
    return f"#{first:06x}" if first != NO_SHADE and (shades == first).all() else None


def _must_be_convex(corners: Array, fans: NDArray[np.int64]) -> None:
    """Raises UnreadableFile where a triangle of a fan looks the other way than its polygon: it lies beside that."""
    polygon = np.repeat(np.arange(len(fans)), fans)
    areas = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    whole = np.stack([np.bincount(polygon, weights=areas[:, k], minlength=len(fans)) for k in range(3)], axis=1)
    if ((areas * whole[polygon]).sum(axis=1) < -1e-6 * (whole[polygon] ** 2).sum(axis=1)).any():
        raise UnreadableFile("the file holds a polygon that is not convex; export it as triangles")
