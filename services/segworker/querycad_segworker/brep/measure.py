"""Exact measurements between faces, by the kernel."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache
from io import BytesIO
from pathlib import Path
from typing import Any, BinaryIO

from OCP.BinTools import BinTools
from OCP.BRep import BRep_Builder, BRep_Tool
from OCP.BRepAdaptor import BRepAdaptor_Surface
from OCP.BRepAlgoAPI import BRepAlgoAPI_Common
from OCP.BRepClass3d import BRepClass3d_SolidClassifier
from OCP.BRepExtrema import BRepExtrema_DistShapeShape
from OCP.BRepGProp import BRepGProp
from OCP.BRepTools import BRepTools
from OCP.collections import IndexedMap_TopoDS_Shape_TopTools_ShapeMapHasher as ShapeMap
from OCP.GeomAbs import GeomAbs_SurfaceType
from OCP.gp import gp_Ax3, gp_Dir, gp_Pnt, gp_Trsf
from OCP.GProp import GProp_GProps
from OCP.Storage import Storage_StreamReadError
from OCP.TopAbs import TopAbs_ShapeEnum, TopAbs_State
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS, TopoDS_Face, TopoDS_Iterator, TopoDS_Shape, TopoDS_Shell, TopoDS_Solid

from querycad_contracts import DRAWING_M, Vector
from querycad_segworker.errors import UnreadableFile
from querycad_segworker.vectors import box_union

from .boxes import exact_box, rough_box
from .canonical import vector
from .faces import METRES_PER_MM
from .moments import of_volume
from .step import compound_of, subshapes

DRAWING_MM = DRAWING_M / METRES_PER_MM
"""A body that reaches less far into another one only touches it."""


def save_faces(faces: Sequence[TopoDS_Face], path: Path) -> None:
    """Keeps the faces, in order, in the kernel's binary format."""
    if not BinTools.Write_s(compound_of(faces), str(path)):
        raise UnreadableFile("the kernel could not keep the model's faces")


def distance(faces: Sequence[TopoDS_Face], first: Sequence[int], second: Sequence[int]) -> float:
    """How far apart are two groups of faces, in metres? 0 when they touch."""
    return _between(compound_of([faces[i] for i in first]), compound_of([faces[i] for i in second]))


class PlaneFaces:
    """The plane ones among faces, by their edges: looked up for each part, on models of ten thousand faces too."""

    def __init__(self, faces: Sequence[TopoDS_Face]) -> None:
        self._edges = ShapeMap()
        self._at: list[list[int]] = [[]]  # the kernel counts from 1
        for i, face in enumerate(faces):
            if BRepAdaptor_Surface(face).GetType() == GeomAbs_SurfaceType.GeomAbs_Plane:
                for edge in subshapes(face, TopAbs_ShapeEnum.TopAbs_EDGE):
                    known = self._edges.Add(edge)
                    self._at += [[] for _ in range(known + 1 - len(self._at))]
                    self._at[known].append(i)

    def beside(self, face: TopoDS_Face) -> set[int]:
        """Those that share an edge with a face, by their places in the list."""
        edges = subshapes(face, TopAbs_ShapeEnum.TopAbs_EDGE)
        return {i for edge in edges if self._edges.Contains(edge) for i in self._at[self._edges.FindIndex(edge)]}


def edge_distance(faces: Sequence[TopoDS_Face], part: Sequence[int], planes: PlaneFaces) -> float:
    """How far is a part from the outer boundary of the plane face it lies in, in metres?

    That face is the largest plane one that shares an edge with the part without belonging to it.
    """
    host, host_area = None, 0.0
    for i in sorted(set[int]().union(*(planes.beside(faces[i]) for i in part)) - set(part)):
        area = GProp_GProps()
        BRepGProp.SurfaceProperties_s(faces[i], area)
        if area.Mass() > host_area:
            host, host_area = faces[i], area.Mass()
    if host is None:
        raise UnreadableFile("the part lies in no plane face, so it has no distance to the edge of one")
    return _between(compound_of([faces[i] for i in part]), BRepTools.OuterWire_s(host))


def extent(faces: Sequence[TopoDS_Face], part: Sequence[int], direction: Vector) -> float:
    """How far does a part extend along a unit vector, in metres? Turned so that this is along z, and boxed exactly."""
    turn = gp_Trsf()
    turn.SetTransformation(gp_Ax3(gp_Pnt(0.0, 0.0, 0.0), gp_Dir(*direction)))
    placed = TopLoc_Location(turn)
    low, high = box_union(exact_box(faces[i].Moved(placed)) for i in part) or ((0.0,) * 3, (0.0,) * 3)
    return (high[2] - low[2]) * METRES_PER_MM


def overlap(faces: Sequence[TopoDS_Face], first: Sequence[int], second: Sequence[int]) -> float:
    """Which volume do two bodies, each of closed faces, share, in m3? 0 when they only touch.

    The kernel's intersection may fail in silence: none is believed while a corner of one body lies inside the other.
    """
    one, other = (_solid([faces[i] for i in ids]) for ids in (first, second))
    common = BRepAlgoAPI_Common(one, other)
    shared = 0.0 if not common.IsDone() or common.Shape().IsNull() else abs(of_volume(common.Shape()).amount)
    if not common.IsDone() or (not shared and (_corner_inside(one, other) or _corner_inside(other, one))):
        raise UnreadableFile("the kernel could not intersect these bodies")
    return shared * METRES_PER_MM**3


def _corner_inside(one: TopoDS_Shape, other: TopoDS_Shape) -> bool:
    """Does a corner of one lie inside the other, by more than drawings tell?"""
    classifier, box = BRepClass3d_SolidClassifier(other), rough_box(other)
    for vertex in subshapes(one, TopAbs_ShapeEnum.TopAbs_VERTEX):
        point = BRep_Tool.Pnt_s(TopoDS.Vertex(vertex))
        if all(low < c < high for low, c, high in zip(box[0], vector(point), box[1], strict=True)):
            classifier.Perform(point, DRAWING_MM)
            if classifier.State() == TopAbs_State.TopAbs_IN:
                return True
    return False


def _solid(faces: Sequence[TopoDS_Face]) -> TopoDS_Shape:
    """The solid that closed faces bound: what they enclose from outside, less its voids."""
    shells = [(of_volume(shell).amount, shell) for shell in _shells(faces)]
    solid, builder = TopoDS_Solid(), BRep_Builder()
    builder.MakeSolid(solid)
    outer = max((abs(amount) for amount, _ in shells), default=0.0)
    for amount, shell in shells:
        builder.Add(solid, shell if (amount > 0) == (abs(amount) == outer) else shell.Reversed())
    return solid


def _shells(faces: Sequence[TopoDS_Face]) -> list[TopoDS_Shell]:
    """A closed shell for each group of faces that hang together by shared edges."""
    known, builder = ShapeMap(), BRep_Builder()
    groups: list[tuple[set[int], list[TopoDS_Face]]] = []
    for face in faces:
        edges, members = {int(known.Add(edge)) for edge in subshapes(face, TopAbs_ShapeEnum.TopAbs_EDGE)}, [face]
        for group in [group for group in groups if not edges.isdisjoint(group[0])]:
            groups.remove(group)
            edges |= group[0]
            members = [*group[1], *members]
        groups.append((edges, members))
    shells = []
    for _, members in groups:
        shell = TopoDS_Shell()
        builder.MakeShell(shell)
        for face in members:
            builder.Add(shell, face)
        shell.Closed(True)
        shells.append(shell)
    return shells


def _load_faces(kept: BinaryIO) -> list[TopoDS_Face]:
    shape = TopoDS_Shape()
    try:
        BinTools.Read_s(shape, BytesIO(kept.read()))
    except Storage_StreamReadError as error:
        raise UnreadableFile("the model's faces could not be read again") from error
    faces = []
    iterator = TopoDS_Iterator(shape)
    while iterator.More():
        faces.append(TopoDS.Face(iterator.Value()))
        iterator.Next()
    return faces


def _between(first: TopoDS_Shape, second: TopoDS_Shape) -> float:
    extrema = BRepExtrema_DistShapeShape(first, second)
    if not extrema.IsDone():
        raise UnreadableFile("the kernel found no distance between these parts")
    return float(extrema.Value()) * METRES_PER_MM


def measurer(kept: BinaryIO) -> Callable[[dict[str, Any]], float]:
    """What measures the kept faces, which are open, as requests ask? It raises UnreadableFile."""
    faces = _load_faces(kept)
    planes = cache(lambda: PlaneFaces(faces))

    def measure(request: dict[str, Any]) -> float:
        match request["what"]:
            case "distance":
                return distance(faces, request["first"], request["second"])
            case "overlap":
                return overlap(faces, request["first"], request["second"])
            case "extent":
                return extent(faces, request["first"], request["direction"])
        return edge_distance(faces, request["first"], planes())

    return measure
