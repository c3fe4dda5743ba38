// Points that a measurement snaps to: corners, middles of edges, centres of circles.

import { Vector3, type BufferGeometry } from "three";
import type { Point } from "./layout";

/** A click this near to a point means the point, this near to a circle the circle's centre; pixels. */
const POINT_PX = 12;
const LINE_PX = 7;
/** An edge ends where it turns by more than this (cosine of 45 degrees): a circle is drawn in smaller steps. */
const STRAIGHT = Math.SQRT1_2;
/** An edge is an arc if all of its points are on one circle to this share of the radius, as single precision has it. */
const ROUND = 2e-4;
/** Points of an edge that say whether it is round: two lines are always on some circle. */
const FEW = 5;

export interface Snap {
  readonly kind: "corner" | "middle" | "center";
  readonly point: Vector3;
  /** Of a circle, in the model's drawn units. */
  readonly radius?: number;
}

interface Candidate extends Snap {
  /** One of the faces that meet here. */
  readonly face: number;
  /** Of a circle: its points, whoever clicks one of which means the centre. */
  readonly around: readonly Vector3[];
}

export class Snapping {
  private found: readonly Candidate[] | undefined;

  /** `edges`: pairs of points, and at each the face that it is of. They are looked at when first asked for. */
  constructor(private readonly edges: BufferGeometry) {}

  /** The nearest point that is seen and that a click at this place may mean. `depth`: greater is nearer to the viewer. */
  at(
    place: Point,
    project: (point: Vector3) => Point,
    isSeen: (point: Vector3, face: number) => boolean,
    depth: (point: Vector3) => number,
  ): Snap | undefined {
    this.found ??= candidates(this.edges);
    const away = (point: Vector3): number => {
      const { x, y } = project(point);
      return Math.hypot(x - place.x, y - place.y);
    };
    const near = this.found
      .map((one) => ({ one, px: away(one.point) }))
      .filter(({ one, px }) => px < POINT_PX && isSeen(one.point, one.face))
      .sort((a, b) => Math.round(a.px - b.px) || depth(b.one.point) - depth(a.one.point));
    const point = near[0]?.one ?? this.nearCircle(place, project, isSeen, depth);
    return point && { kind: point.kind, point: point.point, ...(point.radius === undefined ? {} : { radius: point.radius }) };
  }

  /** The circle whose line is nearest to this place; of several, the nearest to the viewer. */
  private nearCircle(
    place: Point,
    project: (point: Vector3) => Point,
    isSeen: (point: Vector3, face: number) => boolean,
    depth: (point: Vector3) => number,
  ): Candidate | undefined {
    const lines = this.found!.flatMap((one) =>
      one.around.slice(1).map((end, index) => {
        const start = one.around[index]!;
        const { px, share } = toSegment(place, project(start), project(end));
        return { one, px, point: start.clone().lerp(end, share) };
      }),
    );
    return lines
      .filter(({ one, point, px }) => px < LINE_PX && isSeen(point, one.face))
      .sort((a, b) => Math.round(a.px - b.px) || depth(b.point) - depth(a.point))[0]?.one;
  }
}

interface Edge {
  readonly points: readonly Vector3[];
  readonly face: number;
  readonly closed: boolean;
}

function candidates(edges: BufferGeometry): Candidate[] {
  return chains(edges).flatMap(({ points, face, closed }): Candidate[] => {
    const circle = circleThrough(points, closed);
    const center: Candidate[] = circle ? [{ kind: "center", point: circle.center, radius: circle.radius, face, around: points }] : [];
    if (closed) return center;
    const corners = [points[0]!, points.at(-1)!].map((point): Candidate => ({ kind: "corner", point, face, around: [] }));
    return [...corners, { kind: "middle", point: middleOf(points), face, around: [] }, ...center];
  });
}

/** The edges as rows of points: segments joined where two meet that go on in one direction. */
function chains(edges: BufferGeometry): Edge[] {
  const [position, face, index] = [edges.getAttribute("position"), edges.getAttribute("face"), edges.getIndex()!.array];
  const numbers = new Map<string, number>();
  const points: Vector3[] = [];
  const faces: number[] = [];
  const numberOf = (vertex: number): number => {
    const point = new Vector3().fromBufferAttribute(position, vertex);
    const key = point.toArray().join();
    const known = numbers.get(key);
    if (known !== undefined) return known;
    numbers.set(key, points.length);
    faces.push(face.getX(vertex));
    return points.push(point) - 1;
  };
  const segments = Array.from({ length: index.length / 2 }, (_, at) => [numberOf(index[2 * at]!), numberOf(index[2 * at + 1]!)] as const);
  const at: number[][] = points.map(() => []);
  segments.forEach(([a, b], number) => {
    at[a]!.push(number);
    at[b]!.push(number);
  });
  const other = (segment: number, point: number): number => (segments[segment]![0] === point ? segments[segment]![1] : segments[segment]![0]);
  const goesOn = (point: number): boolean => {
    const [one, two, ...more] = at[point]!;
    if (one === undefined || two === undefined || more.length) return false;
    const [a, b] = [one, two].map((segment) => points[other(segment, point)]!.clone().sub(points[point]!).normalize());
    return -a!.dot(b!) > STRAIGHT;
  };
  const used = new Set<number>();
  const walked = (start: number, first: number): Edge => {
    const row = [start];
    for (let segment: number | undefined = first; segment !== undefined; ) {
      used.add(segment);
      const next = other(segment, row.at(-1)!);
      row.push(next);
      segment = next !== start && goesOn(next) ? at[next]!.find((each) => !used.has(each)) : undefined;
    }
    return { points: row.map((point) => points[point]!), face: faces[row[0]!]!, closed: row[0] === row.at(-1) && goesOn(start) };
  };
  const from = (starts: number[]): Edge[] =>
    starts.flatMap((start) => at[start]!.flatMap((segment) => (used.has(segment) ? [] : [walked(start, segment)])));
  const all = points.map((_, point) => point);
  return [...from(all.filter((point) => !goesOn(point))), ...from(all)]; // what is left then is closed
}

/** The point half-way along. */
function middleOf(points: readonly Vector3[]): Vector3 {
  const lengths = points.slice(1).map((point, index) => point.distanceTo(points[index]!));
  let left = lengths.reduce((sum, length) => sum + length, 0) / 2;
  for (const [index, length] of lengths.entries()) {
    if (left <= length) return points[index]!.clone().lerp(points[index + 1]!, length ? left / length : 0);
    left -= length;
  }
  return points.at(-1)!;
}

/** The circle that all of the points are on; undefined: they are not on one. */
function circleThrough(points: readonly Vector3[], closed: boolean): { center: Vector3; radius: number } | undefined {
  if (points.length < FEW) return undefined;
  const last = closed ? points.length - 1 : points.length;
  const [a, b, c] = [points[0]!, points[Math.floor(last / 3)]!, points[closed ? Math.floor((2 * last) / 3) : last - 1]!];
  const [u, v] = [b.clone().sub(a), c.clone().sub(a)];
  const normal = u.clone().cross(v);
  const square = normal.lengthSq();
  if (square < 1e-16) return undefined;
  // the circumcentre of three points, from the first of them
  const toCenter = normal.clone().cross(u).multiplyScalar(v.lengthSq()).add(v.clone().cross(normal).multiplyScalar(u.lengthSq())).divideScalar(2 * square);
  const [center, radius, up] = [a.clone().add(toCenter), toCenter.length(), normal.normalize()];
  const isOn = (point: Vector3): boolean => {
    const from = point.clone().sub(center);
    return Math.abs(from.length() - radius) < ROUND * radius && Math.abs(from.dot(up)) < ROUND * radius;
  };
  return points.every(isOn) ? { center, radius } : undefined;
}

/** How far a line is from a place, and at which share of it. */
function toSegment(place: Point, a: Point, b: Point): { px: number; share: number } {
  const [dx, dy] = [b.x - a.x, b.y - a.y];
  const share = Math.max(0, Math.min(1, ((place.x - a.x) * dx + (place.y - a.y) * dy) / (dx * dx + dy * dy || 1)));
  return { px: Math.hypot(a.x + share * dx - place.x, a.y + share * dy - place.y), share };
}
