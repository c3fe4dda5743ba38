"""How the page's files are sent; what the page does is tried in a browser, in tests/page."""

from __future__ import annotations

import re
from pathlib import Path

import httpx
import pytest
from fastapi import FastAPI
from fastapi.testclient import TestClient

from querycad_api.web.endpoints import BUILT, pages

ROOT = Path(__file__).parents[3]
SOURCES = ROOT / "web/src"


@pytest.fixture
def built(tmp_path: Path) -> Path:
    (tmp_path / "assets").mkdir()
    (tmp_path / "index.html").write_text('<script src="./assets/page-1.js"></script>')
    (tmp_path / "assets/page-1.js").write_text("const page = 1;\n" * 100)
    return tmp_path


def served(built: Path) -> TestClient:
    app = FastAPI()
    app.include_router(pages(built))
    return TestClient(app)


def test_the_page_may_load_nothing_from_elsewhere_and_run_nothing_that_is_written_in_it(built: Path) -> None:
    policy = served(built).get("/").headers["content-security-policy"]
    rules = dict(rule.strip().split(" ", 1) for rule in policy.split(";"))
    assert rules["default-src"] == "'none'"
    assert rules["script-src"] == rules["style-src"] == rules["connect-src"] == "'self'"
    assert "unsafe" not in policy
    assert "://" not in policy


def test_files_named_by_their_content_are_kept_by_browsers_and_the_page_is_not(built: Path) -> None:
    client = served(built)
    assert "immutable" in client.get("/assets/page-1.js").headers["cache-control"]
    assert client.get("/").headers["cache-control"] == "no-cache"


def test_files_are_compressed_for_who_accepts_it(built: Path) -> None:
    client = served(built)
    plain = client.get("/assets/page-1.js", headers={"Accept-Encoding": "identity"})
    zipped = client.get("/assets/page-1.js", headers={"Accept-Encoding": "gzip"})
    assert "content-encoding" not in plain.headers
    assert zipped.headers["content-encoding"] == "gzip"
    assert plain.text == zipped.text
    assert int(zipped.headers["content-length"]) < int(plain.headers["content-length"])


def test_no_other_file_is_sent(built: Path) -> None:
    (built / "secret.txt").write_text("x")
    client = served(built)
    for path in ("/assets/other.js", "/assets/..%2Fsecret.txt", "/secret.txt", "/assets/%2e%2e/secret.txt"):
        assert client.get(path).status_code == 404


def test_a_service_without_the_page_says_how_it_is_built(tmp_path: Path) -> None:
    response = served(tmp_path).get("/")
    assert response.status_code == 200
    assert "make web" in response.text


def test_what_is_built_links_its_own_files_alone(client: httpx.Client) -> None:
    if not (BUILT / "index.html").exists():
        pytest.skip("the page is not built: make web")
    page = client.get("/")
    linked = re.findall(r'(?:src|href)="([^"]+)"', page.text)
    files = [each for each in linked if not each.startswith(("data:", "#"))]
    assert {Path(each).suffix for each in files} == {".js", ".css"}
    for each in files:
        assert client.get(f"/{each.removeprefix('./')}").status_code == 200


def test_no_source_makes_markup_of_text() -> None:
    scripts = sorted(SOURCES.rglob("*.ts"))
    assert len(scripts) > 20
    for path in scripts:
        assert not re.search(r"innerHTML|outerHTML|insertAdjacentHTML|document\.write|\beval\(", path.read_text()), path


def test_every_address_that_the_page_calls_exists(client: httpx.Client) -> None:
    described = {re.sub(r"\{\w+\}", "x", path) for path in client.get("/openapi.json").json()["paths"]}
    source = (SOURCES / "api/client.ts").read_text()
    called = {
        "/" + re.sub(r"\$\{\w+(\(\w+\))?\}", "x", path.replace("${of(id)}", "v1/models/x")).partition("?")[0]
        for path in re.findall(r'[`"]((?:v1/|\$\{of\(id\)\})[^`"]*)[`"]', source)
    }
    assert len(called) > 10
    assert called <= described
