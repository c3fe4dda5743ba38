"""What does each option contribute? The benchmark once for every value of an option, and one table an option.

What a value needs and this machine lacks (weights, a language model) is said in its row: a score of zero would be one.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

from pydantic import ValidationError
from rich.table import Table

from .compare import side_by_side
from .results import Results
from .systems import SystemOptions, UnknownSystem

Measure = Callable[[SystemOptions, str], Results]
"""Runs the benchmark with these options, its results kept under this name. Raises UnknownSystem."""

Needs = Mapping[str, tuple[str, ...]]
"""Names of options, and the values of them that serve."""


@dataclass(frozen=True, slots=True)
class Ablation:
    """An option with the values that are compared. `needs` are other options without which it has no effect.

    What a caller chose of `needs` stays, if it is one of the values listed; else the first of them is taken.
    """

    option: str
    values: tuple[str, ...]
    needs: Needs = field(default_factory=dict)


_LOOKING: Needs = {"grounding": ("vision", "fused")}
_WRITING: Needs = {"codegen": ("llm", "both")}
ABLATIONS = (
    Ablation("codegen", ("parser", "llm", "both")),
    Ablation("grounding", ("geometry", "vision", "fused")),
    Ablation("views", ("6", "8"), _LOOKING),
    Ablation("box_threshold", ("0.25", "0.30", "0.35"), _LOOKING),
    Ablation("prompt_examples", ("0", "3", "nearest"), _WRITING),
    Ablation("llm_samples", ("1", "3"), _WRITING),
    Ablation("llm_repairs", ("0", "2"), _WRITING),
)
"""Thresholds and views: around those of the QueryCAD paper."""


@dataclass(frozen=True, slots=True)
class Row:
    """One value: what came of it, or why it was not measured."""

    value: str
    results: Results | None
    refused: str = ""


def ablations(option: str | None, values: Sequence[str] | None) -> tuple[Ablation, ...]:
    """All of them, or the one of this option, with other values where some are given. Raises UnknownSystem."""
    if option is None:
        if values:
            raise UnknownSystem("--values are those of an --option")
        return ABLATIONS
    found = next((one for one in ABLATIONS if one.option == option), None)
    if found is None:
        raise UnknownSystem(f"{option} is no option that varies; there are: {', '.join(o.option for o in ABLATIONS)}")
    return (Ablation(option, tuple(values), found.needs) if values else found,)


class Ablations:
    """Measures, and no set of options twice: most ablations hold the options that are the default."""

    def __init__(self, base: SystemOptions, measure: Measure) -> None:
        self._base, self._measure = base, measure
        self._known: dict[SystemOptions, Results | UnknownSystem] = {}

    def rows(self, ablation: Ablation) -> list[Row]:
        """A row a value. Raises UnknownSystem for a value that the option cannot have."""
        setups = [(value, _setup(self._base, ablation, value)) for value in ablation.values]
        return [self._row(value, setup, f"{ablation.option}-{value}") for value, setup in setups]

    def _row(self, value: str, setup: SystemOptions, name: str) -> Row:
        if setup not in self._known:
            try:
                self._known[setup] = self._measure(setup, name)
            except UnknownSystem as refused:
                self._known[setup] = refused
        known = self._known[setup]
        return Row(value, None, str(known)) if isinstance(known, UnknownSystem) else Row(value, known)


def _setup(base: SystemOptions, ablation: Ablation, value: str) -> SystemOptions:
    given = base.model_dump()
    needed = {name: allowed[0] for name, allowed in ablation.needs.items() if given[name] not in allowed}
    try:
        return SystemOptions.model_validate(given | needed | {ablation.option: value})
    except ValidationError as error:
        raise UnknownSystem(f"{ablation.option} cannot be {value!r}: {error.errors()[0]['msg']}") from error


def table(ablation: Ablation, rows: Sequence[Row], base: SystemOptions) -> Table:
    """How many are right with each value, by set; of what was not measured, why."""
    setup = _setup(base, ablation, ablation.values[0])
    constant = ", ".join(f"{name} {getattr(setup, name)}" for name in ablation.needs)
    runs = [(row.value, row.refused if row.results is None else row.results) for row in rows]
    return side_by_side(runs, f"{ablation.option}{f', with {constant}' if constant else ''}", ablation.option)
