"""Shapes built with the kernel, in millimetres, and what is recognised on them, in metres."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from OCP.Bnd import Bnd_Box
from OCP.BRep import BRep_Builder
from OCP.BRepAdaptor import BRepAdaptor_Curve
from OCP.BRepAlgoAPI import BRepAlgoAPI_Cut, BRepAlgoAPI_Fuse, BRepAlgoAPI_Splitter
from OCP.BRepBndLib import BRepBndLib
from OCP.BRepBuilderAPI import (
    BRepBuilderAPI_MakeFace,
    BRepBuilderAPI_MakePolygon,
    BRepBuilderAPI_MakeSolid,
    BRepBuilderAPI_NurbsConvert,
    BRepBuilderAPI_Sewing,
    BRepBuilderAPI_Transform,
)
from OCP.BRepFilletAPI import BRepFilletAPI_MakeChamfer, BRepFilletAPI_MakeFillet
from OCP.BRepLib import BRepLib
from OCP.BRepPrimAPI import (
    BRepPrimAPI_MakeBox,
    BRepPrimAPI_MakeCone,
    BRepPrimAPI_MakeCylinder,
    BRepPrimAPI_MakePrism,
    BRepPrimAPI_MakeSphere,
    BRepPrimAPI_MakeTorus,
)
from OCP.collections import List_TopoDS_Shape
from OCP.GeomAbs import GeomAbs_CurveType
from OCP.gp import gp_Ax1, gp_Ax2, gp_Dir, gp_Pln, gp_Pnt, gp_Trsf, gp_Vec
from OCP.IFSelect import IFSelect_ReturnStatus
from OCP.Interface import Interface_Static
from OCP.ShapeUpgrade import ShapeUpgrade_ShapeDivideAngle
from OCP.STEPControl import STEPControl_StepModelType, STEPControl_Writer
from OCP.TopAbs import TopAbs_ShapeEnum
from OCP.TopoDS import TopoDS, TopoDS_Compound, TopoDS_Edge, TopoDS_Shape

from querycad_contracts import Part, Refusal, Shape
from querycad_segworker.brep.extract import Extracted, extract
from querycad_segworker.brep.step import StepContent, subshapes
from querycad_segworker.brep.tessellate import tessellate
from querycad_segworker.features.recognise import Recognised, recognise
from querycad_segworker.features.sheet.material_thickness import material_thickness
from querycad_segworker.mesh import Mesh
from querycad_segworker.orientation import outward
from querycad_segworker.topology import Brep
from querycad_segworker.vectors import dist
from querycad_segworker.visibility.faces import visible_pixels
from querycad_segworker.visibility.raycast import Scene
from querycad_segworker.visibility.sides import with_sides

Vec = tuple[float, float, float]
UP: Vec = (0.0, 0.0, 1.0)
DOWN: Vec = (0.0, 0.0, -1.0)


def box(size: Vec, at: Vec = (0.0, 0.0, 0.0)) -> TopoDS_Shape:
    """Corner at `at`."""
    return BRepPrimAPI_MakeBox(gp_Pnt(*at), *size).Shape()


def plate(x: float = 60.0, y: float = 40.0, z: float = 20.0) -> TopoDS_Shape:
    """A block around the origin whose top is z = 0."""
    return box((x, y, z), (-x / 2, -y / 2, -z))


def cylinder(radius: float, height: float, at: Vec = (0.0, 0.0, 0.0), along: Vec = UP) -> TopoDS_Shape:
    return BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(*at), gp_Dir(*along)), radius, height).Shape()


def cone(first: float, second: float, height: float, at: Vec = (0.0, 0.0, 0.0), along: Vec = UP) -> TopoDS_Shape:
    """Radius `first` at `at`, `second` at the other end."""
    return BRepPrimAPI_MakeCone(gp_Ax2(gp_Pnt(*at), gp_Dir(*along)), first, second, height).Shape()


def extruded(outline: Sequence[tuple[float, float]], z: float, height: float) -> TopoDS_Shape:
    """The prism over a closed polygon in the plane at `z`."""
    polygon = BRepBuilderAPI_MakePolygon()
    for x, y in outline:
        polygon.Add(gp_Pnt(x, y, z))
    polygon.Close()
    face = BRepBuilderAPI_MakeFace(polygon.Wire()).Face()
    return BRepPrimAPI_MakePrism(face, gp_Vec(0, 0, height)).Shape()


def ball(radius: float, at: Vec = (0.0, 0.0, 0.0)) -> TopoDS_Shape:
    return BRepPrimAPI_MakeSphere(gp_Pnt(*at), radius).Shape()


def torus(radius: float, tube: float, at: Vec = (0.0, 0.0, 0.0), along: Vec = UP) -> TopoDS_Shape:
    return BRepPrimAPI_MakeTorus(gp_Ax2(gp_Pnt(*at), gp_Dir(*along)), radius, tube).Shape()


def bend(radius: float, tube: float, degrees: float, at: Vec, around: Vec, first: Vec) -> TopoDS_Shape:
    """Part of a torus around the axis through `at`, from the direction `first` on."""
    frame = gp_Ax2(gp_Pnt(*at), gp_Dir(*around), gp_Dir(*first))
    return BRepPrimAPI_MakeTorus(frame, radius, tube, math.radians(degrees)).Shape()


def prism(corners: Sequence[Vec], by: Vec) -> TopoDS_Shape:
    """A polygon, moved along `by`."""
    outline = BRepBuilderAPI_MakePolygon()
    for corner in corners:
        outline.Add(gp_Pnt(*corner))
    outline.Close()
    return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(outline.Wire()).Face(), gp_Vec(*by)).Shape()


def gear(count: int, tip: float, root: float, width: float) -> TopoDS_Shape:
    """Around z from z = 0, its teeth with flat tips and flat bottoms."""
    pitch = 2 * math.pi / count
    corners = [(root, 0.0), (root, 0.35), (tip, 0.5), (tip, 0.8)]
    outline = [
        (r * math.cos((i + share) * pitch), r * math.sin((i + share) * pitch))
        for i in range(count)
        for r, share in corners
    ]
    return extruded(outline, 0.0, width)


def sewn(polygons: Sequence[Sequence[Vec]]) -> TopoDS_Shape:
    """The solid that plane polygons enclose."""
    sewing = BRepBuilderAPI_Sewing(1e-6)
    for corners in polygons:
        outline = BRepBuilderAPI_MakePolygon()
        for corner in corners:
            outline.Add(gp_Pnt(*corner))
        outline.Close()
        sewing.Add(BRepBuilderAPI_MakeFace(outline.Wire(), True).Face())
    sewing.Perform()
    solid = BRepBuilderAPI_MakeSolid(TopoDS.Shell(sewing.SewedShape())).Solid()
    BRepLib.OrientClosedSolid_s(solid)
    return solid


def cut(shape: TopoDS_Shape, *tools: TopoDS_Shape) -> TopoDS_Shape:
    """All tools at once."""
    if not tools:
        return shape
    operation = BRepAlgoAPI_Cut()
    operation.SetArguments(_list([shape]))
    operation.SetTools(_list(tools))
    operation.Build()
    return operation.Shape()


def fuse(shape: TopoDS_Shape, *others: TopoDS_Shape) -> TopoDS_Shape:
    for other in others:
        shape = BRepAlgoAPI_Fuse(shape, other).Shape()
    return shape


def compound(*shapes: TopoDS_Shape) -> TopoDS_Shape:
    result, builder = TopoDS_Compound(), BRep_Builder()
    builder.MakeCompound(result)
    for shape in shapes:
        builder.Add(result, shape)
    return result


def edges(shape: TopoDS_Shape) -> list[TopoDS_Edge]:
    return [TopoDS.Edge(edge) for edge in subshapes(shape, TopAbs_ShapeEnum.TopAbs_EDGE)]


def rims(shape: TopoDS_Shape, radius: float, height: float) -> list[TopoDS_Edge]:
    """The circles of this radius around the z direction at this height."""
    found = []
    for edge in edges(shape):
        curve = BRepAdaptor_Curve(edge)
        if curve.GetType() == GeomAbs_CurveType.GeomAbs_Circle:
            circle = curve.Circle()
            if math.isclose(circle.Radius(), radius) and math.isclose(circle.Location().Z(), height, abs_tol=1e-9):
                found.append(edge)
    return found


def upright(shape: TopoDS_Shape) -> list[TopoDS_Edge]:
    """The straight edges along z."""
    found = []
    for edge in edges(shape):
        curve = BRepAdaptor_Curve(edge)
        if curve.GetType() == GeomAbs_CurveType.GeomAbs_Line and abs(curve.Line().Direction().Z()) > 0.999:
            found.append(edge)
    return found


def faces(shape: TopoDS_Shape) -> list[TopoDS_Shape]:
    return subshapes(shape, TopAbs_ShapeEnum.TopAbs_FACE)


def filleted(shape: TopoDS_Shape, radius: float, *chosen: TopoDS_Edge) -> TopoDS_Shape:
    maker = BRepFilletAPI_MakeFillet(shape)
    for edge in chosen:
        maker.Add(radius, edge)
    return maker.Shape()


def chamfered(shape: TopoDS_Shape, width: float, *chosen: TopoDS_Edge) -> TopoDS_Shape:
    maker = BRepFilletAPI_MakeChamfer(shape)
    for edge in chosen:
        maker.Add(width, edge)
    return maker.Shape()


def nurbs(shape: TopoDS_Shape) -> TopoDS_Shape:
    """Every surface and curve as a B-spline."""
    return BRepBuilderAPI_NurbsConvert(shape, True).Shape()


def turned(shape: TopoDS_Shape, axis: Vec, degrees: float) -> TopoDS_Shape:
    move = gp_Trsf()
    move.SetRotation(gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(*axis)), math.radians(degrees))
    return BRepBuilderAPI_Transform(shape, move, True).Shape()


def shifted(shape: TopoDS_Shape, by: Vec) -> TopoDS_Shape:
    move = gp_Trsf()
    move.SetTranslation(gp_Vec(*by))
    return BRepBuilderAPI_Transform(shape, move, True).Shape()


def scaled(shape: TopoDS_Shape, factor: float) -> TopoDS_Shape:
    move = gp_Trsf()
    move.SetScale(gp_Pnt(0, 0, 0), factor)
    return BRepBuilderAPI_Transform(shape, move, True).Shape()


def mirrored(shape: TopoDS_Shape) -> TopoDS_Shape:
    """At the plane x = 0."""
    move = gp_Trsf()
    move.SetMirror(gp_Ax2(gp_Pnt(0, 0, 0), gp_Dir(1, 0, 0)))
    return BRepBuilderAPI_Transform(shape, move, True).Shape()


def halved(shape: TopoDS_Shape) -> TopoDS_Shape:
    """Every face that turns by more than half a circle in halves, as many CAD systems store them."""
    divide = ShapeUpgrade_ShapeDivideAngle(math.pi, shape)
    divide.Perform()
    return divide.Result()


def split(shape: TopoDS_Shape) -> TopoDS_Shape:
    """Every solid with its faces cut apart along two oblique planes; what they enclose stays the same."""
    solids = []
    for solid in subshapes(shape, TopAbs_ShapeEnum.TopAbs_SOLID):
        operation = BRepAlgoAPI_Splitter()
        operation.SetArguments(_list(faces(solid)))
        box = Bnd_Box()
        BRepBndLib.Add_s(solid, box)
        low, high = box.CornerMin(), box.CornerMax()
        size = low.Distance(high)
        middle = gp_Pnt(*((a + 0.02 * size + b) / 2 for a, b in zip(_xyz(low), _xyz(high), strict=True)))
        planes = [gp_Pln(middle, gp_Dir(*normal)) for normal in ((1, 0.13, 0.07), (0.11, 1, 0.17))]
        operation.SetTools(_list([BRepBuilderAPI_MakeFace(plane, -size, size, -size, size).Face() for plane in planes]))
        operation.Build()
        sewing = BRepBuilderAPI_Sewing(1e-6 * size)
        for face in faces(operation.Shape()):
            sewing.Add(face)
        sewing.Perform()
        shells = subshapes(sewing.SewedShape(), TopAbs_ShapeEnum.TopAbs_SHELL)
        made = BRepBuilderAPI_MakeSolid(*(TopoDS.Shell(shell) for shell in shells)).Solid()
        BRepLib.OrientClosedSolid_s(made)
        solids.append(made)
    return solids[0] if len(solids) == 1 else compound(*solids)


def _xyz(point: gp_Pnt) -> Vec:
    return point.X(), point.Y(), point.Z()


def shuffled(shape: TopoDS_Shape) -> TopoDS_Shape:
    """The same solid with its faces stored in the opposite order."""
    from OCP.TopoDS import TopoDS_Shell

    builder, shell = BRep_Builder(), TopoDS_Shell()
    builder.MakeShell(shell)
    for face in reversed(faces(shape)):
        builder.Add(shell, face)
    shell.Closed(True)
    return BRepBuilderAPI_MakeSolid(shell).Shape()


def write_step(path: Path, shape: TopoDS_Shape, unit: str = "MM") -> Path:
    """`unit` is what the file declares, as the kernel names it: MM, M, INCH. Lengths stay the same in space."""
    Interface_Static.SetCVal_s("write.step.unit", unit)
    try:
        writer = STEPControl_Writer()
        writer.Transfer(shape, STEPControl_StepModelType.STEPControl_AsIs)
        assert writer.Write(str(path)) == IFSelect_ReturnStatus.IFSelect_RetDone
    finally:
        Interface_Static.SetCVal_s("write.step.unit", "MM")
    return path


@dataclass(frozen=True)
class Found:
    """What is recognised on a shape, as an ingest does it."""

    content: StepContent

    @cached_property
    def brep(self) -> Brep:
        return self._extracted.brep

    @cached_property
    def _extracted(self) -> Extracted:
        return extract(self.content)

    @cached_property
    def mesh(self) -> Mesh:
        mesh = tessellate(self._extracted.faces, dist(*self.brep.box))
        return outward(mesh, [body.faces for body in self.brep.bodies])

    @cached_property
    def _scene(self) -> Scene:
        return Scene(self.mesh, threads=1)

    @cached_property
    def _recognised(self) -> Recognised:
        thickness = material_thickness(self.brep, self.mesh, self._scene)
        return recognise(self.brep, self._scene.is_clear, thickness, self.mesh, self._scene.ahead)

    @property
    def shape(self) -> Shape:
        return self._recognised.shape

    @property
    def parts(self) -> tuple[Part, ...]:
        """Without the sides they are visible from."""
        return self._recognised.parts

    @property
    def refused(self) -> tuple[Refusal, ...]:
        return self._recognised.refused

    @cached_property
    def seen_parts(self) -> list[Part]:
        """With the sides that they are visible from, in small pictures."""
        visibility = visible_pixels(self._scene, len(self.brep.faces), 640, 360)
        return with_sides(self.parts, self.brep, self._scene, visibility)

    def of(self, kind: str) -> list[Part]:
        return [part for part in self.parts if part.kind == kind]

    @property
    def hole(self) -> Part:
        (hole,) = self.of("hole")
        return hole


def find(shape: TopoDS_Shape) -> Found:
    """Recognises lazily: what a test does not ask for is not computed."""
    return Found(StepContent(shape, "", ()))


def _list(shapes: Sequence[TopoDS_Shape]) -> List_TopoDS_Shape:
    result = List_TopoDS_Shape()
    for shape in shapes:
        result.Append(shape)
    return result
