"""Cameras: the right way up, the whole model inside, and pixels that lead back to the world."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from querycad_contracts import Side, Vector
from querycad_segworker.visibility.cameras import (
    CORNERS,
    Camera,
    box_corners,
    corner_camera,
    isometric_camera,
    off_axis,
    side_camera,
    side_cameras,
)

BOUNDS = np.array([[-1.0, -2.0, -3.0], [4.0, 5.0, 6.0]])
EVERY = [*side_cameras(BOUNDS, 320, 180), *(corner_camera(corner, BOUNDS, 320, 180) for corner in CORNERS)]


@pytest.mark.parametrize(
    ("side", "right", "up"),
    [
        (Side.FRONT, (1, 0, 0), (0, 0, 1)),
        (Side.BACK, (-1, 0, 0), (0, 0, 1)),
        (Side.RIGHT, (0, 1, 0), (0, 0, 1)),
        (Side.LEFT, (0, -1, 0), (0, 0, 1)),
        (Side.TOP, (1, 0, 0), (0, 1, 0)),
        (Side.BOTTOM, (1, 0, 0), (0, -1, 0)),
    ],
)
def test_a_side_is_seen_as_an_engineer_draws_it(side: Side, right: Vector, up: Vector) -> None:
    assert np.allclose(off_axis(side, degrees=0), (right, up, side.outward))


@pytest.mark.parametrize("side", Side)
def test_a_side_camera_stands_one_degree_off_axis(side: Side) -> None:
    camera = side_camera(side, BOUNDS, 320, 180)
    assert np.degrees(np.arccos(np.dot(camera.backward, side.outward))) == pytest.approx(1.0)
    assert np.dot(camera.backward, off_axis(side, degrees=0)[0]) > 0  # towards the right of the image


@pytest.mark.parametrize("camera", EVERY, ids=lambda camera: camera.name)
def test_a_cameras_axes_are_orthonormal_and_right_handed(camera: Camera) -> None:
    assert np.allclose(camera.axes @ camera.axes.T, np.eye(3))
    assert np.linalg.det(camera.axes) == pytest.approx(1.0)


@pytest.mark.parametrize("camera", EVERY, ids=lambda camera: camera.name)
def test_the_box_fills_the_image_up_to_the_margin(camera: Camera) -> None:
    spots = camera.to_pixels(box_corners(BOUNDS))
    low, high = spots.min(axis=0), spots.max(axis=0)
    assert np.allclose((low + high)[:2], (camera.width, camera.height))
    fill = (high - low)[:2] / (camera.width, camera.height)
    assert fill.max() == pytest.approx(0.96)
    assert low[2] > 0
    assert high[2] < camera.range_m


@given(
    st.sampled_from(EVERY),
    st.lists(st.tuples(*[st.floats(-50, 50, allow_subnormal=False)] * 3), min_size=1, max_size=5),
)
def test_pixels_lead_back_to_the_world(camera: Camera, points: list[Vector]) -> None:
    assert np.allclose(camera.to_world(camera.to_pixels(points)), points, atol=1e-9)


def test_rows_run_downwards_and_depth_away_from_the_viewer() -> None:
    camera = side_camera(Side.FRONT, BOUNDS, 320, 180)
    low, high, far = camera.to_pixels([(0, 0, 0), (0, 0, 1), (0, 1, 0)])
    assert high[1] < low[1]
    assert far[2] > low[2]


def test_the_isometric_view_shortens_all_axes_alike_from_above_the_front_right_corner() -> None:
    camera = isometric_camera(BOUNDS, 320, 180)
    assert camera.name == "top front right"
    assert np.allclose(camera.backward, np.array([1, -1, 1]) / np.sqrt(3))
    spots = camera.to_pixels([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)])[:, :2]
    lengths = np.linalg.norm(spots[1:] - spots[0], axis=1)
    assert np.allclose(lengths, lengths[0])


def test_the_eight_corners_differ_and_bear_their_names() -> None:
    assert len(set(CORNERS)) == 8
    cameras = [corner_camera(corner, BOUNDS, 32, 32) for corner in CORNERS]
    assert len({camera.name for camera in cameras}) == 8
    for camera in cameras:
        assert ("top" in camera.name) == (camera.backward[2] > 0)
        assert ("back" in camera.name) == (camera.backward[1] > 0)
        assert ("right" in camera.name) == (camera.backward[0] > 0)


def test_a_focus_fills_the_image_while_the_whole_model_stays_in_depth_range() -> None:
    focus = np.array([(0.0, 0.0, 0.0), (0.1, 0.1, 0.1)])
    camera = corner_camera(CORNERS[0], BOUNDS, 100, 100, focus_m=focus)
    spots = camera.to_pixels(focus)
    assert np.ptp(spots, axis=0)[:2].max() == pytest.approx(96)
    depths = camera.to_pixels(box_corners(BOUNDS))[:, 2]
    assert 0 < depths.min() < depths.max() < camera.range_m


@pytest.mark.parametrize("side", Side)
@pytest.mark.parametrize("extents", [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 0)])
def test_a_flat_or_single_point_model_has_a_camera_too(side: Side, extents: Vector) -> None:
    camera = side_camera(side, [(7, 7, 7), tuple(7 + e for e in extents)], 64, 48)
    assert camera.pixel_m > 0
    assert camera.range_m > 0
    assert np.allclose(camera.to_pixels([np.add((7, 7, 7), np.multiply(extents, 0.5))])[0, :2], (32, 24))


@pytest.mark.parametrize(("width", "height", "margin"), [(0, 5, 0.1), (5, 0, 0.1), (5, 5, 0.5), (5, 5, -0.1)])
def test_an_image_without_pixels_is_refused(width: int, height: int, margin: float) -> None:
    with pytest.raises(ValueError, match="cannot be"):
        side_camera(Side.TOP, BOUNDS, width, height, margin)


def test_bounds_of_another_shape_are_refused() -> None:
    with pytest.raises(ValueError, match=r"\(2, 3\)"):
        side_camera(Side.TOP, np.zeros((3, 2)), 10, 10)
