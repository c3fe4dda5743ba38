"""The page is for everybody: contrast, names, keyboard, small screens, whatever is shown."""

from __future__ import annotations

import re
from typing import Any

import pytest
from playwright.sync_api import expect
from tests.page.browser import AXE
from tests.page.conftest import Opener, Seen

RULES = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"]
QUESTION = "What is the diameter of the holes visible from the top?"


def violations(page: Seen) -> list[str]:
    """What axe finds, a line for each kind with the first elements."""
    page.page.evaluate(AXE.read_text())
    found: dict[str, Any] = page.page.evaluate("rules => axe.run({runOnly: rules})", RULES)
    assert len(found["passes"]) > 20
    return [
        f"{each['id']}: {[node['html'][:100] + node['failureSummary'][:200] for node in each['nodes'][:3]]}"
        for each in found["violations"]
    ]


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("size", [(1360, 800), (390, 844)], ids=["desk", "phone"])
def test_axe_finds_nothing_in_any_state(
    seen: Opener, assembly_model: str, flange_model: str, scheme: str, size: tuple[int, int]
) -> None:
    page = seen(color_scheme=scheme, viewport={"width": size[0], "height": size[1]}).open()
    expect(page.page.locator(".file").first).to_be_visible()
    assert violations(page) == []
    page.model(assembly_model)
    page.page.click("[data-key=X]")
    page.click(0.5, 0.5)
    for tab in ("holes", "bodies", "description", "ask"):
        page.page.click(f"[data-tab={tab}]")
        expect(page.page.locator(f"#panel-{tab}")).not_to_contain_text("…", timeout=20_000)
        assert violations(page) == [], tab
    page.ask("Who wrote this song?")
    page.ask("What is the diameter of the hole?")
    for summary in page.page.locator("summary").all():
        summary.click()
    page.page.evaluate("() => { document.querySelector('#trouble').hidden = false; }")
    assert violations(page) == []


def test_the_sign_in_field_is_for_everybody_too(seen: Opener) -> None:
    page = seen()
    page.page.route(
        "**/v1/**", lambda route: route.fulfill(status=401, json={"title": "No valid API key", "status": 401})
    )
    page.open()
    expect(page.page.get_by_label("API key")).to_be_visible()
    assert violations(page) == []
    page.errors.clear()


@pytest.mark.parametrize("width", [320, 390, 768])
def test_nothing_is_wider_than_a_small_screen(seen: Opener, flange_model: str, width: int) -> None:
    page = seen(viewport={"width": width, "height": 700}).model(flange_model)
    page.ask(QUESTION)
    page.page.click("[data-tab=holes]")
    expect(page.page.locator("tbody tr")).to_have_count(11)
    assert page.page.evaluate("() => document.documentElement.scrollWidth") <= width
    canvas = page.page.locator("#view canvas").bounding_box()
    assert canvas is not None
    assert canvas["width"] >= min(width, 320) * 0.9


def test_all_can_be_done_without_a_mouse(seen: Opener, flange_model: str) -> None:
    page = seen().model(flange_model)
    press = page.page.keyboard.press
    page.page.evaluate("() => document.activeElement.blur()")
    press("Tab")
    expect(page.page.locator(":focus")).to_have_text("To the question")
    press("Enter")
    page.page.locator("#question").focus()
    page.page.keyboard.type("How many holes are there?")
    press("Enter")
    expect(page.page.locator(".card .answer").first).to_have_text("11")
    page.page.locator("[data-tab=ask]").focus()
    press("ArrowRight")
    expect(page.page.locator("[data-tab=holes]")).to_be_focused()
    expect(page.page.locator("tbody tr")).to_have_count(11)
    press("Tab")
    for _ in range(6):
        if page.page.locator("tbody :focus").count():
            break
        press("Tab")
    expect(page.page.locator("tbody :focus")).to_have_count(1)
    press("Enter")
    expect(page.page.locator("tr[data-selected]")).to_have_count(1)
    assert set(page.lit.values()) >= {"#f0a500"}


def test_the_view_says_in_words_what_it_shows(seen: Opener, flange_model: str) -> None:
    page = seen().model(flange_model)
    page.ask(QUESTION)
    view = page.page.locator("#view canvas")
    expect(view).to_have_attribute("aria-label", re.compile(r"flange\.step in 3D; lit: 27 faces"))
    expect(page.page.locator("#announcer")).to_contain_text("16 mm (each of 8)")
