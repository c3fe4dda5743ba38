"""Centre of mass, inertia and symmetry of bodies: exact, with twins that are off by a tenth of a millimetre."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
from OCP.BRepBuilderAPI import BRepBuilderAPI_Transform
from OCP.gp import gp_Ax1, gp_Dir, gp_Pnt, gp_Trsf, gp_Vec
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import ball, box, compound, cone, cut, cylinder, find, fuse, plate, turned, write_step

from querycad_contracts import Part, Vector
from querycad_segworker.ingest import ingest
from querycad_segworker.model import ModelStore

MM = 1e-3
X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
CORNERS = [(x, y) for x in (-20.0, 20.0) for y in (-12.0, 12.0)]


def holes(moved: float = 0.0, wider: float = 0.0) -> TopoDS_Shape:
    """A plate with a hole in each corner; one of them `moved` along x, or `wider` (mm)."""
    drills = [cylinder(3, 40, (x, y, -30)) for x, y in CORNERS[:-1]]
    return cut(plate(60, 40, 10), *drills, cylinder(3 + wider, 40, (20 + moved, 12, -30)))


def flange(count: int, start: float = 0.0) -> TopoDS_Shape:
    angles = [start + math.tau * i / count for i in range(count)]
    return cut(cylinder(40, 10), *(cylinder(3, 30, (30 * math.cos(a), 30 * math.sin(a), -5)) for a in angles))


def propeller() -> TopoDS_Shape:
    """A hub with three blades, each beside its radius: turned onto itself, and mirrored by no plane."""
    blade = box((30, 4, 6), (5, 3, 0))
    return fuse(cylinder(10, 10), *(turned(blade, Z, 120.0 * i) for i in range(3)))


def model(shape: TopoDS_Shape) -> Part:
    return next(part for part in find(shape).parts if part.kind == "model")


def same(found: tuple[Vector, ...], wanted: list[Vector]) -> bool:
    """The same directions, whichever way they point."""
    met = [any(abs(abs(sum(a * b for a, b in zip(one, n, strict=True))) - 1) < 1e-9 for n in found) for one in wanted]
    return len(found) == len(wanted) and all(met)


@pytest.mark.parametrize(
    ("shape", "planes", "axes"),
    [
        (box((10, 20, 30)), [X, Y, Z], [2, 2, 2]),
        (cylinder(5, 20), [X, Y, Z], [0]),
        (cone(5, 2, 20), [X, Y], [0]),
        (ball(5), [X, Y, Z], [0, 0, 0]),
        (holes(), [X, Y, Z], [2, 2, 2]),
        (holes(moved=0.1), [Z], []),
        (holes(wider=0.05), [Z], []),
        (compound(cylinder(5, 10, (-20, 0, 0)), cylinder(5, 10, (20, 0, 0))), [X, Y, Z], [2, 2, 2]),
        (compound(cylinder(5, 10, (-20, 0, 0)), cylinder(5, 10.1, (20, 0, 0))), [Y], []),
    ],
)
def test_mirror_planes_and_rotations_are_exact(shape: TopoDS_Shape, planes: list[Vector], axes: list[int]) -> None:
    found = model(shape)
    assert same(found.mirror_planes, planes)
    assert [order for _, order in found.rotation_axes] == axes


def test_a_cube_has_nine_planes_and_thirteen_axes() -> None:
    cube = model(box((10, 10, 10), (3, 4, 5)))
    assert len(cube.mirror_planes) == 9
    assert sorted(order for _, order in cube.rotation_axes) == [2] * 6 + [3] * 4 + [4] * 3


@pytest.mark.parametrize(("count", "start"), [(5, 0.3), (6, 0.0), (7, 1.0)])
def test_a_bolt_circle_gives_as_many_planes_and_positions_as_holes(count: int, start: float) -> None:
    found = model(flange(count, start))
    assert len(found.mirror_planes) == count + 1
    assert found.rotation_axes[0] == (Z, count)


def test_what_is_only_turned_onto_itself_has_no_plane_along_its_axis() -> None:
    found = model(propeller())
    assert found.mirror_planes == ()
    assert found.rotation_axes == ((Z, 3),)
    assert "rotational" in found.tags
    assert "symmetric" not in found.tags


def test_a_body_off_the_axes_of_the_file_keeps_its_symmetry() -> None:
    found = model(turned(turned(box((10, 20, 30), (7, 8, 9)), (1.0, 2.0, 3.0), 33.0), X, 20.0))
    assert len(found.mirror_planes) == len(found.rotation_axes) == 3
    assert {"symmetric"} == {tag for tag in found.tags if tag.startswith("symmetric")}


def test_tags_say_along_which_axis_both_sides_are_alike() -> None:
    found = model(cut(plate(60, 40, 10), cylinder(3, 40, (15, 0, -30))))
    assert {tag for tag in found.tags if tag.startswith("symmetric")} == {"symmetric", "symmetric_y", "symmetric_z"}


def test_the_centre_of_mass_is_that_of_the_material_and_not_of_the_box() -> None:
    ell = fuse(box((40, 10, 10)), box((10, 10, 30)))  # 4000 and 2000 mm3 above it
    found = model(ell)
    assert found.center_of_mass == pytest.approx(((4 * 20 + 2 * 5) / 6 * MM, 5 * MM, (4 * 5 + 2 * 20) / 6 * MM))
    assert found.center == pytest.approx((20 * MM, 5 * MM, 15 * MM))


def test_the_inertia_of_a_block_is_that_of_the_textbook() -> None:
    found = model(box((10, 20, 30), (100, 200, 300)))
    mass = 6000 * MM**3
    wanted = [mass * (a**2 + b**2) / 12 * MM**2 for a, b in ((20, 30), (10, 30), (10, 20))]
    assert found.inertia is not None
    assert [found.inertia[i][i] for i in range(3)] == pytest.approx(wanted, rel=1e-9)
    assert max(abs(found.inertia[i][j]) for i in range(3) for j in range(3) if i != j) < 1e-9 * wanted[0]


def test_products_of_inertia_have_a_minus_sign() -> None:
    """Two cubes at (+, +) and (-, -): the sum of x y is positive, and the entry negative."""
    found = model(compound(box((2, 2, 2), (4, 4, -1)), box((2, 2, 2), (-6, -6, -1))))
    assert found.inertia is not None
    assert found.inertia[0][1] == pytest.approx(-2 * 8 * MM**3 * (5 * MM) ** 2)
    assert found.inertia[2][2] == pytest.approx(2 * 8 * MM**3 * (4 / 6 + 50) * MM**2)


def test_instances_of_one_product_have_each_their_own_place(tmp_path: Path) -> None:
    ell = fuse(box((40, 10, 10)), box((10, 10, 30)))
    turn, shift = gp_Trsf(), gp_Trsf()
    turn.SetRotation(gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1)), math.radians(90))
    shift.SetTranslation(gp_Vec(100, 0, 0))
    placed = ell.Located(TopLoc_Location(shift.Multiplied(turn)))
    copied = BRepBuilderAPI_Transform(ell, shift.Multiplied(turn), True).Shape()
    file = write_step(tmp_path / "instances.step", compound(ell, placed, copied))
    first, second, third = ingest(file, ModelStore(tmp_path / "store")).load_model().shape.bodies
    assert second.center_of_mass == pytest.approx(third.center_of_mass)
    assert second.inertia is not None
    assert third.inertia is not None
    assert first.inertia is not None
    assert [v for row in second.inertia for v in row] == pytest.approx([v for row in third.inertia for v in row])
    assert second.inertia[0][0] == pytest.approx(first.inertia[1][1])
    assert same(second.mirror_planes, [X])


def test_loose_surfaces_have_no_centre_of_mass() -> None:
    from OCP.TopAbs import TopAbs_ShapeEnum

    from querycad_segworker.brep.step import subshapes

    sides = subshapes(box((10, 20, 30)), TopAbs_ShapeEnum.TopAbs_FACE)
    assert model(compound(*sides[:3])).center_of_mass is None
