"""Face by face from the kernel: canonical surface, loops, edges with convexity, exact boxes."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from OCP.BRep import BRep_Tool
from OCP.BRepAdaptor import BRepAdaptor_Curve, BRepAdaptor_Surface
from OCP.BRepTools import BRepTools
from OCP.collections import IndexedMap_TopoDS_Shape_TopTools_ShapeMapHasher as ShapeMap
from OCP.GCPnts import GCPnts_AbscissaPoint
from OCP.GeomAbs import GeomAbs_SurfaceType
from OCP.gp import gp_Pnt, gp_Vec
from OCP.TopAbs import TopAbs_Orientation, TopAbs_ShapeEnum
from OCP.TopExp import TopExp_Explorer
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS, TopoDS_Edge, TopoDS_Face, TopoDS_Wire

from querycad_contracts import SurfaceKind, Vector
from querycad_segworker.tolerances import Tolerances
from querycad_segworker.topology import (
    BodyRecord,
    Brep,
    EdgeConvexity,
    EdgeKind,
    EdgeRecord,
    FaceRecord,
    Loop,
    Moments,
    linked,
)
from querycad_segworker.vectors import (
    Box,
    across,
    angle_covered,
    box_of,
    box_union,
    cross,
    dist,
    dot,
    norm,
    scale,
    sub,
    unit,
    wrapped,
)

from .boxes import arc_box, curve_box, face_box
from .canonical import Circle, Surface, canonical_circle, canonical_surface, is_straight, vector
from .moments import of_surface, placed

METRES_PER_MM = 1e-3
"""The one conversion between the kernel's millimetres and the metres of everything else."""

ONCE_AROUND = math.radians(120.0)
"""A closed edge whose middle lies further than this around an axis from its start goes around the axis."""

BETWEEN = (0.125, 0.25, 0.375, 0.625, 0.75, 0.875)
"""Shares of the way along a curve where more points of it are taken; those of a whole ellipse include its corners."""

_REVERSED = TopAbs_Orientation.TopAbs_REVERSED


@dataclass(slots=True)
class _EdgeUse:
    """One face's use of an edge: its outward normal there, and which way its own surface lies."""

    face: int
    normal: Vector
    into_face: Vector


@dataclass(frozen=True, slots=True)
class _Face:
    """What the edges of a face are measured by. `flip`: -1 where it looks against its surface's natural normal."""

    index: int
    adaptor: BRepAdaptor_Surface
    surface: Surface
    outward: int
    flip: float


@dataclass(slots=True)
class _EdgeData:
    kind: EdgeKind
    points: tuple[Vector, Vector, Vector]
    length: float
    circle: Circle | None
    box: Box
    uses: list[_EdgeUse]
    tangent: Vector
    between: tuple[Vector, ...] = ()


class FaceTable:
    """All faces of a shape, measured in millimetres; every edge is visited once."""

    def __init__(self, faces: Sequence[TopoDS_Face], tolerances_mm: Tolerances) -> None:
        self.kernel_faces = list(faces)
        self.tolerances = tolerances_mm
        self.edge_map = ShapeMap()
        self.edges: list[_EdgeData] = []
        self.seams: set[int] = set()
        self.surfaces: list[Surface] = []
        self.records: list[FaceRecord] = []
        self._unplaced = ShapeMap()
        self._areas: list[Moments] = []
        self.regular: set[int] = set()
        """Planes and quadrics between lines and circles, which the plain integration suits (`moments`)."""
        for index, face in enumerate(self.kernel_faces):
            self._face(index, face)

    def _face(self, index: int, face: TopoDS_Face) -> None:
        adaptor = BRepAdaptor_Surface(face, True)
        surface = canonical_surface(face, adaptor, self.tolerances.canonical)
        u = _finite_middle(adaptor.FirstUParameter(), adaptor.LastUParameter())
        v = _finite_middle(adaptor.FirstVParameter(), adaptor.LastVParameter())
        point, natural = _natural_normal(adaptor, u, v)
        flip = -1.0 if face.Orientation() == _REVERSED else 1.0
        outward_normal = scale(natural, flip)
        outward = 0
        if surface.kind is SurfaceKind.PLANE:
            if dot(surface.axis, outward_normal) < 0:
                surface = replace(surface, axis=scale(surface.axis, -1.0))
        elif surface.kind is not SurfaceKind.FREEFORM:
            outward = 1 if dot(surface.direction_at(point), outward_normal) > 0 else -1
        self.surfaces.append(surface)
        loops = self._loops(face, _Face(index, adaptor, surface, outward, flip))
        edges_box = box_union(self.edges[e].box for loop in loops for e in loop.edges)
        small, large = self._radii(surface, loops)
        bounds = (self.edges[e].kind for loop in loops for e in loop.edges)
        if adaptor.GetType() in _NATIVE_TYPES and EdgeKind.OTHER not in bounds:
            self.regular.add(index)
        moments = self._moments(face, adaptive=index not in self.regular)
        self.records.append(
            FaceRecord(
                id=index,
                body=0,
                kind=surface.kind,
                origin=surface.origin,
                axis=surface.axis,
                area=moments.amount,
                box=face_box(face, adaptor, surface, edges_box),
                loops=loops,
                radius=large,
                minor_radius=small,
                half_angle=surface.half_angle,
                outward=outward,
                sweep=self._sweep(surface, adaptor, loops, point) if outward else 0.0,
                point=point,
                point_normal=outward_normal,
                moments=moments,
            )
        )

    def _moments(self, face: TopoDS_Face, adaptive: bool) -> Moments:
        """Of its area, mm2. Instances of one product share their faces but for the place: each is integrated once."""
        place = face.Location()
        position = int(self._unplaced.Add(face.Located(TopLoc_Location())))
        if position > len(self._areas):
            self._areas.append(of_surface(face.Located(TopLoc_Location()), adaptive=adaptive).positive())
        known = self._areas[position - 1]
        return known if place.IsIdentity() else placed(known, place.Transformation())

    def _loops(self, face: TopoDS_Face, own: _Face) -> tuple[Loop, ...]:
        """The face's wires, outer first. The face is explored as FORWARD, where material lies left of each edge."""
        forward = TopoDS.Face(face.Oriented(TopAbs_Orientation.TopAbs_FORWARD))
        outer = BRepTools.OuterWire_s(forward)
        loops = []
        wires = TopExp_Explorer(forward, TopAbs_ShapeEnum.TopAbs_WIRE)
        while wires.More():
            wire = TopoDS.Wire(wires.Current())
            ids = self._wire(forward, wire, own)
            if ids:
                loops.append(Loop(ids, wire.IsSame(outer)))
            wires.Next()
        return tuple(sorted(loops, key=lambda loop: not loop.outer))

    def _wire(self, forward: TopoDS_Face, wire: TopoDS_Wire, own: _Face) -> tuple[int, ...]:
        ids: list[int] = []
        explorer = TopExp_Explorer(wire, TopAbs_ShapeEnum.TopAbs_EDGE)
        while explorer.More():
            edge = TopoDS.Edge(explorer.Current())
            explorer.Next()
            if BRep_Tool.Degenerated_s(edge):
                continue
            edge_id = self._edge(edge)
            if edge_id is None:
                continue
            data = self.edges[edge_id]
            if any(use.face == own.index for use in data.uses):
                self.seams.add(edge_id)
                continue
            ids.append(edge_id)
            normal = _normal_at(edge, forward, own, data.points[1])
            tangent = scale(data.tangent, -1.0 if edge.Orientation() == _REVERSED else 1.0)
            into = unit(cross(scale(normal, own.flip), tangent))
            data.uses.append(_EdgeUse(own.index, normal, into))
        return tuple(ids)

    def _edge(self, edge: TopoDS_Edge) -> int | None:
        """The id of a kernel edge, measured when first met; None for an edge without a curve in space."""
        position = self.edge_map.FindIndex(edge)
        if position:
            return int(position) - 1
        adaptor = BRepAdaptor_Curve()
        try:
            adaptor.Initialize(edge)
            first, last = adaptor.FirstParameter(), adaptor.LastParameter()
            if not math.isfinite(first) or not math.isfinite(last) or max(abs(first), abs(last)) > 1e50:
                return None
            data = self._measure(adaptor, first, last)
        except Exception:
            return None
        self.edge_map.Add(edge)
        self.edges.append(data)
        return len(self.edges) - 1

    def _measure(self, adaptor: BRepAdaptor_Curve, first: float, last: float) -> _EdgeData:
        middle, tangent = gp_Pnt(), gp_Vec()
        adaptor.D1((first + last) / 2, middle, tangent)
        points = (vector(adaptor.Value(first)), vector(middle), vector(adaptor.Value(last)))
        tolerance = self.tolerances.canonical
        straight = is_straight(adaptor, tolerance)
        circle = None if straight else canonical_circle(adaptor, tolerance)
        if straight:
            kind, length = EdgeKind.LINE, dist(points[0], points[2])
            box = box_of(points)
        else:
            kind = EdgeKind.CIRCLE if circle else EdgeKind.OTHER
            length = float(GCPnts_AbscissaPoint.Length_s(adaptor))
            box = arc_box(circle, points, length) if circle else curve_box(adaptor)
        assert box is not None
        free = BETWEEN if kind is EdgeKind.OTHER else ()
        between = tuple(vector(adaptor.Value(first + share * (last - first))) for share in free)
        return _EdgeData(kind, points, length, circle, box, [], unit(vector(tangent)), between)

    def _radii(self, surface: Surface, loops: Sequence[Loop]) -> tuple[float, float]:
        """(minor, main) radius; a cone's come from how far its edges reach along the axis."""
        if surface.kind is not SurfaceKind.CONE:
            return surface.minor_radius, surface.radius
        slope = math.tan(surface.half_angle)
        reach = [
            abs(dot(sub(p, surface.origin), surface.axis)) * slope
            for loop in loops
            for e in loop.edges
            for p in self.edges[e].points
        ]
        if not reach:
            return 0.0, 0.0
        return (min(reach) if len(loops) > 1 or len(reach) > 3 else 0.0), max(reach)

    def _sweep(self, surface: Surface, adaptor: BRepAdaptor_Surface, loops: Sequence[Loop], point: Vector) -> float:
        """The angle around the axis: a native surface's parameter range, else what the edges go around together."""
        if adaptor.GetType() in _NATIVE_TYPES:
            return min(float(adaptor.LastUParameter() - adaptor.FirstUParameter()), 2 * math.pi)
        edges = [self.edges[e] for loop in loops for e in loop.edges]
        if surface.kind is SurfaceKind.SPHERE or any(_is_ring(e, surface, self.tolerances.length) for e in edges):
            return 2 * math.pi
        x, y = across(surface.axis)

        def angle(p: Vector) -> float:
            return math.atan2(dot(sub(p, surface.origin), y), dot(sub(p, surface.origin), x))

        ranges = [(angle(point), angle(point))]
        for edge in edges:
            start, middle, end = (angle(p) for p in edge.points)
            first, second = wrapped(middle - start), wrapped(end - middle)
            closed = dist(edge.points[0], edge.points[2]) <= self.tolerances.length
            if closed and abs(first) > ONCE_AROUND:
                return 2 * math.pi
            ranges += [(start + min(first, 0.0), start + max(first, 0.0))]
            ranges += [(middle + min(second, 0.0), middle + max(second, 0.0))]
        return angle_covered(ranges)

    def turn(self, ids: Sequence[int]) -> None:
        """Turns the outward side of faces, for a body that the file stores inside out."""
        for i in ids:
            r = self.records[i]
            axis = scale(r.axis, -1.0) if r.kind is SurfaceKind.PLANE else r.axis
            self.records[i] = replace(r, axis=axis, outward=-r.outward, point_normal=scale(r.point_normal, -1.0))
        turned = set(ids)
        for e in self._edges_of(ids):
            for use in self.edges[e].uses:
                if use.face in turned:
                    use.normal = scale(use.normal, -1.0)

    def _edges_of(self, ids: Sequence[int]) -> set[int]:
        return {e for i in ids for loop in self.records[i].loops for e in loop.edges}

    def connected(self, ids: Sequence[int]) -> list[list[int]]:
        """Which of these faces hang together by shared edges? Groups in order of their lowest id."""
        own = set(ids)
        uses = ([use.face for use in data.uses if use.face in own] for data in self.edges)
        return linked(own, (pair for faces in uses for pair in pairwise(faces)))

    def is_closed(self, ids: Sequence[int]) -> bool:
        """Do these faces leave no free edge?"""
        return all(len(self.edges[e].uses) > 1 or e in self.seams for e in self._edges_of(ids))

    def brep(self, name: str, bodies: Sequence[BodyRecord], warnings: Sequence[str]) -> Brep:
        """The finished B-rep in metres."""
        body_of = {face: body.id for body in bodies for face in body.faces}
        s = METRES_PER_MM
        faces = tuple(
            replace(
                r,
                body=body_of.get(r.id, 0),
                origin=scale(r.origin, s),
                area=r.area * s * s,
                box=(scale(r.box[0], s), scale(r.box[1], s)),
                radius=r.radius * s,
                minor_radius=r.minor_radius * s,
                point=scale(r.point, s),
                moments=r.moments.in_metres(s, 2),
            )
            for r in self.records
        )
        edges = tuple(self._edge_record(i, data) for i, data in enumerate(self.edges))
        return Brep(name, faces, edges, tuple(bodies), tuple(warnings))

    def _edge_record(self, index: int, data: _EdgeData) -> EdgeRecord:
        convexity, angle = self._convexity(index, data)
        s = METRES_PER_MM
        start, middle, end = (scale(p, s) for p in data.points)
        circle = data.circle
        return EdgeRecord(
            id=index,
            kind=data.kind,
            start=start,
            end=end,
            mid=middle,
            length=data.length * s,
            faces=tuple(use.face for use in data.uses),
            convexity=convexity,
            angle=angle,
            center=scale(circle.center, s) if circle else None,
            axis=circle.axis if circle else None,
            radius=circle.radius * s if circle else None,
            closed=dist(data.points[0], data.points[2]) <= self.tolerances.length and data.length > 0,
            between=tuple(scale(p, s) for p in data.between),
        )

    def _convexity(self, index: int, data: _EdgeData) -> tuple[EdgeConvexity, float]:
        """Convex where one face lies behind the other's plane (its inward direction against the other's normal)."""
        if len(data.uses) < 2:
            return (EdgeConvexity.SEAM if index in self.seams else EdgeConvexity.FREE), 0.0
        a, b = data.uses[0], data.uses[1]
        angle = math.atan2(norm(cross(a.normal, b.normal)), dot(a.normal, b.normal))
        if angle < self.tolerances.smooth:
            return EdgeConvexity.SMOOTH, angle
        side = dot(a.into_face, b.normal) + dot(b.into_face, a.normal)
        return (EdgeConvexity.CONVEX if side < 0 else EdgeConvexity.CONCAVE), angle


_NATIVE_TYPES = (
    GeomAbs_SurfaceType.GeomAbs_Plane,
    GeomAbs_SurfaceType.GeomAbs_Cylinder,
    GeomAbs_SurfaceType.GeomAbs_Cone,
    GeomAbs_SurfaceType.GeomAbs_Sphere,
    GeomAbs_SurfaceType.GeomAbs_Torus,
)


def _normal_at(edge: TopoDS_Edge, forward: TopoDS_Face, own: _Face, point: Vector) -> Vector:
    """A face's outward normal at the middle of one of its edges."""
    if own.surface.kind is SurfaceKind.PLANE:
        return own.surface.axis
    if own.outward:
        return scale(own.surface.direction_at(point), float(own.outward))
    first, last = BRep_Tool.Range_s(edge, forward)
    curve = BRep_Tool.CurveOnSurface_s(edge, forward, first, last)
    if curve is None:
        return scale(_natural_normal(own.adaptor, 0.0, 0.0)[1], own.flip)
    uv = curve.Value((first + last) / 2)
    return scale(_natural_normal(own.adaptor, uv.X(), uv.Y())[1], own.flip)


def _finite_middle(first: float, last: float) -> float:
    if abs(first) > 1e50 or abs(last) > 1e50:
        return 0.0
    return (first + last) / 2


def _natural_normal(adaptor: BRepAdaptor_Surface, u: float, v: float) -> tuple[Vector, Vector]:
    """Point and unit normal du x dv; next to a pole or apex, where it vanishes, a little away from it."""
    span_u = min(adaptor.LastUParameter() - adaptor.FirstUParameter(), 1.0)
    span_v = min(adaptor.LastVParameter() - adaptor.FirstVParameter(), 1.0)
    point, du, dv = gp_Pnt(), gp_Vec(), gp_Vec()
    for step in (0.0, 0.01, -0.01, 0.1, -0.1):
        adaptor.D1(u + step * span_u, v + step * span_v, point, du, dv)
        normal = cross(vector(du), vector(dv))
        if norm(normal) > 1e-12 * max(norm(vector(du)) * norm(vector(dv)), 1e-30):
            return vector(point), unit(normal)
    return vector(point), (0.0, 0.0, 1.0)


def _is_ring(edge: _EdgeData, surface: Surface, tolerance: float) -> bool:
    """Does a full circle around the surface's axis bound the face?"""
    return (
        edge.circle is not None
        and dist(edge.points[0], edge.points[2]) <= tolerance
        and norm(cross(edge.circle.axis, surface.axis)) < 1e-3
    )
