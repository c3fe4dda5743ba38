"""A spur gear on its shaft: involute teeth, lightening holes, stepped journals, keyway, ring groove, centre holes."""

from __future__ import annotations

from dataclasses import dataclass
from math import acos, cos, pi, sin, sqrt, tan

from build123d import (
    Align,
    BuildPart,
    BuildSketch,
    Circle,
    CounterSinkHole,
    Cylinder,
    Edge,
    Face,
    GeomType,
    Line,
    Locations,
    Mode,
    Part,
    Plane,
    PolarLocations,
    ShapeList,
    SlotOverall,
    Spline,
    ThreePointArc,
    Wire,
    chamfer,
    extrude,
    fillet,
    insert,
)

from _example import count, length, lengths, publish, size

FLANK_POINTS = 7  # a cubic spline through them stays within a micrometre of the involute


@dataclass(frozen=True, slots=True)
class GearShaft:
    """Millimetres and degrees; the axis is x, the shaft's drive end at x = 0."""

    module: float = 3
    teeth: int = 24
    pressure_angle: float = 20
    face_width: float = 26
    tip_chamfer: float = 0.5
    holes: int = 6
    hole: float = 9
    hole_circle: float = 48.5
    drive: float = 22
    drive_length: float = 42
    shoulder: float = 28
    shoulder_length: float = 16
    tail: float = 20
    tail_length: float = 34
    step_fillet: float = 1
    end_chamfer: float = 1
    key_width: float = 6
    key_depth: float = 3.5
    key_length: float = 28
    key_start: float = 7
    ring_width: float = 1.3
    ring_diameter: float = 19
    ring_from_end: float = 6
    center_hole: float = 4
    center_depth: float = 9
    center_countersink: float = 8.5

    @property
    def pitch_diameter(self) -> float:
        """Where two gears roll on one another (ISO 53)."""
        return self.module * self.teeth

    @property
    def tip_diameter(self) -> float:
        """One module above the pitch circle."""
        return self.pitch_diameter + 2 * self.module

    @property
    def root_diameter(self) -> float:
        """1.25 modules below the pitch circle."""
        return self.pitch_diameter - 2.5 * self.module

    @property
    def gear_start(self) -> float:
        """Where the gear begins along x."""
        return self.drive_length + self.shoulder_length

    @property
    def length(self) -> float:
        """Overall."""
        return self.gear_start + self.face_width + self.shoulder_length + self.tail_length


def involute(base: float, radius: float) -> float:
    """Which angle has the involute of a base circle swept where it reaches `radius`?"""
    pressure = acos(base / radius)
    return tan(pressure) - pressure


def tooth_edges(p: GearShaft, index: int) -> list[Edge]:
    """The root arc before a tooth, its flanks and its tip, in the XY plane, ready to close into the gear's outline."""
    base = p.pitch_diameter / 2 * cos(p.pressure_angle * pi / 180)
    root, tip = p.root_diameter / 2, p.tip_diameter / 2
    start = max(base, root)
    half = pi / (2 * p.teeth) + involute(base, p.pitch_diameter / 2)

    def polar(radius: float, angle: float) -> tuple[float, float]:
        turned = angle + 2 * pi * index / p.teeth
        return radius * cos(turned), radius * sin(turned)

    # evenly in the roll angle, in which the involute is smooth down to its base circle
    rolls = [sqrt((radius / base) ** 2 - 1) for radius in (start, tip)]
    steps = [rolls[0] + (rolls[1] - rolls[0]) * k / (FLANK_POINTS - 1) for k in range(FLANK_POINTS)]
    radii = [base * sqrt(1 + roll**2) for roll in steps]
    rising = [polar(radius, -half + involute(base, radius)) for radius in radii]
    falling = [polar(radius, half - involute(base, radius)) for radius in reversed(radii)]
    gap = -2 * pi / p.teeth + half  # where the root arc starts, behind the tooth before
    edges: list[Edge] = [ThreePointArc(polar(root, gap), polar(root, (gap - half) / 2), polar(root, -half))]
    if start > root:
        edges.append(Line(polar(root, -half), rising[0]))
    edges += [Spline(*rising), ThreePointArc(rising[-1], polar(tip, 0), falling[0]), Spline(*falling)]
    if start > root:
        edges.append(Line(falling[-1], polar(root, half)))
    return edges


def build(p: GearShaft) -> Part:
    """Extrudes the gear, stacks the journals, cuts keyway, groove, holes."""
    along = (Align.CENTER, Align.CENTER, Align.MIN)
    outline = Wire([edge for index in range(p.teeth) for edge in tooth_edges(p, index)])
    steps = [
        (p.drive, p.drive_length),
        (p.shoulder, p.shoulder_length + p.face_width + p.shoulder_length),
        (p.tail, p.tail_length),
    ]
    with BuildPart() as part:
        with BuildSketch(Plane.YZ.offset(p.gear_start)):
            insert(Face(outline))
            with PolarLocations(p.hole_circle / 2, p.holes):
                Circle(p.hole / 2, mode=Mode.SUBTRACT)
        extrude(amount=p.face_width)
        start = 0.0
        for diameter, length_mm in steps:
            with Locations(Plane.YZ.offset(start)):
                Cylinder(diameter / 2, length_mm, align=along)
            start += length_mm
        fillet(
            _circles(part, p.drive, p.drive_length) + _circles(part, p.tail, p.length - p.tail_length), p.step_fillet
        )
        chamfer(_circles(part, p.drive, 0) + _circles(part, p.tail, p.length), p.end_chamfer)
        gear_end = p.gear_start + p.face_width
        chamfer(_circles(part, p.tip_diameter, p.gear_start) + _circles(part, p.tip_diameter, gear_end), p.tip_chamfer)
        middle = p.key_start + p.key_length / 2
        with BuildSketch(Plane.XY.offset(p.drive / 2)), Locations((middle, 0)):
            SlotOverall(p.key_length, p.key_width)
        extrude(amount=-p.key_depth, mode=Mode.SUBTRACT)
        ring = p.length - p.ring_from_end - p.ring_width
        with BuildSketch(Plane.YZ.offset(ring)):
            Circle(p.tail / 2 + 1)
            Circle(p.ring_diameter / 2, mode=Mode.SUBTRACT)
        extrude(amount=p.ring_width, mode=Mode.SUBTRACT)
        with Locations(Plane.YZ.rotated((0, 180, 0)), Plane.YZ.offset(p.length)):
            CounterSinkHole(p.center_hole / 2, p.center_countersink / 2, depth=p.center_depth, counter_sink_angle=60)
    return part.part


def _circles(part: BuildPart, diameter: float, x: float) -> ShapeList[Edge]:
    return part.edges().filter_by(
        lambda e: (
            e.geom_type == GeomType.CIRCLE and abs(e.radius - diameter / 2) < 1e-6 and abs(e.arc_center.X - x) < 1e-6
        )
    )


def main() -> None:
    """Writes the model and its questions."""
    p = GearShaft()
    publish(
        "gear_shaft",
        build(p),
        [
            count("How many teeth has the gear?", p.teeth),
            count("How many keyways are there?", 1),
            lengths("What is the diameter of the through holes?", [p.hole] * p.holes),
            length("What is the outer diameter of the gear?", p.tip_diameter),
            length("What is the width of the keyway?", p.key_width),
            length("What is the length of the keyway?", p.key_length),
            length("What is the width of the gear?", p.face_width),
            length("How long is the object?", p.length),
            size("What is the size of the object?", (p.length, p.tip_diameter, p.tip_diameter)),
        ],
    )


if __name__ == "__main__":
    main()
