"""The question worker: `python -m querycad_api.worker`

It does a question's own steps, so that the web process may come and go; what it does is in the domains' `tasks`.
"""

from __future__ import annotations

from typing import cast

from celery import Celery
from celery.bootsteps import StartStopStep
from celery.signals import heartbeat_sent, setup_logging
from kombu import Queue as KombuQueue
from redis import Redis

from querycad_contracts import Queue, alive_key, keep_private, start_logging, start_worker_tracing

from .models import tasks as models
from .questions import tasks as questions
from .questions.tasks import STORE_PAUSE_S, STORE_TRIES
from .settings import ApiSettings

MEMORY_MIB = 512
"""Size at which a process is replaced once its question is answered; it has some 100 after thousands of questions."""
HARD_MARGIN_S = 20
VISIBILITY_MARGIN_S = 10
RESTORE_S = 5
"""Between two looks for questions that were taken and not answered in time."""
UNACKED_INDEX = "querycad:questions:unacked_index"
ALIVE_S = 10


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
    process = questions.Questions(settings)
    questions.register(app, process)
    models.register(app, lambda: process.ledger)
    heartbeat_sent.connect(lambda **_: redis.set(alive_key(Queue.QUESTIONS), "", ex=ALIVE_S), weak=False)
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


def main() -> None:
    """Works until it is told to stop; SIGTERM lets running questions end."""
    keep_private()
    settings = ApiSettings.read()
    make_app(settings).worker_main(
        ["worker", "--loglevel=INFO", "--without-gossip", "--without-mingle", "--hostname=questions@%h"]
    )


if __name__ == "__main__":
    main()
