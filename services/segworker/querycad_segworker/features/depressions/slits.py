"""Slits and gaps: cuts from a bore to the outside, as in clamps, shaft collars and retaining rings."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from querycad_contracts import SurfaceKind
from querycad_segworker.features.shared.frames import frame_of
from querycad_segworker.features.shared.refusals import refuse
from querycad_segworker.features.shared.walls import Wall
from querycad_segworker.tolerances import FACING
from querycad_segworker.topology import Brep, EdgeConvexity, EdgeKind, FaceRecord
from querycad_segworker.vectors import dot, parallel, scale, sub, unit, upwards

from .depression import Depression, DepressionKind, depression_in

ALONG = 1e-2
"""Sine of the angle by which the edges of a slit may deviate from the axis of its bore."""


def recognise_slits(brep: Brep, walls: Sequence[Wall], used: set[int]) -> Iterator[Depression]:
    """Which pairs of walls that face each other run from a bore to the outside? Wider than long they are a gap.

    They end at the bore in edges along its axis, and nowhere in a floor: that would make a keyway.
    """
    for bore in walls:
        if bore.kind is not SurfaceKind.CYLINDER or bore.outward > 0 or not bore.encloses:
            continue
        flanks = _flanks(brep, bore, used)
        for i, a in enumerate(flanks):
            for b in flanks[i + 1 :]:
                gap = dot(sub(b.point, a.point), a.axis)
                if dot(a.axis, b.axis) > -FACING.parallel or not 0 < gap < 2 * bore.radius:
                    continue
                group = {a.id, b.id}
                if any(brep.beside(flank.id, EdgeConvexity.CONCAVE) for flank in (a, b)):
                    refuse("slot", group, "two walls at a bore that stand on a floor between them")
                    continue
                out = bore.axis.out_to(a.point)
                way = unit(sub(out, scale(a.axis, dot(out, a.axis))))
                frame = frame_of(brep, group, upwards(bore.axis.direction), None, way)
                found = depression_in(DepressionKind.SLOT, "rectangular", frame, group, (), bore.body, is_open=True)
                yield replace(found, width=gap, tags=("through", "slit" if frame.size[0] > gap else "gap"))
                used |= group


def _flanks(brep: Brep, bore: Wall, used: set[int]) -> list[FaceRecord]:
    """The free plane faces that end at a bore along its axis."""
    found = {
        other
        for face in bore.faces
        for edge, other in brep.neighbours(face)
        if edge.kind is EdgeKind.LINE
        and edge.convexity is EdgeConvexity.CONVEX
        and brep.faces[other].kind is SurfaceKind.PLANE
        and parallel(edge.direction, bore.axis.direction, ALONG)
    }
    return [brep.faces[i] for i in sorted(found - used)]
