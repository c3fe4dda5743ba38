// A model as it is drawn: all bodies in one geometry, so that a large assembly is three draw calls.

import { Box3, BufferAttribute, BufferGeometry, Color, Mesh, Vector3, type Material, type Object3D } from "three";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
import { coarser } from "./coarse";

/** A body as the file names and colours it. */
export interface BodyNode {
  readonly id: number;
  readonly name: string;
  /** `#rrggbb`, sRGB. */
  readonly color: string;
  readonly faces: readonly number[];
}

/** What a GLB holds. Places are in units of the model's half diagonal, about its middle: see `toMetres`. */
export class Model {
  constructor(
    /** Its groups are the bodies' triangles. */
    readonly surface: BufferGeometry,
    readonly edges: BufferGeometry,
    /** The surface for while it moves, with ever fewer triangles; none: it is small enough as it is. */
    readonly coarser: readonly BufferGeometry[],
    readonly bodies: readonly BodyNode[],
    readonly faceCount: number,
    /** Metres. */
    readonly box: Box3,
    /** Of the box, metres. */
    readonly middle: Vector3,
    private readonly scale: number,
  ) {}

  /** A point of the file, metres, as it is drawn. */
  fromMetres(point: readonly number[]): Vector3 {
    return new Vector3(point[0], point[1], point[2]).sub(this.middle).multiplyScalar(1 / this.scale);
  }

  /** A point that is drawn, in metres of the file. */
  toMetres(point: Vector3): Vector3 {
    return point.clone().multiplyScalar(this.scale).add(this.middle);
  }

  /** A length that is drawn, in metres. */
  lengthInMetres(length: number): number {
    return length * this.scale;
  }

  /** Half extents as drawn. */
  get half(): Vector3 {
    return this.box.getSize(new Vector3()).multiplyScalar(0.5 / this.scale);
  }

  dispose(): void {
    this.surface.dispose();
    this.edges.dispose();
    this.coarser.forEach((each) => each.dispose());
  }
}

interface Piece {
  id: number;
  name: string;
  color: string;
  surface: BufferGeometry;
  lines: BufferGeometry | undefined;
}

/** Reads binary glTF as the service writes it. Throws an Error for what is no such file. */
export async function readModel(data: ArrayBuffer): Promise<Model> {
  const gltf = await new GLTFLoader().parseAsync(data, "");
  const pieces = piecesOf(gltf.scene);
  if (!pieces.length) throw new Error("the file holds no surface");
  return merged(pieces);
}

function piecesOf(scene: Object3D): Piece[] {
  const pieces: Piece[] = [];
  const seen = new Set<Object3D>();
  scene.traverse((node) => {
    if (typeof node.userData["body"] !== "number" || seen.has(node)) return;
    // a body of one primitive is the mesh itself, one of two has a child for each
    const drawn = node instanceof Mesh ? [node] : node.children;
    drawn.forEach((each) => seen.add(each));
    const surface = drawn.find((each): each is Mesh => each instanceof Mesh);
    if (!surface) return;
    const lines = drawn.find((each) => "isLineSegments" in each) as { geometry: BufferGeometry } | undefined;
    const material = surface.material as Material & { color?: Color };
    pieces.push({
      id: node.userData["body"],
      name: String(node.userData["name"] ?? node.name),
      color: `#${(material.color ?? new Color(0xdee0e4)).getHexString()}`,
      surface: surface.geometry,
      lines: lines?.geometry,
    });
  });
  return pieces.sort((a, b) => a.id - b.id);
}

function merged(pieces: readonly Piece[]): Model {
  const count = (of: (piece: Piece) => number): number => pieces.reduce((sum, piece) => sum + of(piece), 0);
  const vertices = count((piece) => piece.surface.getAttribute("position").count);
  const positions = new Float32Array(vertices * 3);
  const normals = new Int8Array(vertices * 4);
  const faces = new Float32Array(vertices);
  const triangles = new Uint32Array(count((piece) => piece.surface.getIndex()?.count ?? 0));
  const lines = new Uint32Array(count((piece) => piece.lines?.getIndex()?.count ?? 0));
  const bodies: BodyNode[] = [];
  const ranges: { start: number; count: number }[] = [];
  const box = new Box3();
  let [vertex, corner, end, faceCount] = [0, 0, 0, 0];
  for (const piece of pieces) {
    const place = piece.surface.getAttribute("position").array;
    const normal = piece.surface.getAttribute("normal").array;
    const face = piece.surface.getAttribute("_face_id").array;
    positions.set(place, vertex * 3);
    faces.set(face, vertex);
    for (let i = 0; i < face.length; i += 1) {
      for (let axis = 0; axis < 3; axis += 1) normals[(vertex + i) * 4 + axis] = Math.round((normal[i * 3 + axis] ?? 0) * 127);
    }
    const first = corner;
    corner = copied(piece.surface, triangles, corner, vertex);
    ranges.push({ start: first, count: corner - first });
    end = copied(piece.lines, lines, end, vertex);
    const own = [...new Set(face)].sort((a, b) => a - b);
    faceCount = Math.max(faceCount, (own.at(-1) ?? -1) + 1);
    bodies.push({ id: piece.id, name: piece.name, color: piece.color, faces: own });
    box.union(new Box3().setFromArray(place as Float32Array));
    vertex += face.length;
  }
  const middle = box.getCenter(new Vector3());
  const scale = box.getSize(new Vector3()).length() / 2 || 1;
  for (let i = 0; i < positions.length; i += 3) {
    positions[i] = ((positions[i] ?? 0) - middle.x) / scale;
    positions[i + 1] = ((positions[i + 1] ?? 0) - middle.y) / scale;
    positions[i + 2] = ((positions[i + 2] ?? 0) - middle.z) / scale;
  }
  const shared = {
    position: new BufferAttribute(positions, 3),
    normal: new BufferAttribute(normals, 4, true),
    face: new BufferAttribute(faces, 1),
  };
  const drawn = (index: Uint32Array): BufferGeometry => {
    const geometry = new BufferGeometry();
    Object.entries(shared).forEach(([name, attribute]) => geometry.setAttribute(name, attribute));
    geometry.setIndex(new BufferAttribute(index, 1));
    return geometry;
  };
  const surface = drawn(triangles);
  ranges.forEach(({ start, count }, body) => surface.addGroup(start, count, body));
  return new Model(surface, drawn(lines), coarser(surface), bodies, faceCount, box, middle, scale);
}

/** Copies a geometry's indices to `target` from `at`, raised by the number of its first vertex; where the next ones go. */
function copied(from: BufferGeometry | undefined, target: Uint32Array, at: number, first: number): number {
  const index = from?.getIndex()?.array;
  if (!index) return at;
  for (let i = 0; i < index.length; i += 1) target[at + i] = (index[i] ?? 0) + first;
  return at + index.length;
}
