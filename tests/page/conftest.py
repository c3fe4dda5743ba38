"""One service and one browser for all tests of the page."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, ConsoleMessage, Locator, Page, sync_playwright
from tests.page.browser import ARGUMENTS, Missing, environment, executable

from querycad.client import Client
from querycad_contracts import ModelResource

ROOT = Path(__file__).parents[2]
START_S = 120.0
STEP_S = 60.0


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    try:
        path = executable()
    except Missing as missing:
        pytest.skip(str(missing))
    with sync_playwright() as playwright:
        running = playwright.chromium.launch(executable_path=path, args=ARGUMENTS, env=environment())
        yield running
        running.close()


class Service:
    """One `querycad serve`."""

    def __init__(self, home: Path, **variables: str) -> None:
        self.home = home
        self.log = home.parent / f"{home.name}.log"
        inherited = {name: value for name, value in os.environ.items() if not name.startswith("QUERYCAD_")}
        self.environment = {**inherited, "QUERYCAD_HOME": str(home), **variables}
        with self.log.open("w") as stderr:
            command = [sys.executable, "-m", "querycad.cli", "serve", "--port", "0"]
            self.process = subprocess.Popen(command, env=self.environment, stderr=stderr, text=True)
        self.url = ""

    def wait(self) -> None:
        marker = "ready at "
        deadline = time.monotonic() + START_S
        while marker not in (text := self.log.read_text()):
            assert self.process.poll() is None, text
            assert time.monotonic() < deadline, text
            time.sleep(0.1)
        self.url = text.partition(marker)[2].split()[0]

    def children(self, module: str) -> list[int]:
        """Its processes that run this module."""
        found, parents = [], {self.process.pid}
        for folder in sorted(Path("/proc").glob("[0-9]*"), key=lambda path: int(path.name)):
            try:
                parent = int((folder / "stat").read_text().rpartition(")")[2].split()[1])
                said = (folder / "cmdline").read_bytes().replace(b"\0", b" ").decode()
            except OSError:
                continue  # it has ended
            if parent in parents:
                parents.add(int(folder.name))
                if module in said:
                    found.append(int(folder.name))
        return found

    @contextmanager
    def paused(self, module: str) -> Iterator[None]:
        """While the context lasts, what runs this module does nothing."""
        pids = self.children(module)
        assert pids
        for pid in pids:
            os.kill(pid, signal.SIGSTOP)
        try:
            yield
        finally:
            for pid in pids:
                os.kill(pid, signal.SIGCONT)

    def stop(self) -> None:
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGTERM)
            self.process.wait(STEP_S)


@pytest.fixture(scope="module")
def service(browser: Browser, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Service]:
    home = tmp_path_factory.mktemp("page") / "home"
    home.mkdir()
    running = Service(home)
    try:
        running.wait()
        yield running
    finally:
        running.stop()


@pytest.fixture(scope="module")
def client(service: Service) -> Iterator[Client]:
    with Client(service.url) as connected:
        yield connected


def example(client: Client, name: str) -> ModelResource:
    return client.upload(ROOT / f"examples/{name}.step", STEP_S)


@pytest.fixture(scope="module")
def flange_model(client: Client) -> str:
    return example(client, "flange").id


@pytest.fixture(scope="module")
def assembly_model(client: Client) -> str:
    return example(client, "bearing_assembly").id


class Seen:
    """A page, what went wrong on it, and what is asked of it often."""

    def __init__(self, page: Page, url: str) -> None:
        self.page = page
        self.url = url
        self.errors: list[str] = []
        page.on("console", self._console)
        page.on("pageerror", lambda error: self.errors.append(str(error)))

    def _console(self, message: ConsoleMessage) -> None:
        if message.type == "error":
            self.errors.append(message.text)

    def open(self, place: str = "") -> Seen:
        self.page.goto(f"{self.url}/{place}")
        return self

    def model(self, model: str, more: str = "") -> Seen:
        """Opens a model, and waits until it is drawn."""
        self.open(f"#model={model}{more}")
        return self.drawn()

    def drawn(self) -> Seen:
        self.until("() => Boolean(window.querycad && querycad.model)")
        self.still()
        return self

    def still(self) -> None:
        """Waits until the view rests."""
        self.until(
            """() => new Promise(done => { const pose = querycad.pose;
               setTimeout(() => done(pose === querycad.pose), 250); })"""
        )

    def until(self, script: str, timeout_s: float = STEP_S) -> Any:
        """What the script gives, once it gives something. The page's policy forbids Playwright's own way to wait."""
        deadline = time.monotonic() + timeout_s
        while not (value := self.page.evaluate(script)):
            assert time.monotonic() < deadline, f"not within {timeout_s} s: {script}"
            time.sleep(0.05)
        return value

    def ask(self, question: str) -> Locator:
        """Asks, and waits for what comes of it: its card."""
        before = self.page.locator(".card").count()
        self.page.fill("#question", question)
        self.page.keyboard.press("Enter")
        self.until(f"() => document.querySelectorAll('.card').length > {before}")
        card = self.page.locator(".card").first
        card.locator(".answer, .readings").first.wait_for()
        return card

    @property
    def lit(self) -> dict[int, str]:
        """The colour of each face that is lit."""
        return dict(self.page.evaluate("() => [...querycad.lit]"))

    def pick(self, x: float, y: float) -> int | None:
        """Which face is at this share of the view?"""
        script = """([x, y]) => { const box = querycad.canvas.getBoundingClientRect();
                    return querycad.pick(box.left + x * box.width, box.top + y * box.height)?.face ?? null; }"""
        found: int | None = self.page.evaluate(script, [x, y])
        return found

    def click(self, x: float, y: float) -> None:
        """Clicks at this share of the view."""
        box = self.page.locator("#view canvas").bounding_box()
        assert box is not None
        self.page.mouse.click(box["x"] + x * box["width"], box["y"] + y * box["height"])

    def click_at(self, place: tuple[float, float, float], off: tuple[float, float] = (0, 0)) -> None:
        """Clicks where a place of the file is seen, in metres, or so many pixels away from it."""
        x, y = self.page.evaluate(
            """async place => { for (const _ of [1, 2, 3]) await new Promise(requestAnimationFrame);
               const at = querycad.project(querycad.model.fromMetres(place));
               const box = querycad.canvas.getBoundingClientRect(); return [box.left + at.x, box.top + at.y]; }""",
            list(place),
        )
        self.page.mouse.click(x + off[0], y + off[1])


Opener = Callable[..., Seen]


@pytest.fixture
def seen(browser: Browser, service: Service) -> Iterator[Opener]:
    """Opens browsers of their own, as different users have; at the end nothing may have gone wrong on their pages."""
    opened: list[Seen] = []

    def new(url: str = "", **options: Any) -> Seen:
        context = browser.new_context(**({"viewport": {"width": 1360, "height": 800}} | options))
        context.grant_permissions(["clipboard-read", "clipboard-write"])
        opened.append(Seen(context.new_page(), url or service.url))
        return opened[-1]

    yield new
    errors = [error for each in opened for error in each.errors]
    for each in opened:
        each.page.context.close()
    assert errors == []
