"""What frames make of a question, before and after it is known which words they pass over."""

from __future__ import annotations

from collections.abc import Set as AbstractSet
from dataclasses import dataclass, field

from querycad_language.forms import Form

Features = dict[str, float]


@dataclass(slots=True)
class Parse:
    """A form with the features of its words. `used`: the tokens whose meaning it reflects."""

    form: Form
    features: Features = field(default_factory=dict)
    used: AbstractSet[int] = frozenset()

    def with_more(self, features: Features, used: AbstractSet[int]) -> Parse:
        """The same form, for which more speaks, and that reflects more words."""
        return Parse(self.form, {**features, **self.features}, self.used | used)


@dataclass(frozen=True, slots=True)
class Reading:
    """One thing that a question can mean."""

    form: Form
    features: Features
    skipped: tuple[tuple[str, str], ...] = ()
    """(class, word) of every word that the form does not reflect, function words aside."""
    used: frozenset[int] = frozenset()
