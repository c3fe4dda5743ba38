"""A weld-neck flange: counterbored bolt circle, jacking screws, raised face with an O-ring groove."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import (
    Axis,
    BuildLine,
    BuildPart,
    BuildSketch,
    CounterBoreHole,
    GeomType,
    Hole,
    Locations,
    Mode,
    Part,
    Plane,
    PolarLocations,
    Polyline,
    Rectangle,
    chamfer,
    fillet,
    make_face,
    revolve,
)

from _example import count, length, lengths, point, publish, size


@dataclass(frozen=True, slots=True)
class Flange:
    """Millimetres; the axis is z, the plate's underside lies at z = 0."""

    diameter: float = 170
    thickness: float = 22
    face_diameter: float = 104
    face_height: float = 3
    bore: float = 54
    neck_base: float = 92
    neck_end: float = 66
    neck_length: float = 28
    neck_fillet: float = 6
    bolts: int = 8
    bolt_circle: float = 134
    bolt_hole: float = 16
    counterbore: float = 26
    counterbore_depth: float = 8
    jacks: int = 2
    jack_hole: float = 8.5  # tap drill of M10
    groove_inner: float = 72
    groove_width: float = 4.2
    groove_depth: float = 2.6
    edge: float = 1.5

    @property
    def top(self) -> float:
        """Height of the raised face."""
        return self.thickness + self.face_height


def build(p: Flange) -> Part:
    """Revolves the section, cuts the groove, drills."""
    with BuildPart() as part:
        with BuildSketch(Plane.XZ):
            with BuildLine():
                Polyline(
                    (p.bore / 2, -p.neck_length),
                    (p.neck_end / 2, -p.neck_length),
                    (p.neck_base / 2, 0),
                    (p.diameter / 2, 0),
                    (p.diameter / 2, p.thickness),
                    (p.face_diameter / 2, p.thickness),
                    (p.face_diameter / 2, p.top),
                    (p.bore / 2, p.top),
                    close=True,
                )
            make_face()
        revolve(axis=Axis.Z)
        rims = part.edges().filter_by(GeomType.CIRCLE).filter_by(lambda e: abs(e.radius - p.diameter / 2) < 1e-6)
        chamfer(rims, p.edge)
        neck = part.edges().filter_by(GeomType.CIRCLE).filter_by(lambda e: abs(e.radius - p.neck_base / 2) < 1e-6)
        fillet(neck, p.neck_fillet)
        with BuildSketch(Plane.XZ), Locations(((p.groove_inner + p.groove_width) / 2, p.top - p.groove_depth / 2)):
            Rectangle(p.groove_width, p.groove_depth)
        revolve(axis=Axis.Z, mode=Mode.SUBTRACT)
        with Locations((0, 0, p.thickness)):
            with PolarLocations(p.bolt_circle / 2, p.bolts):
                CounterBoreHole(p.bolt_hole / 2, p.counterbore / 2, p.counterbore_depth)
            with PolarLocations(p.bolt_circle / 2, p.jacks, start_angle=180 / p.bolts):
                Hole(p.jack_hole / 2)
    return part.part


def main() -> None:
    """Writes the model and its questions."""
    p = Flange()
    publish(
        "flange",
        build(p),
        [
            count("How many counterbored holes are there?", p.bolts),
            count("How many holes are visible from the top?", p.bolts + p.jacks + 1),
            length("What is the diameter of the largest hole?", p.bore),
            lengths("What is the diameter of the counterbored holes?", [p.bolt_hole] * p.bolts),
            length("What is the height of the object?", p.top + p.neck_length),
            length("What is the depth of the groove?", p.groove_depth),
            length("What is the width of the groove?", p.groove_width),
            point("Where is the center of the largest hole?", (0, 0, (p.top - p.neck_length) / 2)),
            size("What is the size of the object?", (p.diameter, p.diameter, p.top + p.neck_length)),
        ],
    )


if __name__ == "__main__":
    main()
