"""Modelled threads: a helix around a bore or shaft is told from a plain one, and gives its pitch."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import Found, cut, cylinder, find, plate, turned

MM = 1e-3
PITCH = 2.5

Sweep = Callable[[float, float, float], TopoDS_Shape]


@pytest.fixture(scope="module")
def swept() -> Sweep:
    """Sweeps a truncated triangle along three turns of a helix, from radius `core` to `tip`, from `z` upwards."""
    from build123d import Helix, Polyline, Pos, make_face, sweep  # slow to load: only where a helix is needed

    def sweep_thread(core: float, tip: float, z: float) -> TopoDS_Shape:
        foot = core - 0.1 if tip > core else core + 0.1
        corners = [(foot, -0.42), (tip, -0.06), (tip, 0.06), (foot, 0.42)]
        outline = make_face(Polyline(*[(r, 0, share * PITCH) for r, share in corners], close=True))
        return (Pos(0, 0, z) * sweep(outline, path=Helix(PITCH, 3 * PITCH, core), is_frenet=True)).wrapped

    return sweep_thread


@pytest.fixture(scope="module")
def nut_thread(swept: Sweep) -> Found:
    return find(cut(plate(30, 30, 20), cylinder(4, 20, (0, 0, -20)), swept(4, 4.8, -15)))


@pytest.fixture(scope="module")
def bolt_thread(swept: Sweep) -> Found:
    return find(turned(cut(cylinder(5, 30), swept(5, 4.2, 18)), (1, 2, 3), 35))


def test_a_helix_in_a_bore_is_a_threaded_hole_with_its_pitch_and_core_diameter(nut_thread: Found) -> None:
    hole = nut_thread.hole
    assert "threaded" in hole.tags
    assert hole.label.startswith("threaded through hole")
    assert hole.pitch == pytest.approx(PITCH * MM, rel=1e-3)
    assert hole.diameter == pytest.approx(8 * MM)
    assert hole.depth == pytest.approx(20 * MM)


def test_a_helix_around_a_shaft_is_a_thread_with_its_pitch_and_outer_diameter(bolt_thread: Found) -> None:
    (boss,) = bolt_thread.of("boss")
    assert "threaded" in boss.tags
    assert boss.pitch == pytest.approx(PITCH * MM, rel=1e-3)
    assert [boss.diameter, boss.height] == pytest.approx([10 * MM, 30 * MM])


def test_a_plain_bore_has_no_pitch() -> None:
    hole = find(cut(plate(), cylinder(4, 30, (0, 0, -25)))).hole
    assert hole.pitch is None
    assert "threaded" not in hole.tags


def ringed_bore(wide: float | None) -> Found:
    """A thread drawn as six rings of radius 3.2 in a bore of 2.75, below a counterbore of radius `wide` if any."""
    tools = [cylinder(3.2, 1.0, (0, 0, -18 + 2.0 * i)) for i in range(6)]
    counterbore = [] if wide is None else [cylinder(wide, 4, (0, 0, -4))]
    return find(cut(plate(), cylinder(2.75, 30, (0, 0, -25)), *tools, *counterbore))


@pytest.mark.parametrize(("wide", "steps"), [(None, [2.75]), (6.0, [6.0, 2.75])])
def test_rings_in_a_bore_are_one_thread_and_a_counterbore_above_them_stays(
    wide: float | None, steps: list[float]
) -> None:
    found = ringed_bore(wide)
    assert "threaded" in found.hole.tags
    assert list(found.hole.radii) == pytest.approx([step * MM for step in steps])
    assert ("counterbored" in found.hole.tags) == (wide is not None)
    assert found.of("groove") == []
    assert len(found.of("counterbore")) == (0 if wide is None else 1)
