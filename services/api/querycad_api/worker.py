"""The question worker: `python -m querycad_api.worker`

It does a question's own steps, so that the web process may come and go.
A question whose worker died is done by another; after `ATTEMPTS` it is given up. Whatever happens, a job ends with a
record.
"""

from __future__ import annotations

import logging
import time
from typing import Any, cast

from celery import Celery, Task
from celery.bootsteps import StartStopStep
from celery.exceptions import SoftTimeLimitExceeded
from celery.signals import heartbeat_sent, setup_logging
from kombu import Queue as KombuQueue
from redis import Redis
from redis.backoff import ExponentialBackoff
from redis.retry import Retry

from querycad_answering.answering import answer_question
from querycad_answering.llm import LlmWriter
from querycad_contracts import (
    AnswerRecord,
    Failure,
    ModelResource,
    ModelStatus,
    ModelSummary,
    Program,
    QuestionTask,
    Queue,
    RunOutcome,
    TaskFailure,
    TaskFailureKind,
    TaskName,
    TaskOutcome,
    alive_key,
    start_logging,
    start_worker_tracing,
    working_for,
)

from .answered import cancelled, failed
from .ledger import Begun, Ledger
from .sandbox import RunRefused, SandboxClient, SandboxUnavailable
from .settings import ApiSettings

ATTEMPTS = 2
"""A question that has taken its worker with it twice will do so again."""
RETRIES = 5
"""Of a sandbox that does not answer; with the pauses below some 10 s, in which it is started again."""
PAUSE_S = 2.0
READING_S = 0.2
"""Between two looks at a model that is still being read, growing to five times that."""
READING_AT_MOST_S = 3600.0
MEMORY_MIB = 512
"""Size at which a process is replaced once its question is answered; it has some 100 after thousands of questions."""
HARD_MARGIN_S = 20
VISIBILITY_MARGIN_S = 10
STORE_TRIES, STORE_PAUSE_S = 100, 1.0
"""A worker waits for a store that is away: a task that fails for want of it would be lost."""
RESTORE_S = 5
"""Between two looks for questions that were taken and not answered in time."""
UNACKED_INDEX = "querycad:questions:unacked_index"
ALIVE_S = 10

log = logging.getLogger("querycad_api.worker")  # it is run as __main__


def make_app(settings: ApiSettings) -> Celery:
    """The Celery application of a question worker."""
    app = Celery("querycad_api", broker=settings.redis_url)
    redis = Redis.from_url(settings.redis_url)  # connects when used, in each process anew
    hard_s = settings.question_s + HARD_MARGIN_S
    app.conf.update(
        task_queues=[KombuQueue(Queue.QUESTIONS.value)],
        task_default_queue=Queue.QUESTIONS.value,
        worker_concurrency=settings.question_processes,
        worker_pool="prefork",
        worker_prefetch_multiplier=1,
        worker_max_memory_per_child=MEMORY_MIB * 1024,
        worker_redirect_stdouts=False,
        worker_cancel_long_running_tasks_on_connection_loss=False,
        broker_connection_retry_on_startup=True,
        broker_transport_options={
            "visibility_timeout": hard_s + VISIBILITY_MARGIN_S,
            # The segworkers' is another: whoever looks for lost tasks must not give out theirs too early.
            "unacked_key": "querycad:questions:unacked",
            "unacked_index_key": UNACKED_INDEX,
            "unacked_mutex_key": "querycad:questions:unacked_mutex",
            "unacked_restore_interval": RESTORE_S,
            "unacked_restore_throttle": 1,
        },
        task_publish_retry_policy={
            "max_retries": STORE_TRIES,
            "interval_start": 0,
            "interval_step": 0.1,
            "interval_max": STORE_PAUSE_S,
        },
        task_acks_late=True,
        task_reject_on_worker_lost=True,
        task_ignore_result=True,
        task_soft_time_limit=settings.question_s,
        task_time_limit=hard_s,
    )
    process = Questions(settings)

    def question(self: Task, payload: dict[str, Any]) -> None:
        task = QuestionTask.model_validate(payload)
        with working_for(task.request):
            again_s = process.answer(task, int(self.request.retries))
        if again_s is not None:
            raise self.retry(countdown=again_s)

    def model_read(outcome: dict[str, Any], model: str, tenant: str, uploaded: str) -> None:
        process.ledger.finish_model(tenant, model, TaskOutcome[ModelSummary].model_validate(outcome), uploaded)

    def model_lost(_task_id: str, model: str, tenant: str, uploaded: str) -> None:
        failure = TaskFailure(
            kind=TaskFailureKind.INTERNAL, message="the file could not be read: its worker was stopped", retryable=True
        )
        process.ledger.finish_model(tenant, model, TaskOutcome[ModelSummary](failure=failure), uploaded)

    app.task(question, name=TaskName.QUESTION.value, bind=True, max_retries=None)
    app.task(model_read, name=TaskName.MODEL_READ.value)
    app.task(model_lost, name=TaskName.MODEL_LOST.value)

    heartbeat_sent.connect(lambda **_: redis.set(alive_key(Queue.QUESTIONS), 1, ex=ALIVE_S), weak=False)
    setup_logging.connect(lambda **_: start_logging("questions", settings.log_format), weak=False)
    start_worker_tracing("querycad-questions", settings.traces)
    if settings.sole_worker:
        app.steps["consumer"].add(_take_over(redis))
    return app


def _take_over(redis: Redis) -> type[StartStopStep]:
    """What a sole worker does each time that it connects: questions that were taken and not answered are due at once.

    Its predecessor may have died with them, or the store while it had them.
    """

    class TakeOver(StartStopStep):  # type: ignore[misc]  # Celery is untyped
        requires = ("celery.worker.consumer.tasks:Tasks",)

        def start(self, _consumer: object) -> None:
            for tag in cast("list[bytes]", redis.zrange(UNACKED_INDEX, 0, -1)):
                redis.zadd(UNACKED_INDEX, {tag: 0}, xx=True)

    return TakeOver


class Questions:
    """Answers questions, in one process. Connects when it is first used, which is after the fork."""

    def __init__(
        self, settings: ApiSettings, ledger: Ledger | None = None, sandbox: SandboxClient | None = None
    ) -> None:
        self._settings = settings
        self._ledger = ledger
        self._sandbox = sandbox
        self._llm = LlmWriter(settings)

    @property
    def ledger(self) -> Ledger:
        """Where models and jobs are finished."""
        if self._ledger is None:
            patience = Retry(ExponentialBackoff(cap=STORE_PAUSE_S), STORE_TRIES)
            redis = Redis.from_url(self._settings.redis_url, decode_responses=True, retry=patience)
            self._ledger = Ledger(redis, self._settings.answers_days)
        return self._ledger

    @property
    def sandbox(self) -> SandboxClient:
        """Where programs run."""
        if self._sandbox is None:
            self._sandbox = SandboxClient(self._settings.sandbox_url, self._settings.question_s)
        return self._sandbox

    def answer(self, task: QuestionTask, retries: int = 0) -> float | None:
        """Ends the job with a record; or, where something is not ready, in how many seconds is it to be tried again?"""
        start = time.perf_counter()
        job = self.ledger.begin_job(task)
        if job is None:
            return None  # done, or deleted
        if job.attempt > ATTEMPTS:
            message = f"given up: {ATTEMPTS} workers died while they answered this"
            self._finish(task, job, failed(task.question, Failure(category="internal", message=message)))
            return None
        if job.model is not None and job.model.status is ModelStatus.READING and job.age_s < READING_AT_MOST_S:
            self.ledger.wait_job(task.job, "the model's file is being read")
            return READING_S * min(5, 1 + retries)
        model_ms = round((time.perf_counter() - start) * 1e3, 3)
        try:
            record = self._record(task, job.model, model_ms)
        except SandboxUnavailable as error:
            log.warning("job %s: sandbox: %s", task.job, error)
            if retries < RETRIES:
                self.ledger.wait_job(task.job, "the sandbox does not answer")
                return PAUSE_S
            failure = Failure(category="internal", message="the sandbox does not answer; try again", retryable=True)
            record = failed(task.question, failure)
        except SoftTimeLimitExceeded:
            if (time.perf_counter() - start) < self._settings.question_s - 1:
                log.info("job %s: stopped", task.job)  # called off; if another job was meant, this one begins again
                self.ledger.wait_job(task.job, "interrupted")
                return 0.0
            message = f"not answered within {self._settings.question_s} s"
            record = failed(task.question, Failure(category="limit", message=message, retryable=True))
        self._finish(task, job, record)
        return None

    def _finish(self, task: QuestionTask, job: Begun, record: AnswerRecord) -> None:
        took_s = job.age_s
        self.ledger.finish_job(task, record, took_s)
        category = record.failure.category if record.failure else ""
        told = {"job": task.job, "status": record.status.value, "failure": category, "seconds": round(took_s, 3)}
        log.info("question done", extra=told)

    def _record(self, task: QuestionTask, model: ModelResource | None, model_ms: float) -> AnswerRecord:
        if model is None:  # deleted, as the question came
            return cancelled(task.question)
        if model.summary is None:
            late = Failure(category="internal", message="the model's file was not read in time", retryable=True)
            return failed(task.question, model.failure or late)

        def run(program: Program) -> RunOutcome:
            self.ledger.wrote(task.job, program.code, program.codegen)
            outcome = self.sandbox.run(program, task.model, task.grounding)
            self.ledger.ran(task.job, outcome.status, outcome.message)
            return outcome

        try:
            record = answer_question(task.question, run, task.unit, task, summary=model.summary, llm=self._llm)
        except RunRefused as refused:
            return failed(task.question, refused.failure)
        except (SoftTimeLimitExceeded, SandboxUnavailable):
            raise
        except Exception:
            log.exception("job %s failed", task.job)
            return failed(task.question, Failure(category="internal", message="the question could not be answered"))
        warnings = tuple(dict.fromkeys((*model.summary.warnings, *record.warnings)))
        return record.model_copy(update={"timings_ms": {"model": model_ms, **record.timings_ms}, "warnings": warnings})


def main() -> None:
    """Works until it is told to stop; SIGTERM lets running questions end."""
    settings = ApiSettings.read()
    make_app(settings).worker_main(
        ["worker", "--loglevel=INFO", "--without-gossip", "--without-mingle", "--hostname=questions@%h"]
    )


if __name__ == "__main__":
    main()
