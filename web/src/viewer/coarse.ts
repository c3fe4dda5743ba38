// A large model with fewer triangles, for while it moves: what is smaller than a few pixels goes.

import { BufferAttribute, BufferGeometry } from "three";

/** Triangles that a software renderer draws 30 times a second: on two free cores, and on two that others use as well. */
const BUDGETS = [50_000, 15_000] as const;
/** Cells along the longest side, the finest grid first: one cell is 4 pixels of 960, then more. */
const GRIDS = [240, 160, 110, 90, 75, 60, 50] as const;

/** The model with ever fewer triangles; none: it is small enough as it is. */
export function coarser(fine: BufferGeometry): BufferGeometry[] {
  const found: BufferGeometry[] = [];
  for (const budget of BUDGETS) {
    const next = coarse(found.at(-1) ?? fine, budget);
    if (next) found.push(next);
  }
  return found;
}

/**
 * The geometry by vertex clustering (Rossignac and Borrel, 1993), in the finest grid that keeps within the budget:
 * all vertices of a cell move to one place, and triangles that lose a side go. Every vertex keeps its face, so that
 * colours, lights and hidden bodies are as in the original; its groups are the bodies, too, and what was closed stays
 * closed. Undefined: the model is small enough as it is.
 */
function coarse(fine: BufferGeometry, budget: number): BufferGeometry | undefined {
  const index = fine.getIndex()!.array;
  if (index.length / 3 <= budget) return undefined;
  const positions = fine.getAttribute("position").array;
  const faces = fine.getAttribute("face").array;
  let found = clustered(positions, faces, index, fine.groups, GRIDS[0]);
  for (const cells of GRIDS.slice(1)) {
    if (found.triangles.length / 3 <= budget) break;
    found = clustered(positions, faces, index, fine.groups, cells);
  }
  const { vertices, index: kept } = used(found.triangles);
  const normals = fine.getAttribute("normal").array;
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(picked(found.positions, vertices, 3), 3));
  geometry.setAttribute("normal", new BufferAttribute(Int8Array.from(picked(normals, vertices, 4)), 4, true));
  geometry.setAttribute("face", new BufferAttribute(picked(faces, vertices, 1), 1));
  geometry.setIndex(new BufferAttribute(kept, 1));
  found.groups.forEach(({ start, count }, body) => geometry.addGroup(start, count, body));
  return geometry;
}

/** The vertices that triangles use, and the triangles by their places among these. */
function used(triangles: Uint32Array): { vertices: number[]; index: Uint32Array<ArrayBuffer> } {
  const place = new Map<number, number>();
  const index = new Uint32Array(triangles.length);
  triangles.forEach((vertex, corner) => {
    const at = place.get(vertex) ?? place.size;
    place.set(vertex, at);
    index[corner] = at;
  });
  return { vertices: [...place.keys()], index };
}

/** The numbers of these vertices, `width` of them each. */
function picked(from: Numbers, vertices: readonly number[], width: number): Float32Array<ArrayBuffer> {
  const found = new Float32Array(vertices.length * width);
  vertices.forEach((vertex, at) => {
    for (let i = 0; i < width; i += 1) found[at * width + i] = from[vertex * width + i]!;
  });
  return found;
}

type Numbers = ArrayLike<number>;

interface Range {
  start: number;
  count: number;
}

interface Clustered {
  positions: Float32Array<ArrayBuffer>;
  triangles: Uint32Array<ArrayBuffer>;
  groups: Range[];
}

function clustered(positions: Numbers, faces: Numbers, index: Numbers, bodies: readonly Range[], cells: number): Clustered {
  const count = faces.length;
  const cellOf = new Uint32Array(count);
  const own = new Uint32Array(count); // the vertex that stands for all of this cell and face
  const moved = new Float32Array(count * 3);
  const firstOfCell = new Map<number, number>();
  const firstOfFace = new Map<number, number>();
  // places lie between -1 and 1
  const step = (value: number): number => Math.floor(((value + 1) / 2) * cells);
  for (let vertex = 0; vertex < count; vertex += 1) {
    const at = vertex * 3;
    const key = step(positions[at]!) + cells * (step(positions[at + 1]!) + cells * step(positions[at + 2]!));
    const first = firstOfCell.get(key) ?? vertex;
    if (first === vertex) firstOfCell.set(key, vertex);
    cellOf[vertex] = first;
    const faceKey = first * 4_194_304 + faces[vertex]!;
    const same = firstOfFace.get(faceKey) ?? vertex;
    if (same === vertex) firstOfFace.set(faceKey, vertex);
    own[vertex] = same;
    for (let axis = 0; axis < 3; axis += 1) moved[at + axis] = positions[first * 3 + axis]!;
  }
  const triangles = new Uint32Array(index.length);
  const groups: Range[] = [];
  let kept = 0;
  for (const body of bodies) {
    const start = kept;
    for (let corner = body.start; corner < body.start + body.count; corner += 3) {
      const [a, b, c] = [index[corner]!, index[corner + 1]!, index[corner + 2]!];
      if (cellOf[a] === cellOf[b] || cellOf[b] === cellOf[c] || cellOf[c] === cellOf[a]) continue;
      triangles.set([own[a]!, own[b]!, own[c]!], kept);
      kept += 3;
    }
    groups.push({ start, count: kept - start });
  }
  return { positions: moved, triangles: triangles.slice(0, kept), groups };
}
