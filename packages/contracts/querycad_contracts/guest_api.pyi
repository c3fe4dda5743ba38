"""The guest API: all that a program which answers a question sees.

Everything is SI: lengths in metres, areas in m2, volumes in m3, angles in radians (1 mm = 0.001, 1 inch = 0.0254).
The frame is the file's: x is width (left to right), y is depth (front to back), z is height (bottom to top).
Extents are full lengths unless the name says `half_`. The result is whatever the program assigns to `solution`.
A measure that an object does not have is None, or AttributeError in a program that names AttributeError to catch it; a
name that is none of the API always is.

Python's own builtins are there, `print` among them, but for open, input, eval, exec, globals and what else reaches out;
math, re, itertools, functools and collections can be imported. What a program prints is kept beside its result.
Parts and faces are equal where they are the same, but go into no set and are no key: their ids do.
"""

from typing import Literal, TypeAlias, TypedDict

Vector: TypeAlias = tuple[float, float, float]
Side: TypeAlias = Literal["top", "bottom", "left", "right", "front", "back"]
Outline: TypeAlias = Literal["circle", "rectangle", "slot", "free"]

class Frame:
    """Own axes."""

    origin: Vector
    x: Vector
    """Its length. Along its longest straight edge across z; of what is round, any direction across z."""
    y: Vector
    z: Vector
    """Along its axis or normal."""

class Opening:
    """Of a hole, pocket or slot."""

    center: Vector
    normal: Vector
    outline: Outline

class Face:
    """One face of the surface."""

    id: int
    kind: Literal["plane", "cylinder", "cone", "sphere", "torus", "freeform"]
    convexity: Literal["convex", "concave", "flat", "mixed"]
    """A hole's wall is concave."""
    center: Vector
    extents: Vector
    area: float
    radius: float
    """Of a torus its tube's, of a cone at its widest."""
    normal: Vector
    """Out of the material. Of a plane."""
    axis: Vector
    """Of length 1. Of a cylinder, cone or torus. `axis_point` is the point of it beside `center`."""
    axis_point: Vector
    length: float
    """Along its axis; of a plane its longer side."""
    outline: Outline
    """Of a plane. Its outer boundary."""
    local_size: Vector
    """Of a plane: length, width, 0."""
    frame: Frame
    neighbours: list["Face"]
    part: "Part"
    """The smallest feature, else its body."""
    body: int
    """Id of its body."""

class Body:
    """One body of the file. A solid, or a loose sheet where there is no solid."""

    id: int
    name: str
    """May be empty. Its product name."""
    color: str
    """Such as '#c0c0c0'."""
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
    """Of the bounding box."""
    extents: Vector
    """Full size along x, y, z."""
    half_extents: Vector
    min_corner: Vector
    max_corner: Vector
    center_of_mass: Vector
    width: float
    depth: float
    height: float
    volume: float
    area: float
    minimum_thickness: float
    thickness: float
    """Of sheet or plate material."""
    bodies: list[Body]
    face_count: int
    edge_count: int
    up: Side
    """Likely. The top, unless the model would hardly stand on its bottom."""

class Part:
    """A hole, a shaft, a slot, a body …"""

    id: str
    kind: str
    """'hole', 'boss', 'slot', 'body' …"""
    tags: list[str]
    """'through', 'blind', 'threaded' …"""
    label: str
    name: str
    """Of a body."""
    color: str
    """Of a body. Such as '#c0c0c0'."""
    sides: list[Side]
    """Visible from; of a hole, into it."""
    faces: list[Face]
    center: Vector
    """Of a hole: half-way between its ends, on its axis. Of a sphere: of the ball. Of a curved slot: on its arc."""
    opening: Vector
    """Centre of where it opens."""
    openings: list[Opening]
    """Two of what goes through."""
    frame: Frame
    tip: Vector
    """Outermost point of what protrudes. Of a cone: its narrow end."""
    tips: list[Vector]
    """Of all free ends, `tip` first."""
    extents: Vector
    """Full size along x, y, z."""
    half_extents: Vector
    axis: Vector
    normal: Vector
    """That it faces; out of an opening."""
    radius: float
    """Of a stepped hole: of its narrowest bore."""
    diameter: float
    radii: list[float]
    """Of its steps, from the opening inwards."""
    depth: float
    """To the bottom; of what has no opening along y."""
    height: float
    """Base to tip; of what does not protrude along z."""
    width: float
    """In its own frame. Of a body along x."""
    length: float
    nominal_length: float
    """Of screws. Under the head."""
    thickness: float
    """Of sheets, plates, fins. Else the least dimension. None of what has an opening and no thickness."""
    local_size: Vector
    bottom: Literal["through", "flat", "conical", "spherical", "open", "bore"]
    """'bore': in another hole."""
    pitch: float
    """Between neighbours; a thread's own."""
    count: int
    """Members of a pattern, teeth of a gear."""
    angle: float
    """The full angle; of a chamfer to its face. Of a V groove, cone, conical boss or countersink; of a dovetail's
    flanks to its floor."""
    outer_diameter: float
    """Over all, of what is round. Rings, tubes, pipes, shafts, tori, bent bars; of a sheet's bend twice
    its outer radius."""
    inner_diameter: float
    """What is free inside. Of a ring, tube, pipe, torus; of a sheet's bend twice its inner radius."""
    tube_diameter: float
    """Of a torus."""
    across_flats: float
    """Of a hexagon, octagon, square, two flats."""
    across_corners: float
    center_length: float
    """Between the centres. Of the round ends of a slot or an arm."""
    chamfer_size: float
    """The '2 mm' of '2 mm x 45 degrees'."""
    draft: float
    """Of a taper's wall to its axis. Of cones and taper pins, of the walls of pockets and pads."""
    bend_radius: float
    """Of a pipe its middle line's. And of a curved slot; of sheet inside."""
    bend_angle: float
    """Of what bends once. A pipe or sheet."""
    mouth_length: float
    """Of what narrows or widens. An opening."""
    mouth_width: float
    bottom_length: float
    bottom_width: float
    opening_area: float
    developed_length: float
    minimum_thickness: float
    bottom_thickness: float
    """Left behind a blind bottom."""
    wall_distance: float
    """To the nearest outer face. Of a hole or counterbore, across the material."""
    inclination: float
    """To the horizontal."""
    volume: float
    area: float
    center_of_mass: Vector
    """Of bodies. And of the model; as of one density, as are the next three."""
    inertia: list[Vector]
    """For density 1. About the centre of mass along x, y, z; times kg/m3 in kg m2."""
    mirror_planes: list[Vector]
    """Normals. The planes go through the centre of mass; of what is round, those along x, y, z only."""
    rotation_axes: list[tuple[Vector, int]]
    """With positions; 0: any. So many look alike; through the centre of mass."""
    approach: list[Vector]
    """Ways in. Of a tool, from each mouth of an opening; of a screw as a body."""

    def distance_to(self, other: "Part") -> float:
        """Between the surfaces; 0 when they touch."""
        ...

    def center_distance(self, other: "Part") -> float:
        """Of holes, or gears, between parallel axes."""
        ...

    def angle_to(self, other: "Part") -> float:
        """0 to pi/2. Between axes or normals; of two arms, which point outwards, to pi."""
        ...

    def is_in(self, other: "Part") -> bool:
        """A hole in a flange, a boss on a plate."""
        ...

    def overlap_with(self, other: "Part") -> float:
        """Volume that two bodies share."""
        ...

    def edge_distance(self) -> float:
        """To the outer edge of its face. From its surface; ValueError where it lies in no plane face."""
        ...

    def size_in(self, frame: Frame) -> Vector:
        """Along its axes."""
        ...

    def measures(self) -> list[str]:
        """Names of those that it has."""
        ...

class Parts(list[Part]):
    """A list that says what of the words is not in it."""

    ignored_words: list[str]
    """Unknown words."""
    not_checked: list[str]
    """What could not be checked."""

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
    deictic: bool
    """'this bracket', 'my bracket': what the speaker has before them, so perhaps the whole model."""
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

Item: TypeAlias = Part | Face
shape: Shape

def find_parts(description: str | PartQuery, sides: list[Side] | None = None) -> Parts:
    """Which parts do these words mean: 'blind hole', 'M5 screw', 'red body'? Seen from any of `sides`.

    'the hole' is one: of several that differ the largest, or those that are largest alike; 'hole' and 'holes' are all.
    Parts come sorted by id. An empty list means: understood, but the model has none. A description that cannot be
    grounded ends the program with its nearest known terms; it is never guessed.
    Example: find_parts("blind hole", sides=["top"]).not_checked
    """
    ...

def parts(
    kind: str | None = None,
    tags: str | list[str] | None = None,
    side: Side | list[Side] | None = None,
    diameter: float | None = None,
    near: Item | Vector | None = None,
) -> list[Part]:
    """Which are so? Exactly this kind, all these tags, and so on. Sorted by id, or by distance.

    Nothing is guessed: a kind or tag that this model does not know raises ValueError with those that it has. The
    diameter is compared to drawing accuracy, with that of every step. `near` sorts by distance of the centres.
    Example: parts(kind="hole", tags=["through"], side="top", near=shape.center)
    """
    ...

def faces(
    kind: str | None = None,
    convexity: str | None = None,
    facing: Side | None = None,
    radius: float | None = None,
    coaxial_with: Item | None = None,
    body: int | Body | None = None,
) -> list[Face]:
    """Which are so? `facing`: planes whose normal points to that side, within 2.5 degrees.

    Example: faces(kind="cylinder", convexity="concave", coaxial_with=parts(kind="hole")[0])
    """
    ...

def look(phrase: str) -> list[Part]:
    """Which parts look like this in pictures? For what geometry has no name for.

    Somebody who takes images is shown the model with numbered marks, where such eyes are set up; else nothing is found.
    Example: look("logo")
    """
    ...

def picture(side: Side | None = None, parts: list[Part] | None = None) -> None:
    """Shows you a picture after this program, these parts numbered in their order.

    Of use to a model that is shown pictures; to any other program it does nothing.
    Example: picture("top", parts(kind="hole"))
    """
    ...

def coaxial(a: Item, b: Item) -> bool:
    """Do they share one axis?

    Example: coaxial(parts(kind="hole")[0], parts(kind="hole")[1])
    """
    ...

def adjacent(a: Item, b: Item) -> bool:
    """Do they share a face or an edge?

    Example: adjacent(parts(kind="hole")[0], faces(facing="top")[0])
    """
    ...

def offset(a: Item, b: Item) -> float:
    """Between two axes or parallel planes. Or a plane and an axis along it; else ValueError.

    Of axes that are not parallel it is their least distance, 0 where they cross.

    Example: offset(faces(facing="top")[0], faces(facing="bottom")[0])
    """
    ...

def on(items: list[Part], what: Item) -> list[Part]:
    """Those in, on or touching it.

    Example: on(parts(kind="hole"), faces(facing="top")[0])
    """
    ...

def around(items: list[Part], center: Item) -> list[Part]:
    """Those on a circle about its axis. Three or more of a kind, by angle.

    Example: around(parts(kind="hole"), parts(kind="hole")[0])
    """
    ...

def between(items: list[Part], a: Item, b: Item) -> list[Part]:
    """Those whose centre is between the two. Within the box around both.

    Example: between(parts(kind="hole"), parts(kind="hole")[0], parts(kind="hole")[1])
    """
    ...

def nearest(items: list[Part]) -> list[tuple[Part, Part]]:
    """Neighbours, the nearest pair first. Each part with the one nearest to it, by centres; of thousands, too.

    Example: nearest(parts(kind="hole"))[0][0].id
    """
    ...

def closest(items: list[Part], others: list[Part] | None = None) -> list[Part]:
    """Two with the least gap. By surfaces, of the items, or one of these and one of the others; none of fewer.

    Example: len(closest(parts(kind="hole")))
    """
    ...

def overlaps(items: list[Part], others: list[Part] | None = None) -> list[tuple[Part, Part]]:
    """Bodies in the same room. Pairs of them that share more than a cube of 0.1 mm.

    Example: len(overlaps(parts(kind="body")))
    """
    ...

def outermost(items: list[Part], side: Side | None = None) -> list[Part]:
    """Those that reach farthest. To a side, or from the model's middle.

    Example: outermost(parts(kind="hole"), "left")
    """
    ...

def distance(a: Vector, b: Vector) -> float:
    """How far apart are two points?

    Example: distance(parts(kind="hole")[0].center, shape.center)
    """
    ...

def different(values: list[float], tolerance: float = 1e-6) -> list[float]:
    """Different values, sorted.

    Values nearer than `tolerance` count as one.
    Example: different([p.diameter for p in parts(kind="hole")])
    """
    ...

def close(a: float, b: float, tolerance: float = 5e-5) -> bool:
    """Are two lengths the same? To drawing accuracy, 0.05 mm.

    Example: close(parts(kind="hole")[0].diameter, 0.005)
    """
    ...
