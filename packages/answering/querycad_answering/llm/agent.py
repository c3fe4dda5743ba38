"""A language model that looks before it answers: it runs small programs, reads what they show, and then answers.

Each of its replies holds one program. One that does not assign `solution` is a look: what it prints, and the parts that
it found, are shown. One that does is an answer, which stands at once where nothing speaks against it; else it is shown
what does, and decides: the same again, another program, or that it is unsure. The steps and the tokens are bounded.
"""

from __future__ import annotations

import ast
import re
import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import partial
from textwrap import shorten

from querycad_answering.judging import Verdict
from querycad_answering.typed import are_several, same_value
from querycad_contracts import (
    RESULT,
    Answer,
    AnswerType,
    Attempt,
    Grounding,
    Part,
    Program,
    RunOutcome,
    RunStatus,
    TokenUse,
)
from querycad_contracts.guest_reference import syntax_of

from .checks import problems
from .doubts import doubts, odd, other_measure
from .hints import hint
from .messages import ChatModel, LlmError, Message, Reply, Role, TimeLimit
from .program import blocks_in, program_in
from .prompt import agent_conversation, in_words, shown
from .task import Candidate, Limits, Task, Written

ROWS, CELL_CHARS = 12, 80
"""Of a table of parts: lines, and characters of a label."""
IDS, PLACES = 12, 6
"""Of parts that are alike: how many are named, and of how many it is said where they are."""
NEAREST_DIGITS = 8
"""Of a coordinate in metres: what is nearer to zero is the kernel's noise."""
PRINTED_CHARS, VALUE_CHARS, SHOWN_CHARS = 1500, 400, 3000
"""Of what is shown after a step: as much as a small model reads in a moment."""
WIDER = 4
"""So many times as much for a capable one."""
CUT = "… cut here, {} more lines: print less, or what is alike once."
NOISE = 1e-15
"""A number nearer to zero is zero, that was computed."""
_LONG_NUMBER = re.compile(r"(?<![\w.])-?(?:\d+\.\d{7,}(?:e[+-]?\d+)?|\d+(?:\.\d+)?e-\d+)(?![\w.])")
NOTHING = "Nothing was printed, and no part was looked for."
MEND = "Send another program, which mends this. Only if nothing of it is so, send the same again."
LOOK_FIRST = "to keep your answer against it, look first at what shows that the parser is wrong"
REPLY_CHARS = 2000
"""Of a reply that stays in the conversation."""
_WORD = re.compile(r"[a-z]+")
_UNSURE = re.compile(r"^\W*unsure\b\W*", re.IGNORECASE)
_ASK = re.compile(r"^\W*ask\b\s*:\s*", re.IGNORECASE)


@dataclass(slots=True)
class _Course:
    """How far a question is."""

    messages: tuple[Message, ...]
    tokens: TokenUse = field(default_factory=TokenUse)
    answers: list[Candidate] = field(default_factory=list)
    """Programs that gave an answer, in order."""
    images: tuple[bytes, ...] = ()
    """Those that the last program asked for."""
    codes: set[str] = field(default_factory=set)
    """Those of them that were doubted."""
    doubted: list[tuple[Answer, frozenset[str]]] = field(default_factory=list)
    """Their answers, and what was said against each."""
    tables: set[str] = field(default_factory=set)
    """Those that were shown: none is shown again."""
    has_looked: bool = False
    """Since an answer was doubted."""
    said: list[str] = field(default_factory=list)
    """Its replies that led to no answer: their programs, else what was said."""

    def shown_to(self, code: str) -> set[str]:
        """The tables that are known when this program is run; none where it takes the place of the one before."""
        if self.said[-1:] == [code]:
            self.tables.clear()
        return self.tables

    def was_told(self, answer: Answer, against: Sequence[str]) -> bool:
        """Was all of this said against the same answer before? Then the model holds to it, in other words."""
        return any(same_value(answer, other) and told.issuperset(against) for other, told in self.doubted)

    def goes_on(self, reply: Reply, code: str | None, seen: str, left: int) -> bool:
        """Adds a reply and what it is shown. Is it one that came before? Then the conversation grows by nothing.

        A small model that reads its own failure again and again says it ever more surely.
        """
        what = code or reply.text
        told = Message(Role.ASSISTANT, reply.text[:REPLY_CHARS]), shown(seen, left, self.images)
        self.images = ()
        is_again = what in self.said
        if self.said[-1:] == [what]:
            self.messages = (*self.messages[:-1], told[1])
        else:
            self.messages = (*self.messages, *told)
        self.said.append(what)
        return is_again


def work(model: ChatModel, task: Task, codegen: str, limits: Limits, deadline: TimeLimit, written: Written) -> None:
    """Adds to `written` what comes of the question. Raises LlmError. What there is by then is kept."""
    course = _Course(agent_conversation(task.question, task.summary, task.expect, task.readings(), task.tools, limits))
    temperature = 0.0
    for step in range(1, limits.steps + 1):
        began = time.perf_counter()
        try:
            reply = model.reply(course.messages, temperature, step, deadline)
        except LlmError:
            _end(task, course, limits, written)
            raise
        course.tokens += reply.tokens
        attempt = Attempt(codegen=codegen, sample=step, code=None, tokens=reply.tokens)
        is_done, seen, attempt = _step(task, course, reply, attempt, limits, written)
        seconds = round(time.perf_counter() - began, 3)
        written.attempts.append(attempt.model_copy(update={"seconds": seconds, "problem": seen}))
        if is_done or course.tokens.input + course.tokens.output >= limits.tokens:
            break
        is_again = course.goes_on(reply, attempt.code, seen, limits.steps - step)
        temperature = limits.temperature if is_again else 0.0
    _end(task, course, limits, written)


def _end(task: Task, course: _Course, limits: Limits, written: Written) -> None:
    """The last answer stands where none was settled on.

    To say the same again is no reason against a sure parser, unless a capable model says it: of 60 fresh questions such
    a one was right on all, and on each of the three where the sure parser was not.
    """
    if written.question or written.is_unsure:
        return
    if not written.candidates:
        written.candidates += course.answers[-1:]
    answer = written.candidates[-1].verdict.answer if written.candidates else None
    yields = answer is not None and not course.has_looked and not limits.capable
    parsed = task.parsed() if yields else None
    if parsed is not None and answer is not None and parsed.is_sure:
        written.yields = not same_value(parsed.answer, answer, each_once=True)


def _step(
    task: Task, course: _Course, reply: Reply, attempt: Attempt, limits: Limits, written: Written
) -> tuple[bool, str, Attempt]:
    """Is the question settled, and if not, what is the language model shown? With the step's record."""
    blocks = blocks_in(reply.text, reply.cut)
    if not blocks:
        return _said(course, reply, attempt, written)
    code = blocks[-1]
    if not _assigns_result(code):
        outcome = task.run(Program(code=f"{code}\n{RESULT} = None", codegen=attempt.codegen))
        course.has_looked = course.has_looked or (bool(course.codes) and outcome.status is RunStatus.OK)
        drawn = _drawn(task, course, outcome)
        return (
            False,
            "\n".join((look(outcome, shown=course.shown_to(code), wide=limits.capable), *drawn)),
            attempt.model_copy(update={"code": code}),
        )
    code = program_in(reply.text, reply.cut) or code
    attempt = attempt.model_copy(update={"code": code})
    if wrong := problems(code, task.question):
        return False, " ".join(wrong), attempt
    program = Program(code=code, codegen=attempt.codegen, expects=task.wanted)
    outcome = task.run(program)
    verdict = task.judged(program, outcome)
    if verdict.answer is None and limits.capable and task.expect.type is None and outcome.status is RunStatus.OK:
        program = program.model_copy(update={"expects": None})  # what the parser takes the question for is no law
        verdict = task.judged(program, outcome)
    if verdict.answer is None:
        return False, _failed(outcome, verdict, course.shown_to(code), limits.capable), attempt
    candidate = Candidate(program, verdict)
    course.answers.append(candidate)
    attempt = attempt.model_copy(update={"answer": verdict.answer.text})
    against = _against(task, program, outcome, verdict, limits.capable)
    if not against or code in course.codes or course.was_told(verdict.answer, against):
        written.candidates.append(candidate)
        return True, "", attempt
    course.codes.add(code)
    course.doubted.append((verdict.answer, frozenset(against)))
    noted = "\n".join(f"- {each}" for each in against)
    would = f"The answer would be {verdict.answer.text}. What may speak against it:\n{noted}"
    return False, f"{look(outcome, shown=course.shown_to(code), wide=limits.capable)}\n{would}\n{MEND}", attempt


def _said(course: _Course, reply: Reply, attempt: Attempt, written: Written) -> tuple[bool, str, Attempt]:
    """What comes of a reply without a program: that it is unsure, or asks back."""
    text = reply.text.strip()
    if _ASK.match(text):
        written.question = " ".join(_ASK.sub("", text).split())[:REPLY_CHARS]
        return True, f"it asks: {written.question}", attempt
    if _UNSURE.match(text) and course.answers:
        written.is_unsure = True
        written.candidates += _different(course.answers)
        return True, "it is unsure", attempt
    return False, "The reply broke off." if reply.cut else "The reply holds no program.", attempt


def _different(answers: Sequence[Candidate]) -> list[Candidate]:
    """The last program of each answer, the last answer first."""
    kept: list[Candidate] = []
    for candidate in reversed(answers):
        answer = candidate.verdict.answer
        if answer is not None and not any(_same(answer, other) for other in kept):
            kept.append(candidate)
    return kept


def _same(answer: Answer, other: Candidate) -> bool:
    return other.verdict.answer is not None and same_value(answer, other.verdict.answer)


def _drawn(task: Task, course: _Course, outcome: RunOutcome) -> list[str]:
    """What is said of the pictures that a program asked for; those that could be drawn go with the next message."""
    lines: list[str] = []
    for asked in outcome.pictures:
        if task.draw is None:
            return ["No pictures can be shown here."]
        try:
            course.images += (task.draw(asked),)
        except (KeyError, OSError) as error:
            lines.append(f"A picture could not be drawn: {error}")
            continue
        numbers = "; ".join(f"{number}: {part}" for number, part in enumerate(asked.parts, start=1))
        side = f"seen from {asked.side.value}" if asked.side is not None else "seen from where most of it shows"
        lines.append(f"Picture {len(course.images)}, {side}{f', with numbers {numbers}' if numbers else ''}.")
    return lines


def look(outcome: RunOutcome, why: bool = True, shown: set[str] | None = None, wide: bool = False) -> str:
    """What a program showed, in short: what it printed, what it gave, and a table of the parts that it found.

    `why`: also why it did not end well. `shown`: tables that were shown before, to which those of this one are added.
    `wide`: several times as much, for who reads it at a glance; what was printed is then not shown again as tables.
    """
    scale = WIDER if wide else 1
    most = 0 if wide and outcome.printed else scale * ROWS
    before, tables = set() if shown is None else shown, list[str]()
    lines: list[str] = []
    if why and outcome.status is not RunStatus.OK:
        more = hint(outcome.message, outcome.missing_attribute)
        lines.append(" ".join(filter(None, (f"{outcome.status.value}: {outcome.message}", more))))
    if outcome.printed:
        lines.append(f"printed: {_within(_short(outcome.printed.strip()), scale * PRINTED_CHARS)}")
    if outcome.status is RunStatus.OK and outcome.value is not None:
        lines.append(f"{RESULT} = {str(_rounded(outcome.value))[: scale * VALUE_CHARS]}")
    for grounding in outcome.groundings:
        head, *rows = _table(grounding, most)
        table = "\n".join((head, *rows))
        lines += [f"{head} | as shown before"] if rows and table in before else [head, *rows]
        tables.append(table)
    text = _within("\n".join(lines), scale * SHOWN_CHARS) or NOTHING
    before.update(table for table in tables if table in text)
    return text


def _within(text: str, most: int) -> str:
    """The text, whose last lines are only counted where it is too long: half a line may say something else."""
    if len(text) <= most:
        return text
    kept = text[: most - len(CUT)].rpartition("\n")[0] or text[: most - len(CUT)]
    left = text.count("\n") - kept.count("\n")
    return f"{kept}\n{CUT.format(left)}"


def _short(text: str) -> str:
    """The text with six digits of its long numbers: what follows is the kernel's noise."""

    def short(found: re.Match[str]) -> str:
        number = float(found[0])
        return f"{number:.6g}" if abs(number) > NOISE else "0"

    return _LONG_NUMBER.sub(short, text)


def _rounded(value: object) -> object:
    """The value with six digits of every number: what follows is the kernel's noise."""
    if isinstance(value, list):
        return [_rounded(each) for each in value]
    return float(f"{value:.6g}") if isinstance(value, float) else value


def _table(grounding: Grounding, most: int) -> list[str]:
    """The parts of one call, a line each, with what of its words is not in them."""
    said = f"{grounding.description!r} is {len(grounding.parts)} part{'' if len(grounding.parts) == 1 else 's'}"
    notes = [f"ignored: {', '.join(grounding.ignored)}"] if grounding.ignored else []
    notes += [f"not checked: {', '.join(grounding.unchecked)}"] if grounding.unchecked else []
    notes += [grounding.message] if grounding.message else []
    notes += [f"known here: {', '.join(grounding.nearest)}"] if grounding.nearest else []
    rows = [row for group in _alike(grounding.parts) for row in _rows(group)]
    more = len(rows) - most if most else 0
    return [" | ".join([said, *notes]), *rows[:most], *([f"  … and {more} more lines"] if more > 0 else [])]


def _alike(parts: Sequence[Part]) -> list[list[Part]]:
    """The parts, those together that differ by their place alone."""
    groups: dict[tuple[object, ...], list[Part]] = {}
    for part in parts:
        groups.setdefault((part.label, part.sides, part.radius, part.radii, part.tags), []).append(part)
    return list(groups.values())


def _rows(parts: Sequence[Part]) -> list[str]:
    """A line each; one for all of more than two that are alike, with the first of their places."""
    if len(parts) <= 2:
        return [_row(part, part.id, f"center {_place(part)}") for part in parts]
    ids, places = [part.id for part in parts], [_place(part) for part in parts]
    listed, more = (", ".join(ids[:IDS]), ", …" if len(ids) > IDS else "")
    centers = ", ".join(places[:PLACES]) + (", …" if len(places) > PLACES else "")
    return [_row(parts[0], f"{len(parts)} x {listed}{more}", f"centers {centers}")]


def _place(part: Part) -> str:
    return f"({', '.join(f'{round(coordinate, NEAREST_DIGITS) + 0.0:.4g}' for coordinate in part.center)})"


def _row(part: Part, ids: str, places: str) -> str:
    radii = part.radii or (() if part.radius is None else (part.radius,))
    sizes = f"radii {', '.join(f'{radius:.4g}' for radius in radii)}" if radii else ""
    sides = ", ".join(part.sides) or "hidden"
    cells = (ids, shorten(part.label, CELL_CHARS, placeholder=" …"), sides, places, sizes, " ".join(part.tags[:4]))
    return "  " + " | ".join(filter(None, cells))


def _failed(outcome: RunOutcome, verdict: Verdict, shown_before: set[str], wide: bool) -> str:
    assert verdict.failure is not None
    told = verdict.failure.message
    more = hint(told, verdict.lacking)
    return f"No answer: {' '.join(filter(None, (f'{told}.', more)))}\n{look(outcome, False, shown_before, wide)}"


def _against(task: Task, program: Program, outcome: RunOutcome, verdict: Verdict, capable: bool) -> list[str]:
    """What speaks against an answer: words left out, none found, a whole body, several for one, the parser's own.

    A capable model is not told what small ones forget, nor of a parser that is not sure: of 15 such, 13 were wrong.
    """
    assert verdict.answer is not None
    code, found = program.code, list[str]()
    if task.asked is not None and program.expects is None and task.expect.type is None:
        found.append(f"a parser takes the question to ask for {in_words(task.asked)}")
    for grounding in outcome.groundings:
        left = dict.fromkeys(word.strip("'") for word in (*grounding.ignored, *grounding.unchecked))
        found += [f"of {grounding.description!r} this is not in the parts: {', '.join(left)}"] if left else []
        found += [grounding.message] if not grounding.parts and grounding.message else []
    if _is_none(verdict.answer):
        found.append("the answer is none")
    if "find_parts" in code and verdict.parts and not any(map(partial(_is_feature, task.question), verdict.parts)):
        found.append(f"it rests on a whole body: {verdict.parts[0].label}")
    if several := are_several(verdict.answer, task.wanted):
        asked = in_words(task.wanted) if task.wanted is not None else "one"
        found.append(f"{asked} is asked for, and these are {several}: tell which part is meant")
    found += filter(None, (odd(verdict.answer, code), other_measure(code, task.wanted)))
    if task.asked is not None:
        found += doubts(code, task.question, task.asked, task.summary, by_words=not capable)
    parsed = task.parsed()
    is_heard = parsed is not None and (not capable or (parsed.is_sure and not _is_none(parsed.answer)))
    if parsed is not None and is_heard and not _agrees(parsed.answer, verdict.answer):
        who = "a parser, which is sure," if parsed.is_sure else "a parser"
        found.append(f"{who} understands the question as {parsed.meant!r} and gets {parsed.answer.text}")
        found += [LOOK_FIRST] if parsed.is_sure and not capable else []
    return list(dict.fromkeys(found))


def _agrees(answer: Answer, other: Answer) -> bool:
    """Do they say the same? So do a size and its three lengths, in any order."""
    first, second = (
        one.model_copy(update={"type": AnswerType.LENGTHS}) if one.type is AnswerType.SIZE else one
        for one in (answer, other)
    )
    return same_value(answer, other, each_once=True) or same_value(first, second)


def _is_none(answer: Answer) -> bool:
    return answer.value in (0, 0.0, []) and not isinstance(answer.value, bool)


def _is_feature(question: str, part: Part) -> bool:
    """Is it less than a body, or a body that the question calls by its whole name?"""
    said, name = set(_WORD.findall(question.lower())), _WORD.findall((part.name or "").lower())
    return not part.kind.is_whole or (bool(name) and said.issuperset(name))


def _assigns_result(code: str) -> bool:
    """Does the program assign `solution`? One that Python cannot read counts as one that does: it is to be mended."""
    if (tree := syntax_of(code)) is None:
        return RESULT in code
    return any(
        isinstance(node, ast.Name) and node.id == RESULT and isinstance(node.ctx, ast.Store) for node in ast.walk(tree)
    )
