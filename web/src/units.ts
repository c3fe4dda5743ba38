// Values as people read them. What comes from the service is SI.

import type { LengthUnit } from "./api/types";

const METRES: Record<LengthUnit, number> = { mm: 1e-3, cm: 1e-2, m: 1, in: 0.0254 };
const RAISED = ["", "", "²", "³"];
const DIGITS = 5;

/** A number with at most five significant digits, as the service writes it. */
export function plain(value: number): string {
  if (Math.abs(value) < 1e-12) return "0";
  return String(Number(value.toPrecision(DIGITS)));
}

/** A length, area or volume (power 1, 2, 3) with its unit. */
export function measure(value: number, unit: LengthUnit, power: 1 | 2 | 3 = 1): string {
  return `${plain(value / METRES[unit] ** power)} ${unit}${RAISED[power]}`;
}

/** The number alone, for a table whose head names the unit. */
export const bare = (value: number, unit: LengthUnit, power: 1 | 2 | 3 = 1): string => plain(value / METRES[unit] ** power);

/** The name of a unit to a power. */
export const unitName = (unit: LengthUnit, power: 1 | 2 | 3): string => `${unit}${RAISED[power]}`;

export const degrees = (radians: number): string => `${plain((radians * 180) / Math.PI)}°`;

export function bytes(size: number): string {
  if (size < 1024) return `${size} B`;
  return size < 1024 ** 2 ? `${Math.round(size / 1024)} KiB` : `${(size / 1024 ** 2).toFixed(1)} MiB`;
}
