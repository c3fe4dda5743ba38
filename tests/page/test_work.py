"""Files on their way, services away, keys, several users: what takes time or fails is seen, each by itself."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Route, expect
from tests.page.conftest import ROOT, Opener, Service
from tests.segworker.mesh_files import forms, triangles, write_stl
from tests.segworker.shapes import cut, cylinder, plate

from querycad.client import Client

EXAMPLES = ROOT / "examples"
BROKEN = "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\nENDSEC;\nEND-ISO-10303-21;\n"


def fresh(folder: Path, name: str, source: str = "bracket") -> Path:
    """A file that the service has not seen: an example with a comment of its own."""
    path = folder / name
    path.write_text((EXAMPLES / f"{source}.step").read_text() + f"/* {folder.name} {name} */\n")
    return path


def test_each_of_several_files_has_its_own_outcome(seen: Opener, tmp_path: Path) -> None:
    page = seen().open()
    (tmp_path / "notes.step").write_text("no STEP")
    (tmp_path / "hollow.step").write_text(BROKEN + f"/* {tmp_path} */\n")
    good = [fresh(tmp_path, "first.step"), fresh(tmp_path, "last.step")]
    page.page.set_input_files("#file", [good[0], tmp_path / "notes.step", tmp_path / "hollow.step", good[1]])
    row = page.page.locator(".file")
    expect(row.filter(has_text="notes.step")).to_contain_text("refused: not a STEP file")
    expect(row.filter(has_text="hollow.step")).to_contain_text("not read:", timeout=60_000)
    for path in good:
        expect(row.filter(has_text=path.name)).to_contain_text("KiB", timeout=60_000)
    expect(page.page.locator("#announcer")).not_to_be_empty()
    page.drawn()
    expect(page.page.locator("#model-name")).to_contain_text("first.step")
    page.errors.clear()  # the browser notes that a response was 415


def test_meshes_of_every_kind_are_read_beside_one_that_is_damaged(seen: Opener, tmp_path: Path) -> None:
    page = seen().open()
    corners = triangles(cut(plate(), cylinder(3, 30, (0, 0, -25))), 0.1)
    good = [path for name, path in forms(tmp_path, corners).items() if name in ("stl", "obj", "3mf")]
    bad = write_stl(tmp_path / "short.stl", corners, len(corners) + 5)
    page.page.set_input_files("#file", [good[0], bad, *good[1:]])
    row = page.page.locator(".file")
    for path in good:
        expect(row.filter(has_text=path.name)).to_contain_text("KiB", timeout=60_000)
    expect(row.filter(has_text="short.stl")).to_contain_text("cut short", timeout=60_000)
    page.drawn()
    page.ask("How many holes are there?")
    expect(page.page.locator(".card .answer").first).to_have_text("1")
    page.errors.clear()  # the browser notes that a response was no success


def test_reading_is_seen_by_stage_and_place_and_a_question_waits_for_it(
    seen: Opener, service: Service, tmp_path: Path
) -> None:
    page = seen().open()
    row = page.page.locator(".file")
    with service.paused("querycad_segworker.worker"):
        page.page.set_input_files("#file", [fresh(tmp_path, "one.step", "housing"), fresh(tmp_path, "two.step")])
        expect(row.filter(has_text="two.step")).to_contain_text("waiting")
        page.page.evaluate(
            """() => { window.told = new Set(); new MutationObserver(() => document.querySelectorAll(".file small")
               .forEach(each => told.add(each.textContent))).observe(document.querySelector(".files"),
               {childList: true, subtree: true}); }"""
        )
        page.page.fill("#question", "How many holes are there?")
        page.page.keyboard.press("Enter")
        expect(page.page.locator(".card").first).to_contain_text(re.compile("waiting|being read"))
    expect(row.filter(has_text="one.step")).to_contain_text("KiB", timeout=60_000)
    expect(page.page.locator(".card .answer").first).not_to_be_empty(timeout=60_000)
    told = page.page.evaluate("() => [...told].join(' | ')")
    assert "of 5)" in told
    page.drawn()


SLOW = """() => {
  const before = window.fetch;
  window.fetch = async (address, ...more) => {
    if (/models\\/[0-9a-f]+$/.test(String(address))) await new Promise((resolve) => setTimeout(resolve, 2000));
    return before(address, ...more);
  };
}"""


def test_a_question_that_is_asked_before_its_model_is_open_is_asked_then(seen: Opener, tmp_path: Path) -> None:
    page = seen().open()
    page.page.evaluate(SLOW)
    page.page.set_input_files("#file", fresh(tmp_path, "early.step"))
    page.page.fill("#question", "How many holes are there?")
    page.page.keyboard.press("Enter")
    expect(page.page.get_by_text("Asked as soon as a model is open.").first).to_be_visible()
    expect(page.page.locator(".card .answer").first).not_to_be_empty(timeout=60_000)
    expect(page.page.locator(".card")).to_have_count(1)
    expect(page.page.locator("#question")).to_have_value("")


def test_a_file_that_is_sent_or_read_can_be_stopped(seen: Opener, service: Service, tmp_path: Path) -> None:
    page = seen().open()
    with service.paused("querycad_segworker.worker"):
        page.page.set_input_files("#file", fresh(tmp_path, "unwanted.step"))
        row = page.page.locator(".file").filter(has_text="unwanted.step")
        expect(row).to_contain_text("waiting")
        row.get_by_role("button", name="Stop unwanted.step").click()
        expect(row).to_have_count(0)
    page.errors.clear()


def test_a_model_is_deleted_after_a_question_and_another_tab_is_told(
    seen: Opener, client: Client, tmp_path: Path
) -> None:
    model = client.upload(fresh(tmp_path, "brief.step"), 60.0)
    page, other = seen().model(model.id), seen().model(model.id)
    page.page.on("dialog", lambda dialog: dialog.accept())
    page.page.get_by_role("button", name="Delete brief.step and its answers").click()
    expect(page.page.locator(".file").filter(has_text="brief.step")).to_have_count(0)
    expect(page.page.locator("#model-name")).to_be_empty()
    other.page.fill("#question", "How many holes are there?")
    other.page.keyboard.press("Enter")
    expect(other.page.get_by_role("alert")).to_contain_text("no model with this id")
    other.page.evaluate("() => document.dispatchEvent(new Event('visibilitychange'))")
    expect(other.page.locator(".file").filter(has_text="brief.step")).to_have_count(0)
    other.errors.clear()


def test_two_tabs_ask_about_two_models_at_once(seen: Opener, flange_model: str, assembly_model: str) -> None:
    first, second = seen().model(flange_model), seen().model(assembly_model)
    for page in (first, second):
        page.page.fill("#question", "How many holes are there?")
        page.page.keyboard.press("Enter")
    expect(first.page.locator(".card .answer").first).to_have_text("11")
    expect(second.page.locator(".card .answer").first).not_to_have_text("11")


def test_a_service_that_is_away_is_said_to_be_and_the_page_works_on(seen: Opener, flange_model: str) -> None:
    page = seen().model(flange_model)
    away = {"on": True}

    def route(route: Route) -> None:
        route.abort() if away["on"] else route.continue_()

    page.page.route("**/questions", route)
    page.page.fill("#question", "How many holes are there?")
    page.page.keyboard.press("Enter")
    expect(page.page.get_by_role("alert")).to_contain_text("does not answer")
    away["on"] = False
    expect(page.ask("How many holes are there?").locator(".answer")).to_have_text("11")
    expect(page.page.locator("#trouble")).to_be_hidden()
    page.errors.clear()


def test_a_link_to_a_model_that_is_gone_says_so(seen: Opener) -> None:
    page = seen().open(f"#model={'0' * 64}")
    expect(page.page.get_by_role("alert")).to_contain_text("no model with this id")
    page.errors.clear()


def test_without_webgl_questions_are_answered_all_the_same(seen: Opener, flange_model: str) -> None:
    page = seen()
    page.page.add_init_script("HTMLCanvasElement.prototype.getContext = () => null")
    page.open(f"#model={flange_model}")
    expect(page.page.locator("#view")).to_contain_text("no 3D")
    expect(page.ask("How many holes are there?").locator(".answer")).to_have_text("11")


@pytest.fixture(scope="module")
def guarded(browser: object, tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[Service, str]]:
    """A service that asks for keys, and a key of it."""
    home = tmp_path_factory.mktemp("guarded") / "home"
    home.mkdir()
    inherited = {name: value for name, value in os.environ.items() if not name.startswith("QUERYCAD_")}
    command = [sys.executable, "-m", "querycad.cli", "keys", "create", "--tenant", "acme", "--name", "page"]
    environment = {**inherited, "QUERYCAD_HOME": str(home)}  # a service that asks for keys starts where there is one
    made = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    service = Service(home, QUERYCAD_AUTH="1")
    try:
        service.wait()
        yield service, next(word for word in made.stdout.split() if word.startswith("qc_"))
    finally:
        service.stop()


def test_a_service_with_keys_asks_for_one_in_a_field(seen: Opener, guarded: tuple[Service, str]) -> None:
    service, key = guarded
    page = seen(service.url).open()
    field = page.page.get_by_label("API key")
    expect(field).to_be_focused()
    expect(page.page.locator("#trouble")).to_be_hidden()
    field.fill("qc_wrong")
    page.page.keyboard.press("Enter")
    expect(page.page.locator("#key-hint")).to_contain_text("not valid")
    field.fill(key)
    page.page.keyboard.press("Enter")
    expect(page.page.locator("#sign-in")).to_be_hidden()
    page.page.set_input_files("#file", EXAMPLES / "flange.step")
    page.drawn()
    card = page.ask("What is the diameter of the holes visible from the top?")
    assert len(page.lit) == 27
    card.locator("summary", has_text="Evidence").click()
    expect(card.locator("img")).to_be_visible(timeout=60_000)  # a picture that needs the key, too
    page.page.reload()
    page.drawn()  # the key lasts as long as the tab
    page.page.get_by_role("button", name="Sign out").click()
    expect(page.page.get_by_label("API key")).to_be_visible()
    page.errors.clear()
