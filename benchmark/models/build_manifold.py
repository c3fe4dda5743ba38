"""A hydraulic manifold drawn in inches: ports on three sides that meet a long gallery, four mounting holes."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, chamfer

from benchmark.kit import INCH, Item, Model, count, length, lengths, point, points, size
from benchmark.shapes import BACK, LEFT, block, drill, grid, rod

MODEL = Model("Hydraulic manifold", "dev", unit="in")


@dataclass(frozen=True, slots=True)
class P:
    """Inches turned into millimetres; the underside lies on z = 0, the gallery runs along x."""

    width: float = 6 * INCH
    depth: float = 2.5 * INCH
    height: float = 2 * INCH
    edge: float = 0.06 * INCH
    ports: int = 4
    port: float = 0.5 * INCH
    port_pitch: float = 1.25 * INCH
    port_depth: float = 1.25 * INCH
    gallery: float = 0.625 * INCH
    gallery_depth: float = 5.5 * INCH
    gallery_height: float = 0.875 * INCH
    gauge: float = 0.25 * INCH
    gauges: int = 2
    gauge_depth: float = 0.75 * INCH
    gauge_spacing: float = 3 * INCH
    gauge_height: float = 0.5 * INCH
    bolts: int = 4
    bolt: float = 0.28125 * INCH  # clearance of 1/4-20
    bolt_span: tuple[float, float] = (5.25 * INCH, 1.875 * INCH)

    def bolts_at(self) -> list[tuple[float, float]]:
        """Where are the mounting holes?"""
        return grid(2, self.bolts // 2, *self.bolt_span)


def build(p: P) -> Part:
    """Drills the gallery from the right, ports from above, gauge ports from the front, mounting holes through."""
    body = chamfer(block((p.width, p.depth, p.height)).edges().filter_by(Axis.Z), p.edge)
    tools = [rod(p.gallery, p.gallery_depth, (p.width / 2, 0, p.gallery_height), LEFT)]
    tools += [rod(p.port, p.port_depth, (x, 0, p.height - p.port_depth)) for x, _ in grid(p.ports, 1, p.port_pitch, 0)]
    tools += [
        drill(p.gauge, p.gauge_depth, (x, -p.depth / 2, p.gauge_height), BACK)
        for x, _ in grid(p.gauges, 1, p.gauge_spacing, 0)
    ]
    tools += [rod(p.bolt, p.height, (x, y, 0)) for x, y in p.bolts_at()]
    return body - tools


def questions(p: P) -> list[Item]:
    """Asked by fluid-power engineers."""
    middle_z = p.height / 2
    return [
        size(
            "object",
            "What are the external dimensions of the manifold block (width, depth, height)?",
            (p.width, p.depth, p.height),
        ),
        length("object", "height", "How tall is the manifold?", p.height),
        count("hole", "How many holes are visible from the top of the manifold?", p.ports + p.bolts),
        count("through hole", "How many through holes run vertically through the block?", p.bolts),
        lengths("through hole", "diameter", "What is the diameter of the vertical through holes?", [p.bolt] * p.bolts),
        points(
            "mounting hole",
            "Give the centre coordinates of the four through holes.",
            [(x, y, middle_z) for x, y in p.bolts_at()],
        ),
        count("hole", "How many half inch ports are on the top?", p.ports),
        length("hole", "distance", "How far apart are neighbouring ports on top, center to center?", p.port_pitch),
        count("blind hole", "Number of blind holes on the front side?", p.gauges),
        lengths(
            "blind hole",
            "depth",
            "How deep are the gauge ports in the front face (drill point excluded)?",
            [p.gauge_depth] * p.gauges,
        ),
        lengths(
            "blind hole",
            "radius",
            "Which radius do the holes have that I see from the front?",
            [p.gauge / 2] * p.gauges,
        ),
        length("hole", "diameter", "What is the diameter of the gallery hole that opens on the right side?", p.gallery),
        length("hole", "depth", "How deep is the hole on the right?", p.gallery_depth),
        point(
            "hole",
            "Where's the centre of the long gallery bore?",
            (p.width / 2 - p.gallery_depth / 2, 0, p.gallery_height),
        ),
        count("hole", "How many holes can I see when I look from the left?", 0),
        count(
            "hole",
            "How many holes open to the top, the front or the right, taken together?",
            p.ports + p.bolts + p.gauges + 1,
        ),
    ]
