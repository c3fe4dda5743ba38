// Measuring by two clicks: from point to point, and between two faces where they have a distance or an angle.

import { Vector3 } from "three";
import type { Face, LengthUnit } from "../api/types";
import { texts } from "../texts";
import { degrees, measure } from "../units";

/** Directions count as parallel within a hundredth of a degree. */
const PARALLEL = Math.cos((0.01 * Math.PI) / 180);

/** Places are of single precision: what is less than this share of them is how they were stored. */
const SINGLE = 2 ** -22;

/** What was clicked: a place in metres, what it is called if it was snapped to, else the face that it is on. */
export interface Clicked {
  readonly place: Vector3;
  readonly name: string;
  readonly face: Face | undefined;
}

/** What there is between two clicks: the distance, and a sentence for each thing that there is. */
export function measured(from: Clicked, to: Clicked, unit: LengthUnit): { distance: string; said: string[] } {
  const apart = to.place.clone().sub(from.place);
  const noise = SINGLE * Math.max(from.place.length(), to.place.length());
  const size = (value: number): string => measure(Math.abs(value) < noise ? 0 : Math.abs(value), unit);
  const distance = size(apart.length());
  const points = texts.measured.points(distance, from.name, to.name, size(apart.x), size(apart.y), size(apart.z));
  return { distance, said: [points, ...(from.face && to.face ? between(from.face, to.face, size) : [])] };
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
