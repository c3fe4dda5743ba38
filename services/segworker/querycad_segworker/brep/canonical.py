"""Which plain surface or curve is it really? Converted files store cylinders as B-splines or surfaces of revolution."""

from __future__ import annotations

import math
from dataclasses import dataclass

from OCP.BRep import BRep_Tool
from OCP.BRepAdaptor import BRepAdaptor_Curve, BRepAdaptor_Surface
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace
from OCP.Geom import Geom_RectangularTrimmedSurface
from OCP.GeomAbs import GeomAbs_CurveType, GeomAbs_SurfaceType
from OCP.gp import gp_Cone, gp_Cylinder, gp_Dir, gp_Pln, gp_Pnt, gp_Sphere, gp_Vec
from OCP.ShapeAnalysis import ShapeAnalysis_CanonicalRecognition
from OCP.TopoDS import TopoDS_Face

from querycad_contracts import SurfaceKind, Vector
from querycad_segworker.vectors import ORIGIN, add, cross, dist, dot, line_distance, norm, scale, sub, unit


@dataclass(frozen=True, slots=True)
class Surface:
    """A canonical surface in kernel units (millimetres); fields as in `topology.FaceRecord`."""

    kind: SurfaceKind
    origin: Vector = ORIGIN
    axis: Vector = ORIGIN
    radius: float = 0.0
    minor_radius: float = 0.0
    half_angle: float = 0.0

    def direction_at(self, point: Vector) -> Vector:
        """Which unit vector leaves the surface at `point`, away from axis or centre; for a plane, along its axis?"""
        if self.kind is SurfaceKind.PLANE:
            return self.axis
        to_point = sub(point, self.origin)
        if self.kind is SurfaceKind.SPHERE:
            return unit(to_point)
        along = dot(to_point, self.axis)
        radial = unit(sub(to_point, scale(self.axis, along)))
        if self.kind is SurfaceKind.CYLINDER:
            return radial
        if self.kind is SurfaceKind.CONE:
            return unit(sub(scale(radial, math.cos(self.half_angle)), scale(self.axis, math.sin(self.half_angle))))
        return unit(sub(point, add(self.origin, scale(radial, self.radius))))


@dataclass(frozen=True, slots=True)
class Circle:
    """A circle or arc of one, in kernel units."""

    center: Vector
    axis: Vector
    radius: float


def vector(v: gp_Pnt | gp_Dir | gp_Vec) -> Vector:
    """What are the three coordinates?"""
    return v.Coord()  # type: ignore[no-any-return]  # one call into the kernel, not three


def bounds_of(adaptor: BRepAdaptor_Surface) -> tuple[float, float, float, float]:
    """From where to where do the parameters u, then v, of a surface go?"""
    u, v = (adaptor.FirstUParameter(), adaptor.LastUParameter()), (adaptor.FirstVParameter(), adaptor.LastVParameter())
    return (*u, *v)


def canonical_surface(face: TopoDS_Face, adaptor: BRepAdaptor_Surface, tolerance_mm: float) -> Surface:
    """Which canonical surface carries the face? A freeform one within `tolerance_mm` of a canonical one is that one."""
    kind = adaptor.GetType()
    if kind == GeomAbs_SurfaceType.GeomAbs_Plane:
        return _plane(adaptor.Plane())
    if kind == GeomAbs_SurfaceType.GeomAbs_Cylinder:
        return _cylinder(adaptor.Cylinder())
    if kind == GeomAbs_SurfaceType.GeomAbs_Cone:
        return _cone(adaptor.Cone(), adaptor)
    if kind == GeomAbs_SurfaceType.GeomAbs_Sphere:
        return _sphere(adaptor.Sphere())
    if kind == GeomAbs_SurfaceType.GeomAbs_Torus:
        torus = adaptor.Torus()
        place = torus.Axis()
        return Surface(
            SurfaceKind.TORUS,
            vector(place.Location()),
            vector(place.Direction()),
            torus.MajorRadius(),
            torus.MinorRadius(),
        )
    return _recognise(face, adaptor, tolerance_mm) or _fit_torus(adaptor, tolerance_mm) or Surface(SurfaceKind.FREEFORM)


def canonical_circle(adaptor: BRepAdaptor_Curve, tolerance_mm: float) -> Circle | None:
    """Is the edge a circle or an arc of one? Freeform curves are tested on sample points."""
    kind = adaptor.GetType()
    if kind == GeomAbs_CurveType.GeomAbs_Circle:
        circle = adaptor.Circle()
        return Circle(vector(circle.Location()), vector(circle.Axis().Direction()), circle.Radius())
    if kind in (GeomAbs_CurveType.GeomAbs_Line, GeomAbs_CurveType.GeomAbs_Ellipse):
        return None
    first, last = adaptor.FirstParameter(), adaptor.LastParameter()
    points = [vector(adaptor.Value(first + (last - first) * i / 8)) for i in range(9)]
    return _circle_through(points, tolerance_mm)


def is_straight(adaptor: BRepAdaptor_Curve, tolerance_mm: float) -> bool:
    """Does the curve run straight from its start to its end?"""
    if adaptor.GetType() == GeomAbs_CurveType.GeomAbs_Line:
        return True
    first, last = adaptor.FirstParameter(), adaptor.LastParameter()
    points = [vector(adaptor.Value(first + (last - first) * i / 8)) for i in range(9)]
    chord = unit(sub(points[-1], points[0]))
    return chord != ORIGIN and all(line_distance(p, points[0], chord) <= tolerance_mm for p in points)


def _plane(plane: gp_Pln) -> Surface:
    return Surface(SurfaceKind.PLANE, vector(plane.Location()), vector(plane.Axis().Direction()))


def _cylinder(cylinder: gp_Cylinder) -> Surface:
    axis = cylinder.Axis()
    return Surface(SurfaceKind.CYLINDER, vector(axis.Location()), vector(axis.Direction()), cylinder.Radius())


def _cone(cone: gp_Cone, adaptor: BRepAdaptor_Surface) -> Surface:
    """The axis points from the apex towards the face: the kernel's own cones go on beyond their apex."""
    apex, direction = vector(cone.Apex()), vector(cone.Axis().Direction())
    u0, u1, v0, v1 = bounds_of(adaptor)
    if dot(sub(vector(adaptor.Value((u0 + u1) / 2, (v0 + v1) / 2)), apex), direction) < 0:
        direction = scale(direction, -1.0)
    return Surface(SurfaceKind.CONE, apex, direction, half_angle=abs(cone.SemiAngle()))


def _sphere(sphere: gp_Sphere) -> Surface:
    return Surface(SurfaceKind.SPHERE, vector(sphere.Location()), ORIGIN, sphere.Radius())


def _recognise(face: TopoDS_Face, adaptor: BRepAdaptor_Surface, tolerance_mm: float) -> Surface | None:
    """The kernel's own recognition; its answers are checked for sense, since it also fits huge radii to near planes."""
    plane, cylinder, cone, sphere = gp_Pln(), gp_Cylinder(), gp_Cone(), gp_Sphere()
    try:
        recogniser = ShapeAnalysis_CanonicalRecognition(_untrimmed(face, adaptor))
        if recogniser.IsPlane(tolerance_mm, plane):
            return _plane(plane)
        if recogniser.IsCylinder(tolerance_mm, cylinder):
            return _cylinder(cylinder)
        if recogniser.IsCone(tolerance_mm, cone) and abs(cone.SemiAngle()) > 1e-4:
            return _cone(cone, adaptor)
        if recogniser.IsSphere(tolerance_mm, sphere):
            return _sphere(sphere)
    except Exception:  # the kernel raises any of its own for surfaces that it cannot take apart
        return None
    return None


def _untrimmed(face: TopoDS_Face, adaptor: BRepAdaptor_Surface) -> TopoDS_Face:
    """The face over the surface that a trimmed one is cut from: the recognition raises on trimmed ones."""
    surface = BRep_Tool.Surface_s(face)
    if not isinstance(surface, Geom_RectangularTrimmedSurface):
        return face
    return BRepBuilderAPI_MakeFace(surface.BasisSurface(), *bounds_of(adaptor), 1e-7).Face()


def _fit_torus(adaptor: BRepAdaptor_Surface, tolerance_mm: float) -> Surface | None:
    """A torus from its two families of circles, as the kernel's own recognition knows none.

    One parameter runs along circles about a common axis, the other along circles of one radius, the tube.
    """
    u0, u1, v0, v1 = bounds_of(adaptor)
    if max(map(abs, (u0, u1, v0, v1))) > 1e50:
        return None
    rows = [[vector(adaptor.Value(u0 + (u1 - u0) * i / 6, v0 + (v1 - v0) * j / 6)) for j in range(7)] for i in range(7)]
    for grid in (rows, [list(column) for column in zip(*rows, strict=True)]):
        around, tube = _circle_through(grid[1], tolerance_mm), _circle_through([row[3] for row in grid], tolerance_mm)
        if around is None or tube is None:
            continue
        along = dot(sub(tube.center, around.center), around.axis)
        center = add(around.center, scale(around.axis, along))
        surface = Surface(SurfaceKind.TORUS, center, around.axis, dist(tube.center, center), tube.radius)
        if tube.radius < 1e3 * max(dist(rows[0][0], p) for row in grid for p in row) and all(
            abs(_torus_distance(surface, p)) <= tolerance_mm for row in grid for p in row
        ):
            return surface
    return None


def _torus_distance(torus: Surface, point: Vector) -> float:
    to_point = sub(point, torus.origin)
    along = dot(to_point, torus.axis)
    radial = norm(sub(to_point, scale(torus.axis, along)))
    return math.hypot(radial - torus.radius, along) - torus.minor_radius


def _circle_through(points: list[Vector], tolerance_mm: float) -> Circle | None:
    """The circle through the first, a middle and a late point, if all points lie on it. Formula: circumcentre."""
    a, b, c = points[0], points[len(points) // 3], points[2 * len(points) // 3]
    ab, ac = sub(b, a), sub(c, a)
    normal = cross(ab, ac)
    area2 = dot(normal, normal)
    if area2 <= (1e-6 * dot(ab, ab)) ** 2 or dot(ab, ab) <= tolerance_mm**2:
        return None
    to_center = scale(add(scale(cross(normal, ab), dot(ac, ac)), scale(cross(ac, normal), dot(ab, ab))), 0.5 / area2)
    center, radius, axis = add(a, to_center), norm(to_center), unit(normal)
    chord = max(dist(a, p) for p in points)
    if radius > 100 * chord:
        return None
    for p in points:
        offset = sub(p, center)
        if abs(norm(offset) - radius) > tolerance_mm or abs(dot(offset, axis)) > tolerance_mm:
            return None
    return Circle(center, axis, radius)
