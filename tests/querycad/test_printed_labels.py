"""What is printed of a model can be asked for: every label reaches exactly the parts that it is printed of."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterable, Iterator
from pathlib import Path

import pytest
from tests.segworker.shapes import ball, box, chamfered, compound, cone, cut, cylinder, fuse, upright, write_step

from querycad_answering.addressing import address
from querycad_answering.drawing.callouts import callouts, carried_sections
from querycad_answering.drawing.describing import SURFACES, describe, is_bare_surface
from querycad_answering.llm.facts import facts
from querycad_contracts import Part, PartKind
from querycad_language.describe import plural_of
from querycad_segworker.grounding.find import find
from querycad_segworker.grounding.inventory import Inventory
from querycad_segworker.grounding.printed import group_label
from querycad_segworker.ingest import ingest
from querycad_segworker.model import Model, ModelStore
from querycad_segworker.summary import summary

EXAMPLES = sorted((Path(__file__).parents[2] / "examples").glob("*.step"))
BODIES_FIRST = {
    ("bearing_assembly", "shaft"), ("bearing_assembly", "rectangular plate"),
    ("gear_shaft", "shaft"), ("flange", "flange"),
}  # fmt: skip
"""Words that bodies go by, by their names or by their shape, mean these bodies, and not a step or a wall of them."""
WHOLE_KIND = {("bearing_assembly", "boss"), ("gear_shaft", "boss")}
"""'boss' is the word of a whole kind, which is printed with each: shafts, rings and tubes are bosses."""

Named = dict[str, set[str]]


@pytest.fixture(scope="session")
def store(tmp_path_factory: pytest.TempPathFactory) -> ModelStore:
    return ModelStore(tmp_path_factory.mktemp("store"))


@pytest.fixture(scope="module", params=[*(path.stem for path in EXAMPLES), "told"])
def named_model(
    request: pytest.FixtureRequest, store: ModelStore, tmp_path_factory: pytest.TempPathFactory
) -> tuple[str, Model]:
    name = request.param
    file = next((path for path in EXAMPLES if path.stem == name), None)
    return name, ingest(file or told(tmp_path_factory.mktemp("made")), store).load_model()


def told(folder: Path) -> Path:
    """A plate with blind and counterbored holes in a rectangle and in a row, a cone on it, a disc and a ball beside."""
    drills = [cylinder(2, 8, (x, y, 12)) for x in (10, 90) for y in (10, 50)]
    bores = [fuse(cylinder(2.5, 30, (x, 30, -5)), cylinder(5, 5, (x, 30, 15))) for x in (20, 35, 50)]
    block = box((100, 60, 20))
    plate = fuse(cut(chamfered(block, 2, *upright(block)), *drills, *bores), cone(8, 4, 10, (75, 30, 20)))
    return write_step(folder / "told.step", compound(plate, cylinder(15, 4, (150, 0, 0)), ball(10, (200, 0, 0))))


def test_a_whole_label_reaches_what_it_is_printed_of(named_model: tuple[str, Model]) -> None:
    _, model = named_model
    inventory = Inventory(model.parts)
    for label, ids in labels(model.parts).items():
        assert reached(inventory, label) == ids, label
        assert reached(inventory, f"{len(ids)} x {label}") == ids, label


def test_as_many_are_found_as_the_prompt_says(named_model: tuple[str, Model]) -> None:
    _, model = named_model
    inventory = Inventory(model.parts)
    lines = re.findall(r"^(\d+) x (.+?) \{", facts(summary(model)), re.MULTILINE)
    assert lines
    assert {label: len(reached(inventory, label)) for _, label in lines} == {label: int(n) for n, label in lines}


def test_a_name_reaches_what_it_is_printed_of(named_model: tuple[str, Model]) -> None:
    """One or several; a counterbored through hole is a through hole; exceptions stand above."""
    name, model = named_model
    inventory = Inventory(model.parts)
    wrong = set()
    for said, ids in names(model).items():
        for form in (said, plural_of(said)):
            if reached(inventory, form) != ids:
                wrong.add((name, said))
    exceptions = {one for one in BODIES_FIRST | WHOLE_KIND if one[0] == name}
    assert wrong == exceptions


def test_a_line_of_a_list_names_its_parts_in_a_question(named_model: tuple[str, Model]) -> None:
    _, model = named_model
    known = {part.id: part for part in model.parts}
    carried = carried_sections(model.parts)
    left_out = {*carried, *(part.id for part in model.parts if part.kind.is_whole or is_bare_surface(part))}
    listed = [part for part in model.parts if part.id not in left_out]
    described = describe(summary(model), model.parts)
    for one in {*callouts(listed, known=known), *described.features, *described.patterns}:
        text = one.text
        if re.fullmatch(r"(\d+x )?R[\d.]+", text):
            continue  # 'R8' is a size, which any rounding and fillet has: 'the R8 rounds'
        said = f"{text} chamfers" if one.kind is PartKind.CHAMFER and "C" in text else text
        addressed = address(f"Where are the {said}?", model.parts)
        assert addressed.ids == set(one.ids), text


def reached(inventory: Inventory, said: str) -> set[str]:
    """Ids of the parts that the words reach; nothing of the words may be left unchecked."""
    found = find(inventory, said)
    assert not found.ignored, said
    assert not found.unchecked, said
    return as_printed(found.parts, inventory.alone)


def as_printed(parts: Iterable[Part], alone: bool) -> set[str]:
    """The only body of a file is the whole model."""
    return {"model" if alone and part.kind in ("body", "model") else part.id for part in parts}


def labels(parts: Iterable[Part]) -> Named:
    found: Named = defaultdict(set)
    for part in parts:
        if part.kind.is_feature:
            found[group_label(part)].add(part.id)
    return found


def names(model: Model) -> Named:
    """What labels begin with, with the parts of each longer name that ends in it, too; names of bodies."""
    alone = len(model.shape.bodies) == 1
    groups: dict[str, list[Part]] = defaultdict(list)
    for part in model.parts:
        for name in _named(part):
            groups[name].append(part)
    return {
        name: as_printed(
            (part for n, those in groups.items() if n == name or n.endswith(f" {name}") for part in those), alone
        )
        for name in groups
    }


def _named(part: Part) -> Iterator[str]:
    if part.kind is PartKind.BODY:
        yield from filter(None, (part.name,))
    elif part.kind not in (*SURFACES, PartKind.MODEL):
        name = group_label(part).partition(",")[0]
        yield name.partition(" of ")[0] if part.kind is PartKind.PATTERN else name
