"""Uploading: what is kept, what is refused, and how a model comes to be ready."""

from __future__ import annotations

import base64
import gzip
import hashlib
import json
import socket
import tempfile
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import httpx
import pytest
from fastapi import FastAPI, Request, Response
from redis import Redis
from starlette.middleware.gzip import GZipMiddleware

from querycad_api.models.drawings import whole
from querycad_api.models.uploads import shown_name
from querycad_api.ops.delivery import Tagged
from querycad_api.problems import add_handlers
from querycad_api.settings import ApiSettings
from querycad_api.store.ledger import Ledger
from querycad_api.store.state import READ_S
from querycad_contracts import (
    NO_ACCOUNTS,
    ModelSummary,
    Queue,
    ReadingStage,
    Shape,
    TaskFailure,
    TaskFailureKind,
    TaskName,
    TaskOutcome,
    alive_key,
    stage_key,
)

STEP = b"ISO-10303-21;\nHEADER;\nENDSEC;\nEND-ISO-10303-21;\n"
SHA256 = hashlib.sha256(STEP).hexdigest()
BOX = Shape(name="box", center=(0, 0, 0), extents=(1, 1, 1), volume=1, area=6, bodies=(), face_count=6)
SUMMARY = ModelSummary(shape=BOX, body_count=1, part_counts={"hole": 2}, warnings=(), timings_ms={})


def upload(client: httpx.Client, content: bytes = STEP, name: str = "box.step", **headers: str) -> Any:
    return client.post("/v1/models", files={"file": (name, content)}, headers=headers)


def queued(redis: Redis, queue: Queue) -> list[str]:
    messages: Any = redis.lrange(queue.value, 0, -1)
    return [json.loads(message)["headers"]["task"] for message in messages]


def problem(response: Any, status: int) -> dict[str, Any]:
    assert response.status_code == status
    assert response.headers["content-type"] == "application/problem+json"
    found: dict[str, Any] = response.json()
    assert found["status"] == status
    return found


def test_an_upload_is_kept_under_its_hash_and_put_on_the_queue(
    client: httpx.Client, settings: ApiSettings, redis: Redis
) -> None:
    response = upload(client)
    assert response.status_code == 202
    assert response.headers["location"] == f"/v1/models/{SHA256}"
    assert (response.json()["id"], response.json()["status"]) == (SHA256, "reading")
    assert settings.upload(SHA256).read_bytes() == STEP
    assert queued(redis, Queue.INGEST) == [TaskName.INGEST]


def test_the_same_file_twice_is_one_model_read_once(client: httpx.Client, redis: Redis) -> None:
    first, second = upload(client), upload(client, name="copy.step")
    assert first.json() == second.json()
    assert len(queued(redis, Queue.INGEST)) == 1


def test_a_file_that_waits_tells_its_place_and_one_that_is_read_its_stage(client: httpx.Client, redis: Redis) -> None:
    other = STEP + b"/* another */"
    upload(client)
    second = upload(client, other).json()["id"]
    places = [client.get(f"/v1/models/{model}").json() for model in (SHA256, second)]
    assert [(place["stage"], place["ahead"]) for place in places] == [(None, 0), (None, 1)]
    redis.set(stage_key(second), ReadingStage.MEASURE.value)
    found = client.get(f"/v1/models/{second}").json()
    assert (found["stage"], found["ahead"]) == ("measure", None)
    assert client.delete(f"/v1/models/{second}").status_code == 204
    upload(client, other)
    assert client.get(f"/v1/models/{second}").json()["stage"] is None  # it begins anew


def test_a_face_that_the_model_lacks_is_told_without_asking_a_worker(client: httpx.Client, ledger: Ledger) -> None:
    upload(client)
    ledger.finish_model(NO_ACCOUNTS, SHA256, TaskOutcome[ModelSummary](value=SUMMARY))
    assert "no face 6" in problem(client.get(f"/v1/models/{SHA256}/faces?id=0&id=6"), 404)["detail"]
    for query in ("", "?id=-1", "?id=x"):
        problem(client.get(f"/v1/models/{SHA256}/faces{query}"), 400)


def test_a_model_that_was_read_says_what_it_holds(client: httpx.Client, ledger: Ledger) -> None:
    upload(client)
    ledger.finish_model(NO_ACCOUNTS, SHA256, TaskOutcome[ModelSummary](value=SUMMARY))
    found = client.get(f"/v1/models/{SHA256}").json()
    assert (found["status"], found["summary"]["part_counts"]) == ("ready", {"hole": 2})
    assert upload(client).status_code == 200


def test_an_upload_waits_until_its_file_is_read_when_that_is_preferred(client: httpx.Client, ledger: Ledger) -> None:
    def read_once_uploaded() -> None:
        while client.get(f"/v1/models/{SHA256}").status_code != 200:
            time.sleep(0.01)
        ledger.finish_model(NO_ACCOUNTS, SHA256, TaskOutcome[ModelSummary](value=SUMMARY))

    reader = threading.Thread(target=read_once_uploaded)
    reader.start()
    response = upload(client, Prefer="wait=30")
    reader.join()
    assert (response.status_code, response.json()["status"]) == (201, "ready")
    assert response.headers["preference-applied"] == "wait=20", "as long as it is granted"


def test_a_wait_that_is_not_met_is_an_accepted_upload(client: httpx.Client) -> None:
    response = upload(client, Prefer="respond-async, wait=1")
    assert response.status_code == 202
    assert "preference-applied" not in response.headers


def test_a_file_that_cannot_be_read_is_a_failed_model_which_may_be_uploaded_again(
    client: httpx.Client, ledger: Ledger, redis: Redis
) -> None:
    upload(client)
    failure = TaskFailure(kind=TaskFailureKind.FILE, message="it has no geometry")
    ledger.finish_model(NO_ACCOUNTS, SHA256, TaskOutcome[ModelSummary](failure=failure))
    found = client.get(f"/v1/models/{SHA256}").json()
    assert (found["status"], found["failure"]["message"]) == ("failed", "it has no geometry")
    assert problem(client.get(f"/v1/models/{SHA256}/parts"), 422)["detail"] == "it has no geometry"
    assert upload(client).json()["status"] == "reading"
    assert len(queued(redis, Queue.INGEST)) == 2


def test_what_came_of_a_file_that_was_deleted_says_nothing_of_the_same_file_uploaded_anew(
    client: httpx.Client, redis: Redis, ledger: Ledger
) -> None:
    def follow() -> dict[str, Any]:
        (message,) = [json.loads(str(each)) for each in redis.lrange(Queue.INGEST.value, 0, 0)]
        args, _, more = json.loads(base64.b64decode(message["body"]))
        assert args[0]["model"] == SHA256
        followed: dict[str, Any] = more["callbacks"][0]["kwargs"]
        return followed

    upload(client)
    before = follow()
    client.delete(f"/v1/models/{SHA256}")
    upload(client)
    failure = TaskFailure(kind=TaskFailureKind.FILE, message="the file was cut off")
    ledger.finish_model(outcome=TaskOutcome[ModelSummary](failure=failure), **before)
    assert client.get(f"/v1/models/{SHA256}").json()["status"] == "reading"
    ledger.finish_model(outcome=TaskOutcome[ModelSummary](value=SUMMARY), **follow())
    assert client.get(f"/v1/models/{SHA256}").json()["status"] == "ready"


@pytest.mark.parametrize("content", [b"", b"<html>", b"\x1f\x8c\x08", b"solid x", b"ISO-10303-2"])
def test_what_is_no_step_file_is_refused(client: httpx.Client, redis: Redis, content: bytes) -> None:
    assert problem(upload(client, content), 415)["title"] == "Not a STEP file"
    assert redis.keys("querycad:model:*") == []


@pytest.mark.parametrize("before", [b"\xef\xbb\xbf", b"\r\n \n"])
def test_marks_and_blanks_before_the_header_do_no_harm(client: httpx.Client, before: bytes) -> None:
    assert upload(client, before + STEP).status_code == 202


@pytest.mark.parametrize("declared", [True, False])
def test_a_file_that_is_too_large_is_refused_and_leaves_nothing(
    client: httpx.Client, settings: ApiSettings, declared: bool
) -> None:
    content = STEP + b" " * 2 * 2**20
    if declared:
        response = upload(client, content)
    else:
        head = b'--x\r\nContent-Disposition: form-data; name="file"; filename="a.step"\r\n\r\n'
        chunks = iter([head, *(content[i : i + 65536] for i in range(0, len(content), 65536)), b"\r\n--x--\r\n"])
        response = client.post(
            "/v1/models", content=chunks, headers={"Content-Type": "multipart/form-data; boundary=x"}
        )
    refused = problem(response, 413)
    assert "1 MiB" in refused["detail"]
    assert refused["type"] == "urn:querycad:problem:file-too-large"
    assert not [path for path in settings.home.rglob("*") if path.is_file()]


def test_a_file_just_over_the_limit_is_refused(client: httpx.Client, settings: ApiSettings) -> None:
    assert upload(client, STEP.ljust(2**20)).status_code == 202
    problem(upload(client, STEP.ljust(2**20 + 1)), 413)
    assert len([path for path in settings.home.rglob("*") if path.is_file()]) == 1


@pytest.mark.parametrize(
    ("given", "shown"),
    [
        ("a.step", "a.step"),
        ("../../a.step", "a.step"),
        ("C:\\x\\a.step", "a.step"),
        ("a\n\x00b.stp", "ab.stp"),
        ("", "model.step"),
    ],
)
def test_a_file_is_shown_without_folders_and_control_characters(given: str, shown: str) -> None:
    assert shown_name(given) == shown


def test_an_upload_is_put_together_where_files_are_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from querycad_api import app

    found = []
    monkeypatch.setattr(tempfile, "tempdir", None)
    monkeypatch.setattr(app, "start_logging", lambda *_: None)
    monkeypatch.setattr("uvicorn.run", lambda *_, **__: found.append(tempfile.gettempdir()))
    monkeypatch.setenv("QUERYCAD_HOME", str(tmp_path / "home"))
    app.main()
    assert found == [str(tmp_path / "home")]
    assert (tmp_path / "home").is_dir()


CONTENT = bytes(range(256)) * 4096
SIZE = len(CONTENT)
PACKED = gzip.compress(CONTENT, 9)


@pytest.fixture
def file_client(tmp_path: Path, serving: Any) -> Iterator[httpx.Client]:
    """Of a file that is deleted as soon as its response is made."""
    app = FastAPI()
    add_handlers(app)
    app.add_middleware(Tagged)
    app.add_middleware(GZipMiddleware)

    @app.get("/{name}")
    async def drawn(name: str, request: Request) -> Response:
        (tmp_path / name).write_bytes(CONTENT)
        packed = tmp_path / f"{name}.gz"
        packed.write_bytes(PACKED)
        media = {"png": "image/png", "glb": "model/gltf-binary"}[name.rpartition(".")[2]]
        takes_packed = name.endswith(".glb") and "gzip" in request.headers["accept-encoding"]
        response = whole(tmp_path / name, media, "tag", request.headers, packed if takes_packed else None)
        (tmp_path / name).unlink()
        packed.unlink()
        return response

    with serving(app) as client:
        client.headers["Accept-Encoding"] = "identity"
        yield client


@pytest.mark.parametrize("asked", ["nonsense", "bytes=0-1,5-6", "bytes=-", "lines=0-3"])
def test_a_file_comes_whole_where_no_one_range_is_asked_for_and_whoever_deletes_it(
    file_client: httpx.Client, asked: str
) -> None:
    response = file_client.get("/a.png", headers={"Range": asked})
    assert (response.status_code, response.content) == (200, CONTENT)
    assert (response.headers["content-length"], response.headers["accept-ranges"]) == (str(SIZE), "bytes")
    assert "immutable" in response.headers["cache-control"]


@pytest.mark.parametrize(
    ("asked", "first", "end"),
    [
        ("bytes=0-3", 0, 4),
        ("bytes=300000-", 300_000, SIZE),
        ("bytes=-5", SIZE - 5, SIZE),
        (f"bytes=5-{10 * SIZE}", 5, SIZE),
        (f"bytes=-{10 * SIZE}", 0, SIZE),
    ],
)
def test_a_range_of_a_file_comes_alone(file_client: httpx.Client, asked: str, first: int, end: int) -> None:
    response = file_client.get("/a.png", headers={"Range": asked, "If-Range": '"tag"'})
    assert (response.status_code, response.content) == (206, CONTENT[first:end])
    assert response.headers["content-range"] == f"bytes {first}-{end - 1}/{SIZE}"
    other = file_client.get("/a.png", headers={"Range": asked, "If-Range": '"of another file"'})
    assert (other.status_code, other.content) == (200, CONTENT)


@pytest.mark.parametrize("asked", [f"bytes={SIZE}-", "bytes=9-3", "bytes=-0"])
def test_a_range_behind_the_end_is_refused_and_told_the_size(file_client: httpx.Client, asked: str) -> None:
    response = file_client.get("/a.png", headers={"Range": asked})
    problem(response, 416)
    assert response.headers["content-range"] == f"bytes */{SIZE}"


def test_triangles_come_compressed_to_who_takes_that_and_ranges_do_not(file_client: httpx.Client) -> None:
    takes = {"Accept-Encoding": "gzip"}
    compressed = file_client.get("/a.glb", headers=takes)
    assert (compressed.headers["content-encoding"], compressed.content) == ("gzip", CONTENT)
    assert compressed.headers["etag"] == 'W/"tag"'
    assert int(compressed.headers["content-length"]) == len(PACKED), "it is sent as it was compressed before"
    assert "Accept-Encoding" in compressed.headers["vary"]
    part = file_client.get("/a.glb", headers={**takes, "Range": "bytes=0-9999"})
    assert (part.status_code, part.content) == (206, CONTENT[:10_000])
    assert (part.headers.get("content-encoding"), part.headers["etag"]) == (None, '"tag"')
    assert "content-encoding" not in file_client.get("/a.png", headers=takes).headers


@pytest.mark.parametrize(
    ("known", "status"), [('"tag"', 304), ('W/"x", W/"tag"', 304), ("*", 304), ('"x"', 200)], ids=range(4)
)
def test_who_has_a_file_is_told_so(file_client: httpx.Client, known: str, status: int) -> None:
    response = file_client.get("/a.png", headers={"If-None-Match": known})
    assert response.status_code == status
    assert response.content == (b"" if status == 304 else CONTENT)
    assert response.headers["etag"] == '"tag"'


@pytest.mark.parametrize("path", ["/v1/models/", f"/v1/models/{SHA256}/"])
def test_a_path_that_is_none_leads_nowhere_else(client: httpx.Client, path: str) -> None:
    problem(client.get(path, follow_redirects=False), 404)


def test_of_several_files_none_is_lost_unsaid(client: httpx.Client) -> None:
    files = [("file", ("a.step", STEP)), ("file", ("b.step", STEP + b" "))]
    assert "one file" in problem(client.post("/v1/models", files=files), 400)["detail"]
    assert client.get("/v1/models").json()["total"] == 0


def test_a_request_without_a_file_is_not_as_documented(client: httpx.Client) -> None:
    found = problem(client.post("/v1/models", files={"other": ("x.step", STEP)}), 422)
    assert [error["pointer"] for error in found["errors"]] == ["#/file"]
    problem(client.post("/v1/models", data={"file": "x"}), 415)
    problem(client.post("/v1/models", data={"file": "x" * 2000}), 415)
    without_name = problem(client.post("/v1/models", files={"file": (None, "x" * 2000)}), 400)
    assert "file name" in without_name["detail"]
    problem(client.post("/v1/models", content=STEP, headers={"Content-Type": "model/step"}), 415)


@pytest.mark.parametrize("path", ["", "/parts"])
def test_an_unknown_model_is_not_found(client: httpx.Client, path: str) -> None:
    problem(client.get(f"/v1/models/{SHA256}{path}"), 404)
    nowhere = problem(client.get(f"/v1/models/not-a-hash{path}"), 404)
    assert nowhere["errors"][0]["parameter"] == "model_id"


def test_parts_of_a_model_that_is_being_read_come_later(client: httpx.Client) -> None:
    upload(client)
    response = client.get(f"/v1/models/{SHA256}/parts")
    assert problem(response, 409)["retryable"] is True
    assert int(response.headers["retry-after"]) > 0


def test_without_a_store_the_service_is_unavailable_but_alive(settings: ApiSettings, serving: Any) -> None:
    from querycad_api.app import make_app

    lost = settings.model_copy(update={"redis_url": "redis://127.0.0.1:1/0"})
    with serving(make_app(lost)) as client:
        problem(client.get(f"/v1/models/{SHA256}"), 503)
        assert client.get("/livez").status_code == 200
        assert client.get("/readyz").json()["checks"]["store"] is False


def test_a_store_that_says_nothing_is_away(
    settings: ApiSettings, serving: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    from querycad_api import app

    monkeypatch.setattr(app, "SILENCE_S", 0.2 - READ_S)
    monkeypatch.setattr("querycad_api.ops.health.STORE_S", 0.2)
    with socket.create_server(("127.0.0.1", 0)) as silent:  # connections are taken, and nothing is said
        hung = settings.model_copy(update={"redis_url": f"redis://127.0.0.1:{silent.getsockname()[1]}/0"})
        with serving(app.make_app(hung)) as client:
            assert client.get("/readyz").json()["checks"]["store"] is False
            problem(client.get(f"/v1/models/{SHA256}"), 503)


def test_it_is_ready_when_every_queue_has_a_worker(client: httpx.Client, redis: Redis) -> None:
    redis.set(alive_key(Queue.SEGCAD), "seccomp landlock")
    response = client.get("/readyz")
    assert response.status_code == 503
    wanted = {"store": True, "ingest": False, "segcad": True, "pictures": False, "questions": False, "sandbox": False}
    assert response.json()["checks"] == wanted
    assert response.json()["walls_missing"] == {"segcad": ["seccomp", "landlock"]}


def test_a_model_that_is_deleted_while_it_is_read_stops_the_reading(
    client: httpx.Client, redis: Redis, ledger: Ledger
) -> None:
    def told_to_stop() -> list[str]:
        """What all workers are told, by Celery's own broadcast."""
        message = listening.get_message(timeout=5)
        while message is not None and message["type"] != "pmessage":
            message = listening.get_message(timeout=5)
        return [] if message is None else json.loads(base64.b64decode(json.loads(message["data"])["body"]))

    with redis.pubsub() as listening:  # type: ignore[no-untyped-call]
        listening.psubscribe("*celery.pidbox*")
        upload(client)
        (message,) = [json.loads(str(each)) for each in redis.lrange(Queue.INGEST.value, 0, 0)]
        client.delete(f"/v1/models/{SHA256}")
        stop: Any = told_to_stop()
        assert (stop["method"], stop["arguments"]["terminate"]) == ("revoke", True)
        assert stop["arguments"]["task_id"] == [message["headers"]["id"]]
        upload(client)
        ledger.finish_model(NO_ACCOUNTS, SHA256, TaskOutcome[ModelSummary](value=SUMMARY))
        client.delete(f"/v1/models/{SHA256}")
        listening.get_message(timeout=0.5)
        assert listening.get_message(timeout=0.5) is None  # it was read: there is nothing to stop
