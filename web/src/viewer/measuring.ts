// Measuring by two clicks: from point to point, and between the two faces where they have a distance or an angle.

import { Vector3 } from "three";
import type { Face, LengthUnit } from "../api/types";
import { texts } from "../texts";
import { degrees, measure } from "../units";

/** Directions count as parallel within a hundredth of a degree. */
const PARALLEL = Math.cos((0.01 * Math.PI) / 180);

/** What there is between two points (metres) on two faces: the distance, and a sentence for each thing that there is. */
export function measured(from: Vector3, to: Vector3, first: Face, second: Face, unit: LengthUnit): { distance: string; said: string[] } {
  const apart = to.clone().sub(from);
  const size = (value: number): string => measure(Math.abs(value), unit);
  const distance = size(apart.length());
  const points = texts.measured.points(distance, size(apart.x), size(apart.y), size(apart.z));
  return { distance, said: [points, ...between(first, second, size)] };
}

function between(first: Face, second: Face, size: (value: number) => string): string[] {
  if (first.id === second.id) return [];
  if (first.normal && second.normal) {
    const [a, b] = [new Vector3(...first.normal), new Vector3(...second.normal)];
    const cosine = Math.min(1, Math.abs(a.dot(b)));
    if (cosine < PARALLEL) return [texts.measured.angle(degrees(Math.acos(cosine)))];
    return [texts.measured.planes(size(new Vector3(...second.center).sub(new Vector3(...first.center)).dot(a)))];
  }
  if (first.axis && second.axis && first.axis_point && second.axis_point) {
    const axis = new Vector3(...first.axis);
    if (Math.abs(axis.dot(new Vector3(...second.axis))) < PARALLEL) return [];
    const apart = new Vector3(...second.axis_point).sub(new Vector3(...first.axis_point));
    return [texts.measured.axes(size(apart.addScaledVector(axis, -apart.dot(axis)).length()))];
  }
  return [];
}
