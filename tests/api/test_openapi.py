"""The interface's description is what the code does, and is in the repository."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import yaml

from querycad_api.openapi import openapi_yaml

ROOT = Path(__file__).parents[2]


def operations() -> list[tuple[str, dict[str, Any]]]:
    schema = yaml.safe_load(openapi_yaml())
    return [(f"{method} {path}", each) for path, of in schema["paths"].items() for method, each in of.items()]


def test_the_committed_description_is_the_code_s() -> None:
    assert (ROOT / "openapi.yaml").read_text(encoding="utf-8") == openapi_yaml(), "run `make openapi`"


def test_the_page_about_the_service_lists_every_endpoint_and_no_other() -> None:
    page = (ROOT / "docs/service.md").read_text(encoding="utf-8")
    listed = re.findall(r"`(GET|POST|DELETE) (/[^`?]*?)(?:\?[^`]*)?`(?=[^|]*\|)", page.partition("## API keys")[0])
    pages = {"get /docs", "get /redoc"}  # for people: the description leaves them out
    described = {re.sub(r"\{(\w+?)(?:_id)?\}", r"{\1}", name) for name, _ in operations()}
    named = {f"{method.lower()} {path}".replace("/models/{id}", "/models/{model}") for method, path in listed}
    named = {name.replace("/jobs/{id}", "/jobs/{job}") for name in named}
    assert named == described | pages


def test_every_error_is_documented_as_a_problem() -> None:
    errors = [
        (name, status, tuple(entry["content"]))
        for name, operation in operations()
        for status, entry in operation["responses"].items()
        if status.startswith(("4", "5")) and "readyz" not in name
    ]
    assert len(errors) > 15
    assert {content for _, _, content in errors} == {("application/problem+json",)}, errors


def test_all_that_is_referred_to_is_described() -> None:
    text = openapi_yaml()
    schemas = yaml.safe_load(text)["components"]["schemas"]
    referred = {line.rpartition("/")[2].strip("'") for line in text.splitlines() if "$ref:" in line}
    assert referred <= schemas.keys()
    assert schemas.keys() <= referred


def test_an_answer_has_one_shape_whether_it_is_waited_for_or_not() -> None:
    (ask,) = (operation for name, operation in operations() if name.endswith("/questions"))
    (job,) = (operation for name, operation in operations() if name == "get /v1/jobs/{job_id}")
    answers = [ask["responses"]["200"], ask["responses"]["202"], job["responses"]["200"]]
    assert [each["content"]["application/json"]["schema"] for each in answers] == [
        {"$ref": "#/components/schemas/Job"}
    ] * 3
