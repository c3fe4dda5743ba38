"""Who renders? OpenGL where the machine has it, rays elsewhere: the same images, by the same call."""

from __future__ import annotations

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from querycad_segworker.mesh import Mesh

from .cameras import Camera
from .gl import GlScene, GlUnavailable
from .raycast import IdImage, Scene


class Renderer(Protocol):
    """A mesh made ready for looking at."""

    @property
    def mesh(self) -> Mesh:
        """What is looked at."""
        ...

    @property
    def bounds(self) -> NDArray[np.float64]:
        """Which axis-aligned box holds it? (2, 3) float64, lower and upper corner, metres."""
        ...

    def render_ids(self, camera: Camera, normals: bool = False) -> IdImage:
        """Which face does each pixel of `camera` show, and how far away?"""
        ...


def make_renderer(mesh: Mesh) -> Renderer:
    """Which renderer is the fastest here? Made after a fork, and for that process only."""
    try:
        return GlScene(mesh)
    except GlUnavailable:
        return Scene(mesh)
