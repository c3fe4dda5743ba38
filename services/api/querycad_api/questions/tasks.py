"""The question workers' task: one question to one record.

A question whose worker died is done by another; after `ATTEMPTS` it is given up. Whatever happens, a job ends with a
record.
"""

from __future__ import annotations

import logging
import time
from collections.abc import Callable
from dataclasses import replace
from functools import cache, cached_property, partial
from typing import Any, TypeVar

from celery import Celery, Task
from celery.exceptions import SoftTimeLimitExceeded
from redis import Redis
from redis.backoff import ExponentialBackoff
from redis.retry import Retry

from querycad_answering.answering import answer_question, described
from querycad_answering.llm import LlmWriter
from querycad_answering.parameters import fill_parameters
from querycad_answering.understanding import ModelView
from querycad_api.settings import ApiSettings
from querycad_api.store.keyspace import ModelStale
from querycad_api.store.ledger import Begun, Ledger
from querycad_contracts import (
    AnswerRecord,
    DescribeTask,
    Description,
    Failure,
    FailureCategory,
    GroundedBy,
    ModelResource,
    ModelStatus,
    ModelSummary,
    ModelTask,
    ParameterSet,
    ParametersTask,
    Program,
    QuestionTask,
    RunOutcome,
    TaskFailure,
    TaskFailureKind,
    TaskName,
    TaskOutcome,
    reply_key,
    working_for,
)
from querycad_contracts.infrastructure import file_store
from querycad_contracts.infrastructure.workers import REPLY_S, STORE_PAUSE_S

from .sandbox import RunRefused, SandboxClient, SandboxUnavailable
from .segworker import SegworkerClient

ATTEMPTS = 2
"""A question that has taken its worker with it twice will do so again."""
RETRIES = 5
"""Of a sandbox that does not answer; with the pauses below some 10 s, in which it is started again."""
PAUSE_S = 2.0
READING_S = 0.2
"""Between two looks at a model that is still being read, growing to five times that."""
BEING_READ = "the model's file is being read"
READING_AT_MOST_S = 3600.0
STORE_TRIES = 100
"""A worker waits for a store that is away: a task that fails for want of it would be lost."""

log = logging.getLogger(__name__)
T = TypeVar("T")
M = TypeVar("M", bound=ModelTask)


def register(app: Celery, questions: Questions) -> None:
    """Adds the tasks to a worker."""

    def question(self: Task, payload: dict[str, Any]) -> None:
        task = QuestionTask.model_validate(payload)
        with working_for(task.request):
            again_s = questions.answer(task, int(self.request.retries))
        if again_s is not None:
            raise self.retry(countdown=again_s)

    def reply(name: TaskName, kind: type[M], work: Callable[[M], TaskOutcome[Any]]) -> None:
        def replied(self: Task, payload: dict[str, Any]) -> None:
            task = kind.model_validate(payload)
            with working_for(task.request):
                questions.reply(self.request.id, work(task))

        app.task(replied, name=name.value, bind=True)

    app.task(question, name=TaskName.QUESTION.value, bind=True, max_retries=None)
    reply(TaskName.DESCRIPTION, DescribeTask, questions.described)
    reply(TaskName.PARAMETERS, ParametersTask, questions.filled)


class Questions:
    """Answers questions, in one process. Connects when it is first used, which is after the fork."""

    def __init__(
        self,
        settings: ApiSettings,
        ledger: Ledger | None = None,
        sandbox: SandboxClient | None = None,
        segworker: SegworkerClient | None = None,
    ) -> None:
        self._settings = settings
        self._ledger = ledger
        self._sandbox = sandbox
        self._segworker = segworker
        self._llm = LlmWriter(settings)
        self._files = file_store(settings)

    @cached_property
    def ledger(self) -> Ledger:
        """Where models and jobs are finished."""
        return self._ledger or Ledger(self._redis(), self._settings.answers_days)

    def _redis(self) -> Redis:
        patience = Retry(ExponentialBackoff(cap=STORE_PAUSE_S), STORE_TRIES)
        return Redis.from_url(self._settings.redis_url, decode_responses=True, retry=patience)

    @cached_property
    def segworker(self) -> SegworkerClient:
        """Who knows what words mean on a model."""
        return self._segworker or SegworkerClient(self._redis())

    @cached_property
    def sandbox(self) -> SandboxClient:
        """Where programs run."""
        settings = self._settings
        token = settings.sandbox_token.get_secret_value()
        return self._sandbox or SandboxClient(settings.sandbox_url, settings.question_s, token)

    def answer(self, task: QuestionTask, retries: int = 0) -> float | None:
        """Ends the job with a record; or, where something is not ready, in how many seconds is it to be tried again?"""
        start = time.perf_counter()
        job = self.ledger.begin_job(task)
        if job is None:
            return None  # done, or deleted
        if job.attempt > ATTEMPTS:
            message = f"abandoned after {ATTEMPTS} workers crashed while answering this"
            failure = Failure(category=FailureCategory.INTERNAL, message=message)
            self._finish(task, job, AnswerRecord.failed(task.question, failure))
            return None
        if job.model is not None and job.model.status is ModelStatus.READING and job.age_s < READING_AT_MOST_S:
            self.ledger.wait_job(task.job, BEING_READ)
            return READING_S * min(5, 1 + retries)
        model_ms = round((time.perf_counter() - start) * 1e3, 3)
        try:
            record = self._record(task, job.model, model_ms)
        except ModelStale:
            self.ledger.read_again(task.tenant, task.model)
            self.ledger.wait_job(task.job, BEING_READ)
            return READING_S
        except SandboxUnavailable as error:
            log.warning("job %s: sandbox: %s", task.job, error)
            if retries < RETRIES:
                self.ledger.wait_job(task.job, "the sandbox does not answer")
                return PAUSE_S
            failure = Failure(
                category=FailureCategory.INTERNAL, message="the sandbox does not answer; try again", retryable=True
            )
            record = AnswerRecord.failed(task.question, failure)
        except SoftTimeLimitExceeded:
            if (time.perf_counter() - start) < self._settings.question_s - 1:
                log.info("job %s: stopped", task.job)  # called off; if another job was meant, this one begins again
                self.ledger.wait_job(task.job, "interrupted")
                return 0.0
            message = f"not answered within {self._settings.question_s} s"
            record = AnswerRecord.failed(
                task.question, Failure(category=FailureCategory.LIMIT, message=message, retryable=True)
            )
        self._finish(task, job, record)
        return None

    def described(self, task: DescribeTask) -> TaskOutcome[Description]:
        """What is the model, and what can be asked about it?"""

        def run(program: Program) -> RunOutcome:
            return self.sandbox.run(program, task.model)

        return _tried(lambda: described(run, self._view(task, task.summary), task.unit))

    def filled(self, task: ParametersTask) -> TaskOutcome[ParameterSet]:
        """What are the parameters of a model?"""
        asked, grounding = task.asked, task.asked.grounding
        other = cache(partial(self.segworker.parts, asked.other)) if asked.other is not None else None

        def run(program: Program) -> RunOutcome:
            return self.sandbox.run(program, task.model, grounding)

        def fill() -> ParameterSet:
            view = self._view(task, task.summary, grounding)
            found = fill_parameters(asked, view, run, other=other, summary=task.summary, llm=self._llm)
            return found.model_copy(update={"model": task.model})

        return _tried(fill)

    def reply(self, task_id: str, outcome: TaskOutcome[Any]) -> None:
        """Leaves the outcome for whoever waits for it."""
        with self._redis() as redis, redis.pipeline() as pipe:
            pipe.rpush(reply_key(task_id), outcome.model_dump_json())
            pipe.expire(reply_key(task_id), REPLY_S)
            pipe.execute()

    def _view(self, task: ModelTask, summary: ModelSummary, grounding: GroundedBy = GroundedBy.GEOMETRY) -> ModelView:
        """What readings are ranked on; all parts are fetched only where a description is asked for."""
        view = self.segworker.view(task.model, grounding)
        return replace(view, contents=cache(lambda: (summary, self.segworker.parts(task.model))))

    def _finish(self, task: QuestionTask, job: Begun, record: AnswerRecord) -> None:
        took_s = job.age_s
        self.ledger.finish_job(task, record, took_s)
        category = record.failure.category if record.failure else ""
        told = {"job": task.job, "status": record.status.value, "failure": category, "seconds": round(took_s, 3)}
        log.info("question done", extra=told)

    def _record(self, task: QuestionTask, model: ModelResource | None, model_ms: float) -> AnswerRecord:
        if model is None:  # deleted, as the question came
            return AnswerRecord.cancelled(task.question)
        if model.summary is None:
            late = Failure(
                category=FailureCategory.INTERNAL, message="the model's file was not read in time", retryable=True
            )
            return AnswerRecord.failed(task.question, model.failure or late)
        summary = model.summary

        def run(program: Program) -> RunOutcome:
            self.ledger.wrote(task.job, program.code, program.codegen)
            outcome = self.sandbox.run(program, task.model, task.grounding)
            self.ledger.ran(task.job, outcome.status, outcome.message)
            return outcome

        try:
            view = self._view(task, summary, task.grounding)
            place = self.segworker.place(task.model, self._files)
            llm = self._llm.resuming(self.ledger.transcript(task.job))
            record = answer_question(task.question, run, view, task.unit, task, summary=summary, llm=llm, place=place)
        except RunRefused as refused:
            return AnswerRecord.failed(task.question, refused.failure)
        except (SoftTimeLimitExceeded, SandboxUnavailable, ModelStale):
            raise
        except Exception:
            log.exception("job %s failed", task.job)
            return AnswerRecord.failed(
                task.question, Failure(category=FailureCategory.INTERNAL, message="the question could not be answered")
            )
        warnings = tuple(dict.fromkeys((*summary.warnings, *record.warnings)))
        return record.model_copy(update={"timings_ms": {"model": model_ms, **record.timings_ms}, "warnings": warnings})


def _tried(work: Callable[[], T | None]) -> TaskOutcome[T]:
    """What comes of work that somebody waits for, or why nothing does."""
    try:
        return TaskOutcome(value=work())
    except RunRefused as refused:
        failure = TaskFailure(kind=TaskFailureKind.FILE, message=refused.failure.message)
    except ModelStale as stale:
        failure = TaskFailure(kind=TaskFailureKind.NOT_READ, message=str(stale), retryable=True)
    except SandboxUnavailable as error:
        log.warning("sandbox: %s", error)
        failure = TaskFailure(kind=TaskFailureKind.INTERNAL, message="the sandbox does not answer", retryable=True)
    return TaskOutcome(failure=failure)
