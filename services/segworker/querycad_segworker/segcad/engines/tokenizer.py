"""How does a phrase become numbers? WordPiece tokens of BERT, and the text masks that GroundingDINO adds to them."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

MAX_TOKENS = 256
"""Length of GroundingDINO's text axis; what is longer is cut (`max_text_len` of the published models)."""
SEPARATORS = ("[CLS]", "[SEP]", ".", "?")
"""Tokens that end a phrase: words on two sides of one do not attend to each other (GroundingDINO, section 3.4)."""


@dataclass(frozen=True, slots=True, eq=False)
class Prompt:
    """A phrase as GroundingDINO takes it; L tokens, those after the last real one are padding."""

    input_ids: NDArray[np.int64]
    """(L,)"""
    attention_mask: NDArray[np.bool_]
    """(L,): False for padding."""
    position_ids: NDArray[np.int64]
    """(L,): place of a token in its own phrase."""
    self_attention: NDArray[np.bool_]
    """(L, L): which token (row) attends to which (column): those of its own phrase."""


class Tokenizer:
    """BERT's uncased WordPiece, from a `vocab.txt`."""

    def __init__(self, vocab: Path) -> None:
        from tokenizers import BertWordPieceTokenizer

        self._encoder = BertWordPieceTokenizer(str(vocab), lowercase=True)
        self._encoder.enable_truncation(MAX_TOKENS)
        ids = [self._encoder.token_to_id(token) for token in SEPARATORS]
        self._separators = np.array([number for number in ids if number is not None], dtype=np.int64)
        self._padding = self._encoder.token_to_id("[PAD]") or 0

    def encode(self, caption: str, length: int | None = None) -> Prompt:
        """The caption's tokens between [CLS] and [SEP]; padded to `length`, or cut to it, where that is given."""
        ids = np.array(self._encoder.encode(caption).ids, dtype=np.int64)
        if length is not None and len(ids) > length:
            ids = np.concatenate([ids[: length - 1], ids[-1:]])  # the closing [SEP] stays
        real = len(ids)
        ids = np.pad(ids, (0, max((length or 0) - real, 0)), constant_values=self._padding)
        self_attention, position_ids = phrase_masks(ids, self._separators)
        return Prompt(ids, np.arange(len(ids)) < real, position_ids, self_attention)


def caption_of(phrase: str) -> str:
    """The phrase as one sentence: lower case, a full stop at its end and nowhere else ("M4 0.7 hole" > "m4 0 7 hole.").

    A stop inside would make it several phrases, which the model finds one by one.
    """
    return " ".join(re.sub(r"[.?!]", " ", phrase.lower()).split()) + "."


def phrase_masks(
    input_ids: NDArray[np.int64], separators: NDArray[np.int64]
) -> tuple[NDArray[np.bool_], NDArray[np.int64]]:
    """Which tokens attend to each other (L, L), and each one's place in its phrase (L,)?

    A phrase is what stands between two separators, with the one that closes it. What the last token closes, and what
    nothing closes, is no phrase: its tokens see themselves only and have place 0, as in the published model's
    `generate_masks_with_special_tokens_and_transfer_map`.
    """
    length = len(input_ids)
    at = np.arange(length)
    ends = np.isin(input_ids, separators)
    closing = np.minimum.accumulate(np.where(ends, at, length)[::-1])[::-1]
    opening = np.concatenate([[-1], np.maximum.accumulate(np.where(ends, at, -1))[:-1]])
    phrase = (closing > 0) & (closing < length - 1)
    attends = np.eye(length, dtype=bool) | ((closing[:, None] == closing[None, :]) & phrase[None, :])
    return attends, np.where(phrase, at - opening - 1, 0).astype(np.int64)
