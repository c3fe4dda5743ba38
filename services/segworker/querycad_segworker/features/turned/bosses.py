"""Bosses: cylindrical and conical steps that stand out of the material, from a flat disc to a long shaft."""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from dataclasses import dataclass

from querycad_contracts import SurfaceKind, Vector
from querycad_segworker.features.holes.hole import RIM, Hole, Section, SectionKind
from querycad_segworker.features.shared.coaxial_stacks import (
    End,
    Stack,
    radius_at,
    roundings_beside,
    stacks,
    wall_range,
)
from querycad_segworker.features.shared.refusals import refuse
from querycad_segworker.features.shared.regular import end_of_corner_chamfer
from querycad_segworker.features.shared.shaft_steps import ALIKE, FLANGE_RATIO, FLAT, goes_on, is_clasped, is_collar
from querycad_segworker.features.shared.walls import Axis, Wall, is_waist
from querycad_segworker.tolerances import Tolerances, exceeds, reaches
from querycad_segworker.topology import Brep, EdgeConvexity, EdgeKind
from querycad_segworker.vectors import parallel, points_up, scale

from .necks import is_flank, is_neck
from .step_bores import Bore, bore_in, hole_in, inside_of_rim, length_bored
from .step_ends import before_jaws, oblique_ends

WIDER = 1.05
"""A chamfer begins about as wide as the cylinder that it is on."""
SLENDER = 1.0
"""Longer than its diameter: a shaft, pin or rod rather than a boss or disc."""
TUBE_RATIO = 0.5
"""A bore of more than half the diameter makes a tube; below that it is a shaft or boss with a bore."""
HOLLOW = 0.5
"""A tube is bored along more than this share of its height: it may be closed at one end; a shaft with a hole in its end
is none."""

BREAK = 0.2
"""The chamfer of an edge is lower than this share of the radius."""
BROAD, CORNER = 0.5, 1 / 3
"""A cone higher than this share of the radius of the cylinder it breaks is a step; one in the corner at a cylinder's
foot from a third on, as the hubs of welding neck flanges are (EN 1092-1): what eases a shoulder is lower."""
LEANS = 0.5
"""The middle of a fillet on a cone lies within this share of its height from where it begins: walls that lean less than
some 30 degrees."""
BALL = 0.1
"""A sphere whose middle lies beyond the end of a step by more than this share of its radius is no cap on it."""
LEAST_SWEEP = math.radians(80.0)
"""A boss in the corner of a box shows a quarter of its wall, but for what fillets take."""
DRAFT_RAD = math.radians(5.0)
"""A boss that leans no more is a cylinder with draft, and still called one: cast and moulded bosses lean by 1 to 5
degrees (Machinery's Handbook, draft in patterns and forging dies)."""


@dataclass(frozen=True, slots=True)
class Boss:
    """One step that stands out. Metres, frame of the file.

    `normal` points from `base` to `tip` along the axis. `radius` is the widest.
    `hole` is the index of the coaxial hole in its tip, of a standoff or ring, `bore_radius` that hole's radius where it
    runs through the step, of a tapered bore at the step's wide end; None of a shaft with no more than a hole in its
    end. `wall` is the thickness of what is around the bore, square to the bore where that tapers; None where it is not
    hollow, or the wall tapers. `breaks` are chamfers at its ends; `step_of` counts the steps of its stack.
    """

    base: Vector
    tip: Vector
    normal: Vector
    radius: float
    height: float
    tags: tuple[str, ...]
    faces: tuple[int, ...]
    body: int
    hole: int | None
    bore_radius: float | None
    wall: float | None
    breaks: tuple[Section, ...]
    step_of: int
    pitch: float | None = None
    """Of a modelled thread, along the axis."""
    lean: float = 0.0
    """Between a cone's wall and its axis, radians."""
    tips: tuple[Vector, ...] = ()
    """All free ends of its axis, where they are more than `tip`."""
    between_planes: float | None = None
    """How far apart its ends are, square to them, where parallel planes cut it off obliquely."""
    is_broken_edge: bool = False
    """It is a cone that breaks the corners of a nut, head or other prism: as a part, that is a chamfer and no boss."""


def recognise_bosses(brep: Brep, walls: Sequence[Wall], holes: Sequence[Hole], tolerances: Tolerances) -> list[Boss]:
    """Which round protrusions does the model have? One record a step, sorted by lowest face id.

    A step is a convex cylinder or cone that encloses its axis, or one with a hole that grows out of walls beside it;
    roundings and chamfers at its ends belong to it, and the two sides of a groove turned into it are one step. A cone
    that breaks the corners of a prism is marked as such: it tells how wide a turned body is, and is no boss as a part.
    """
    found: list[Boss] = []
    grown = {wall.faces for wall in walls if _grows_out(brep, wall, holes, tolerances)}

    def stands(wall: Wall) -> bool:
        if wall.kind is SurfaceKind.TORUS and wall.outward < 0:
            return _is_round_groove(brep, wall, tolerances)
        return wall.outward > 0 and (wall.encloses or wall.faces in grown)

    for stack in stacks(brep, walls, tolerances, stands, over_roundings=True):
        steps = _steps(stack, tolerances)
        found.extend(_boss(brep, stack, steps, step, holes, tolerances) for step in steps)
    for wall in walls:
        stood = stands(wall) or wall.outward < 0
        if wall.kind is SurfaceKind.CYLINDER and not stood and wall.sweep > math.pi / 2:
            refuse("boss", wall.faces, f"its wall covers {math.degrees(wall.sweep):.0f} of 360 degrees")
    return sorted(found, key=lambda boss: boss.faces[0])


def _is_round_groove(brep: Brep, wall: Wall, tolerances: Tolerances) -> bool:
    """Is a hollow torus a groove turned around a step: narrower than its diameter, its throat between two wider ends?

    The fillet at a shoulder ends at its throat.
    """
    torus = brep.faces[wall.faces[0]]
    throat = torus.radius - torus.minor_radius
    dips = min(wall.radius_low, wall.radius_high) > throat + 3 * tolerances.length
    return wall.encloses and is_waist(torus) and dips and not reaches(wall.height, 2 * throat)


def _grows_out(brep: Brep, wall: Wall, holes: Sequence[Hole], tolerances: Tolerances) -> bool:
    """Is it the wall of a screw boss in the corner of a box, or at its side? Around a hole, and walls begin beside it.

    The hole opens at one end of it, and along its sides the walls meet it in concave edges, or fillets.
    """
    if wall.kind is not SurfaceKind.CYLINDER or wall.outward < 0 or wall.encloses or wall.sweep < LEAST_SWEEP:
        return False
    near = 10 * tolerances.length
    opens = (
        hole.body == wall.body and hole.radius < wall.radius and parallel(hole.normal, wall.axis.direction, 1e-3)
        and wall.axis.radius_of(hole.opening) <= near
        and any(abs(wall.axis.position(hole.opening) - end) <= near for end in (wall.low, wall.high))
        for hole in holes
    )  # fmt: skip
    sides = [
        (edge, brep.faces[other])
        for face in wall.faces
        for edge, other in brep.neighbours(face)
        if edge.kind is EdgeKind.LINE
        and parallel(edge.direction, wall.axis.direction, 1e-3)
        and other not in wall.faces
    ]
    return any(opens) and bool(sides) and all(
        edge.convexity is EdgeConvexity.CONCAVE
        or (edge.convexity is EdgeConvexity.SMOOTH and beside.kind is SurfaceKind.CYLINDER and beside.outward < 0)
        for edge, beside in sides
    )  # fmt: skip


def _steps(stack: Stack, tolerances: Tolerances) -> list[tuple[Wall, ...]]:
    """The steps in order along the axis; walls of one radius with nothing but a groove between them are one."""
    steps: list[list[Wall]] = []
    grooved = False
    for wall in sorted(stack.walls, key=lambda w: wall_range(stack.axis, w)):
        if is_neck(wall, stack) or is_flank(wall, stack):
            grooved = True
            continue
        if not _is_step(wall, stack):
            if wall.kind is SurfaceKind.CONE:
                refuse("boss", wall.faces, "a cone this low breaks the edge of the cylinder beside it")
            continue
        near = 3 * tolerances.length
        alike = bool(steps) and SurfaceKind.CYLINDER is wall.kind is steps[-1][-1].kind
        over_groove = alike and grooved and abs(steps[-1][-1].radius - wall.radius) <= near
        if over_groove or (steps and _part_at_their_middle(stack.axis, steps[-1][-1], wall, near)):
            steps[-1].append(wall)
        else:
            steps.append([wall])
        grooved = False
    return [tuple(step) for step in steps]


def _part_at_their_middle(axis: Axis, low: Wall, high: Wall, near: float) -> bool:
    """Are they the two halves of one step with draft, which narrow away from the parting line where they meet?"""
    if not (low.kind is high.kind is SurfaceKind.CONE and _is_cylindrical(low) and _is_cylindrical(high)):
        return False
    radius = radius_at(axis, low, True)
    narrow = radius_at(axis, low, False) < radius > radius_at(axis, high, True)
    meet = abs(wall_range(axis, low)[1] - wall_range(axis, high)[0]) <= near
    return narrow and meet and abs(radius - radius_at(axis, high, False)) <= near


def _is_step(wall: Wall, stack: Stack) -> bool:
    """A cylinder is; a cone is unless it merely breaks the edge of a cylinder next to it, or cuts its corner.

    One that narrows on from another cone and leans more breaks the edge of that; one almost square to the axis is an
    end face with draft.
    """
    if wall.kind is SurfaceKind.CYLINDER:
        return True
    if wall.kind is not SurfaceKind.CONE or _is_end_face(wall):
        return False
    if any(_breaks_cone(stack.axis, wall, other) for other in stack.walls):
        return False
    cylinders = [w for w in stack.walls if w.kind is SurfaceKind.CYLINDER]
    low, high = wall_range(stack.axis, wall)
    near = 0.01 * wall.height
    # What is wider by far is not the cylinder whose edge it breaks, but the flange that a neck stands on.
    slim = [c for c in cylinders if c.radius <= WIDER * wall.radius]
    touching = [
        c for c in slim for a, b in (wall_range(stack.axis, c),) if abs(a - high) <= near or abs(b - low) <= near
    ]
    beside = touching or slim  # over a rounding nothing touches
    narrow = min(wall.radius_low, wall.radius_high)
    # A chamfer is narrower than what it breaks. One that only meets a cylinder as narrow fills the corner at its foot.
    fills = bool(touching) and all(c.radius <= narrow + near for c in touching)
    least = CORNER if fills else BROAD
    return all(wall.height > least * c.radius for c in beside)


def _breaks_cone(axis: Axis, wall: Wall, other: Wall) -> bool:
    """Is it the chamfer at the narrow end of another cone: low, and leaning more?"""
    if other.kind is not SurfaceKind.CONE or wall.height >= min(BREAK * other.radius, other.height):
        return False
    near = 0.01 * wall.height
    at_high = radius_at(axis, other, True) < radius_at(axis, other, False)
    end, begins = wall_range(axis, other)[at_high], wall_range(axis, wall)[not at_high]
    radius = radius_at(axis, wall, not at_high)
    meet = abs(end - begins) <= near and abs(radius_at(axis, other, at_high) - radius) <= near
    return meet and radius_at(axis, wall, at_high) < radius and _lean(wall) > _lean(other)


def _boss(
    brep: Brep,
    stack: Stack,
    steps: Sequence[tuple[Wall, ...]],
    step: tuple[Wall, ...],
    holes: Sequence[Hole],
    tolerances: Tolerances,
) -> Boss:
    axis, wall = stack.axis, step[0]
    tip_high = _tip_is_high(stack, wall)
    low, high = wall_range(axis, step[0])[0], wall_range(axis, step[-1])[1]
    faces = {face for part in step for face in part.faces}
    own = set(faces)
    breaks = []
    # Edge breaks next to the wall lengthen it to the shoulder or end face that they run into.
    for other in stack.walls:
        if any(other in members for members in steps) or is_neck(other, stack) or is_flank(other, stack):
            continue
        a, b = wall_range(axis, other)
        near = 3 * tolerances.length
        if abs(a - high) <= near or abs(b - low) <= near:
            at_high = abs(a - high) <= near
            own_end = radius_at(axis, step[-1] if at_high else step[0], at_high)
            begins = radius_at(axis, other, not at_high)
            if not begins / WIDER <= own_end <= begins * WIDER or _breaks_wider(axis, steps, other, at_high, near):
                continue  # it breaks the edge of the wider step that this one stands on
            low, high = (low, b) if at_high else (a, high)
            faces.update(other.faces)
            if other.kind is SurfaceKind.CONE and not _is_end_face(other):
                breaks.append(_break(axis, other, at_high))
    of_others = {face for members in steps for part in members for face in part.faces} - own
    low, high = _rounded(brep, axis, own, of_others, low, high, tolerances)
    low, high = before_jaws(brep, axis, step, _domed(brep, stack, low, high, faces), tolerances)
    oblique = oblique_ends(brep, axis, step)
    low, high = (low, high) if oblique is None else oblique[:2]
    tip, base = (axis.at(high), axis.at(low)) if tip_high else (axis.at(low), axis.at(high))
    for end in (tip, base) if stack.open_both else (tip,):
        end_face = _end_face(brep, axis, wall, axis.position(end), stack)
        if end_face is not None:
            faces.add(end_face)
    hole = hole_in(holes, axis, wall, tip, base)
    bore = None if hole is None else bore_in(holes[hole], axis, wall, low, high)
    bored = 0.0 if hole is None else length_bored(holes[hole], axis, low, high)
    if stack.open_both and high - low > SLENDER * 2 * wall.radius and bored <= HOLLOW * (high - low):
        bore = None  # a centre hole in its end makes no shaft hollow
    rim = inside_of_rim(brep, axis, wall, low, high) if hole is None else None
    bore = bore or rim
    tags = _tags(stack, steps, step, high - low, bore, bored, on_both=is_clasped(brep, axis, own))
    return Boss(
        base=base,
        tip=tip,
        normal=axis.direction if tip_high else scale(axis.direction, -1.0),
        radius=wall.radius,
        height=high - low,
        tags=_as_rim(tags) if rim is not None or (hole is not None and RIM in holes[hole].tags) else tags,
        faces=tuple(sorted(faces)),
        body=wall.body,
        hole=hole,
        bore_radius=None if bore is None else bore.radius,
        wall=None if bore is None else bore.wall,
        breaks=tuple(breaks),
        step_of=len(steps),
        lean=_lean(wall),
        pitch=next((part.pitch for part in step if part.pitch is not None), None),
        between_planes=None if oblique is None else oblique[2],
        is_broken_edge=end_of_corner_chamfer(brep, brep.faces[wall.faces[0]]) is not None,
    )


def _breaks_wider(axis: Axis, steps: Sequence[tuple[Wall, ...]], other: Wall, at_high: bool, near: float) -> bool:
    """Does a chamfer or rounding widen away from this step, up to the wall of another one that begins there?"""
    end, far = wall_range(axis, other)[at_high], radius_at(axis, other, at_high)
    return far > radius_at(axis, other, not at_high) + near and any(
        abs(wall_range(axis, wall)[not at_high] - end) <= near and abs(radius_at(axis, wall, not at_high) - far) <= near
        for step in steps
        for wall in step
    )


def _lean(wall: Wall) -> float:
    """The angle between a wall and its axis, radians."""
    return math.atan2(abs(wall.radius_high - wall.radius_low), wall.height)


def _as_rim(tags: Sequence[str]) -> tuple[str, ...]:
    """A rim has its thickness around its axis, however flat it is."""
    return (*(tag for tag in tags if tag != "flat"), RIM)


def _tags(
    stack: Stack,
    steps: Sequence[tuple[Wall, ...]],
    step: tuple[Wall, ...],
    height: float,
    bore: Bore | None,
    bored: float,
    *,
    on_both: bool,
) -> tuple[str, ...]:
    """Canonical attributes of the lexicon, from the step's own proportions and from its neighbours.

    `bored`: along how much of its height its bore runs, metres. `on_both`: something narrower stands on both of its end
    faces, whatever its outline.
    """
    radius = step[0].radius
    place = steps.index(step)
    free = stack.open_both
    ends = ((stack.low_end, 0), (stack.high_end, len(steps) - 1))
    undercut = any(end is End.CLOSED and place == last for end, last in ends)
    beside = [steps[i][0].radius for i in (place - 1, place + 1) if 0 <= i < len(steps)]
    shell = bore is not None and bore.lean > DRAFT_RAD and _lean(step[0]) > DRAFT_RAD  # however low, it is no disc
    flat = not shell and not reaches(height, FLAT * 2 * radius) and not goes_on(steps, place)
    tags = [*_form(step[0]), "circular"]
    if exceeds(height, SLENDER * 2 * radius):
        tags.append("slender")
    if flat:
        tags.append("flat")
    if any(part.pitch is not None for part in step):
        tags.append("threaded")
    if bore is not None:
        tags.append("hollow")
        straight = bore.lean <= DRAFT_RAD
        if straight and not flat and reaches(bore.radius, TUBE_RATIO * radius) and exceeds(bored, HOLLOW * height):
            tags.append("tube")
    if free:
        tags.append("free")
    if len(steps) > 1:
        tags.append("stepped")
    between = flat and undercut and any(other > ALIKE * radius for other in beside)
    if between:
        tags.append("undercut")
    elif not free or any(other > ALIKE * radius for other in beside):
        tags.append("raised")
    if flat and beside and exceeds(radius, FLANGE_RATIO * max(beside)):
        tags.append("flange")
    if flat and (on_both or is_collar(steps, place, hollow=bore is not None, undercut=undercut)):
        tags.append("collar")
    tags += ["land"] * (len(steps) > 2 and all(radius > ALIKE * other for other in beside))
    return tuple(tags)


def _is_cylindrical(wall: Wall) -> bool:
    """Is it a cylinder, or a cone that leans no more than a draft?"""
    return wall.kind is SurfaceKind.CYLINDER or (wall.kind is SurfaceKind.CONE and _lean(wall) <= DRAFT_RAD)


def _is_end_face(wall: Wall) -> bool:
    """Is it a cone so flat that it is the end face of a step, with draft?"""
    return wall.kind is SurfaceKind.CONE and _lean(wall) >= math.pi / 2 - DRAFT_RAD


def _form(wall: Wall) -> tuple[str, ...]:
    """Cylindrical, conical, or with draft both."""
    return ("cylindrical",) * _is_cylindrical(wall) + ("conical",) * (wall.kind is not SurfaceKind.CYLINDER)


def _break(axis: Axis, wall: Wall, at_high: bool) -> Section:
    """A chamfer at one end of a step: it starts at that end."""
    low, high = wall_range(axis, wall)
    start, end = (high, low) if at_high else (low, high)
    return Section(
        kind=SectionKind.CHAMFER,
        start=axis.at(start),
        end=axis.at(end),
        radius=radius_at(axis, wall, at_high),
        end_radius=radius_at(axis, wall, not at_high),
        normal=axis.direction if at_high else scale(axis.direction, -1.0),
        faces=wall.faces,
    )


def _rounded(
    brep: Brep,
    axis: Axis,
    own: Collection[int],
    of_others: Collection[int],
    low: float,
    high: float,
    tolerances: Tolerances,
) -> tuple[float, float]:
    """The step's range up to the planes that its fillet at the foot and its rounded or chamfered rim run into.

    `own` are its faces, `of_others` those of the other steps of its stack, which break no edge of it.
    """
    near = 3 * tolerances.length
    for face in own:
        for other in roundings_beside(brep, face):
            torus = brep.faces[other]
            if not axis.same_line(Axis.of(torus), tolerances):
                continue
            middle = axis.position(torus.origin)
            ends = [axis.position(brep.edges[e].mid) for e in brep.face_edges[other]]
            # On a cone the fillet begins a little beside the level of its middle.
            beside = near if brep.faces[face].kind is SurfaceKind.CYLINDER else LEANS * (max(ends) - min(ends))
            if min(ends) < low - near and abs(max(ends) - low) <= near and abs(middle - low) <= beside:
                low = min(ends)
            elif max(ends) > high + near and abs(min(ends) - high) <= near and abs(middle - high) <= beside:
                high = max(ends)
        for other in {beside for _, beside in brep.neighbours(face)}.difference(of_others):
            cone = brep.faces[other]
            if cone.kind is SurfaceKind.CONE and cone.outward > 0 and axis.same_line(Axis.of(cone), tolerances):
                mids = [brep.edges[e].mid for e in brep.face_edges[other]]
                ends, radius = [axis.position(mid) for mid in mids], brep.faces[face].radius
                narrows = max(map(axis.radius_of, mids)) <= radius + near
                if narrows and max(ends) - min(ends) < BREAK * radius:  # a chamfer, also one that notches part
                    low = min(ends) if abs(max(ends) - low) <= near else low
                    high = max(ends) if abs(min(ends) - high) <= near else high
    return low, high


def _domed(brep: Brep, stack: Stack, low: float, high: float, faces: set[int]) -> tuple[float, float]:
    """The step's range with the round caps on its ends, whose faces are added to `faces`."""
    for at_high in (False, True):
        if abs((stack.high if at_high else stack.low) - (high if at_high else low)) > 1e-3 * (high - low):
            continue
        for face_id in stack.beyond(at_high):
            face = brep.faces[face_id]
            on_axis = stack.axis.radius_of(face.origin) < 0.02 * max(face.radius, 1e-12)
            if face.kind is SurfaceKind.SPHERE and face.outward > 0 and on_axis:
                center = stack.axis.position(face.origin)
                if (center - high if at_high else low - center) > BALL * face.radius:
                    continue  # a ball of its own, as of a ball stud
                top = center + (face.radius if at_high else -face.radius)
                low, high = (low, max(high, top)) if at_high else (min(low, top), high)
                faces.add(face_id)
    return low, high


def _tip_is_high(stack: Stack, wall: Wall) -> bool:
    """Which end is free?

    The open one; with both open, a cone's narrow one; that away from the widest wall; else the end facing top, then
    front, then right.
    """
    if (stack.low_end is End.OPEN) != (stack.high_end is End.OPEN):
        return stack.high_end is End.OPEN
    if wall.kind is SurfaceKind.CONE:
        narrow, wide = (wall.low, wall.high) if wall.radius_low < wall.radius_high else (wall.high, wall.low)
        return stack.axis.position(wall.axis.at(narrow)) > stack.axis.position(wall.axis.at(wide))
    widest = max(stack.walls, key=lambda w: w.radius)
    if widest is not wall and widest.radius > 1.001 * wall.radius:
        return sum(wall_range(stack.axis, wall)) > sum(wall_range(stack.axis, widest))
    return points_up(stack.axis.direction)


def _end_face(brep: Brep, axis: Axis, wall: Wall, position: float, stack: Stack) -> int | None:
    """The plane that closes an end, where it is not wider than the step."""
    for face_id in {*stack.low_faces, *stack.high_faces, *stack.shoulders}:
        face = brep.faces[face_id]
        if face.kind is not SurfaceKind.PLANE or not parallel(face.axis, axis.direction, 1e-2):
            continue
        near = abs(axis.position(face.point) - position) <= 0.02 * max(wall.height, wall.radius)
        if near and axis.reach(face.box) <= 1.5 * wall.radius:
            return face_id
    return None
