"""How does one get the benchmark's STEP files and question files?

`python -m benchmark.build_all FOLDER` writes FOLDER/<name>.step for every script in models/ (or those after `--only`);
`--questions` writes questions/<name>.json too; `--last-look` takes the scripts of last_look/models instead, whose
questions are files of their own. Run it in the repository's root.
"""

from __future__ import annotations

import argparse
import importlib
import json
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, dataclass
from multiprocessing import get_context
from pathlib import Path
from typing import Any

from benchmark.kit import Form, Item, Model

FOLDER = Path(__file__).parent
QUESTIONS = FOLDER / "questions"
PREFIX = "build_"


@dataclass(frozen=True, slots=True)
class Script:
    """A script of models/, loaded, with its own parameters filled in."""

    name: str
    model: Model
    shape: Any  # what build(p) returns, None until built
    items: list[Item]


def names(package: str = "models") -> list[str]:
    """Which models are there? In alphabetical order."""
    folder = FOLDER.joinpath(*package.split("."))
    return sorted(path.stem.removeprefix(PREFIX) for path in folder.glob(f"{PREFIX}*.py"))


def load(name: str, *, build: bool = True) -> Script:
    """What does a model's script give? Without `build`, its questions only, which is quick."""
    module = importlib.import_module(f"benchmark.models.{PREFIX}{name}")
    p = module.P()
    return Script(name, module.MODEL, module.build(p) if build else None, module.questions(p))


def question_file(script: Script) -> str:
    """Which text has the model's question file?"""
    content = {
        "model": f"{script.name}.step",
        "title": script.model.title,
        "split": script.model.split,
        "form": script.model.form,
        "unit": script.model.unit,
        "bodies": script.model.bodies,
        "items": [asdict(item) for item in script.items],
    }
    return json.dumps(content, indent=1, ensure_ascii=False) + "\n"


def write(name: str, folder: Path, package: str = "models") -> Path:
    """Where is the model's STEP file? ValueError: the shape is not valid, or not as many solids as the script says."""
    module = importlib.import_module(f"benchmark.{package}.{PREFIX}{name}")
    return _exported(name, module.MODEL, module.build(module.P()), folder)


def _exported(name: str, model: Model, shape: Any, folder: Path) -> Path:
    from build123d import Compound, Part
    from OCP.BRepBuilderAPI import BRepBuilderAPI_NurbsConvert

    from _example import export

    if len(shape.solids()) != model.bodies or not shape.is_valid:
        raise ValueError(f"{name}: {len(shape.solids())} solids instead of {model.bodies}, or an invalid one")
    if model.form is Form.BSPLINE:
        shape = Part(BRepBuilderAPI_NurbsConvert(shape.wrapped, True).Shape())
    elif model.form is Form.SURFACES:
        shape = Compound(shape.faces())
    step = folder / f"{name}.step"
    export(shape, step, 0 if model.form is Form.SURFACES else model.bodies, {"mm": "MM", "in": "INCH"}[model.unit])
    return step


def main() -> None:
    """Builds each model in a process of its own, as the kernel numbers products through a whole process."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="where the STEP files go")
    parser.add_argument("--only", nargs="+", metavar="NAME", help="these models; default: all")
    parser.add_argument("--last-look", action="store_true", help="the models of last_look/")
    parser.add_argument("--questions", action="store_true", help="write the question files too")
    parser.add_argument("--jobs", type=int, default=1, help="models built at the same time")
    options = parser.parse_args()
    package = "last_look.models" if options.last_look else "models"
    known = names(package)
    if unknown := set(options.only or ()) - set(known):
        parser.error(f"no such model: {', '.join(sorted(unknown))}")
    chosen = options.only or known
    options.folder.mkdir(parents=True, exist_ok=True)
    context = get_context("forkserver")
    context.set_forkserver_preload(["build123d"])
    with ProcessPoolExecutor(options.jobs, mp_context=context, max_tasks_per_child=1) as pool:
        tasks = {name: pool.submit(write, name, options.folder, package) for name in chosen}
        for name, task in tasks.items():
            step = task.result()
            print(f"{name}: {step.stat().st_size / 1e3:.0f} kB", flush=True)
    if options.questions and not options.last_look:
        QUESTIONS.mkdir(exist_ok=True)
        for name in chosen:
            (QUESTIONS / f"{name}.json").write_text(question_file(load(name, build=False)))


if __name__ == "__main__":
    main()
