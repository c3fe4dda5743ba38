"""Every example in the guest API's text runs, on a real model, and says something of it."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from querycad.runtime import EmbeddedRuntime
from querycad_answering.understanding import Run
from querycad_contracts import Program, RunStatus
from querycad_contracts.guest_reference import guest_api

EXAMPLES = {function.name: function.example for function in guest_api().functions}


@pytest.fixture(scope="module")
def runtime(tmp_path_factory: pytest.TempPathFactory) -> Iterator[EmbeddedRuntime]:
    with EmbeddedRuntime(store=tmp_path_factory.mktemp("models")) as made:
        yield made


@pytest.fixture(scope="module")
def run(runtime: EmbeddedRuntime, flange: Path) -> Run:
    return runtime.runner(flange)


def test_every_function_has_an_example_that_calls_it() -> None:
    assert all(f"{name}(" in example for name, example in EXAMPLES.items())


@pytest.mark.parametrize("kind", ["hole", "cylinder", "face"])
def test_the_closest_pair_of_a_real_model_is_that_of_all_pairs(run: Run, kind: str) -> None:
    code = f"""some = parts(kind="{kind}")[:20]
every = [a.distance_to(b) for i, a in enumerate(some) for b in some[i + 1 :]]
a, b = closest(some)
solution = [min(every), a.distance_to(b), len(every)]"""
    outcome = run(Program(code=code, codegen="llm"))
    assert (outcome.status, outcome.message) == (RunStatus.OK, "")
    every, closest, pairs = outcome.value
    assert closest == every
    assert pairs > 1


@pytest.mark.parametrize("name", sorted(EXAMPLES))
def test_an_example_runs(run: Run, name: str) -> None:
    outcome = run(Program(code=f"solution = {EXAMPLES[name]}", codegen="llm"))
    assert (outcome.status, outcome.message) == (RunStatus.OK, "")
    assert outcome.value is not None or outcome.pictures  # a picture is shown after the program


@pytest.mark.parametrize(
    ("code", "value"),
    [
        ("len(parts(kind='hole'))", 11),
        ("len(parts(kind='hole', tags=['through', 'counterbored'], side='top'))", 8),
        ("len(around(parts(kind='counterbore'), parts(kind='hole', tags='central')[0]))", 8),
        ("len({f.part.id for f in faces(radius=0.00425, convexity='concave')})", 2),
        ("offset(faces(facing='top')[0], faces(facing='bottom')[0]) > 0", True),
        ("[o.outline for o in parts(kind='hole')[0].openings]", ["circle", "circle"]),
        ("len(find_parts('zorblax hole').ignored_words)", 1),
        ("all(adjacent(f, n) for f in faces(kind='plane') for n in f.neighbours)", True),
    ],
)
def test_the_api_says_what_the_flange_is(run: Run, code: str, value: object) -> None:
    outcome = run(Program(code=f"solution = {code}", codegen="llm"))
    assert (outcome.message, outcome.value) == ("", value)


def test_a_turned_frame_gives_a_turned_size(run: Run) -> None:
    """A round body is as wide in any frame about its axis."""
    code = (
        "body = parts(kind='body')[0]\n"
        "size = body.size_in(parts(kind='hole')[0].frame)\n"
        "solution = [abs(a - b) < 1e-7 for a, b in zip(sorted(size), sorted(body.extents))]"
    )
    assert run(Program(code=code, codegen="llm")).value == [True] * 3


def test_kinds_and_tags_of_the_facts_are_what_parts_takes(run: Run, runtime: EmbeddedRuntime, flange: Path) -> None:
    groups = runtime.summary(flange).groups
    calls = [f"parts(kind={group.kind.value!r}, tags={list(group.tags)})" for group in groups]
    counts = run(Program(code=f"solution = [len(found) for found in [{', '.join(calls)}]]", codegen="llm")).value
    assert all(count >= group.count for count, group in zip(counts, groups, strict=True))
