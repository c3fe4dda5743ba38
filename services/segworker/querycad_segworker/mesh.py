"""The triangles of a model: what rendering sees of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, slots=True, eq=False)
class Mesh:
    """Which triangles is the model's surface made of, and which face does each belong to?

    vertices_m: (V, 3) float64, metres, in the frame of the file. triangles: (T, 3) int32, indices of vertices.
    triangle_face: (T,) int32, id of the face that each triangle is part of. Shared vertices, triangles without area
    and either orientation are fine. Raises ValueError for any other shape or dtype, for a coordinate that is not
    finite, and for an index out of range.

    closed: every body is closed, and its triangles run counter-clockwise as seen from outside: nobody there sees the
    back of one. `orientation.outward` finds it out.
    """

    vertices_m: NDArray[np.float64]
    triangles: NDArray[np.int32]
    triangle_face: NDArray[np.int32]
    closed: bool = False

    def __post_init__(self) -> None:
        _require(self.vertices_m, "vertices_m", np.float64, (None, 3))
        _require(self.triangles, "triangles", np.int32, (None, 3))
        _require(self.triangle_face, "triangle_face", np.int32, (len(self.triangles),))
        if not np.isfinite(self.vertices_m).all():
            raise ValueError("vertices_m holds a coordinate that is not finite")
        if self.triangles.size and not 0 <= self.triangles.min() <= self.triangles.max() < len(self.vertices_m):
            raise ValueError(f"triangles holds an index outside 0..{len(self.vertices_m) - 1}")
        if self.triangle_face.size and self.triangle_face.min() < 0:
            raise ValueError("triangle_face holds a negative face id")

    @property
    def points_m(self) -> NDArray[np.float64]:
        """Which vertices do the triangles use? (N, 3) float64, metres, each once."""
        used = np.zeros(len(self.vertices_m), dtype=np.bool_)
        used[self.triangles] = True
        return self.vertices_m[used]

    @property
    def bounds(self) -> NDArray[np.float64]:
        """Which axis-aligned box holds the triangles? (2, 3) float64, lower and upper corner; zeros when empty."""
        columns = self.points_m.T  # one by one: NumPy is 20 times slower across the rows of a narrow array
        if not columns.size:
            return np.zeros((2, 3))
        return np.array([[column.min() for column in columns], [column.max() for column in columns]])

    def renumbered(self, faces: Sequence[int]) -> Mesh:
        """The same triangles with other ids of faces: `faces` has the new id of each old one."""
        owner = np.array(faces, dtype=np.int32)
        return Mesh(self.vertices_m, self.triangles, owner[self.triangle_face], closed=self.closed)

    def save(self, path: Path) -> None:
        """Keeps the arrays in NumPy's format. `path` ends in .npz."""
        np.savez(
            path,
            vertices_m=self.vertices_m,
            triangles=self.triangles,
            triangle_face=self.triangle_face,
            closed=np.bool_(self.closed),
        )

    @classmethod
    def load(cls, path: Path | BinaryIO) -> Mesh:
        """Which mesh did `save` keep?"""
        with np.load(path) as arrays:
            return cls(
                arrays["vertices_m"], arrays["triangles"], arrays["triangle_face"], closed=bool(arrays["closed"])
            )

    def of_faces(self, faces: NDArray[np.integer]) -> Mesh:
        """Which part of the mesh belongs to these faces? Shares the vertices; unknown ids are passed over."""
        chosen = np.isin(self.triangle_face, faces)
        return Mesh(self.vertices_m, self.triangles[chosen], self.triangle_face[chosen])


def _require(array: NDArray[np.generic], name: str, dtype: type[np.generic], shape: tuple[int | None, ...]) -> None:
    fits = array.ndim == len(shape) and all(
        want is None or have == want for have, want in zip(array.shape, shape, strict=True)
    )
    if not fits or array.dtype != dtype:
        wanted = ", ".join("n" if n is None else str(n) for n in shape)
        raise ValueError(f"{name} must be ({wanted}) {dtype.__name__}, not {array.shape} {array.dtype}")
