"""Files of meshes: faces are fitted to triangles, and what is recognised on them is what the CAD model has."""

from __future__ import annotations

import math
from collections import Counter
from pathlib import Path

import numpy as np
import pytest
from OCP.TopoDS import TopoDS_Shape
from tests.segworker import mesh_files
from tests.segworker.mesh_files import (
    Corners,
    forms,
    model_xml,
    moved,
    prism,
    triangles,
    write_3mf,
    write_obj,
    write_stl,
)
from tests.segworker.shapes import (
    ball,
    box,
    chamfered,
    cone,
    cut,
    cylinder,
    extruded,
    filleted,
    plate,
    rims,
    shifted,
    turned,
    upright,
)

from querycad_contracts import FileKind, Part, SurfaceKind
from querycad_segworker import errors
from querycad_segworker.errors import FileProblem, FileTooLarge, IncompleteFile, UnreadableFile
from querycad_segworker.ingest import ingest
from querycad_segworker.local import LocalPartFinder
from querycad_segworker.meshes import files, three_mf
from querycad_segworker.meshes import triangles as limits
from querycad_segworker.meshes.files import MeshFile, read_mesh_file
from querycad_segworker.meshes.fitting import fitted
from querycad_segworker.meshes.triangles import Named, merged
from querycad_segworker.model import Model, ModelStore
from querycad_segworker.topology import Brep, EdgeConvexity

PLATE, SHAFT = plate(), cylinder(10, 20)
DRILLED = cut(plate(), cylinder(5, 30, (0, 0, -25)), cylinder(3, 12, (20, 10, -2)))


def brep_of(corners: Corners) -> Brep:
    """What is fitted to corners in millimetres."""
    return fitted(MeshFile(corners * 1e-3, (Named("", None, len(corners)),)), "part")[0]


def kinds(brep: Brep) -> dict[str, int]:
    return dict(Counter(face.kind.value for face in brep.faces))


def holes(model: Model) -> list[Part]:
    return sorted((part for part in model.parts if part.kind == "hole"), key=lambda hole: hole.diameter or 0.0)


@pytest.fixture(scope="module")
def store(tmp_path_factory: pytest.TempPathFactory) -> ModelStore:
    return ModelStore(tmp_path_factory.mktemp("store"))


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    return forms(tmp_path_factory.mktemp("files"), triangles(DRILLED))


@pytest.mark.parametrize("form", ["stl", "stl text", "obj", "3mf", "3mf in inches"])
def test_a_drilled_plate_is_recognised_in_every_form(written: dict[str, Path], store: ModelStore, form: str) -> None:
    model = ingest(written[form], store).load_model()
    small, large = holes(model)
    assert (small.diameter, large.diameter) == pytest.approx((0.006, 0.010), abs=2e-6)
    assert "through" in large.tags
    assert "blind" in small.tags
    assert model.shape.extents == pytest.approx((0.06, 0.04, 0.02), abs=2e-6)
    assert model.shape.name == written[form].stem
    assert any("a mesh of" in each and "approximate" in each for each in model.warnings)
    assert any("no unit" in each for each in model.warnings) == (not form.startswith("3mf"))
    assert model.units == ({"3mf": ("millimetre",), "3mf in inches": ("inch",)}.get(form, ()))


def test_volume_and_area_are_those_of_the_round_faces(store: ModelStore, tmp_path: Path) -> None:
    """A coarse mesh of a hole of radius 5 has a polygon of 13 corners: 4 % less."""
    shape = cut(plate(), cylinder(5, 30, (0, 0, -25)))
    corners = triangles(shape, 0.2)
    wall = [face for face in brep_of(corners).faces if face.kind is SurfaceKind.CYLINDER]
    model = ingest(write_stl(tmp_path / "coarse.stl", corners), store).load_model()
    exact = 0.06 * 0.04 * 0.02 - math.pi * 0.005**2 * 0.02
    flat = float(np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])).sum() / 6e9)
    assert abs(flat - exact) > 1e-8
    assert model.shape.volume == pytest.approx(exact, rel=2e-5)
    assert wall[0].area == pytest.approx(2 * math.pi * 0.005 * 0.02, rel=2e-3)


@pytest.mark.parametrize("turn_rad", [0.5, 0.2, 0.05])
@pytest.mark.parametrize(
    ("shape", "expected"),
    [
        (cylinder(5, 20), {"plane": 2, "cylinder": 1}),
        (cone(8, 4, 10), {"plane": 2, "cone": 1}),
        (ball(7), {"sphere": 1}),
        (filleted(SHAFT, 2, *rims(SHAFT, 10, 20)), {"plane": 2, "cylinder": 1, "torus": 1}),
        (cut(plate(), cylinder(5, 30, (0, 0, -25)), cylinder(9, 5, (0, 0, -5))), {"plane": 7, "cylinder": 2}),
        (filleted(PLATE, 3, *upright(PLATE)), {"plane": 6, "cylinder": 4}),
        (turned(cut(plate(), cylinder(5, 30, (0, 0, -25))), (1.0, 2.0, 3.0), 37.0), {"plane": 6, "cylinder": 1}),
    ],
    ids=["cylinder", "cone", "ball", "round", "stepped hole", "fillets", "oblique"],
)
def test_surfaces_are_those_of_the_cad_model(shape: TopoDS_Shape, expected: dict[str, int], turn_rad: float) -> None:
    found = brep_of(triangles(shape, 0.1, turn_rad))
    assert kinds(found) == expected
    assert all(body.is_solid for body in found.bodies)


@pytest.mark.parametrize("sides", [3, 4, 6, 8, 10])
def test_a_prism_of_few_sides_stays_planes(sides: int) -> None:
    assert kinds(brep_of(prism(sides, 10, 20))) == {"plane": sides + 2}


@pytest.mark.parametrize("sides", [12, 16, 90, 720])
def test_a_prism_of_many_sides_is_a_cylinder(sides: int) -> None:
    found = brep_of(prism(sides, 10, 20))
    assert kinds(found) == {"plane": 2, "cylinder": 1}
    (wall,) = (face for face in found.faces if face.kind is SurfaceKind.CYLINDER)
    assert wall.radius == pytest.approx(0.01, abs=1e-9)
    assert wall.outward == 1
    assert wall.sweep == pytest.approx(2 * math.pi)
    assert {edge.convexity for edge in found.edges} == {EdgeConvexity.CONVEX}
    assert found.bodies[0].volume == pytest.approx(math.pi * 0.01**2 * 0.02, rel=6e-3 if sides < 16 else 2e-3)


def test_a_hexagonal_pocket_is_no_hole(store: ModelStore, tmp_path: Path) -> None:
    six = [(8 * math.cos(k * math.pi / 3), 8 * math.sin(k * math.pi / 3)) for k in range(6)]
    model = ingest(write_stl(tmp_path / "hex.stl", triangles(cut(plate(), extruded(six, -8, 10)))), store).load_model()
    assert not holes(model)
    assert any(part.kind == "pocket" for part in model.parts)


def test_three_flats_of_unlike_width_are_no_cylinder() -> None:
    """A bevel, a top and a bevel: the corners of any even trapezium lie on a circle."""
    found = brep_of(triangles(chamfered(PLATE, 2, *upright(PLATE))))
    assert kinds(found) == {"plane": 10}


def test_touching_bodies_stay_apart_and_a_void_belongs_to_its_body() -> None:
    two = np.concatenate([triangles(box((10, 10, 10))), triangles(box((10, 10, 10), (10, 0, 0)))])
    found = brep_of(two)
    assert [body.volume for body in found.bodies] == pytest.approx([1e-6, 1e-6])
    hollow = np.concatenate([triangles(box((10, 10, 10))), triangles(box((4, 4, 4), (3, 3, 3)))[:, ::-1]])
    (body,) = brep_of(hollow).bodies
    assert body.volume == pytest.approx(1e-6 - 64e-9)
    assert len(body.faces) == 12


PAINTS = (
    '<basematerials id="5"><base name="grass" displaycolor="#22AA44FF"/><base name="ink" displaycolor="#101820"/>'
    '</basematerials><m:colorgroup xmlns:m="http://schemas.microsoft.com/3dmanufacturing/material/2015/02" id="6">'
    '<m:color color="#ff8800"/></m:colorgroup>'
)


@pytest.mark.parametrize(
    ("of_object", "of_triangles", "color"),
    [
        ('pid="5" pindex="1"', "", "#101820"),
        ('pid="6" pindex="0"', "", "#ff8800"),
        ("", 'pid="5" p1="0"', "#22aa44"),
        ('pid="5" pindex="1"', 'pid="6" p1="0"', "#ff8800"),
        ('pid="5" pindex="9"', "", None),
        ('pid="7" pindex="0"', "", None),
        ('pid="5" pindex="-1"', "", None),
        ("", "", None),
    ],
)
def test_an_object_of_a_3mf_has_its_colour(
    store: ModelStore, tmp_path: Path, of_object: str, of_triangles: str, color: str | None
) -> None:
    text = model_xml(prism(4, 5, 8)).replace("<resources>", f"<resources>{PAINTS}")
    text = text.replace('<object id="1"', f'<object id="1" {of_object}').replace(
        "<triangle ", f"<triangle {of_triangles} "
    )
    path = write_3mf(tmp_path / "painted.3mf", ("3D/3dmodel.model", text))
    assert [body.color for body in ingest(path, store).load_model().shape.bodies] == [color]


def test_an_object_whose_triangles_differ_in_colour_has_none(tmp_path: Path) -> None:
    text = model_xml(prism(4, 5, 8)).replace("<resources>", f"<resources>{PAINTS}")
    text = text.replace("<triangle ", '<triangle pid="5" p1="0" ', 3).replace(
        "<triangle v1", '<triangle pid="5" p1="1" v1'
    )
    found = read_mesh_file(write_3mf(tmp_path / "two.3mf", ("3D/3dmodel.model", text)), FileKind.THREE_MF)
    assert [each.color for each in found.objects] == [None]


@pytest.mark.parametrize(("shade", "color"), [("1 0.5 0", "#ff8000"), ("0 0 0", "#000000"), ("", None), ("1 1", None)])
def test_an_object_of_an_obj_has_the_colour_of_its_vertices(tmp_path: Path, shade: str, color: str | None) -> None:
    path = write_obj(tmp_path / "part.obj", prism(4, 5, 8))
    lines = [f"{line} {shade}" if line.startswith("v ") else line for line in path.read_text().splitlines()]
    path.write_text("\n".join(lines))
    assert [each.color for each in read_mesh_file(path, FileKind.OBJ).objects] == [color]


def test_a_mesh_that_is_inside_out_is_turned() -> None:
    found = brep_of(triangles(DRILLED)[:, ::-1])
    assert all(body.is_solid for body in found.bodies)
    assert [face.outward for face in found.faces if face.kind is SurfaceKind.CYLINDER] == [-1, -1]


def test_an_open_mesh_is_read_and_says_so(store: ModelStore, tmp_path: Path) -> None:
    corners = triangles(DRILLED)
    model = ingest(write_stl(tmp_path / "open.stl", corners[1:]), store).load_model()
    assert any("not closed" in each for each in model.warnings)
    assert any("no volume" in each for each in model.warnings)
    assert len(holes(model)) >= 1


def test_a_mesh_that_cuts_through_itself_is_read_as_its_bodies(store: ModelStore, tmp_path: Path) -> None:
    corners = triangles(plate())
    both = np.concatenate([corners, moved(corners, (7, 5, 3))])
    model = ingest(write_stl(tmp_path / "through.stl", both), store).load_model()
    assert [body.is_solid for body in model.shape.bodies] == [True, True]


def test_a_distance_is_measured_on_the_triangles(store: ModelStore, tmp_path: Path) -> None:
    apart = np.concatenate([triangles(box((10, 10, 10))), triangles(box((10, 10, 10), (13, 14, 0)))])
    path = write_stl(tmp_path / "apart.stl", apart)
    finder = LocalPartFinder(ingest(path, store))
    assert finder.distance("body-1", "body-2") == pytest.approx(5e-3, abs=1e-8)
    assert finder.extent("body-1", (0.5**0.5, 0.5**0.5, 0.0)) == pytest.approx(0.01 * 2**0.5, abs=1e-8)
    drilled = write_stl(tmp_path / "drilled.stl", triangles(shifted(DRILLED, (5, 0, 0))))
    model = LocalPartFinder(ingest(drilled, store))
    small, _ = holes(model.model)
    assert model.edge_distance(small.id) == pytest.approx(0.007, abs=1e-4)


def test_a_3mf_places_named_components_and_reads_parts_of_their_own(store: ModelStore, tmp_path: Path) -> None:
    corners = triangles(box((10, 10, 10)))
    turn = "0 1 0 -1 0 0 0 0 1"
    pair = f'<object id="2" name="pair"><components><component objectid="1" transform="{turn} 0 0 0"/>'
    pair += '<component objectid="1" transform="1 0 0 0 1 0 0 0 -1 50 0 0"/></components></object>'
    root = model_xml(corners, build='<item objectid="2" transform="1 0 0 0 1 0 0 0 1 0 0 5"/>', more=pair)
    found = read_mesh_file(write_3mf(tmp_path / "pair.3mf", ("3D/3dmodel.model", root)), FileKind.THREE_MF)
    brep = fitted(found, "pair")[0]
    assert [body.name for body in brep.bodies] == ["part", "part"]
    assert [body.volume for body in brep.bodies] == pytest.approx([1e-6, 1e-6])
    assert brep.box[0] == pytest.approx((-0.01, 0.0, -0.005))
    assert brep.box[1] == pytest.approx((0.06, 0.01, 0.015))
    outer = model_xml(np.zeros((0, 3, 3)), build='<item objectid="1" p:path="/3D/Objects/one.model"/>')
    outer = outer.replace(
        "<model ", '<model xmlns:p="http://schemas.microsoft.com/3dmanufacturing/production/2015/06" '
    )
    path = write_3mf(
        tmp_path / "parts.3mf", ("3D/3dmodel.model", outer), ("3D/Objects/one.model", model_xml(corners, build=""))
    )
    model = ingest(path, store).load_model()
    assert model.shape.volume == pytest.approx(1e-6)


CUBE = triangles(box((10, 10, 10)))
NOT_A_NUMBER = CUBE.copy()
NOT_A_NUMBER[3, 1, 2] = np.nan
FAR = CUBE * 1e12
BILLION = (
    '<!DOCTYPE model [<!ENTITY a "1234567890">'
    + "".join(f'<!ENTITY {b} "{10 * f"&{a};"}">' for a, b in zip("abcdefgh", "bcdefghi", strict=True))
    + "]>"
)
BAD = {
    "no triangles": (lambda path: write_stl(path, np.zeros((0, 3, 3))), FileProblem, ""),
    "fewer than said": (
        lambda path: write_stl(path, CUBE, 4_000_000_000),
        IncompleteFile, "cut short: it says that it holds 4,000,000,000",
    ),
    "more than said": (
        lambda path: write_stl(path, CUBE, 5),
        UnreadableFile, "says that it holds 5 triangles, and has room for 12",
    ),
    "no number": (lambda path: write_stl(path, NOT_A_NUMBER), UnreadableFile, "not a finite number"),
    "too far": (lambda path: write_stl(path, FAR), UnreadableFile, "beyond all bounds"),
    "one place": (lambda path: write_stl(path, np.ones((5, 3, 3))), IncompleteFile, "has an area"),
    "one line": (lambda path: write_stl(path, np.cumsum(np.ones((5, 3, 3)), axis=1)), IncompleteFile, "has an area"),
    "text cut short": (
        lambda path: _text(path, lambda text: text[: text.rindex("endsolid")]),
        IncompleteFile, "endsolid",
    ),
    "text lacks a corner": (
        lambda path: _text(path, lambda text: text.replace("vertex", "corner", 1)),
        UnreadableFile, "12 facets have 35 corners",
    ),
    "text is no number": (
        lambda path: _text(path, lambda text: text.replace("vertex 0.0", "vertex x.0", 1)),
        UnreadableFile, "no number",
    ),
    "obj names nothing": (
        lambda path: _put(path, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"),
        UnreadableFile, "a vertex that it does not hold",
    ),
    "obj is no number": (
        lambda path: _put(path, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 c\n"),
        UnreadableFile, "not made of numbers",
    ),
    "obj with a concave polygon": (
        lambda path: _put(path, "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 3 1 0\nf 1 2 3 4\nf 3 2 1 4\n"),
        UnreadableFile, "not convex; export it as triangles",
    ),
    "obj has no face": (lambda path: _put(path, "v 0 0 0\nv 1 0 0\nv 0 1 0\n"), IncompleteFile, "no triangle"),
    "3mf with entities": (lambda path: _3mf(path, model_xml(CUBE, head=BILLION)), UnreadableFile, "document type"),
    "3mf breaks off": (lambda path: _3mf(path, model_xml(CUBE)[:-20]), UnreadableFile, "XML breaks off"),
    "3mf of itself": (
        lambda path: _3mf(path, model_xml(CUBE, build='<item objectid="2"/>', more=ITSELF)),
        UnreadableFile, "of itself",
    ),
    "3mf of nothing": (
        lambda path: _3mf(path, model_xml(CUBE, build='<item objectid="7"/>')),
        UnreadableFile, "does not hold",
    ),
    "3mf in no unit": (lambda path: _3mf(path, model_xml(CUBE, "furlong")), UnreadableFile, "furlong"),
    "3mf names nothing": (
        lambda path: _3mf(path, model_xml(CUBE).replace('v1="3"', 'v1="99"')),
        UnreadableFile, "a vertex that it does not hold",
    ),
    "3mf is no number": (
        lambda path: _3mf(path, model_xml(CUBE).replace('x="0"', 'x="far"', 1)),
        UnreadableFile, "a number in it is missing or none",
    ),
    "3mf lacks a number": (
        lambda path: _3mf(path, model_xml(CUBE).replace('x="0" ', "", 1)),
        UnreadableFile, "a number in it is missing or none",
    ),
}  # fmt: skip
ITSELF = '<object id="2"><components><component objectid="2"/></components></object>'


def _put(path: Path, text: str) -> Path:
    path.write_text(text)
    return path


def _text(path: Path, change: object) -> Path:
    assert callable(change)
    return _put(path, change(mesh_files.write_stl_text(path, CUBE).read_text()))


def _3mf(path: Path, text: str) -> Path:
    return write_3mf(path, ("3D/3dmodel.model", text))


@pytest.mark.parametrize("name", BAD)
def test_a_bad_mesh_is_one_clear_sentence(name: str, tmp_path: Path, store: ModelStore) -> None:
    write, problem, said = BAD[name]
    with pytest.raises(problem) as raised:
        ingest(write(tmp_path / "bad"), store)  # type: ignore[no-untyped-call]
    assert said in str(raised.value)
    assert "\n" not in str(raised.value)
    assert type(raised.value) in vars(errors).values()


def test_too_many_triangles_are_refused_before_they_are_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for module in (files, three_mf, limits):
        monkeypatch.setattr(module, "MOST_TRIANGLES", 10)
    for name, kind in (
        ("stl", FileKind.STL),
        ("stl text", FileKind.STL),
        ("obj", FileKind.OBJ),
        ("3mf", FileKind.THREE_MF),
    ):
        with pytest.raises(FileTooLarge, match="triangles"):
            read_mesh_file(forms(tmp_path, CUBE)[name], kind)


def test_a_3mf_ends_where_a_file_would_be_too_large(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(three_mf, "MAX_FILE_BYTES", 2**21)
    path = _3mf(tmp_path / "bomb.3mf", model_xml(CUBE) + " " * 2**23)
    assert path.stat().st_size < 2**16
    with pytest.raises(FileTooLarge, match="unpacked"):
        read_mesh_file(path, FileKind.THREE_MF)


def test_places_that_are_almost_one_are_merged(tmp_path: Path, store: ModelStore) -> None:
    corners = CUBE + 50
    corners[::2] *= 1 + 3e-7
    model = ingest(write_obj(tmp_path / "off.obj", corners), store).load_model()
    assert model.shape.volume == pytest.approx(1e-6, rel=1e-4)
    assert not merged(CUBE)[0].is_open.any()
