"""The path from render to merge with perfect networks: known parts come back, through colours, views and masks."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image
from tests.segworker.shapes import Found, cut, cylinder, find, plate, write_step

from querycad_contracts import AnswerRecord, GroundedBy, Side, Status
from querycad_segworker.fusing.vision import networks_in
from querycad_segworker.ingest import ingest
from querycad_segworker.local import LocalPartFinder
from querycad_segworker.model import ModelStore
from querycad_segworker.render.evidence import draw_evidence
from querycad_segworker.segcad.engines.known import KnownParts
from querycad_segworker.segcad.engines.null_models import NULL_MODELS
from querycad_segworker.segcad.inspection.stage_pictures import contact_sheet, draw_view
from querycad_segworker.segcad.pipeline import Looked
from querycad_segworker.segcad.pipeline import find as look_for
from querycad_segworker.segcad.ports import Detection, Masks, VisionModels, VisionOptions
from querycad_segworker.segcad.prune import FaceGraph
from querycad_segworker.visibility.renderer import make_renderer

ROOT = Path(__file__).resolve().parents[3]
SMALL = VisionOptions(width=960, height=540)


def graph(model: Found) -> FaceGraph:
    return FaceGraph(np.array(model.brep.face_pairs, dtype=np.int32).reshape(-1, 2))


@pytest.fixture(scope="module")
def drilled() -> Found:
    """A plate with a wide and a narrow through hole, and a blind one from below."""
    return find(
        cut(
            plate(),
            cylinder(6, 30, (-18, 0, -25)),
            cylinder(3, 30, (0, 0, -25)),
            cylinder(5, 3, (18, 0, -20)),
        )
    )


@pytest.mark.parametrize("views", [6, 8])
def test_each_hole_is_found_once_with_all_its_faces(drilled: Found, views: int) -> None:
    holes = drilled.of("hole")
    models = KnownParts(len(drilled.brep.faces), [hole.faces for hole in holes]).models
    options = VisionOptions(views=8 if views == 8 else 6, width=960, height=540)
    seen = look_for(make_renderer(drilled.mesh), graph(drilled), len(drilled.brep.faces), "hole", models, options)
    assert [set(one.faces) for one in seen.finds] == sorted((set(hole.faces) for hole in holes), key=min)
    assert seen.visibility.pixels.shape == (6, len(drilled.brep.faces))


class Sloppy:
    """A detector and segmenter whose boxes are right and whose masks bleed over every border."""

    def __init__(self, known: KnownParts) -> None:
        self._known = known

    def detect(self, image: NDArray[np.uint8], phrase: str) -> list[Detection]:
        return self._known.detect(image, phrase)

    def segment(self, image: NDArray[np.uint8], boxes: NDArray[np.float32]) -> Masks:
        import cv2

        exact = self._known.segment(image, boxes)
        grown = [cv2.dilate(mask.astype(np.uint8), np.ones((9, 9), np.uint8)) for mask in exact.masks]
        return Masks(np.array(grown, dtype=np.bool_), exact.scores)


def test_masks_that_bleed_over_borders_mean_the_same_faces(drilled: Found) -> None:
    holes = drilled.of("hole")
    sloppy = Sloppy(KnownParts(len(drilled.brep.faces), [hole.faces for hole in holes]))
    models = VisionModels(sloppy, sloppy)
    seen = look_for(make_renderer(drilled.mesh), graph(drilled), len(drilled.brep.faces), "hole", models, SMALL)
    assert [set(one.faces) for one in seen.finds] == sorted((set(hole.faces) for hole in holes), key=min)


def test_boxes_below_the_threshold_are_not_looked_at(drilled: Found) -> None:
    known = KnownParts(len(drilled.brep.faces), [hole.faces for hole in drilled.of("hole")])
    options = VisionOptions(width=320, height=180, box_threshold=1.0)
    seen = look_for(make_renderer(drilled.mesh), graph(drilled), len(drilled.brep.faces), "hole", known.models, options)
    assert seen.finds == ()


def test_every_stage_has_its_picture_and_discarded_masks_are_grey(drilled: Found) -> None:
    everything = KnownParts(len(drilled.brep.faces), [range(len(drilled.brep.faces)), drilled.of("hole")[0].faces])
    renderer = make_renderer(drilled.mesh)
    looked: list[Looked] = []
    options = VisionOptions(width=480, height=270)
    look_for(renderer, graph(drilled), len(drilled.brep.faces), "hole", everything.models, options, looked.append)
    top = next(one for one in looked if one.view.camera.name == "top")
    assert [gone.mask for gone in top.discarded] == [0]
    pictures = draw_view(top, renderer)
    assert all(picture.shape == (270, 480, 3) for picture in pictures.of_stages())
    inside = (top.view.face_id_map >= 0) & ~top.masks.masks[1]
    colors = pictures.masks[inside].astype(int)
    assert np.median(np.ptp(colors, axis=1)) < 40, "grey, but for what shines through"
    assert contact_sheet("hole", [pictures]).height < contact_sheet("hole", [pictures] * 2).height


@pytest.fixture(scope="module")
def ingested(tmp_path_factory: pytest.TempPathFactory) -> LocalPartFinder:
    folder = tmp_path_factory.mktemp("sight")
    shape = cut(plate(), cylinder(6, 30, (-18, 0, -25)), cylinder(5, 10, (18, 0, -20)))
    artefacts = ingest(write_step(folder / "plate.step", shape), ModelStore(folder / "store"))
    faces = [part.faces for part in artefacts.load_model().parts if part.kind == "hole" and "through" in part.tags]
    known = KnownParts(len(artefacts.load_faces()), faces)
    return LocalPartFinder(artefacts, networks=lambda: known.models)


def test_vision_finds_what_geometry_has_no_word_for(ingested: LocalPartFinder) -> None:
    assert not ingested.find_parts("quux").understood
    for mode in (GroundedBy.VISION, GroundedBy.FUSED):
        (part,) = ingested.grounded_by(mode).find_parts("quux").parts
        assert part.evidence.source == "vision"
        assert part.kind == "hole"
        assert part.evidence.picture is not None
    assert ingested.grounded_by(GroundedBy.VISION).find_parts("quux", [Side.LEFT]).parts == ()


def test_an_answer_s_picture_shows_below_what_vision_saw(ingested: LocalPartFinder, tmp_path: Path) -> None:
    record = AnswerRecord(
        question="?",
        status=Status.ANSWERED,
        answer=None,
        code=None,
        codegen=None,
        parts=ingested.grounded_by(GroundedBy.VISION).find_parts("quux").parts,
        timings_ms={},
        warnings=(),
    )
    draw_evidence(ingested.artefacts, record, tmp_path / "picture.png")
    with Image.open(tmp_path / "picture.png") as picture:
        assert picture.width == 1600
        assert picture.height > 1000 + 1000, "the marked model, and six views below it"


def test_fused_keeps_what_geometry_knows_and_says_where_vision_differs(ingested: LocalPartFinder) -> None:
    parts = ingested.grounded_by(GroundedBy.FUSED).find_parts("hole").parts
    assert sorted(part.evidence.source for part in parts) == ["fused", "geometry"]
    assert {part.id for part in parts} == {part.id for part in ingested.find_parts("hole").parts}


def test_absent_weights_are_a_state_that_is_told(ingested: LocalPartFinder, tmp_path: Path) -> None:
    blind = LocalPartFinder(ingested.artefacts, networks=networks_in(tmp_path / "no weights"))
    for mode in (GroundedBy.VISION, GroundedBy.FUSED):
        found = blind.grounded_by(mode).find_parts("hole")
        assert [part.id for part in found.parts] == [part.id for part in ingested.find_parts("hole").parts]
        assert any(warning.startswith("grounded on geometry alone: no weights") for warning in found.warnings)
        missing = blind.grounded_by(mode).find_parts("quux")
        assert not missing.understood
        assert missing.message.startswith(ingested.find_parts("quux").message)
        assert "vision cannot look: no weights" in missing.message


def test_parts_that_were_seen_can_be_measured(ingested: LocalPartFinder) -> None:
    hole = next(part for part in ingested.model.parts if part.kind == "hole")
    same = "faces-" + "+".join(str(face) for face in hole.faces)
    assert ingested.distance(same, hole.id) == 0.0
    with pytest.raises(KeyError):
        ingested.distance("faces-9999", hole.id)


def test_without_networks_nothing_is_seen(drilled: Found) -> None:
    options = VisionOptions(width=320, height=180)
    seen = look_for(make_renderer(drilled.mesh), graph(drilled), len(drilled.brep.faces), "hole", NULL_MODELS, options)
    assert seen.finds == ()
