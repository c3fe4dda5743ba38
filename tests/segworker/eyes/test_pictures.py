"""Pictures with numbered marks: what gets one, how few share a picture, and that a leader ends on its part."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from querycad_contracts import PartKind, Sight, Sighted
from querycad_segworker.eyes.candidates import candidates
from querycad_segworker.eyes.pictures import A_PICTURE, PICTURES, SIZE, draw, plan
from querycad_segworker.ingest import ingest
from querycad_segworker.local import LocalPartFinder
from querycad_segworker.mesh import Mesh
from querycad_segworker.model import ModelStore
from querycad_segworker.visibility.raycast import Scene

ROOT = Path(__file__).parents[3]


@pytest.fixture(scope="module")
def bracket(tmp_path_factory: pytest.TempPathFactory) -> LocalPartFinder:
    return LocalPartFinder(ingest(ROOT / "examples/bracket.step", ModelStore(tmp_path_factory.mktemp("models"))))


def test_every_feature_and_large_free_face_is_a_candidate_once_and_no_edge_or_group_is(
    bracket: LocalPartFinder,
) -> None:
    listed, left = candidates(bracket.model.parts, bracket._faces)
    by_id = {part.id: part for part in bracket.model.parts}
    kinds = {by_id[one.part].kind for one in listed if one.part in by_id}
    assert left == 0
    assert len({one.faces for one in listed}) == len(listed)
    assert PartKind.HOLE in kinds
    assert not kinds & {PartKind.FILLET, PartKind.CHAMFER, PartKind.PATTERN, PartKind.MODEL, PartKind.COUNTERSINK}
    covered = {face for one in listed for face in one.faces}
    large = [face.id for face in bracket._faces if face.area > 0.02 * sum(each.area for each in bracket._faces)]
    assert set(large) <= covered


def test_few_marks_share_a_picture_and_every_candidate_that_is_seen_has_one(bracket: LocalPartFinder) -> None:
    listed, _ = candidates(bracket.model.parts, bracket._faces)
    mesh = Mesh.load(bracket.artefacts.mesh)
    planned = plan(mesh, listed, Scene(mesh, threads=1))
    assert 6 <= len(planned) <= PICTURES
    assert all(1 <= len(one.marks) <= A_PICTURE for one in planned)
    shown = {listed[index].part for one in planned for index in one.marks}
    seen = {part.id for part in bracket.model.parts if part.sides}
    assert {one.part for one in listed if one.part in seen} <= shown


def test_a_leader_ends_on_its_part_and_balloons_stand_apart(bracket: LocalPartFinder) -> None:
    listed, _ = candidates(bracket.model.parts, bracket._faces)
    mesh = Mesh.load(bracket.artefacts.mesh)
    scene = Scene(mesh, threads=1)
    whole = next(one for one in plan(mesh, listed, scene) if not one.enlarged and one.name == "back")
    image, marks = draw(mesh, listed, whole, scene)
    assert image.size == SIZE
    assert {mark.number - 1 for mark in marks} == set(whole.marks)
    assert all(0 < mark.x < SIZE[0] and 0 < mark.y < SIZE[1] for mark in marks)
    apart = [
        np.hypot(one.x - other.x, one.y - other.y) for one in marks for other in marks if one.number < other.number
    ]
    assert min(apart) > 10
    middles = [np.mean(mesh.of_faces(np.array(listed[mark.number - 1].faces)).points_m, axis=0) for mark in marks]
    holes = [i for i, mark in enumerate(marks) if mark.part.startswith("hole-")]
    assert len(holes) > 2
    for axis, places in ((0, [-mark.x for mark in marks]), (2, [-mark.y for mark in marks])):
        drawn, there = np.array(places)[holes], np.array(middles)[holes, axis]
        pixels_per_m = np.ptp(drawn) / np.ptp(there)
        assert np.allclose(drawn - drawn.mean(), (there - there.mean()) * pixels_per_m, atol=8)


def test_pictures_are_drawn_once_and_the_sidecar_says_what_the_numbers_are(bracket: LocalPartFinder) -> None:
    first = bracket.marked()
    stamps = [bracket.picture_file(one.name).stat().st_mtime_ns for one in first]
    assert bracket.marked() == first
    assert [bracket.picture_file(one.name).stat().st_mtime_ns for one in first] == stamps
    assert all(bracket.png(one.name).startswith(b"\x89PNG") for one in first)


def test_what_was_seen_is_kept_by_phrase_and_leads_to_exact_faces(bracket: LocalPartFinder) -> None:
    hole = next(part for part in bracket.model.parts if part.kind is PartKind.HOLE)
    names = tuple(one.name for one in bracket.marked())[:2]
    found = (Sighted(part=hole.id, score=0.8, views=("top",)), Sighted(part="faces-2", score=0.7, views=("back",)))
    assert bracket.look("emblem").seen_by == ""
    bracket.keep_sight(Sight(phrase="emblem", by="eyes-1", found=found, pictures=names))
    seen = bracket.look("emblem")
    assert seen.seen_by == "eyes-1"
    assert {part.id: part.faces for part in seen.parts} == {hole.id: hole.faces, "faces-2": (2,)}
    assert {part.evidence.source for part in seen.parts} == {"vision"}
    assert bracket.artefacts.sight(str(seen.parts[0].evidence.picture)).is_file()
    assert bracket.look("other emblem").seen_by == ""


def test_a_sight_of_parts_that_the_model_does_not_have_is_refused(bracket: LocalPartFinder) -> None:
    for name in ("hole-999", "faces-99999", "../../etc/passwd"):
        with pytest.raises(KeyError):
            bracket.keep_sight(Sight(phrase="x", by="y", found=(Sighted(part=name, score=1.0, views=()),)))
    with pytest.raises(OSError, match=r"passwd|No such file"):
        bracket.png("../../../../../../etc/passwd")
