"""What all services run on alike: settings from the environment, logs, traces, files, tasks on queues, walls, workers.

Contracts import nothing from here. `workers` and `walls` are imported by name, by those processes alone that need them.
"""

from .files import BucketStore, FileStore, FolderStore, file_store
from .logs import LogFormat, start_logging
from .processes import end_with_parent, keep_private, processors
from .settings import (
    BrokerSettings,
    Settings,
    StorageSettings,
    Walls,
    WallSettings,
    WallsMissing,
    WorkerSettings,
    compressed_name,
    models_name,
    picture_name,
    upload_name,
)
from .task_messages import task_message
from .tracing import carried_trace, carry_trace, start_tracing
