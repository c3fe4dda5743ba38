"""Which marks does a phrase mean? Every picture is shown on its own, and the pictures vote.

A picture's words and a reply's words are never followed: of a reply, only numbers that the picture has are read.
"""

from __future__ import annotations

import json
import logging
import re
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from hashlib import sha256
from typing import Any, Protocol

from querycad_answering.llm.breaker import Breaker
from querycad_answering.llm.forms import Form
from querycad_answering.llm.messages import ChatModel, LlmBusy, LlmError, Message, Reply, Role, TimeLimit
from querycad_answering.llm.prompt import filled
from querycad_answering.llm.settings import LlmSettings
from querycad_contracts import Grounding, MarkedPicture, PartQuery, PictureRequest, Side, Sight, Sighted, TokenUse

MEANT = 0.5
"""A part is found when the pictures that mark it are, on average, surer than this."""
PHRASE_CHARS = 200
NO_SHARE = 1e9
"""Numbers so large, and what is no number, are no confidence, however they are rounded."""
AT_ONCE = 4
"""Pictures of one phrase under way at the same time; the address has limits of its own."""
_OBJECT = re.compile(r"\{.*\}", re.DOTALL)
_SCHEMA = {
    "type": "object",
    "properties": {
        "marks": {
            "type": "array",
            "items": {
                "type": "object",
                "properties": {"mark": {"type": "integer"}, "sure": {"type": "number"}},
                "required": ["mark", "sure"],
                "additionalProperties": False,
            },
        }
    },
    "required": ["marks"],
    "additionalProperties": False,
}
FORM = Form("marks", json.dumps(_SCHEMA), "Says which marks are meant.")
log = logging.getLogger(__name__)


class Place(Protocol):
    """Access to the model: draws its pictures, keeps what was seen in them, and finds parts by that."""

    def find_parts(self, description: str | PartQuery, sides: Sequence[Side] | None = None) -> Grounding:
        """Which parts are meant, by geometry and by what was seen so far?"""
        ...

    def marked(self, asked: PictureRequest | None = None) -> tuple[MarkedPicture, ...]:
        """The pictures with marks on all that could be meant; or the one that a program asks for."""
        ...

    def png(self, name: str) -> bytes:
        """A picture's file. Raises OSError."""
        ...

    def keep_sight(self, sight: Sight) -> None:
        """Keeps what was seen."""
        ...


@dataclass(frozen=True, slots=True)
class Looked:
    """What came of one phrase."""

    sight: Sight
    tokens: TokenUse
    unread: int
    """Pictures whose reply could not be read."""


class Eyes:
    """A model that takes images, as these settings say; `model` replaces it."""

    def __init__(self, settings: LlmSettings, model: ChatModel | None = None) -> None:
        self.settings = settings
        self._model = model
        self._breaker = Breaker(settings.llm_failures, settings.llm_pause_s)

    @property
    def name(self) -> str:
        """Who looks, as records say it."""
        where = self.settings.llm_command or self.settings.llm_base_url  # told by a digest: a command may hold a secret
        return self.settings.llm_model or f"eyes {sha256(where.encode()).hexdigest()[:8]}"

    def look(self, phrase: str, place: Place, deadline: TimeLimit) -> Looked:
        """What does the phrase mean on the model, by sight? Raises LlmError where nobody could say."""
        self._breaker.check()
        try:
            looked = self._look(phrase, place, deadline)
        except LlmError as error:
            self._breaker.heard(error)
            raise
        self._breaker.heard(None)
        return looked

    def _look(self, phrase: str, place: Place, deadline: TimeLimit) -> Looked:
        if self._model is None:
            from querycad_answering.llm.client import open_model  # here: where nobody looks, no HTTP client is loaded

            self._model = open_model(self.settings, FORM)
        model = self._model
        pictures = place.marked()[: self.settings.eyes_pictures]
        shown = [(picture, place.png(picture.name)) for picture in pictures]

        def ask(one: tuple[MarkedPicture, bytes]) -> Reply | LlmError:
            try:
                return model.reply(asked(phrase, *one), 0.0, 1, deadline)
            except LlmError as error:
                return error

        pool = ThreadPoolExecutor(max_workers=AT_ONCE)
        try:
            replies = list(pool.map(ask, shown))
        finally:  # a question that is called off waits for no picture, and asks about no further one
            pool.shutdown(wait=False, cancel_futures=True)
        errors = [reply for reply in replies if isinstance(reply, LlmError)]
        if errors and len(errors) * 2 >= len(replies):  # half of them have not voted
            raise errors[0]
        votes = {
            picture.name: said_in(reply.text, picture)
            for picture, reply in zip(pictures, replies, strict=True)
            if isinstance(reply, Reply)
        }
        read = {name: vote for name, vote in votes.items() if vote is not None}
        if votes and not read:
            raise LlmBusy("the eyes' replies name no marks")
        found, where = counted(pictures, read)
        tokens = sum((reply.tokens for reply in replies if isinstance(reply, Reply)), TokenUse())
        sight = Sight(phrase=phrase[:300], by=self.name[:200], found=found, pictures=where)
        log.info("looked", extra={"pictures": len(pictures), "found": len(found), "tokens": tokens.input})
        return Looked(sight, tokens, len(pictures) - len(read))


def asked(phrase: str, picture: MarkedPicture, png: bytes) -> tuple[Message, ...]:
    """What is sent for one picture: nothing of the file's words is in it."""
    plain = " ".join("".join(c if c.isprintable() and c not in "<>" else " " for c in phrase).split())[:PHRASE_CHARS]
    numbers = ", ".join(str(mark.number) for mark in picture.marks)
    question = filled("eyes_question.md", view=f"seen from {picture.view}", numbers=numbers, phrase=plain)
    return (Message(Role.SYSTEM, filled("eyes.md")), Message(Role.USER, question, images=(png,)))


def said_in(reply: str, picture: MarkedPicture) -> dict[int, float] | None:
    """How sure is a reply of each of the picture's marks? None where it cannot be read; other numbers do not count."""
    found = _OBJECT.search(re.sub(r"<think>.*?(?:</think>|\Z)", "", reply, flags=re.DOTALL))
    try:
        said: Any = json.loads(found.group(0)) if found is not None else None
    except (ValueError, RecursionError):
        return None
    marks = said.get("marks") if isinstance(said, dict) else None
    if not isinstance(marks, list):
        return None
    there = {mark.number for mark in picture.marks}
    sure: dict[int, float] = {}
    for one in marks[: 10 * len(there) + 10]:
        number, share = (one.get("mark"), one.get("sure")) if isinstance(one, dict) else (one, 1.0)
        is_number = isinstance(number, int) and not isinstance(number, bool)
        if not is_number or not isinstance(share, int | float) or isinstance(share, bool) or not abs(share) < NO_SHARE:
            continue
        if number in there:
            sure[number] = float(min(1, max(0, share)))
    return sure


def counted(
    pictures: Sequence[MarkedPicture], votes: dict[str, dict[int, float]]
) -> tuple[tuple[Sighted, ...], tuple[str, ...]]:
    """Which parts were found, and in which pictures, those with most of them first? `votes`: by picture and number.

    A part counts as meant when the pictures that mark it, and were read, are surer than `MEANT` on average: one that
    does not name it says 0.
    """
    said: dict[str, list[float]] = {}
    views: dict[str, list[str]] = {}
    hits: dict[str, int] = {}
    voting = [picture for picture in pictures if picture.name in votes]
    for picture in voting:
        for mark in picture.marks:
            share = votes[picture.name].get(mark.number, 0.0)
            said.setdefault(mark.part, []).append(share)
            if share > MEANT:
                views.setdefault(mark.part, []).append(picture.view)
    scores = {part: sum(shares) / len(shares) for part, shares in said.items()}
    found = {part: score for part, score in scores.items() if score > MEANT}
    for picture in voting:
        hits[picture.name] = sum(
            mark.part in found and votes[picture.name].get(mark.number, 0.0) > MEANT for mark in picture.marks
        )
    order = sorted((name for name, count in hits.items() if count), key=lambda name: -hits[name])
    return (
        tuple(
            Sighted(part=part, score=round(score, 4), views=tuple(dict.fromkeys(views.get(part, ()))))
            for part, score in found.items()
        ),
        tuple(order),
    )
