"""`querycad.open`: a model in two lines of Python; through a client it has the same methods and says the same."""

from __future__ import annotations

import asyncio
import inspect
import json
import subprocess
import sys
from collections.abc import Callable, Iterator
from datetime import UTC, datetime
from functools import partial
from hashlib import sha256
from pathlib import Path
from typing import Any

import httpx
import pytest

import querycad
from querycad import AsyncClient, AsyncModel, Client, EmbeddedRuntime, FileProblem, Model, NoValue, ServerProblem
from querycad_api.problems import ApiProblem, FileTooLarge, NotStepFile, QuotaReached
from querycad_contracts import (
    AnswerType,
    Failure,
    FailureCategory,
    Job,
    JobStatus,
    LengthUnit,
    Measure,
    ModelResource,
    ModelStatus,
    PartsPage,
    RunStatus,
    Status,
    TableKind,
    Unit,
    ViewName,
)

ROOT = Path(__file__).parents[2]
PNG = b"\x89PNG"


@pytest.fixture(scope="module")
def model(runtime: EmbeddedRuntime) -> Model:
    return runtime.open(ROOT / "examples/flange.step")


class Service:
    """A service as far as its interface goes: what it says is computed here."""

    def __init__(self, model: Model, file: Path) -> None:
        self.model = model
        _ = model.parts  # here: a cached property is locked for all instances, and the other one waits for an answer
        self.id = sha256(file.read_bytes()).hexdigest()
        self.job: Job | None = None
        self.resource = ModelResource(
            id=self.id,
            file_name=file.name,
            size_bytes=file.stat().st_size,
            created=datetime.now(UTC),
            status=ModelStatus.READY,
            summary=model.summary,
        )

    def answer(self, request: httpx.Request) -> httpx.Response:  # noqa: PLR0911 - a case each
        path, query = request.url.path, dict(request.url.params)
        body = json.loads(request.content) if request.headers.get("content-type") == "application/json" else {}
        if path in ("/v1/models", f"/v1/models/{self.id}"):
            return _said(self.resource)
        if path.startswith("/v1/jobs/"):
            return _said(self.job)
        match path.removeprefix(f"/v1/models/{self.id}/").split("/"):
            case ["questions"]:
                record = self.model.ask(body.pop("question"), unit=body.pop("unit"), options=_options(body))
                self.drawn = record.picture() if record.answer is not None else b""
                self.job = Job(
                    id="b" * 32,
                    model=self.id,
                    question=record.question,
                    unit=LengthUnit.MM,
                    status=JobStatus.DONE,
                    created=datetime.now(UTC),
                    record=record,
                )
                return _said(self.job, 202)
            case ["answers", _, "picture"]:
                return httpx.Response(200, content=self.drawn)
            case ["parts"]:
                offset, limit = int(query["offset"]), min(int(query["limit"]), 50)
                some = self.model.parts[offset : offset + limit]
                return _said(PartsPage(items=some, total=len(self.model.parts)))
            case ["segment"]:
                found = self.model._source.find_parts(body["description"], body["sides"], body["grounding"])
                return _said(found)
            case ["description"]:
                return _said(self.model.describe(LengthUnit(query["unit"])))
            case ["tables", kind]:
                return _said(self.model.table(kind))
            case ["programs"]:
                return _said(self.model.run(body["code"], body["expects"]))
            case ["views", view]:
                return httpx.Response(200, content=self.model.picture(view, int(query["width"]), int(query["height"])))
        raise AssertionError(path)


def _options(body: dict[str, Any]) -> Any:
    from querycad_contracts import AnswerOptions

    return AnswerOptions.model_validate(body)


def _said(what: Any, status: int = 200) -> httpx.Response:
    return httpx.Response(status, content=what.model_dump_json(), headers={"Content-Type": "application/json"})


@pytest.fixture(params=["here", "served"])
def either(request: pytest.FixtureRequest, model: Model, flange: Path) -> Iterator[Model]:
    if request.param == "here":
        yield model
        return
    with Client("http://service", transport=httpx.MockTransport(Service(model, flange).answer)) as client:
        yield client.open(flange)


def test_two_lines_print_the_answer() -> None:
    code = 'import querycad; print(querycad.open("examples/flange.step").ask("How many holes are there?"))'
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True)
    assert (done.stdout, done.stderr) == ("11\n", "")


def test_importing_it_loads_nothing_that_takes_a_moment() -> None:
    code = "import sys, querycad; querycad.__version__; print({'numpy', 'httpx', 'pydantic', 'OCP'} & set(sys.modules))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "set()\n"


def test_every_public_name_is_there_and_documented() -> None:
    assert set(querycad.__all__) <= set(dir(querycad))
    for name in querycad.__all__:
        found = getattr(querycad, name)
        assert isinstance(found, str) or inspect.getdoc(found), name
    with pytest.raises(AttributeError, match="no attribute 'shut'"):
        _ = querycad.shut


def test_the_version_is_the_one_of_the_tree() -> None:
    assert querycad.__version__ == (ROOT / "VERSION").read_text().strip()


def test_an_answer_is_typed_and_says_what_it_rests_on(either: Model) -> None:
    reply = either.ask("What is the diameter of the largest hole?", unit="in")
    assert (reply.value, reply.type, reply.unit) == (pytest.approx(0.054), AnswerType.LENGTH, Unit.METRE)
    assert str(reply) == reply.text == "2.12598 in"
    assert [part.id for part in reply.parts] == ["hole-11"]
    assert reply
    assert reply.status is Status.ANSWERED
    assert reply.picture().startswith(PNG)
    shown = reply._repr_html_()
    assert all(each in shown for each in ("2.12598 in", "Ø54 THRU", "hole-11", "data:image/png;base64,"))


def test_a_question_that_has_no_answer_is_a_reply_too(either: Model) -> None:
    reply = either.ask("How many bananas are there?")
    assert not reply
    assert (reply.value, reply.type, reply.unit) == (None, None, None)
    assert reply.failure is not None
    assert "banana" in str(reply)
    assert "hole" in str(reply)
    assert "banana" in reply._repr_html_()
    with pytest.raises(NoValue, match="banana"):
        reply.picture()


@pytest.mark.parametrize("question", ["", " \n", "how deep is it? " * 200, "How many \udcff holes?"])
def test_what_is_no_question_is_told_so_and_nothing_is_raised(either: Model, question: str) -> None:
    reply = either.ask(question)
    assert reply.failure is not None
    assert reply.failure.category is FailureCategory.BAD_INPUT
    assert reply.failure.message.startswith("the question ")
    assert json.loads(reply.model_dump_json())["status"] == "failed"


def test_one_may_be_given_where_several_may(either: Model) -> None:
    assert either.ask("How deep is it?", select="hole-4").text == either.ask("How deep is it?", select=["hole-4"]).text
    counted = "How many counterbored holes are there?"
    assert either.ask("And how deep are they?", context=counted).text == "22 mm (each of 8)"
    assert either.find_parts("holes", sides="top") == either.find_parts("holes", sides=["top"])


@pytest.mark.parametrize(
    ("wrong", "says"),
    [
        (
            lambda model: model.measure("diametre", "hole-4"),
            "'diametre' is no measure, perhaps 'diameter' is meant; .*",
        ),
        (lambda model: model.table("screws"), ".* is no table; there are holes, slots, .*"),
        (lambda model: model.picture("above"), ".* is no view; there are isometric, top, .*"),
        (lambda model: model.picture("top", width=32), "a picture has 64 to 2048 pixels each way, not 32 x 600"),
        (lambda model: model.describe("yard"), "'yard' is no unit; there are mm, cm, m, in"),
        (lambda model: model.find_parts("holes", sides=["north"]), ".* is no side; there are top, .*"),
        (lambda model: model.find_parts(" "), "a phrase for parts has 1 to 500 characters"),
        (lambda model: model.find_parts("hole " * 200), "a phrase for parts has 1 to 500 characters"),
        (lambda model: model.ask("How many holes?", expect="lenght"), ".* perhaps 'length' is meant; .*"),
        (lambda model: model.distance("hole-4", "hole-6", "axes"), "a distance is between surfaces or centers, .*"),
        (lambda model: model.measure("mass", density=-5), "a density is more than 0 kg/m3, not -5"),
        (lambda model: model.measure("mass", density=float("nan")), "a density is more than 0 kg/m3, not nan"),
        (lambda model: model.measure("diameter", []), "no part is given to be measured"),
    ],
)
def test_what_does_not_exist_is_refused_with_what_does(
    either: Model, wrong: Callable[[Model], object], says: str
) -> None:
    with pytest.raises(ValueError, match=f"^{says}$"):
        wrong(either)


def test_what_is_said_of_a_question_counts(either: Model) -> None:
    before = ["How many counterbored holes are there?"]
    assert either.ask("And how deep are they?", context=before).text == "22 mm (each of 8)"
    assert either.ask("What is its diameter?", select=["hole-4"]).value == pytest.approx(0.0085)
    assert either.ask("What is its diameter?", select=[either.part("hole-4")]).value == pytest.approx(0.0085)
    assert either.ask("How many holes are there?", least_confidence=1.0).status is Status.UNSURE
    refused = either.ask("How many holes are there?", expect="point")
    assert refused.failure is not None
    assert refused.failure.category == "unexpected"


def test_parts_are_found_by_words(either: Model) -> None:
    assert either.find_parts("counterbored holes", ["top"]).ids[:2] == ("hole-1", "hole-2")
    none = either.find_parts("banana")
    assert not none
    assert "banana" in none.message
    assert "hole" in none.nearest
    assert "banana" in none._repr_html_()
    assert "Ø8.5 THRU" in either.find_parts("hole 4")._repr_html_()
    assert len(either.parts) == 70


def test_a_measure_is_that_of_the_part_and_no_stretch_of_it(either: Model) -> None:
    assert either.measure("diameter", "hole-4").value == pytest.approx(0.0085)
    assert either.measure(Measure.DEPTH, ["hole-4", "hole-11"]).value == pytest.approx([0.022, 0.053])
    assert either.measure("size").text == "170 x 170 x 53 mm"
    assert either.measure("size", unit="m").text == "0.17 x 0.17 x 0.053 m"
    with pytest.raises(NoValue, match="across flats is not a measure of hole-4, a hole"):
        either.measure("across_flats", "hole-4")
    with pytest.raises(NoValue, match=r"flange\.step has no color"):
        either.measure("color")
    with pytest.raises(KeyError, match="hole-99"):
        either.measure("depth", "hole-99")
    with pytest.raises(ValueError, match="beauty"):
        either.measure("beauty")
    assert either.measure("face_count").value == 41
    assert either.measure("edge_count", "model-1").value == 51
    assert either.measure("mass", "body-1", density=7850).value == pytest.approx(3.76705, rel=1e-5)
    whole = either.measure("mass", density=7850)
    assert (whole.value, whole.text) == (pytest.approx(3.76705, rel=1e-5), "3.76705 kg")
    assert either.measure("inertia", density=7850).text.endswith(" kg m2")
    with pytest.raises(NoValue, match="density=7850"):
        either.measure("mass")
    with pytest.raises(NoValue, match="counted of the whole model"):
        either.measure("face_count", "hole-4")


def test_every_measure_has_a_value_or_a_reason(model: Model) -> None:
    refused: list[str] = []
    for measure in Measure:
        for part in (None, "hole-1", "boss-1", "chamfer-b1.1", "fillet-1", "pattern-1", "body-1"):
            try:
                answer = model.measure(measure, part)
            except NoValue as reason:
                refused.append(str(reason))
            else:
                assert answer.text
                if answer.type is AnswerType.LENGTH and measure.value not in "xyz":
                    assert answer.value >= 0, (measure, part)
    assert refused
    assert all(refused)


def test_distances_and_angles_are_exact(either: Model) -> None:
    apart = either.distance("hole-4", "hole-6", "centers")
    assert apart == pytest.approx(0.134)
    assert either.distance("hole-4", "hole-6") == pytest.approx(apart - 0.0085)
    assert either.angle("hole-4", "hole-6") == pytest.approx(0)
    with pytest.raises(NoValue, match="fillet-1 has no axis"):
        either.angle("hole-4", "fillet-1")


def test_tables_descriptions_programs_and_views_are_there(either: Model) -> None:
    assert "8x Ø16 THRU" in either.describe().text
    assert len(either.table("holes").rows) == 11
    assert either.table(TableKind.BODIES).parts == 1
    outcome = either.run("solution = len(parts(kind='hole'))", expects="count")
    assert (outcome.status, outcome.value) == (RunStatus.OK, 11)
    assert either.run("solution = open('/etc/passwd')").status is not RunStatus.OK
    assert either.picture("top", 320, 200).startswith(PNG)
    assert either.shape.extents == pytest.approx((0.17, 0.17, 0.053))
    assert repr(either) == "<querycad.Model 'flange.step': 170 x 170 x 53 mm, 70 parts>"
    assert "bolt circle" in either._repr_html_()


def test_a_picture_is_written_and_shown(model: Model, tmp_path: Path) -> None:
    picture = model.picture(ViewName.FRONT, 200, 100)
    assert picture.save(tmp_path / "new" / "front.png").read_bytes() == picture == picture._repr_png_()


def test_a_file_that_cannot_be_read_says_why(runtime: EmbeddedRuntime, model: Model, tmp_path: Path) -> None:
    (tmp_path / "page.step").write_text("<html></html>")
    with pytest.raises(FileProblem, match="HTML"):
        runtime.open(tmp_path / "page.step")
    with pytest.raises(FileProblem, match="no such file"):
        querycad.open(tmp_path / "none.step")
    service = Service(model, ROOT / "examples/flange.step")
    with Client("http://service", transport=httpx.MockTransport(service.answer)) as client:
        with pytest.raises(FileProblem, match=f"^no such file: {tmp_path}/none.step$"):
            client.open(tmp_path / "none.step")
        with pytest.raises(FileProblem, match="not a file: "):
            client.open(tmp_path)
    failure = Failure(category=FailureCategory.BAD_INPUT, message="it is an HTML document")
    service.resource = service.resource.model_copy(update={"status": ModelStatus.FAILED, "failure": failure})
    with Client("http://service", transport=httpx.MockTransport(service.answer)) as client:
        with pytest.raises(FileProblem, match="HTML"):
            client.open(tmp_path / "page.step")
        service.resource = service.resource.model_copy(update={"status": ModelStatus.READING, "failure": None})
        with pytest.raises(TimeoutError, match="within 0 s"):
            client.open(tmp_path / "page.step", timeout_s=0)


@pytest.mark.parametrize(
    ("refusal", "raised"),
    [
        (NotStepFile("it is a song"), FileProblem),
        (FileTooLarge("it is large"), FileProblem),
        (QuotaReached("too much"), ServerProblem),
    ],
)
def test_a_file_that_a_service_refuses_is_a_bad_file_here_too(
    refusal: ApiProblem, raised: type[Exception], flange: Path
) -> None:
    problem = refusal.problem()
    transport = httpx.MockTransport(lambda _: _said(problem, problem.status))
    with Client("http://service", transport=transport) as client, pytest.raises(raised, match=f"^{refusal}$"):
        client.open(flange)


def test_a_model_that_a_service_holds_is_opened_by_its_id(model: Model, flange: Path) -> None:
    service = Service(model, flange)
    with Client("http://service", transport=httpx.MockTransport(service.answer)) as client:
        assert client.open(service.id).ask("How many holes are there?").value == 11


def test_the_asynchronous_model_says_the_same(model: Model, flange: Path) -> None:
    service = Service(model, flange)

    async def talk() -> None:
        async with AsyncClient("http://service", transport=httpx.MockTransport(service.answer)) as client:
            opened = await client.open(flange)
            assert isinstance(opened, AsyncModel)
            reply = await opened.ask("How many holes are there?")
            assert reply.value == 11
            assert (await asyncio.to_thread(reply.picture)).startswith(PNG)
            assert len(await opened.parts()) == 70
            assert (await opened.measure("diameter", "hole-4")).text == "8.5 mm"
            assert opened.shape == model.shape

    asyncio.run(talk())


def test_an_answer_is_drawn_on_the_event_loop_too(model: Model, flange: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    service = Service(model, flange)

    async def talk() -> None:
        async with AsyncClient("http://service", transport=httpx.MockTransport(service.answer)) as client:
            reply = await (await client.open(flange)).ask("How many holes are there?")
            with pytest.raises(RuntimeError, match=r"asyncio\.to_thread"):  # waits for itself, never
                reply.picture()
            client._blocking = ("http://service", None)  # as without a transport of the caller's
            waits = partial(Client, transport=httpx.MockTransport(service.answer))
            monkeypatch.setattr("querycad.client.Client", waits)
            assert reply.picture().startswith(PNG)
            assert "data:image/png" in reply._repr_html_()

    asyncio.run(asyncio.wait_for(talk(), 60))


def test_the_asynchronous_model_has_all_methods() -> None:
    def public(kind: type) -> set[str]:
        return {name for name, value in vars(kind).items() if callable(value) and not name.startswith("_")}

    assert public(AsyncModel) - {"parts"} == public(Model)
    assert {"warnings", "summary", "shape", "parts"} <= set(vars(AsyncModel))
