// Values drawn on the model itself: across a diameter, down a depth, along a side, from one part to another, an angle.

import { Quaternion, Vector3 } from "three";
import type { Answer, LengthUnit, Part, Vector } from "./api/types";
import { measure } from "./units";
import type { Model } from "./viewer/model";
import type { Dimension } from "./viewer/overlay";

/** What was answered, and how it is written. */
export interface Value {
  readonly text: string;
  readonly answer?: Answer;
  /** Extents of the whole model, metres: an answer that rests on no part is about it. */
  readonly whole?: Vector;
}

/** What has a box: a part, or the model. */
type Boxed = Pick<Part, "center" | "extents">;

/** A part's measure is the answer's where they differ by less than a nanometre, or a billionth of a radian. */
const SAME = 1e-9;
/** More dimensions than this hide the model. */
const MOST = 12;
/** An arc is as large as this share of the model's diagonal, and has so many pieces. */
const ARC_SHARE = 0.15;
const ARC_STEPS = 24;
const AXES = ["x", "y", "z"] as const;

type Path = readonly Vector3[];

/** The answer's values where their places are known: each is the measure of a part, or lies between two parts. */
export function dimensionsOf(parts: readonly Part[], value: Value, model: Model, unit: LengthUnit): Dimension[] {
  const { text, answer, whole } = value;
  if (!answer) return [];
  const drawn = (paths: readonly { path: Path; text: string }[]): Dimension[] =>
    paths.length > MOST ? [] : paths.map((each) => ({ path: each.path.map((point) => model.fromMetres(point.toArray())), text: each.text }));
  const numbers = (Array.isArray(answer.value) ? answer.value : [answer.value]).filter((each) => typeof each === "number");
  const [first, second, ...more] = parts;
  const pair = first && second && !more.length ? ([first, second] as const) : undefined;
  const boxed: Boxed | undefined = first ?? (whole && { center: model.middle.toArray(), extents: whole });
  if (answer.type === "size" && boxed && !second) return drawn(numbers.flatMap((_, axis) => sides(boxed, axis, unit)));
  if (answer.type === "angle" && pair) return drawn(arc(...pair, numbers[0] ?? 0, model).map((path) => ({ path, text })));
  if (answer.type !== "length" && answer.type !== "lengths") return [];
  if (!first) {
    const path = boxed && sideOf(boxed, numbers[0] ?? 0);
    return drawn(path ? [{ path, text }] : []);
  }
  const own = parts.flatMap((part) => {
    const found = numbers.map((length) => ({ length, path: along(part, length) })).find(({ path }) => path !== undefined);
    return found?.path ? [{ path: found.path, text: measure(found.length, unit) }] : [];
  });
  if (own.length === parts.length) return drawn(numbers.length === 1 ? own.map(({ path }) => ({ path, text })) : own);
  const gap = pair && numbers.length === 1 ? between(...pair, numbers[0]!) : undefined;
  return drawn(gap ? [{ path: gap, text }] : []);
}

const same = (a: number | null, b: number): boolean => a !== null && Math.abs(a - b) < SAME;
const vector = (of: Vector): Vector3 => new Vector3(...of);

/** The line on a part that is so many metres long: one of its measures. */
function along(part: Part, length: number): Path | undefined {
  const way = part.normal ?? part.axis;
  const place = vector(part.opening ?? part.tip ?? part.center);
  if (way) {
    const across = square(vector(way));
    const line = (radius: number, from: number): Path => {
      const middle = part.opening && !same(part.radii[0] ?? radius, radius) ? bottom(part) : place;
      return [from, 1].map((share) => middle.clone().addScaledVector(across, share * radius));
    };
    if ([part.diameter, part.outer_diameter, part.inner_diameter].some((own) => same(own, length))) return line(length / 2, -1);
    if (same(part.radius, length)) return line(length, 0);
  }
  if (part.opening && part.normal && same(part.depth, length)) return [place, place.clone().addScaledVector(vector(part.normal), -length)];
  const [start, end] = part.tips.map(vector);
  if (start && end && same(start.distanceTo(end), length)) return [start, end];
  if (part.tip && part.axis && same(part.height, length)) {
    const up = vector(part.axis);
    return [place, place.clone().addScaledVector(up, up.dot(place.clone().sub(vector(part.center))) > 0 ? -length : length)];
  }
  return sideOf(part, length);
}

/** The middle of a hole's inner end: there a stepped one is as wide as its bore. */
const bottom = (part: Part): Vector3 => vector(part.opening ?? part.center).addScaledVector(vector(part.normal ?? [0, 0, 0]), -(part.depth ?? 0));

/** The side of a box that is so many metres long. */
function sideOf(boxed: Boxed, length: number): Path | undefined {
  const axis = boxed.extents.findIndex((extent) => same(extent, length));
  return axis < 0 ? undefined : side(boxed, axis);
}

/** A side of the box along an axis of the file, at the front and below. */
function side(boxed: Boxed, axis: number): Path {
  const half = vector(boxed.extents).multiplyScalar(0.5);
  const low = vector(boxed.center).sub(half);
  const name = AXES[axis]!;
  if (name === "z") low.x += 2 * half.x;
  const high = low.clone();
  high[name] += 2 * half[name];
  return [low, high];
}

const sides = (boxed: Boxed, axis: number, unit: LengthUnit): { path: Path; text: string }[] =>
  axis < 3 ? [{ path: side(boxed, axis), text: measure(boxed.extents[axis]!, unit) }] : [];

/** The line of so many metres from one part to another: centre to centre, square to faces, axis to axis, or wall to wall. */
function between(one: Part, other: Part, length: number): Path | undefined {
  const start = vector(one.center);
  const apart = vector(other.center).sub(start);
  const line = (way: Vector3, from = 0, to = 1): Path => [start.clone().addScaledVector(way, from), start.clone().addScaledVector(way, to)];
  if (same(apart.length(), length)) return line(apart);
  for (const normal of [one.normal, other.normal]) {
    if (normal === null) continue;
    const step = vector(normal).multiplyScalar(apart.dot(vector(normal)));
    if (same(step.length(), length)) return line(step);
  }
  for (const axis of [one.axis, other.axis]) {
    if (axis === null) continue;
    const step = apart.clone().addScaledVector(vector(axis), -apart.dot(vector(axis)));
    const whole = step.length();
    if (same(whole, length)) return line(step);
    const [near, far] = [(one.diameter ?? 0) / 2, (other.diameter ?? 0) / 2];
    if (whole && same(whole - near - far, length)) return line(step, near / whole, 1 - far / whole);
  }
  return undefined;
}

/** The arc of so many radians between the directions of two parts, half-way between them. */
function arc(one: Part, other: Part, radians: number, model: Model): Path[] {
  const [a, b] = [one, other].map((part) => part.normal ?? part.axis);
  if (!a || !b) return [];
  const [from, to] = [vector(a).normalize(), vector(b).normalize()];
  if (!same(from.angleTo(to), radians)) to.negate(); // an axis points both ways
  if (!same(from.angleTo(to), radians) || radians < SAME) return [];
  const middle = vector(one.center).lerp(vector(other.center), 0.5);
  const radius = ARC_SHARE * model.lengthInMetres(2);
  const turn = new Quaternion().setFromUnitVectors(from, to);
  const points = Array.from({ length: ARC_STEPS + 1 }, (_, step) => {
    const way = from.clone().applyQuaternion(new Quaternion().slerp(turn, step / ARC_STEPS));
    return middle.clone().addScaledVector(way, radius);
  });
  return [[middle, ...points, middle]];
}

/** A direction square to this one, along the file's x or y as far as can be. */
function square(way: Vector3): Vector3 {
  const axis = way.clone().normalize();
  const least = Math.abs(axis.x) < 0.9 ? new Vector3(1, 0, 0) : new Vector3(0, 1, 0);
  return least.addScaledVector(axis, -least.dot(axis)).normalize();
}
