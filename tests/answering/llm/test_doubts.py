"""A program that leaves out, changes or adds something of the question is doubted; one that does not, is not."""

from __future__ import annotations

import pytest
from tests.answering.llm.test_prompt import summary

from querycad_answering.llm.doubts import doubts
from querycad_contracts import AnswerType

LENGTH, LENGTHS, COUNT, POINT = AnswerType.LENGTH, AnswerType.LENGTHS, AnswerType.COUNT, AnswerType.POINT
MODEL = summary("power_inlet", terms={"blind hole": 3, "slot": 2, "boss": 1, "flange": 1})
"""With a body called "Base plate"."""


@pytest.mark.parametrize(
    ("question", "wanted", "code", "said"),
    [
        ("How many slots are there?", COUNT, 'len(find_parts("slot", sides=["top"]))', '"top"'),
        ("How many slots are on the left?", COUNT, 'len(find_parts("slot", ["left", "right"]))', '"right"'),
        ("How deep are the screw holes?", LENGTHS, '[p.depth for p in find_parts("screw")]', '"screw hole"'),
        ("How many counterbored holes are there?", COUNT, 'len(find_parts("counterbore"))', '"counterbored hole"'),
        ("How deep are the holes with a ring?", LENGTHS, '[p.depth for p in find_parts("ring")]', '"hole with ring"'),
        ("Where is the nut hole?", POINT, 'find_parts("through hole")[0].center', '"through"'),
        ("How many keyways are there?", COUNT, 'len(find_parts("slot"))', '"slot"'),
        ("What diameter have the holes on top?", LENGTHS, '[p.diameter for p in find_parts("top")]', "no part"),
        ("How many holes are wider than 6 mm?", COUNT,
         'len([p for p in find_parts("hole") if p.diameter > 0.004])', "0.006"),
        ("Where is the largest hole?", POINT, 'find_parts("hole")[0].center', '"largest"'),
        ("What radius has the boss?", LENGTH, 'find_parts("boss")[0].diameter', "a radius"),
        ("What radii have the holes?", LENGTHS, '[2 * r for p in find_parts("hole") for r in p.radii]', "a radius"),
        ("What is the diameter of the boss?", LENGTH, 'max(find_parts("boss")[0].radii)', "a diameter"),
        ("How far apart are the slots along the width?", LENGTH,
         'find_parts("slot")[0].center_distance(find_parts("slot")[1])', "a.center[0]"),
    ],
)  # fmt: skip
def test_what_differs_from_the_question_is_doubted(question: str, wanted: AnswerType, code: str, said: str) -> None:
    (doubt,) = doubts(f"solution = {code}", question, wanted, MODEL)
    assert said in doubt


@pytest.mark.parametrize(
    ("question", "wanted", "code"),
    [
        ("How many slots are visible from above?", COUNT, 'len(find_parts("slot", sides=["top"]))'),
        ("How many slots are on the long sides?", COUNT, 'len(find_parts("slot", sides=["left", "right"]))'),
        ("How deep are the holes in the flange?", LENGTHS, '[p.depth for p in find_parts("hole in the flange")]'),
        ("How high are the bosses with a hole?", LENGTHS, '[p.height for p in find_parts("boss with a hole")]'),
        ("How long is the shaft?", LENGTH, 'find_parts("shaft of the part")[0].length'),
        ("How thick is the plate?", LENGTH, 'find_parts("base plate")[0].thickness'),
        ("How large is the inlet?", LENGTH, 'find_parts("power inlet")[0].extents'),
        ("How many red bodies are there?", COUNT, 'len(find_parts("red body"))'),
        ("How many hexagonal pockets are there?", COUNT, 'len(find_parts("hexagon pocket"))'),
        ("What is the radius of the largest hole?", LENGTH, 'max(max(p.radii) for p in find_parts("hole"))'),
        ("How deep is the largest hole?", LENGTH, 'find_parts("largest hole")[0].depth'),
        ("What radius has the boss?", LENGTH, 'find_parts("boss")[0].diameter / 2'),
        ("What is the diameter of the boss?", LENGTH, '2 * max(find_parts("boss")[0].radii)'),
        ("How deep are the holes with a radius of 5 mm?", LENGTHS,
         '[p.depth for p in find_parts("hole") if close(p.diameter, 0.01)]'),
        ("How many holes have a diameter of 5 mm?", COUNT,
         'len([p for p in find_parts("hole") if close(p.radius, 0.0025)])'),
        ("How deep are the 6 mm holes?", LENGTHS, '[p.depth for p in find_parts("6 mm hole")]'),
        ("How far apart are the slots?", LENGTH,
         'find_parts("slot")[0].center_distance(find_parts("slot")[1])'),
        ("How wide is the pin, flange included?", LENGTH, 'find_parts("pin")[0].width'),
        ("How high are the feet?", LENGTHS, '[p.height for p in find_parts("foot")]'),
        ("How wide is it?", LENGTH, "("),
    ],
)  # fmt: skip
def test_what_says_the_same_as_the_question_is_not_doubted(question: str, wanted: AnswerType, code: str) -> None:
    assert doubts(f"solution = {code}", question, wanted, MODEL) == ()
