"""Views: as few as show all parts, the usual ones first."""

from __future__ import annotations

import numpy as np
from tests.segworker.meshes import BOTTOM, LEFT, RIGHT, TOP, box, joined, tunnel

from querycad_contracts import Side
from querycad_segworker.render.views import VIEWPOINTS, choose_views, marked_faces
from querycad_segworker.visibility.raycast import Scene


def test_the_usual_isometric_view_is_taken_where_it_shows_all() -> None:
    views = choose_views(Scene(box()), marked_faces(6, [[TOP], [RIGHT]]), 2)
    assert [(view.viewpoint, view.parts) for view in views] == [((1, -1, 1), (0, 1))]


def test_opposite_faces_need_two_views_and_each_part_is_labelled_once() -> None:
    faces = [[TOP], [BOTTOM], [LEFT], [RIGHT]]
    views = choose_views(Scene(box()), marked_faces(6, faces), 4)
    assert len(views) == 2
    assert sorted(part for view in views for part in view.parts) == [0, 1, 2, 3]
    first, second = (np.array(view.viewpoint) for view in views)
    assert first[2] == -second[2]
    assert first[0] == -second[0]


def test_a_side_view_is_taken_where_no_corner_sees_the_part() -> None:
    bottom_of_a_deep_well = box((-0.05, -0.05, -0.99), (0.05, 0.05, -0.9))
    views = choose_views(Scene(joined(tunnel(), bottom_of_a_deep_well)), marked_faces(16, [[10 + TOP]]), 1)
    assert [view.viewpoint for view in views] == [Side.TOP]


def test_a_part_seen_from_nowhere_belongs_to_the_first_view() -> None:
    mesh = joined(box(), box((-0.1, -0.1, -0.1), (0.1, 0.1, 0.1)))
    views = choose_views(Scene(mesh), marked_faces(12, [[6 + TOP], [BOTTOM]]), 2)
    assert len(views) == 1
    assert views[0].parts == (0, 1)


def test_without_parts_the_isometric_view_is_taken() -> None:
    views = choose_views(Scene(box()), marked_faces(6, []), 0)
    assert [(view.viewpoint, view.parts) for view in views] == [(VIEWPOINTS[0], ())]


def test_a_face_of_two_parts_belongs_to_the_first() -> None:
    assert marked_faces(5, [[1, 2], [2, 3]]).tolist() == [-1, 0, 0, 1, -1]
