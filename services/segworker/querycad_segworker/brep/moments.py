"""Where the weight of a face or of what faces enclose lies, by the kernel's integration. Millimetres."""

from __future__ import annotations

from collections.abc import Sequence

from OCP.BRepGProp import BRepGProp
from OCP.gp import gp_Trsf
from OCP.GProp import GProp_GProps
from OCP.TopoDS import TopoDS_Shape

from querycad_contracts import Matrix, Vector
from querycad_segworker.topology import Moments
from querycad_segworker.vectors import add, dot

from .canonical import vector

INTEGRATION_ERROR = 1e-4
"""Relative error asked of the kernel's adaptive integration of areas and volumes; bolts come out right to 1e-6.

Its plain integration is up to 1 % wrong on B-spline cylinders, 1e-3 is up to 0.5 % wrong on bolts, and at 1e-6 it does
not finish on some freeform faces.
"""


def of_surface(shape: TopoDS_Shape) -> Moments:
    """Of the area of a face."""
    properties = GProp_GProps()
    BRepGProp.SurfaceProperties_s(shape, properties, INTEGRATION_ERROR)
    return _moments(properties)


def of_volume(shape: TopoDS_Shape) -> Moments:
    """Of what oriented faces enclose, by the divergence theorem; the amount is negative where they point inwards.

    Not by the kernel's Gauss-Kronrod integration: it is quicker and finer, but does not end on ill-formed faces.
    """
    properties = GProp_GProps()
    BRepGProp.VolumeProperties_s(shape, properties, INTEGRATION_ERROR)
    return _moments(properties)


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
    """The kernel gives the inertia about the centre."""
    amount, about = float(properties.Mass()), properties.MatrixOfInertia()
    sign = -1.0 if amount < 0 else 1.0
    rows: list[tuple[float, float, float]] = [
        (sign * about.Value(i, 1), sign * about.Value(i, 2), sign * about.Value(i, 3)) for i in (1, 2, 3)
    ]
    inertia: Matrix = (rows[0], rows[1], rows[2])
    return Moments(amount, vector(properties.CentreOfMass()), inertia)
