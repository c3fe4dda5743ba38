"""A phrase becomes one sentence of tokens, each of which sees its own phrase only."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from querycad_segworker.segcad.engines.tokenizer import Tokenizer, caption_of, phrase_masks

VOCABULARY = ["[PAD]", "[UNK]", "[CLS]", "[SEP]", ".", "?", "hole", "power", "connect", "##or", "m", "##4"]


@pytest.fixture
def tokenizer(tmp_path: Path) -> Tokenizer:
    (tmp_path / "vocab.txt").write_text("\n".join(VOCABULARY), encoding="utf-8")
    return Tokenizer(tmp_path / "vocab.txt")


@pytest.mark.parametrize(
    ("phrase", "caption"),
    [
        ("hole", "hole."),
        ("  Power\tConnector. ", "power connector."),
        ("M4 x 0.7 hole?", "m4 x 0 7 hole."),
        ("logo. text", "logo text."),
    ],
)
def test_a_phrase_is_one_sentence(phrase: str, caption: str) -> None:
    assert caption_of(phrase) == caption


def test_words_are_lowered_and_split(tokenizer: Tokenizer) -> None:
    ids = tokenizer.encode("Power connector M4.").input_ids
    assert [VOCABULARY[i] for i in ids] == ["[CLS]", "power", "connect", "##or", "m", "##4", ".", "[SEP]"]


def test_a_graph_of_fixed_length_gets_padding_that_nothing_sees(tokenizer: Tokenizer) -> None:
    prompt = tokenizer.encode("hole.", 7)
    assert prompt.input_ids.tolist() == [2, 6, 4, 3, 0, 0, 0]
    assert prompt.attention_mask.tolist() == [True] * 4 + [False] * 3
    assert not prompt.self_attention[:4, 4:].any()


def test_what_is_too_long_is_cut_and_still_closed(tokenizer: Tokenizer) -> None:
    assert tokenizer.encode("hole power hole power hole.", 4).input_ids.tolist() == [2, 6, 7, 3]
    assert len(tokenizer.encode("hole " * 400 + ".").input_ids) == 256


def test_two_phrases_do_not_see_each_other() -> None:
    attends, places = phrase_masks(np.array([2, 6, 4, 7, 8, 4, 3]), np.array([2, 3, 4, 5]))
    expected = np.zeros((7, 7), dtype=bool)
    expected[0, 0] = expected[6, 6] = True
    expected[1:3, 1:3] = expected[3:6, 3:6] = True
    assert (attends == expected).all()
    assert places.tolist() == [0, 0, 1, 0, 1, 2, 0]
