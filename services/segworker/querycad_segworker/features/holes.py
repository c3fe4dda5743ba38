"""Holes: bores with whatever lies on their axis, from the mouth's chamfer to the drill point, each counted once."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import StrEnum

from querycad_contracts import SurfaceKind, Vector
from querycad_segworker.tolerances import Tolerances
from querycad_segworker.topology import Brep, EdgeConvexity
from querycad_segworker.vectors import dist, dot, foot, mid, parallel, scale, sub, unit

from .stacks import End, Stack, radius_at, stacks, wall_range
from .walls import Axis, Wall

CHAMFER_RATIO = 1.5
"""A cone at the mouth this much wider than its bore is a countersink, a narrower one a chamfer: heads of countersunk
screws are about twice as wide as their shank (ISO 10642), edge-breaking chamfers of bores at most some 10 to 30 %."""

SPOTFACE_RATIO = 0.25
"""A counterbore shallower than this share of its diameter only faces the surface: a screw head (ISO 4762) sinks in by
more than half of its diameter."""

THREAD_TURNS = 3
"""So many times must a bore alternate between two radii to be a modelled thread; fewer are grooves for snap rings."""

FORK_GAP = 2.0
"""Two bores of one radius on one axis, this many diameters apart or nearer with nothing between, are one hole drilled
through two walls: the gap of a fork head is about its pin's diameter (DIN 71752)."""

CORE_RATIO = 0.5
"""A boss inside the bore that fills more than this share of its depth leaves a ring: a groove, not a hole."""


class Bottom(StrEnum):
    """What a hole ends in."""

    THROUGH = "through"
    FLAT = "flat"
    CONICAL = "conical"
    SPHERICAL = "spherical"


@dataclass(frozen=True, slots=True)
class Hole:
    """One hole. Metres, frame of the file.

    `normal` points out of the opening; `far_opening` is the other opening of a through hole. `radius` is the bore's:
    the narrowest cylinder (or cone end). `steps` are the cylinders' radii from the opening inwards, neighbours of one
    radius counted once. `depth` runs from the opening to the bottom at full diameter: a drill point is not counted.
    """

    opening: Vector
    far_opening: Vector | None
    normal: Vector
    center: Vector
    radius: float
    opening_radius: float
    steps: tuple[float, ...]
    depth: float
    bottom: Bottom
    tags: tuple[str, ...]
    faces: tuple[int, ...]
    body: int
    core_radius: float | None = None
    """Of a boss that stands inside: the walls bound a ring-shaped groove."""

    @property
    def is_ring(self) -> bool:
        """Is it a ring-shaped groove rather than a hole?"""
        return self.core_radius is not None


IsClear = Callable[[Vector, Vector], bool]
"""Is the straight way between two points free of material?"""


def recognise_holes(
    brep: Brep, walls: Sequence[Wall], tolerances: Tolerances, is_clear: IsClear | None = None
) -> list[Hole]:
    """Which holes does the model have? Sorted by their lowest face id.

    A hole is a stack of concave coaxial walls that enclose their axis, of which one at least is a cylinder or cone,
    and which is open at one end at least. With `is_clear`, bores through the two walls of a fork become one hole.
    """
    found = []
    for stack in stacks(brep, walls, tolerances, lambda wall: wall.outward < 0 and wall.encloses):
        if all(wall.kind is SurfaceKind.TORUS for wall in stack.walls):
            continue
        if stack.low_end is End.CLOSED and stack.high_end is End.CLOSED:
            continue
        found.append(_hole(brep, stack, tolerances))
    if is_clear is not None:
        found = _united_through_walls(found, tolerances, is_clear)
    return sorted(found, key=lambda hole: hole.faces[0])


def _united_through_walls(holes: Sequence[Hole], tolerances: Tolerances, is_clear: IsClear) -> list[Hole]:
    """Bores drilled in one go through two walls with a gap between them, made one hole."""
    result = []
    for line in _by_line(holes, tolerances):
        axis = Axis(line[0].opening, line[0].normal)
        kept: list[Hole] = []
        for hole in sorted(line, key=lambda hole: axis.position(hole.center)):
            united = _united(kept[-1], hole, tolerances, is_clear) if kept else None
            kept[-1:] = [united] if united is not None else [*kept[-1:], hole]
        result.extend(kept)
    return result


def _by_line(holes: Sequence[Hole], tolerances: Tolerances) -> list[list[Hole]]:
    """Holes of one body and radius that lie on one line, together.

    The foot of one fixed point on the line is much the same for all of them: sorted by it, only few need comparing.
    """
    if not holes:
        return []
    keys = [dot(foot(holes[0].opening, hole.opening, hole.normal), _SWEEP) for hole in holes]
    order = sorted(range(len(holes)), key=lambda i: keys[i])
    groups, taken = [], set[int]()
    for rank, i in enumerate(order):
        if i in taken:
            continue
        first = holes[i]
        axis = Axis(first.opening, first.normal)
        group = [first]
        for j in order[rank + 1 :]:
            if keys[j] - keys[i] > _SWEEP_REACH * tolerances.length:
                break
            other = holes[j]
            alike = other.body == first.body and abs(other.radius - first.radius) <= 3 * tolerances.length
            if alike and j not in taken and axis.same_line(Axis(other.opening, other.normal), tolerances):
                taken.add(j)
                group.append(other)
        groups.append(group)
    return groups


_SWEEP = unit((0.8317, 0.4561, 0.3163))
"""Any direction that no common feature axis is at right angles to, so that different lines get different keys."""
_SWEEP_REACH = 1e3
"""How far apart, in length tolerances, the keys of one line may be: `Axis.same_line` forgives 0.3 degrees, which over
the length of the model is 5e-3 of it."""


def _united(a: Hole, b: Hole, tolerances: Tolerances, is_clear: IsClear) -> Hole | None:
    """One hole from two, or None when they are not two walls of one drilling."""
    axis = Axis(a.opening, a.normal)
    if a.body != b.body or not axis.same_line(Axis(b.opening, b.normal), tolerances):
        return None
    upper, lower = (a, b) if axis.position(a.center) > axis.position(b.center) else (b, a)
    ends = [
        (axis.position(p), p)
        for h in (upper, lower)
        for p in ((h.opening, h.far_opening) if h.far_opening else (h.opening,))
    ]
    inner_upper = min(((t, p) for t, p in ends[: 1 + (upper.far_opening is not None)]), key=lambda e: e[0])
    inner_lower = max(((t, p) for t, p in ends[1 + (upper.far_opening is not None) :]), key=lambda e: e[0])
    gap = inner_upper[0] - inner_lower[0]
    faces_inwards = _open_towards(upper, scale(axis.direction, -1.0)) and _open_towards(lower, axis.direction)
    if not faces_inwards or not 0 <= gap <= FORK_GAP * 2 * a.radius or not is_clear(inner_upper[1], inner_lower[1]):
        return None
    through = upper.far_opening is not None and lower.far_opening is not None
    outer, inner = (upper, lower) if upper.far_opening is not None else (lower, upper)
    if outer.opening_radius < inner.opening_radius and through:
        outer, inner = inner, outer
    out = axis.direction if outer is upper else scale(axis.direction, -1.0)
    opening = max((p for _, p in ends), key=lambda p: dot(p, out))
    end = (
        min((p for _, p in ends), key=lambda p: dot(p, out))
        if through
        else sub(inner.opening, scale(inner.normal, inner.depth))
    )
    return Hole(
        opening=opening,
        far_opening=end if through else None,
        normal=out,
        center=mid(opening, end),
        radius=a.radius,
        opening_radius=outer.opening_radius,
        steps=_steps(outer.steps + inner.steps, tolerances),
        depth=dist(opening, end),
        bottom=Bottom.THROUGH if through else inner.bottom,
        tags=tuple(
            dict.fromkeys(
                (*(t for t in outer.tags if t not in ("through", "blind")), "through" if through else "blind")
            )
        ),
        faces=tuple(sorted({*outer.faces, *inner.faces})),
        body=a.body,
    )


def _open_towards(hole: Hole, direction: Vector) -> bool:
    return dot(hole.normal, direction) > 0 or hole.far_opening is not None


def _hole(brep: Brep, stack: Stack, tolerances: Tolerances) -> Hole:
    axis = stack.axis
    through = stack.low_end is End.OPEN and stack.high_end is End.OPEN
    opens_high = _opens_high(stack) if through else stack.high_end is End.OPEN
    inwards = sorted(stack.walls, key=lambda w: wall_range(axis, w), reverse=opens_high)
    mouth = _mouth(brep, stack, opens_high)
    top = stack.high if opens_high else stack.low
    if mouth is not None:
        top = (max if opens_high else min)(top, mouth[1])
    point = _drill_point(stack, opens_high)
    bottom_wall = [w for w in inwards if w is not point] or inwards
    ends = [p for w in bottom_wall for p in wall_range(axis, w)]
    end = min(ends) if opens_high else max(ends)
    far = _mouth(brep, stack, not opens_high) if through else None
    if far is not None:
        end = (min if opens_high else max)(end, far[1])
    cylinders = [w for w in inwards if w.kind is SurfaceKind.CYLINDER]
    spotface = _spotface(cylinders)
    steps = _steps([w.radius for w in cylinders if w is not spotface], tolerances)
    threaded = _is_thread(steps, tolerances)
    if threaded:
        steps = (min(steps),)
    bore = min(
        (w.radius for w in cylinders), default=min(min(w.radius_low, w.radius_high) or w.radius for w in inwards)
    )
    floor = () if through else (stack.low_faces if opens_high else stack.high_faces)
    bottom = Bottom.THROUGH if through else _bottom(brep, floor, point)
    faces = {face for w in stack.walls for face in w.faces} | set(stack.shoulders) | set(mouth[0] if mouth else ())
    faces |= set(far[0] if far else ())
    faces |= {f for f in floor if _is_floor(brep, f, axis, bore if not cylinders else inwards[-1].radius)}
    normal = axis.direction if opens_high else scale(axis.direction, -1.0)
    return Hole(
        opening=axis.at(top),
        far_opening=axis.at(end) if through else None,
        normal=normal,
        center=axis.at((top + end) / 2),
        radius=bore,
        opening_radius=mouth[2] if mouth else radius_at(axis, inwards[0], opens_high),
        steps=steps,
        depth=abs(top - end),
        bottom=bottom,
        tags=_tags(inwards, axis, opens_high, through, steps)
        + (("spotfaced",) if spotface else ())
        + (("threaded",) if threaded else ())
        + (("rounded",) if mouth is not None else ()),
        faces=tuple(sorted(faces)),
        body=stack.walls[0].body,
        core_radius=None if through else _core_radius(brep, floor, axis, end, abs(top - end)),
    )


def _opens_high(stack: Stack) -> bool:
    """Which of a through hole's two ends is the opening?

    The wider one; of two alike the one facing top, then front, then right, however the axis was stored.
    """
    ordered = sorted(stack.walls, key=lambda w: wall_range(stack.axis, w))
    low, high = radius_at(stack.axis, ordered[0], False), radius_at(stack.axis, ordered[-1], True)
    if abs(high - low) > 1e-3 * max(high, low):
        return high > low
    x, y, z = stack.axis.direction
    for component in (z, -y, x):
        if abs(component) > 0.05:
            return component > 0
    return True


def _mouth(brep: Brep, stack: Stack, high: bool) -> tuple[tuple[int, ...], float, float] | None:
    """A rounding between the wall and the outer face: (faces, position of its outer rim, radius there)."""
    faces, positions, radii = [], [], []
    for face_id in stack.high_faces if high else stack.low_faces:
        face = brep.faces[face_id]
        coaxial = parallel(face.axis, stack.axis.direction, 1e-2) and stack.axis.radius_of(face.origin) < 1e-2 * max(
            face.radius, 1e-9
        )
        if face.kind is SurfaceKind.TORUS and face.outward > 0 and coaxial:
            faces.append(face_id)
            for e in brep.face_edges[face_id]:
                positions.append(stack.axis.position(brep.edges[e].mid))
                radii.append(stack.axis.radius_of(brep.edges[e].mid))
    if not faces:
        return None
    return tuple(faces), (max if high else min)(positions), max(radii)


def _drill_point(stack: Stack, opens_high: bool) -> Wall | None:
    """The cone that runs to a point at the closed end."""
    inner = min(
        stack.walls, key=lambda w: wall_range(stack.axis, w)[0 if opens_high else 1] * (1 if opens_high else -1)
    )
    if inner.kind is SurfaceKind.CONE and radius_at(stack.axis, inner, not opens_high) <= 0.05 * inner.radius:
        return inner if len(stack.walls) > 1 else None
    return None


def _bottom(brep: Brep, floor: Sequence[int], point: Wall | None) -> Bottom:
    if point is not None:
        return Bottom.CONICAL
    kinds = [brep.faces[face].kind for face in floor]
    if SurfaceKind.SPHERE in kinds:
        return Bottom.SPHERICAL
    if SurfaceKind.CONE in kinds:
        return Bottom.CONICAL
    return Bottom.FLAT


def _is_floor(brep: Brep, face_id: int, axis: Axis, radius: float) -> bool:
    """Does the face close this hole, rather than being a larger face that the hole only ends at?"""
    (x0, y0, z0), (x1, y1, z1) = brep.faces[face_id].box
    corners = [(x, y, z) for x in (x0, x1) for y in (y0, y1) for z in (z0, z1)]
    return max(axis.radius_of(c) for c in corners) <= 1.8 * radius


def _core_radius(brep: Brep, floor: Sequence[int], axis: Axis, end: float, depth: float) -> float | None:
    """The radius of a coaxial boss that rises from the floor, if there is one."""
    for face_id in floor:
        for edge, other in brep.neighbours(face_id):
            face = brep.faces[other]
            if edge.convexity is not EdgeConvexity.CONCAVE or face.outward <= 0:
                continue
            if not parallel(face.axis, axis.direction, 1e-2) or axis.radius_of(face.origin) > 1e-2 * face.radius:
                continue
            reach = [abs(axis.position(brep.edges[e].mid) - end) for e in brep.face_edges[other]]
            if max(reach) >= CORE_RATIO * depth:
                return face.radius
    return None


def _spotface(cylinders: Sequence[Wall]) -> Wall | None:
    """The shallow wide first step that only faces the surface around the bore."""
    if len(cylinders) < 2:
        return None
    first, second = cylinders[0], cylinders[1]
    return first if first.radius > second.radius and first.height < SPOTFACE_RATIO * 2 * first.radius else None


def _is_thread(steps: Sequence[float], tolerances: Tolerances) -> bool:
    """Does the bore alternate between two radii, as a thread does that is modelled by rings?"""
    near = 3 * tolerances.length
    small, large = min(steps, default=0.0), max(steps, default=0.0)
    two_radii = all(abs(r - small) <= near or abs(r - large) <= near for r in steps)
    return two_radii and len(steps) > 2 * THREAD_TURNS and large < 1.5 * small


def _steps(radii: Sequence[float], tolerances: Tolerances) -> tuple[float, ...]:
    steps: list[float] = []
    for radius in radii:
        if not steps or abs(steps[-1] - radius) > 3 * tolerances.length:
            steps.append(radius)
    return tuple(steps)


def _tags(
    inwards: Sequence[Wall], axis: Axis, opens_high: bool, through: bool, steps: Sequence[float]
) -> tuple[str, ...]:
    """Canonical attributes of the lexicon, from the order and shape of the walls."""
    tags = ["through" if through else "blind", "circular"]
    cylinders = [w for w in inwards if w.kind is SurfaceKind.CYLINDER]
    if not cylinders:
        tags.append("conical")
    if len(steps) > 1:
        tags.extend(("stepped", "counterbored") if steps[0] > steps[1] else ("stepped",))
    for wall in inwards:
        if wall.kind is not SurfaceKind.CONE or not cylinders:
            continue
        wide = radius_at(axis, wall, opens_high)
        narrow = radius_at(axis, wall, not opens_high)
        if wide > narrow > 0.05 * wide:
            tags.extend(("countersunk", "beveled") if wide >= CHAMFER_RATIO * narrow else ("chamfered", "beveled"))
        elif narrow > wide and through:
            tags.extend(("chamfered", "beveled"))
    return tuple(dict.fromkeys(tags))
