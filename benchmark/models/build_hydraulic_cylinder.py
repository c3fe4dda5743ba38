"""A hydraulic cylinder: tube, two caps, piston, piston rod, four tie screws, as named and coloured bodies."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Compound, Part, Pos

from benchmark.kit import Item, Model, count, length, lengths, point, points, size
from benchmark.shapes import LEFT, RIGHT, assembly, block, grid, named, rod

MODEL = Model("Hydraulic cylinder", "dev", bodies=9)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is x, the rear cap begins at x = 0, the rod leaves to the right."""

    tube: float = 63
    tube_bore: float = 50
    tube_length: float = 200
    cap: float = 75  # square
    front_cap: float = 40
    rear_cap: float = 30
    rod: float = 28
    rod_out: float = 60  # beyond the front cap
    piston: float = 24  # along the axis
    stroke: float = 40  # from the rear cap to the piston
    port: float = 14
    port_depth: float = 18
    screws: int = 4
    screw: float = 8
    screw_grip: float = 25
    screw_head: float = 13
    screw_head_height: float = 8
    screw_span: float = 55

    @property
    def front(self) -> float:
        """Where the front cap begins."""
        return self.rear_cap + self.tube_length

    @property
    def rod_start(self) -> float:
        """Where the rod begins, flush with its piston."""
        return self.rear_cap + self.stroke

    @property
    def end(self) -> float:
        """Where the rod ends."""
        return self.front + self.front_cap + self.rod_out

    def screws_at(self) -> list[tuple[float, float]]:
        """Where are the screws, y and z?"""
        return grid(2, 2, self.screw_span, self.screw_span)


def cap(p: P, thickness: float, port_x: float) -> Part:
    """A square cap from x = 0 on, with its port from above."""
    body = block((thickness, p.cap, p.cap), (thickness / 2, 0, -p.cap / 2))
    return body - rod(p.port, p.port_depth, (port_x, 0, p.cap / 2 - p.port_depth))


def build(p: P) -> Compound:
    """Lines the bodies up along x; screws enter the front cap from the right."""
    total = p.front + p.front_cap
    front = cap(p, p.front_cap, 12) - rod(p.rod, p.front_cap, along=RIGHT)
    front -= [rod(p.screw, p.screw_grip, (p.front_cap, y, z), LEFT) for y, z in p.screws_at()]
    tube = rod(p.tube, p.tube_length, along=RIGHT) - rod(p.tube_bore, p.tube_length, along=RIGHT)
    start = (p.rod_start, 0, 0)
    piston = rod(p.tube_bore, p.piston, start, RIGHT) - rod(p.rod, p.piston, start, RIGHT)
    screw = rod(p.screw, p.screw_grip, along=LEFT) + rod(p.screw_head, p.screw_head_height, along=RIGHT)
    bodies = [
        named(cap(p, p.rear_cap, p.rear_cap / 2), "Rear cap", "SlateGray"),
        named(tube, "Cylinder tube", "SteelBlue", Pos(p.rear_cap, 0, 0)),
        named(front, "Front cap", "DimGray", Pos(p.front, 0, 0)),
        named(piston, "Piston", "SaddleBrown"),
        named(rod(p.rod, p.end - p.rod_start, start, RIGHT), "Piston rod", "Gold"),
    ]
    bodies += [named(Pos(total, y, z) * screw, "Screw M8x25", "Firebrick") for y, z in p.screws_at()]
    return assembly(bodies)


def questions(p: P) -> list[Item]:
    """Asked by fitters and by control engineers."""
    total = p.front + p.front_cap
    return [
        length("rod", "diameter", "What is the diameter of the piston rod?", p.rod),
        length("rod", "length", "How long is the piston rod body?", p.end - p.rod_start),
        point("rod", "Where is the center of the piston rod?", ((p.end + p.rod_start) / 2, 0, 0)),
        length("rod", "distance", "How far does the rod come out of the front cap?", p.rod_out),
        length("tube", "diameter", "What is the outside diameter of the cylinder tube?", p.tube),
        length("tube", "diameter", "What is the inside diameter of the cylinder tube?", p.tube_bore),
        length("tube", "thickness", "Wall thickness of the tube?", (p.tube - p.tube_bore) / 2),
        length("tube", "length", "Which length has the cylinder tube?", p.tube_length),
        count("screw", "How many screws are fitted on the right side of the front cap?", p.screws),
        count("screw head", "How many screw heads can be seen from the right?", p.screws),
        lengths("screw head", "diameter", "What diameter do the screw heads have?", [p.screw_head] * p.screws),
        lengths(
            "screw head", "height", "Height of the screw heads along their axis?", [p.screw_head_height] * p.screws
        ),
        points(
            "screw",
            "Where are the bounding-box centres of the screws?",
            [(total + (p.screw_head_height - p.screw_grip) / 2, y, z) for y, z in p.screws_at()],
        ),
        count("blind hole", "How many oil ports (blind holes) open to the top?", 2),
        lengths("blind hole", "diameter", "Diameter of the blind holes visible from the top?", [p.port] * 2),
        size("rectangular part", "What are the dimensions of the front cap?", (p.front_cap, p.cap, p.cap)),
        length("object", "length", "How long is the complete cylinder along x, rod included?", p.end),
    ]
