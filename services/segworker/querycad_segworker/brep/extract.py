"""From the file's shape to `topology.Brep`: what is sewn, which bodies there are, which way out is."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from OCP.BRep import BRep_Tool
from OCP.BRepBuilderAPI import BRepBuilderAPI_Sewing
from OCP.collections import IndexedMap_TopoDS_Shape_TopTools_ShapeMapHasher as ShapeMap
from OCP.gp import gp_Trsf
from OCP.TopAbs import TopAbs_ShapeEnum
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS, TopoDS_Face, TopoDS_Shape

from querycad_contracts import SurfaceKind
from querycad_segworker.errors import IncompleteFile
from querycad_segworker.tolerances import Tolerances
from querycad_segworker.topology import BodyRecord, Brep, Moments, together
from querycad_segworker.vectors import dist

from .boxes import rough_box
from .faces import METRES_PER_MM, FaceTable
from .moments import of_volume, placed, under_face, under_plane
from .step import NamedShape, StepContent, compound_of, subshapes

_FACE = TopAbs_ShapeEnum.TopAbs_FACE


@dataclass(frozen=True, slots=True)
class Extracted:
    """The B-rep and, for what still needs the kernel, its faces in the order of their ids (millimetres)."""

    brep: Brep
    faces: tuple[TopoDS_Face, ...]


def extract(content: StepContent) -> Extracted:
    """What is the file's B-rep? Raises IncompleteFile where there is no face at all."""
    warnings = list(content.warnings)
    faces = _faces(content.shape, warnings)
    if not faces:
        raise IncompleteFile("the file holds no geometry: no face was found in it")
    solids = [(solid, subshapes(solid, _FACE)) for solid in subshapes(content.shape, TopAbs_ShapeEnum.TopAbs_SOLID)]
    faces = _sew_loose(faces, solids, warnings)
    size = dist(*rough_box(compound_of(faces)))
    table = FaceTable(faces, Tolerances.for_diagonal(max(size, 1e-6)))
    bodies = _bodies(content.products, solids, table, warnings)
    return Extracted(table.brep(content.name, bodies, warnings), tuple(faces))


def _faces(shape: TopoDS_Shape, warnings: list[str]) -> list[TopoDS_Face]:
    """The faces in file order. One without a surface cannot be measured or drawn; it is left out, with a warning."""
    found = [TopoDS.Face(item) for item in subshapes(shape, _FACE)]
    kept = [face for face in found if BRep_Tool.Surface_s(face) is not None]
    if len(kept) < len(found):
        warnings.append(f"{len(found) - len(kept)} face(s) without a surface were left out")
    return kept


def _sew_loose(
    faces: list[TopoDS_Face], solids: Sequence[tuple[TopoDS_Shape, list[TopoDS_Shape]]], warnings: list[str]
) -> list[TopoDS_Face]:
    """Sews the faces that belong to no solid, so that neighbours share edges and point the same way."""
    in_solids = ShapeMap()
    for _, members in solids:
        for member in members:
            in_solids.Add(member)
    loose = [face for face in faces if not in_solids.Contains(face)]
    if not loose:
        return faces
    warnings.append(f"{len(loose)} of {len(faces)} faces belong to no solid; they were sewn where they meet")
    # 1e-5 of the size: translators write vertices to about 1e-6 of it, and real gaps are far wider.
    sewing = BRepBuilderAPI_Sewing(1e-5 * dist(*rough_box(compound_of(loose))))
    for face in loose:
        sewing.Add(face)
    sewing.Perform()
    placed = ShapeMap()
    for face in subshapes(sewing.SewedShape(), _FACE):
        placed.Add(face)
    result = []
    for face in faces:
        new = face if in_solids.Contains(face) else sewing.ModifiedSubShape(face)
        position = placed.FindIndex(new)
        # The copy inside the sewn shell carries the orientation that agrees with its neighbours.
        result.append(TopoDS.Face(placed.FindKey(position)) if position else face)
    return result


def _bodies(
    products: Sequence[NamedShape],
    solids: Sequence[tuple[TopoDS_Shape, list[TopoDS_Shape]]],
    table: FaceTable,
    warnings: list[str],
) -> list[BodyRecord]:
    """Solids first, in file order; then loose faces, connected ones together. What is inside out is turned."""
    index = ShapeMap()
    for face in table.kernel_faces:
        index.Add(face)
    groups: list[tuple[list[int], str, str | None, TopoDS_Shape | None]] = []
    product_index = ShapeMap()
    for product in products:
        product_index.Add(product.shape)
    taken: set[int] = set()
    for solid, members in solids:
        ids = sorted({int(index.FindIndex(face)) - 1 for face in members} - {-1} - taken)
        if ids:
            taken.update(ids)
            position = int(product_index.FindIndex(solid))
            owner = products[position - 1] if position else None
            groups.append(
                (ids, owner.name if owner is not None else "", owner.color if owner is not None else None, solid)
            )
    loose = [i for i in range(len(table.kernel_faces)) if i not in taken]
    groups.extend((ids, "", None, None) for ids in table.connected(loose))
    bodies: list[BodyRecord] = []
    volumes = _Volumes(table)
    for ids, name, color, owning_solid in groups:
        enclosed = volumes.of(ids, owning_solid)
        if enclosed.amount < 0:
            table.turn(ids)
        area = sum(table.records[i].area for i in ids) * METRES_PER_MM**2
        closed = owning_solid is not None or table.is_closed(ids)
        moments = enclosed.positive().in_metres(METRES_PER_MM, 3) if closed else None
        volume = 0.0 if moments is None else moments.amount
        bodies.append(BodyRecord(len(bodies), name, color, closed, tuple(ids), volume, area, moments))
    if any(not body.is_solid for body in bodies):
        warnings.append("a body that is not closed has no volume")
    return bodies


class _Volumes:
    """What oriented faces enclose, mm3. Instances of one product differ in place only: integrated once."""

    def __init__(self, table: FaceTable) -> None:
        self._table = table
        self._unplaced = ShapeMap()
        self._known: dict[tuple[int, int], tuple[gp_Trsf, Moments]] = {}

    def of(self, ids: Sequence[int], solid: TopoDS_Shape | None) -> Moments:
        """The amount is negative where the faces point inwards."""
        if solid is None or solid.Location().Transformation().IsNegative():
            return of_volume(compound_of([self._table.kernel_faces[i] for i in ids]))
        place = solid.Location().Transformation()
        key = int(self._unplaced.Add(solid.Located(TopLoc_Location()))), len(ids)
        if key not in self._known:
            self._known[key] = place, self._enclosed(ids)
        first, moments = self._known[key]
        return placed(moments, place.Multiplied(first.Inverted()))

    def _enclosed(self, ids: Sequence[int]) -> Moments:
        """Plane faces need no integration once their own moments are known; regular ones no adaptive one."""
        table = self._table
        apex = table.records[ids[0]].point
        return together(
            [
                under_plane(record.moments, record.point_normal, apex)
                if record.kind is SurfaceKind.PLANE and record.id in table.regular
                else under_face(table.kernel_faces[record.id], apex, adaptive=record.id not in table.regular)
                for record in map(table.records.__getitem__, ids)
            ]
        )
