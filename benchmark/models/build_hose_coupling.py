"""A hose coupling, stored as B-splines: threaded end with a conical seat, hexagon, collar and a barbed hose tail."""

from __future__ import annotations

from dataclasses import dataclass
from math import radians, tan

from build123d import Part

from benchmark.kit import Form, Item, Model, angle, count, length, lengths, size
from benchmark.shapes import RIGHT, cone, prism, rod

MODEL = Model("Hose coupling", "dev", Form.BSPLINE)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres and degrees; the axis is x, the threaded end's face lies on x = 0."""

    thread: float = 20.955  # outer diameter of G 1/2 (ISO 228)
    thread_length: float = 14
    undercut: float = 18
    undercut_width: float = 3  # next to the hexagon
    flats: float = 27
    hexagon: float = 11
    collar: float = 34
    collar_width: float = 3
    neck: float = 16
    neck_length: float = 6
    barbs: int = 4
    barb: float = 19
    barb_end: float = 15.6
    barb_length: float = 7
    bore: float = 11.5
    seat: float = 17
    seat_angle: float = 60

    @property
    def end(self) -> float:
        """Where on x does the hose tail end?"""
        tail = self.neck_length + self.barbs * self.barb_length
        return self.thread_length + self.hexagon + self.collar_width + tail


def build(p: P) -> Part:
    """Turns the contour from left to right, bores."""
    body = rod(p.thread, p.thread_length - p.undercut_width, (0, 0, 0), RIGHT)
    body += rod(p.undercut, p.thread_length, (0, 0, 0), RIGHT)
    x = p.thread_length
    body += prism(p.flats, p.hexagon, (x, 0, 0), RIGHT)
    x += p.hexagon
    body += rod(p.collar, p.collar_width, (x, 0, 0), RIGHT)
    x += p.collar_width
    body += rod(p.neck, p.neck_length, (x, 0, 0), RIGHT)
    x += p.neck_length
    for index in range(p.barbs):
        body += cone(p.barb, p.barb_end, p.barb_length, (x + index * p.barb_length, 0, 0), RIGHT)
    seat = (p.seat - p.bore) / 2 / tan(radians(p.seat_angle / 2))
    return body - rod(p.bore, p.end, (0, 0, 0), RIGHT) - cone(p.seat, p.bore, seat, (0, 0, 0), RIGHT)


def questions(p: P) -> list[Item]:
    """Asked in the plain way, and by a plumber, a buyer and an apprentice."""
    return [
        length("tube", "diameter", "What is the inner diameter of the tube?", p.bore),
        length("through hole", "radius", "What is the radius of the through hole?", p.bore / 2),
        length("ring", "diameter", "What is the outer diameter of the ring?", p.collar),
        length("ring", "thickness", "What is the thickness of the ring along the axis?", p.collar_width),
        length("cylinder", "diameter", "What is the outer diameter of the cylinder on the left?", p.thread),
        length("object", "width", "What is the total width of the object?", p.end),
        size("object", "What are the extents of the object?", (p.end, p.collar, p.collar), "extents"),
        length("hexagon", "width", "spanner size of the hexagon (across flats)?", p.flats),
        length("hexagon", "length", "How long is the hexagonal section, measured along the axis?", p.hexagon),
        count("cone", "Hello, can you tell me how many conical barbs there are on the hose end?", p.barbs),
        lengths("cone", "length", "length of each of the barbs", [p.barb_length] * p.barbs),
        length("groove", "width", "How wide is the groove between the thread and the hex?", p.undercut_width),
        length(
            "cone", "diameter", "The conical seat inside, at the left end: what's its diameter at the mouth?", p.seat
        ),
        angle("cone", "And what is the full (included) angle of that conical seat in the left end?", p.seat_angle),
    ]
