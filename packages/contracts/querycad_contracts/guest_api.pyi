"""The guest API: all that a program which answers a question sees.

Everything is SI: lengths in metres, areas in m2, volumes in m3, angles in radians (1 mm = 0.001, 1 inch = 0.0254).
The frame is the file's: x is width (left to right), y is depth (front to back), z is height (bottom to top).
Extents are full lengths unless the name says `half_`. The result is whatever the program assigns to `solution`.
A measure that a part does not have raises AttributeError with a message that names the measures it has.
"""

from typing import Literal, TypeAlias, TypedDict

Vector: TypeAlias = tuple[float, float, float]
Side: TypeAlias = Literal["top", "bottom", "left", "right", "front", "back"]

class Face:
    """One face of the model's surface."""

    id: int
    kind: Literal["plane", "cylinder", "cone", "sphere", "torus", "freeform"]
    convexity: Literal["convex", "concave", "flat", "mixed"]
    """Seen from outside the material: a shaft is convex, the wall of a hole concave."""
    center: Vector
    extents: Vector
    area: float
    radius: float
    """Of a cylinder, sphere, torus tube, or a cone's widest end."""
    normal: Vector
    """Unit direction out of the material; planes only."""
    axis: Vector
    """Unit axis of a cylinder, cone or torus."""

class Body:
    """One body of the file, as modelled: a solid, or a loose sheet where there is no solid."""

    id: int
    name: str
    """Its product name in the file; empty when it has none."""
    color: str
    """Hexadecimal such as '#c0c0c0'."""
    is_solid: bool
    center: Vector
    extents: Vector
    half_extents: Vector
    volume: float
    area: float

class Shape:
    """The whole model."""

    name: str
    center: Vector
    """Centre of the bounding box."""
    extents: Vector
    """Full size along x (width), y (depth) and z (height)."""
    half_extents: Vector
    min_corner: Vector
    max_corner: Vector
    width: float
    depth: float
    height: float
    volume: float
    area: float
    thickness: float
    """Of the sheet or plate material that the model is made of."""
    bodies: list[Body]
    face_count: int
    edge_count: int

class Part:
    """A part or feature of the model: a hole, a shaft, a slot, a body …"""

    id: str
    kind: str
    """Its family: 'hole', 'boss', 'slot', 'body' …"""
    tags: list[str]
    """Such as 'through', 'blind', 'counterbored', 'circular', 'threaded'."""
    label: str
    name: str
    """Product name in the file; bodies only."""
    sides: list[Side]
    """Where it is visible from; a hole or pocket counts where one looks into its opening."""
    faces: list[Face]
    center: Vector
    """Middle of the part: of a hole, half-way between its ends on its axis."""
    opening: Vector
    """Centre of a hole's, pocket's or slot's opening."""
    tip: Vector
    """Outermost point on the axis of a shaft, pin, boss, cone."""
    tips: list[Vector]
    """All free ends of its axis, `tip` first: two of a shaft or rod whose ends are both free."""
    extents: Vector
    """Full size along x, y, z of the file."""
    half_extents: Vector
    axis: Vector
    normal: Vector
    """Unit direction that it faces; out of a hole's opening."""
    radius: float
    """Of a stepped hole: of its narrowest bore. See `radii` for every step."""
    diameter: float
    radii: list[float]
    """Radii of the coaxial steps, from the opening inwards."""
    depth: float
    """Of a hole, pocket or slot: along its axis from opening to bottom. Else its extent along y."""
    height: float
    """Of what protrudes: along its own axis from base to tip. Else its extent along z."""
    width: float
    """In the part's own frame; of the whole body, its extent along x."""
    length: float
    thickness: float
    """Of sheets, plates and fins; of what has no thickness of its own and no opening, its smallest dimension."""
    local_size: Vector
    bottom: Literal["through", "flat", "conical", "spherical", "open", "bore"]
    """'bore': it ends in another hole, inside the material."""
    pitch: float
    """Distance of neighbours in a pattern (bolt circle, row, grid), centre to centre; a modelled thread's own."""
    count: int
    """How many members a pattern has, or teeth a gear."""
    angle: float
    """Radians. Between the flanks of a V groove; of a dovetail's flanks to its floor; of a chamfer to its face; of a
    cone or countersink, the full angle."""
    outer_diameter: float
    """Over all, of what is round about an axis: rings, tubes, pipes, shafts, tori, bent bars; of a sheet's bend twice
    its outer radius."""
    inner_diameter: float
    """What is free inside of a ring, tube, pipe, torus or bent bar; of a sheet's bend twice its inner radius."""
    tube_diameter: float
    """Of a torus: across the tube that goes around."""
    across_flats: float
    """Between opposite sides of a hexagon, octagon or square, or of two flats on a shaft: the width of the wrench."""
    across_corners: float
    """Between opposite corners of a hexagon, octagon or square."""
    center_length: float
    """From centre to centre of the round ends of a slot, link or obround plate."""
    chamfer_size: float
    """Of a chamfer: how much it takes off the edge, the '2 mm' of '2 mm x 45 degrees'."""
    draft: float
    """Radians, between a taper's wall and its axis: of cones and taper pins, of the walls of pockets and pads."""
    bend_radius: float
    """Of a bent pipe or bar along its middle line; of bent sheet, inside."""
    bend_angle: float
    """Radians that a pipe or sheet with one bend turns by."""
    mouth_length: float
    """Of an opening that gets narrower or wider with depth, at its mouth; `bottom_length` and `bottom_width` at its
    other end."""
    mouth_width: float
    bottom_length: float
    bottom_width: float
    volume: float
    area: float

    def distance_to(self, other: "Part") -> float:
        """How far apart are the two parts' surfaces? 0 when they touch."""
        ...

    def center_distance(self, other: "Part") -> float:
        """How far apart are the two parts' centres? Of holes, or gears, on parallel axes: how far apart these are."""
        ...

    def angle_to(self, other: "Part") -> float:
        """Which angle, 0 to pi/2, do the two parts' axes (or normals) enclose?"""
        ...

    def is_in(self, other: "Part") -> bool:
        """Does the part lie in or on the other one: a hole in a flange, a boss on a plate, a member of a pattern?"""
        ...

    def edge_distance(self) -> float:
        """How far is the part's surface from the outer edge of the face it lies in?"""
        ...

class SizeFilter(TypedDict, total=False):
    """A stated size that the part has: 'a diameter of 5 mm', 'deeper than 11 mm'."""

    measure: str | None
    """Such as 'diameter'; without it, whatever size a part of that kind is named by."""
    relation: Literal["equal", "unequal", "about", "less", "at_most", "more", "at_least", "between"]
    low: float
    """What it is compared with, or the lower end of a range."""
    high: float | None

class Rank(TypedDict, total=False):
    """Which of several, by a measure, towards a side, or by nearness."""

    measure: str | None
    side: Side | None
    near: "PartQuery | None"
    edge: bool
    """Nearest to the model's edge."""
    most: bool
    nth: int
    count: int

class Place(TypedDict, total=False):
    """Where the part is, as seen from another one."""

    relation: str
    """'in', 'on', 'of', 'through', 'near', 'around', 'between', 'above', 'with' …"""
    what: "PartQuery | None"
    side: Side | None
    negated: bool

class PartQuery(TypedDict, total=False):
    """Which parts are meant: a noun with all that restricts it, as the parser writes it. All of it is optional."""

    noun: str
    """'hole', 'boss', 'counterbore' … Empty: any part."""
    known: bool
    words: list[str]
    """All words of the phrase, for the names of bodies."""
    adjectives: list[str]
    lacking: list[str]
    """Attributes that it must not have."""
    sizes: list[SizeFilter]
    threads: list[str]
    """'m6' …"""
    colors: list[str]
    count: int | None
    """How many there are said to be."""
    plural: bool
    definite: bool
    sample: bool
    """Any one of them stands for all."""
    ranks: list[Rank]
    places: list[Place]
    sides: list[Side]
    """Visible from any of these."""
    unseen: list[Side]
    """Visible from none of these."""
    ends: list[Side]
    """Said like an adjective: 'the left leg'."""
    excluded: list["PartQuery"]
    also: list["PartQuery"]
    unknown: list[str]
    ids: list[str]
    """'hole-4'; nothing else counts then."""
    sense: int
    """Which of the ways to ground it on the model, the best first."""

shape: Shape

def find_parts(description: str | PartQuery, sides: list[Side] | None = None) -> list[Part]:
    """Which parts does `description` mean, seen from any of `sides` (every side when None)?

    `description` is free text: 'hole', 'blind hole', 'rectangular pocket', 'M5 threaded hole', 'circular base',
    'screw', 'red body'. 'the hole' is one: of several that differ the largest, or those that are largest alike; 'hole'
    and 'holes' are all. Parts come sorted by id. An empty list means: understood, but the model has none.
    A description that cannot be grounded ends the program with its nearest known terms; it is never guessed.
    """
    ...

def distance(a: Vector, b: Vector) -> float:
    """How far apart are two points?"""
    ...

def different(values: list[float], tolerance: float = 1e-6) -> list[float]:
    """Which different values are there? Sorted; values nearer than `tolerance` count as one."""
    ...

def close(a: float, b: float, tolerance: float = 5e-5) -> bool:
    """Are two lengths the same to drawing accuracy (0.05 mm)?"""
    ...
