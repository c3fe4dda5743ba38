"""Records of questions that no program was run for."""

from __future__ import annotations

from querycad_contracts import AnswerRecord, Failure, Status


def failed(question: str, failure: Failure) -> AnswerRecord:
    """The record of a question without an answer."""
    return AnswerRecord(
        question=question,
        status=Status.FAILED,
        answer=None,
        code=None,
        codegen=None,
        parts=(),
        timings_ms={},
        warnings=(),
        failure=failure,
    )


def cancelled(question: str) -> AnswerRecord:
    """The record of a question that somebody called off."""
    return failed(question, Failure(category="cancelled", message="the question was cancelled"))
