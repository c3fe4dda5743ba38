// What a part is called beside an answer.

import type { Part } from "./api/types";

/** The part's label; of a stepped hole with all its diameters, as a drawing has them. As render/evidence.py. */
export function told(part: Part): string {
  if (part.kind !== "hole" || part.diameter === null || part.tags.includes("conical")) return part.label;
  const found = [part.diameter, ...part.radii.map((radius) => 2 * radius)].sort((a, b) => a - b);
  const written = [...new Set(found.map((each) => String(Number((1e3 * each).toFixed(2)))))];
  if (written.length < 2) return part.label;
  return part.label.replace(/diameter [\d.]+ mm/, `diameters ${written.slice(0, -1).join(", ")} and ${written.at(-1)} mm`);
}
