"""What a segworker answers: values and failures as data, from the uploaded file on."""

from __future__ import annotations

import gzip
import hashlib
import json
import math
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from celery.exceptions import SoftTimeLimitExceeded
from PIL import Image
from redis import Redis

from querycad_contracts import (
    AnswerRecord,
    GroundedParts,
    GroundTask,
    Part,
    PartQuery,
    ReadingStage,
    Status,
    TaskName,
    reply_key,
)
from querycad_contracts.infrastructure import FolderStore, compressed_name, models_name, picture_name
from querycad_segworker.errors import FileProblem
from querycad_segworker.ingest import ingest
from querycad_segworker.segcad.engines.known import KnownParts
from querycad_segworker.settings import SegworkerSettings
from querycad_segworker.tasks import ModelCache, Tasks, make_tasks
from querycad_segworker.worker import ATTEMPTS, make_app

Table = dict[TaskName, Callable[[dict[str, Any]], dict[str, Any]]]
UNKNOWN = "0" * 64


def table_of(tasks: Tasks) -> Table:
    """The tasks, with what they answer read."""

    def read(work: Callable[[dict[str, Any]], str]) -> Callable[[dict[str, Any]], dict[str, Any]]:
        return lambda payload: dict(json.loads(work(payload)))

    return {name: read(work) for name, work in tasks.table().items()}


def put(settings: SegworkerSettings, content: bytes) -> str:
    model = hashlib.sha256(content).hexdigest()
    settings.upload(model).parent.mkdir(parents=True, exist_ok=True)
    settings.upload(model).write_bytes(content)
    return model


@pytest.fixture(scope="module")
def settings(tmp_path_factory: pytest.TempPathFactory) -> SegworkerSettings:
    return SegworkerSettings(home=tmp_path_factory.mktemp("home"), segworker_models=1)


@pytest.fixture(scope="module")
def table(settings: SegworkerSettings) -> Table:
    return table_of(make_tasks(settings))


@pytest.fixture(scope="module")
def model(settings: SegworkerSettings, table: Table, flange: Path) -> str:
    sha256 = put(settings, flange.read_bytes())
    outcome = table[TaskName.INGEST]({"model": sha256, "file_name": "flange.step"})
    assert outcome["failure"] is None
    return sha256


def test_an_ingest_tells_what_the_file_holds(table: Table, model: str) -> None:
    summary = table[TaskName.INGEST]({"model": model, "file_name": "flange.step"})["value"]
    assert summary["body_count"] == 1
    assert summary["shape"]["extents"][:2] == pytest.approx([0.17, 0.17])
    assert summary["part_counts"]["hole"] == 11
    assert summary["units"] == ["millimetre"]


def test_an_ingest_tells_how_many_bytes_are_kept_of_older_versions_too(
    settings: SegworkerSettings, table: Table, model: str
) -> None:
    folder = settings.models / model[:2] / model

    def kept() -> tuple[int, int]:
        told = table[TaskName.INGEST]({"model": model, "file_name": "flange.step"})["value"]["kept_bytes"]
        return told, sum(path.stat().st_size for path in folder.rglob("*") if path.is_file())

    before, there = kept()
    assert before == there > 100_000
    (folder / "v1").mkdir()
    (folder / "v1" / "model.json").write_text("x" * 1000)
    assert kept() == (before + 1000, there + 1000)
    shutil.rmtree(folder / "v1")


def test_the_user_s_name_of_the_file_is_kept_not_its_hash(
    settings: SegworkerSettings, table: Table, model: str
) -> None:
    kept = make_tasks(settings).cache.artefacts(model).load_model()
    assert kept.file_name == "flange.step"


def test_calls_answer_as_the_model_itself_does(settings: SegworkerSettings, table: Table, model: str) -> None:
    local = make_tasks(settings).cache.finder(model)
    found = table[TaskName.FIND_PARTS]({"model": model, "description": "hole", "sides": ["top"]})["value"]
    assert found == local.find_parts("hole", ["top"]).model_dump(mode="json")  # type: ignore[list-item]
    assert table[TaskName.SHAPE]({"model": model})["value"] == local.shape().model_dump(mode="json")
    faces = table[TaskName.FACES]({"model": model, "ids": [3, 1]})["value"]
    assert [face["id"] for face in faces] == [3, 1]


def test_groundings_come_back_as_the_model_itself_has_them(
    settings: SegworkerSettings, table: Table, model: str
) -> None:
    local = make_tasks(settings).cache.finder(model)
    queries = (PartQuery(noun="hole", plural=True), PartQuery(noun="banana", known=False))
    payload = GroundTask(model=model, queries=queries).model_dump(mode="json")
    found = GroundedParts.model_validate(table[TaskName.GROUND](payload)["value"])
    assert found.whole.kind == "model"
    for mine, theirs in zip(local.ground(queries), found.grounded, strict=True):
        assert [way.features for way in mine] == [way.features for way in theirs]
        assert [[part.id for part in way.parts] for way in mine] == [[part.id for part in way.parts] for way in theirs]
    holes = found.grounded[0][0].parts
    assert len(holes) == 11
    assert all(part.faces == () and part.diameter for part in holes)


class Bucket(FolderStore):
    """A store that two machines share: what it is not given stays on the machine."""

    def __init__(self, home: Path, bucket: Path) -> None:
        super().__init__(home)
        self._bucket = bucket

    def keep(self, name: str, unfinished: Path) -> None:
        (self._bucket / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(unfinished, self._bucket / name)
        super().keep(name, unfinished)

    def fetch(self, name: str) -> Path | None:
        if super().fetch(name) is None and (self._bucket / name).is_file():
            (self.home / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(self._bucket / name, self.home / name)
        return super().fetch(name)


def test_what_vision_saw_on_one_machine_is_in_the_picture_that_another_draws(
    settings: SegworkerSettings, model: str, tmp_path: Path
) -> None:
    artefacts = make_tasks(settings).cache.artefacts(model)
    holes = [part.faces for part in artefacts.load_model().parts if part.kind == "hole"]
    known = KnownParts(len(artefacts.load_faces()), holes)
    machines = []
    for name in ("here", "there"):
        shutil.copytree(settings.home, tmp_path / name)
        cache = ModelCache(settings.model_copy(update={"home": tmp_path / name}), lambda: known.models)
        cache.files = Bucket(tmp_path / name, tmp_path / "bucket")
        machines.append(table_of(Tasks(cache)))
    here, there = machines
    found = here[TaskName.FIND_PARTS]({"model": model, "description": "quux", "grounding": "vision"})["value"]
    assert found["parts"]
    record = AnswerRecord(
        question="?",
        status=Status.ANSWERED,
        answer=None,
        code=None,
        codegen=None,
        parts=[Part.model_validate(part) for part in found["parts"]],
        timings_ms={},
        warnings=[],
    )
    asked = {"model": model, "record": record.model_dump(mode="json"), "name": picture_name("a" * 32)}
    picture = tmp_path / "there" / there[TaskName.PICTURE](asked)["value"]
    with Image.open(picture) as drawn:
        assert drawn.height > 1000 + 1000, "the marked model, and six views below it"
    (sheet,) = (tmp_path / "there").glob("models/*/*/*/sight/*.png")
    assert sheet.read_bytes() in [path.read_bytes() for path in (tmp_path / "bucket").glob("models/*/*/*/sight/*.png")]


@pytest.mark.parametrize("grounding", ["vision", "fused"])
def test_without_weights_geometry_answers_and_says_so(table: Table, model: str, grounding: str) -> None:
    asked = {"model": model, "description": "hole"}
    found = table[TaskName.FIND_PARTS]({**asked, "grounding": grounding})["value"]
    assert found["parts"] == table[TaskName.FIND_PARTS](asked)["value"]["parts"]
    assert found["warnings"][-1].startswith("grounded on geometry alone: no weights")


def test_a_distance_is_measured(table: Table, model: str) -> None:
    found = table[TaskName.FIND_PARTS]({"model": model, "description": "hole"})["value"]["parts"]
    one, other = [part for part in found if part["radius"] == pytest.approx(0.008)][:2]
    gap = table[TaskName.DISTANCE]({"model": model, "part_a": one["id"], "part_b": other["id"]})["value"]
    assert gap == pytest.approx(math.dist(one["center"], other["center"]) - 2 * max(one["radii"]), abs=1e-6)


@pytest.mark.parametrize(
    ("name", "asked"),
    [
        (TaskName.FACES, {"ids": [10**6]}),
        (TaskName.DISTANCE, {"part_a": "hole-1", "part_b": "hole-999"}),
        (TaskName.EDGE_DISTANCE, {"part": "hole-999"}),
    ],
)
def test_an_id_that_the_model_lacks_is_a_failure_not_an_error(
    table: Table, model: str, name: TaskName, asked: dict[str, Any]
) -> None:
    outcome = table[name]({"model": model, **asked})
    assert outcome["value"] is None
    assert outcome["failure"]["kind"] == "unknown_id"


def test_a_measure_that_a_part_has_not_is_told_apart_from_a_fault_of_the_file(table: Table, model: str) -> None:
    failure = table[TaskName.EDGE_DISTANCE]({"model": model, "part": "model-1"})["failure"]
    assert failure["kind"] == "no_measure"
    assert "no plane face" in failure["message"]


def test_faces_are_found_with_the_part_that_they_make(table: Table, model: str) -> None:
    query = {"kind": "cylinder", "convexity": "concave", "radius": 0.027}
    found = table[TaskName.FIND_FACES]({"model": model, "query": query})["value"]
    assert [face["part"] for face in found["faces"]] == ["hole-11"]
    assert found["part"]["faces"] == [face["id"] for face in found["faces"]]
    nothing = table[TaskName.FIND_FACES]({"model": model, "query": {"radius": 7.0}})["value"]
    assert nothing == {"faces": [], "part": None}


def test_an_extent_is_measured(table: Table, model: str) -> None:
    along = {"model": model, "part": "body-1", "direction": [0.6, 0.8, 0.0]}
    assert table[TaskName.EXTENT](along)["value"] == pytest.approx(0.17, abs=1e-7)
    assert table[TaskName.EXTENT]({**along, "part": "body-9"})["failure"]["kind"] == "unknown_id"


def test_parts_come_in_pages(table: Table, model: str) -> None:
    pages = [
        table[TaskName.PARTS]({"model": model, "kind": "hole", "offset": i, "limit": 4})["value"] for i in (0, 4, 8)
    ]
    assert {page["total"] for page in pages} == {11}
    assert [len(page["items"]) for page in pages] == [4, 4, 3]
    assert len({part["id"] for page in pages for part in page["items"]}) == 11


def test_parts_are_given_by_their_ids(table: Table, model: str) -> None:
    page = table[TaskName.PARTS]({"model": model, "ids": ["hole-4", "hole-2", "hole-99"]})["value"]
    assert [part["id"] for part in page["items"]] == ["hole-2", "hole-4"]
    assert page["total"] == 2


def test_every_stage_of_reading_is_told_in_order_and_none_of_a_file_that_is_known(tmp_path: Path, flange: Path) -> None:
    told: list[tuple[str, ReadingStage]] = []
    settings = SegworkerSettings(home=tmp_path)
    model = put(settings, flange.read_bytes())
    table = table_of(make_tasks(settings, lambda *stage: told.append(stage)))
    for _ in range(2):
        assert table[TaskName.INGEST]({"model": model, "file_name": "flange.step"})["failure"] is None
    assert told == [(model, stage) for stage in ReadingStage]


def test_a_model_that_was_never_uploaded_is_a_failure(table: Table) -> None:
    assert "upload" in table[TaskName.SHAPE]({"model": UNKNOWN})["failure"]["message"]


def test_a_bad_file_is_a_failure_that_says_why(settings: SegworkerSettings, table: Table) -> None:
    bad = put(settings, b"ISO-10303-21;\nHEADER;\nENDSEC;\n")
    failure = table[TaskName.INGEST]({"model": bad, "file_name": "bad.step"})["failure"]
    assert failure["kind"] == "file"
    assert "DATA" in failure["message"]


def test_a_file_is_read_anew_by_an_ingest_and_by_nothing_else(settings: SegworkerSettings, model: str) -> None:
    (artefacts,) = settings.models.glob(f"{model[:2]}/{model}/v*")
    artefacts.rename(artefacts.with_name("v1"))  # those of an older version
    anew = table_of(make_tasks(settings))
    for name in (TaskName.SHAPE, TaskName.PARTS, TaskName.GLB):
        assert anew[name]({"model": model})["failure"]["kind"] == "not_read"
    assert not artefacts.exists()
    assert anew[TaskName.INGEST]({"model": model, "file_name": "flange.step"})["failure"] is None
    shape = anew[TaskName.SHAPE]({"model": model})
    assert shape["failure"] is None
    assert shape["value"]["extents"][0] == pytest.approx(0.17)


def test_no_more_models_are_kept_in_memory_than_allowed(settings: SegworkerSettings, model: str, flange: Path) -> None:
    cache = make_tasks(settings).cache
    other = put(settings, flange.read_bytes() + b"\n")
    cache.read(other, "flange.step")
    first = cache.finder(model)
    assert cache.finder(model) is first
    cache.finder(other)
    assert cache.finder(model) is not first


def test_what_is_made_of_a_model_that_was_deleted_meanwhile_goes_too(
    settings: SegworkerSettings, flange: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    deleted = put(settings, flange.read_bytes() + b"\n\n")

    def slow_ingest(*given: Any, **more: Any) -> Any:
        made = ingest(*given, **more)
        settings.upload(deleted).unlink()
        return made

    monkeypatch.setattr("querycad_segworker.tasks.ingest", slow_ingest)
    cache = make_tasks(settings).cache
    outcome = table_of(Tasks(cache))[TaskName.INGEST]({"model": deleted, "file_name": "flange.step"})
    assert "deleted" in outcome["failure"]["message"]
    assert not (settings.home / models_name(deleted)).exists()


def test_a_picture_of_a_model_that_was_deleted_meanwhile_goes_too(settings: SegworkerSettings, flange: Path) -> None:
    deleted = put(settings, flange.read_bytes() + b"\n\n\n")
    cache = make_tasks(settings).cache
    cache.read(deleted, "flange.step")
    name = picture_name("2" * 32)
    cache.made(name, lambda path: Image.new("RGB", (1, 1)).save(path))
    cache.drop_if_deleted(deleted, name)
    assert (settings.home / name).is_file()
    settings.upload(deleted).unlink()
    with pytest.raises(FileProblem, match="deleted"):
        cache.drop_if_deleted(deleted, name)
    assert not (settings.home / name).exists()
    assert not (settings.home / models_name(deleted)).exists()


def test_a_picture_is_drawn_under_its_name(settings: SegworkerSettings, table: Table, model: str) -> None:
    record = AnswerRecord(
        question="?", status=Status.ANSWERED, answer=None, code=None, codegen=None, parts=(), timings_ms={}, warnings=()
    )
    name = picture_name("1" * 32)
    outcome = table[TaskName.PICTURE]({"model": model, "record": record.model_dump(mode="json"), "name": name})
    assert outcome == {"value": name, "failure": None}
    assert (settings.home / name).read_bytes().startswith(b"\x89PNG")
    assert not list(settings.home.glob("draw-*"))


def test_triangles_are_compressed_once(settings: SegworkerSettings, table: Table, model: str) -> None:
    name = table[TaskName.GLB]({"model": model})["value"]
    plain, packed = settings.home / name, settings.home / compressed_name(name)
    assert plain.read_bytes().startswith(b"glTF")
    assert gzip.decompress(packed.read_bytes()) == plain.read_bytes()
    made = packed.stat().st_mtime_ns
    assert table[TaskName.GLB]({"model": model})["value"] == name
    assert packed.stat().st_mtime_ns == made


def test_a_file_whose_workers_die_is_given_up(redis_url: str, settings: SegworkerSettings, model: str) -> None:
    app = make_app(settings.model_copy(update={"redis_url": redis_url}))
    task = app.tasks[TaskName.SHAPE.value]

    def deliver(task_id: str, redelivered: bool) -> dict[str, Any]:
        task.push_request(id=task_id, delivery_info={"redelivered": redelivered})
        task.run({"model": model})
        task.pop_request()
        with Redis.from_url(redis_url) as redis:
            return dict(json.loads(redis.lpop(reply_key(task_id))))

    outcomes = [deliver("deadly", redelivered) for redelivered in (False, *[True] * ATTEMPTS)]
    assert [outcome["failure"] is None for outcome in outcomes] == [True] * ATTEMPTS + [False]
    assert "abandoned" in outcomes[-1]["failure"]["message"]
    assert deliver("another", True)["failure"] is None
    app.close()


def test_who_called_is_told_at_once_of_what_fails(
    redis_url: str, settings: SegworkerSettings, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(_: SegworkerSettings) -> Tasks:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("querycad_segworker.worker.make_tasks", full)
    app = make_app(settings.model_copy(update={"redis_url": redis_url}))
    task = app.tasks[TaskName.SHAPE.value]
    task.push_request(id="flawed", delivery_info={})
    task.run({"model": UNKNOWN})
    with Redis.from_url(redis_url) as redis:
        assert json.loads(redis.lpop(reply_key("flawed")))["failure"]["kind"] == "internal"
    task.pop_request()
    app.close()


def test_what_is_stopped_since_its_model_was_deleted_ends_at_once_and_anything_else_begins_anew(
    redis_url: str, settings: SegworkerSettings, monkeypatch: pytest.MonkeyPatch, flange: Path
) -> None:
    stopped = put(settings, flange.read_bytes() + b"\n\n\n\n")
    deletes = True

    def interrupted(*given: Any, **more: Any) -> Any:
        monkeypatch.setattr("querycad_segworker.tasks.ingest", ingest)
        if deletes:
            settings.upload(stopped).unlink()
        raise SoftTimeLimitExceeded

    app = make_app(settings.model_copy(update={"redis_url": redis_url}))
    task = app.tasks[TaskName.INGEST.value]

    def outcome() -> Any:
        monkeypatch.setattr("querycad_segworker.tasks.ingest", interrupted)
        task.push_request(id="stopped", delivery_info={})
        try:
            return task.run({"model": stopped, "file_name": "flange.step"})
        finally:
            task.pop_request()

    assert "upload its file first" in outcome()["failure"]["message"]
    put(settings, flange.read_bytes() + b"\n\n\n\n")
    deletes = False
    assert outcome()["failure"] is None
    app.close()


def test_what_its_caller_has_abandoned_is_not_begun(redis_url: str, settings: SegworkerSettings, model: str) -> None:
    app = make_app(settings.model_copy(update={"redis_url": redis_url}))
    task = app.tasks[TaskName.SHAPE.value]
    with Redis.from_url(redis_url) as redis:
        redis.rpush(reply_key("abandoned"), "null")
        task.push_request(id="abandoned", delivery_info={})
        task.run({"model": model})
        task.pop_request()
        assert redis.lrange(reply_key("abandoned"), 0, -1) == [b"null"]
    app.close()
