"""A mesh as a B-rep: places that are one merged, shells turned outwards, faces fitted."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from querycad_segworker.errors import IncompleteFile, UnreadableFile
from querycad_segworker.mesh import Mesh
from querycad_segworker.tolerances import Tolerances
from querycad_segworker.topology import Brep

from .files import MeshFile
from .records import brep_of
from .regions import regions
from .shells import outward
from .triangles import Triangles, merged

LARGEST_M = 1e6
"""Beyond, the numbers are none of a part's, and their squares leave what can be computed."""


def fitted(file: MeshFile, name: str) -> tuple[Brep, Mesh]:
    """The faces that the triangles of a file make, and the triangles by face. Raises FileProblem without any."""
    if float(np.abs(file.corners).max()) > LARGEST_M:
        raise UnreadableFile("the file is damaged: a coordinate in it is beyond all bounds")
    source = np.repeat(np.arange(len(file.objects)), [each.count for each in file.objects])
    mesh, kept = merged(file.corners)
    if kept.any() and mesh.is_open.any():  # text of few digits has one place in several spellings
        wider, wider_kept = merged(file.corners, 2 * mesh.noise)
        if wider.is_open.sum() < mesh.is_open.sum():
            mesh, kept = wider, wider_kept
    if not len(mesh.corners) or not mesh.areas.sum():
        raise IncompleteFile("the file holds no geometry: no triangle in it has an area")
    source = source[kept]
    mesh = outward(mesh)
    near = max(Tolerances.for_diagonal(float(np.linalg.norm(np.ptp(mesh.vertices, axis=0)))).canonical, 2 * mesh.noise)
    found = regions(mesh, near)
    brep = brep_of(mesh, found, file.objects, source, (*_said(mesh), *file.warnings), near)
    triangles = Mesh(mesh.vertices, mesh.corners.astype(np.int32), found.owner.astype(np.int32))
    return replace(brep, name=name), triangles


def _said(mesh: Triangles) -> list[str]:
    said = [f"a mesh of {len(mesh.corners):,} triangles: faces were fitted to them, so measures are approximate"]
    if mesh.is_open.any():
        said.append(
            f"the mesh is not closed: {int(mesh.is_open.sum()):,} of its triangles have a side without a neighbour"
        )
    return said
