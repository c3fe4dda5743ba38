"""A model's triangles as binary glTF 2.0, for viewers that let users pick faces."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import trimesh

from querycad_segworker.errors import UnreadableFile
from querycad_segworker.mesh import Mesh
from querycad_segworker.model import Artefacts
from querycad_segworker.visibility.normals import smooth_normals

from .shading import NEUTRAL

_Z_UP_TO_Y_UP = np.array([[1.0, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]])
"""glTF's y points up (glTF 2.0, 3.4); the file's z does here. The node turns it, the vertices stay as in the file."""


def write_glb(artefacts: Artefacts, path: Path) -> None:
    """Writes the model's triangles into a GLB file. Raises OSError, and UnreadableFile where there are none."""
    path.write_bytes(glb(Mesh.load(artefacts.mesh)))


def glb(mesh: Mesh) -> bytes:
    """The mesh as binary glTF, metres. The vertex attribute `_FACE_ID` (one float32) is the id of the vertex's face.

    A vertex belongs to one face: where faces meet, there is one for each. Ids are exact as float32 up to 2^24; glTF
    allows no 32-bit integers there. Raises UnreadableFile for a mesh without triangles.
    """
    if not len(mesh.triangles):
        raise UnreadableFile("the model has no surface that could be shown")
    scene = trimesh.Scene()
    corner_normals = smooth_normals(mesh)
    keys = np.stack([mesh.triangles.reshape(-1), np.repeat(mesh.triangle_face, 3)], axis=1)
    own, first, index = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    normals = corner_normals.reshape(-1, 3)[first]
    shape = trimesh.Trimesh(
        vertices=mesh.vertices_m[own[:, 0]],
        faces=index.reshape(-1, 3),
        vertex_normals=normals,
        vertex_attributes={"_FACE_ID": own[:, 1].astype(np.float32)},
        process=False,
    )
    material = trimesh.visual.material.PBRMaterial(
        baseColorFactor=[*NEUTRAL, 255], metallicFactor=0.1, roughnessFactor=0.7, doubleSided=True
    )
    shape.visual = trimesh.visual.TextureVisuals(material=material)
    scene.add_geometry(shape, node_name="model", geom_name="model", transform=_Z_UP_TO_Y_UP)
    data: bytes = scene.export(file_type="glb", include_normals=True)
    return data
