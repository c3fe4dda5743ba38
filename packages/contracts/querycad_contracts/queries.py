"""What a noun phrase asks for: a typed query for parts, as language writes it and grounding reads it.

Lengths are metres, areas m2, volumes m3, angles radians. Nothing here knows words of a question or faces of a model.
"""

from __future__ import annotations

from enum import StrEnum

from pydantic import Field

from .geometry import Convexity, Frozen, Part, Side, SurfaceKind, Vector


class Measure(StrEnum):
    """A property that can be asked of a part or of the whole model. docs/measures.md defines each."""

    RADIUS = "radius"
    DIAMETER = "diameter"
    INNER_RADIUS = "inner_radius"
    OUTER_RADIUS = "outer_radius"
    INNER_DIAMETER = "inner_diameter"
    OUTER_DIAMETER = "outer_diameter"
    ROOT_DIAMETER = "root_diameter"
    """Of a gear: of the circle at the feet of its teeth."""
    PITCH_DIAMETER = "pitch_diameter"
    """Of a gear: of its reference circle, the module times the number of teeth (ISO 1122-1)."""
    MODULE = "module"
    """Of a gear: by the height of its teeth, which is 2.25 modules (ISO 53)."""
    CENTRELINE_RADIUS = "centreline_radius"
    """Of what is bent along an arc: from the arc's centre to its middle line."""
    CIRCUMFERENCE = "circumference"
    DEPTH = "depth"
    HEIGHT = "height"
    WIDTH = "width"
    MOUTH_WIDTH = "mouth_width"
    BOTTOM_WIDTH = "bottom_width"
    """Of a cut that narrows or widens inwards, at its bottom."""
    LENGTH = "length"
    THICKNESS = "thickness"
    WALL_THICKNESS = "wall_thickness"
    RADIAL_WIDTH = "radial_width"
    """Of a ring, a shoulder or a ledge: square to its axis."""
    MAGNITUDE = "magnitude"
    """How big something is, where no dimension is named."""
    SIZE = "size"
    """Full extents along x, y, z."""
    HALF_SIZE = "half_size"
    X_EXTENT = "x_extent"
    Y_EXTENT = "y_extent"
    Z_EXTENT = "z_extent"
    SHORT_SIDE = "short_side"
    LONG_SIDE = "long_side"
    DIAGONAL = "diagonal"
    ACROSS_FLATS = "across_flats"
    ACROSS_CORNERS = "across_corners"
    CENTRE_LENGTH = "centre_length"
    """Of a slot with round ends: from centre to centre of the ends."""
    TUBE_DIAMETER = "tube_diameter"
    """Of a torus: across the tube that goes around."""
    DEVELOPED_LENGTH = "developed_length"
    """Of bent sheet: laid flat."""
    BOTTOM_THICKNESS = "bottom_thickness"
    """Of what is blind: the material behind its bottom."""
    MINIMUM_THICKNESS = "minimum_thickness"
    """Of a body or the whole: of the thinnest wall."""
    WALL_DISTANCE = "wall_distance"
    """Of a hole: the material from its wall to the nearest outer face."""
    ANGLE = "angle"
    ANGULAR_PITCH = "angular_pitch"
    """Of like parts around an axis: from one to the next."""
    INCLUDED_ANGLE = "included_angle"
    """Of what tapers: from flank to flank."""
    DRAFT = "draft"
    INCLINATION = "inclination"
    """Of what is plane: its angle to the horizontal plane."""
    AREA = "area"
    OPENING_AREA = "opening_area"
    """Within the rim of an opening."""
    CROSS_SECTION_AREA = "cross_section_area"
    """Of what is extruded, or the mean of what is long: cut across its length."""
    VOLUME = "volume"
    MASS = "mass"
    CENTER_OF_MASS = "center_of_mass"
    INERTIA = "inertia"
    """Moments about x, y, z through the centre of mass."""
    MIRROR_PLANES = "mirror_planes"
    FILL = "fill"
    """The share of the bounding box that is material, in percent."""
    REMOVED = "removed"
    """What is cut away of a block as large as the bounding box."""
    STANDING_AREA = "standing_area"
    """On which the whole stands on a plane below it."""
    LONG_AXIS = "long_axis"
    """The axis, 'x', 'y' or 'z', along which the whole is longest."""
    AXIAL_EXTENT = "axial_extent"
    """How far the part reaches along its own axis."""
    FACE_COUNT = "face_count"
    """Of all shapes."""
    EDGE_COUNT = "edge_count"
    POSITION = "position"
    OPENING = "opening"
    FLOOR_CENTER = "floor_center"
    """Of what is cut in: where its axis meets its floor."""
    MIN_CORNER = "min_corner"
    """Of the bounding box: the one with the smallest x, y and z."""
    MAX_CORNER = "max_corner"
    TIP = "tip"
    TOP_END = "top_end"
    BOTTOM_END = "bottom_end"
    LEFT_END = "left_end"
    RIGHT_END = "right_end"
    FRONT_END = "front_end"
    BACK_END = "back_end"
    X = "x"
    Y = "y"
    Z = "z"
    AXIS = "axis"
    NORMAL = "normal"
    DIRECTION = "direction"
    APPROACH = "approach"
    """Into the material: of a tool into an opening, of a screw."""
    EDGE_DISTANCE = "edge_distance"
    CENTER_HEIGHT = "center_height"
    PITCH = "pitch"
    COUNT = "count"
    """Of a pattern its members, of a gear its teeth."""
    NAME = "name"
    KIND = "kind"
    COLOR = "color"
    SIDES = "sides"
    BOTTOM = "bottom"


class Relation(StrEnum):
    """How does a value compare with a stated one?"""

    EQUAL = "equal"
    UNEQUAL = "unequal"
    ABOUT = "about"
    LESS = "less"
    AT_MOST = "at_most"
    MORE = "more"
    AT_LEAST = "at_least"
    BETWEEN = "between"


class SizeFilter(Frozen):
    """A stated size that the part has: 'with a diameter of 5 mm', 'deeper than 11 mm', '5 mm hole'."""

    measure: Measure | None = Field(None, description="Null: whatever size a part of that kind is named by.")
    relation: Relation = Relation.EQUAL
    low: float = Field(description="SI; what it is compared with, the lower end of a range.")
    high: float | None = Field(None, description="The upper end of a range.")


class Rank(Frozen):
    """Which of several: the first `count` in an order, or the `nth`.

    One of the orders is set; or none, where the words say none: for 'the second hole' there must be two.
    """

    measure: Measure | None = None
    side: Side | None = Field(None, description="The part that lies farthest towards this side.")
    near: PartQuery | None = Field(None, description="The part nearest to another one.")
    edge: bool = Field(False, description="The part nearest to the model's edge.")
    most: bool = True
    nth: int = 1
    count: int = 1

    @property
    def is_unordered(self) -> bool:
        """Is no order said?"""
        return self.measure is None and self.side is None and self.near is None and not self.edge


class Place(Frozen):
    """Where the part is, as seen from another one, from a side, or from the middle of the model."""

    relation: str = Field(description="'in', 'on', 'of', 'through', 'near', 'around', 'between', 'above', 'with' …")
    what: PartQuery | None = None
    side: Side | None = None
    negated: bool = False


class PartQuery(Frozen):
    """Which parts are asked for? A noun with all that restricts it. Every field restricts, or is said not to."""

    noun: str = Field("", description="An entry of the lexicon, or the free words of an unknown noun; empty: any part.")
    known: bool = Field(True, description="Is the noun an entry of the lexicon?")
    words: tuple[str, ...] = Field((), description="All content words of the noun phrase, for names of bodies.")
    adjectives: tuple[str, ...] = Field((), description="Entries of the lexicon, such as 'counterbored'.")
    lacking: tuple[str, ...] = Field((), description="Attributes it must not have: 'without thread', 'unthreaded'.")
    sizes: tuple[SizeFilter, ...] = ()
    threads: tuple[str, ...] = Field((), description="'m6', '1/4-20' …")
    colors: tuple[str, ...] = ()
    count: int | None = Field(None, description="How many there are said to be.")
    plural: bool = False
    definite: bool = Field(False, description="'the …': one, or all of them, is known to the speaker.")
    sample: bool = Field(False, description="However many there are, any one stands for all: 'one of the holes'.")
    deictic: bool = Field(False, description="'this bracket', 'my bracket': what the speaker has before them.")
    ranks: tuple[Rank, ...] = ()
    places: tuple[Place, ...] = ()
    sides: tuple[Side, ...] = Field((), description="Visible from any of these.")
    unseen: tuple[Side, ...] = Field((), description="Visible from none of these.")
    ends: tuple[Side, ...] = Field((), description="Said like an adjective: 'the left leg' is the leftmost one.")
    excluded: tuple[PartQuery, ...] = Field((), description="'except the threaded ones'.")
    also: tuple[PartQuery, ...] = Field((), description="Further kinds that count as well: 'holes and slots'.")
    unknown: tuple[str, ...] = Field((), description="Words of the phrase that the lexicon does not have.")
    ids: tuple[str, ...] = Field((), description="Ids of parts: 'hole-4' for 'hole 4'; nothing else counts then.")
    sense: int = Field(0, description="Which of the groundings is taken, best first.")


class Line(Frozen):
    """An infinite straight line, such as an axis."""

    point: Vector
    direction: Vector = Field(description="Unit vector; which way it points does not matter.")


class FaceQuery(Frozen):
    """Which faces are asked for? Every field that is set restricts; there is nothing to be understood."""

    kind: SurfaceKind | None = None
    convexity: Convexity | None = None
    facing: Side | None = Field(None, description="Planes whose outward normal points to that side.")
    radius: float | None = Field(None, description="To 0.05 mm (`DRAWING_M`), or a hundredth where that is less.")
    coaxial_with: Line | None = Field(None, description="Those around this axis, to the tolerance of recognition.")
    body: int | None = None


class Grounded(Frozen):
    """One way to ground a query on a model: the parts, and what speaks for and against it."""

    parts: tuple[Part, ...]
    features: dict[str, float] = Field(description="Name to number; docs/understanding.md explains each.")
    unchecked: tuple[str, ...] = Field((), description='What restricts but could not be checked: "in the rim".')
    reason: str = Field("", description="In plain words: 'counterbored holes visible from the top'.")


Rank.model_rebuild()
Place.model_rebuild()
