"""Queries of a question go to the segworkers in one call; what is known of a model is asked once."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from redis import Redis
from tests.api.fakes import MODEL, FakeSegworker

from querycad_api.questions.sandbox import SandboxUnavailable
from querycad_api.questions.segworker import SegworkerClient
from querycad_contracts import GroundedBy, GroundTask, PartQuery, Queue, TaskName, queue_of


@pytest.fixture
def segworker(redis_url: str) -> Iterator[FakeSegworker]:
    thread = FakeSegworker(redis_url)
    thread.start()
    yield thread
    thread.stop()


def test_all_queries_of_a_question_are_one_call(redis: Redis, segworker: FakeSegworker) -> None:
    client = SegworkerClient(redis)
    view = client.view(MODEL)
    assert view.whole.kind == "model"
    queries = (PartQuery(noun="hole"), PartQuery(noun="slot"))
    ways = view.ground(queries)
    assert [len(each) > 0 for each in ways] == [True, True]
    assert [task.queries for task in segworker.asked] == [(), queries]
    client.view(MODEL)
    assert len(segworker.asked) == 2


def test_a_store_without_segworkers_is_said_to_be_unavailable(redis: Redis, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("querycad_api.questions.segworker.CALL_S", 0.1)
    with pytest.raises(SandboxUnavailable):
        SegworkerClient(redis).view(MODEL)


def test_looking_does_not_hold_up_what_takes_milliseconds() -> None:
    task = GroundTask(model=MODEL, queries=())
    assert queue_of(TaskName.GROUND, task) is Queue.SEGCAD
    looks = task.model_copy(update={"grounding": GroundedBy.VISION})
    assert queue_of(TaskName.GROUND, looks) is Queue.PICTURES
