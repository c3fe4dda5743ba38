"""Which triangles are one face? Flat ones together first, then round surfaces grown over them. Lengths in metres.

A mesh made from a CAD model has its vertices on the model's surfaces. So a cylinder is known by its vertices, which
lie on it to the last digit, and by its facets, which turn in steps. What lies on no surface that can be named is a
freeform face where it turns in such steps, else a plane.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from querycad_contracts import SurfaceKind

from .surfaces import Fitted, fit_cone, fit_cylinder, fit_plane, fit_sphere, fit_torus
from .triangles import Array, Ints, Triangles, components, grouped

MOST_STEP_RAD = math.radians(32.0)
"""Facets of one round face turn by no more: 12 around. Programs' coarse settings are 10 to 30 degrees (Open CASCADE
0.5 rad); a nut has 60 degrees, an octagon 45, and both are prisms."""
HALF_STEP, DOUBLE_STEP = 0.55, 0.8
"""Of the largest step: so much a facet's normal may differ from its surface's; more where that bends both ways."""
FLAT_RAD = 1e-3
"""Triangles that turn by less are in one plane: a circle of 6,000 facets is finer than any program makes it."""
SLIVER_RAD = 0.1
"""A triangle whose normal may be off by this says nothing of the surface."""
LEAST_FACETS = {SurfaceKind.CYLINDER: 3, SurfaceKind.CONE: 4, SurfaceKind.SPHERE: 8, SurfaceKind.TORUS: 10}
"""In a round face: two planes that meet are an edge, and the freer a surface, the more points it goes through."""
FEW = 5
"""Facets of a face that must be about equally wide, lest they be something else."""
UNLIKE = 2.0
"""Steps and radii of neighbouring facets of one round face differ by no more than this factor; a cut facet's do."""
MOST_FAILED = 3000
"""Tries that come to nothing: freeform faces of scans would cost minutes. Some milliseconds each at most."""
BENDS_ON = 0.25
"""A change of curvature by less is no end of a face: a spline's changes by little from facet to facet, while beside a
round there is a plane, with none, or another round, whose radius is made another one by more."""
FURTHER = 1.2
"""By this factor larger a face of a less simple surface must be."""
_PATCHES = {
    SurfaceKind.CYLINDER: (2, 8),
    SurfaceKind.CONE: (4, 14),
    SurfaceKind.SPHERE: (2,),
    SurfaceKind.TORUS: (6, 14, 40),
}
"""How many facets a first fit is made of, tried in order: few, as more may reach beyond the face; more where a surface
needs them, or where they do not lie along its rulings."""


@dataclass(frozen=True, slots=True, eq=False)
class Regions:
    """owner: (T,) the number of the region that each triangle is in. surfaces, outward: of each region."""

    owner: Ints
    surfaces: tuple[Fitted | None, ...]
    """None: freeform."""
    outward: tuple[int, ...]
    """As in `topology.FaceRecord`."""

    @property
    def members(self) -> list[Ints]:
        """Which triangles has each?"""
        return grouped(self.owner, len(self.surfaces))


def regions(mesh: Triangles, near: float) -> Regions:
    """Which faces is the mesh made of? `near`: vertices at this distance of a surface lie on it."""
    facets = _facets(mesh)
    growth = _Growth(mesh, facets, near)
    growth.run()
    return growth.regions()


def _facets(mesh: Triangles) -> Ints:
    """Groups of triangles in one plane. A sliver goes with the neighbour at its longest side."""
    sliver = mesh.tilts > SLIVER_RAD
    one, other = mesh.pairs
    a, b = one // 3, other // 3
    turned = mesh.angles.ravel()[one] > FLAT_RAD + mesh.tilts[a] + mesh.tilts[b]
    flat = ~turned & ~sliver[a] & ~sliver[b]
    links_a, links_b = [a[flat]], [b[flat]]
    thin = np.flatnonzero(sliver)
    longest = mesh.lengths[thin].argmax(axis=1)
    beyond = mesh.beside[thin, longest]
    known = beyond >= 0
    links_a.append(thin[known])
    links_b.append(beyond[known])
    return components(len(mesh.corners), np.concatenate(links_a), np.concatenate(links_b))


class _Growth:
    def __init__(self, mesh: Triangles, facets: Ints, near: float) -> None:
        self.mesh = mesh
        self.facets = facets
        self.near = near
        self.sliver = mesh.tilts > SLIVER_RAD
        self._size = np.bincount(facets)[facets]
        self._flags = np.zeros(len(mesh.corners), dtype=bool)
        self.owner = np.full(len(mesh.corners), -1, dtype=np.int64)
        self.surfaces: list[Fitted | None] = []
        self.outward: list[int] = []
        self._origins, self._directions, self._seen = np.zeros((0, 3)), np.zeros((0, 3)), 0
        self.smooth = (mesh.beside >= 0) & (
            (mesh.angles <= MOST_STEP_RAD)
            | self.sliver[:, None]
            | self.sliver[np.where(mesh.beside < 0, 0, mesh.beside)]
        )

    def run(self) -> None:
        """Grows a round surface from every pair of facets that a round surface could begin with."""
        one, other = self._seeds()
        tried = np.zeros(len(self.mesh.corners), dtype=np.int8)
        failed = 0
        for first, second in zip(one.tolist(), other.tolist(), strict=True):
            a, b = first // 3, second // 3
            if self.owner[a] >= 0 or self.owner[b] >= 0 or tried[a] > 1 or tried[b] > 1:
                continue
            members = self._grown_from(a, b, float(self.mesh.angles.ravel()[first]))
            if not len(members):
                continue
            tried[members] += 1
            failed += 1
            if failed >= MOST_FAILED:
                return

    def _seeds(self) -> tuple[Ints, Ints]:
        """Sides where two facets turn by a step, and one of them by a like one at another side; the longest first."""
        mesh = self.mesh
        one, other = mesh.pairs
        angle = mesh.angles.ravel()[one]
        a, b = one // 3, other // 3
        step = (self.facets[a] != self.facets[b]) & (angle <= MOST_STEP_RAD) & ~self.sliver[a] & ~self.sliver[b]
        one, other, angle, a, b = one[step], other[step], angle[step], a[step], b[step]
        # Of each facet: the steps at its sides, sorted; a like one follows or precedes.
        facet = np.r_[self.facets[a], self.facets[b]]
        steps, index = np.r_[angle, angle], np.r_[np.arange(len(one)), np.arange(len(one))]
        order = np.lexsort((steps, facet))
        facet, steps, index = facet[order], steps[order], index[order]
        like = (facet[1:] == facet[:-1]) & (steps[1:] <= UNLIKE * steps[:-1]) & (index[1:] != index[:-1])
        good = np.zeros(len(one), dtype=bool)
        good[index[1:][like]] = True
        good[index[:-1][like]] = True
        chosen = np.flatnonzero(good)
        chosen = chosen[np.argsort(-mesh.lengths.ravel()[one[chosen]], kind="stable")]
        return one[chosen], other[chosen]

    def _grown_from(self, a: int, b: int, step: float) -> Ints:
        """Grows a face from two triangles; the triangles that it was tried on in vain, none where it is one.

        Of the surfaces that go on from two triangles the one that goes furthest, the simpler where two are alike.

        A ring of facets lies on a cylinder or cone, on a sphere and on tori alike: what lies beyond it decides.
        """
        best: tuple[Ints, Fitted, int] | None = None
        most = 0.0
        for kind, patches in _PATCHES.items():
            for wanted in patches:
                unlike = 8 * UNLIKE if kind is SurfaceKind.TORUS else UNLIKE
                seed = self._patch(np.array([a, b]), step, wanted, unlike)
                found = self._grow(kind, seed) if len(seed) else None
                if found is None:
                    continue
                if kind is not SurfaceKind.CYLINDER:
                    found = self._plainer(kind, found)
                area = float(self.mesh.areas[found[0]].sum())
                if area > FURTHER * most:
                    best, most = found, area
                break
            if best is not None and self._is_all(best[0]):
                break
        if best is None:
            around = self._patch(np.array([a, b]), step, 8, UNLIKE)
            return around if len(around) else np.array([a, b])
        members, surface, outward = best
        if self._bends_on(members, surface):
            return members
        self.owner[members] = len(self.surfaces)
        self.surfaces.append(surface)
        self.outward.append(outward)
        return members[:0]

    def _plainer(self, kind: SurfaceKind, found: tuple[Ints, Fitted, int]) -> tuple[Ints, Fitted, int]:
        """The cylinder or cone that a face lies on as well, as far as it goes: a ring tells its axis, an arc not."""
        for plainer in (SurfaceKind.CYLINDER, SurfaceKind.CONE):
            if plainer is kind:
                break
            grown = self._grow(plainer, found[0])
            if grown is not None:
                return grown
        return found

    def _bends_on(self, members: Ints, surface: Fitted) -> bool:
        """Does the mesh go on beyond these with almost the same curvature? Then they are a piece of a freeform face.

        A vertex at a distance w from the last facet is off a surface of curvature k by w2 k / 2 where a plane begins,
        and by the same share of that by which the curvature changes.
        """
        mesh = self.mesh
        flags = self._flags
        flags[members] = True
        rows, side = np.nonzero(self.smooth[members])
        beyond = mesh.beside[members[rows], side]
        opposite = mesh.across[members[rows], side]
        outside = (
            ~flags[beyond]
            & (self.owner[beyond] < 0)
            & ~self.sliver[beyond]
            & (self._size[beyond] <= 2)
            & (mesh.angles[members[rows], side] > FLAT_RAD)
        )
        flags[members] = False
        beyond, opposite = beyond[outside], opposite[outside]
        if not len(beyond):
            return False
        far = mesh.vertices[mesh.corners[beyond, (opposite % 3 + 2) % 3]]
        width = 2 * mesh.areas[beyond] / mesh.lengths[beyond, opposite % 3]
        radius = surface.minor_radius or surface.radius
        if surface.kind is SurfaceKind.CONE:
            to = far - surface.origin
            radius = np.linalg.norm(to - (to @ surface.axis)[:, None] * surface.axis, axis=1) / math.cos(
                surface.half_angle
            )
        facet = width <= 2 * radius * math.sin(MOST_STEP_RAD / 2)
        return bool((facet & (np.abs(surface.off(far)) < BENDS_ON * width * width / (2 * radius))).any())

    def _is_all(self, members: Ints) -> bool:
        """Is there nothing beyond these that meets them smoothly?"""
        beyond = self.mesh.beside[members][self.smooth[members]]
        beyond = beyond[self.owner[beyond] < 0]
        flags = self._flags
        flags[members] = True
        none_left = bool(flags[beyond].all())
        flags[members] = False
        return none_left

    def _patch(self, seed: Ints, step: float, wanted: int, unlike: float) -> Ints:
        """So many facets around a pair of triangles, which turn by like steps; the pair itself where 2 are wanted."""
        if wanted <= 2:
            return seed
        members, front, most = seed, seed, max(2, int(self._size[seed].max()))
        while len(front):
            angle = self.mesh.angles[front]
            like = self.smooth[front] & ((angle <= FLAT_RAD) | ((angle < unlike * step) & (angle > step / unlike)))
            front = np.setdiff1d(self.mesh.beside[front][like], members)
            front = front[(self.owner[front] < 0) & ~self.sliver[front] & (self._size[front] <= most)]
            members = np.r_[members, front]
            if len(np.unique(self.facets[members])) >= wanted:
                found: Ints = members
                return found
        return members[:0]

    def _fit(self, kind: SurfaceKind, members: Ints) -> Fitted | None:
        mesh = self.mesh
        members = members[~self.sliver[members]]
        if not len(members):
            return None
        sample = members[:: max(1, len(members) // 2000)]
        points = mesh.vertices[np.unique(mesh.corners[sample])]
        normals, weights, centers = mesh.normals[sample], mesh.areas[sample], mesh.centers[sample]
        with np.errstate(all="ignore"):
            if kind is SurfaceKind.CYLINDER:
                found = fit_cylinder(points, normals, weights, mesh.noise)
            elif kind is SurfaceKind.CONE:
                found = fit_cone(points, normals, centers, weights, mesh.noise)
            elif kind is SurfaceKind.SPHERE:
                found = fit_sphere(points)
            else:
                found = fit_torus(points, *self._axes(), self.near)
            if found is None or not np.abs(found.off(points)).max() <= self.near:
                return None
        return found

    def _axes(self) -> tuple[Array, Array]:
        """Axes of the cylinders and cones found so far, each line once: (A, 3) points on them and directions."""
        for surface in self.surfaces[self._seen :]:
            if surface is not None and surface.kind in (SurfaceKind.CYLINDER, SurfaceKind.CONE):
                to = surface.origin - self._origins
                apart = np.linalg.norm(np.cross(to, self._directions), axis=1)
                turned = np.linalg.norm(np.cross(surface.axis, self._directions), axis=1)
                if not ((apart <= self.near) & (turned <= FLAT_RAD)).any():
                    self._origins = np.r_[self._origins, surface.origin[None]]
                    self._directions = np.r_[self._directions, surface.axis[None]]
        self._seen = len(self.surfaces)
        return self._origins, self._directions

    def _lie_on(self, surface: Fitted, members: Ints, side: int) -> NDArray[np.bool_]:
        """Which triangles lie on the surface: with all corners, and with its normal within half a step?"""
        mesh = self.mesh
        corners = mesh.corners[members]
        on = (np.abs(surface.off(mesh.vertices[corners.ravel()])).reshape(-1, 3) <= self.near).all(axis=1)
        cosine = (surface.directions(mesh.centers[members]) * mesh.normals[members]).sum(axis=1) * side
        share = HALF_STEP if surface.kind in (SurfaceKind.CYLINDER, SurfaceKind.CONE) else DOUBLE_STEP
        turned: NDArray[np.bool_] = cosine >= math.cos(share * MOST_STEP_RAD)
        return on & (turned | self.sliver[members])

    def _grow(self, kind: SurfaceKind, seed: Ints) -> tuple[Ints, Fitted, int] | None:
        """All triangles that go on from the seed on one surface of the kind; None where they are too few."""
        mesh = self.mesh
        surface = self._fit(kind, seed)
        if surface is None:
            return None
        side = 1 if float((surface.directions(mesh.centers[seed[:1]]) * mesh.normals[seed[:1]]).sum()) > 0 else -1
        if not self._lie_on(surface, seed, side).all():
            return None
        inside = self._flags
        members, front, fitted = [seed], seed, len(seed)
        inside[seed] = True
        count = len(seed)
        while len(front):
            beside = mesh.beside[front][self.smooth[front]]
            new = beside[~inside[beside] & (self.owner[beside] < 0)]
            if len(new) > 1:
                new = np.unique(new)
            if len(new):
                new = new[self._lie_on(surface, new, side)]
            inside[new] = True
            members.append(new)
            count += len(new)
            front = new
            if count >= 2 * fitted or (not len(front) and count > fitted):
                better = self._fit(kind, np.concatenate(members))
                if better is None:
                    break
                surface = better
                if not len(front):  # what the first fit was too coarse for
                    front = np.concatenate(members)
                fitted = count
        whole = np.concatenate(members)
        inside[whole] = False
        facets = np.unique(self.facets[whole[~self.sliver[whole]]])
        if len(facets) < LEAST_FACETS[kind]:
            return None
        final = self._fit(kind, whole)
        if final is None or not self._lie_on(final, whole, side).all():
            return None
        if kind is SurfaceKind.CYLINDER and len(facets) <= FEW and not self._even(final, whole):
            return None
        return whole, final, side

    def _even(self, surface: Fitted, members: Ints) -> bool:
        """Are a few facets about equally wide? An even trapezium's corners lie on a circle: two bevels and a top."""
        to = self.mesh.vertices[np.unique(self.mesh.corners[members])] - surface.origin
        first = to[0] - (to[0] @ surface.axis) * surface.axis
        angles = np.sort(np.arctan2(to @ np.cross(surface.axis, first), to @ first))
        gaps = np.diff(angles)
        gaps = gaps[gaps > 10 * self.mesh.noise / surface.radius]
        return float(gaps.max()) <= UNLIKE * float(gaps.min())

    def regions(self) -> Regions:
        """What is left is flat, or freeform where small facets turn by steps."""
        mesh, left = self.mesh, self.owner < 0
        one, other = mesh.pairs
        a, b = one // 3, other // 3
        both = left[a] & left[b]
        a, b, one = a[both], b[both], one[both]
        linked = (self.facets[a] == self.facets[b]) | self._is_step(a, b, one)
        label = components(len(mesh.corners), a[linked], b[linked])
        owner = self.owner.copy()
        ids, owner_of_left = np.unique(label[left], return_inverse=True)
        owner[left] = owner_of_left.reshape(-1) + len(self.surfaces)
        surfaces, outward = list(self.surfaces), list(self.outward)
        order = np.argsort(owner, kind="stable")
        bounds = np.searchsorted(owner[order], np.arange(len(surfaces), len(surfaces) + len(ids) + 1))
        for number in range(len(ids)):
            members = order[bounds[number] : bounds[number + 1]]
            surfaces.append(self._plane(members))
            outward.append(0)
        return Regions(owner, tuple(surfaces), tuple(outward))

    def _is_step(self, a: Ints, b: Ints, side: Ints) -> NDArray[np.bool_]:
        """Are triangles that meet at a side parts of one freeform face: facets about as wide, which turn by a step?

        A facet is as wide as its area over the length of what it shares with the other one.
        """
        mesh, facets = self.mesh, self.facets
        step = (facets[a] != facets[b]) & (mesh.angles.ravel()[side] <= MOST_STEP_RAD)
        low, high = np.minimum(facets[a], facets[b]), np.maximum(facets[a], facets[b])
        area = np.bincount(facets, weights=mesh.areas)
        _, meeting = np.unique(low * np.int64(len(area)) + high, return_inverse=True)
        shared = np.bincount(meeting.reshape(-1), weights=mesh.lengths.ravel()[side])[meeting.reshape(-1)]
        widths = area[low] / shared, area[high] / shared
        like = np.maximum(*widths) <= UNLIKE**2 * np.minimum(*widths)
        found: NDArray[np.bool_] = step & like
        return found

    def _plane(self, members: Ints) -> Fitted | None:
        mesh = self.mesh
        normal = mesh.areas[members] @ mesh.normals[members]
        length = float(np.linalg.norm(normal))
        if length == 0.0:
            return None
        points = mesh.vertices[np.unique(mesh.corners[members])]
        found = fit_plane(points, normal / length)
        return found if np.abs(found.off(points)).max() <= self.near else None
