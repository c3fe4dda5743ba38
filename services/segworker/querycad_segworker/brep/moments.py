"""Centroids and second moments of faces and of what they enclose, by the kernel's integration. Millimetres."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from OCP.BRepGProp import BRepGProp, BRepGProp_Domain, BRepGProp_Face, BRepGProp_Vinert
from OCP.gp import gp_Pnt, gp_Trsf
from OCP.GProp import GProp_GProps
from OCP.TopoDS import TopoDS_Face, TopoDS_Shape

from querycad_contracts import Vector
from querycad_segworker.topology import Moments
from querycad_segworker.vectors import add, dot

from .canonical import vector

INTEGRATION_ERROR = 1e-4
"""Relative error asked of the kernel's adaptive integration of areas and volumes; bolts come out right to 1e-6.

Its plain integration is up to 1 % wrong on B-spline cylinders, 1e-3 is up to 0.5 % wrong on bolts, and at 1e-6 it does
not finish on some freeform faces. On planes, cylinders, cones, spheres and tori between lines and circles the plain one
is right to 1e-7 (2,000 faces of real models), and takes a half to a fifth of the time.
"""


def of_surface(shape: TopoDS_Shape, *, adaptive: bool = True) -> Moments:
    """Of the area of a face."""
    properties = GProp_GProps()
    BRepGProp.SurfaceProperties_s(shape, properties, *([INTEGRATION_ERROR] if adaptive else []))
    return _moments(properties)


def of_volume(shape: TopoDS_Shape) -> Moments:
    """Of what oriented faces enclose, by the divergence theorem; the amount is negative where they point inwards.

    Not by the kernel's Gauss-Kronrod integration: it is quicker and finer, but does not end on ill-formed faces.
    """
    properties = GProp_GProps()
    BRepGProp.VolumeProperties_s(shape, properties, INTEGRATION_ERROR)
    return _moments(properties)


def under_face(face: TopoDS_Face, apex: Vector, *, adaptive: bool) -> Moments:
    """Of the cone between a face and `apex`: the cones of all faces of a solid add up to it (`topology.together`).

    Negative where the face looks towards the apex.
    """
    error = [INTEGRATION_ERROR] if adaptive else []
    return _moments(BRepGProp_Vinert(BRepGProp_Face(face), BRepGProp_Domain(face), gp_Pnt(*apex), *error))


def under_plane(base: Moments, normal: Vector, apex: Vector) -> Moments:
    """As `under_face`, of a plane face whose own moments and outward normal are known.

    The height h is the same all over the face, so the divergence theorem leaves integrals over the face alone: h/3 of
    1, h/4 of x, h/5 of x y, with x, y from the apex.
    """
    arm = np.subtract(base.center, apex)
    height = float(arm @ normal)
    amount = height / 3 * base.amount
    outer, own, one = np.outer(arm, arm), np.array(base.inertia), np.eye(3)
    of_base = own.trace() / 2 * one - own + base.amount * outer  # second moments about the apex
    spread = height / 5 * of_base - amount * 9 / 16 * outer  # about the cone's centre, which lies at 3/4 of the way
    x, y, z = map(_vector, (spread.trace() * one - spread).tolist())
    return Moments(amount, _vector((np.array(apex) + 0.75 * arm).tolist()), (x, y, z))


def placed(moments: Moments, place: gp_Trsf) -> Moments:
    """The same of the shape once it is moved, turned or mirrored."""
    linear = place.VectorialPart()
    turn: list[Vector] = [(linear.Value(i, 1), linear.Value(i, 2), linear.Value(i, 3)) for i in (1, 2, 3)]
    half = [_times(turn, column) for column in zip(*moments.inertia, strict=True)]  # columns of turn x inertia
    x, y, z = (_times(turn, row) for row in zip(*half, strict=True))
    center = add(vector(place.TranslationPart()), _times(turn, moments.center))
    return Moments(moments.amount, center, (x, y, z))


def _times(rows: Sequence[Vector], column: Vector) -> Vector:
    x, y, z = (dot(row, column) for row in rows)
    return (x, y, z)


def _moments(properties: GProp_GProps) -> Moments:
    """The kernel gives the inertia about the centre; of a negative amount it is negative, too."""
    about = properties.MatrixOfInertia()
    x, y, z = (_vector(about.Value(i, j) for j in (1, 2, 3)) for i in (1, 2, 3))
    return Moments(float(properties.Mass()), vector(properties.CentreOfMass()), (x, y, z))


def _vector(coordinates: Iterable[float]) -> Vector:
    x, y, z = coordinates
    return (x, y, z)
