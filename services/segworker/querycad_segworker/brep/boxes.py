"""Exact axis-aligned boxes, without the kernel's tolerance gap and without its slow general search. Millimetres."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator

from OCP.Bnd import Bnd_Box
from OCP.BndLib import BndLib_Add3dCurve
from OCP.BRepAdaptor import BRepAdaptor_Curve, BRepAdaptor_Surface
from OCP.BRepBndLib import BRepBndLib
from OCP.ElSLib import ElSLib
from OCP.GeomAbs import GeomAbs_Shape, GeomAbs_SurfaceType
from OCP.gp import gp_Pnt, gp_Pnt2d
from OCP.IntTools import IntTools_FClass2d
from OCP.TopAbs import TopAbs_State
from OCP.TopoDS import TopoDS_Face, TopoDS_Shape

from querycad_contracts import SurfaceKind, Vector
from querycad_segworker.vectors import AXES, Box, add, box_of, cross, dot, norm, perpendicular, scale, sub, unit

from .canonical import Circle, Surface, bounds_of, vector

_RULED = (SurfaceKind.PLANE, SurfaceKind.CYLINDER, SurfaceKind.CONE)
_SAMPLES = (12, 40)
"""Fewest and most sample points along a parameter of a freeform face; in between, four to each polynomial piece."""
_HALVINGS = 14
"""Of the sample step around an extreme: its error falls with the square of the step, here below 1e-8 of the size."""


def face_box(face: TopoDS_Face, adaptor: BRepAdaptor_Surface, surface: Surface, edges: Box | None) -> Box:
    """Which box does a face fill, whose edges together fill the box `edges`?

    A linear function on a ruled surface takes its extremes at the ends of rulings, that is on the face's edges; on any
    other surface on its edges or at a point inside where the normal runs along x, y or z.
    """
    if edges is None:
        return exact_box(face)
    kind = adaptor.GetType()
    if surface.kind in _RULED or kind == GeomAbs_SurfaceType.GeomAbs_SurfaceOfExtrusion:
        return edges
    if max(map(abs, bounds_of(adaptor))) > 1e50:
        return exact_box(face)
    inside = _Inside(face, adaptor)
    if kind == GeomAbs_SurfaceType.GeomAbs_Torus:
        torus = adaptor.Torus()
        found = [p for p in _torus_extremes(surface, adaptor) if inside(*ElSLib.Parameters_s(torus, gp_Pnt(*p)))]
    elif kind == GeomAbs_SurfaceType.GeomAbs_Sphere:
        sphere = adaptor.Sphere()
        ends = [add(surface.origin, scale(e, r)) for e in AXES for r in (surface.radius, -surface.radius)]
        found = [p for p in ends if _outside(p, edges) and inside(*ElSLib.Parameters_s(sphere, gp_Pnt(*p)))]
    else:
        found = list(_freeform_extremes(adaptor, edges, inside))
    box = box_of([*edges, *found])
    assert box is not None
    return box


def arc_box(circle: Circle, points: tuple[Vector, Vector, Vector], length: float) -> Box:
    """Which box does an arc fill? Its ends and, where the arc passes them, the circle's extreme points along x, y, z.

    The arc runs from `points[0]` by the angle length / radius, to that side on which `points[1]`, its middle, lies.
    """
    span = length / circle.radius
    x = unit(sub(points[0], circle.center))
    y = cross(circle.axis, x)
    to_middle = sub(points[1], circle.center)
    expected = add(scale(x, math.cos(span / 2)), scale(y, math.sin(span / 2)))
    mirrored = add(scale(x, math.cos(span / 2)), scale(y, -math.sin(span / 2)))
    if dot(to_middle, mirrored) > dot(to_middle, expected):
        y = scale(y, -1.0)
    candidates = list(points)
    for i in range(3):
        extreme = math.atan2(y[i], x[i])
        for turn in (extreme % (2 * math.pi), (extreme + math.pi) % (2 * math.pi)):
            if turn <= span:
                offset = add(scale(x, math.cos(turn)), scale(y, math.sin(turn)))
                candidates.append(add(circle.center, scale(offset, circle.radius)))
    box = box_of(candidates)
    assert box is not None
    return box


def curve_box(adaptor: BRepAdaptor_Curve) -> Box:
    """Which box does a curve fill?"""
    box = Bnd_Box()
    BndLib_Add3dCurve.AddOptimal_s(adaptor, 0.0, box)
    return _corners(box)


def exact_box(shape: TopoDS_Shape) -> Box:
    """Which box holds the shape, by the kernel's own search? Slow: some ten milliseconds a curved face."""
    box = Bnd_Box()
    BRepBndLib.AddOptimal_s(shape, box, False, False)
    return _corners(box)


def rough_box(shape: TopoDS_Shape) -> Box:
    """Which box surely holds the shape? Quick, and up to some per cent too large."""
    box = Bnd_Box()
    BRepBndLib.Add_s(shape, box, False)
    return _corners(box)


def _corners(box: Bnd_Box) -> Box:
    if box.IsVoid():
        return (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
    box.SetGap(0.0)
    return vector(box.CornerMin()), vector(box.CornerMax())


class _Inside:
    """Does a point of the surface, by its parameters, lie on the face? The costly test comes after the cheap one."""

    def __init__(self, face: TopoDS_Face, adaptor: BRepAdaptor_Surface) -> None:
        self._face = face
        self._bounds = bounds_of(adaptor)
        self._period = (
            adaptor.UPeriod() if adaptor.IsUPeriodic() else 0.0,
            adaptor.VPeriod() if adaptor.IsVPeriodic() else 0.0,
        )
        self._classifier: IntTools_FClass2d | None = None

    def __call__(self, u: float, v: float) -> bool:
        u0, u1, v0, v1 = self._bounds
        for value, low, high, period in ((u, u0, u1, self._period[0]), (v, v0, v1, self._period[1])):
            beyond = (value - low) % period if period else value - low
            if not 0.0 <= beyond <= high - low:
                return False
        if self._classifier is None:
            self._classifier = IntTools_FClass2d(self._face, 1e-9)
        return bool(self._classifier.Perform(gp_Pnt2d(u, v), True) != TopAbs_State.TopAbs_OUT)


def _outside(point: Vector, box: Box) -> bool:
    return any(not low <= p <= high for p, low, high in zip(point, *box, strict=True))


def _torus_extremes(torus: Surface, adaptor: BRepAdaptor_Surface) -> Iterator[Vector]:
    """The points where the normal runs along x, y or z.

    Where that is a whole circle about the axis, its point at the middle of the face is enough: a circle that leaves the
    face does so through its edges.
    """
    u0, u1, v0, v1 = bounds_of(adaptor)
    middle = sub(vector(adaptor.Value((u0 + u1) / 2, (v0 + v1) / 2)), torus.origin)
    for e in AXES:
        across = sub(e, scale(torus.axis, dot(e, torus.axis)))
        if norm(across) < 1e-9:
            across = sub(middle, scale(torus.axis, dot(middle, torus.axis)))
        radial = unit(across) if norm(across) > 0 else perpendicular(torus.axis)
        for r in (torus.radius, -torus.radius):
            tube = add(torus.origin, scale(radial, r))
            yield add(tube, scale(e, torus.minor_radius))
            yield add(tube, scale(e, -torus.minor_radius))


def _freeform_extremes(
    adaptor: BRepAdaptor_Surface, edges: Box, inside: Callable[[float, float], bool]
) -> Iterator[Vector]:
    """The extreme points inside a face beyond the box of its edges: the best sample point, moved while that helps."""
    u0, u1, v0, v1 = bounds_of(adaptor)
    columns = min(max(4 * adaptor.NbUIntervals(GeomAbs_Shape.GeomAbs_C2), _SAMPLES[0]), _SAMPLES[1])
    rows = min(max(4 * adaptor.NbVIntervals(GeomAbs_Shape.GeomAbs_C2), _SAMPLES[0]), _SAMPLES[1])
    step_u, step_v = (u1 - u0) / columns, (v1 - v0) / rows
    samples = [
        (u, v, vector(adaptor.Value(u, v)))
        for u in (u0 + (i + 0.5) * step_u for i in range(columns))
        for v in (v0 + (j + 0.5) * step_v for j in range(rows))
    ]
    for axis in range(3):
        for sign, limit in ((-1.0, edges[0][axis]), (1.0, edges[1][axis])):
            # A sample that lies a little inside the box may still have its extreme outside: hence no strict cut.
            slack = 0.02 * (edges[1][axis] - edges[0][axis])
            beyond = [s for s in samples if sign * (s[2][axis] - limit) > -slack]
            beyond.sort(key=lambda s: sign * s[2][axis], reverse=True)
            start = next((s for s in beyond if inside(s[0], s[1])), None)
            if start is not None:
                yield _climb(adaptor, axis, sign, start, (step_u, step_v), inside)


def _climb(
    adaptor: BRepAdaptor_Surface,
    axis: int,
    sign: float,
    start: tuple[float, float, Vector],
    steps: tuple[float, float],
    inside: Callable[[float, float], bool],
) -> Vector:
    """Pattern search: to the better of the four neighbours, or half the step."""
    u, v, best = start
    du, dv = steps[0] / 2, steps[1] / 2
    halved = 0
    while halved < _HALVINGS:
        for a, b in ((u + du, v), (u - du, v), (u, v + dv), (u, v - dv)):
            point = vector(adaptor.Value(a, b))
            if sign * (point[axis] - best[axis]) > 0 and inside(a, b):
                u, v, best = a, b, point
                break
        else:
            du, dv, halved = du / 2, dv / 2, halved + 1
    return best
