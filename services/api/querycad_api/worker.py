"""The question worker: `python -m querycad_api.worker`

It does a question's own steps, so that the web process may come and go; what it does is in the domains' `tasks`.
"""

from __future__ import annotations

from celery import Celery

from querycad_contracts import Queue
from querycad_contracts.infrastructure import keep_private
from querycad_contracts.infrastructure.workers import worker_app

from .models import tasks as models
from .questions import tasks as questions
from .questions.tasks import STORE_TRIES
from .settings import ApiSettings

MEMORY_MIB = 512
"""Size at which a process is replaced once its question is answered; it has some 100 after thousands of questions."""
HARD_MARGIN_S = 20


def make_app(settings: ApiSettings) -> Celery:
    """The Celery application of a question worker."""
    hard_s = settings.question_s + HARD_MARGIN_S
    app: Celery = worker_app(
        "querycad_questions",
        settings,
        [Queue.QUESTIONS],
        processes=settings.question_processes,
        memory_mib=MEMORY_MIB,
        longest_s=hard_s,
        store_tries=STORE_TRIES,
    )
    app.conf.update(
        task_default_queue=Queue.QUESTIONS.value,
        task_soft_time_limit=settings.question_s,
        task_time_limit=hard_s,
    )
    process = questions.Questions(settings)
    questions.register(app, process)
    models.register(app, lambda: process.ledger)
    return app


def main() -> None:
    """Works until it is told to stop; SIGTERM lets running questions end."""
    keep_private()
    settings = ApiSettings.read()
    make_app(settings).worker_main(
        ["worker", "--loglevel=INFO", "--without-gossip", "--without-mingle", "--hostname=questions@%h"]
    )


if __name__ == "__main__":
    main()
