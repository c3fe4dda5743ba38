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
from benchmark.perf import page as page_speed
from numpy.typing import NDArray
from PIL import Image
from playwright.sync_api import expect
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
    page.ask("How many holes are there?")
    for side in ("isometric", "top", "front", "left", "bottom"):
        page.page.click(f"[data-side={side}]")
        page.still()
        lines: list[list[float]] = page.page.evaluate(
            """() => [...document.querySelectorAll(".leaders polyline")].map(line =>
               line.getAttribute("points").split(/[ ,]/).map(Number))"""
        )
        assert len(lines) == 11
        assert not [pair for pair in combinations(lines, 2) if crosses(*pair)], side


def test_texts_of_dimensions_never_overlap(seen: Opener, flange_model: str) -> None:
    page = seen().model(flange_model)
    page.ask("What is the diameter of the holes visible from the top?")
    page.still()
    boxes: list[list[float]] = page.page.evaluate(
        """() => [...document.querySelectorAll(".label.center")].map(label => {
           const box = label.getBoundingClientRect(); return [box.left, box.top, box.right, box.bottom]; })"""
    )
    assert len(boxes) == 11
    for (left, top, right, bottom), (other_left, other_top, other_right, other_bottom) in combinations(boxes, 2):
        assert right <= other_left or other_right <= left or bottom <= other_top or other_bottom <= top


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


def section_area(mesh: Mesh, x: float) -> float:
    """Of the cut across x, in square metres: the lines in which triangles meet the plane run around it (Green)."""
    corners = mesh.vertices_m[mesh.triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    above = corners[..., 0] > x
    total = 0.0
    for triangle, normal, over in zip(corners, normals, above, strict=True):
        if over.all() or not over.any():
            continue
        ends = []
        for a, b in ((0, 1), (1, 2), (2, 0)):
            if over[a] != over[b]:
                share = (x - triangle[a, 0]) / (triangle[b, 0] - triangle[a, 0])
                ends.append((triangle[a] + share * (triangle[b] - triangle[a]))[1:])
        start, end = ends
        along = np.array([-normal[2], normal[1]])  # the outside is to the right
        if (end - start) @ along < 0:
            start, end = end, start
        total += (start[0] * end[1] - start[1] * end[0]) / 2
    return total


def hatched(image: NDArray[np.uint8], color: str) -> NDArray[np.bool_]:
    """Where a cut is filled in a body's colour: the lines and what is between them."""
    own = np.array([int(color[at : at + 2], 16) for at in (1, 3, 5)])
    shades = [(image[..., :3] == np.round(share * own)).all(axis=-1) for share in (0.92, 0.4)]
    return np.asarray((shades[0] | shades[1]) & (image[..., 3] > 0))


def test_what_a_section_cuts_is_filled_to_its_true_outline(seen: Opener, service: Service, flange_model: str) -> None:
    page = seen().model(flange_model)
    page.page.click("[data-key=E]")
    page.page.select_option("[data-key=C]", "x")
    page.page.locator("input[type=range]").fill("0.53")
    page.page.click("[data-side=right]")
    page.still()
    artefacts = ModelStore(service.home / "models").find(flange_model)
    assert artefacts is not None
    mesh = Mesh.load(artefacts.mesh)
    low, high = mesh.bounds
    color, pixels = page.page.evaluate(
        """() => { const [a, b] = [0, 1].map(y => querycad.project(querycad.model.fromMetres([0, y, 0])));
           return [querycad.model.bodies[0].color, Math.abs(a.x - b.x)]; }"""
    )
    cut = hatched(canvas(page), color)
    true_area = section_area(mesh, low[0] + 0.53 * (high[0] - low[0]))
    assert cut.sum() / pixels**2 == pytest.approx(true_area, rel=0.03)
    assert page.pick(0.5, 0.5) is not None  # the bore's far wall, behind no material
    box = page.page.evaluate("() => [querycad.canvas.clientWidth, querycad.canvas.clientHeight]")
    rows, columns = np.nonzero(cut)
    middle = len(rows) // 2
    assert page.pick((columns[middle] + 0.5) / box[0], (rows[middle] + 0.5) / box[1]) is None, "the cut is no face"


def test_each_body_that_is_cut_is_filled_in_its_own_colour(seen: Opener, assembly_model: str) -> None:
    page = seen().model(assembly_model)
    page.page.select_option("[data-key=C]", "y")
    page.page.locator(".section input[type=checkbox]").check()
    page.page.click("[data-side=front]")
    page.still()
    colors: list[str] = page.page.evaluate("() => querycad.model.bodies.map(body => body.color)")
    before = [int(hatched(canvas(page), color).sum()) for color in colors]
    assert min(before[:4]) > 500  # plate, block, bushing, shaft
    page.page.locator(".tree input").nth(1).uncheck()
    after = [int(hatched(canvas(page), color).sum()) for color in colors]
    assert after[1] == 0
    assert min(after[0], after[2], after[3]) > 500


def test_the_axes_in_the_corner_turn_with_the_view_and_lead_to_its_sides(seen: Opener, flange_model: str) -> None:
    page = seen(reduced_motion="reduce").model(flange_model)

    def place(side: str) -> list[float]:
        told = page.page.locator(f"[data-end={side}]").get_attribute("transform")
        return [float(each) for each in re.findall(r"-?[\d.]+", told or "")]

    page.page.click("[data-side=front]")
    page.still()
    assert place("right")[0] > 30 > abs(place("right")[1])
    assert place("top")[1] < -30 < -abs(place("top")[0])
    for side in ("top", "left", "bottom", "back"):
        page.page.click(f"[data-side={side}]")
        page.still()
        wanted = page.page.evaluate("() => querycad.pose")
        page.page.click("[data-side=isometric]")
        page.still()
        page.page.locator(f"[data-end={side}] circle").click()
        page.still()
        assert page.page.evaluate("() => querycad.pose") == wanted, side


def test_a_measurement_takes_the_centre_of_a_circle_that_is_clicked(seen: Opener, flange_model: str) -> None:
    page = seen().model(flange_model)
    page.page.click("[data-key=M]")
    told = page.page.locator(".told")
    page.click_at((0.067 + 0.013, 0, 0.022), (2, 1))  # on the rim of a counterbore
    expect(told).to_contain_text("From the centre of Ø 26 mm")
    page.click_at((-0.067, 0, 0.014), (-3, 2))  # at the centre of another one's floor, where there is no face
    expect(told).to_contain_text(re.compile(r"134\.24 mm between the centre of Ø 26 mm and the centre of Ø (16|26) mm"))
    expect(told).to_contain_text("(x 134 mm, y 0 mm, z 8 mm)")


def test_a_measurement_takes_corners_and_middles_of_edges(seen: Opener, assembly_model: str) -> None:
    page = seen().model(assembly_model)
    found: list[tuple[str, list[float]]] = page.page.evaluate(
        """() => { const box = querycad.canvas.getBoundingClientRect(); const found = new Map();
           for (let x = box.left; x < box.right; x += 16) for (let y = box.top; y < box.bottom; y += 16) {
             const snap = querycad.snap(x, y, querycad.pick(x, y));
             const place = snap && querycad.model.toMetres(snap.point).toArray();
             if (snap) found.set(`${snap.kind} ${place}`, [snap.kind, place]);
           }
           return [...found.values()]; }"""
    )
    of = {kind: np.array([point for each, point in found if each == kind]) for kind in ("corner", "middle", "center")}
    assert min(map(len, of.values())) >= 3
    halves = {tuple(np.round((a + b) / 2, 6)) for a, b in combinations(of["corner"], 2)}
    assert len(halves & {tuple(np.round(point, 6)) for point in of["middle"]}) >= 3, "of straight edges"


def test_two_clicks_measure(seen: Opener, client: Client, flange_model: str) -> None:
    page = seen().model(flange_model)
    page.page.click("[data-side=front]")
    page.still()
    page.page.click("[data-key=M]")
    rows = [share for share in np.linspace(0.2, 0.8, 61) if page.pick(0.5, share) is not None]
    page.click(0.5, rows[0] + 0.005)
    page.click(0.5, rows[-1] - 0.005)
    told = page.page.locator(".told")
    page.until("() => document.querySelector('.told').textContent.includes('between')")
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
    moving = page.page.evaluate(
        """() => { for (let i = 0; i < 60; i += 1) querycad.pace.moved(performance.now() + 100 * i);
           return querycad.model.coarser.map(each => [each.getIndex().count / 3, each.groups.length])
             .concat([[querycad.pace.quality.coarser, querycad.pace.quality.resolution]]); }"""
    )
    (first, bodies), (least, same), worst = moving
    assert (bodies, same) == (16, 16)
    assert least <= 15_000 < first <= 50_000
    assert worst == [2, 0.5], "a machine that is slow draws the fewest triangles, at half of the resolution"
    card = page.ask("How many holes are there?")
    assert len(page.lit) > 1000
    assert page.page.locator(".label").count() <= 8
    assert card.locator(".legend li").count() >= 5


def test_the_rate_is_measured_at_the_size_that_is_told(seen: Opener, service: Service, client: Client) -> None:
    browser = seen().page.context.browser
    assert browser is not None
    told = page_speed.frames(browser, service, client, ROOT / "examples/bracket.step", rounds=2, count=5)
    assert "bracket.step: " in told
    assert re.search(r"view 960 x 540, drawn at 960 x 540 while it moves: [\d.]+, [\d.]+ frames a second", told)
    assert re.search(r"; \d+ ms of a core each, load", told)
