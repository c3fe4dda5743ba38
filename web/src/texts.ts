// Every text of the page, in one place.

import type { ReadingStage, TableKind } from "./api/types";
import type { Side } from "./viewer/sides";

const count = (number: number, one: string, many = `${one}s`): string => `${number} ${number === 1 ? one : many}`;

export const texts = {
  away: "The service does not answer. Is it running?",
  noSense: (status: number): string => `The service answered ${status}, and did not say why.`,
  noWebGl: "This browser shows no 3D (WebGL 2 is missing or switched off). Questions, tables and pictures work without it.",
  dismiss: "Close",

  signIn: {
    label: "API key",
    hint: "This service asks for a key. It stays in this browser tab.",
    button: "Sign in",
    wrong: "This key is not valid here.",
    out: "Sign out",
  },

  files: {
    choose: "Add CAD files",
    drop: "STEP, IGES, BREP, STL, OBJ, 3MF, or zipped; several at once",
    uploading: (percent: number): string => `sending, ${percent} %`,
    ahead: (number: number | null): string =>
      number === null ? "waiting to be read" : number === 0 ? "waiting: next to be read" : `waiting: ${count(number, "file")} before it`,
    stage: {
      read: "reading the file (1 of 5)",
      measure: "measuring its faces (2 of 5)",
      tessellate: "making triangles (3 of 5)",
      look: "looking from all sides (4 of 5)",
      recognise: "recognising features (5 of 5)",
    } satisfies Record<ReadingStage, string>,
    ready: "ready",
    failed: (why: string): string => `not read: ${why}`,
    refused: (why: string): string => `refused: ${why}`,
    stopped: "stopped",
    cancel: (name: string): string => `Stop ${name}`,
    remove: (name: string): string => `Delete ${name} and its answers`,
    sure: (name: string): string => `Delete ${name} with all questions and answers?`,
    dismiss: (name: string): string => `Forget that ${name} failed`,
    empty: "No models yet. Add a STEP file, or one of the other kinds, to begin.",
    outcome: (good: number, bad: number): string =>
      bad ? `${count(good, "file")} taken, ${count(bad, "file")} not: see the list` : `${count(good, "file")} taken`,
  },

  bodies: {
    title: (number: number): string => count(number, "body", "bodies"),
    filter: "Find a body",
    all: "Show all",
    none: "Hide all",
    onlyShort: "only",
    only: (name: string): string => `Show only ${name}`,
  },

  view: {
    label: (name: string, lit: string): string =>
      `${name} in 3D${lit ? `; lit: ${lit}` : ""}. Arrow keys turn, with Shift they move, plus and minus zoom, digits 0 to 6 are the sides.`,
    empty: "Open a model to see it here.",
    loading: "Loading the model …",
    sides: {
      isometric: "Isometric",
      front: "Front",
      back: "Back",
      left: "Left",
      right: "Right",
      top: "Top",
      bottom: "Bottom",
    } satisfies Record<Side, string>,
    sideGroup: "Look from",
    key: (name: string, key: string): string => `${name} (key ${key})`,
    fit: "Fit",
    edges: "Edges",
    transparent: "Transparent",
    measure: "Measure",
    section: "Section",
    sectionNone: "none",
    sectionAt: "Where the section is",
    sectionFlip: "Other half",
    unit: "Unit of lengths",
    picture: "Save picture",
    link: "Copy link",
    linkCopied: "The link to this view is copied.",
    measureFirst: "Measure: click the first point. Corners, middles of edges and circles snap. Escape ends it.",
    measureSecond: (name: string): string => `${name ? `From the ${name}. ` : ""}Click the second point.`,
  },

  measured: {
    points: (distance: string, from: string, to: string, x: string, y: string, z: string): string =>
      `${distance} between ${from || to ? `the ${from || "point"} and the ${to || "point"}` : "the points"} (x ${x}, y ${y}, z ${z})`,
    corner: "corner",
    middle: "middle of an edge",
    center: (diameter: string): string => `centre of Ø ${diameter}`,
    planes: (distance: string): string => `parallel faces: ${distance} apart`,
    axes: (distance: string): string => `parallel axes: ${distance} apart`,
    angle: (angle: string): string => `the faces stand at ${angle}`,
  },

  tabs: { ask: "Ask", holes: "Holes", bodies: "Bill of material", description: "Description" },

  ask: {
    label: "Question",
    placeholder: "How many holes are there?",
    button: "Ask",
    suggested: "You may ask",
    clear: "Clear selection",
    follows: (number: number): string => `Follows ${count(number, "question")} of this conversation: “and how deep are they?” works.`,
    fresh: "New conversation",
    more: "Earlier questions",
    waits: "Asked as soon as a model is open.",
  },

  selection: {
    face: (id: number, kind: string): string => `face ${id}, ${kind}`,
    radius: (text: string): string => `radius ${text}`,
    area: (text: string): string => `area ${text}`,
    body: (name: string): string => `of ${name}`,
    questions: {
      what: (name: string): string => `What is ${name}?`,
      diameter: "What is its diameter?",
      depth: "How deep is it?",
      size: "How large is it?",
      area: "What is its area?",
      radius: "What is its radius?",
      volume: "What is its volume?",
    },
  },

  answer: {
    queued: (ahead: number | null): string => (ahead ? `waiting, ${count(ahead, "question")} before it` : "waiting"),
    steps: {
      started: "reading the question",
      program: "program written",
      ran: "program run",
      waiting: "waiting",
      done: "done",
    },
    cancel: "Cancel",
    nearest: (words: string): string => `Known here: ${words}.`,
    understood: (what: string): string => `understood as: ${what}`,
    confidence: (share: number): string => `${Math.round(share * 100)} % sure`,
    unsure: "Not sure which is meant. Choose a reading:",
    others: (number: number): string => count(number, "other reading"),
    choose: "What else may be meant:",
    ignored: (words: string): string => `not taken into account: ${words}`,
    light: "Show on the model",
    link: "Copy link",
    linked: "The link to this answer is copied.",
    evidence: "Evidence",
    program: (by: string): string => `Program, written by ${by}`,
    timings: "Timings",
    reason: "Why these parts",
    pictureOf: (question: string): string => `The model with the parts marked that answer: ${question}`,
    noAnswer: "There is no answer.",
  },

  tables: {
    kind: "Table",
    kinds: {
      holes: "Holes",
      slots: "Slots and pockets",
      bosses: "Bosses and ribs",
      edges: "Fillets and chamfers",
      bends: "Bends",
      patterns: "Patterns",
      fasteners: "Fasteners",
      bodies: "Bodies",
    } satisfies Record<TableKind, string>,
    grouped: "Like ones in one row",
    csv: "CSV",
    none: (name: string): string => `The model has none: ${name.toLowerCase()}.`,
    caption: (name: string, rows: number, parts: number): string => `${name}: ${count(parts, "part")} in ${count(rows, "row")}`,
    more: (number: number): string => `Show ${number} more rows`,
    row: (name: string): string => `Show ${name} on the model`,
    loading: "Loading …",
  },

  description: {
    size: "Size (x, y, z)",
    volume: "Volume",
    area: "Surface",
    bodies: "Bodies",
    faces: "Faces",
    declared: "Units in the file",
    drawn: "Likely drawn in",
    stands: "Likely upright axis",
    thickness: "Material thickness",
    features: "Features",
    patterns: "Patterns",
    standard: "Standard parts",
    warnings: "Notes on the file",
    loading: "Looking at the model …",
  },

  model: {
    size: (extents: string, bodies: number, faces: number): string =>
      `${extents} · ${count(bodies, "body", "bodies")} · ${count(faces, "face")}`,
    exportAll: "Export all",
    pending: "The file is being read.",
  },
} as const;
