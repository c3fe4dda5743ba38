"""Triangles for looking and casting rays; measures never come from them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from OCP.BRep import BRep_Tool
from OCP.BRepMesh import BRepMesh_IncrementalMesh
from OCP.collections import IndexedMap_TopoDS_Shape_TopTools_ShapeMapHasher as ShapeMap
from OCP.gp import gp_Pnt
from OCP.Poly import Poly_Triangle, Poly_Triangulation
from OCP.TopAbs import TopAbs_Orientation
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS_Face

from querycad_segworker.mesh import Mesh

from .faces import METRES_PER_MM
from .step import compound_of

RELATIVE_DEFLECTION = 5e-4
"""Chord error as a share of the model's diagonal: half a pixel where the model fills a picture of 1,000 pixels."""
ANGULAR_DEFLECTION_RAD = 0.35
"""Angle between neighbouring facets: 18 facets a circle, so that small holes stay round enough to look through."""


def tessellate(faces: Sequence[TopoDS_Face], diagonal_m: float) -> Mesh:
    """Which triangles cover the faces? `triangle_face` counts `faces` from 0; a face that cannot be meshed has none."""
    deflection = max(RELATIVE_DEFLECTION * diagonal_m / METRES_PER_MM, 1e-7)
    BRepMesh_IncrementalMesh(compound_of(faces), deflection, False, ANGULAR_DEFLECTION_RAD, False)
    corners: list[NDArray[np.float64]] = []
    triangles: list[NDArray[np.int32]] = []
    owners: list[NDArray[np.int32]] = []
    known = _Triangulations()
    count = 0
    for index, face in enumerate(faces):
        found = known.of(face)
        if found is None:
            continue
        points, corner_ids = found
        turned = face.Orientation() == TopAbs_Orientation.TopAbs_REVERSED
        corners.append(points)
        triangles.append((corner_ids[:, ::-1] if turned else corner_ids) + np.int32(count))
        owners.append(np.full(len(corner_ids), index, dtype=np.int32))
        count += len(points)
    return Mesh(
        vertices_m=np.concatenate([np.zeros((0, 3)), *corners]) * METRES_PER_MM,
        triangles=np.concatenate([np.zeros((0, 3), dtype=np.int32), *triangles]),
        triangle_face=np.concatenate([np.zeros(0, dtype=np.int32), *owners]),
    )


class _Triangulations:
    """The faces' triangles as arrays. Instances of one product share them but for the place: each is read once."""

    def __init__(self) -> None:
        self._unplaced = ShapeMap()
        self._known: list[tuple[NDArray[np.float64], NDArray[np.int32]] | None] = []

    def of(self, face: TopoDS_Face) -> tuple[NDArray[np.float64], NDArray[np.int32]] | None:
        """(V, 3) float64 points, placed, and (T, 3) int32 indices of them; None for a face without triangles."""
        location = TopLoc_Location()
        triangulation = BRep_Tool.Triangulation_s(face, location)
        position = int(self._unplaced.Add(face.Located(TopLoc_Location())))
        if position > len(self._known):
            self._known.append(None if triangulation is None else _arrays(triangulation))
        found = self._known[position - 1]
        if found is None or location.IsIdentity():
            return found
        place = location.Transformation()
        matrix = np.array([[place.Value(row, column) for column in range(1, 5)] for row in range(1, 4)])
        return found[0] @ matrix[:, :3].T + matrix[:, 3], found[1]


def _arrays(triangulation: Poly_Triangulation) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    nodes = map(triangulation.Node, range(1, triangulation.NbNodes() + 1))
    points = np.array(list(map(gp_Pnt.Coord, nodes)), dtype=np.float64)
    triangles = map(triangulation.Triangle, range(1, triangulation.NbTriangles() + 1))
    corners = np.array(list(map(Poly_Triangle.Get, triangles)), dtype=np.int32)
    return points.reshape(-1, 3), corners.reshape(-1, 3) - np.int32(1)
