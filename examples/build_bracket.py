"""An angle bracket: slots and countersunk holes in the foot, a bearing seat with threads in the wall, two gussets."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import (
    Align,
    Axis,
    Box,
    BuildLine,
    BuildPart,
    BuildSketch,
    CounterSinkHole,
    Cylinder,
    Edge,
    GeomType,
    GridLocations,
    Hole,
    Locations,
    Mode,
    Part,
    Plane,
    PolarLocations,
    Polyline,
    SlotOverall,
    chamfer,
    extrude,
    fillet,
    make_face,
)

from _example import count, length, lengths, point, publish, size


@dataclass(frozen=True, slots=True)
class Bracket:
    """Millimetres; the foot lies on z = 0, the wall stands at the back (largest y), x runs along the wall."""

    width: float = 120
    depth: float = 90
    height: float = 105
    plate: float = 12
    corner: float = 10
    inner_fillet: float = 6
    gusset: float = 8
    gusset_reach: float = 48
    gusset_spacing: float = 88
    slots: int = 2
    slot_width: float = 9
    slot_length: float = 22
    slot_spacing: float = 56
    slot_setback: float = 20
    screw_hole: float = 5.5
    countersink: float = 11.2
    screws: int = 4
    screw_spacing: float = 32
    screw_rows: float = 24
    seat: float = 32
    seat_height: float = 68
    seat_boss: float = 62
    seat_boss_height: float = 6
    seat_chamfer: float = 1
    threads: int = 6
    thread_hole: float = 5  # tap drill of M6
    thread_circle: float = 47

    @property
    def wall_front(self) -> float:
        """Where the wall's front face lies along y; the foot starts at y = 0."""
        return self.depth - self.plate


def build(p: Bracket) -> Part:
    """Extrudes the angle, adds gussets and the seat's boss, drills."""
    low = (Align.CENTER, Align.MIN, Align.MIN)
    with BuildPart() as part:
        Box(p.width, p.depth, p.plate, align=low)
        with Locations((0, p.wall_front, 0)):
            Box(p.width, p.plate, p.height, align=low)
        corners = (
            part.edges().filter_by(Axis.Y).group_by(Axis.Z)[-1] + part.edges().filter_by(Axis.Z).group_by(Axis.Y)[0]
        )
        fillet(corners, p.corner)
        root = part.edges().filter_by(Axis.X).filter_by_position(Axis.Y, p.wall_front - 0.1, p.wall_front + 0.1)
        fillet(root.filter_by_position(Axis.Z, p.plate - 0.1, p.plate + 0.1), p.inner_fillet)
        for side in (-1, 1):
            with BuildSketch(Plane.YZ.offset(side * p.gusset_spacing / 2)):
                with BuildLine():
                    y, z, reach = p.wall_front, p.plate, p.gusset_reach
                    Polyline((y, z), (y - reach, z), (y - reach, z + 4), (y - 4, z + reach), (y, z + reach), close=True)
                make_face()
            extrude(amount=p.gusset / 2, both=True)
        wall = Plane((0, p.wall_front, p.seat_height), x_dir=(1, 0, 0), z_dir=(0, -1, 0))
        with Locations(wall):
            Cylinder(p.seat_boss / 2, p.seat_boss_height, align=(Align.CENTER, Align.CENTER, Align.MIN))
        with Locations(wall.offset(p.seat_boss_height)):
            Hole(p.seat / 2)
            with PolarLocations(p.thread_circle / 2, p.threads):
                Hole(p.thread_hole / 2)
        mouth = part.edges().filter_by(lambda e: _is_circle_at(e, p.seat / 2, p.wall_front - p.seat_boss_height))
        chamfer(mouth, p.seat_chamfer)
        with BuildSketch(Plane.XY), Locations((0, p.slot_setback)), GridLocations(p.slot_spacing, 0, p.slots, 1):
            SlotOverall(p.slot_length, p.slot_width)
        extrude(amount=p.plate, mode=Mode.SUBTRACT)
        with (
            Locations((0, (p.slot_setback + p.wall_front) / 2, p.plate)),
            GridLocations(p.screw_spacing, p.screw_rows, 2, p.screws // 2),
        ):
            CounterSinkHole(p.screw_hole / 2, p.countersink / 2, counter_sink_angle=90)
    return part.part


def _is_circle_at(edge: Edge, radius: float, y: float) -> bool:
    return bool(
        edge.geom_type == GeomType.CIRCLE and abs(edge.radius - radius) < 1e-6 and abs(edge.arc_center.Y - y) < 1e-6
    )


def main() -> None:
    """Writes the model and its questions."""
    p = Bracket()
    seat_depth = p.plate + p.seat_boss_height
    publish(
        "bracket",
        build(p),
        [
            count("How many slots are there?", p.slots),
            count("How many countersunk holes has the bracket?", p.screws),
            count("How many holes are visible from the front?", p.threads + 1),
            length("What is the diameter of the largest hole?", p.seat),
            lengths("What is the diameter of the countersunk holes?", [p.screw_hole] * p.screws),
            lengths("What is the width of the slots?", [p.slot_width] * p.slots),
            lengths("What is the length of the slots?", [p.slot_length] * p.slots),
            length("How deep is the largest hole?", seat_depth),
            point("Where is the center of the largest hole?", (0, p.depth - seat_depth / 2, p.seat_height)),
            size("What is the size of the bracket?", (p.width, p.depth, p.height)),
        ],
    )


if __name__ == "__main__":
    main()
