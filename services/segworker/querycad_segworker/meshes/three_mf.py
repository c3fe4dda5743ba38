"""Reads 3MF (ISO/IEC 25422): an archive of XML. Objects, what they are composed of, and where the build places them.

Of the extensions the one for production is read, where objects lie in parts of their own, and of that for materials the
colours. An object is as its own property says, or as all its triangles do. Bytes are counted as they
come out of the archive, and a document type, which the format forbids and entities need, ends the reading.
"""

from __future__ import annotations

import re
import zipfile
import zlib
from array import array
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from xml.parsers import expat

import numpy as np

from querycad_segworker.errors import FileTooLarge, IncompleteFile, UnreadableFile
from querycad_segworker.files.archives import opened
from querycad_segworker.files.sniff import MAX_FILE_BYTES

from .triangles import MOST_TRIANGLES, Array, Named

CHUNK_BYTES = 2**20
_COLOR = re.compile(r"#[0-9a-fA-F]{6}(?:[0-9a-fA-F]{2})?")
DEEPEST = 20
"""Of assemblies in assemblies: more is a circle."""
_RELATIONS = "_rels/.rels"
_MODEL = "3D/3dmodel.model"
_MODEL_TYPE = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"
_UNITS = {
    "micron": ("micrometre", 1e-6), "millimeter": ("millimetre", 1e-3), "centimeter": ("centimetre", 1e-2),
    "inch": ("inch", 0.0254), "foot": ("foot", 0.3048), "meter": ("metre", 1.0),
}  # fmt: skip
"""The core specification, section 3.4."""
Reference = tuple[str, str]
"""Of an object: the part of the archive that it is in, and its id there."""


_COLORS = {"base": "displaycolor", "color": "color"}
"""Elements that state a colour, '#RRGGBB' or '#RRGGBBAA', and in which attribute: core 5.1.1, materials 3.1."""
Paint = tuple[str, str]
"""The id of a group of colours in the same part of the archive, and which of the group it is."""


@dataclass(slots=True)
class _Object:
    name: str
    paint: Paint | None
    """Of the object, and of its triangles that do not state one."""
    paints: set[Paint] = field(default_factory=set)
    """Of its triangles."""
    places: array[float] = field(default_factory=lambda: array("d"))
    corners: array[int] = field(default_factory=lambda: array("q"))
    components: list[tuple[Reference, Array]] = field(default_factory=list)


def read_3mf(path: Path) -> tuple[Array, tuple[Named, ...], str]:
    """(T, 3, 3) corners in metres, the objects as they are placed, and the name of the unit."""
    try:
        with opened(path) as archive:
            reader = _Reader(archive)
            reader.read(_root(reader))
            return reader.placed()
    except (zipfile.BadZipFile, zlib.error, EOFError, NotImplementedError, RuntimeError) as error:
        raise IncompleteFile("the 3MF file is damaged or cut short") from error
    except expat.ExpatError as error:
        raise UnreadableFile(f"the 3MF file is damaged: its XML breaks off or is none ({error})") from error
    except (KeyError, ValueError, OverflowError) as error:
        raise UnreadableFile("the 3MF file is damaged: a number in it is missing or none") from error


def _root(reader: _Reader) -> str:
    """The part that the archive's relations name as its model."""
    targets: list[str] = []

    def start(name: str, attributes: dict[str, str]) -> None:
        if _local(name) == "Relationship" and attributes.get("Type") == _MODEL_TYPE:
            targets.append(attributes.get("Target", "").lstrip("/"))

    if reader.has(_RELATIONS):
        reader.parse(_RELATIONS, start)
    return targets[0] if targets else _MODEL


class _Reader:
    def __init__(self, archive: zipfile.ZipFile) -> None:
        self._archive = archive
        self._names = {name.lower(): name for name in archive.namelist()}
        self._left = MAX_FILE_BYTES
        self._read: set[str] = set()
        self._part = ""
        self._unit = "millimeter"
        self._object: _Object | None = None
        self._objects: dict[Reference, _Object] = {}
        self._colors: dict[Reference, list[str]] = {}
        self._group: list[str] = []
        self._items: list[tuple[Reference, Array]] = []
        self._triangles = 0

    def has(self, part: str) -> bool:
        """Is it in the archive?"""
        return part.lower() in self._names

    def parse(self, part: str, start: Callable[[str, dict[str, str]], None]) -> None:
        """Goes through a part's XML, element by element."""
        if not self.has(part):
            raise IncompleteFile(f"the 3MF file is damaged: its part {part[:80]!r} is missing")
        parser = expat.ParserCreate()
        parser.StartElementHandler = start
        parser.StartDoctypeDeclHandler = _no_document_type
        with self._archive.open(self._names[part.lower()]) as file:
            while chunk := file.read(CHUNK_BYTES):
                self._left -= len(chunk)
                if self._left < 0:
                    raise FileTooLarge(
                        f"unpacked, the file has more than the {MAX_FILE_BYTES / 2**20:.0f} MB that are read"
                    )
                parser.Parse(chunk)
        parser.Parse(b"", True)

    def read(self, part: str) -> None:
        """Reads a part, and those that it refers to."""
        waiting = [part]
        while waiting:
            self._part = waiting.pop().lstrip("/")
            if self._part.lower() in self._read:
                continue
            self._read.add(self._part.lower())
            self._object = None
            is_root = len(self._read) == 1
            self.parse(self._part, self._start)
            referred = [reference for each in self._objects.values() for reference, _ in each.components]
            if is_root:
                referred += [reference for reference, _ in self._items]
            waiting += sorted({name for name, _ in referred if name.lower() not in self._read})

    def _start(self, name: str, attributes: dict[str, str]) -> None:
        match _local(name):
            case "vertex" if self._object is not None:
                self._object.places.extend((float(attributes["x"]), float(attributes["y"]), float(attributes["z"])))
            case "triangle" if self._object is not None:
                self._object.corners.extend((int(attributes["v1"]), int(attributes["v2"]), int(attributes["v3"])))
                self._object.paints |= {paint} if (paint := _paint(attributes, "p1")) else set()
                self._triangles += 1
                if self._triangles > MOST_TRIANGLES:
                    raise FileTooLarge(f"the mesh has more than the {MOST_TRIANGLES:,} triangles that are read")
            case "object":
                self._object = _Object(attributes.get("name", ""), _paint(attributes, "pindex"))
                self._objects[self._part.lower(), attributes.get("id", "")] = self._object
            case "basematerials" | "colorgroup":
                self._group = self._colors.setdefault((self._part.lower(), attributes.get("id", "")), [])
            case "base" | "color" as kind:
                self._group.append(attributes.get(_COLORS[kind], ""))
            case "component" if self._object is not None:
                self._object.components.append(self._reference(attributes))
            case "item":
                self._items.append(self._reference(attributes))
            case "model" if not self._objects and not self._items:
                self._unit = attributes.get("unit", self._unit)

    def _reference(self, attributes: dict[str, str]) -> tuple[Reference, Array]:
        part = next((value for name, value in attributes.items() if _local(name) == "path"), self._part)
        matrix = np.array([float(each) for each in attributes.get("transform", "1 0 0 0 1 0 0 0 1 0 0 0").split()])
        return (part.lstrip("/").lower(), attributes.get("objectid", "")), matrix.reshape(4, 3)

    def placed(self) -> tuple[Array, tuple[Named, ...], str]:
        """What the build places; all objects with triangles where it places none."""
        if self._unit not in _UNITS:
            raise UnreadableFile(f"the 3MF file is damaged: its unit {self._unit[:40]!r} is none of the format's")
        unit, metres = _UNITS[self._unit]
        unmoved = np.r_[np.eye(3), np.zeros((1, 3))]
        items = self._items or [(reference, unmoved) for reference, each in self._objects.items() if each.corners]
        pieces: list[Array] = []
        named: list[Named] = []
        for reference, matrix in items:
            self._place(reference, matrix, "", pieces, named, 0)
        corners = np.concatenate([np.zeros((0, 3, 3)), *pieces])
        return corners * metres, tuple(named), unit

    def _place(
        self, reference: Reference, matrix: Array, name: str, pieces: list[Array], named: list[Named], depth: int
    ) -> None:
        found = self._objects.get(reference)
        if found is None or depth > DEEPEST:
            raise UnreadableFile(
                "the 3MF file is damaged: an object in it is made of one that it does not hold, or of itself"
            )
        own = found.name or name
        if found.corners:
            points = np.frombuffer(found.places, dtype=np.float64).reshape(-1, 3)
            index = np.frombuffer(found.corners, dtype=np.int64).reshape(-1, 3)
            if not len(points) or not 0 <= index.min() <= index.max() < len(points):
                raise UnreadableFile("the 3MF file is damaged: a triangle in it names a vertex that it does not hold")
            placed = points @ matrix[:3] + matrix[3]
            mirrored = np.linalg.det(matrix[:3]) < 0
            pieces.append(placed[index[:, ::-1] if mirrored else index])
            named.append(Named(own, self._color(reference[0], found), len(index)))
            if sum(each.count for each in named) > MOST_TRIANGLES:
                raise FileTooLarge(f"the mesh has more than the {MOST_TRIANGLES:,} triangles that are read")
        for inner, place in found.components:
            both = np.r_[place[:3] @ matrix[:3], (place[3] @ matrix[:3] + matrix[3])[None]]
            self._place(inner, both, own, pieces, named, depth + 1)

    def _color(self, part: str, of: _Object) -> str | None:
        """The one colour of an object, '#rrggbb'; None where it has none, or several."""
        paint = of.paint if not of.paints else of.paints.copy().pop() if len(of.paints) == 1 else None
        if paint is None or not paint[1].isdecimal():
            return None
        group = self._colors.get((part, paint[0]), [])
        said = group[int(paint[1])] if int(paint[1]) < len(group) else ""
        return said[:7].lower() if _COLOR.fullmatch(said) else None


def _paint(attributes: dict[str, str], which: str) -> Paint | None:
    return (attributes["pid"], attributes.get(which, "0")) if "pid" in attributes else None


def _local(name: str) -> str:
    return name.rpartition(":")[2]


def _no_document_type(*_: object) -> None:
    raise UnreadableFile("the 3MF file declares a document type, which the format forbids")
