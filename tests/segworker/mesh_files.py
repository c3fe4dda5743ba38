"""Files of meshes, written from shapes of the kernel or from triangles."""

from __future__ import annotations

import zipfile
from collections.abc import Sequence
from pathlib import Path
from tempfile import NamedTemporaryFile

import numpy as np
from numpy.typing import NDArray
from OCP.BRepMesh import BRepMesh_IncrementalMesh
from OCP.BRepTools import BRepTools
from OCP.StlAPI import StlAPI_Writer
from OCP.TopoDS import TopoDS_Shape

Corners = NDArray[np.float64]
RECORD = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"


def triangles(shape: TopoDS_Shape, chord_mm: float = 0.05, turn_rad: float = 0.5) -> Corners:
    """(T, 3, 3) corners in millimetres."""
    BRepTools.Clean_s(shape, True)
    BRepMesh_IncrementalMesh(shape, chord_mm, False, turn_rad, False)
    with NamedTemporaryFile(suffix=".stl") as file:
        writer = StlAPI_Writer()
        writer.ASCIIMode = False
        writer.Write(shape, file.name)
        return np.fromfile(file.name, dtype=RECORD, offset=84)["corners"].astype(np.float64)


def prism(sides: int, radius: float, height: float) -> Corners:
    """A regular prism, upright; its sides are two triangles each."""
    turn = 2 * np.pi * np.arange(sides) / sides
    low = np.c_[radius * np.cos(turn), radius * np.sin(turn), np.zeros(sides)]
    high, nexts = low + np.array([0.0, 0.0, height]), np.roll(np.arange(sides), -1)
    middle = np.array([[0, 0, 0], [0, 0, height]], dtype=float)
    found = []
    for i, k in enumerate(nexts):
        found += [(low[i], low[k], high[k]), (low[i], high[k], high[i])]
        found += [(middle[0], low[k], low[i]), (middle[1], high[i], high[k])]
    return np.array(found)


def write_stl(path: Path, corners: Corners, count: int | None = None) -> Path:
    """A binary file, which says that it holds `count` triangles."""
    records = np.zeros(len(corners), dtype=RECORD)
    records["corners"] = corners
    number = len(corners) if count is None else count
    path.write_bytes(b"a mesh".ljust(80) + number.to_bytes(4, "little") + records.tobytes())
    return path


def write_stl_text(path: Path, corners: Corners) -> Path:
    """A file of text, six digits a coordinate."""
    lines = ["solid part"]
    for triangle in corners:
        lines += ["facet normal 0 0 0", "  outer loop"]
        lines += [f"    vertex {x:.6e} {y:.6e} {z:.6e}" for x, y, z in triangle]
        lines += ["  endloop", "endfacet"]
    path.write_text("\n".join([*lines, "endsolid part", ""]))
    return path


def write_obj(path: Path, corners: Corners) -> Path:
    """Each corner a vertex of its own; every second face counts from the end."""
    lines = ["# a mesh", "mtllib none.mtl", "o part"]
    for number, triangle in enumerate(corners):
        lines += [f"v {x:.9g} {y:.9g} {z:.9g}" for x, y, z in triangle]
        lines.append("f -3//1 -2//1 -1//1" if number % 2 else "f " + " ".join(str(3 * number + k) for k in (1, 2, 3)))
    path.write_text("\n".join([*lines, ""]))
    return path


def model_xml(
    corners: Corners, unit: str = "millimeter", build: str = '<item objectid="1"/>', head: str = "", more: str = ""
) -> str:
    """The model of a 3MF with object 1, called part, made of the triangles."""
    vertices = "".join(f'<vertex x="{x:.9g}" y="{y:.9g}" z="{z:.9g}"/>' for x, y, z in corners.reshape(-1, 3))
    faces = "".join(f'<triangle v1="{3 * n}" v2="{3 * n + 1}" v3="{3 * n + 2}"/>' for n in range(len(corners)))
    mesh = f"<mesh><vertices>{vertices}</vertices><triangles>{faces}</triangles></mesh>"
    return (
        f'<?xml version="1.0"?>{head}<model unit="{unit}" xmlns="{CORE}"><resources>'
        f'<object id="1" name="part">{mesh}</object>{more}</resources><build>{build}</build></model>'
    )


def write_3mf(path: Path, *parts: tuple[str, str]) -> Path:
    """An archive of these parts, (name, text)."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("[Content_Types].xml", "<Types/>")
        for name, text in parts:
            archive.writestr(name, text)
    return path


def forms(folder: Path, corners: Corners) -> dict[str, Path]:
    """The same triangles in every form."""
    return {
        "stl": write_stl(folder / "part.stl", corners),
        "stl text": write_stl_text(folder / "text.stl", corners),
        "obj": write_obj(folder / "part.obj", corners),
        "3mf": write_3mf(folder / "part.3mf", ("3D/3dmodel.model", model_xml(corners))),
        "3mf in inches": write_3mf(folder / "inch.3mf", ("3D/3dmodel.model", model_xml(corners / 25.4, "inch"))),
    }


def moved(corners: Corners, by: Sequence[float]) -> Corners:
    """The same, elsewhere."""
    there: Corners = corners + np.asarray(by)
    return there
