"""API keys: hashed at rest, revoked at once, a tenant each; off on loopback alone, where other sites stay out."""

from __future__ import annotations

import stat
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import httpx
import pytest
from redis import Redis
from tests.api.fakes import MODEL, STEP

from querycad_api.accounts.commands import main
from querycad_api.accounts.keys import KeyRing
from querycad_api.accounts.schemas import Scope
from querycad_api.app import make_app
from querycad_api.settings import ApiSettings
from querycad_contracts.infrastructure import upload_name


@pytest.fixture
def guarded(settings: ApiSettings) -> ApiSettings:
    return settings.model_copy(update={"auth": True, "key_questions": 3, "key_rate": "1000/minute"})


@pytest.fixture
def ring(guarded: ApiSettings) -> KeyRing:
    return KeyRing(guarded.keys)


@pytest.fixture
def api(guarded: ApiSettings, serving: Any) -> Iterator[httpx.Client]:
    with serving(make_app(guarded)) as client:
        yield client


def bearer(key: str) -> dict[str, str]:
    return {"Authorization": f"Bearer {key}"}


def upload(api: httpx.Client, key: str, content: bytes = STEP) -> Any:
    return api.post("/v1/models", files={"file": ("box.step", content)}, headers=bearer(key))


def ask(api: httpx.Client, key: str, **headers: str) -> Any:
    body = {"question": "How many holes are there?"}
    return api.post(f"/v1/models/{MODEL}/questions", json=body, headers={**bearer(key), **headers})


def test_without_a_valid_key_nothing_is_told(api: httpx.Client, ring: KeyRing) -> None:
    key = ring.create("acme")
    wrong = key[:-1] + ("A" if key[-1] != "A" else "B")
    for headers in (
        {},
        bearer(wrong),
        bearer("qc_"),
        {"Authorization": "Basic x"},
    ):
        for path in (
            "/v1/models",
            f"/v1/models/{MODEL}",
            f"/v1/jobs/{'0' * 32}",
            f"/v1/jobs/{'0' * 32}/events",
            "/metrics",
        ):
            response = api.get(path, headers=headers)
            assert response.status_code == 401
            assert response.headers["www-authenticate"] == "Bearer"
            assert response.headers["content-type"] == "application/problem+json"
    assert api.get("/v1/models", headers=bearer(key)).json() == {"items": [], "total": 0}
    assert api.get("/livez").status_code == 200


def test_tenants_never_see_each_others_models(api: httpx.Client, ring: KeyRing, guarded: ApiSettings) -> None:
    acme, other = ring.create("acme"), ring.create("other")
    assert upload(api, acme).status_code == 202
    job = ask(api, acme).json()["id"]
    paths = ["", "/parts", "/answers", "/views/top", "/glb", "/faces?id=0", f"/answers/{job}/picture"]
    for path in paths:
        assert api.get(f"/v1/models/{MODEL}{path}", headers=bearer(other)).status_code == 404
    for path in (f"/v1/jobs/{job}", f"/v1/jobs/{job}/events"):
        assert api.get(path, headers=bearer(other)).status_code == 404
    assert api.post(f"/v1/jobs/{job}/cancel", headers=bearer(other)).status_code == 404
    assert api.delete(f"/v1/models/{MODEL}", headers=bearer(other)).status_code == 404
    assert ask(api, other).status_code == 404
    assert api.get("/v1/models", headers=bearer(other)).json()["total"] == 0
    assert api.get(f"/v1/jobs/{job}", headers=bearer(acme)).json()["status"] == "queued"


def test_the_same_file_of_two_tenants_is_two_models_and_one_file(
    api: httpx.Client, ring: KeyRing, guarded: ApiSettings
) -> None:
    acme, other = ring.create("acme"), ring.create("other")
    for key in (acme, other):
        assert upload(api, key).status_code == 202
    file = guarded.home / upload_name(MODEL)
    assert api.delete(f"/v1/models/{MODEL}", headers=bearer(acme)).status_code == 204
    assert api.get(f"/v1/models/{MODEL}", headers=bearer(other)).status_code == 200
    assert file.exists()
    assert api.delete(f"/v1/models/{MODEL}", headers=bearer(other)).status_code == 204
    assert not file.exists()


def test_an_idempotency_key_is_its_tenants_own(api: httpx.Client, ring: KeyRing) -> None:
    jobs = set()
    for key in (ring.create("acme"), ring.create("other")):
        upload(api, key)
        jobs.add(ask(api, key, **{"Idempotency-Key": "1"}).json()["id"])
    assert len(jobs) == 2


def test_a_key_has_so_many_open_questions_and_no_more(api: httpx.Client, ring: KeyRing, redis: Redis) -> None:
    key, another = ring.create("acme"), ring.create("acme")
    upload(api, key)
    jobs = [ask(api, key).json()["id"] for _ in range(3)]
    refused = ask(api, key)
    assert (refused.status_code, refused.json()["retryable"]) == (429, True)
    assert int(refused.headers["retry-after"]) > 0
    assert redis.llen("questions") == 3
    assert ask(api, another).status_code == 202
    api.post(f"/v1/jobs/{jobs[0]}/cancel", headers=bearer(key)).raise_for_status()
    assert ask(api, key).status_code == 202


def test_a_batch_that_no_key_may_have_open_is_not_worth_repeating(api: httpx.Client, ring: KeyRing) -> None:
    key = ring.create("acme")
    model = upload(api, key).json()["id"]

    def batch(size: int) -> Any:
        body = {"questions": [{"question": f"How many holes with {n} steps?"} for n in range(size)]}
        return api.post(f"/v1/models/{model}/questions/batch", json=body, headers=bearer(key))

    refused = batch(4)
    assert (refused.status_code, refused.json()["retryable"]) == (422, False)
    assert "retry-after" not in refused.headers
    assert "at most 3" in refused.json()["detail"]
    assert batch(3).status_code == 202
    assert (batch(1).status_code, batch(1).json()["retryable"]) == (429, True)


def test_a_key_makes_so_many_requests_and_no_more(guarded: ApiSettings, ring: KeyRing, serving: Any) -> None:
    key, another = ring.create("acme"), ring.create("acme")
    with serving(make_app(guarded.model_copy(update={"key_rate": "5/hour"}))) as api:
        statuses = [api.get("/v1/models", headers=bearer(key)).status_code for _ in range(7)]
        assert statuses == [200] * 5 + [429] * 2
        assert api.get("/v1/models", headers=bearer(another)).status_code == 200


def test_a_revoked_key_is_worth_nothing_at_once(api: httpx.Client, ring: KeyRing) -> None:
    key = ring.create("acme")
    assert api.get("/v1/models", headers=bearer(key)).status_code == 200
    assert ring.revoke(key.split("_")[1])
    assert api.get("/v1/models", headers=bearer(key)).status_code == 401


def test_metrics_are_for_a_key_of_their_own(api: httpx.Client, ring: KeyRing) -> None:
    asks, reads = ring.create("acme"), ring.create("ops", scope=Scope.METRICS)
    assert api.get("/metrics", headers=bearer(asks)).status_code == 403
    assert "querycad_waiting_tasks" in api.get("/metrics", headers=bearer(reads)).text
    assert api.get("/v1/models", headers=bearer(reads)).status_code == 403


def test_the_file_of_keys_holds_no_key_and_is_its_owners_alone(ring: KeyRing, guarded: ApiSettings) -> None:
    key = ring.create("acme", "a laptop")
    assert key.split("_", 2)[2] not in guarded.keys.read_text()
    assert stat.S_IMODE(guarded.keys.stat().st_mode) == 0o600
    found = KeyRing(guarded.keys).find(key)
    assert found is not None
    assert (found.tenant, found.name) == ("acme", "a laptop")


def test_keys_are_made_listed_and_revoked_by_a_command(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("QUERYCAD_HOME", str(tmp_path))
    assert main(["create", "--tenant", "acme", "--name", "laptop"]) == 0
    key = capsys.readouterr().out.strip()
    assert KeyRing(tmp_path / "keys.json").find(key) is not None
    assert main(["list"]) == 0
    listed = capsys.readouterr().out
    assert "acme ask" in listed
    assert "laptop" in listed
    assert main(["revoke", key.split("_")[1]]) == 0
    assert KeyRing(tmp_path / "keys.json").find(key) is None
    assert main(["revoke", key.split("_")[1]]) == 2
    assert main(["create", "--tenant", "No Such Name"]) == 2


@pytest.mark.parametrize(
    ("host", "auth", "asked_for"),
    [
        ("127.0.0.1", None, False),
        ("localhost", None, False),
        ("::1", None, False),
        ("127.0.0.1", True, True),
        ("0.0.0.0", None, True),  # noqa: S104 - nothing listens
        ("192.168.1.5", None, True),
        ("example.org", None, True),
    ],
)
def test_keys_are_asked_for_unless_only_this_machine_can_ask(host: str, auth: bool | None, asked_for: bool) -> None:
    assert ApiSettings(api_host=host, auth=auth).asks_for_keys is asked_for


def test_the_api_does_not_start_open_to_others(tmp_path: Path) -> None:
    environment = {"QUERYCAD_API_HOST": "0.0.0.0", "QUERYCAD_AUTH": "0", "QUERYCAD_HOME": str(tmp_path)}  # noqa: S104
    command = [sys.executable, "-m", "querycad_api.app"]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode == 2
    assert "QUERYCAD_AUTH" in done.stderr


@pytest.mark.parametrize(
    "headers",
    [
        {"Origin": "https://evil.example"},
        {"Origin": "null"},
        {"Origin": "http://["},
        {"Host": "evil.example"},
        {"Host": "evil.example:8000"},
        {"Host": "["},
    ],
)
def test_without_keys_other_sites_pages_are_refused(client: httpx.Client, headers: dict[str, str]) -> None:
    assert client.get("/v1/models", headers=headers).status_code == 403
    response = client.post("/v1/models", files={"file": ("a.step", STEP)}, headers=headers)
    assert (response.status_code, response.headers["content-type"]) == (403, "application/problem+json")
    assert "access-control-allow-origin" not in response.headers


def test_the_services_own_page_may_ask(client: httpx.Client) -> None:
    own = str(client.base_url).rstrip("/")
    assert client.get("/v1/models", headers={"Origin": own}).status_code == 200


def test_only_origins_that_are_named_may_ask_from_a_browser(settings: ApiSettings, serving: Any) -> None:
    named = settings.model_copy(update={"cors_origins": "https://cad.example, https://two.example"})
    preflight = {"Access-Control-Request-Method": "POST", "Access-Control-Request-Headers": "prefer"}
    with serving(make_app(named)) as api:
        response = api.get("/v1/models", headers={"Origin": "https://two.example"})
        assert response.headers["access-control-allow-origin"] == "https://two.example"
        assert api.options("/v1/models", headers={"Origin": "https://cad.example", **preflight}).status_code == 200
        assert api.options("/v1/models", headers={"Origin": "https://evil.example", **preflight}).status_code == 400
