"""What a CAD model is made of, as every service sees it: sides, faces, parts, bodies, the whole shape.

All lengths are metres, areas square metres, volumes cubic metres, angles radians; all points and directions
are in the coordinate frame of the file. `x` is width, `y` is depth, `z` is height; `extents` are full lengths.
"""

from __future__ import annotations

from enum import StrEnum

from pydantic import BaseModel, ConfigDict, Field

Vector = tuple[float, float, float]
"""A point (metres) or a unit direction in the frame of the file."""
Matrix = tuple[Vector, Vector, Vector]
"""Three rows."""
DRAWING_M = 5e-5
"""Drawing accuracy, metres: half of a tenth of a millimetre, the last digit on drawings of machine parts."""


def as_drawn(value: float, wanted: float) -> bool:
    """Is a length the one that is asked for, both metres? To `DRAWING_M`, on small parts to a hundredth."""
    return abs(value - wanted) <= min(DRAWING_M, abs(wanted) / 100)


class Frozen(BaseModel):
    """Base of every contract: immutable, unknown fields refused."""

    model_config = ConfigDict(frozen=True, extra="forbid")


class Side(StrEnum):
    """The six sides a model is looked at from, named as in the CAD-Q&A benchmark."""

    TOP = "top"
    BOTTOM = "bottom"
    LEFT = "left"
    RIGHT = "right"
    FRONT = "front"
    BACK = "back"

    @property
    def outward(self) -> Vector:
        """Which way does this side face? The unit vector from the model towards a viewer on this side."""
        return _OUTWARD[self]

    @property
    def opposite(self) -> Side:
        """The side on the other end of the same axis."""
        return _OPPOSITE[self]


_OUTWARD: dict[Side, Vector] = {
    Side.TOP: (0.0, 0.0, 1.0),
    Side.BOTTOM: (0.0, 0.0, -1.0),
    Side.LEFT: (-1.0, 0.0, 0.0),
    Side.RIGHT: (1.0, 0.0, 0.0),
    Side.FRONT: (0.0, -1.0, 0.0),
    Side.BACK: (0.0, 1.0, 0.0),
}
_OPPOSITE: dict[Side, Side] = {
    Side.TOP: Side.BOTTOM,
    Side.BOTTOM: Side.TOP,
    Side.LEFT: Side.RIGHT,
    Side.RIGHT: Side.LEFT,
    Side.FRONT: Side.BACK,
    Side.BACK: Side.FRONT,
}


class SurfaceKind(StrEnum):
    """The canonical form of a face's surface; a B-spline that is a cylinder is a cylinder."""

    PLANE = "plane"
    CYLINDER = "cylinder"
    CONE = "cone"
    SPHERE = "sphere"
    TORUS = "torus"
    FREEFORM = "freeform"


class Convexity(StrEnum):
    """How a curved face bulges, seen from outside the material: a boss is convex, a hole's wall concave."""

    CONVEX = "convex"
    CONCAVE = "concave"
    FLAT = "flat"
    MIXED = "mixed"


class Outline(StrEnum):
    """What is a plane face's outer boundary called?"""

    CIRCLE = "circle"
    RECTANGLE = "rectangle"
    """With square or rounded corners."""
    SLOT = "slot"
    """Two straight sides between two half circles."""
    FREE = "free"
    """Anything else."""


class Face(Frozen):
    """One face of the B-rep."""

    id: int = Field(description="Index of the face in file order, stable for a file.")
    body: int = Field(description="Index of the body (solid, or loose shell) that the face belongs to.")
    kind: SurfaceKind
    center: Vector = Field(description="Centre of the face's bounding box.")
    extents: Vector
    area: float
    convexity: Convexity
    radius: float | None = Field(None, description="Of a cylinder or sphere; a torus's minor radius; a cone's largest.")
    normal: Vector | None = Field(None, description="Outward unit normal of a plane.")
    axis: Vector | None = Field(None, description="Unit axis of a cylinder, cone or torus.")
    axis_point: Vector | None = Field(None, description="The point of the axis beside the middle of the face.")
    length: float | None = Field(
        None, description="Of a cylinder or cone along its axis; of a plane its longer side. Null: not known exactly."
    )
    outline: Outline | None = Field(None, description="Of a plane, by its outer boundary.")
    local_size: Vector | None = Field(None, description="Of a plane: length and width in its own frame, and 0.")
    along: Vector | None = Field(None, description="Unit direction of a plane's length.")
    neighbours: tuple[int, ...] = Field((), description="Ids of the faces that it shares an edge with.")
    part: str = Field("", description="Id of the feature that it belongs to, else of its body.")


class Weighed(Frozen):
    """What a body, the model, or the part that stands for either is as a mass of one density."""

    center_of_mass: Vector | None = Field(None, description="Of closed bodies only.")
    inertia: Matrix | None = Field(
        None,
        description="About the centre of mass, along the file's axes, for density 1 (m5): times a density in kg/m3 it "
        "is in kg m2. Off the diagonal are the products of inertia with a minus sign.",
    )
    mirror_planes: tuple[Vector, ...] = Field(
        (), description="Unit normals of the planes through its middle that mirror it onto itself."
    )
    rotation_axes: tuple[tuple[Vector, int], ...] = Field(
        (), description="Axes through its middle, and in how many positions each turns it onto itself; 0: in any."
    )


class Body(Weighed):
    """One body: a solid, or a loose shell where the file holds surfaces only."""

    id: int
    name: str = Field(description="Product or shape name in the file; empty when it has none.")
    color: str | None = Field(None, description="Hexadecimal sRGB such as '#c0c0c0'.")
    is_solid: bool
    center: Vector
    extents: Vector
    volume: float
    area: float
    face_count: int


class Shape(Weighed):
    """The whole model."""

    name: str
    center: Vector = Field(description="Centre of the exact bounding box.")
    extents: Vector
    volume: float
    area: float
    thickness: float | None = Field(None, description="Of sheet or plate material, where most walls share one.")
    minimum_thickness: float | None = Field(None, description="The thinnest wall, where faces of exact shapes make it.")
    bodies: tuple[Body, ...]
    face_count: int
    edge_count: int = Field(0, description="As the file has them; seams of round faces are none.")
    up: Side | None = Field(
        None, description="The side that is likely up: the top, unless the model would hardly stand on its bottom."
    )


class GroundedBy(StrEnum):
    """By which evidence are words turned into parts?"""

    GEOMETRY = "geometry"
    """What is recognised on the exact surfaces: milliseconds."""
    VISION = "vision"
    """What networks see in pictures of the model: seconds. Without their weights geometry answers, with a warning."""
    FUSED = "fused"
    """Both; without weights as above."""
    EYES = "eyes"
    """Geometry, and what a language model that takes images sees in pictures with numbered marks: seconds a phrase."""


class Evidence(Frozen):
    """What a part rests on."""

    source: str = Field(description="'geometry', 'vision' (by sight alone), 'fused' (both agree), 'name' or 'color'.")
    confidence: float = Field(ge=0.0, le=1.0)
    reason: str = Field(description="One sentence: why these faces are this part.")
    picture: str | None = Field(None, description="Name of the sheet that shows how it was seen; of vision only.")


class Refusal(Frozen):
    """What looked like a part of one kind, and why it is none."""

    kind: str = Field(description="The kind of part that it is not: 'hole', 'chamfer' …")
    faces: tuple[int, ...] = Field(description="Ids of the faces that it would have been made of.")
    reason: str = Field(description="Why not, in a few words.")


class PartKind(StrEnum):
    """Which family does a part belong to? A canonical term of the lexicon."""

    ARC = "arc"
    BEARING = "bearing"
    BEND = "bend"
    BODY = "body"
    BOSS = "boss"
    CAVITY = "cavity"
    CHAMFER = "chamfer"
    CHANNEL = "channel"
    CONE = "cone"
    COUNTERBORE = "counterbore"
    COUNTERSINK = "countersink"
    CUTOUT = "cutout"
    CYLINDER = "cylinder"
    CROSSBAR = "crossbar"
    DEPRESSION = "depression"
    """Whatever convex edges close off, where no narrower kind has it."""
    DIMPLE = "dimple"
    ELEVATION = "elevation"
    """Whatever concave edges close off, where no narrower kind has it."""
    FACE = "face"
    FILLET = "fillet"
    FLOOR = "floor"
    GEAR = "gear"
    GROOVE = "groove"
    HOLE = "hole"
    MODEL = "model"
    NOTCH = "notch"
    PATTERN = "pattern"
    PIPE = "pipe"
    POCKET = "pocket"
    PRISM = "prism"
    PROTRUSION = "protrusion"
    REGION = "region"
    """Faces that were seen to be what the words mean, without a name in geometry."""
    RIB = "rib"
    RING_SECTOR = "ring_sector"
    ROUND = "round"
    SLOT = "slot"
    SPHERE = "sphere"
    SPOTFACE = "spotface"
    STEP = "step"
    TOOTH = "tooth"
    TORUS = "torus"
    WALL = "wall"

    @property
    def stands_out(self) -> bool:
        """Does it rise from the material that it stands on?"""
        return self in _STANDING_OUT

    @property
    def cuts_in(self) -> bool:
        """Is it cut into the material from outside? A cavity is not: no tool reaches it."""
        return self in _CUT_IN

    @property
    def breaks_edge(self) -> bool:
        """Does it take the sharpness from an edge or a corner?"""
        return self in _EDGE_BREAKS

    @property
    def is_whole(self) -> bool:
        """Is it the model or a body of it, which other parts belong to?"""
        return self in (PartKind.MODEL, PartKind.BODY)

    @property
    def is_surface(self) -> bool:
        """Is it a surface by its shape alone, a piece of some feature?"""
        return self in _SURFACES

    @property
    def is_group(self) -> bool:
        """Is it nothing but its members: holes of a pattern, teeth of a gear?"""
        return self in (PartKind.PATTERN, PartKind.GEAR)

    @property
    def is_feature(self) -> bool:
        """Is it something that a drawing would name, more than a surface, a body, or a group of other parts?"""
        return self not in _NO_FEATURES


_STANDING_OUT = frozenset(
    (
        PartKind.BOSS,
        PartKind.ELEVATION,
        PartKind.PRISM,
        PartKind.PROTRUSION,
        PartKind.RIB,
    )
)
_CUT_IN = frozenset(
    (
        PartKind.HOLE,
        PartKind.POCKET,
        PartKind.CUTOUT,
        PartKind.SLOT,
        PartKind.CHANNEL,
        PartKind.STEP,
        PartKind.NOTCH,
        PartKind.GROOVE,
        PartKind.DEPRESSION,
        PartKind.DIMPLE,
        PartKind.COUNTERBORE,
        PartKind.COUNTERSINK,
    )
)
_EDGE_BREAKS = frozenset((PartKind.CHAMFER, PartKind.FILLET, PartKind.ROUND))
_SURFACES = frozenset(
    (
        PartKind.ARC,
        PartKind.CONE,
        PartKind.CYLINDER,
        PartKind.FACE,
        PartKind.SPHERE,
        PartKind.TORUS,
    )
)
_NO_FEATURES = _SURFACES | frozenset(
    (
        PartKind.BODY,
        PartKind.FLOOR,
        PartKind.MODEL,
        PartKind.PATTERN,
        PartKind.PRISM,
        PartKind.REGION,
        PartKind.WALL,
    )
)


class Bottom(StrEnum):
    """What does a hole, pocket or slot end in?"""

    THROUGH = "through"
    FLAT = "flat"
    CONICAL = "conical"
    SPHERICAL = "spherical"
    OPEN = "open"
    """At a side."""
    BORE = "bore"
    """Another bore, inside the material: a cross hole that does not leave it."""


class Part(Weighed):
    """A part or feature of the model that words can name: a hole, a boss, a body, a face.

    A measure that the part does not have is None.
    """

    id: str = Field(description="Unique within the model, such as 'hole-3'.")
    kind: PartKind = Field(description="Family, a canonical term of the lexicon: 'hole', 'boss', 'slot', 'body' …")
    tags: tuple[str, ...] = Field(
        (), description="Canonical attributes: 'through', 'blind', 'counterbored', 'circular' …"
    )
    label: str = Field(description="What a drawing would call it: 'through hole, diameter 5.5 mm'.")
    faces: tuple[int, ...] = Field(description="Ids of the faces it is made of.")
    sides: tuple[Side, ...] = Field(
        (), description="Sides it is visible from; for a hole or pocket, through its opening."
    )
    center: Vector
    extents: Vector
    axis: Vector | None = None
    normal: Vector | None = Field(None, description="Outward unit direction: of a planar part, or out of the opening.")
    radius: float | None = None
    diameter: float | None = None
    depth: float | None = Field(None, description="Along the part's own axis, from the opening to the bottom.")
    height: float | None = Field(None, description="Along the part's own axis for what protrudes; else the z extent.")
    width: float | None = None
    length: float | None = None
    nominal_length: float | None = Field(
        None, description="Of a screw as its standard says: under the head; a countersunk one's head counts."
    )
    thickness: float | None = None
    opening: Vector | None = Field(None, description="Centre of the opening of a hole, pocket or slot.")
    tip: Vector | None = Field(None, description="Outermost point on its axis; of a cone its narrow end.")
    tips: tuple[Vector, ...] = Field((), description="All free ends of its axis, `tip` first: two of a shaft or rod.")
    approach: tuple[Vector, ...] = Field(
        (),
        description="Unit directions into the material that it is reached along from its mouths, two of what goes "
        "through; of a screw, that it is driven in.",
    )
    bottom: Bottom | None = Field(None, description="'through', 'flat', 'conical', 'spherical', 'open' or 'bore'.")
    local_size: Vector | None = Field(
        None, description="Length, width, height in the part's own frame, longest of the plane first."
    )
    volume: float | None = None
    area: float | None = None
    radii: tuple[float, ...] = Field((), description="Radii of the coaxial steps from the opening inwards.")
    pitch: float | None = Field(
        None, description="Distance of neighbours in a pattern, centre to centre; of a modelled thread, along its axis."
    )
    count: int | None = Field(None, description="How many members a pattern has, or teeth a gear.")
    angle: float | None = Field(
        None,
        description="Radians. Between the flanks of a V groove, a dovetail's flank and floor, a chamfer and its face; "
        "of a cone, the full angle.",
    )
    outer_diameter: float | None = Field(
        None, description="Of what is round about an axis: over all. A sheet's bend: twice its outer bend radius."
    )
    inner_diameter: float | None = Field(
        None,
        description="Of a ring, tube, pipe, torus or bend: what is free inside. A sheet's bend: twice the inner one.",
    )
    tube_diameter: float | None = Field(None, description="Of a torus: across the tube that goes around.")
    across_flats: float | None = Field(
        None,
        description="Between opposite sides of a regular outline: hexagon, octagon, square; of two flats on a shaft.",
    )
    across_corners: float | None = Field(None, description="Between opposite corners of a regular outline.")
    center_length: float | None = Field(
        None, description="Between the centres of the two round ends of an obround slot, link or plate, or of an arm."
    )
    chamfer_size: float | None = Field(
        None, description="Of a chamfer: how much it takes off the edge, along the axis of a turned one."
    )
    draft: float | None = Field(
        None, description="Radians. Of a cone or a taper's wall to its axis; of the walls of a pocket, pad or rib."
    )
    bend_radius: float | None = Field(
        None, description="Of a pipe's bends along its middle line, where all have one; of a sheet's bends, inside."
    )
    bend_angle: float | None = Field(
        None, description="Radians that a bent pipe or sheet turns by, where it bends once."
    )
    mouth_length: float | None = Field(None, description="Of an opening that narrows or widens: at its mouth.")
    mouth_width: float | None = None
    bottom_length: float | None = Field(None, description="Of an opening that narrows or widens: at its bottom.")
    bottom_width: float | None = None
    edge_distance: float | None = Field(
        None, description="From the opening's rim to the outer edge of its face, where recognition measured it."
    )
    opening_area: float | None = Field(None, description="Of what has one opening: the area within its rim.")
    bottom_thickness: float | None = Field(
        None, description="Of what is blind: the least material straight behind its bottom, along its axis."
    )
    minimum_thickness: float | None = Field(
        None,
        description="Of a body and of the whole: the least material between two faces that look away from each other.",
    )
    wall_distance: float | None = Field(
        None, description="Of a hole or counterbore: from its wall sideways to the nearest outer face, across material."
    )
    inclination: float | None = Field(
        None, description="Radians, 0 to pi/2. Of what is plane: to the horizontal plane; 0 lies, pi/2 stands upright."
    )
    developed_length: float | None = Field(
        None, description="Of bent sheet: laid flat across its bends, along the middle of the material."
    )
    children: tuple[str, ...] = Field(
        (), description="Ids of the parts this one is made of or carries, such as the holes of a pattern."
    )
    name: str | None = Field(None, description="Product name in the file, of a body.")
    color: str | None = None
    evidence: Evidence
