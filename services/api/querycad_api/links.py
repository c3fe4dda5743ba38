"""Where to go on from a model or a job: paths of this service, and the `Link` header of a page."""

from __future__ import annotations

from typing import TYPE_CHECKING
from urllib.parse import urlencode

from querycad_contracts import AnswerRecord

if TYPE_CHECKING:  # the question workers have no requests
    from fastapi import Request, Response


def model_links(model: str, ready: bool) -> dict[str, str]:
    """Of a model; what is made of its content is there once its file has been read."""
    own = f"/v1/models/{model}"
    links = {"self": own, "questions": f"{own}/questions", "answers": f"{own}/answers"}
    if ready:
        links |= {name: f"{own}/{name}" for name in ("parameters", "programs", "segment", "parts", "description")}
        links |= {"view": f"{own}/views/isometric", "glb": f"{own}/glb"}
    return links


def job_links(model: str, job: str, record: AnswerRecord | None) -> dict[str, str]:
    """Of a question; picture and parts are there once it is answered."""
    own = f"/v1/jobs/{job}"
    links = {"self": own, "model": f"/v1/models/{model}", "events": f"{own}/events"}
    if record is None:
        return links | {"cancel": f"{own}/cancel"}
    if record.answer is not None:
        answer = f"/v1/models/{model}/answers/{job}"
        links |= {"picture": f"{answer}/picture", "parts": f"{answer}/parts"}
    return links


def link_next(request: Request, response: Response, offset: int, limit: int, total: int) -> None:
    """Tells where the next page is, if there is one (RFC 8288)."""
    if offset + limit < total:
        query = [(name, value) for name, value in request.query_params.multi_items() if name not in ("offset", "limit")]
        query += [("offset", str(offset + limit)), ("limit", str(limit))]
        response.headers["Link"] = f'<{request.url.path}?{urlencode(query)}>; rel="next"'
