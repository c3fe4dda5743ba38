"""Annotated pictures: the marked parts, and only they, are coloured, numbered and listed."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image
from tests.segworker.meshes import BOTTOM, RIGHT, TOP, box, empty, joined, quads, sphere

from querycad_contracts import Vector
from querycad_segworker.mesh import Mesh
from querycad_segworker.render.palette import part_colors, readable_on
from querycad_segworker.render.pictures import LEGEND_ROWS, Mark, annotate, save_png
from querycad_segworker.render.sheet import Sheet, plain

SIZE = (800, 500)
LEGEND_LEFT = 560  # 30 % of the width belong to the legend


def pixels(image: Image.Image) -> NDArray[np.int64]:
    return np.asarray(image).astype(np.int64)


def hued(image: NDArray[np.int64], color: NDArray[np.uint8]) -> int:
    """How many pixels have the colour's hue at full saturation, however lit?"""
    want = color / np.linalg.norm(color.astype(float))
    length = np.maximum(np.linalg.norm(image, axis=-1), 1)
    return int(((image @ want / length) > 0.9995).sum())


def test_a_marked_face_is_coloured_in_the_view_and_the_legend() -> None:
    colors = part_colors(2)
    image = pixels(annotate(box(), [Mark("top", (TOP,)), Mark("right", (RIGHT,))], "Which?", "These", SIZE))
    assert image.shape == (500, 800, 3)
    for color in colors:
        assert hued(image[:, :LEGEND_LEFT], color) > 4000
        assert hued(image[:, LEGEND_LEFT:], color) > 100


def test_what_is_not_marked_is_neutral_grey() -> None:
    image = pixels(annotate(box(), (), size=SIZE))
    spread = image.max(axis=-1) - image.min(axis=-1)
    view = spread[:420]  # the strip below shows the axes in colour
    assert view.max() <= 12


def test_the_same_picture_is_drawn_every_time() -> None:
    marks = [Mark("top", (TOP,)), Mark("bottom", (BOTTOM,))]
    first, second = (np.asarray(annotate(box(), marks, "q", "a", SIZE)) for _ in range(2))
    assert (first == second).all()


def test_a_part_inside_shines_through_the_outside() -> None:
    mesh = joined(box(), box((-0.2, -0.2, -0.2), (0.2, 0.2, 0.2)))
    inner = tuple(range(6, 12))
    marked = pixels(annotate(mesh, [Mark("core", inner)], size=SIZE))[:420, :LEGEND_LEFT]
    bare = pixels(annotate(mesh, [Mark("nothing", ())], size=SIZE))[:420, :LEGEND_LEFT]
    tinted = marked[..., 2] - marked[..., 0] > 25  # the first colour is a blue
    assert tinted.sum() > 1000
    assert (bare[..., 2] - bare[..., 0] > 25).sum() == 0


def test_parts_on_opposite_sides_are_both_coloured_although_no_view_shows_both() -> None:
    image = pixels(annotate(box(), [Mark("top", (TOP,)), Mark("bottom", (BOTTOM,))], size=SIZE))[:, :LEGEND_LEFT]
    assert all(hued(image, color) > 1500 for color in part_colors(2))


def strip(count: int) -> Mesh:
    """Squares in a row, each a face, seen from the front and above."""
    return quads(*[[[(i, 0, 0), (i + 0.8, 0, 0), (i + 0.8, 0.5, 0.5), (i, 0.5, 0.5)]] for i in range(count)])


def test_all_of_many_parts_are_coloured_but_the_legend_ends() -> None:
    count = LEGEND_ROWS + 4
    image = pixels(annotate(strip(count), [Mark(f"tile {i}", (i,)) for i in range(count)], size=(1000, 800)))
    colors = part_colors(count)
    view, legend = image[:, :680], image[:, 700:]
    listed = [bool((legend == color).all(axis=-1).sum() > 50) for color in colors]
    assert listed == [True] * LEGEND_ROWS + [False] * 4
    assert all((view == color).all(axis=-1).sum() > 50 for color in colors)  # the balloons


@pytest.mark.parametrize("anchor", [None, (0.0, 0.0, 0.5), (0.0, 0.0, -99.0), (99.0, 0.0, 0.5)])
def test_any_anchor_will_do(anchor: Vector | None) -> None:
    image = pixels(annotate(box(), [Mark("top", (TOP,), anchor)], size=SIZE))
    assert (image[:, :LEGEND_LEFT] == part_colors(1)[0]).all(axis=-1).sum() > 50


def test_a_small_part_of_a_large_model_is_enlarged() -> None:
    mesh = joined(box((-1, -1, -1), (1, 1, 1)), box((0.9, -0.98, 1), (0.92, -0.96, 1.02)))
    color = part_colors(1)[0]
    image = pixels(annotate(mesh, [Mark("button", tuple(range(6, 12)))], size=SIZE))[:, :LEGEND_LEFT]
    assert hued(image, color) > 1500  # 2 % of the width would be 40 pixels


def test_ids_without_triangles_an_empty_model_and_no_marks_are_fine() -> None:
    for mesh in (box(), empty()):
        for marks in ([], [Mark("lost", (77,))], [Mark("", ())]):
            assert annotate(mesh, marks, size=SIZE).size == SIZE


def test_a_high_sheet_stacks_its_panels() -> None:
    marks = [Mark("top", (TOP,)), Mark("bottom", (BOTTOM,))]
    image = pixels(annotate(box(), marks, size=(800, 1200)))[:, :LEGEND_LEFT]
    rows = [np.flatnonzero([hued(row[None], color) > 20 for row in image]) for color in part_colors(2)]
    assert rows[0].mean() < 500 < rows[1].mean()


def test_too_small_a_picture_is_refused() -> None:
    with pytest.raises(ValueError, match="800 x 500 at least"):
        annotate(box(), (), size=(799, 500))


def test_a_picture_comes_back_from_its_file(tmp_path: Path) -> None:
    image = annotate(sphere(rings=8), [Mark("ball", (0,))], size=SIZE)
    save_png(image, tmp_path / "picture.png")
    with Image.open(tmp_path / "picture.png") as back:
        assert (np.asarray(back) == np.asarray(image)).all()


def test_part_colours_differ_from_each_other_and_from_grey() -> None:
    colors = part_colors(24).astype(float)
    apart = np.linalg.norm(colors[:, None] - colors[None], axis=-1) + 1e9 * np.eye(24)
    assert apart.min() > 20
    assert (colors.max(axis=1) - colors.min(axis=1)).min() > 60
    assert (part_colors(5) == part_colors(24)[:5]).all()


def test_numbers_are_black_on_light_and_white_on_dark_colours() -> None:
    assert readable_on(np.array([255, 255, 200], dtype=np.uint8)) == (0, 0, 0)
    assert readable_on(np.array([20, 30, 90], dtype=np.uint8)) == (255, 255, 255)


@pytest.mark.parametrize(
    ("given", "drawn"),
    [
        ("5 × 3 mm", "5 x 3 mm"),
        ("⌀ 5.5 mm ± 0.1", "diameter  5.5 mm ± 0.1"),
        ("Größe ≤ 12 mm²", "Grosse <= 12 mm2"),
        ("café – …", "cafe - …"),
        ("孔", "?"),
    ],
)
def test_characters_that_the_font_lacks_are_spelled_out(given: str, drawn: str) -> None:
    assert plain(given) == drawn


def test_a_line_breaks_between_words_but_not_between_number_and_unit() -> None:
    sheet = Sheet(100, 100)
    rows = sheet.wrap("through hole, diameter 12 mm, depth 34 mm", 16, 110, 9)
    assert " ".join(rows) == "through hole, diameter 12 mm, depth 34 mm"
    assert len(rows) > 2
    assert any("12 mm" in row for row in rows)
    assert any("34 mm" in row for row in rows)


def test_text_that_does_not_fit_ends_in_dots() -> None:
    sheet = Sheet(100, 100)
    assert sheet.wrap("one two three four five six seven", 16, 80, 2)[-1].endswith("…")
    (cut,) = sheet.wrap("Donaudampfschifffahrtsgesellschaft", 16, 80, 1)
    assert cut.startswith("Donau")
    assert cut.endswith("…")
    assert sheet.wrap("", 16, 80, 2) == []
