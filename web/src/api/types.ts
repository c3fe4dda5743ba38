// What the service sends, as far as the page reads it; openapi.yaml describes all of it. SI units.

export type Vector = readonly [number, number, number];
export type LengthUnit = "mm" | "cm" | "m" | "in";

export interface Failure {
  category: string;
  message: string;
  nearest: string[];
  retryable: boolean;
}

export interface Body {
  id: number;
  name: string;
  color: string | null;
  volume: number;
}

export interface ModelSummary {
  shape: { name: string; extents: Vector; volume: number; area: number; face_count: number; bodies: Body[] };
  body_count: number;
  part_counts: Record<string, number>;
  units: string[];
  warnings: string[];
}

export type ReadingStage = "read" | "measure" | "tessellate" | "look" | "recognise";

export interface ModelResource {
  id: string;
  file_name: string;
  size_bytes: number;
  created: string;
  status: "reading" | "ready" | "failed";
  stage: ReadingStage | null;
  ahead: number | null;
  summary: ModelSummary | null;
  failure: Failure | null;
}

export interface Part {
  id: string;
  kind: string;
  tags: string[];
  label: string;
  faces: number[];
  center: Vector;
  extents: Vector;
  opening: Vector | null;
  tip: Vector | null;
  tips: Vector[];
  axis: Vector | null;
  normal: Vector | null;
  diameter: number | null;
  depth: number | null;
  radius: number | null;
  /** Of the coaxial steps from the opening inwards. */
  radii: number[];
  width: number | null;
  length: number | null;
  height: number | null;
  outer_diameter: number | null;
  inner_diameter: number | null;
  name: string | null;
  evidence: { source: string; confidence: number; reason: string };
}

export interface Face {
  id: number;
  body: number;
  kind: string;
  center: Vector;
  area: number;
  radius: number | null;
  normal: Vector | null;
  axis: Vector | null;
  axis_point: Vector | null;
  part: string;
}

export interface Answer {
  value: unknown;
  type: string;
  unit: string;
  text: string;
}

export interface Alternative {
  codegen: string;
  code: string;
  answer: Answer;
  understood_as: string;
  confidence: number | null;
}

export interface AnswerRecord {
  question: string;
  status: "answered" | "unsure" | "not_grounded" | "failed";
  answer: Answer | null;
  code: string | null;
  codegen: string | null;
  parts: Part[];
  timings_ms: Record<string, number>;
  warnings: string[];
  failure: Failure | null;
  confidence: number | null;
  understood_as: string;
  ignored: string[];
  alternatives: Alternative[];
}

export interface Job {
  id: string;
  model: string;
  question: string;
  unit: LengthUnit;
  status: "queued" | "running" | "done";
  created: string;
  ahead: number | null;
  record: AnswerRecord | null;
}

export interface JobEvent {
  kind: "queued" | "started" | "program" | "ran" | "waiting" | "done";
  message: string;
  record: AnswerRecord | null;
}

export interface RunOutcome {
  status: string;
  message: string;
  used_parts: string[];
}

export interface Column {
  name: string;
  quantity: "text" | "count" | "length" | "area" | "volume" | "angle";
}

export interface Table {
  kind: string;
  columns: Column[];
  rows: (string | number | null)[][];
  ids: string[][];
  parts: number;
}

export const TABLES = ["holes", "slots", "bosses", "edges", "bends", "patterns", "fasteners", "bodies"] as const;
export type TableKind = (typeof TABLES)[number];

export interface Callout {
  text: string;
  kind: string;
  ids: string[];
}

export interface Description {
  name: string;
  size: Vector;
  volume: number;
  area: number;
  bodies: number;
  faces: number;
  declared_units: string[];
  drawn_in: string;
  stands_along: string;
  material_thickness: number | null;
  features: Callout[];
  patterns: Callout[];
  standard_parts: string[];
  warnings: string[];
  questions: string[];
  text: string;
}

export interface Page<T> {
  items: T[];
  total: number;
}

/** What is pointed at while a question is asked. */
export interface Selection {
  parts: string[];
  faces: number[];
}
