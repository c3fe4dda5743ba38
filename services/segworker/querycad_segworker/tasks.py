"""What a segworker does when asked: plain functions from a task's payload to its value; `worker` puts them on queues.

A file that cannot be read, or an id that the model does not have, is an outcome, never an exception: only a flaw of
ours or of the machine is.
"""

from __future__ import annotations

import logging
import tempfile
import time
from collections import OrderedDict
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

from querycad_contracts import (
    AnswerRecord,
    DistanceTask,
    EdgeDistanceTask,
    ExtentTask,
    Face,
    FacesTask,
    FindFacesTask,
    FindPartsTask,
    FoundFaces,
    Grounded,
    GroundedBy,
    GroundedIds,
    GroundedParts,
    Grounding,
    GroundTask,
    IngestTask,
    MarkedPicture,
    MarkTask,
    ModelSummary,
    ModelTask,
    NoSuchMeasure,
    Part,
    PartsPage,
    PartsTask,
    PictureTask,
    ReadingStage,
    Shape,
    SightTask,
    TaskFailure,
    TaskFailureKind,
    TaskName,
    TaskOutcome,
    ViewTask,
    working_for,
)
from querycad_contracts.infrastructure import (
    WallsMissing,
    compressed_name,
    file_store,
    models_name,
    upload_name,
)

from .errors import DiskFull, FileProblem, NotRead
from .fusing.vision import Networks, networks_in
from .ingest import IngestLimits, Progress, ingest
from .local import LocalPartFinder
from .model import Artefacts, ModelStore, sheets_of
from .settings import SegworkerSettings
from .summary import summary

log = logging.getLogger(__name__)
P = TypeVar("P", bound=ModelTask)
DRAWN = 100
"""Views of one model that are kept, in whatever sizes; one that is gone is drawn again."""


class UnknownModelError(FileProblem):
    """No file with this id was uploaded."""


class ModelCache:
    """The models that one process has in memory: the most recently used, up to a number. For one thread."""

    def __init__(self, settings: SegworkerSettings, networks: Networks | None = None) -> None:
        """`networks` of the vision path; None: those whose weights are where the settings say."""
        self._settings = settings
        self._networks = networks or networks_in(settings.weights)
        self.files = file_store(settings)
        self._store = ModelStore(settings.models)
        self._kept: OrderedDict[str, LocalPartFinder] = OrderedDict()

    def artefacts(self, model: str) -> Artefacts:
        """What is kept of an uploaded model. Raises NotRead where an ingest has to read its file first."""
        known = self._store.find(model)
        if known is not None:
            return known
        folder = self.name_of(self._store.folder(model))
        if self.files.fetch_folder(folder) and (known := self._store.find(model)) is not None:
            return known
        if not self.files.exists(upload_name(model)):
            raise UnknownModelError("no such model: upload its file first")
        raise NotRead("the file has to be read first")

    def read(self, model: str, file_name: str, progress: Progress | None = None, anew: bool = False) -> Artefacts:
        """What is kept of an uploaded model; its file is read now if need be, or `anew`. Raises FileProblem."""
        known = None
        with suppress(NotRead):
            known = self.artefacts(model)
        if known is not None and not anew:
            return known
        folder = self.name_of(self._store.folder(model))
        upload = self.files.fetch(upload_name(model))
        if upload is None:
            raise UnknownModelError("no such model: upload its file first")
        limits = IngestLimits(float(self._settings.ingest_s), self._settings.ingest_memory_mib * 2**20)
        try:
            made = ingest(upload, self._store, limits, progress, file_name, anew)
        except FileProblem:
            self.drop_if_deleted(model)  # then it is no fault of the file's
            raise
        self.files.keep_folder(folder)
        return made

    def made_of(self, model: str, file_name: str, make: Callable[[Artefacts, Path], None]) -> str:
        """The name, in the store, of a file that is made of the model's artefacts, now if it is not there yet."""
        artefacts = self.artefacts(model)
        name = self.name_of(artefacts.folder / "drawn" / file_name)
        made = self.made(name, lambda path: make(artefacts, path))
        _keep_newest(artefacts.folder / "drawn")
        self.drop_if_deleted(model)
        return made

    def made(self, name: str, make: Callable[[Path], None]) -> str:
        """The name, in the store, of a file that is made now if it is not there yet: all at once, or not at all."""
        if self.files.fetch(name) is None:
            with tempfile.TemporaryDirectory(prefix="draw-", dir=self.files.home) as scratch:
                unfinished = Path(scratch) / Path(name).name
                make(unfinished)
                self.files.keep(name, unfinished)
        return name

    def fetch_sheets(self, record: AnswerRecord, artefacts: Artefacts) -> None:
        """Brings here the sheets of what vision saw, where another machine drew them."""
        for name in sheets_of(record):
            self.files.fetch(self.name_of(artefacts.sight(name)))

    def drop_if_deleted(self, model: str, *names: str) -> None:
        """Removes what was made of a model, and the files of these names, if it was deleted while they were made.

        Raises UnknownModelError then. The upload is the first that a deletion removes: what is made after it is
        removed here, what was made before it there.
        """
        if self.files.exists(upload_name(model)):
            return
        self._kept.pop(model, None)
        for name in (models_name(model), *names):
            self.files.remove(name)
        raise UnknownModelError("the model was deleted meanwhile")

    def _keep(self, unfinished: Path, place: Path) -> None:
        self.files.keep(self.name_of(place), unfinished)

    def _fetch(self, place: Path) -> None:
        self.files.fetch(self.name_of(place))

    def name_of(self, path: Path) -> str:
        """What is a file of this machine called in the store?"""
        return path.relative_to(self.files.home).as_posix()

    def finder(self, model: str) -> LocalPartFinder:
        """The recognised model. Raises FileProblem."""
        if model not in self._kept:
            self._kept[model] = LocalPartFinder(
                self.artefacts(model), networks=self._networks, keep=self._keep, fetch=self._fetch
            )
        self._kept.move_to_end(model)
        while len(self._kept) > self._settings.segworker_models:
            self._kept.popitem(last=False)
        return self._kept[model]


@dataclass(frozen=True, slots=True)
class Tasks:
    """Every task, on the models of one process."""

    cache: ModelCache
    told: Callable[[str, ReadingStage], None] = lambda _model, _stage: None
    """Told the stage of reading that begins for a model."""

    def ingest(self, task: IngestTask) -> ModelSummary:
        """What does the uploaded file hold? Read once; known content is answered at once."""

        def progress(stage: str) -> None:
            self.told(task.model, ReadingStage(stage))

        artefacts = self.cache.read(task.model, task.file_name, progress, task.anew)
        found = summary(artefacts.load_model())
        self.cache.drop_if_deleted(task.model)
        return found.model_copy(update={"kept_bytes": artefacts.size_bytes()})

    def shape(self, task: ModelTask) -> Shape:
        """What is the whole model?"""
        return self.cache.finder(task.model).shape()

    def find_parts(self, task: FindPartsTask) -> Grounding:
        """Which parts does the description mean?"""
        finder = self.cache.finder(task.model)
        if task.sight_alone:
            return finder.look(str(task.description))
        found = finder.grounded_by(task.grounding).find_parts(task.description, task.sides)
        if task.grounding is not GroundedBy.GEOMETRY:  # else nothing is written
            self.cache.drop_if_deleted(task.model)
        return found

    def ground(self, task: GroundTask) -> GroundedParts:
        """In which ways can the queries of a question be grounded on the model?"""
        finder = self.cache.finder(task.model).grounded_by(task.grounding)
        ways = finder.ground(task.queries)
        if task.grounding is not GroundedBy.GEOMETRY:  # else nothing is written
            self.cache.drop_if_deleted(task.model)
        parts = {part.id: _bare(part) for each in ways for way in each for part in way.parts}
        return GroundedParts(
            whole=_bare(finder.whole),
            names=tuple(sorted(finder.names)),
            kinds=finder.kinds,
            parts=tuple(parts.values()),
            ways=tuple(tuple(_by_ids(way) for way in each) for each in ways),
        )

    def faces(self, task: FacesTask) -> tuple[Face, ...]:
        """What are these faces?"""
        return self.cache.finder(task.model).faces(task.ids)

    def find_faces(self, task: FindFacesTask) -> FoundFaces:
        """Which faces are so?"""
        return self.cache.finder(task.model).find_faces(task.query)

    def extent(self, task: ExtentTask) -> float:
        """How far does a part extend along a direction, in metres?"""
        return self.cache.finder(task.model).extent(task.part, task.direction)

    def distance(self, task: DistanceTask) -> float:
        """How far apart are the surfaces of two parts, in metres?"""
        return self.cache.finder(task.model).distance(task.part_a, task.part_b)

    def overlap(self, task: DistanceTask) -> float:
        """Which volume do two bodies share, in m3?"""
        return self.cache.finder(task.model).overlap(task.part_a, task.part_b)

    def edge_distance(self, task: EdgeDistanceTask) -> float:
        """How far is a part from the outer edge of its face, in metres?"""
        return self.cache.finder(task.model).edge_distance(task.part)

    def parts(self, task: PartsTask) -> PartsPage:
        """Which parts does the model have? All of them, or one page, by id."""
        parts = self.cache.finder(task.model).model.parts
        ids = set(task.ids)
        wanted = [part for part in parts if task.kind in (None, part.kind) and (not ids or part.id in ids)]
        end = None if task.limit is None else task.offset + task.limit
        return PartsPage(items=tuple(wanted[task.offset : end]), total=len(wanted))

    def picture(self, task: PictureTask) -> str:
        """Draws the parts that an answer rests on; the name of the file in the store."""
        from .render.evidence import draw_evidence  # here: most tasks draw nothing, and numpy's import is not free

        def draw(path: Path) -> None:
            artefacts = self.cache.artefacts(task.model)
            self.cache.fetch_sheets(task.record, artefacts)
            draw_evidence(artefacts, task.record, path)

        name = self.cache.made(task.name, draw)
        self.cache.drop_if_deleted(task.model, name)
        return name

    def view(self, task: ViewTask) -> str:
        """Draws the model as it is seen from there; the name of the file in the store."""
        from .render.plain import draw_view  # here: as above

        def draw(artefacts: Artefacts, path: Path) -> None:
            draw_view(artefacts, task.view, (task.width, task.height), path)

        return self.cache.made_of(task.model, f"{task.view.value}-{task.width}x{task.height}.png", draw)

    def mark(self, task: MarkTask) -> tuple[MarkedPicture, ...]:
        """Draws the pictures that eyes are shown; their files are with the model's in the store."""
        finder = self.cache.finder(task.model)
        made = finder.marked(task.asked)
        self.cache.drop_if_deleted(task.model)
        return tuple(one.model_copy(update={"name": self.cache.name_of(finder.picture_file(one.name))}) for one in made)

    def sight(self, task: SightTask) -> bool:
        """Keeps what eyes saw."""
        self.cache.finder(task.model).keep_sight(task.sight)
        self.cache.drop_if_deleted(task.model)
        return True

    def glb(self, task: ModelTask) -> str:
        """Writes the model as binary glTF, and compressed beside it; the name of the first in the store."""
        from .render.glb import compress, write_glb  # here: as above

        name = self.cache.made_of(task.model, "bodies.glb", write_glb)
        plain = self.cache.files.fetch(name)
        if plain is not None:  # else it was deleted meanwhile, which the next line tells
            self.cache.made(compressed_name(name), lambda path: compress(plain, path))
        self.cache.drop_if_deleted(task.model)
        return name

    def table(self) -> dict[TaskName, Callable[[dict[str, Any]], str]]:
        """Every task by its name, from its payload as JSON data to its TaskOutcome as JSON text."""
        return {
            TaskName.INGEST: _as_data(IngestTask, self.ingest),
            TaskName.SHAPE: _as_data(ModelTask, self.shape),
            TaskName.FIND_PARTS: _as_data(FindPartsTask, self.find_parts),
            TaskName.GROUND: _as_data(GroundTask, self.ground),
            TaskName.FACES: _as_data(FacesTask, self.faces),
            TaskName.FIND_FACES: _as_data(FindFacesTask, self.find_faces),
            TaskName.EXTENT: _as_data(ExtentTask, self.extent),
            TaskName.DISTANCE: _as_data(DistanceTask, self.distance),
            TaskName.OVERLAP: _as_data(DistanceTask, self.overlap),
            TaskName.EDGE_DISTANCE: _as_data(EdgeDistanceTask, self.edge_distance),
            TaskName.PARTS: _as_data(PartsTask, self.parts),
            TaskName.PICTURE: _as_data(PictureTask, self.picture),
            TaskName.VIEW: _as_data(ViewTask, self.view),
            TaskName.GLB: _as_data(ModelTask, self.glb),
            TaskName.MARK: _as_data(MarkTask, self.mark),
            TaskName.SIGHT: _as_data(SightTask, self.sight),
        }


def _keep_newest(folder: Path) -> None:
    """Removes what is more than `DRAWN` files of a folder, the oldest first: every size of every view is one."""
    paths = sorted(folder.iterdir(), key=lambda path: path.stat().st_mtime) if folder.is_dir() else []
    for path in paths[:-DRAWN]:
        path.unlink(missing_ok=True)


def _bare(part: Part) -> Part:
    """The part without its lists of faces and children, which a large model has thousands of."""
    return part.model_copy(update={"faces": (), "children": ()})


def _by_ids(way: Grounded) -> GroundedIds:
    ids = tuple(part.id for part in way.parts)
    return GroundedIds(parts=ids, features=way.features, unchecked=way.unchecked, reason=way.reason)


def make_tasks(settings: SegworkerSettings, told: Callable[[str, ReadingStage], None] | None = None) -> Tasks:
    """The tasks of a process with these settings; `told` is told which stage of reading a file begins."""
    cache = ModelCache(settings)
    return Tasks(cache, told) if told is not None else Tasks(cache)


def _as_data(payload: type[P], work: Callable[[P], Any]) -> Callable[[dict[str, Any]], str]:
    """The task with its payload, value and failures as what the store carries."""

    def task(data: dict[str, Any]) -> str:
        asked = payload.model_validate(data)
        start = time.perf_counter()
        with working_for(asked.request):
            outcome = _outcome(lambda: work(asked)).model_dump_json()
            ms = round((time.perf_counter() - start) * 1e3, 1)
            log.info("%s done", payload.__name__, extra={"model": asked.model, "ms": ms})
            return outcome

    return task


def _outcome(work: Callable[[], Any]) -> TaskOutcome[Any]:
    try:
        return TaskOutcome[Any](value=work())
    except FileProblem as problem:
        kind = TaskFailureKind.NOT_READ if isinstance(problem, NotRead) else TaskFailureKind.FILE
        failure = TaskFailure(kind=kind, message=str(problem), retryable=problem.retryable)
    except OSError as error:
        if error.errno not in DiskFull.CODES:
            raise
        failure = TaskFailure(kind=TaskFailureKind.FILE, message=str(DiskFull()), retryable=True)
    except WallsMissing as error:
        failure = TaskFailure(kind=TaskFailureKind.INTERNAL, message=str(error), retryable=True)
    except KeyError as error:
        failure = TaskFailure(
            kind=TaskFailureKind.UNKNOWN_ID, message=f"no such id: {error.args[0] if error.args else error}"
        )
    except NoSuchMeasure as error:
        failure = TaskFailure(kind=TaskFailureKind.NO_MEASURE, message=str(error))
    log.info("no value: %s", failure.message)
    return TaskOutcome[Any](failure=failure)
