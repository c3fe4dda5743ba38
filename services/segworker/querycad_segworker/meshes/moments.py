"""How much area and volume do triangles have, and what do they lack of the round surfaces that they stand for?"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from querycad_segworker.topology import NO_MOMENTS, Moments

from .regions import Regions
from .triangles import Array, Ints, Triangles, vector_of

_GAUSS = np.array([[2 / 3, 1 / 6, 1 / 6], [1 / 6, 2 / 3, 1 / 6], [1 / 6, 1 / 6, 2 / 3]])
"""Places in a triangle over which squares are integrated exactly: the gap between facet and round surface is one."""


def gaps_of(mesh: Triangles, found: Regions) -> Array:
    """(T,) m3 between each triangle and its round surface: what a mesh lacks of a shaft, and has too much in a hole."""
    gaps = np.zeros(len(mesh.corners))
    for members, surface, outward in zip(found.members, found.surfaces, found.outward, strict=True):
        if surface is not None and outward:
            places = gauss_places(mesh, members)
            off = surface.off(places.reshape(-1, 3)).reshape(-1, 3).mean(axis=1)
            gaps[members] = -outward * off * mesh.areas[members]
    return gaps


def gauss_places(mesh: Triangles, members: Ints) -> Array:
    """(T, 3, 3): three places in each triangle, over which a mean is the integral."""
    places: Array = np.einsum("gk,tkd->tgd", _GAUSS, mesh.vertices[mesh.corners[members]])
    return places


def of_area(mesh: Triangles, members: Ints) -> Moments:
    """Of these triangles' area."""
    weights = mesh.areas[members]
    total = float(weights.sum())
    if total <= 0:
        return replace(NO_MOMENTS, center=vector_of(mesh.centers[members].mean(axis=0)))
    center = weights @ mesh.centers[members] / total
    corners = mesh.vertices[mesh.corners[members]] - center
    sums = corners.sum(axis=1)
    second = (
        np.einsum("t,tki,tkj->ij", weights, corners, corners) + np.einsum("t,ti,tj->ij", weights, sums, sums)
    ) / 12
    return _moments(total, center, second)


def of_volume(mesh: Triangles, members: Ints) -> Moments:
    """Of what these triangles enclose; nothing where they are inside out."""
    base = mesh.vertices[mesh.corners[members]].reshape(-1, 3).mean(axis=0)
    corners = mesh.vertices[mesh.corners[members]] - base
    volumes = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6
    total = float(volumes.sum())
    if total <= 0:
        return NO_MOMENTS
    sums = corners.sum(axis=1)
    center = volumes @ sums / 4 / total
    second = (
        np.einsum("t,tki,tkj->ij", volumes, corners, corners) + np.einsum("t,ti,tj->ij", volumes, sums, sums)
    ) / 20
    return _moments(total, base + center, second - total * np.outer(center, center))


def _moments(amount: float, center: Array, second: Array) -> Moments:
    """From second moments about the centre, the integral of x xT."""
    x, y, z = (vector_of(row) for row in np.trace(second) * np.eye(3) - second)
    return Moments(amount, vector_of(center), (x, y, z))


def scaled(moments: Moments, amount: float) -> Moments:
    """The same spread, of another amount."""
    if moments.amount <= 0:
        return replace(moments, amount=amount)
    share = amount / moments.amount
    x, y, z = ((row[0] * share, row[1] * share, row[2] * share) for row in moments.inertia)
    return Moments(amount, moments.center, (x, y, z))
