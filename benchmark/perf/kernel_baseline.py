"""How long does the kernel alone take for a file? The baseline that reading a model is measured against."""

from __future__ import annotations

import time
from pathlib import Path

from OCP.Bnd import Bnd_Box
from OCP.BRepBndLib import BRepBndLib
from OCP.BRepMesh import BRepMesh_IncrementalMesh
from OCP.IFSelect import IFSelect_ReturnStatus
from OCP.STEPControl import STEPControl_Reader

from querycad_segworker.brep.tessellate import ANGULAR_DEFLECTION_RAD, RELATIVE_DEFLECTION
from querycad_segworker.errors import UnreadableFile


def read_and_tessellate_s(path: Path) -> float:
    """How many seconds do the kernel's own reader and mesher take, as fine as `tessellate`? Raises UnreadableFile.

    The plain reader: no names, no colours, nothing copied out of the kernel.
    """
    start = time.perf_counter()
    reader = STEPControl_Reader()
    if reader.ReadFile(str(path)) != IFSelect_ReturnStatus.IFSelect_RetDone:
        raise UnreadableFile("the CAD kernel cannot parse this STEP file")
    reader.TransferRoots()
    shape = reader.OneShape()
    box = Bnd_Box()
    BRepBndLib.Add_s(shape, box)
    deflection = RELATIVE_DEFLECTION * float(box.SquareExtent()) ** 0.5
    BRepMesh_IncrementalMesh(shape, deflection, False, ANGULAR_DEFLECTION_RAD, False)
    return time.perf_counter() - start
