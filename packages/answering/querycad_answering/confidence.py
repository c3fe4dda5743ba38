"""How sure is an answer? Calibrated on its share and its doubts, and limited where something is not as it was asked."""

from __future__ import annotations

import math
from collections.abc import Iterator

from querycad_contracts import AnswerType, Measure
from querycad_language.forms import Count, Towards
from querycad_language.measures import WHOLE
from querycad_language.readings.skipped_words import CLOSED
from querycad_language.text import Text
from querycad_language.weights import calibration

from .candidates import Candidate, Features, is_own
from .companion_values import uneven
from .programs.builder import Read
from .unanswerable import TAKEN_FOR_WHOLE

_DOUBTS: dict[str, tuple[str, ...]] = {
    "skipped": (
        "skip_number", "skip_side", "skip_measure", "skip_negation", "skip_comparison", "skip_adjective",
    ),
    "noun": ("skip_noun",),
    "unknown": ("skip_unknown", "aside_unknown"),
    "unknown_words": ("unknown_words",),
    "unknown_whole": ("unknown_whole",),
    "guessed": ("guessed",),
    "passed": ("parts_passed", "owner_passed", "link_whole"),
    "aside": ("aside_noun", "aside_number", "aside_side", "aside_measure", "aside_comparison"),
    "dropped": (
        "adjective_dropped", "size_dropped", "place_dropped", "place_unknown", "compound_dropped", "compound_unknown",
        "trait_dropped", "trait_unknown", "color_dropped", "thread_dropped", "rank_dropped", "nth_dropped",
        "nth_unchecked",
    ),
    "denied": ("place_denied", "end_denied"),
    "several": ("values_several_for_one", "several_for_one", "values_differ_for_each"),
    "chosen": ("group_for_one", "group_for_plural"),
    "alike": ("alike_for_one",),
    "kin": ("sense_kin", "sense_wide", "kin_instead"),
    "stretched": ("sense_stretch", "sense_rank"),
    "measure": ("measure_derived", "measure_foreign"),
    "miscounted": ("count_differs", "count_group", "one_for_plural"),
    "whole": ("whole_hollow",),
    "empty": ("empty", "nothing", "counts_none", "value_zero"),
    "none_there": ("exists_none",),
    "yes_no": ("form_check", "form_every", "form_uniform", "form_exists", "form_parallel", "form_within"),
    "choice": ("form_towards", "form_either", "form_which"),
    "apart": ("form_distance", "form_combine", "form_angle"),
    "long": ("words",),
    "strange": ("strange_words",),
    "whole_model": ("whole_sense",),
    "named": ("file_named", "by_name"),
    "odd": ("named_only", "value_is_extent", "value_too_large", "material_under", "material_between"),
}  # fmt: skip
"""What may speak against an answer, whatever else there is: the groups of features that calibration looks at."""
SAY_NOTHING = ("chatter", "function", "courtesy")
"""Classes of words that may be skipped without a word about it."""
RESTRICTING = frozenset(("noun", "adjective", "measure", "comparison", "side", "number", "negation", "unknown"))
"""Classes of words without which a yes or no is as often wrong as right: of 137 so answered 70 were right."""
PASSED_OVER = 0.35
"""So sure, at most, is a value that leaves out a part which is named by its id, or is of one that is not as said."""
NONE_COUNTED = 0.7
"""So sure, at most, is that there are none: people count what there is. Of 44 surer answers to collected questions 30
were right."""
SKIPPED_RESTRICTIONS = ("skip_number", "skip_negation", "skip_comparison", "skip_side")
NOT_SURE = 0.75
"""So sure, at most, is a value of a reading that passes over a number, negation, comparison or side, or that could not
check a word that restricts. Of 136 surer ones by unread writers 16 were wrong, of 680 others 23. So sure is the number
of parts that are not what the noun itself means, of cutouts as holes, or where a measure is passed over, and the least
of several spacings."""
OTHER_CLASS = 0.35
"""So sure, at most, is a value that answers a question which asks for yes or no, or one of parts that are guessed, or
decides or lists and passes over a word, or gives the smallest extent of a body for the thickness of its material, or a
slope that is no draft, where no cone is named."""
BY_SIGHT_AT_MOST = 0.7
"""So sure at most is an answer that rests on sight alone: below what counts as sure, as nobody has measured yet how
often sight is right."""
AS_ONE = 0.7
"""So sure, at most, is the one value of a question that may be several: what else may be asked is passed over."""


def doubts(features: Features, score: float) -> Features:
    """What speaks against an answer, by kind; the score itself is among it."""
    found = {name: math.fsum(abs(features.get(one, 0.0)) for one in members) for name, members in _DOUBTS.items()}
    return {**found, "score": score / 5}


def odds(share: float) -> float:
    """The log odds of a share, kept finite."""
    share = min(max(share, 1e-3), 1 - 1e-3)
    return math.log(share / (1 - share))


def calibrated(share: float, features: Features, score: float, table: Features | None = None) -> float:
    """The probability that an answer is right: logistic in its share and its doubts, fitted in cross-validation."""
    table = table if table is not None else calibration()
    z = table.get("bias", 0.0) + table.get("share", 1.0) * odds(share)
    z += math.fsum(table.get(name, 0.0) * value for name, value in doubts(features, score).items())
    return 1 / (1 + math.exp(-z))


def most(candidate: Candidate, text: Text) -> float:
    """How sure is a value at most, by what it does not do of what is asked? `text`: of the question."""
    return min(_limits(candidate, text), default=1.0)


def _limits(candidate: Candidate, text: Text) -> Iterator[float]:
    form, features, over = candidate.reading.form, candidate.features, skipped(candidate)
    if "guessed" in features or "value_for_yes_no" in features:
        yield OTHER_CLASS
    if candidate.written.expects is AnswerType.PARTS and over:  # nothing that is fitted on is a list
        yield OTHER_CLASS
    if text.at_phrases("stuff") and any(map(_is_bulk, candidate.written.reads)):
        yield OTHER_CLASS
    if features.get("value_steep") and not any(query.words for query in candidate.grounds):
        yield OTHER_CLASS  # of a countersink or drill tip
    restricting = RESTRICTING.intersection(kind for kind, _ in candidate.reading.skipped)
    if isinstance(form, CLOSED | Towards) and (restricting or unchecked(candidate) or _at_several(candidate)):
        yield OTHER_CLASS
    if isinstance(form, Count) and candidate.value == 0:
        yield NONE_COUNTED
    if isinstance(form, Count) and (features.get("skip_measure") or not all(map(is_own, candidate.grounds.values()))):
        yield NOT_SURE  # 'in the long side' restricts, too
    if any(map(features.get, SKIPPED_RESTRICTIONS)) or unchecked(candidate) or uneven(candidate):
        yield NOT_SURE


def _at_several(candidate: Candidate) -> bool:
    """Is asked whether parts are at two places, 'on both ends'? That one of them holds is all that is looked at."""
    places = (place.what for query in candidate.grounds for place in query.places)
    return any(what is not None and what.count is not None and what.count > 1 for what in places)


def _is_bulk(read: Read) -> bool:
    """Is an extent of a whole body taken for its thickness: is it no sheet, plate or tube of one thickness?"""
    return read.measure == Measure.THICKNESS and read.kind in WHOLE and read.grade != "own"


def skipped(candidate: Candidate) -> tuple[str, ...]:
    """The words that carry meaning and that the reading passes over."""
    return tuple(dict.fromkeys(word for kind, word in candidate.reading.skipped if kind not in SAY_NOTHING))


def unchecked(candidate: Candidate) -> tuple[str, ...]:
    """What restricts, by the words, and could not be checked on the model; what is only taken for the whole model."""
    found = [said for grounded in candidate.grounds.values() for said in grounded.unchecked]
    for query, grounded in candidate.grounds.items():
        if any(grounded.features.get(name) for name in TAKEN_FOR_WHOLE):
            found.append(f"'{query.noun}', taken for the whole model")
    return tuple(dict.fromkeys(found))
