"""What an agent's calls share: the models that are open, the answers that were given, and what ids stand for."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Sequence
from functools import wraps
from pathlib import Path
from threading import Lock
from typing import ParamSpec, TypeVar

from mcp.server.mcpserver.exceptions import ToolError

from querycad_answering.drawing.callouts import ids_in, ids_text
from querycad_contracts import Part
from querycad_segworker.errors import FileProblem

from .model import Model, Reply
from .runtime import EmbeddedRuntime

T = TypeVar("T")
P = ParamSpec("P")

MODELS_OPEN = 16
ANSWERS_KEPT = 100
FILES_TOLD, FOLDERS_READ = 20, 100
"""Where the file that was asked for is not."""
SUFFIXES = (".step", ".stp", ".stpz", ".igs", ".iges", ".brep", ".zip", ".stl", ".obj", ".3mf")


class Session:
    """The models that are open, and the answers that were given."""

    def __init__(self, runtime: EmbeddedRuntime, folder: Path | None) -> None:
        self._runtime = runtime
        self._folder = folder
        self._models: OrderedDict[str, Model] = OrderedDict()
        self._answers: OrderedDict[str, tuple[Model, Reply]] = OrderedDict()
        self._asked = 0
        self._lock = Lock()

    def guarded(self, tool: Callable[P, T]) -> Callable[P, T]:
        """The tool, one call at a time; what went wrong is said with what to do next."""

        @wraps(tool)
        def guard(*arguments: P.args, **named: P.kwargs) -> T:
            with self._lock:
                try:
                    return tool(*arguments, **named)
                except (FileProblem, ValueError) as problem:
                    raise ToolError(str(problem)) from problem

        return guard

    def open(self, file: str) -> str:
        """The id of the model in the file."""
        path = Path(file).expanduser()
        if self._folder is not None:
            path = self._folder / path
            if not path.resolve().is_relative_to(self._folder):
                raise ToolError(f"only files in {self._folder} are opened; {_there(self._folder)}")
        if not path.is_file():
            near = next((each for each in (path, path.parent) if each.is_dir()), self._folder or Path.cwd())
            raise ToolError(f"{'no file' if path.is_dir() else 'no such file'}: {path}; {_there(near.resolve())}")
        model = self._runtime.open(path)
        name = f"{path.stem}-{model.id[:8]}"
        self._models[name] = model
        self._models.move_to_end(name)
        while len(self._models) > MODELS_OPEN:
            self._models.popitem(last=False)
        return name

    def model(self, name: str) -> Model:
        """The open model."""
        if name not in self._models:
            known = f"open are {', '.join(self._models)}" if self._models else "none is open"
            raise ToolError(f"no open model is called {name!r}: call open_model with its file first; {known}")
        self._models.move_to_end(name)
        return self._models[name]

    def part(self, model: Model, part: str) -> Part:
        """The part with this id. Raises ToolError."""
        found = self.parts(model, [part])
        if len(found) != 1:
            raise ToolError(f"{part!r} is {len(found)} parts: {ids_text([each.id for each in found])}; name one")
        return found[0]

    def parts(self, model: Model, ids: Sequence[str]) -> list[Part]:
        """The parts with these ids: in short too, as they are told, or an answer's, whose parts are meant.

        Raises ToolError.
        """
        named = [each for text in ids for each in ids_in(text)]
        spread = [each for name in named for each in (self._of(model, name) if name in self._answers else [name])]
        return [self._part(model, name) for name in dict.fromkeys(spread)]

    def _of(self, model: Model, answer: str) -> list[str]:
        asked, reply = self._answers[answer]
        if asked.id != model.id:
            raise ToolError(f"{answer} is about another model, {asked.name}: name parts of this one")
        return [each.id for each in reply.parts]

    def _part(self, model: Model, part: str) -> Part:
        try:
            return model.part(part)
        except KeyError:
            kind = part.rpartition("-")[0]
            same = [each.id for each in model.parts if each.kind == kind]
            has = f"it has {ids_text(same)}" if same else "find_parts and the tables tell which there are"
            raise ToolError(f"the model has no part {part!r}; {has}") from None

    def keep(self, model: Model, reply: Reply) -> str:
        """The id that an answer about the model is known by from now on."""
        self._asked += 1
        name = f"answer-{self._asked}"
        self._answers[name] = (model, reply)
        while len(self._answers) > ANSWERS_KEPT:
            self._answers.popitem(last=False)
        return name

    def answer(self, name: str) -> Reply:
        """The answer that was given."""
        if name not in self._answers:
            raise ToolError(f"no answer is called {name!r} (any more): ask again, and take the id of that answer")
        return self._answers[name][1]

    @property
    def models(self) -> dict[str, Model]:
        """Those that are open, the last used last."""
        return dict(self._models)


def _there(folder: Path) -> str:
    """Which files could be opened in a folder? Where it holds none, in the folders in it."""
    names = _files(folder) or [f"{each.name}/{name}" for each in _folders(folder) for name in _files(each)]
    if not names:
        return f"{folder} holds no CAD file"
    more = f" and {len(names) - FILES_TOLD} more" if len(names) > FILES_TOLD else ""
    return f"{folder} holds {', '.join(names[:FILES_TOLD])}{more}"


def _files(folder: Path) -> list[str]:
    try:
        return sorted(each.name for each in folder.iterdir() if each.suffix.lower() in SUFFIXES)
    except OSError:
        return []


def _folders(folder: Path) -> list[Path]:
    try:
        inside = sorted(each for each in folder.iterdir() if each.is_dir() and not each.name.startswith("."))
    except OSError:
        return []
    return inside[:FOLDERS_READ]
