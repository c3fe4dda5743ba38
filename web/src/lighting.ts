// How an answer's parts are shown: like ones in one colour, with labels while there are few of them.

import { Vector3 } from "three";
import type { LengthUnit, Part } from "./api/types";
import { dimensionsOf, type Value } from "./dimensions";
import { told } from "./told";
import type { Model } from "./viewer/model";
import type { Dimension, Label } from "./viewer/overlay";

/** Okabe and Ito, 2008: told apart by nearly everybody, whatever colours they see. */
const COLORS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00", "#8a6fd1"] as const;
/** More parts than this get no label each; in a view as narrow as a phone's, more than that. */
const MOST_LABELS = 20;
const MOST_NARROW_LABELS = 4;
const MOST_GROUP_LABELS = 8;
const VALUE_CHARS = 40;
/** Another part within a part's label: 'counterbore of hole 3'. */
const ID = / of [a-z]+[- ][a-z]?\d+(\.\d+)*/g;

export interface Group {
  readonly color: string;
  readonly label: string;
  readonly parts: readonly Part[];
}

export interface Lighting {
  readonly groups: readonly Group[];
  readonly labels: readonly Label[];
  readonly dimensions: readonly Dimension[];
}

/**
 * Groups of like parts, and what is written beside them. The model itself is not lit.
 *
 * `value`: what was answered, in `unit`. `narrow`: there is hardly room for labels beside the model.
 */
export function lighting(parts: readonly Part[], model?: Model, value?: Value, unit: LengthUnit = "mm", narrow = false): Lighting {
  const shown = parts.filter((part) => part.kind !== "model" && part.faces.length);
  const groups = groupsOf(shown);
  if (!model) return { groups, labels: [], dimensions: [] };
  const found = value ? dimensionsOf(shown.length ? shown : parts, value, model, unit) : [];
  const dimensions = narrow && found.length > MOST_NARROW_LABELS ? [] : found;
  return { groups, labels: dimensions.length ? [] : labelsOf(groups, shown, value?.text, model, narrow), dimensions };
}

function groupsOf(parts: readonly Part[]): Group[] {
  const alike = new Map<string, Part[]>();
  for (const part of parts) {
    const key = `${part.kind}|${told(part).replace(ID, "")}`;
    alike.set(key, [...(alike.get(key) ?? []), part]);
  }
  return [...alike.values()].map((own, index) => ({
    color: COLORS[index % COLORS.length]!,
    label: own.length > 1 ? `${own.length}× ${told(own[0]!).replace(ID, "")}` : told(own[0]!),
    parts: own,
  }));
}

function labelsOf(groups: readonly Group[], parts: readonly Part[], value: string | undefined, model: Model, narrow: boolean): Label[] {
  const at = (part: Part): Vector3 => model.fromMetres(part.opening ?? part.tip ?? part.center);
  if (parts.length === 1 && value && value.length <= VALUE_CHARS) {
    return [{ at: at(parts[0]!), text: `${parts[0]!.name ?? parts[0]!.id}: ${value}`, color: groups[0]!.color }];
  }
  if (parts.length <= (narrow ? MOST_NARROW_LABELS : MOST_LABELS)) {
    return groups.flatMap(({ color, parts: own }) => own.map((part) => ({ at: at(part), text: part.name ?? part.id, color })));
  }
  if (narrow || groups.length > MOST_GROUP_LABELS) return [];
  return groups.map(({ color, label, parts: own }) => ({ at: at(own[0]!), text: short(label), color }));
}

const short = (text: string): string => (text.length > VALUE_CHARS ? `${text.slice(0, VALUE_CHARS - 1)}…` : text);
