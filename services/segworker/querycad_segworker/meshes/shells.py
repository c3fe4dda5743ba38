"""Which triangles hang together, which of such shells bound one body, and which way is out?"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .triangles import Array, Ints, Triangles, components


@dataclass(frozen=True, slots=True, eq=False)
class Shells:
    """of: (T,) the shell that each triangle is in. body: (S,) the shell that each is a void of, or itself."""

    of: Ints
    closed: NDArray[np.bool_]
    volumes: Array
    body: Ints


def shells(mesh: Triangles) -> Shells:
    """A shell that is inside out within another closed one is its void."""
    one, other = mesh.pairs
    of = components(len(mesh.corners), one // 3, other // 3)
    count = int(of.max(initial=-1)) + 1
    closed = np.bincount(of, weights=mesh.is_open, minlength=count) == 0
    corners = mesh.vertices[mesh.corners] - mesh.vertices.mean(axis=0)
    signed = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6
    volumes: Array = np.bincount(of, weights=signed, minlength=count).astype(np.float64)
    low, high = np.full((count, 3), np.inf), np.full((count, 3), -np.inf)
    for k in range(3):
        np.minimum.at(low, of, mesh.vertices[mesh.corners[:, k]])
        np.maximum.at(high, of, mesh.vertices[mesh.corners[:, k]])
    body = np.arange(count)
    for void in np.flatnonzero((volumes < 0) & closed):
        around = (volumes > -volumes[void]) & closed & (low < low[void]).all(axis=1) & (high > high[void]).all(axis=1)
        if around.any():
            body[void] = np.flatnonzero(around)[volumes[around].argmin()]
    return Shells(of, closed, volumes, body)


def outward(mesh: Triangles) -> Triangles:
    """The mesh with shells turned that are inside out and no void of another one."""
    found = shells(mesh)
    turned = ((found.volumes < 0) & (found.body == np.arange(len(found.body))))[found.of]
    if not turned.any():
        return mesh
    corners = mesh.corners.copy()
    corners[turned] = corners[turned, ::-1]
    return Triangles(mesh.vertices, corners)
