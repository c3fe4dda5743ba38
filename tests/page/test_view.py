"""The model in 3D: seen from its sides, cut, measured, picked; and what is lit is what the service means."""

from __future__ import annotations

import base64
import io
import re
import time
from collections.abc import Callable
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image
from tests.page.conftest import Opener, Seen, Service

from querycad.client import Client
from querycad_contracts import AnswerRecord, ViewName
from querycad_segworker.mesh import Mesh
from querycad_segworker.model import ModelStore
from querycad_segworker.visibility.cameras import isometric_camera
from querycad_segworker.visibility.raycast import Scene

ROOT = Path(__file__).parents[2]
LARGE = ROOT.parent / "shared/robustness/derived/assembly_16x_ctc02_10608faces.step"
QUESTION = "What is the diameter of the holes visible from the top?"
GRID = (240, 180)


def cropped(mask: NDArray[np.bool_], about: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """The mask within the box that `about` fills, at one size for all."""
    rows, columns = np.flatnonzero(about.any(axis=1)), np.flatnonzero(about.any(axis=0))
    inside = mask[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]
    return np.asarray(Image.fromarray((inside * 255).astype(np.uint8)).resize(GRID)) > 127


def overlap(a: NDArray[np.bool_], b: NDArray[np.bool_]) -> float:
    return float((a & b).sum() / (a | b).sum())


def canvas(page: Seen) -> NDArray[np.uint8]:
    """The view's own pixels, RGBA: transparent where the model is not."""
    data: str = page.page.evaluate(
        """() => { const view = querycad.snapshot(); const copy = document.createElement("canvas");
           [copy.width, copy.height] = [view.width, view.height]; copy.getContext("2d").drawImage(view, 0, 0);
           return copy.toDataURL(); }"""
    )
    return np.asarray(Image.open(io.BytesIO(base64.b64decode(data.partition(",")[2]))))


def faces_of(record: AnswerRecord) -> set[int]:
    return {face for part in record.parts for face in part.faces}


def test_the_faces_that_an_answer_rests_on_are_lit_and_no_others(
    seen: Opener, client: Client, flange_model: str
) -> None:
    page = seen().model(flange_model)
    card = page.ask(QUESTION)
    record = client.ask(flange_model, QUESTION)
    assert set(page.lit) == faces_of(record)
    assert len(set(page.lit.values())) == 3  # a colour for each diameter
    assert card.locator(".legend li").count() == 3


def test_what_is_lit_is_where_the_worker_sees_it(
    seen: Opener, client: Client, service: Service, flange_model: str
) -> None:
    page = seen().model(flange_model)
    page.ask(QUESTION)
    page.page.click("[data-key=E]")
    image = canvas(page)
    highest, lowest = image[..., :3].max(axis=2).astype(float), image[..., :3].min(axis=2)
    colored = (highest - lowest) / np.maximum(highest, 1) > 0.7  # what shines through others is paler
    artefacts = ModelStore(service.home / "models").find(flange_model)
    assert artefacts is not None
    mesh = Mesh.load(artefacts.mesh)
    ids = Scene(mesh).render_ids(isometric_camera(mesh.bounds, 800, 600)).face_id_map
    wanted = np.isin(ids, list(faces_of(client.ask(flange_model, QUESTION))))
    assert wanted.sum() > 5000
    assert overlap(cropped(image[..., 3] > 0, image[..., 3] > 0), cropped(ids >= 0, ids >= 0)) > 0.97
    assert overlap(cropped(colored, image[..., 3] > 0), cropped(wanted, ids >= 0)) > 0.9


def test_leader_lines_never_cross(seen: Opener, flange_model: str) -> None:
    page = seen().model(flange_model)
    page.ask(QUESTION)
    for side in ("isometric", "top", "front", "left", "bottom"):
        page.page.click(f"[data-side={side}]")
        page.still()
        lines: list[list[float]] = page.page.evaluate(
            """() => [...document.querySelectorAll(".leaders line")].map(line =>
               ["x1", "y1", "x2", "y2"].map(name => Number(line.getAttribute(name))))"""
        )
        assert len(lines) == 11
        assert not [pair for pair in combinations(lines, 2) if crosses(*pair)], side


def crosses(a: list[float], b: list[float]) -> bool:
    def turn(p: list[float], q: list[float], r: list[float]) -> float:
        return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])

    start, end, other, last = a[:2], a[2:], b[:2], b[2:]
    return (
        turn(start, end, other) * turn(start, end, last) < -1e-6
        and turn(other, last, start) * turn(other, last, end) < -1e-6
    )


@pytest.mark.parametrize("side", ["top", "bottom", "front", "back", "left", "right"])
def test_a_side_shows_what_the_service_calls_by_its_name(
    seen: Opener, client: Client, assembly_model: str, side: str
) -> None:
    page = seen().model(assembly_model)
    page.page.click(f"[data-side={side}]")
    page.still()
    shown = canvas(page)[..., 3] > 0
    picture = (
        np.asarray(Image.open(io.BytesIO(client.view(assembly_model, ViewName(side), 600, 450))).convert("L")) < 250
    )
    assert overlap(cropped(shown, shown), cropped(picture, picture)) > 0.93


def test_keys_move_the_view_only_while_it_has_the_focus(seen: Opener, flange_model: str) -> None:
    page = seen().model(flange_model)
    before = page.page.evaluate("() => querycad.pose")
    page.page.focus("#question")
    page.page.keyboard.press("5")
    page.still()
    assert page.page.evaluate("() => querycad.pose") == before
    page.page.focus("#view canvas")
    for key in ("5", "ArrowLeft", "Shift+ArrowRight", "+", "f"):
        page.page.keyboard.press(key)
        page.still()
        assert page.page.evaluate("() => querycad.pose") != before, key
        before = page.page.evaluate("() => querycad.pose")


def test_bodies_have_the_files_names_and_colours_and_can_be_hidden(seen: Opener, assembly_model: str) -> None:
    page = seen().model(assembly_model)
    names = page.page.locator(".tree label").all_inner_texts()
    assert [name.strip() for name in names][:4] == [
        "Base plate",
        "Bearing block",
        "ISO 4379 bushing 20x26x36",
        "Shaft 20x120",
    ]
    bodies = page.page.evaluate("() => querycad.model.bodies.map(body => [body.id, body.color, body.faces])")
    assert [color for _, color, _ in bodies][:3] == ["#708090", "#4682b4", "#daa520"]
    face = page.pick(0.5, 0.45)
    assert face is not None
    (number,) = [number for number, _, faces in bodies if face in faces]
    page.page.locator(".tree input").nth(number).uncheck()
    assert page.pick(0.5, 0.45) not in bodies[number][2]
    page.page.locator(".tree li").nth(number).get_by_role("button").click()  # only this one
    assert page.pick(0.5, 0.45) == face


def test_a_section_takes_away_what_lies_beyond_it(seen: Opener, flange_model: str) -> None:
    page = seen().model(flange_model)
    page.page.click("[data-side=front]")
    page.still()
    whole = (canvas(page)[..., 3] > 0).sum()
    page.page.select_option("[data-key=C]", "x")
    cut = (canvas(page)[..., 3] > 0).sum()
    assert 0.4 < cut / whole < 0.6
    assert page.pick(0.7, 0.5) is None
    assert page.pick(0.4, 0.5) is not None


def test_two_clicks_measure(seen: Opener, client: Client, flange_model: str) -> None:
    page = seen().model(flange_model)
    page.page.click("[data-side=front]")
    page.still()
    page.page.click("[data-key=M]")
    rows = [share for share in np.linspace(0.2, 0.8, 61) if page.pick(0.5, share) is not None]
    page.click(0.5, rows[0] + 0.005)
    page.click(0.5, rows[-1] - 0.005)
    told = page.page.locator(".told")
    page.until("() => document.querySelector('.told').textContent.includes('between the points')")
    match = re.search(r"z ([\d.]+) mm", told.inner_text())
    assert match is not None
    extents = client.model(flange_model).summary
    assert extents is not None
    assert 0.7 * extents.shape.extents[2] < float(match[1]) / 1000 <= extents.shape.extents[2]
    assert page.page.locator(".label.center").count() == 1


def test_reduced_motion_means_that_views_change_at_once(seen: Opener, flange_model: str) -> None:
    page = seen(reduced_motion="reduce").model(flange_model)
    poses: list[str] = page.page.evaluate(
        """async () => { document.querySelector("[data-side=top]").click();
           await new Promise(requestAnimationFrame); await new Promise(requestAnimationFrame);
           const soon = querycad.pose; await new Promise(done => setTimeout(done, 600));
           return [soon, querycad.pose]; }"""
    )
    assert poses[0] == poses[1]


@pytest.mark.skipif(not LARGE.exists(), reason="the large assembly is not in this checkout's shared folder")
def test_ten_thousand_faces_are_drawn_and_labelled_by_group(
    seen: Opener, client: Client, record_property: Callable[[str, object], None]
) -> None:
    model = client.upload(LARGE, 180.0)
    page = seen(viewport={"width": 1590, "height": 700})
    start = time.monotonic()
    page.model(model.id)
    record_property("seconds to see it", round(time.monotonic() - start, 1))
    size = page.page.evaluate("() => [querycad.canvas.clientWidth, querycad.canvas.clientHeight]")
    rates = [page.page.evaluate("() => querycad.spin(60)") for _ in range(3)]
    record_property("frames a second", [round(rate, 1) for rate in rates])
    record_property("pixels", size)
    assert page.page.evaluate("() => querycad.model.faceCount") == 10608
    page.still()
    card = page.ask("How many holes are there?")
    assert len(page.lit) > 1000
    assert page.page.locator(".label").count() <= 8
    assert card.locator(".legend li").count() >= 5
