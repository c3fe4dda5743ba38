"""A centring fixture of loose surfaces: cone on a cylinder on a round base; no solid in the file."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Part

from benchmark.kit import Form, Item, Model, count, length, lengths, point, size
from benchmark.shapes import circle, cone, rod

MODEL = Model("Centring cone", "dev", Form.SURFACES)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is z, the base lies on z = 0, the cone is cut off flat at its top."""

    base: float = 90
    base_height: float = 12
    cylinder: float = 50
    cylinder_height: float = 30
    cone_top: float = 16
    cone_height: float = 40
    holes: int = 4
    hole: float = 9
    circle: float = 70

    @property
    def height(self) -> float:
        """Over all."""
        return self.base_height + self.cylinder_height + self.cone_height


def build(p: P) -> Part:
    """Stacks base, cylinder and cone; drills the base."""
    step = p.base_height + p.cylinder_height
    body = rod(p.base, p.base_height) + rod(p.cylinder, p.cylinder_height, (0, 0, p.base_height))
    body += cone(p.cylinder, p.cone_top, p.cone_height, (0, 0, step))
    return body - [rod(p.hole, p.base_height, (x, y, 0)) for x, y in circle(p.holes, p.circle, 45)]


def questions(p: P) -> list[Item]:
    """Asked by toolmakers."""
    step = p.base_height + p.cylinder_height
    return [
        count("cone", "How many cones are there in the model?", 1),
        length("cone", "height", "How high is the cone, from its base to its flat top?", p.cone_height),
        length("cone", "diameter", "What is the largest diameter of the cone?", p.cylinder),
        length("cone", "radius", "What is the radius of the cone at its wide end?", p.cylinder / 2),
        point("cone", "Where is the centre of the cone's bounding box?", (0, 0, step + p.cone_height / 2)),
        length("cylinder", "height", "What is the height of the cylinder that carries the cone?", p.cylinder_height),
        length("cylinder", "diameter", "How large is the diameter of the cylinder below the cone?", p.cylinder),
        length("circular base", "diameter", "What is the diameter of the circular base?", p.base),
        length("circular base", "height", "Height of the round base plate?", p.base_height),
        count("mounting hole", "How many mounting holes does the base have?", p.holes),
        lengths("mounting hole", "diameter", "The mounting holes: which diameter?", [p.hole] * p.holes),
        lengths("through hole", "depth", "How deep are the through holes?", [p.base_height] * p.holes),
        length(
            "through hole",
            "distance",
            "Two holes lie opposite each other on the bolt circle; how far are their centres apart?",
            p.circle,
        ),
        length("object", "height", "What is the overall height?", p.height),
        size("object", "Extents of the object, please.", (p.base, p.base, p.height), "extents"),
    ]
