"""How much of labelled B-rep models is recognised? `python -m benchmark.recognition` prints recall and precision.

The models are those of MFCAD (Cao et al., 2020) and MFCAD++ (Colligan et al., 2022): each face carries the class of the
machining feature that it was made by. An instance is a connected group of faces of one class: one feature as a rule,
several where they touch. A part lies in an instance when more than half of its faces do; an instance is found when the
parts of the right kind that lie in it share with it more than half of all faces of both (intersection over union).
"""

from __future__ import annotations

import argparse
import json
import math
import sys
from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from querycad_contracts import Part
from querycad_segworker.brep.extract import Extracted, extract
from querycad_segworker.brep.step import StepContent, read_step
from querycad_segworker.brep.tessellate import tessellate
from querycad_segworker.features.recognise import recognise
from querycad_segworker.features.shared.extruded_walls import tunnel_of
from querycad_segworker.features.shared.walls import REVOLVED, Axis
from querycad_segworker.topology import Brep, EdgeConvexity
from querycad_segworker.vectors import cross, dist, dot, norm
from querycad_segworker.visibility.raycast import Scene

MIN_OVERLAP = 0.5
"""More than half: then no part lies in two instances, and what answers for an instance is more right than wrong."""
SETS = ("mfcadpp", "mfcad")
MOST_CUTS = 8
"""Features of a random block: MFCAD++ has 3 to 10."""


@dataclass(frozen=True, slots=True)
class Kind:
    """Parts of some kinds that have at least one of some tags; of any tags where none are given.

    `also`: kinds that answer for the class as well, but are elements of shape that many features have: a part of such
    a kind that answers for nothing is not wrong.
    """

    kinds: tuple[str, ...]
    tags: tuple[str, ...] = ()
    also: tuple[str, ...] = ()

    def holds(self, part: Part) -> bool:
        """Is the part of this kind?"""
        return part.kind in self.kinds and (not self.tags or not set(self.tags).isdisjoint(part.tags))

    def accepts(self, part: Part) -> bool:
        """May the part answer for an instance of the class?"""
        return self.holds(part) or part.kind in self.also


_SLOT = Kind(("slot", "channel"), also=("notch", "groove"))
_STEP = Kind(("step",), also=("notch",))
CLASSES: dict[str, Kind] = {
    "through_hole": Kind(("hole",), ("through",)),
    "blind_hole": Kind(("hole",), ("blind",)),
    "Oring": Kind(("groove",)),
    "chamfer": Kind(("chamfer",)),
    "round": Kind(("round", "fillet")),
    "rectangular_passage": Kind(("cutout",), ("rectangular",)),
    "triangular_passage": Kind(("cutout",), ("triangular",)),
    "6sides_passage": Kind(("cutout",), ("hexagonal",)),
    "rectangular_pocket": Kind(("pocket",), ("rectangular",)),
    "triangular_pocket": Kind(("pocket",), ("triangular",)),
    "6sides_pocket": Kind(("pocket",), ("hexagonal",)),
    "circular_end_pocket": Kind(("pocket",), ("obround",)),
    "rectangular_through_slot": _SLOT,
    "triangular_through_slot": _SLOT,
    "circular_through_slot": Kind(("slot", "channel"), also=("notch", "groove", "arc")),
    "rectangular_blind_slot": _SLOT,
    "v_circular_end_blind_slot": _SLOT,
    "h_circular_end_blind_slot": _SLOT,
    "rectangular_through_step": _STEP,
    "2sides_through_step": Kind(("step",), also=("slot", "channel", "notch")),
    "slanted_through_step": Kind(("step",), also=("chamfer", "notch")),
    "rectangular_blind_step": _STEP,
    "triangular_blind_step": _STEP,
    "circular_blind_step": Kind(("step",), also=("arc", "notch")),
}
"""What recognition calls the classes of both sets. Classes that share a kind are told apart by the labels only."""

CLASS_ORDER = {
    "mfcad": (
        *("chamfer", "triangular_passage", "rectangular_passage", "6sides_passage", "triangular_through_slot"),
        *("rectangular_through_slot", "rectangular_through_step", "2sides_through_step", "slanted_through_step"),
        *("triangular_pocket", "rectangular_pocket", "6sides_pocket", "rectangular_blind_slot"),
        *("triangular_blind_step", "rectangular_blind_step", "stock"),
    )
}
"""The meaning of the labels' numbers where the set's list of names has another order. For MFCAD the faces show it: all
instances of number 11 have seven faces, the six walls and the floor of a hexagonal pocket; of 5, three faces, the two
walls and the floor of a slot; of 1 and 3, three and six walls without a floor."""

SIDES = {"triangular": 3, "rectangular": 4, "6sides": 6}
"""Walls of a pocket or passage, by the beginning of its class's name."""

FAMILIES: dict[str, tuple[str, ...]] = {
    "holes": ("through_hole", "blind_hole"),
    "pockets": tuple(name for name in CLASSES if name.endswith(("_pocket", "_passage"))),
    "slots": tuple(name for name in CLASSES if name.endswith("_slot")),
    "steps": tuple(name for name in CLASSES if name.endswith("_step")),
    "chamfers": ("chamfer",),
    "fillets": ("round",),
    "ring grooves": ("Oring",),
}


@dataclass(frozen=True, slots=True)
class Labelled:
    """One model with its truth, `instances`: (class, faces) for each connected group of faces of one class.

    `set_aside`: instances whose geometry contradicts their label, with what was measured.
    """

    file: str
    instances: tuple[tuple[str, frozenset[int]], ...]
    set_aside: tuple[tuple[str, frozenset[int], str], ...]
    parts: tuple[Part, ...]


@dataclass(slots=True)
class Score:
    """Counts over all models of a set, and where they went wrong."""

    instances: int = 0
    found: int = 0
    parts: int = 0
    right: int = 0
    missed: list[str] = field(default_factory=list)
    wrong: list[str] = field(default_factory=list)

    @property
    def recall(self) -> float:
        """Which share of the instances was found? 1 where there are none."""
        return self.found / self.instances if self.instances else 1.0

    @property
    def precision(self) -> float:
        """Which share of the parts is right? 1 where there are none."""
        return self.right / self.parts if self.parts else 1.0


def read_set(folder: Path, name: str, *, all_labels: bool = False) -> Iterator[Labelled]:
    """The models of one set with what is recognised on them. `all_labels`: only remnants of holes are set aside."""
    truth = json.loads((folder / name / "ground_truth.json").read_text(encoding="utf-8"))
    names = CLASS_ORDER.get(name) or truth["class_names"]
    for entry in truth["models"]:
        extracted = extract(read_step(folder / name / entry["file"]))
        if len(extracted.brep.faces) != entry["n_faces"]:
            raise ValueError(
                f"{entry['file']} has {len(extracted.brep.faces)} faces, but labels for {entry['n_faces']}"
            )
        labels = [names[label] for label in entry["face_labels"]]
        instances = _instances(extracted.brep, labels)
        yield _labelled(f"{name}/{Path(entry['file']).name}", extracted, instances, all_labels=all_labels)


def random_blocks(count: int, *, all_labels: bool = False) -> Iterator[Labelled]:
    """Blocks with one to eight features each; an instance is what is left of one cutter's surface."""
    from build123d import Face  # 5 s, which the labelled files do not need

    from .random_blocks import block, cutter_of

    for seed in range(count):
        body, cuts = block(seed, 1 + seed % MOST_CUTS)
        extracted = extract(StepContent(body.wrapped, f"block {seed}", ()))
        left: dict[int, set[int]] = defaultdict(set)
        for index, face in enumerate(extracted.faces):
            number = cutter_of(Face(face), cuts)
            if number is not None:
                left[number].add(index)
        instances = ((cuts[number].label, frozenset(faces)) for number, faces in sorted(left.items()))
        yield _labelled(f"block {seed}", extracted, instances, all_labels=all_labels)


def _labelled(
    file: str, extracted: Extracted, instances: Iterable[tuple[str, frozenset[int]]], *, all_labels: bool
) -> Labelled:
    brep = extracted.brep
    scene = Scene(tessellate(extracted.faces, dist(*brep.box)))
    parts = recognise(brep, scene.is_clear).parts
    doubts = [(*found, contradiction(brep, *found)) for found in instances]
    if all_labels:
        doubts = [(label, faces, why if label in FAMILIES["holes"] else None) for label, faces, why in doubts]
    return Labelled(
        file,
        tuple((label, faces) for label, faces, why in doubts if why is None),
        tuple((label, faces, why) for label, faces, why in doubts if why is not None),
        parts,
    )


def _instances(brep: Brep, labels: Sequence[str]) -> Iterator[tuple[str, frozenset[int]]]:
    """Connected faces of one class; 'stock' is what no feature was cut from. Bores that touch stay apart."""
    seen: set[int] = set()
    for start, label in enumerate(labels):
        if start in seen or label == "stock":
            continue
        group, todo = {start}, [start]
        while todo:
            face = todo.pop()
            new = {other for _, other in brep.neighbours(face) if labels[other] == label} - group
            if label in FAMILIES["holes"]:
                new = {other for other in new if not _other_bore(brep, group, other)}
            group |= new
            todo.extend(new)
        seen |= group
        yield label, frozenset(group)


def _other_bore(brep: Brep, group: Iterable[int], face: int) -> bool:
    """Does the face go around another axis than those found so far?"""
    axis = _axis(brep, face)
    others = [found for found in (_axis(brep, i) for i in group) if found is not None]
    near = 1e-4 * dist(*brep.box)
    return axis is not None and any(
        norm(cross(axis.direction, o.direction)) > 1e-3 or axis.radius_of(o.origin) > near for o in others
    )


def _axis(brep: Brep, face: int) -> Axis | None:
    record = brep.faces[face]
    return Axis(record.origin, record.axis) if record.kind in REVOLVED else None


def contradiction(brep: Brep, label: str, faces: frozenset[int]) -> str | None:
    """What about the faces contradicts their label? None when nothing does. Recognition has no say in this."""
    if label in FAMILIES["holes"]:
        sweeps = [brep.faces[i].sweep for i in faces if brep.faces[i].kind in REVOLVED]
        return f"{math.degrees(sum(sweeps)):.0f} of 360 degrees of the wall are left" if sum(sweeps) < math.pi else None
    lengths = {kind: _edge_length(brep, faces, kind) for kind in EdgeConvexity}
    convex, concave = lengths[EdgeConvexity.CONVEX], lengths[EdgeConvexity.CONCAVE]
    if label == "chamfer" and concave > convex:
        return f"of its edges {concave * 1e3:.1f} mm are concave and {convex * 1e3:.1f} mm convex: it breaks no edge"
    if label.endswith("_slot") and (tunnel := tunnel_of(brep, faces)) is not None and tunnel.closed:
        return f"its {len(faces)} walls close a ring without a floor: a passage"
    if label in ("rectangular_through_step", "2sides_through_step") and not concave:
        return "none of its edges is concave: nothing stands on it"
    if label.endswith(("_pocket", "_passage")):
        return _walls_left(brep, label, faces)
    return None


def _edge_length(brep: Brep, faces: Iterable[int], convexity: EdgeConvexity) -> float:
    return sum(edge.length for face in faces for edge, _ in brep.neighbours(face) if edge.convexity is convexity)


def _walls_left(brep: Brep, label: str, faces: frozenset[int]) -> str | None:
    """Has a pocket or passage with a polygon as outline lost walls to other features?"""
    wanted = next((sides for name, sides in SIDES.items() if label.startswith(name)), 0)
    floors = 1 if label.endswith("_pocket") else 0
    walls = len(_planes(brep, faces)) - floors
    return f"{walls} of its {wanted} walls are left" if walls < wanted else None


def _planes(brep: Brep, faces: Iterable[int]) -> set[tuple[float, ...]]:
    """The different planes that the faces lie in, by normal and offset, to a thousandth of the model."""
    step = 1e-3 * dist(*brep.box)
    records = [brep.faces[i] for i in faces]
    return {(*(round(c, 2) + 0.0 for c in f.axis), round(dot(f.point, f.axis) / step)) for f in records}


def score(models: Iterable[Labelled], classes: Sequence[str]) -> Score:
    """How well are the instances of these classes recognised, taken together?

    A part of the classes' kinds is right when it lies in an instance of any class that accepts it. Parts that lie in an
    instance whose label is contradicted are not judged.
    """
    result = Score()
    for model in models:
        for name, faces in model.instances:
            if name in classes:
                result.instances += 1
                if _is_found(name, faces, model.parts):
                    result.found += 1
                else:
                    result.missed.append(_missed(model, name, faces))
        truth = (*model.instances, *((label, faces) for label, faces, _ in model.set_aside))
        for part in model.parts:
            if any(_lies_in(part, faces) for _, faces, _ in model.set_aside):
                continue
            if any(CLASSES[name].holds(part) for name in classes):
                result.parts += 1
                if any(CLASSES[name].accepts(part) and _lies_in(part, faces) for name, faces in truth):
                    result.right += 1
                else:
                    result.wrong.append(_wrong(part, model.file, truth))
    return result


def _lies_in(part: Part, faces: frozenset[int]) -> bool:
    return len(faces & set(part.faces)) > MIN_OVERLAP * len(part.faces)


def _is_found(name: str, faces: frozenset[int], parts: Sequence[Part]) -> bool:
    inside = [set(part.faces) for part in parts if CLASSES[name].accepts(part) and _lies_in(part, faces)]
    together = set().union(*inside)
    return len(faces & together) > MIN_OVERLAP * len(faces | together)


def _missed(model: Labelled, name: str, faces: frozenset[int]) -> str:
    nearest = max(model.parts, key=lambda part: len(faces & set(part.faces)) / len(faces | set(part.faces)))
    what = f"{nearest.kind} {nearest.tags} {sorted(nearest.faces)}"
    return f"{model.file}: {name} {sorted(faces)}; nearest is {what}"


def _wrong(part: Part, file: str, truth: Sequence[tuple[str, frozenset[int]]]) -> str:
    shared = [(name, sorted(faces & set(part.faces))) for name, faces in truth]
    labels = ", ".join(f"{name} {faces}" for name, faces in shared if faces)
    return f"{file}: {part.label} {sorted(part.faces)}; labelled {labels or 'stock'}"


def table(models: Sequence[Labelled]) -> str:
    """Recall and precision of each family and class, as text."""
    counts: dict[str, int] = defaultdict(int)
    for model in models:
        for name, _ in model.instances:
            counts[name] += 1
    lines = [f"{'':28s} {'instances':>9s} {'recall':>7s} {'parts':>6s} {'precision':>9s}"]
    for family, classes in FAMILIES.items():
        present = [name for name in classes if counts[name]]
        if present:
            lines.append(_row(family, score(models, present)))
            lines.extend(_class_row(name, score(models, [name])) for name in present if len(present) > 1)
    return "\n".join(lines)


def _row(name: str, found: Score) -> str:
    return f"{name:28s} {found.instances:9d} {found.recall:7.3f} {found.parts:6d} {found.precision:9.3f}"


def _class_row(name: str, found: Score) -> str:
    """Without precision: one kind of part stands for several classes."""
    return f"  {name:26s} {found.instances:9d} {found.recall:7.3f}"


def main(arguments: Sequence[str] | None = None) -> int:
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    default = Path(__file__).parents[2] / "shared/features-dev"
    parser.add_argument("folder", nargs="?", type=Path, default=default, help="holds mfcadpp/ and mfcad/")
    parser.add_argument("--show", metavar="FAMILY", help="print what was missed and what is wrong in a family")
    parser.add_argument("--all-labels", action="store_true", help="keep labels that the geometry contradicts")
    parser.add_argument("--random", type=int, metavar="N", help="N blocks with random features instead of files")
    options = parser.parse_args(arguments)
    if options.random is None and not options.folder.is_dir():
        print(f"no labelled models at {options.folder}", file=sys.stderr)
        return 1
    if options.show is not None and options.show not in FAMILIES:
        parser.error(f"the families are {', '.join(FAMILIES)}")
    for name in SETS if options.random is None else ("random blocks",):
        if options.random is None:
            models = list(read_set(options.folder, name, all_labels=options.all_labels))
        else:
            models = list(random_blocks(options.random, all_labels=options.all_labels))
        print(f"{name}: {len(models)} models\n{table(models)}\n")
        for model in models:
            for label, faces, why in model.set_aside:
                print(f"set aside: {model.file} {label} {sorted(faces)}: {why}")
        if options.show is not None:
            found = score(models, FAMILIES[options.show])
            print("\n".join([*(f"missed {line}" for line in found.missed), *(f"wrong {line}" for line in found.wrong)]))
    return 0


if __name__ == "__main__":
    sys.exit(main())
