"""Questions about the model as such lead to its description; questions about a part do not."""

from __future__ import annotations

import pytest

from querycad_answering.overview import asks_for_overview

ABOUT_IT = [
    "What is this part?",
    "what's this",
    "List all features",
    "What can I ask?",
    "Describe the model, please.",
    "Give me a short summary of this file",
    "Which features does it have?",
    "Tell me about this component",
    "Can you describe this assembly?",
    "help",
]
OF_A_PART = [
    "",
    "How many features are there?",
    "What is the volume of this part?",
    "Describe the holes",
    "What is the part made of?",
    "Is this a part?",
    "Which holes are there?",
    "What is this hole?",
    "What is the depth?",
    "features larger than 5 mm",
    "How big is it?",
    "What colour is the model?",
]


@pytest.mark.parametrize("question", ABOUT_IT)
def test_the_model_as_such_is_described(question: str) -> None:
    assert asks_for_overview(question)


@pytest.mark.parametrize("question", OF_A_PART)
def test_any_other_word_asks_for_something_else(question: str) -> None:
    assert not asks_for_overview(question)
