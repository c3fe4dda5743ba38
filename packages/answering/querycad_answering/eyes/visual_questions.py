"""Questions with eyes: what a program or a reading looks for is looked at first, and then it goes on.

Who has the model keeps what was seen, by phrase, and says of each grounding by whom it was seen. A program whose
groundings nobody has looked at yet is run, its phrases are looked at, and it is run again: it gives the same calls.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from functools import cached_property

from querycad_answering.candidates import Ground
from querycad_answering.llm.messages import LlmError, TimeLimit
from querycad_answering.understanding import ModelView, Run
from querycad_contracts import Grounded, Grounding, PartQuery, PictureRequest, Program, RunOutcome, TokenUse, needs_eyes

from .mark_voting import Eyes, Place

ROUNDS = 3
"""How often a program is run again: what it looks for may depend on what it has found."""


@dataclass
class Seeing:
    """The eyes of one question."""

    eyes: Eyes
    place: Place
    tokens: TokenUse = field(default_factory=TokenUse)
    notes: list[str] = field(default_factory=list)
    _looked: dict[str, bool] = field(default_factory=dict)
    """Phrases, and whether they could be looked for."""

    @cached_property
    def _deadline(self) -> TimeLimit:
        """Of all that is looked for, for the question; it runs from the first look."""
        return TimeLimit(self.eyes.settings.llm_timeout_s)

    def running(self, run: Run) -> Run:
        """The same, with phrases looked for."""

        def seen(program: Program) -> RunOutcome:
            outcome = run(program)
            for _ in range(ROUNDS):
                if not self._look_for(outcome.groundings):
                    break
                outcome = run(program)
            return outcome

        return seen

    def viewing(self, view: ModelView) -> ModelView:
        """The same view, whose groundings use what is seen; looked for is what geometry has no word for."""
        return ModelView(self._grounding(view.ground), view.whole, view.names, view.kinds, view.contents)

    def _grounding(self, ground: Ground) -> Ground:
        def seen(queries: Sequence[PartQuery]) -> Sequence[Sequence[Grounded]]:
            found = ground(queries)
            unknown = [
                query for query, ways in zip(queries, found, strict=True) if not query.ids and needs_eyes(tuple(ways))
            ]
            if not unknown or not self._look_for(self.place.find_parts(query) for query in unknown):
                return found
            return ground(queries)

        return seen

    def picture(self, asked: PictureRequest) -> bytes:
        """The picture that a program asks for. Raises KeyError and OSError."""
        return self.place.png(self.place.marked(asked)[0].name)

    def _look_for(self, groundings: Iterable[Grounding]) -> bool:
        """Looks for the phrases that these eyes have not looked for; is anything known that was not known before?"""
        phrases = dict.fromkeys(one.description for one in groundings if one.seen_by not in (None, self.eyes.name))
        known = [self._looks(phrase) for phrase in phrases]  # every one of them, whatever came of those before
        return any(known)

    def _looks(self, phrase: str) -> bool:
        if phrase in self._looked:
            return False
        if len(self._looked) >= self.eyes.settings.eyes_phrases:
            self._note(f"not looked for, after {len(self._looked)} phrases: '{phrase}'")
            return False
        self._looked[phrase] = False
        try:
            looked = self.eyes.look(phrase, self.place, self._deadline)
        except (LlmError, OSError) as error:
            self._note(f"nobody could look for '{phrase}': {error}")
            return False
        self.tokens += looked.tokens
        if looked.unread:
            self._note(f"of the pictures for '{phrase}', {looked.unread} got no reply that could be read")
        self.place.keep_sight(looked.sight)
        self._looked[phrase] = True
        return True

    def _note(self, text: str) -> None:
        if text not in self.notes:
            self.notes.append(text)
