"""Questions and answers on the page: asked in words or by a click, followed up, read in several ways, exported."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import pytest
from PIL import Image
from playwright.sync_api import expect
from tests.page.conftest import Opener, Seen, Service

from querycad.client import Client
from querycad_contracts import AnswerOptions, AnswerRecord, Status, TableKind

HOLE = "How many counterbored holes are there?"
MANY = "What is the diameter of the holes?"


def downloaded(page: Seen, button: str, within: str = "body") -> Path:
    with page.page.expect_download() as waiting:
        page.page.locator(within).get_by_role("button", name=button, exact=True).first.click()
    return Path(waiting.value.path())


def picture_width(path: Path) -> int:
    with Image.open(path) as picture:
        return picture.size[0]


def test_a_clicked_face_tells_what_it_is_and_what_it_is_asked_goes_with_it(seen: Opener, flange_model: str) -> None:
    page = seen().model(flange_model)
    page.page.click("[data-side=top]")
    page.still()
    face = page.pick(0.5, 0.5)
    assert face is None  # one looks through the bore
    page.page.click("[data-side=isometric]")
    page.still()
    page.click(0.5, 0.36)
    box = page.page.locator(".selection")
    expect(box).to_contain_text("hole-11, through hole, diameter 54 mm")
    expect(box).to_contain_text("radius 27 mm")
    assert len(page.lit) >= 1
    assert set(page.lit.values()) == {"#f0a500"}
    card = page.ask("How deep is it?")
    expect(card.locator(".answer")).to_contain_text("53 mm")
    page.page.get_by_role("button", name="Clear selection").click()
    expect(box).to_be_hidden()
    page.click(0.5, 0.36)
    box.get_by_role("button", name="What is its diameter?").click()
    card = page.page.locator(".card").first
    expect(card.locator(".answer")).to_contain_text("54 mm")


def test_a_question_leans_on_those_before_until_a_new_conversation_begins(seen: Opener, flange_model: str) -> None:
    page = seen().model(flange_model)
    expect(page.ask(HOLE).locator(".answer")).to_have_text("8")
    expect(page.ask("And how deep are they?").locator(".answer")).to_contain_text("22 mm")
    page.page.get_by_role("button", name="New conversation").click()
    sent: list[str] = []
    page.page.on(
        "request", lambda request: sent.append(request.post_data or "") if "questions" in request.url else None
    )
    page.ask(HOLE)
    assert json.loads(sent[0])["context"] == []


def test_suggested_questions_come_from_the_model_and_are_asked_by_a_click(
    seen: Opener, client: Client, flange_model: str
) -> None:
    page = seen().model(flange_model)
    chips = page.page.locator(".suggestions .chips button")
    expect(chips.first).to_be_visible()
    assert chips.first.inner_text() in client.describe(flange_model).questions
    chips.nth(1).click()
    expect(page.page.locator(".card").first.locator(".answer")).not_to_be_empty()


def test_an_unsure_answer_shows_its_readings_and_each_lights_its_own_parts(
    seen: Opener, client: Client, flange_model: str
) -> None:
    question = "What is the diameter of the hole?"
    record = client.ask(flange_model, question, options=AnswerOptions(least_confidence=0.99))
    assert record.status is Status.UNSURE
    job = next(each.id for each in client.answers(flange_model).items if each.question == question)
    page = seen().model(flange_model, f"&answer={job}")
    page.until("() => querycad.lit.size > 0")
    readings = page.page.locator(f"#answer-{job} .reading")
    assert readings.count() == 1 + len(record.alternatives) >= 3
    assert set(page.lit) == {face for part in record.parts for face in part.faces}
    for index, alternative in enumerate(record.alternatives[:2], 1):
        before = page.page.evaluate("() => JSON.stringify([...querycad.lit])")
        readings.nth(index).click()
        expect(readings.nth(index)).to_have_attribute("aria-pressed", "true")
        expect(readings.nth(index)).to_contain_text(alternative.answer.text)
        page.until(f"() => querycad.lit.size > 0 && JSON.stringify([...querycad.lit]) !== '{before}'")
        used = client.run(flange_model, alternative.code).used_parts
        parts = client.parts(flange_model, limit=1000).items
        wanted = {face for part in parts if part.id in used for face in part.faces}
        assert set(page.lit) == wanted


def drawn_metres(page: Seen) -> list[float]:
    """How long are the lines that are drawn, were they in the plane of the view?"""
    found: list[float] = page.page.evaluate(
        """() => { const one = querycad.model.lengthInMetres(2) / querycad.canvas.clientHeight / querycad.camera.zoom;
           return [...document.querySelectorAll(".leaders polyline")].map(line => {
             const [x, y, u, v] = line.getAttribute("points").split(/[ ,]/).map(Number);
             return Math.hypot(x - u, y - v) * one; }); }"""
    )
    return found


@pytest.mark.parametrize(
    ("question", "side", "lines"),
    [
        ("What is the diameter of hole 11?", "top", [54]),
        ("What is the radius of hole 11?", "top", [27]),
        ("How deep is hole 11?", "front", [53]),
        ("What is the distance between hole 4 and hole 6?", "top", [134]),
        ("What is the diameter of the holes visible from the top?", "top", [8.5] * 2 + [16] * 8 + [54]),
        ("How deep are the counterbored holes?", "front", [22] * 8),
        ("What is the size of the part?", "top", [0, 170, 170]),
    ],
)
def test_a_measure_that_is_the_answer_is_drawn_where_it_is(
    seen: Opener, flange_model: str, question: str, side: str, lines: list[float]
) -> None:
    page = seen().model(flange_model)
    page.page.click(f"[data-side={side}]")
    page.ask(question)
    expect(page.page.locator(".label.center")).to_have_count(len(lines))
    page.still()
    assert sorted(drawn_metres(page)) == pytest.approx([each / 1000 for each in lines], rel=0.01, abs=1e-4)


def test_an_angle_that_is_the_answer_is_drawn_between_its_parts(seen: Opener, assembly_model: str) -> None:
    page = seen().model(assembly_model)
    page.ask("What angle do the axes of the shaft and hole 1 enclose?")
    expect(page.page.locator(".label.center")).to_have_text("90°")
    points = page.page.locator(".leaders polyline").get_attribute("points")
    assert len((points or "").split()) > 10, "an arc"


def test_what_is_no_measure_has_a_label_on_its_part(seen: Opener, flange_model: str) -> None:
    page = seen().model(flange_model)
    page.ask("Where is the center of hole 11?")
    expect(page.page.locator(".label.center")).to_have_count(0)
    expect(page.page.locator(".label")).to_contain_text("hole-11")


def test_what_cannot_be_answered_says_why_and_what_is_known(seen: Opener, client: Client, flange_model: str) -> None:
    page = seen().model(flange_model)
    for question in ("Who wrote this song?", "How deep is the keyway?"):
        card = page.ask(question)
        failure = client.ask(flange_model, question).failure
        assert failure is not None
        expect(card.locator(".answer.failed")).to_contain_text(failure.message)
        for word in failure.nearest:
            expect(card).to_contain_text(word)
        assert page.lit == {}


def test_an_answer_can_be_taken_along_in_every_form(seen: Opener, client: Client, flange_model: str) -> None:
    page = seen().model(flange_model)
    page.ask(MANY)
    record = AnswerRecord.model_validate_json(downloaded(page, "JSON").read_text())
    assert record.question == MANY
    rows = list(csv.reader(downloaded(page, "CSV").read_text().splitlines()))
    assert [row[0] for row in rows[5:]] == [part.id for part in record.parts]
    assert picture_width(downloaded(page, "PNG")) > 300
    whole = json.loads(downloaded(page, "Export all").read_text())
    assert whole["model"]["id"] == flange_model
    assert len(whole["parts"]) == client.parts(flange_model).total
    assert MANY in [job["question"] for job in whole["answers"]]
    assert picture_width(downloaded(page, "Save picture")) > 300


def test_rows_and_model_point_at_each_other(seen: Opener, client: Client, flange_model: str) -> None:
    page = seen().model(flange_model)
    page.page.click("[data-tab=holes]")
    rows = page.page.locator("tbody tr")
    expect(rows).to_have_count(11)
    rows.nth(8).get_by_role("button").click()
    part = next(
        part
        for part in client.parts(flange_model, limit=1000).items
        if part.id == rows.nth(8).get_attribute("data-ids")
    )
    page.until("() => querycad.lit.size > 0")
    assert set(page.lit) == set(part.faces)
    page.click(0.5, 0.36)
    expect(page.page.locator("tr[data-selected]")).to_have_attribute("data-ids", "hole-11")
    heads = page.page.locator("#panel-holes th[scope=col]").all_inner_texts()
    assert heads.index("diameter [mm]") < heads.index("x [mm]"), "what it is stands before where it is"
    said = downloaded(page, "CSV", "#panel-holes").read_text()
    assert len(said.splitlines()) == 12
    assert said.startswith("tag,ids,x [mm]")
    page.page.get_by_label("Like ones in one row").first.check()
    expect(rows).to_have_count(len(client.table(flange_model, TableKind.HOLES, grouped=True).rows))
    page.page.select_option("#panel-holes select", "slots")
    expect(page.page.locator("#panel-holes .table")).not_to_contain_text("Loading")


def test_the_unit_is_chosen_once_for_all(seen: Opener, assembly_model: str) -> None:
    page = seen().model(assembly_model)
    page.page.select_option("#tools select", "in")
    expect(page.page.locator("#model-name")).to_contain_text("5.9055 × 4.7244")
    expect(page.ask("What is the diameter of the shaft?").locator(".answer")).to_contain_text("0.7874")
    page.page.click("[data-tab=bodies]")
    expect(page.page.locator("#panel-bodies th").nth(3)).to_have_text("x size [in]")
    page.page.click("[data-tab=description]")
    expect(page.page.locator("#panel-description dd").first).to_contain_text("in")


def test_a_link_shows_the_same_model_answer_and_view_to_who_opens_it(seen: Opener, flange_model: str) -> None:
    page = seen().model(flange_model)
    page.ask("What is the diameter of the holes visible from the top?")
    page.page.click("[data-side=front]")
    page.still()
    page.page.locator("#tools").get_by_role("button", name="Copy link").click()
    link = page.page.evaluate("() => navigator.clipboard.readText()")
    other = seen().open(link.partition("/#")[2] and "#" + link.partition("#")[2]).drawn()
    other.until("() => querycad.lit.size > 0")
    assert other.lit == page.lit
    assert other.page.evaluate("() => querycad.pose") == page.page.evaluate("() => querycad.pose")
    other.page.reload()
    other.drawn()
    other.until("() => querycad.lit.size > 0")
    assert other.lit == page.lit


def test_a_question_goes_on_when_the_page_is_loaded_anew_in_the_middle_of_it(
    seen: Opener, service: Service, flange_model: str
) -> None:
    page = seen().model(flange_model)
    with service.paused("querycad_api.worker"):
        page.page.fill("#question", HOLE)
        page.page.keyboard.press("Enter")
        expect(page.page.locator(".card").first).to_contain_text("waiting")
        page.page.reload()
        card = page.page.locator(".card").first
        expect(card.locator("h3")).to_have_text(HOLE)
        expect(card).to_contain_text("waiting")
        assert card.locator(".answer").count() == 0
    expect(card.locator(".answer")).to_have_text("8")
    page.until("() => querycad.lit.size > 0")


def test_a_waiting_question_tells_its_place_and_can_be_called_off(
    seen: Opener, service: Service, flange_model: str
) -> None:
    page = seen().model(flange_model)
    with service.paused("querycad_api.worker"):
        for _ in range(3):
            page.page.fill("#question", HOLE)
            page.page.keyboard.press("Enter")
            page.page.wait_for_timeout(400)
        card = page.page.locator(".card").first
        expect(card).to_contain_text("before it")
        card.get_by_role("button", name="Cancel").click()
        expect(card.locator(".answer.failed")).to_contain_text("cancelled")
    expect(page.page.locator(".card").nth(1).locator(".answer")).to_have_text("8")
