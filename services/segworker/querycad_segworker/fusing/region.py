"""What is a part that has no name in geometry? Some faces, with the measures that faces alone tell."""

from __future__ import annotations

from collections.abc import Sequence

from querycad_contracts import Evidence, Face, Part, Side, SurfaceKind, Vector

PREFIX = "faces-"
SAME_RADIUS = 1e-3
"""Cylinders whose radii differ by less than this share are one cylinder in pieces."""


def region(phrase: str, faces: Sequence[Face], sides: tuple[Side, ...] = ()) -> Part:
    """Which part do these faces make? At least one face. Its id tells them, so that any process can make it again."""
    low = [min(face.center[i] - face.extents[i] / 2 for face in faces) for i in range(3)]
    high = [max(face.center[i] + face.extents[i] / 2 for face in faces) for i in range(3)]
    planes = [face for face in faces if face.kind is SurfaceKind.PLANE]
    cylinders = [face for face in faces if face.kind is SurfaceKind.CYLINDER and face.radius]
    radii = [face.radius for face in cylinders if face.radius is not None]
    round_ = bool(radii) and max(radii) - min(radii) <= SAME_RADIUS * max(radii)
    return Part(
        id=region_id([face.id for face in faces]),
        kind="region",
        label=f"{phrase}, {len(faces)} face{'s' if len(faces) > 1 else ''}",
        faces=tuple(sorted(face.id for face in faces)),
        sides=sides,
        center=_vector([(a + b) / 2 for a, b in zip(low, high, strict=True)]),
        extents=_vector([b - a for a, b in zip(low, high, strict=True)]),
        axis=cylinders[0].axis if round_ else None,
        normal=planes[0].normal if len(planes) == 1 else None,
        radius=radii[0] if round_ else None,
        diameter=2 * radii[0] if round_ else None,
        area=sum(face.area for face in faces),
        evidence=Evidence(source="vision", confidence=0.0, reason="seen in a picture"),
    )


def region_id(faces: Sequence[int]) -> str:
    """Which id has the part made of these faces? Such as 'faces-3:5+12' for 3, 4, 5 and 12."""
    runs: list[list[int]] = []
    for face in sorted(faces):
        if runs and face == runs[-1][1] + 1:
            runs[-1][1] = face
        else:
            runs.append([face, face])
    return PREFIX + "+".join(f"{first}:{last}" if last > first else f"{first}" for first, last in runs)


def faces_of_id(part: str) -> tuple[int, ...] | None:
    """Which faces does this id tell? None when it is no such id."""
    if not part.startswith(PREFIX):
        return None
    faces: list[int] = []
    for run in part.removeprefix(PREFIX).split("+"):
        first, _, last = run.partition(":")
        if not (first.isdecimal() and (last.isdecimal() or run == first)):
            return None
        faces.extend(range(int(first), int(last or first) + 1))
    return tuple(faces)


def _vector(values: Sequence[float]) -> Vector:
    x, y, z = values
    return (x, y, z)
