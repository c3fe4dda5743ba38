"""`/v1/models/{id}/…`: parts, pictures, triangles, and which parts a phrase means."""

from __future__ import annotations

import asyncio
from typing import Annotated

from fastapi import APIRouter, Query, Request
from fastapi.responses import Response
from pydantic import Field

from querycad_answering.drawing.tables import table
from querycad_answering.drawing.writing import written
from querycad_api.dependencies import LimitDep, OffsetDep, ServicesDep
from querycad_api.links import link_next
from querycad_api.problems import BODY_PROBLEMS, MODEL_PROBLEMS, FaceNotFound, responses
from querycad_contracts import (
    DescribeTask,
    Description,
    Face,
    FacesTask,
    FindPartsTask,
    GroundedBy,
    Grounding,
    LengthUnit,
    ModelId,
    ModelTask,
    PartKind,
    PartsPage,
    PartsTask,
    SegmentRequest,
    Table,
    TableFormat,
    TableKind,
    TaskName,
    TaskOutcome,
    ViewName,
    ViewTask,
)
from querycad_contracts.services import PIXELS

from .drawings import DRAW_S, GLB, PNG, drawn
from .service import called

CALL_S = 20.0
DESCRIBE_S = 60.0
"""Suggested questions are answered first, each in some ten milliseconds."""
IDS = 1000
_FACES = TaskOutcome[tuple[Face, ...]]
_PARTS = TaskOutcome[PartsPage]
_GROUNDING = TaskOutcome[Grounding]
_DESCRIPTION = TaskOutcome[Description]
TEXT_MEDIA = {
    TableFormat.TEXT: "text/plain",
    TableFormat.CSV: "text/csv",
    TableFormat.MARKDOWN: "text/markdown",
}

router = APIRouter(prefix="/v1/models/{model_id}", tags=["geometry"])


@router.get("/parts", response_model=PartsPage, responses=MODEL_PROBLEMS)
async def list_parts(
    model_id: ModelId,
    services: ServicesDep,
    request: Request,
    response: Response,
    kind: Annotated[PartKind | None, Query(description="Only this kind.")] = None,
    offset: OffsetDep = 0,
    limit: LimitDep = 100,
    ids: Annotated[
        list[str] | None, Query(alias="id", max_length=IDS, description="Only the parts of these ids, repeated.")
    ] = None,
) -> PartsPage:
    """Which parts were recognised in the model? `Link` tells the next page."""
    await services.ready_model(model_id)
    task = PartsTask(model=model_id, kind=kind, ids=tuple(ids or ()), offset=offset, limit=limit)
    page = await called(services, TaskName.PARTS, task, _PARTS, CALL_S)
    link_next(request, response, offset, limit, page.total)
    return page


@router.get("/faces", response_model=tuple[Face, ...], responses={**responses(FaceNotFound), **MODEL_PROBLEMS})
async def list_faces(
    model_id: ModelId,
    services: ServicesDep,
    ids: Annotated[
        list[Annotated[int, Field(ge=0, le=2**31 - 1)]],
        Query(alias="id", min_length=1, max_length=100, description="Ids of faces, repeated, as in the GLB."),
    ],
) -> tuple[Face, ...]:
    """What are these faces: form, radius, area, and which part do they belong to?"""
    model = await services.ready_model(model_id)
    assert model.summary is not None
    if max(ids) >= model.summary.shape.face_count:
        raise FaceNotFound(f"the model has no face {max(ids)}")
    return await called(services, TaskName.FACES, FacesTask(model=model_id, ids=tuple(ids)), _FACES, CALL_S)


@router.get(
    "/tables/{kind}",
    response_model=None,
    responses={
        **MODEL_PROBLEMS,
        200: {
            "description": "The table: JSON in SI units, other forms in the unit asked for.",
            "model": Table,
            "content": {media: {"schema": {"type": "string"}} for media in TEXT_MEDIA.values()},
        },
    },
)
async def get_table(
    model_id: ModelId,
    kind: TableKind,
    services: ServicesDep,
    form: Annotated[TableFormat, Query(alias="format", description="How it is written.")] = TableFormat.JSON,
    unit: Annotated[LengthUnit, Query(description="Unit of lengths in text.")] = LengthUnit.MM,
    grouped: Annotated[
        bool | None, Query(description="A row for all parts alike, or each; null: bodies and fasteners are grouped.")
    ] = None,
) -> Response:
    """The holes, slots, bends, fasteners, bodies … of the model, a row each."""
    await services.ready_model(model_id)
    whole = await called(services, TaskName.PARTS, PartsTask(model=model_id), _PARTS, CALL_S)
    found = await asyncio.to_thread(table, kind, whole.items, grouped=grouped, unit=unit)
    return Response(written(found, form, unit), media_type=TEXT_MEDIA.get(form, "application/json"))


@router.get("/description", response_model=Description, responses=MODEL_PROBLEMS)
async def get_description(
    model_id: ModelId,
    services: ServicesDep,
    unit: Annotated[LengthUnit, Query(description="Unit of lengths in text.")] = LengthUnit.MM,
) -> Description:
    """What is the model? Size, bodies, likely unit, features in groups, and questions that have a sure answer."""
    model = await services.ready_model(model_id)
    assert model.summary is not None
    task = DescribeTask(model=model_id, summary=model.summary, unit=unit)
    return await called(services, TaskName.DESCRIPTION, task, _DESCRIPTION, DESCRIBE_S)


@router.post("/segment", response_model=Grounding, responses=BODY_PROBLEMS)
async def segment(model_id: ModelId, asked: SegmentRequest, services: ServicesDep) -> Grounding:
    """Which parts of the model does a phrase mean? A word that is not known is said to be, with the nearest known."""
    await services.ready_model(model_id)
    task = FindPartsTask(model=model_id, description=asked.description, sides=asked.sides, grounding=asked.grounding)
    wait_s = CALL_S if asked.grounding is GroundedBy.GEOMETRY else DRAW_S
    return await called(services, TaskName.FIND_PARTS, task, _GROUNDING, wait_s)


@router.get("/views/{view}", response_class=Response, responses={**MODEL_PROBLEMS, **PNG})
async def get_view(
    model_id: ModelId,
    view: ViewName,
    services: ServicesDep,
    request: Request,
    width: Annotated[int, Query(ge=PIXELS[0], le=PIXELS[1], description="Pixels.")] = 800,
    height: Annotated[int, Query(ge=PIXELS[0], le=PIXELS[1], description="Pixels.")] = 600,
) -> Response:
    """How does the model look from there? Orthographic; a side's camera stands one degree off its axis."""
    await services.ready_model(model_id)
    task = ViewTask(model=model_id, view=view, width=width, height=height)
    return await drawn(services, TaskName.VIEW, task, "image/png", request.headers)


@router.get("/glb", response_class=Response, responses={**MODEL_PROBLEMS, **GLB})
async def get_glb(model_id: ModelId, services: ServicesDep, request: Request) -> Response:
    """The model as binary glTF 2.0, metres: a named, coloured node for each body, triangles, and lines of the edges.

    The vertex attribute `_FACE_ID` holds the id of the face.
    """
    await services.ready_model(model_id)
    return await drawn(services, TaskName.GLB, ModelTask(model=model_id), "model/gltf-binary", request.headers)
