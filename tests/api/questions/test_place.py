"""Eyes in a service: pictures come from segworkers through the store, and what was seen goes back to them."""

from __future__ import annotations

import hashlib
from pathlib import Path
from typing import TypeVar, cast

import pytest
from redis import Redis
from tests.querycad.sidecar_eyes import SidecarEyes

from querycad_answering.eyes.mark_voting import Eyes
from querycad_answering.llm.messages import TimeLimit
from querycad_answering.llm.settings import LlmSettings
from querycad_api.questions.segworker import LOOK_S, SegworkerClient
from querycad_contracts import ModelTask, PictureRequest, Queue, TaskName, TaskOutcome, queue_of
from querycad_contracts.infrastructure import FolderStore
from querycad_segworker.settings import SegworkerSettings
from querycad_segworker.tasks import Tasks, make_tasks

T = TypeVar("T")


class Segworker(SegworkerClient):
    """A client whose segworker is in this process: tasks and outcomes travel as the text that they are in the store."""

    def __init__(self, tasks: Tasks) -> None:
        super().__init__(cast("Redis", None))
        self._table = tasks.table()
        self.queues: list[tuple[TaskName, Queue]] = []

    def call(self, name: TaskName, task: ModelTask, value: type[TaskOutcome[T]], wait_s: float = LOOK_S) -> T:
        self.queues.append((name, queue_of(name, task)))
        outcome = value.model_validate_json(
            self._table[name](type(task).model_validate_json(task.model_dump_json()).model_dump())
        )
        assert outcome.failure is None, outcome.failure
        assert outcome.value is not None
        return outcome.value


@pytest.fixture(scope="module")
def settings(tmp_path_factory: pytest.TempPathFactory) -> SegworkerSettings:
    return SegworkerSettings(home=tmp_path_factory.mktemp("home"))


@pytest.fixture(scope="module")
def model(settings: SegworkerSettings, flange: Path) -> str:
    sha256 = hashlib.sha256(flange.read_bytes()).hexdigest()
    settings.upload(sha256).parent.mkdir(parents=True, exist_ok=True)
    settings.upload(sha256).write_bytes(flange.read_bytes())
    return sha256


def test_a_phrase_is_looked_at_over_the_queue(settings: SegworkerSettings, model: str) -> None:
    tasks = make_tasks(settings)
    tasks.cache.read(model, "flange.step")
    client = Segworker(tasks)
    place = client.place(model, FolderStore(settings.home))
    assert place.find_parts("the maker's logo").seen_by == ""
    eyes = Eyes(LlmSettings(llm_command="x", llm_model="seer"), SidecarEyes(settings.home, ["hole-5"]))
    looked = eyes.look("the maker's logo", place, TimeLimit(600))
    assert [one.part for one in looked.sight.found] == ["hole-5"]
    place.keep_sight(looked.sight)
    found = place.find_parts("the maker's logo")
    assert (found.seen_by, [part.id for part in found.parts]) == ("seer", ["hole-5"])
    assert (TaskName.MARK, Queue.PICTURES) in client.queues
    assert (TaskName.FIND_PARTS, Queue.SEGCAD) in client.queues
    (asked,) = place.marked(PictureRequest(parts=("hole-5", "boss-1")))
    assert place.png(asked.name).startswith(b"\x89PNG")
    with pytest.raises(FileNotFoundError):
        place.png("models/none.png")
