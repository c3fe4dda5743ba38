"""A language model writes programs for a question: asked, checked, run, and sent back until there is an answer."""

from __future__ import annotations

import time
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from querycad_answering.judging import Verdict
from querycad_contracts import (
    Attempt,
    FailureCategory,
    LlmOptions,
    Program,
    TokenUse,
)

from .agent import work
from .breaker import Breaker
from .checks import problems
from .doubts import doubts, odd, other_measure
from .example_retrieval import words
from .forms import program_form
from .hints import hint
from .messages import ChatModel, LlmError, Message, Reply, Role, TimeLimit
from .program import program_in
from .prompt import conversation, in_words, repair
from .replies import ResumedReplies, Transcript
from .settings import LlmSettings
from .task import Candidate, Limits, Task, Written

if TYPE_CHECKING:
    from querycad_answering.eyes.mark_voting import Eyes

SAID_CHARS = 2000
"""Of a reply that is sent back with what is wrong with it; an endless one is not."""


@dataclass(frozen=True, slots=True)
class _Tried:
    """One reply: its program, what came of that, and what is to be repaired; no problem means that it stands.

    A program with an answer that is only doubted stands when it comes again.
    """

    candidate: Candidate | None
    problem: str
    code: str | None = None
    is_doubted: bool = False


class LlmWriter:
    """Writes programs with the language model of the settings, or with `model`."""

    def __init__(self, settings: LlmSettings, model: ChatModel | None = None, eyes: Eyes | None = None) -> None:
        self.settings = settings
        self._eyes = eyes
        self._models: dict[str, ChatModel] = {} if model is None else {settings.llm_model: model}
        self._breakers: dict[str, Breaker] = {}
        """Both by the model's name, and shared by all writers that come of one."""
        self._transcript: Transcript | None = None

    def chosen(self, options: LlmOptions | None) -> LlmWriter:
        """The writer with what a caller chose. Raises LlmOptionRefused."""
        return self._like(self.settings.chosen(options), self._transcript)

    def resuming(self, transcript: Transcript) -> LlmWriter:
        """The writer for one question, which goes on where the transcript ends."""
        return self._like(self.settings, transcript)

    def _like(self, settings: LlmSettings, transcript: Transcript | None) -> LlmWriter:
        other = LlmWriter(settings, eyes=self.eyes)
        other._models, other._breakers, other._transcript = self._models, self._breakers, transcript
        return other

    @property
    def eyes(self) -> Eyes | None:
        """Who is shown pictures; None where nobody is."""
        shown = self.settings.eyes()
        if self._eyes is None and shown is not None:
            from querycad_answering.eyes.mark_voting import Eyes  # here: eyes speak through this package

            self._eyes = Eyes(shown)
        return self._eyes

    @property
    def codegen(self) -> str:
        """Who writes, as records say it."""
        return f"llm:{self.settings.llm_model}" if self.settings.llm_model else "llm"

    def write(self, task: Task, looks: bool = False) -> Written:
        """Which programs does the language model write? `error` says why there are not as many as asked for.

        `looks`: it may run programs and see what they show before it answers.
        """
        written = Written()
        breaker = self._breakers.setdefault(
            self.settings.llm_model, Breaker(self.settings.llm_failures, self.settings.llm_pause_s)
        )
        try:
            breaker.check()
        except LlmError as error:
            written.error = error
            return written
        model = self._asked()
        deadline = TimeLimit(self.settings.llm_timeout_s)
        try:
            if looks:
                codegen = self.codegen.replace("llm", "agent", 1)
                work(model, task, codegen, self.limits, deadline, written)
            for sample in range(1, 1 if looks else self.settings.llm_samples + 1):
                candidate = self._sample(model, task, sample, deadline, written)
                if candidate is not None:
                    written.candidates.append(candidate)
        except LlmError as error:
            written.error = error
        breaker.heard(None if written.attempts else written.error)
        return written

    def _asked(self) -> ChatModel:
        """The language model, opened once, with what it said about this question before."""
        model = self._models.get(self.settings.llm_model)
        if model is None:
            from .client import open_model  # here: where no language model is asked, no HTTP client is loaded

            model = self._models[self.settings.llm_model] = open_model(self.settings, program_form())
        return model if self._transcript is None else ResumedReplies(model, self.settings, self._transcript)

    @property
    def limits(self) -> Limits:
        """How far may it go as an agent?"""
        return Limits(
            steps=self.settings.llm_steps,
            tokens=self.settings.llm_budget,
            temperature=self.settings.llm_temperature,
            examples=self.settings.llm_examples,
            only_programs=self.settings.only_programs,
            capable=self.settings.has_last_word,
        )

    def _sample(
        self, model: ChatModel, task: Task, sample: int, deadline: TimeLimit, written: Written
    ) -> Candidate | None:
        """What comes of one conversation? The last program that came of it, repaired as often as allowed."""
        start = conversation(task.question, task.summary, task.expect, self.settings.llm_examples)
        messages, last, earlier = start, None, set[str | None]()
        for repairs in range(self.settings.llm_repairs + 1):
            # The first program is the likeliest; another sample, and what was repeated unrepaired, needs chance.
            is_drawn = sample > 1 or len(earlier) < repairs
            temperature = self.settings.llm_temperature if is_drawn else 0.0
            began = time.perf_counter()
            reply = model.reply(messages, temperature, sample, deadline)
            tried = _try(task, reply, self.codegen)
            written.attempts.append(self._attempt(sample, tried, reply.tokens, time.perf_counter() - began))
            last = _further(last, tried.candidate)
            if not tried.problem or (tried.is_doubted and tried.code in earlier):
                return tried.candidate
            earlier.add(tried.code)
            messages = (*start, Message(Role.ASSISTANT, reply.text[:SAID_CHARS]), repair(tried.problem))
        return _as_it_is(task, last)

    def _attempt(self, sample: int, tried: _Tried, tokens: TokenUse, seconds: float) -> Attempt:
        answer = tried.candidate.verdict.answer if tried.candidate is not None and not tried.problem else None
        return Attempt(
            codegen=self.codegen,
            sample=sample,
            code=tried.code,
            answer=answer.text if answer is not None else None,
            problem=tried.problem or _said(tried.candidate),
            tokens=tokens,
            seconds=round(seconds, 3),
        )


def _said(candidate: Candidate | None) -> str:
    failure = candidate.verdict.failure if candidate is not None else None
    return failure.message if failure is not None else ""


def _try(task: Task, reply: Reply, codegen: str) -> _Tried:
    """What comes of one reply?"""
    code = program_in(reply.text, reply.cut)
    if code is None:
        lacking = "The reply broke off before its program was whole." if reply.cut else "The reply holds no code block."
        return _Tried(None, lacking)
    if found := problems(code, task.question):
        return _Tried(None, " ".join(found), code)
    program = Program(code=code, codegen=codegen, expects=task.wanted)
    candidate = Candidate(program, task.judge(program))
    if problem := _problem(task, candidate):
        return _Tried(candidate, problem, code)
    answer = candidate.verdict.answer
    doubt = f"{odd(answer, code)} {_doubt(task, code)}".strip() if answer is not None else ""
    return _Tried(candidate, doubt, code, is_doubted=bool(doubt))


def _further(last: Candidate | None, candidate: Candidate | None) -> Candidate | None:
    """Which of two programs is to be kept: the later one, unless only the earlier one has an answer."""
    if candidate is None or (last is not None and last.verdict.answer is not None and candidate.verdict.answer is None):
        return last
    return candidate


def _doubt(task: Task, code: str) -> str:
    """What of the question is not in the program? Nothing where the parser does not know the question's words."""
    if task.asked is None:
        return ""
    return " ".join(doubts(code, task.question, task.asked, task.summary))


def _problem(task: Task, candidate: Candidate) -> str:
    """What has the language model to repair? Nothing where another program could not do better."""
    verdict, code = candidate.verdict, candidate.program.code
    if verdict.answer is not None:
        return other_measure(code, task.wanted)
    if verdict.missing is not None:
        return _doubt(task, code) or _unfound(task, verdict)
    assert verdict.failure is not None
    message = verdict.failure.message
    if verdict.failure.category is FailureCategory.UNEXPECTED:
        return f"{message}."
    if task.wanted is not None and verdict.wrong_type:
        return f"{message}: the question asks for {in_words(task.wanted)}."
    return " ".join(filter(None, (f"{message}.", hint(message, verdict.lacking), _doubt(task, code))))


def _unfound(task: Task, verdict: Verdict) -> str:
    """What is said when no part was found? Nothing where the question's own words were looked for: there is none."""
    missing = verdict.missing
    assert missing is not None
    if set(words(missing.description)) <= set(words(task.question)):
        return ""
    known = f" Known here: {', '.join(missing.nearest)}." if missing.nearest else ""
    return f"{missing.message}.{known} Describe the part in the question's own words."


def _as_it_is(task: Task, last: Candidate | None) -> Candidate | None:
    """The last program as it is, when all repairs are used up: its answer may be of another type than was thought."""
    if last is None or last.verdict.answer is not None or task.expect.type is not None or task.asked is None:
        return last
    return replace(last, verdict=task.judge(last.program.model_copy(update={"expects": None})))
