"""Takes the pictures of the page in docs/images: python -m tests.page.tour."""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from PIL import Image
from playwright.sync_api import Browser, sync_playwright
from tests.page.browser import ARGUMENTS, environment, executable
from tests.page.conftest import ROOT, Seen, Service, example

from querycad.client import Client
from querycad_contracts import AnswerOptions

IMAGES = ROOT / "docs/images"
DESK = {"width": 1360, "height": 800}
PHONE = {"width": 390, "height": 844}


@contextmanager
def stage() -> Iterator[tuple[Browser, Service, Client]]:
    """A browser, and a service of its own for it."""
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=executable(), args=ARGUMENTS, env=environment())
        home = Path(folder) / "home"
        home.mkdir()
        service = Service(home)
        try:
            service.wait()
            with Client(service.url) as client:
                yield browser, service, client
        finally:
            service.stop()
            browser.close()


def shown(browser: Browser, service: Service, model: str, more: str = "", **options: Any) -> Seen:
    context = browser.new_context(**({"viewport": DESK} | options))
    return Seen(context.new_page(), service.url).model(model, more)


def keep(page: Seen, name: str) -> None:
    page.still()
    path = IMAGES / f"page-{name}.png"
    page.page.screenshot(path=path)
    with Image.open(path) as picture:
        picture.convert("RGB").save(path, optimize=True)
    sys.stdout.write(f"{path.relative_to(ROOT)}: {path.stat().st_size // 1024} KiB\n")


def pictures(browser: Browser, service: Service, client: Client) -> None:
    """The main states: an answer, a selection, readings, a section with measures, tables, a phone."""
    flange, assembly = (example(client, name).id for name in ("flange", "bearing_assembly"))

    page = shown(browser, service, flange)
    page.ask("What is the diameter of the holes visible from the top?")
    keep(page, "answer")

    page = shown(browser, service, assembly, color_scheme="dark")
    page.click(0.5, 0.4)
    page.page.locator(".selection").wait_for()
    page.page.wait_for_timeout(500)
    keep(page, "selection")

    question = "What is the diameter of the hole?"
    client.ask(flange, question, options=AnswerOptions(least_confidence=0.99))
    page = shown(browser, service, flange, f"&answer={client.answers(flange).items[0].id}")
    page.page.locator(".reading").nth(1).click()
    page.page.wait_for_timeout(1000)
    keep(page, "readings")

    page = shown(browser, service, assembly)
    page.page.select_option("[data-key=C]", "y")
    page.page.get_by_label("Other half").check()
    page.page.click("[data-key=M]")
    for x in (-0.063, 0.063):  # two of the plate's holes
        page.click_at((x, 0.033, 0.015))
    page.page.locator(".label.center").wait_for()
    page.page.click("[data-tab=description]")
    page.page.locator("#panel-description dl").wait_for()
    keep(page, "section")

    page = shown(browser, service, assembly)
    page.page.click("[data-tab=bodies]")
    page.page.locator("tbody tr").nth(1).get_by_role("button").click()
    page.page.wait_for_timeout(500)
    keep(page, "bill")

    page = shown(browser, service, flange, viewport=PHONE, has_touch=True, device_scale_factor=1)
    page.ask("How deep are the counterbores?")
    page.page.locator("#stage").scroll_into_view_if_needed()
    page.page.evaluate("() => document.querySelector('#stage').scrollIntoView()")
    keep(page, "phone")


if __name__ == "__main__":
    with stage() as (browser, service, client):
        pictures(browser, service, client)
