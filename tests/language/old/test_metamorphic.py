"""What must not change a program: units, order of clauses, plural, spelling, typing errors, politeness, case."""

from __future__ import annotations

import itertools

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from querycad_language.old import parse
from querycad_language.old.lexicon import LEXICON
from querycad_language.old.tokens import tokenize

SIDES = ("top", "bottom", "left", "right", "front", "back")


def same_program(*questions: str) -> None:
    codes = {question: parse(question).code for question in questions}
    assert len(set(codes.values())) == 1, codes


@pytest.mark.parametrize(
    "amount", ["25.4 mm", "2.54 cm", "0.0254 m", "1 inch", '1"', "1 in", "1000 thou", "25400 µm", "1/1 inch"]
)
def test_one_length_in_any_unit_gives_one_program(amount: str) -> None:
    same_program(
        "How deep are the holes with a diameter of 25.4 mm?", f"How deep are the holes with a diameter of {amount}?"
    )


@pytest.mark.parametrize(
    "amount", ["5.5mm", "5,5 mm", "5.5-mm", "5.50 mm", "0.55 cm", "5500 microns", "5.5 millimetres", "5.5 millimeters"]
)
def test_one_number_in_any_spelling_gives_one_program(amount: str) -> None:
    same_program("How many holes have a diameter of 5.5 mm?", f"How many holes have a diameter of {amount}?")


@given(st.integers(1, 500), st.sampled_from(["deep", "wide", "long"]))
def test_millimetres_and_inches_mean_the_same(tenths: int, adjective: str) -> None:
    inches = tenths / 10
    same_program(
        f"How many slots are {inches} inches {adjective}?", f"How many slots are {inches * 25.4:.6f} mm {adjective}?"
    )


CLAUSES = {
    "with a diameter of 5.5 mm": (
        "with a diameter of 5.5 mm",
        "that have a diameter of 5.5 mm",
        "whose diameter is 5.5 mm",
    ),
    "on the top": ("on the top", "visible from the top", "that can be seen from above", "located on the upper side"),
}


def test_the_order_of_clauses_does_not_matter() -> None:
    questions = []
    for ways in itertools.product(*CLAUSES.values()):
        for first, second in itertools.permutations(ways):
            questions.append(f"How deep are the holes {first} {second}?")
            questions.append(f"How deep are the holes {first} and {second}?")
    questions.append("Seen from the top, how deep are the holes with a diameter of 5.5 mm?")
    same_program(*questions)


@given(st.sampled_from(SIDES), st.sampled_from(["hole", "slot", "rectangular pocket", "gizmo"]))
def test_a_side_in_front_is_a_side_behind(side: str, noun: str) -> None:
    same_program(
        f"How many {noun}s are visible from the {side}?",
        f"From the {side}, how many {noun}s are visible?",
        f"How many {noun}s are there on the {side} side of the object?",
        f"How many {noun}s can be seen when looking from the {side}?",
        f"What is the number of {noun}s on the {side}?",
    )


@pytest.mark.parametrize(
    ("british", "american"),
    [
        ("Where is the centre of the largest hole?", "Where is the center of the largest hole?"),
        ("How many holes are 5 millimetres deep?", "How many holes are 5 millimeters deep?"),
        ("What colour is the cover?", "What color is the cover?"),
        ("Which holes are centred in x and y?", "Which holes are centered in x and y?"),
    ],
)
def test_british_and_american_spelling_are_one(british: str, american: str) -> None:
    same_program(british, american)


@pytest.mark.parametrize(
    ("mistyped", "right"),
    [
        ("What is the daimeter of the shaft?", "What is the diameter of the shaft?"),
        ("What is the raduis of the shaft?", "What is the radius of the shaft?"),
        ("What is the hieght of the object?", "What is the height of the object?"),
        ("How many holes are visable form the top?", "How many holes are visible from the top?"),
        ("What is the thicknes of the rib?", "What is the thickness of the rib?"),
        ("What is the depth of the larges hole?", "What is the depth of the large hole?"),
        ("What is the distanse beween the two legs?", "What is the distance between the two legs?"),
        ("How many holes are on the botom?", "How many holes are on the bottom?"),
        ("What are the diferent radii of the holes?", "What are the different radii of the holes?"),
    ],
)
def test_typing_errors_in_words_of_the_grammar_are_read_over(mistyped: str, right: str) -> None:
    same_program(mistyped, right)


def test_a_corrected_typing_error_lowers_the_confidence() -> None:
    assert (
        parse("What is the daimeter of the shaft?").confidence < parse("What is the diameter of the shaft?").confidence
    )


PARTS = [
    "plate", "plates", "bevel", "fillet", "flange", "collar", "washer", "joint", "depot", "lever", "slider",
    "sleeve", "spring", "spacer", "shoulder", "bracket", "gasket", "socket", "pocket", "packet", "rocker",
    "impeller", "propeller", "chamfer", "channel", "chamber", "counterbore", "counterbored", "countersunk",
    "countersink", "extrusion", "protrusion", "indentation", "standoff", "spigot", "spline", "radial", "axial",
    "trough", "trunnion", "valve", "vane", "volute", "wedge", "web", "yoke", "ledge", "hedge", "fork", "facet",
    "frame", "handle", "hinge", "keyway", "knurl", "latch", "louver", "manifold", "nozzle", "notch", "pawl",
    "pinion", "piston", "pulley", "rack", "ratchet", "rivet", "rotor", "stator", "stiffener", "strut", "stud",
    "tongue", "tooth", "teeth", "thread", "threaded", "tapped", "truss", "turbine", "undercut", "black",
    "white", "orange", "planar", "conical", "spherical", "hexagonal", "octagonal", "triangular", "elliptical",
    "embossed", "engraved", "knurled", "slotted", "tapered", "stepped", "hollow", "machine", "machined",
]  # fmt: skip


@pytest.mark.parametrize("word", PARTS)
def test_words_of_parts_are_left_alone(word: str) -> None:
    assert [token.word for token in tokenize(f"the {word}")] == ["the", word]
    assert not tokenize(word)[0].corrected


@pytest.mark.parametrize(
    "question",
    [
        "please tell me how many holes there are",
        "Can you tell me how many holes there are?",
        "HOW MANY HOLES ARE THERE?",
        "how many holes are there",
        "  How   many holes\tare there ?\n",
        "How many holes are there, please?",
        "So, how many holes does it have?",
    ],
)
def test_politeness_case_and_blanks_do_not_matter(question: str) -> None:
    same_program("How many holes are there?", question)


@given(st.sampled_from(["boss", "hole", "fillet", "tooth", "body", "groove", "cross", "axis", "pulley"]))
def test_the_description_is_in_the_singular(noun: str) -> None:
    plural = {"boss": "bosses", "tooth": "teeth", "body": "bodies", "cross": "crosses", "axis": "axes"}.get(
        noun, noun + "s"
    )
    assert LEXICON.singular(plural) == noun
    assert f'find_parts("{noun}")' in parse(f"How many {plural} are there?").code


@settings(max_examples=60)
@given(st.text(alphabet="abcdefghijklmnopqrstuvwxyz", min_size=3, max_size=9))
def test_any_noun_is_a_description(noun: str) -> None:
    """The parser has no list of parts: a word that is none of the grammar's is handed on as it is."""
    if noun in LEXICON.words or tokenize(noun)[0].word != noun or LEXICON.is_plural(noun) or noun[:2] in ("un", "no"):
        return
    assert parse(f"Is there a {noun} on the left?").code.startswith(f'parts = find_parts("{noun}", sides=["left"])')


FRAMES = [
    "Hi, {}",
    "So, {}",
    "Ok, next one: {}",
    "Quick question: {}",
    "I need to know: {}",
    "Please tell me: {}",
    "On this part, {}",
    "Looking at the model, {}",
    "Sorry if this is a stupid question, but {}",
    "I am working on this part. {}",
    "We lost the drawing. {}",
    "{} Thanks in advance!",
    "{} Please.",
]
ASKED = [
    "what is the diameter of the holes on the top?",
    "how deep is the blind hole?",
    "how many slots are on the left?",
    "how far apart are the two legs?",
    "where is the centre of the largest hole?",
    "how high above the bottom is the axis of the bore?",
    "how far do the pins stick out of the plate?",
    "what is the height of the object without the shaft?",
    "what is the distance between the shaft and the flange?",
    "how long are the screws without the head?",
    "which different radii do the fillets have?",
    "is there a threaded hole?",
]


@pytest.mark.parametrize("frame", FRAMES)
def test_what_is_said_around_a_question_leaves_its_program(frame: str) -> None:
    framed = {asked: parse(frame.format(asked)).code for asked in ASKED}
    assert framed == {asked: parse(asked).code for asked in ASKED}


@pytest.mark.parametrize("measure", ["depth", "length", "height", "diameter", "thickness"])
@pytest.mark.parametrize("parts", ["the slot on the left", "the blind holes", "the pin in the flange", "the collar"])
def test_the_parts_may_come_before_or_behind_what_is_asked(measure: str, parts: str) -> None:
    plain = parse(f"What is the {measure} of {parts}?").code
    for said in (
        f"{parts}: {measure}?",
        f"{parts} - {measure}?",
        f"{parts}, what's their {measure}?",
        f"tell me the {measure} of {parts}",
        f"I'd like to have the {measure} of {parts}",
        f"We need the {measure} of {parts} for the order.",
        f"All I need is the {measure} of {parts}.",
        f"Do you happen to know the {measure} of {parts}?",
        f"I forgot to write down the {measure} of {parts}, can you look it up?",
        f"What {measure} do {parts} have?",
    ):
        assert parse(said).code == plain, said


@pytest.mark.parametrize("adjective", ["deep", "wide", "long", "high", "thick"])
def test_an_embedded_question_is_the_question(adjective: str) -> None:
    plain = parse(f"How {adjective} is the slot on the left?").code
    for said in (
        f"Do you know how {adjective} the slot on the left is?",
        f"I wonder how {adjective} the slot on the left is",
        f"Any idea how {adjective} the slot on the left is?",
        f"What I'd like to know is how {adjective} the slot on the left is.",
        f"my boss wants to know how {adjective} the slot on the left is",
        f"The slot on the left, how {adjective} is it?",
        f"The slot on the left: how {adjective}?",
        f"There is a slot on the left. How {adjective} is it?",
        f"There's a slot on the left, how {adjective} is it?",
        f"hwo {adjective} is teh slot on the left",
    ):
        assert parse(said).code == plain, said
