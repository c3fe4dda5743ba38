"""Reads a STEP file: shape, product names, colours. Lengths arrive in millimetres, whatever unit the file declares."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from OCP.BRep import BRep_Builder
from OCP.collections import IndexedMap_TopoDS_Shape_TopTools_ShapeMapHasher as ShapeMap
from OCP.collections import Sequence_TCollection_AsciiString, Sequence_TDF_Label
from OCP.IFSelect import IFSelect_ReturnStatus
from OCP.Message import Message, Message_Gravity
from OCP.Quantity import Quantity_Color, Quantity_ColorRGBA
from OCP.STEPCAFControl import STEPCAFControl_Reader
from OCP.TCollection import TCollection_ExtendedString
from OCP.TDataStd import TDataStd_Name
from OCP.TDF import TDF_Label
from OCP.TDocStd import TDocStd_Document
from OCP.TopAbs import TopAbs_ShapeEnum
from OCP.TopExp import TopExp
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS_Compound, TopoDS_Shape
from OCP.XCAFDoc import XCAFDoc_ColorTool, XCAFDoc_ColorType, XCAFDoc_DocumentTool, XCAFDoc_ShapeTool

from querycad_segworker.errors import UnreadableFile

NAME_CHARS = 1000
"""Of a product's name; control characters in it are spaces, for it is shown on terminals."""

_GENERATED_NAME = re.compile(r"Open CASCADE STEP translator.*|=>\[[\d:]+\]|NONE|COMPOUND|COMPSOLID|SOLID|SHELL|UNNAMED")
"""What writers put where a shape has no name: the kernel's its own or the shape's type, others that there is none."""

_COLOR_TYPES = (
    XCAFDoc_ColorType.XCAFDoc_ColorSurf,
    XCAFDoc_ColorType.XCAFDoc_ColorGen,
    XCAFDoc_ColorType.XCAFDoc_ColorCurv,
)


@dataclass(frozen=True, slots=True)
class NamedShape:
    """A placed product of the file: its shape, name and colour."""

    shape: TopoDS_Shape
    name: str
    color: str | None


@dataclass(frozen=True, slots=True)
class StepContent:
    """What a CAD file holds. `shape` is everything as one compound; `products` are its leaves, placed."""

    shape: TopoDS_Shape
    name: str
    products: tuple[NamedShape, ...]
    units: tuple[str, ...] = ()
    """Names of the length units that the file declares, such as 'millimetre'."""
    warnings: tuple[str, ...] = ()


def subshapes(shape: TopoDS_Shape, kind: TopAbs_ShapeEnum) -> list[TopoDS_Shape]:
    """Which different subshapes of a kind does the shape hold, in file order?"""
    found = ShapeMap()
    TopExp.MapShapes_s(shape, kind, found)
    return [found.FindKey(i) for i in range(1, found.Size() + 1)]


def compound_of(shapes: Iterable[TopoDS_Shape]) -> TopoDS_Compound:
    """Which one shape holds all of these?"""
    compound, builder = TopoDS_Compound(), BRep_Builder()
    builder.MakeCompound(compound)
    for shape in shapes:
        builder.Add(compound, shape)
    return compound


def read_step(path: Path) -> StepContent:
    """What does the STEP file hold? Raises UnreadableFile when the kernel cannot read or transfer it."""
    quiet()
    document = TDocStd_Document(TCollection_ExtendedString("XCAF"))
    reader = STEPCAFControl_Reader()
    reader.SetNameMode(True)
    reader.SetColorMode(True)
    for unused in (reader.SetGDTMode, reader.SetLayerMode, reader.SetMatMode, reader.SetPropsMode, reader.SetViewMode):
        unused(False)
    if reader.ReadFile(str(path)) != IFSelect_ReturnStatus.IFSelect_RetDone:
        raise UnreadableFile("the CAD kernel cannot parse this STEP file")
    if not reader.Transfer(document):
        raise UnreadableFile("the CAD kernel finds nothing in this STEP file that it can transfer")
    return content_of(document, _units(reader))


def content_of(document: TDocStd_Document, units: tuple[str, ...]) -> StepContent:
    """The products of a document that a reader has filled."""
    shape_tool = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
    color_tool = XCAFDoc_DocumentTool.ColorTool_s(document.Main())
    roots = _labels(shape_tool, None)
    products: list[NamedShape] = []
    for root in roots:
        products.extend(_products(shape_tool, color_tool, root, TopLoc_Location(), _label_color(color_tool, root)))
    compound = compound_of(shape_tool.GetShape_s(root) for root in roots)
    return StepContent(compound, _name(roots[0]) if len(roots) == 1 else "", tuple(products), units)


def _units(reader: STEPCAFControl_Reader) -> tuple[str, ...]:
    """Each once, in the file's order."""
    lengths, angles, solid_angles = (Sequence_TCollection_AsciiString() for _ in range(3))
    reader.ChangeReader().FileUnits(lengths, angles, solid_angles)
    names = (str(lengths.Value(i).ToCString()).lower() for i in range(1, lengths.Length() + 1))
    return tuple(dict.fromkeys(names))


def quiet() -> None:
    """Keep the kernel's chatter off standard output: its messages are not for users."""
    for printer in Message.DefaultMessenger_s().Printers():
        printer.SetTraceLevel(Message_Gravity.Message_Fail)


def _labels(tool: XCAFDoc_ShapeTool, assembly: TDF_Label | None) -> list[TDF_Label]:
    found = Sequence_TDF_Label()
    if assembly is None:
        tool.GetFreeShapes(found)
    else:
        tool.GetComponents_s(assembly, found)
    return [found.Value(i) for i in range(1, found.Length() + 1)]


def _products(
    shapes: XCAFDoc_ShapeTool, colors: XCAFDoc_ColorTool, label: TDF_Label, place: TopLoc_Location, color: str | None
) -> Iterator[NamedShape]:
    """The leaves below a label, placed. A colour given to an instance or assembly goes down to leaves without one."""
    if shapes.IsAssembly_s(label):
        for component in _labels(shapes, label):
            referred = TDF_Label()
            if not shapes.GetReferredShape_s(component, referred):
                continue
            own = _label_color(colors, component) or _label_color(colors, referred) or color
            yield from _products(shapes, colors, referred, place.Multiplied(shapes.GetLocation_s(component)), own)
        return
    shape = shapes.GetShape_s(label)
    if shape.IsNull():
        return
    for solid in subshapes(shape, TopAbs_ShapeEnum.TopAbs_SOLID) or [shape]:
        sub_label = TDF_Label()
        named = shapes.FindSubShape(label, solid, sub_label) and _name(sub_label)
        own = _shape_color(colors, solid) or _label_color(colors, label) or color or _face_color(colors, solid)
        yield NamedShape(solid.Moved(place), named or _name(label), own)


def _name(label: TDF_Label) -> str:
    """The label's name; asking for an attribute that is not there breaks the binding, hence the test first."""
    attribute = TDataStd_Name()
    if label.IsAttribute(TDataStd_Name.GetID_s()) and label.FindAttribute(TDataStd_Name.GetID_s(), attribute):
        said = str(attribute.Get().ToExtString())
        name = "".join(char if unicodedata.category(char)[0] != "C" else " " for char in said[:NAME_CHARS]).strip()
        return "" if _GENERATED_NAME.fullmatch(name) else name
    return ""


def _label_color(tool: XCAFDoc_ColorTool, label: TDF_Label) -> str | None:
    color = Quantity_ColorRGBA()
    return _hex(color) if any(tool.GetColor_s(label, kind, color) for kind in _COLOR_TYPES) else None


def _shape_color(tool: XCAFDoc_ColorTool, shape: TopoDS_Shape) -> str | None:
    color = Quantity_ColorRGBA()
    return _hex(color) if any(tool.GetColor(shape, kind, color) for kind in _COLOR_TYPES) else None


def _face_color(tool: XCAFDoc_ColorTool, shape: TopoDS_Shape) -> str | None:
    """The colour that most of the shape's faces carry, where it has none itself."""
    known = Sequence_TDF_Label()
    tool.GetColors(known)
    if known.IsEmpty():  # asking face by face takes as long as measuring them
        return None
    counts: dict[str, int] = {}
    for face in subshapes(shape, TopAbs_ShapeEnum.TopAbs_FACE):
        color = _shape_color(tool, face)
        if color is not None:
            counts[color] = counts.get(color, 0) + 1
    return max(counts, key=lambda color: counts[color]) if counts else None


def _hex(color: Quantity_ColorRGBA) -> str:
    return str(Quantity_Color.ColorToHex_s(color.GetRGB(), True).ToCString()).lower()
