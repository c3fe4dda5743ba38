"""What a client of HTTP may rely on, whichever endpoint it calls: HEAD, tags, pages, problems, the reference."""

from __future__ import annotations

import re
from typing import Any

import httpx
import pytest
from redis import Redis
from tests.api.fakes import MODEL, STEP, FakeSandbox
from tests.made import hole

from querycad_api.questions.tasks import Questions
from querycad_api.store.keyspace import key_of
from querycad_api.store.ledger import Ledger
from querycad_contracts import Answer, AnswerRecord, AnswerType, QuestionTask, Status, Unit

QUESTION = {"question": "How many holes are there?"}


def problem(response: httpx.Response, status: int) -> dict[str, Any]:
    assert (response.status_code, response.headers["content-type"]) == (status, "application/problem+json")
    found: dict[str, Any] = response.json()
    assert found["type"].startswith("urn:querycad:problem:")
    assert found["title"]
    return found


@pytest.fixture
def answered(client: httpx.Client, model: str, redis: Redis, ledger: Ledger) -> str:
    """The id of a job whose answer rests on 250 holes."""
    job: str = client.post(f"/v1/models/{model}/questions", json=QUESTION).json()["id"]
    task = QuestionTask.model_validate_json(str(redis.hget(key_of("job", job), "task")))
    record = AnswerRecord(
        question=task.question,
        status=Status.ANSWERED,
        answer=Answer(value=250, type=AnswerType.COUNT, unit=Unit.NONE, text="250"),
        code="solution = 250",
        codegen="parser",
        parts=tuple(hole(number, 0) for number in range(250)),
        timings_ms={},
        warnings=(),
        confidence=0.9,
    )
    ledger.finish_job(task, record, 1.0)
    return job


def test_a_head_is_told_what_a_get_is(client: httpx.Client, model: str) -> None:
    for path in (f"/v1/models/{model}", "/v1/models", "/livez", "/openapi.json", "/docs"):
        head, get = client.head(path), client.get(path)
        assert (head.status_code, head.content) == (200, b"")
        assert head.headers["content-type"] == get.headers["content-type"]
        assert head.headers.get("etag") == get.headers.get("etag")
    assert client.head(f"/v1/models/{'0' * 64}").status_code == 404


def test_a_stream_has_no_head_and_says_what_it_has(client: httpx.Client, answered: str) -> None:
    refused = client.head(f"/v1/jobs/{answered}/events")
    assert (refused.status_code, refused.headers["allow"]) == (405, "GET")
    assert client.request("PATCH", "/v1/models").headers["allow"] == "GET, HEAD, POST"


def test_what_has_not_changed_is_not_sent_again(client: httpx.Client, model: str) -> None:
    path = f"/v1/models/{model}/answers"
    first = client.get(path)
    assert "no-cache" in first.headers["cache-control"]
    again = client.get(path, headers={"If-None-Match": first.headers["etag"]})
    assert (again.status_code, again.content, again.headers["etag"]) == (304, b"", first.headers["etag"])
    client.post(f"/v1/models/{model}/questions", json=QUESTION)
    assert client.get(path, headers={"If-None-Match": first.headers["etag"]}).status_code == 200


def test_a_large_answer_comes_compressed_and_is_the_same(client: httpx.Client, answered: str) -> None:
    plain = client.get(f"/v1/jobs/{answered}", headers={"Accept-Encoding": "identity"})
    small = client.get(f"/v1/jobs/{answered}", headers={"Accept-Encoding": "gzip"})
    assert small.headers["content-encoding"] == "gzip"
    assert int(small.headers["content-length"]) * 5 < len(plain.content)
    assert small.json() == plain.json()


def test_an_answer_tells_its_parts_in_full_by_id_or_in_pages(client: httpx.Client, model: str, answered: str) -> None:
    full = client.get(f"/v1/jobs/{answered}").json()
    assert full["part_ids"] == [part["id"] for part in full["record"]["parts"]]
    assert (full["answer"], full["confidence"]) == (full["record"]["answer"], full["record"]["confidence"])
    ids = client.get(f"/v1/jobs/{answered}", params={"parts": "ids"})
    assert (ids.json()["part_ids"], ids.json()["record"]["parts"]) == (full["part_ids"], [])
    listed = client.get(f"/v1/models/{model}/answers", params={"parts": "ids"}).json()["items"]
    assert listed == [ids.json()]
    found, path = [], full["links"]["parts"]
    while path:
        page = client.get(path)
        assert page.json()["total"] == 250
        found += page.json()["items"]
        path = page.links.get("next", {}).get("url")
    assert found == full["record"]["parts"]
    assert problem(client.get(f"/v1/jobs/{answered}?parts=some"), 400)["errors"][0]["parameter"] == "parts"


def test_every_page_but_the_last_says_where_the_next_is(client: httpx.Client) -> None:
    for number in range(3):
        client.post("/v1/models", files={"file": ("a.step", STEP + b" " * number)})
    first = client.get("/v1/models", params={"limit": 2})
    assert first.headers["link"] == '</v1/models?offset=2&limit=2>; rel="next"'
    second = client.get(first.links["next"]["url"])
    assert (len(second.json()["items"]), "link" in second.headers) == (1, False)


def test_links_lead_somewhere(client: httpx.Client, model: str, answered: str) -> None:
    known = client.get(f"/v1/models/{model}").json()["links"] | client.get(f"/v1/jobs/{answered}").json()["links"]
    assert {"self", "questions", "parts", "view", "glb", "model", "events", "picture"} <= known.keys()
    paths = client.get("/openapi.json").json()["paths"]
    templates = [re.sub(r"{\w+}", "[^/]+", path) for path in paths]
    assert [path for path in known.values() if not any(re.fullmatch(one, path) for one in templates)] == []
    waiting = client.post(f"/v1/models/{model}/questions", json=QUESTION).json()
    assert "picture" not in waiting["links"]
    assert client.post(waiting["links"]["cancel"]).json()["status"] == "done"


def test_what_is_wrong_is_said_in_words_of_json(client: httpx.Client, model: str) -> None:
    body = {"question": "?", "expect": "count", "context": "x", "colour": 1}
    found = problem(client.post(f"/v1/models/{model}/questions", json=body), 422)
    assert {error["pointer"]: error["detail"] for error in found["errors"]} == {
        "#/expect": "Input should be an object",
        "#/context": "Input should be an array",
        "#/colour": "There is no such field",
    }
    assert "openapi.json" in problem(client.get("/v1/model"), 404)["detail"]


@pytest.mark.parametrize(
    ("body", "pointers"),
    [
        ({"questions": [{"question": "a"}, {"question": "a", "unit": "ell"}]}, ["#/questions/1/unit"]),
        ({"questions": [{"question": ""}], "a/b~c d": 1}, ["#/questions/0/question", "#/a~1b~0c%20d"]),
        ([], ["#"]),
    ],
)
def test_what_is_wrong_in_a_body_is_pointed_at(
    client: httpx.Client, model: str, body: object, pointers: list[str]
) -> None:
    found = problem(client.post(f"/v1/models/{model}/questions/batch", json=body), 422)
    told = [error["pointer"] for error in found["errors"]]
    assert set(pointers) <= set(told)
    assert found["type"] == "urn:querycad:problem:not-as-documented"


def test_a_list_is_not_too_short_because_its_items_are_wrong(client: httpx.Client, model: str) -> None:
    path = f"/v1/models/{model}/parameters"
    found = problem(client.post(path, json={"parameters": [{"name": "a b", "type": "length"}]}), 422)
    assert [error["pointer"] for error in found["errors"]] == ["#/parameters/0/name"]
    found = problem(client.post(path, json={"parameters": []}), 422)
    assert [error["pointer"] for error in found["errors"]] == ["#/parameters"]


@pytest.mark.parametrize(
    ("method", "path", "headers", "status"),
    [
        ("POST", f"/v1/models/{MODEL}/questions", {"Content-Type": "text/plain"}, 415),
        ("POST", "/v1/models", {"Content-Type": "application/json"}, 415),
        ("POST", f"/v1/models/{MODEL}/questions", {"Content-Encoding": "gzip"}, 415),
        ("GET", "/v1/models/not-an-id", {}, 404),
        ("GET", "/v1/jobs/not-an-id", {}, 404),
        ("GET", f"/v1/models/{MODEL}/tables/bananas", {}, 404),
        ("GET", f"/v1/models/{MODEL}/views/inside", {}, 404),
        ("GET", f"/v1/models/{MODEL}/parts?kind=banana", {}, 400),
        ("GET", f"/v1/models/{MODEL}", {"Prefer": "wait=abc"}, 400),
        ("GET", f"/v1/models/{MODEL}", {"Prefer": "wait"}, 400),
        ("GET", f"/v1/models/{MODEL}", {"Prefer": "respond-async, wait=-1"}, 400),
        ("GET", f"/v1/models/{MODEL}", {"Prefer": 'handling=strict; foo, wait="0"'}, 200),
    ],
)
def test_a_request_that_is_wrong_is_told_by_the_right_status(
    client: httpx.Client, model: str, method: str, path: str, headers: dict[str, str], status: int
) -> None:
    assert model == MODEL
    response = client.request(method, path, headers=headers, content=b"{}" if method == "POST" else None)
    assert response.status_code == status
    if status != 200:
        problem(response, status)


def test_the_reference_loads_nothing_from_elsewhere(client: httpx.Client) -> None:
    for path in ("/docs", "/redoc"):
        page = client.get(path)
        assert page.status_code == 200
        loaded = re.findall(r'(?:src|href)="([^"]+)"', page.text)
        assert len(loaded) >= 2
        assert [client.get(f"/{each}").status_code for each in loaded] == [200] * len(loaded)
        policy = page.headers["content-security-policy"]
        assert not re.search(r"https?:|\*", policy)
        assert len(re.findall(r"'sha256-", policy)) == len(re.findall(r"<script>", page.text))
    assert "openapi.json" in client.get("/docs").text


def test_a_model_of_an_older_version_is_read_anew_before_it_is_asked_about(
    client: httpx.Client, model: str, redis: Redis, worker: Questions, sandbox: FakeSandbox
) -> None:
    from querycad_api.store.keyspace import READING, ModelStale

    sandbox.error = ModelStale("the file has to be read first")
    job = client.post(f"/v1/models/{model}/questions", json=QUESTION).json()["id"]
    task = QuestionTask.model_validate_json(str(redis.hget(key_of("job", job), "task")))
    assert worker.answer(task) is not None
    assert client.get(f"/v1/models/{model}").json()["status"] == "reading"
    assert client.get(f"/v1/jobs/{job}").json()["status"] == "queued"
    score = redis.zscore(READING, f"local:{model}")
    assert score is not None
    sandbox.error = None
    assert worker.answer(task) is not None  # it goes on waiting until the file has been read


def test_a_stream_s_head_does_not_wait_for_its_next_event(client: httpx.Client, model: str) -> None:
    job = client.post(f"/v1/models/{model}/questions", json=QUESTION).json()["id"]
    path = f"/v1/jobs/{job}/events"
    with client.stream("GET", path) as stream:
        told = next(line for line in stream.iter_lines() if line.startswith("id:"))
    headers = {"Last-Event-ID": told.removeprefix("id:").strip(), "Accept-Encoding": "gzip"}
    with client.stream("GET", path, headers=headers, timeout=2) as stream:  # nobody answers: no event comes
        assert stream.headers["content-type"].startswith("text/event-stream")
        assert "content-encoding" not in stream.headers
