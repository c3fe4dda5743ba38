"""Sight beside words: agreement, snapping, disagreement, and who decides."""

from __future__ import annotations

import numpy as np
import pytest

from querycad_contracts import Convexity, Evidence, Face, Grounding, Part, Side, SurfaceKind
from querycad_segworker.fusing.fusion import Sighting, by_vision, fuse, sightings
from querycad_segworker.fusing.region import faces_of_id, region, region_id
from querycad_segworker.segcad.merge import Find
from querycad_segworker.segcad.pipeline import Seen
from querycad_segworker.visibility.faces import FaceVisibility

FACES = tuple(
    Face(
        id=i,
        body=0,
        kind=SurfaceKind.CYLINDER if i % 2 else SurfaceKind.PLANE,
        center=(float(i), 0.0, 0.0),
        extents=(1.0, 1.0, 1.0),
        area=1.0,
        convexity=Convexity.CONCAVE if i % 2 else Convexity.FLAT,
        radius=0.5 if i % 2 else None,
        normal=None if i % 2 else (0.0, 0.0, 1.0),
        axis=(0.0, 0.0, 1.0) if i % 2 else None,
    )
    for i in range(10)
)


def part(name: str, *faces: int, confidence: float = 0.9, sides: tuple[Side, ...] = (Side.TOP,)) -> Part:
    evidence = Evidence(source="geometry", confidence=confidence, reason="round and concave")
    return Part(
        id=name,
        kind="hole",
        label=name,
        faces=faces,
        sides=sides,
        center=(0, 0, 0),
        extents=(1, 1, 1),
        evidence=evidence,
    )


def seen(*finds: Find, pixels: dict[int, int] | None = None) -> Seen:
    """Each face owns 100 pixels from the top, or as many as given, of 0.1 m."""
    counts = np.zeros((6, len(FACES)), dtype=np.int32)
    counts[0] = 100
    for face, count in (pixels or {}).items():
        counts[0, face] = count
    return Seen(finds, FaceVisibility(counts, np.full(6, 0.1)))


def find(*faces: int, score: float = 0.6) -> Find:
    return Find(frozenset(faces), ("top",), score)


def sighting(of: Part, score: float = 0.6) -> Sighting:
    return Sighting(of, score, ("top",), snapped=True)


def grounding(
    *parts: Part, understood: bool = True, message: str = "", sides: tuple[Side, ...] | None = None
) -> Grounding:
    return Grounding(description="hole", sides=sides, parts=parts, understood=understood, message=message)


def test_a_find_snaps_to_the_part_it_mostly_covers() -> None:
    hole, slot = part("hole-1", 1, 2, 3), part("slot-1", 5, 6)
    (one,) = sightings(seen(find(1, 2)), "hole", [slot, hole], FACES)
    assert one.snapped
    assert one.part == hole


def test_visible_area_counts_not_the_number_of_faces() -> None:
    """Face 3 is hidden, face 2 hardly seen: what is seen of the part is face 1."""
    (one,) = sightings(seen(find(1), pixels={2: 5, 3: 0}), "hole", [part("hole-1", 1, 2, 3)], FACES)
    assert one.part.id == "hole-1"


@pytest.mark.parametrize("faces", [(1,), (1, 5, 6, 7)])
def test_a_find_that_covers_no_part_mostly_is_a_part_of_its_own(faces: tuple[int, ...]) -> None:
    (one,) = sightings(seen(find(*faces)), "logo", [part("hole-1", 1, 2, 3)], FACES)
    assert not one.snapped
    assert one.part.faces == faces
    assert one.part.sides == (Side.TOP,)


def test_two_finds_of_one_part_are_one_sighting_with_the_better_score() -> None:
    hole = part("hole-1", 1, 2, 3, 4)
    (one,) = sightings(seen(find(1, 2, 3, score=0.4), find(1, 2, 4, score=0.7)), "hole", [hole], FACES)
    assert one.score == 0.7


def test_an_expected_part_is_preferred_to_one_with_the_same_faces() -> None:
    pocket, hole = part("pocket-1", 1, 2), part("hole-1", 1, 2)
    (one,) = sightings(seen(find(1, 2)), "hole", [pocket, hole], FACES, expected=[hole])
    assert one.part == hole


def test_agreement_raises_confidence_and_is_told() -> None:
    result = fuse(grounding(part("hole-1", 1, confidence=0.9)), [sighting(part("hole-1", 1), 0.6)])
    evidence = result.parts[0].evidence
    assert evidence.source == "fused"
    assert evidence.confidence == pytest.approx(1 - 0.1 * 0.4)
    assert evidence.reason == "round and concave; vision agrees: seen from top, score 0.60"


def test_what_vision_missed_stays_and_says_so() -> None:
    hidden = part("hole-2", 2, sides=())
    result = fuse(grounding(part("hole-1", 1), hidden), [])
    assert [one.id for one in result.parts] == ["hole-1", "hole-2"]
    assert [one.evidence.confidence for one in result.parts] == [0.9, 0.9]
    assert result.parts[0].evidence.reason.endswith("; vision did not find it")
    assert result.parts[1].evidence.reason.endswith("; vision cannot see it: it is hidden from all sides")


def test_what_vision_alone_found_is_reported_not_counted() -> None:
    result = fuse(grounding(part("hole-1", 1)), [sighting(part("hole-1", 1)), sighting(part("slot-1", 5))])
    assert [one.id for one in result.parts] == ["hole-1"]
    assert result.warnings == ("vision takes for 'hole' as well, geometry does not: slot-1 (slot-1)",)


def test_where_geometry_is_half_sure_at_most_vision_chooses() -> None:
    unsure = grounding(part("hole-1", 1, confidence=0.5), part("hole-2", 2, confidence=0.5))
    chosen = fuse(unsure, [sighting(unsure.parts[1])])
    assert [one.id for one in chosen.parts] == ["hole-2"]
    assert chosen.warnings == ("of 2 parts that geometry is not sure of, 1 were also seen",)
    assert len(fuse(unsure, []).parts) == 2


def test_words_that_geometry_does_not_know_are_found_by_sight() -> None:
    unknown = grounding(understood=False, message="'logo' is not a part that is known here")
    result = fuse(unknown, [sighting(part("pocket-1", 5, 6), 0.45)])
    assert result.understood
    assert result.parts[0].evidence.source == "vision"
    assert result.parts[0].evidence.confidence == 0.45
    assert result.parts[0].evidence.reason == "seen from top, score 0.45; it mostly covers pocket-1"
    assert result.warnings == ("found by sight alone: 'logo' is not a part that is known here",)


def test_words_that_neither_knows_stay_missing() -> None:
    unknown = grounding(understood=False, message="'logo' is not a part that is known here")
    result = fuse(unknown, [])
    assert not result.understood
    assert result.message == "'logo' is not a part that is known here; nothing that looks like 'hole' was seen"


def test_only_parts_visible_from_the_asked_sides_are_meant() -> None:
    top, left = part("hole-1", 1), part("hole-2", 2, sides=(Side.LEFT,))
    found = [sighting(top), sighting(left)]
    assert [one.id for one in by_vision("hole", [Side.LEFT], found).parts] == ["hole-2"]
    nothing = by_vision("hole", [Side.BACK], found)
    assert nothing.parts == ()
    assert nothing.message == "nothing that looks like 'hole' was seen visible from back"
    report = fuse(grounding(top, sides=(Side.TOP,)), found)
    assert report.warnings == ()


def test_a_region_has_the_measures_that_its_faces_tell() -> None:
    one = region("logo", [FACES[1], FACES[3], FACES[2]])
    assert one.label == "logo, 3 faces"
    assert one.center == (2.0, 0.0, 0.0)
    assert one.extents == (3.0, 1.0, 1.0)
    assert one.area == 3.0
    assert (one.radius, one.diameter, one.axis) == (0.5, 1.0, (0.0, 0.0, 1.0))
    assert one.normal == (0.0, 0.0, 1.0)


@pytest.mark.parametrize(("faces", "name"), [((3, 4, 5, 12), "faces-3:5+12"), ((7,), "faces-7"), ((0, 2), "faces-0+2")])
def test_the_id_of_a_region_tells_its_faces(faces: tuple[int, ...], name: str) -> None:
    assert region_id(faces) == name
    assert faces_of_id(name) == faces


@pytest.mark.parametrize("name", ["hole-1", "faces-", "faces-a", "faces-1:", "faces-1++2"])
def test_other_ids_tell_no_faces(name: str) -> None:
    assert faces_of_id(name) is None
