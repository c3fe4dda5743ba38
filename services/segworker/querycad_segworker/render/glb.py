"""A model's triangles as binary glTF 2.0, for viewers that let users pick faces."""

from __future__ import annotations

import gzip
import json
import struct
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from querycad_contracts import Body
from querycad_segworker.errors import UnreadableFile
from querycad_segworker.mesh import Mesh
from querycad_segworker.model import Artefacts
from querycad_segworker.visibility.normals import smooth_normals

from .shading import NEUTRAL

_Z_UP_TO_Y_UP = (1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1)
"""glTF's y points up (glTF 2.0, 3.4); the file's z does here. The node turns it, the vertices stay as in the file."""
_FLOAT, _UNSIGNED_INT = 5126, 5125
_VERTICES, _INDICES = 34962, 34963
_LINES, _TRIANGLES = 1, 4
LEVEL = 6
"""Of gzip: the highest, 9, takes four times as long for one part in fifty less."""


def write_glb(artefacts: Artefacts, path: Path) -> None:
    """Writes the model as a GLB file. Raises OSError, and UnreadableFile where there are no triangles."""
    body_of_face = np.array([face.body for face in artefacts.load_faces()], dtype=np.int32)
    data = glb(Mesh.load(artefacts.mesh), artefacts.load_model().shape.bodies, body_of_face)
    path.write_bytes(data)


def compress(plain: Path, path: Path) -> None:
    """Writes the file compressed by gzip, the same bytes each time. Raises OSError."""
    path.write_bytes(gzip.compress(plain.read_bytes(), LEVEL, mtime=0))


def glb(mesh: Mesh, bodies: Sequence[Body] = (), body_of_face: NDArray[np.int32] | None = None) -> bytes:
    """The mesh as binary glTF, metres: a node for each body, with its name, its colour, and its id in `extras`.

    The vertex attribute `_FACE_ID` (one float32) is the id of the vertex's face: where faces meet, there is a vertex
    for each. Ids are exact as float32 up to 2^24; glTF allows no 32-bit integers there. Beside its triangles, a mesh
    has the lines where faces meet, as a primitive of the same vertices. body_of_face: (F,) int32; None: all faces are
    of one body. Raises UnreadableFile for a mesh without triangles.
    """
    if not len(mesh.triangles):
        raise UnreadableFile("the model has no surface that could be shown")
    keys = np.stack([mesh.triangles.reshape(-1), np.repeat(mesh.triangle_face, 3)], axis=1)
    own, first, index = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    positions = mesh.vertices_m[own[:, 0]].astype(np.float32)
    normals = smooth_normals(mesh).reshape(-1, 3)[first].astype(np.float32)
    faces = own[:, 1]
    triangles = index.reshape(-1, 3)
    lines = edge_lines(positions, triangles, mesh.triangle_face)
    body_of = np.zeros(int(faces.max()) + 1, dtype=np.int32) if body_of_face is None else body_of_face
    file = _File()
    known = {body.id: body for body in bodies}
    for body in np.unique(body_of[faces]):
        mine = np.flatnonzero(body_of[faces] == body)
        new = np.full(len(faces), -1)
        new[mine] = np.arange(len(mine))
        attributes = {
            "POSITION": file.add(positions[mine], _VERTICES, bounded=True),
            "NORMAL": file.add(normals[mine], _VERTICES),
            "_FACE_ID": file.add(faces[mine].astype(np.float32), _VERTICES),
        }
        indices = [
            (mode, file.add(new[part[new[part[:, 0]] >= 0]].astype(np.uint32).reshape(-1), _INDICES))
            for mode, part in ((_TRIANGLES, triangles), (_LINES, lines))
            if (new[part[:, 0]] >= 0).any()
        ]
        file.body(known.get(int(body)), int(body), attributes, indices)
    return file.data()


def edge_lines(
    positions: NDArray[np.float32], triangles: NDArray[np.integer], face: NDArray[np.int32]
) -> NDArray[np.int64]:
    """Where do faces meet, or end? (L, 2) indices of vertices, each line once; a round face's own seam is none.

    positions: (V, 3) float32, a vertex for each face that meets there; triangles: (T, 3); face: (T,) ids.
    """
    _, place = np.unique(positions, axis=0, return_inverse=True)
    ends = triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2).astype(np.int64)
    key = np.sort(place.reshape(-1)[ends], axis=1)
    order = np.lexsort((key[:, 1], key[:, 0]))
    key, ends, owner = key[order], ends[order], np.repeat(face, 3)[order]
    starts = np.flatnonzero(np.any(key[1:] != key[:-1], axis=1)) + 1
    starts = np.concatenate([[0], starts])
    low, high = np.minimum.reduceat(owner, starts), np.maximum.reduceat(owner, starts)
    alone = np.diff([*starts, len(key)]) == 1
    real = key[starts, 0] != key[starts, 1]
    lines: NDArray[np.int64] = ends[starts[(alone | (low != high)) & real]]
    return lines


class _File:
    """The parts of a GLB file as they come (glTF 2.0, 4.4)."""

    def __init__(self) -> None:
        self._buffer = bytearray()
        self._tree: dict[str, list[Any]] = {"bufferViews": [], "accessors": [], "materials": [], "meshes": []}
        self._nodes: list[dict[str, Any]] = [{"name": "model", "matrix": _Z_UP_TO_Y_UP, "children": []}]
        self._materials: dict[str, int] = {}

    def add(self, array: NDArray[Any], target: int, *, bounded: bool = False) -> int:
        """The number of a new accessor of these values. All have four bytes, so that each view is aligned."""
        view = {"buffer": 0, "byteOffset": len(self._buffer), "byteLength": array.nbytes, "target": target}
        accessor = {
            "bufferView": len(self._tree["bufferViews"]),
            "componentType": _UNSIGNED_INT if target == _INDICES else _FLOAT,
            "count": len(array),
            "type": "SCALAR" if array.ndim == 1 else "VEC3",
        }
        if bounded:
            accessor |= {"min": array.min(axis=0).tolist(), "max": array.max(axis=0).tolist()}
        self._buffer += array.tobytes()
        self._tree["bufferViews"].append(view)
        self._tree["accessors"].append(accessor)
        return len(self._tree["accessors"]) - 1

    def body(self, body: Body | None, number: int, attributes: dict[str, int], indices: list[tuple[int, int]]) -> None:
        """A node for a body; `indices` has the accessor for each mode that it is drawn in."""
        material = self._material(body.color if body is not None else None)
        primitives = [
            {"attributes": attributes, "indices": accessor, "mode": mode, "material": material}
            for mode, accessor in indices
        ]
        name = (body.name if body is not None else "") or f"body-{number + 1}"
        self._nodes[0]["children"].append(len(self._nodes))
        self._nodes.append({"name": name, "mesh": len(self._tree["meshes"]), "extras": {"body": number}})
        self._tree["meshes"].append({"name": name, "primitives": primitives})

    def _material(self, color: str | None) -> int:
        """The material of a hexadecimal sRGB colour, grey without; glTF's factors are linear (glTF 2.0, 3.9.2)."""
        name = color or ""
        if name not in self._materials:
            srgb = np.array(NEUTRAL if color is None else list(bytes.fromhex(color.removeprefix("#"))[:3])) / 255
            linear = np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)  # IEC 61966-2-1
            self._materials[name] = len(self._tree["materials"])
            look = {"baseColorFactor": [*linear.tolist(), 1.0], "metallicFactor": 0.1, "roughnessFactor": 0.7}
            self._tree["materials"].append({"name": name or "plain", "doubleSided": True, "pbrMetallicRoughness": look})
        return self._materials[name]

    def data(self) -> bytes:
        """The file."""
        tree = {
            "asset": {"version": "2.0", "generator": "QueryCAD"},
            "scene": 0,
            "scenes": [{"nodes": [0]}],
            "nodes": self._nodes,
            "buffers": [{"byteLength": len(self._buffer)}],
            **self._tree,
        }
        text = json.dumps(tree, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        length = 12 + 8 + len(text) + 8 + len(self._buffer)
        head = struct.pack("<4sII", b"glTF", 2, length) + struct.pack("<I4s", len(text), b"JSON")
        return head + text + struct.pack("<I4s", len(self._buffer), b"BIN\0") + bytes(self._buffer)
