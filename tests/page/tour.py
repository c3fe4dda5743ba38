"""Takes the pictures of the page in docs/images, and tells how fast a model is drawn.

python -m tests.page.tour: the pictures. python -m tests.page.tour FILE.step: frames a second, 960 x 540 pixels.
"""

from __future__ import annotations

import os
import sys
import tempfile
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
ROUNDS, FRAMES = 5, 90
READ_S = 180.0


def main(files: list[str]) -> None:
    """Starts a service and a browser, and does what is asked."""
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=executable(), args=ARGUMENTS, env=environment())
        home = Path(folder) / "home"
        home.mkdir()
        service = Service(home)
        try:
            service.wait()
            with Client(service.url) as client:
                if files:
                    for name in files:
                        frames(browser, service, client, Path(name))
                else:
                    pictures(browser, service, client)
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


def frames(browser: Browser, service: Service, client: Client, path: Path) -> None:
    """Prints how many frames a second are drawn while the model turns."""
    model = client.upload(path, READ_S).id
    page = shown(browser, service, model)
    width = page.page.evaluate("() => innerWidth - querycad.canvas.clientWidth") + 960
    height = page.page.evaluate("() => innerHeight - querycad.canvas.clientHeight") + 540
    page.page.set_viewport_size({"width": width, "height": height})
    page.page.wait_for_function("() => querycad.canvas.clientWidth === 960 && querycad.canvas.clientHeight === 540")
    size = page.page.evaluate("() => [querycad.canvas.clientWidth, querycad.canvas.clientHeight]")
    busy_s = _busy_s()
    rates = sorted(page.page.evaluate("frames => querycad.spin(frames)", FRAMES) for _ in range(ROUNDS))
    frame_ms = (_busy_s() - busy_s) / (FRAMES * ROUNDS) * 1e3
    drawn = page.page.evaluate("() => [querycad.canvas.width, querycad.canvas.height]")
    count = page.page.evaluate("() => querycad.model.faceCount")
    said = ", ".join(f"{rate:.1f}" for rate in rates)
    cost = f"{frame_ms:.0f} ms of a core each, load {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores"
    sys.stdout.write(f"{path.name}: {count} faces, view {size}, drawn at {drawn}: {said} frames a second; {cost}\n")


def _busy_s() -> float:
    """How long have the browser's processes had a core, altogether? They are those below this one that draw."""
    ours, ticks = {str(os.getpid())}, 0
    for folder in sorted(Path("/proc").glob("[0-9]*"), key=lambda path: int(path.name)):
        try:
            said = (folder / "stat").read_text().rpartition(")")[2].split()
            command = (folder / "cmdline").read_text(errors="replace")
        except OSError:
            continue  # it has ended
        if said[1] in ours:
            ours.add(folder.name)
            ticks += sum(map(int, said[11:13])) if "swiftshader" in command or "--type=renderer" in command else 0
    return ticks / os.sysconf("SC_CLK_TCK")


if __name__ == "__main__":
    main(sys.argv[1:])
