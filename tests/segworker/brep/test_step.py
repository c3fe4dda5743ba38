"""Reading STEP: lengths in any unit, names, colours, and the order of faces."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from OCP.gp import gp_Trsf, gp_Vec
from OCP.Quantity import Quantity_Color, Quantity_TypeOfColor
from OCP.STEPCAFControl import STEPCAFControl_Writer
from OCP.TCollection import TCollection_ExtendedString
from OCP.TDataStd import TDataStd_Name
from OCP.TDocStd import TDocStd_Document
from OCP.TopLoc import TopLoc_Location
from OCP.XCAFDoc import XCAFDoc_ColorType, XCAFDoc_DocumentTool
from tests.segworker.shapes import Found, box, cut, cylinder, plate, write_step

from querycad_segworker.brep.step import read_step
from querycad_segworker.errors import UnreadableFile


@pytest.mark.parametrize(("unit", "told"), [("MM", "millimetre"), ("M", "metre"), ("INCH", "inch")])
def test_a_cube_has_the_same_size_in_metres_whatever_unit_the_file_declares(
    unit: str, told: str, tmp_path: Path
) -> None:
    path = write_step(tmp_path / "cube.step", box((10, 20, 30)), unit)
    content = read_step(path)
    assert content.units == (told,)
    found = Found(content)
    assert found.shape.extents == pytest.approx((0.010, 0.020, 0.030))
    assert found.shape.volume == pytest.approx(6e-6)


@pytest.fixture(scope="module")
def assembly(tmp_path_factory: pytest.TempPathFactory) -> Found:
    """A blue base, and one red pin placed twice."""
    document = TDocStd_Document(TCollection_ExtendedString("XCAF"))
    shapes = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
    colors = XCAFDoc_DocumentTool.ColorTool_s(document.Main())
    top = shapes.NewShape()
    TDataStd_Name.Set_s(top, TCollection_ExtendedString("fixture"))
    for shape, name, color, places in (
        (box((50, 30, 5)), "base plate", (0.0, 0.0, 1.0), [(0.0, 0.0, 0.0)]),
        (cylinder(3, 20), "dowel pin", (1.0, 0.0, 0.0), [(10.0, 10.0, 5.0), (40.0, 10.0, 5.0)]),
    ):
        label = shapes.AddShape(shape, False)
        TDataStd_Name.Set_s(label, TCollection_ExtendedString(name))
        colors.SetColor(
            label, Quantity_Color(*color, Quantity_TypeOfColor.Quantity_TOC_sRGB), XCAFDoc_ColorType.XCAFDoc_ColorGen
        )
        for place in places:
            move = gp_Trsf()
            move.SetTranslation(gp_Vec(*place))
            shapes.AddComponent(top, label, TopLoc_Location(move))
    shapes.UpdateAssemblies()
    path = tmp_path_factory.mktemp("assembly") / "assembly.step"
    writer = STEPCAFControl_Writer()
    writer.SetNameMode(True)
    writer.SetColorMode(True)
    writer.Transfer(document)
    writer.Write(str(path))
    return Found(read_step(path))


def test_the_bodies_of_an_assembly_keep_their_names_and_colours(assembly: Found) -> None:
    bodies = [(body.name, body.color) for body in assembly.shape.bodies]
    assert bodies == [("base plate", "#0000ff"), ("dowel pin", "#ff0000"), ("dowel pin", "#ff0000")]
    assert assembly.shape.name == "fixture"


@pytest.mark.parametrize("name", ["NONE", "COMPOUND", "=>[0:1:1:2]", "Open CASCADE STEP translator 7.8 1"])
def test_what_a_writer_puts_in_the_place_of_a_name_is_none(tmp_path: Path, name: str) -> None:
    path = write_step(tmp_path / "model.step", plate())
    said = path.read_text()
    renamed, count = re.subn(r"PRODUCT\(\s*'[^']*',\s*'[^']*'", f"PRODUCT('{name}','{name}'", said)
    assert count == 1
    path.write_text(renamed)
    shape = Found(read_step(path)).shape
    assert (shape.name, [body.name for body in shape.bodies]) == ("", [""])


def test_each_instance_of_a_product_is_where_it_was_put(assembly: Found) -> None:
    pins = [body for body in assembly.shape.bodies if body.name == "dowel pin"]
    assert [pin.center for pin in pins] == [
        pytest.approx((0.010, 0.010, 0.015)),
        pytest.approx((0.040, 0.010, 0.015)),
    ]
    assert all(pin.volume == pytest.approx(3.14159265e-9 * 9 * 20) for pin in pins)


def test_the_triangles_of_each_instance_are_where_it_was_put(assembly: Found) -> None:
    for body in assembly.brep.bodies:
        part = assembly.mesh.of_faces(np.array(body.faces))
        low, high = part.bounds
        expected = assembly.shape.bodies[body.id]
        assert tuple((low + high) / 2) == pytest.approx(expected.center, abs=1e-4)


def test_what_is_no_step_is_refused_by_the_kernel_in_one_sentence(tmp_path: Path) -> None:
    path = tmp_path / "text.step"
    path.write_text("ISO-10303-21;\nHEADER;\nrubbish", encoding="ascii")
    with pytest.raises(UnreadableFile, match=r"cannot parse|nothing in this"):
        read_step(path)


BUILD123D = """
import sys, warnings
warnings.simplefilter("ignore")
from build123d import import_step
for face in import_step(sys.argv[1]).faces():
    box = face.bounding_box()
    print(face.area, *box.center())
"""


def test_face_ids_are_build123d_s_order_of_faces(tmp_path: Path) -> None:
    shape = cut(plate(), cylinder(5, 30, (0, 0, -25)), cylinder(3, 8, (15, 5, -8)), box((10, 10, 10), (-25, -5, -10)))
    path = write_step(tmp_path / "model.step", shape)
    printed = subprocess.run(
        [sys.executable, "-c", BUILD123D, str(path)], capture_output=True, text=True, check=True
    ).stdout
    rows = [[float(word) for word in line.split()] for line in printed.splitlines() if line[:1].isdigit()]
    faces = Found(read_step(path)).brep.faces
    assert len(rows) == len(faces)
    for row, face in zip(rows, faces, strict=True):
        middle = [(low + high) / 2 * 1e3 for low, high in zip(*face.box, strict=True)]
        assert row[0] == pytest.approx(face.area * 1e6)
        assert row[1:] == pytest.approx(middle, abs=1e-4)
