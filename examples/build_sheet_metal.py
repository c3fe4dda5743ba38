"""A bent sheet-metal part: a U with one outward lip, 2 mm thick, with holes, obround slots and a cable cut-out."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import (
    Axis,
    BuildLine,
    BuildPart,
    BuildSketch,
    Circle,
    GridLocations,
    Locations,
    Mode,
    Part,
    Plane,
    Polyline,
    RectangleRounded,
    SlotOverall,
    Vertex,
    extrude,
    fillet,
    make_face,
)

from _example import count, length, lengths, publish, size


@dataclass(frozen=True, slots=True)
class Sheet:
    """Millimetres; the web lies on z = 0, bends run along y, the lip points to +x."""

    thickness: float = 2
    bend: float = 2.5
    width: float = 110
    depth: float = 70
    left_height: float = 45
    right_height: float = 32
    lip: float = 20
    corner: float = 5
    foot_holes: int = 4
    foot_hole: float = 4.5
    foot_span: float = 78
    foot_reach: float = 50
    slots: int = 2
    slot_length: float = 24
    slot_width: float = 6.4
    slot_spacing: float = 26
    bushing_hole: float = 16
    rivet_holes: int = 2
    rivet_hole: float = 3.2
    rivet_span: float = 46
    lip_holes: int = 3
    lip_hole: float = 5.5
    lip_span: float = 24
    window_length: float = 34
    window_height: float = 12
    window_corner: float = 2


def build(p: Sheet) -> Part:
    """Extrudes the bent strip along y, rounds its free corners, cuts the openings through each leg."""
    left, right, t = -p.width / 2, p.width / 2, p.thickness
    below, above = p.right_height - t, p.right_height
    outside = [(left, 0.0), (right, 0.0), (right - t, above)]
    inside = [(left + t, t), (right - t, t), (right, below)]
    end = right + p.lip
    outline = [(left, p.left_height), *outside[:2], inside[2], (end, below), (end, above), outside[2]]
    outline += [inside[1], inside[0], (left + t, p.left_height)]
    with BuildPart() as part:
        with BuildSketch(Plane.XZ.offset(-p.depth / 2)) as section:
            with BuildLine():
                Polyline(*outline, close=True)
            make_face()
            for bends, radius in ((outside, p.bend + t), (inside, p.bend)):
                fillet([v for v in section.vertices() if _near(v, bends)], radius)
        extrude(amount=p.depth)
        ends = part.edges().filter_by(Axis.X)
        fillet(ends.group_by(Axis.Z)[-1] + part.edges().filter_by(Axis.Z).group_by(Axis.X)[-1], p.corner)

        with BuildSketch(Plane.XY):
            with GridLocations(p.foot_span, p.foot_reach, 2, p.foot_holes // 2):
                Circle(p.foot_hole / 2)
            with GridLocations(p.slot_spacing, 0, p.slots, 1):
                SlotOverall(p.slot_length, p.slot_width, rotation=90)
        extrude(amount=t, mode=Mode.SUBTRACT)
        with BuildSketch(Plane.YZ.offset(left)), Locations((0, p.left_height / 2)):
            Circle(p.bushing_hole / 2)
            with GridLocations(p.rivet_span, 0, p.rivet_holes, 1):
                Circle(p.rivet_hole / 2)
        extrude(amount=t, mode=Mode.SUBTRACT)
        with BuildSketch(Plane.YZ.offset(right)), Locations((0, p.right_height / 2)):
            RectangleRounded(p.window_length, p.window_height, p.window_corner)
        extrude(amount=-t, mode=Mode.SUBTRACT)
        lip = Locations((right + p.lip / 2 + 2, 0))
        with BuildSketch(Plane.XY.offset(above)), lip, GridLocations(0, p.lip_span, 1, p.lip_holes):
            Circle(p.lip_hole / 2)
        extrude(amount=-t, mode=Mode.SUBTRACT)
    return part.part


def _near(vertex: Vertex, points: list[tuple[float, float]]) -> bool:
    return any(abs(vertex.X - x) + abs(vertex.Y - y) < 1e-6 for x, y in points)


def main() -> None:
    """Writes the model and its questions."""
    p = Sheet()
    vertical = [p.foot_hole] * p.foot_holes + [p.lip_hole] * p.lip_holes
    publish(
        "sheet_metal",
        build(p),
        [
            length("What is the thickness of the sheet metal?", p.thickness),
            count("How many slots are there?", p.slots),
            count("How many round holes are visible from the top?", p.foot_holes + p.lip_holes),
            lengths("What is the diameter of the round holes visible from the top?", vertical),
            count("How many round holes are visible from the left?", p.rivet_holes + 1),
            length("What is the diameter of the largest hole visible from the left?", p.bushing_hole),
            lengths("What is the width of the slots?", [p.slot_width] * p.slots),
            lengths("What is the length of the slots?", [p.slot_length] * p.slots),
            length("What is the height of the object?", p.left_height),
            size("What is the size of the object?", (p.width + p.lip, p.depth, p.left_height)),
        ],
    )


if __name__ == "__main__":
    main()
