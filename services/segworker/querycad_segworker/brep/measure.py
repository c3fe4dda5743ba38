"""Exact measurements between faces, by the kernel."""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from OCP.BinTools import BinTools
from OCP.BRep import BRep_Builder
from OCP.BRepAdaptor import BRepAdaptor_Surface
from OCP.BRepExtrema import BRepExtrema_DistShapeShape
from OCP.BRepGProp import BRepGProp
from OCP.BRepTools import BRepTools
from OCP.collections import IndexedMap_TopoDS_Shape_TopTools_ShapeMapHasher as ShapeMap
from OCP.GeomAbs import GeomAbs_SurfaceType
from OCP.gp import gp_Ax3, gp_Dir, gp_Pnt, gp_Trsf
from OCP.GProp import GProp_GProps
from OCP.TopAbs import TopAbs_ShapeEnum
from OCP.TopExp import TopExp
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS, TopoDS_Compound, TopoDS_Face, TopoDS_Iterator, TopoDS_Shape

from querycad_contracts import Vector
from querycad_segworker.errors import UnreadableFile
from querycad_segworker.vectors import box_union

from .boxes import exact_box
from .faces import METRES_PER_MM


def save_faces(faces: Sequence[TopoDS_Face], path: Path) -> None:
    """Keeps the faces, in order, in the kernel's binary format."""
    if not BinTools.Write_s(_compound(faces), str(path)):
        raise UnreadableFile("the kernel could not keep the model's faces")


def distance(faces: Sequence[TopoDS_Face], first: Sequence[int], second: Sequence[int]) -> float:
    """How far apart are two groups of faces, in metres? 0 when they touch."""
    return _between(_compound([faces[i] for i in first]), _compound([faces[i] for i in second]))


def edge_distance(faces: Sequence[TopoDS_Face], part: Sequence[int]) -> float:
    """How far is a part from the outer boundary of the plane face it lies in, in metres?

    That face is the largest plane one that shares an edge with the part without belonging to it.
    """
    own = ShapeMap()
    for i in part:
        TopExp.MapShapes_s(faces[i], TopAbs_ShapeEnum.TopAbs_EDGE, own)
    host, host_area = None, 0.0
    for i, face in enumerate(faces):
        if i in set(part) or BRepAdaptor_Surface(face).GetType() != GeomAbs_SurfaceType.GeomAbs_Plane:
            continue
        edges = ShapeMap()
        TopExp.MapShapes_s(face, TopAbs_ShapeEnum.TopAbs_EDGE, edges)
        if any(own.Contains(edges.FindKey(k)) for k in range(1, edges.Size() + 1)):
            area = GProp_GProps()
            BRepGProp.SurfaceProperties_s(face, area)
            if area.Mass() > host_area:
                host, host_area = face, area.Mass()
    if host is None:
        raise UnreadableFile("the part lies in no plane face, so it has no distance to the edge of one")
    return _between(_compound([faces[i] for i in part]), BRepTools.OuterWire_s(host))


def extent(faces: Sequence[TopoDS_Face], part: Sequence[int], direction: Vector) -> float:
    """How far does a part extend along a unit vector, in metres? Turned so that this is along z, and boxed exactly."""
    turn = gp_Trsf()
    turn.SetTransformation(gp_Ax3(gp_Pnt(0.0, 0.0, 0.0), gp_Dir(*direction)))
    placed = TopLoc_Location(turn)
    low, high = box_union(exact_box(faces[i].Moved(placed)) for i in part) or ((0.0,) * 3, (0.0,) * 3)
    return (high[2] - low[2]) * METRES_PER_MM


def _load_faces(path: Path) -> list[TopoDS_Face]:
    shape = TopoDS_Shape()
    if not BinTools.Read_s(shape, str(path)):
        raise UnreadableFile("the model's faces could not be read again")
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


def _compound(shapes: Sequence[TopoDS_Shape]) -> TopoDS_Compound:
    compound, builder = TopoDS_Compound(), BRep_Builder()
    builder.MakeCompound(compound)
    for shape in shapes:
        builder.Add(compound, shape)
    return compound


def _measured(faces: Sequence[TopoDS_Face], request: dict[str, Any]) -> float:
    match request["what"]:
        case "distance":
            return distance(faces, request["first"], request["second"])
        case "extent":
            return extent(faces, request["first"], request["direction"])
    return edge_distance(faces, request["first"])


def work(kernel_faces: str) -> None:
    """Answers requests about the kept faces, one JSON object a line, until standard input ends.

    {"what": "distance" | "edge_distance" | "extent", "first": [face ids], "second": [face ids], "direction": [x, y, z]}
    is answered by {"metres": number} or {"problem": sentence}.
    """
    faces = _load_faces(Path(kernel_faces))
    for line in sys.stdin:
        request = json.loads(line)
        try:
            answer: dict[str, float | str] = {"metres": _measured(faces, request)}
        except UnreadableFile as problem:
            answer = {"problem": str(problem)}
        sys.stdout.write(json.dumps(answer) + "\n")
        sys.stdout.flush()
