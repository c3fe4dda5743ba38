// What the parts of the page share: the model that is open, the unit, what is selected, what is lit.

import type { ModelResource, LengthUnit, Part, Selection } from "./api/types";
import * as api from "./api/client";
import { Problem } from "./api/client";
import type { Value } from "./dimensions";
import { lighting } from "./lighting";
import type { Overlay } from "./viewer/overlay";
import type { Viewer } from "./viewer/viewer";

interface Events {
  /** Another model is open, or none; its file has been read, or could not be. */
  model: ModelResource | undefined;
  /** The model is drawn, and can be lit. */
  drawn: undefined;
  unit: LengthUnit;
  selection: Selection;
  /** Whose parts are lit: a name that whoever lit them knows. */
  lit: string;
  /** Something went wrong that belongs to no place of its own; empty: it is over. */
  trouble: string;
  /** A question is to be asked, or written for the user to go on. */
  question: { text: string; send: boolean };
}

interface Shown {
  readonly by: string;
  readonly parts: readonly Part[];
  readonly value?: Value;
}

type Listener<T> = (value: T) => void;

const NOTHING: Selection = { parts: [], faces: [] };
const SELECTED = "#f0a500";

export class Session {
  model: ModelResource | undefined;
  unit: LengthUnit = "mm";
  selection: Selection = NOTHING;
  viewer: Viewer | undefined;
  overlay: Overlay | undefined;
  private shown: Shown = { by: "", parts: [] };
  private readonly listeners = new Map<keyof Events, Listener<never>[]>();
  private readonly known = new Map<string, Part>();

  on<K extends keyof Events>(name: K, listener: Listener<Events[K]>): void {
    this.listeners.set(name, [...(this.listeners.get(name) ?? []), listener as Listener<never>]);
  }

  emit<K extends keyof Events>(name: K, value: Events[K]): void {
    for (const listener of this.listeners.get(name) ?? []) (listener as Listener<Events[K]>)(value);
  }

  open(model: ModelResource | undefined): void {
    if (model?.id !== this.model?.id) this.known.clear();
    this.model = model;
    this.select(NOTHING);
    this.light("", []);
    this.emit("model", model);
  }

  setUnit(unit: LengthUnit): void {
    this.unit = unit;
    this.emit("unit", unit);
  }

  select(selection: Selection, faces: readonly number[] = selection.faces): void {
    this.selection = selection;
    this.viewer?.point(faces.length ? { color: SELECTED, faces } : undefined);
    this.emit("selection", selection);
  }

  /** Lights parts in groups of like ones, with labels; `by` names who does. No parts: lights nothing. */
  light(by: string, parts: readonly Part[], value?: Value): void {
    this.shown = value ? { by, parts, value } : { by, parts };
    this.relight();
  }

  /** Lights what is to be lit on the model as it is drawn now: an answer may be there before its model is. */
  relight(): void {
    const { by, parts, value } = this.shown;
    const { groups, labels, dimensions } = lighting(parts, this.viewer?.model, value, this.unit, this.viewer?.isNarrow);
    this.viewer?.light(groups.map(({ color, parts: own }) => ({ color, faces: own.flatMap((part) => part.faces) })));
    this.overlay?.write(labels, dimensions);
    this.emit("lit", parts.length ? by : "");
  }

  /** Points at faces for as long as something that means them is under the pointer; none: at the selection again. */
  point(faces: readonly number[] | undefined): void {
    const wanted = faces ?? this.selected;
    this.viewer?.point(wanted.length ? { color: SELECTED, faces: wanted } : undefined);
  }

  /** The parts of these ids, each asked for once. */
  async parts(ids: readonly string[]): Promise<Part[]> {
    const model = this.model;
    if (!model) return [];
    const missing = ids.filter((id) => !this.known.has(id));
    if (missing.length) this.learn(await api.parts(model.id, missing));
    return ids.flatMap((id) => this.known.get(id) ?? []);
  }

  learn(parts: readonly Part[]): void {
    parts.forEach((part) => this.known.set(part.id, part));
  }

  /** Runs what an event asks for; what goes wrong is told to the user. */
  guarded<A extends unknown[]>(work: (...given: A) => Promise<void> | void): (...given: A) => void {
    return (...given) => {
      void (async () => {
        try {
          await work(...given);
        } catch (error) {
          if (error instanceof DOMException && error.name === "AbortError") return;
          if (error instanceof Problem && error.status === 401) return; // the sign-in field is shown
          if (!(error instanceof Problem)) console.error(error);
          this.emit("trouble", error instanceof Error ? error.message : String(error));
        }
      })();
    };
  }

  private get selected(): readonly number[] {
    const ofParts = this.selection.parts.flatMap((id) => this.known.get(id)?.faces ?? []);
    return ofParts.length ? ofParts : this.selection.faces;
  }
}
