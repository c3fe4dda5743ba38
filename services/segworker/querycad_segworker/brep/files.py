"""Reads a CAD file of any kind that the kernel knows. Lengths arrive in millimetres."""

from __future__ import annotations

from pathlib import Path

from OCP.BRep import BRep_Builder
from OCP.BRepTools import BRepTools
from OCP.IFSelect import IFSelect_ReturnStatus
from OCP.IGESCAFControl import IGESCAFControl_Reader
from OCP.TCollection import TCollection_ExtendedString
from OCP.TDocStd import TDocStd_Document
from OCP.TopAbs import TopAbs_ShapeEnum
from OCP.TopoDS import TopoDS_Shape

from querycad_contracts import FileKind
from querycad_segworker.errors import UnreadableFile

from .step import NamedShape, StepContent, content_of, quiet, read_step, subshapes

_UNITS = {
    "IN": "inch", "INCH": "inch", "MM": "millimetre", "FT": "foot", "MI": "mile", "M": "metre", "KM": "kilometre",
    "MIL": "mil", "UM": "micrometre", "CM": "centimetre", "UIN": "microinch",
}  # fmt: skip
"""Names of units in the global section of IGES 5.3, 2.2.4.3.14 and 15."""


def read_file(path: Path, kind: FileKind | None) -> StepContent:
    """What does the file hold? Raises UnreadableFile when the kernel cannot read it."""
    if kind is FileKind.IGES:
        return _read_iges(path)
    if kind is FileKind.BREP:
        return _read_brep(path)
    return read_step(path)


def _read_iges(path: Path) -> StepContent:
    quiet()
    document = TDocStd_Document(TCollection_ExtendedString("XCAF"))
    reader = IGESCAFControl_Reader()
    reader.SetNameMode(True)
    reader.SetColorMode(True)
    reader.SetLayerMode(False)
    if reader.ReadFile(str(path)) != IFSelect_ReturnStatus.IFSelect_RetDone:
        raise UnreadableFile("the CAD kernel cannot parse this IGES file")
    if not reader.Transfer(document):
        raise UnreadableFile("the CAD kernel finds nothing in this IGES file that it can transfer")
    name = reader.IGESModel().GlobalSection().UnitName()
    said = str(name.ToCString()).strip().upper() if name is not None else ""
    return content_of(document, (_UNITS[said],) if said in _UNITS else ())


def _read_brep(path: Path) -> StepContent:
    quiet()
    shape = TopoDS_Shape()
    if not BRepTools.Read_s(shape, str(path), BRep_Builder()) or shape.IsNull():
        raise UnreadableFile("the CAD kernel cannot parse this BREP file")
    solids = subshapes(shape, TopAbs_ShapeEnum.TopAbs_SOLID) or [shape]
    warning = "a BREP file declares no unit: its lengths are taken as millimetres"
    return StepContent(shape, "", tuple(NamedShape(solid, "", None) for solid in solids), (), (warning,))
