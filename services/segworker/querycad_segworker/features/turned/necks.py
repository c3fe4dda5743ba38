"""Bottoms and flanks of grooves that are turned into a shaft: walls that are no steps of it."""

from __future__ import annotations

from querycad_contracts import SurfaceKind
from querycad_segworker.features.shared.coaxial_stacks import Stack, radius_at, wall_range
from querycad_segworker.features.shared.shaft_steps import FLANGE_RATIO
from querycad_segworker.features.shared.walls import Wall


def is_neck(wall: Wall, stack: Stack) -> bool:
    """Is it the bottom of a groove turned into a shaft: narrower than its diameter, between wider walls, or hollow?

    A groove's width counts with its leaning flanks, as `recognise_turned_grooves` counts it.
    The drum of a spool is none: longer than both flanges together, which are wider by more than flanges are.
    """
    if wall.kind is SurfaceKind.TORUS and wall.outward < 0:
        return True
    low, high = wall_range(stack.axis, wall)
    if wall.height + sum(flank.height for flank in _cones_from(wall, stack)) >= 2 * wall.radius:
        return False
    below = [w for w in stack.walls if w is not wall and wall_range(stack.axis, w)[1] <= low + 0.01 * wall.height]
    above = [w for w in stack.walls if w is not wall and wall_range(stack.axis, w)[0] >= high - 0.01 * wall.height]
    if not below or not above:
        return False
    beside = below[-1], above[0]
    narrower = min(w.radius for w in beside)
    if wall.height > sum(w.height for w in beside) and narrower > FLANGE_RATIO * wall.radius:
        return False
    return narrower > 1.001 * wall.radius


def _cones_from(wall: Wall, stack: Stack) -> list[Wall]:
    """The cones that lead from the ends of a wall up to something wider."""
    near = 0.01 * wall.height
    found = []
    for cone in stack.walls:
        for at_high in (False, True):
            end, begins = wall_range(stack.axis, wall)[at_high], wall_range(stack.axis, cone)[not at_high]
            radii = [
                radius_at(stack.axis, w, high) for w, high in ((wall, at_high), (cone, not at_high), (cone, at_high))
            ]
            meet = abs(end - begins) <= near and abs(radii[1] - radii[0]) <= near
            if cone.kind is SurfaceKind.CONE and meet and radii[2] > radii[1]:
                found.append(cone)
    return found


def is_flank(wall: Wall, stack: Stack) -> bool:
    """Is it one of two cones that meet at the bottom of a V, turned into a cylinder on both sides of them?"""
    if wall.kind is not SurfaceKind.CONE:
        return False
    low, high = wall_range(stack.axis, wall)
    near = 0.01 * wall.height
    narrow_high = radius_at(stack.axis, wall, True) < radius_at(stack.axis, wall, False)
    for other in stack.walls:
        if other is wall or other.kind is not SurfaceKind.CONE:
            continue
        a, b = wall_range(stack.axis, other)
        bottom, there = (high, a) if narrow_high else (low, b)
        radius = radius_at(stack.axis, wall, narrow_high)
        meet = abs(bottom - there) <= near and abs(radius_at(stack.axis, other, not narrow_high) - radius) <= near
        if meet and radius_at(stack.axis, other, narrow_high) > radius + near:
            ends = sorted((low, high, a, b))
            cylinders = [wall_range(stack.axis, w) for w in stack.walls if w.kind is SurfaceKind.CYLINDER]
            below = any(abs(top - ends[0]) <= near for _, top in cylinders)
            return below and any(abs(foot - ends[-1]) <= near for foot, _ in cylinders)
    return False
