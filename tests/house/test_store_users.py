"""The store's users: what docker-compose.yml lets each service do in Redis, tried on a store with these very rules."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
import yaml
from redis import Redis
from redis.exceptions import NoPermissionError
from tests.api.fakes import MODEL, STEP

from querycad_api.accounts.keys import KeyRing
from querycad_api.accounts.schemas import Scope
from querycad_api.app import make_app
from querycad_api.settings import ApiSettings

ROOT = Path(__file__).parents[2]
COMMAND = yaml.safe_load((ROOT / "docker-compose.yml").read_text(encoding="utf-8"))["services"]["redis"]["command"][-1]
RULES = {user: rules.split() for user, rules in re.findall(r'"user (\w+) on >\$\$\w+ ([^"]*)"', COMMAND)}


@pytest.fixture
def store(redis_url: str) -> Iterator[Callable[[str], Redis]]:
    """Connections of the users, by name."""
    opened: list[Redis] = []
    with Redis.from_url(redis_url) as admin:
        for user, rules in RULES.items():
            admin.execute_command("ACL", "SETUSER", user, "reset", "on", ">secret", *rules)

        def as_user(user: str) -> Redis:
            host, port = re.findall(r"(?:@|//)([\w.]+):(\d+)/", redis_url)[0]
            opened.append(Redis(host=host, port=int(port), username=user, password="secret", decode_responses=True))  # noqa: S106
            return opened[-1]

        yield as_user
        for each in opened:
            each.close()
        admin.execute_command("ACL", "DELUSER", *RULES)


def test_the_sandbox_asks_segworkers_and_takes_their_replies(store: Callable[[str], Redis]) -> None:
    sandbox, segworker = store("sandbox"), store("segworker")
    sandbox.ping()
    sandbox.lpush("segcad", "task")
    sandbox.lpush("pictures", "task")
    assert segworker.brpop(["segcad"], 1) == ("segcad", "task")
    segworker.rpush("querycad:reply:1", "answer")
    segworker.expire("querycad:reply:1", 60)
    assert sandbox.blpop(["querycad:reply:1"], 1) == ("querycad:reply:1", "answer")
    sandbox.rpush("querycad:reply:2", "null")
    sandbox.expire("querycad:reply:2", 60)


FORBIDDEN: dict[str, list[Callable[[Redis], Any]]] = {
    "sandbox": [
        lambda redis: redis.rpop("segcad"),  # others' tasks
        lambda redis: redis.lrange("segcad", 0, -1),
        lambda redis: redis.lpush("questions", "task"),
        lambda redis: redis.lpush("ingest", "task"),
        lambda redis: redis.hgetall("querycad:job:1"),  # others' answers
        lambda redis: redis.keys("*"),
        lambda redis: redis.publish("/0.celery.pidbox", "shutdown"),
        lambda redis: redis.eval("return 1", 0),
        lambda redis: redis.flushall(),
        lambda redis: redis.config_get("*"),
        lambda redis: redis.execute_command("ACL", "LIST"),  # type: ignore[no-untyped-call]
    ],
    "segworker": [
        lambda redis: redis.hgetall("querycad:job:1"),
        lambda redis: redis.hgetall("querycad:model:local:1"),
        lambda redis: redis.lrange("questions", 0, -1),
        lambda redis: redis.flushall(),
        lambda redis: redis.config_get("*"),
    ],
    "questions": [
        lambda redis: redis.flushall(),
        lambda redis: redis.config_get("*"),
        lambda redis: redis.keys("*"),
        lambda redis: redis.lrange("segcad", 0, -1),
        lambda redis: redis.lpush("ingest", "task"),
        lambda redis: redis.get("anything"),
        lambda redis: redis.publish("anything", "said"),
    ],
    "api": [
        lambda redis: redis.flushall(),
        lambda redis: redis.config_get("*"),
        lambda redis: redis.shutdown(),
        lambda redis: redis.set("anything", 1),
        lambda redis: redis.publish("anything", "said"),
    ],
}


@pytest.mark.parametrize(("user", "number"), [(user, n) for user, each in FORBIDDEN.items() for n in range(len(each))])
def test_a_user_may_do_no_more(store: Callable[[str], Redis], user: str, number: int) -> None:
    with pytest.raises(NoPermissionError):
        FORBIDDEN[user][number](store(user))


def test_the_api_does_its_work_as_its_user(
    store: Callable[[str], Redis], redis_url: str, tmp_path: Path, serving: Any
) -> None:
    api = store("api")
    api.publish("/0.celery.pidbox", "stop what nobody wants any more")
    api.smembers("_kombu.binding.celery.pidbox")
    place = redis_url.removeprefix("redis://").rpartition("@")[2]
    as_api = f"redis://api:secret@{place}"
    settings = ApiSettings(redis_url=as_api, home=tmp_path, auth=True, sandbox_url="http://127.0.0.1:1")
    key, metrics = (KeyRing(settings.keys).create("acme", scope=scope) for scope in (Scope.ASK, Scope.METRICS))
    with serving(make_app(settings)) as client:
        client.headers["Authorization"] = f"Bearer {key}"
        added = client.post("/v1/models", files={"file": ("a.step", STEP)})
        assert added.status_code == 202, added.text
        asked = client.post(f"/v1/models/{MODEL}/questions", json={"question": "How many?"})
        assert asked.status_code in (202, 409), asked.text
        assert client.get("/v1/models").json()["total"] == 1
        assert client.get("/metrics", headers={"Authorization": f"Bearer {metrics}"}).status_code == 200
        assert client.get("/readyz").json()["checks"]["store"]
        assert client.delete(f"/v1/models/{MODEL}").status_code == 204


def test_every_user_is_tried() -> None:
    assert RULES.keys() == FORBIDDEN.keys()
