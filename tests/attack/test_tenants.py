"""What one tenant can tell of another, and what two requests at once can take from each other."""

from __future__ import annotations

import asyncio
import stat
from pathlib import Path

import pytest
from redis.asyncio import Redis

from querycad_api.store.keyspace import key_of
from querycad_api.store.state import State
from querycad_contracts import IngestTask, QuestionTask, RunStatus
from querycad_contracts.infrastructure import keep_private
from querycad_sandbox.outcomes import Ending
from querycad_sandbox.run import Run
from querycad_sandbox.sandbox import Sandbox
from querycad_segworker.model import file_sha256
from querycad_segworker.settings import SegworkerSettings
from querycad_segworker.tasks import make_tasks

EXAMPLE = Path("examples/flange.step")


def test_a_file_that_another_has_is_read_again_for_who_uploads_it(tmp_path: Path) -> None:
    settings = SegworkerSettings(home=tmp_path)
    model = file_sha256(EXAMPLE)
    settings.upload(model).parent.mkdir(parents=True)
    settings.upload(model).write_bytes(EXAMPLE.read_bytes())
    stages: list[str] = []
    tasks = make_tasks(settings, lambda _, stage: stages.append(stage.value))
    first = tasks.ingest(IngestTask(model=model, file_name="a.step", anew=True))
    once = list(stages)
    assert once[0] == "read"
    assert len(once) > 3
    assert tasks.ingest(IngestTask(model=model, file_name="b.step", anew=True)) == first
    assert stages == 2 * once
    tasks.ingest(IngestTask(model=model, file_name="a.step"))
    assert stages == 2 * once


def test_what_is_kept_is_for_one_user_alone(tmp_path: Path) -> None:
    old = keep_private()
    try:
        (tmp_path / "folder").mkdir()
        (tmp_path / "folder/file").write_text("x")
    finally:
        keep_private(old)
    modes = [stat.S_IMODE((tmp_path / name).stat().st_mode) for name in ("folder", "folder/file")]
    assert modes == [0o700, 0o600]


def test_two_requests_for_the_same_questions_do_not_take_them_from_each_other(redis_url: str) -> None:
    """The first is over the limit, the second is not, as a question was answered between them."""

    def task(job: str) -> QuestionTask:
        return QuestionTask(model="a" * 64, job=job * 32, tenant="t", key="k", question="How many?")

    async def race() -> tuple[list[bool], list[str]]:
        async with Redis.from_url(redis_url, decode_responses=True) as redis:
            state = State(redis, 30)
            taken = [await state.reserve([task("1"), task("2")], 2)]
            taken.append(await state.reserve([task("3")], 2))  # the first request
            await redis.zrem(key_of("open", "k"), task("1").job)
            taken.append(await state.reserve([task("3")], 2))  # the second, of the same idempotency key
            taken.append(await state.reserve([task("3")], 2))  # and once more: it counts once
            taken.append(await state.reserve([task("4")], 2))
            return taken, sorted(str(job) for job in await redis.zrange(key_of("open", "k"), 0, -1))

    taken, counted = asyncio.run(race())
    assert taken == [True, False, True, True, False]
    assert counted == [task("2").job, task("3").job]


@pytest.mark.parametrize("crashes", [1, 2])
def test_a_program_whose_interpreter_crashed_is_run_once_more(crashes: int, monkeypatch: pytest.MonkeyPatch) -> None:
    runs: list[str] = []
    execute = Run.execute

    def crashing(run: Run, *arguments: object) -> None:
        runs.append("run")
        if len(runs) <= crashes:
            run.ending = Ending(RunStatus.CRASHED, "the interpreter crashed")
            return
        execute(run, *arguments)  # type: ignore[arg-type]

    monkeypatch.setattr(Run, "execute", crashing)
    with Sandbox(workers=1) as sandbox:
        outcome = sandbox.run("solution = 6 * 7", None)  # type: ignore[arg-type]
    assert len(runs) == 2
    assert (outcome.status, outcome.value) == ((RunStatus.OK, 42) if crashes == 1 else (RunStatus.CRASHED, None))
