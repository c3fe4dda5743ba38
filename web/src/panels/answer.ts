// One question and what came of it: the answer, its readings, its parts, and what it rests on.

import * as api from "../api/client";
import type { AnswerRecord, Job, Part } from "../api/types";
import { announce, download, h, swatch } from "../dom";
import { linkTo } from "../link";
import type { Value } from "../dimensions";
import { lighting } from "../lighting";
import type { Session } from "../session";
import { texts } from "../texts";

const MOST_REASONS = 50;
/** Ids that are told of a group of parts. */
const MOST_IDS = 40;

export class AnswerCard {
  readonly element = h("li", { class: "card" });
  private readonly state = h("p", { class: "quiet", role: "status" });
  private readonly body = h("div");
  private readonly legend = h("ul", { class: "legend" });
  private readonly abort = new AbortController();
  private readonly cancel: HTMLButtonElement;
  private record: AnswerRecord | null = null;
  private begun = false;
  private lightButton: HTMLButtonElement | undefined;

  constructor(
    private readonly session: Session,
    readonly job: Job,
    private readonly took: (card: AnswerCard) => void,
  ) {
    this.cancel = h("button", { type: "button", click: session.guarded(async () => void (await api.cancel(job.id))) }, texts.answer.cancel);
    this.element.id = `answer-${job.id}`;
    this.element.append(h("h3", { tabindex: -1 }, job.question), h("div", { class: "row" }, this.state, this.cancel), this.body);
    session.on("lit", (by) => this.lightButton?.setAttribute("aria-pressed", String(by === job.id)));
  }

  get isDone(): boolean {
    return this.record !== null;
  }

  /** Follows the question to its end, from wherever it is. `fresh`: it was asked just now, and its answer is lit. */
  async run(fresh: boolean): Promise<void> {
    if (this.job.record) return this.fill(this.job.record, false);
    for await (const event of api.follow(this.job.id, this.abort.signal)) {
      if (event.kind === "done") {
        if (event.record) this.fill(event.record, fresh);
        return;
      }
      this.begun = event.kind !== "queued";
      if (!this.begun) void this.tellPlace();
      else this.state.textContent = `${event.message || texts.answer.steps[event.kind as keyof typeof texts.answer.steps]} …`;
    }
    const { record } = await api.job(this.job.id); // all was told before
    if (record) this.fill(record, fresh);
  }

  /** Nobody looks at it any more. */
  close(): void {
    this.abort.abort();
  }

  /** Lights the answer's parts. */
  light(): void {
    const { record, session } = this;
    if (!record) return;
    session.light(this.job.id, record.parts, this.valueOf(record));
    this.explain(record.parts);
    this.took(this);
  }

  focus(): void {
    this.element.scrollIntoView({ block: "nearest" });
    this.element.querySelector("h3")?.focus({ preventScroll: true });
  }

  private valueOf(record: AnswerRecord): Value | undefined {
    const whole = this.session.model?.summary?.shape.extents;
    return record.answer ? { text: firstReading(record), answer: record.answer, ...(whole ? { whole } : {}) } : undefined;
  }

  private async tellPlace(): Promise<void> {
    const { status, ahead } = await api.job(this.job.id).catch(() => this.job);
    if (!this.begun && status === "queued") this.state.textContent = texts.answer.queued(ahead);
  }

  private fill(record: AnswerRecord, fresh: boolean): void {
    [this.record, this.begun] = [record, true];
    this.cancel.remove();
    this.session.learn(record.parts);
    const { answer, failure } = record;
    this.state.textContent = [
      answer && record.understood_as ? texts.answer.understood(record.understood_as) : "",
      answer && record.confidence !== null ? texts.answer.confidence(record.confidence) : "",
    ]
      .filter(Boolean)
      .join(" · ");
    this.explain(record.parts);
    const text = answer?.text ?? failure?.message ?? texts.answer.noAnswer;
    const nearest = failure?.nearest?.length ? ` ${texts.answer.nearest(failure.nearest.join(", "))}` : "";
    const content = h(
      "div",
      {},
      record.status === "unsure"
        ? this.readings(record, texts.answer.unsure)
        : h("p", { class: answer ? "answer" : "answer failed" }, `${text}${nearest}`),
      this.notes(record),
      this.legend,
      answer && this.actions(record),
      record.status !== "unsure" && record.alternatives.length > 0 && this.otherReadings(record),
      record.code !== null && this.evidence(record),
    );
    this.body.replaceChildren(content);
    if (fresh) {
      announce(`${record.question} ${text}${nearest}`);
      this.light();
    }
  }

  private notes(record: AnswerRecord): HTMLElement | null {
    const lines = [...record.warnings, ...(record.ignored.length ? [texts.answer.ignored(record.ignored.join(", "))] : [])];
    return lines.length ? h("ul", { class: "notes" }, ...lines.map((line) => h("li", {}, line))) : null;
  }

  /** The readings of a question that may mean several things: a button each, which shows its parts. */
  private readings(record: AnswerRecord, title: string): HTMLElement {
    const all = [
      { ...record, answer: record.answer, text: firstReading(record) },
      ...record.alternatives.map((each) => ({ ...each, text: each.answer.text })),
    ];
    const buttons = all.map((reading, index) =>
      h(
        "button",
        {
          type: "button",
          class: "reading",
          "aria-pressed": String(index === 0),
          click: this.session.guarded(async () => {
            buttons.forEach((button, place) => button.setAttribute("aria-pressed", String(place === index)));
            if (index === 0) return this.light();
            const parts = await this.partsOf(reading.code);
            this.session.light(`${this.job.id}-${index}`, parts, reading.answer ? { text: reading.text, answer: reading.answer } : undefined);
            this.explain(parts);
          }),
        },
        h("strong", {}, reading.text),
        h(
          "span",
          {},
          [reading.understood_as, reading.confidence === null ? "" : texts.answer.confidence(reading.confidence)].filter(Boolean).join(" · "),
        ),
      ),
    );
    return h("div", { role: "group", class: "readings" }, h("p", {}, title), ...buttons);
  }

  /** What the question may mean beside what was answered: folded, since it is less likely. */
  private otherReadings(record: AnswerRecord): HTMLElement {
    return h("details", {}, h("summary", {}, texts.answer.others(record.alternatives.length)), this.readings(record, texts.answer.choose));
  }

  /** The parts that another reading rests on: its program tells. */
  private async partsOf(code: string | null): Promise<Part[]> {
    if (!code) return [];
    const outcome = await api.run(this.job.model, code);
    return this.session.parts([...new Set(outcome.used_parts)]);
  }

  /** Says what each colour stands for. */
  private explain(parts: readonly Part[]): void {
    const rows = lighting(parts).groups.map(({ color, label, parts: own }) => {
      const [faces, ids] = [own.flatMap((part) => part.faces), own.map((part) => part.id)];
      const point = (): void => this.session.point(faces);
      const away = (): void => this.session.point(undefined);
      const select = (): void => this.session.select({ parts: ids, faces: [] }, faces);
      const attributes = { type: "button", class: "plain", title: ids.slice(0, MOST_IDS).join(", ") };
      const listeners = { click: select, mouseenter: point, mouseleave: away, focus: point, blur: away };
      return h("li", {}, h("button", { ...attributes, ...listeners }, swatch(color), h("span", {}, label)));
    });
    this.legend.hidden = !rows.length;
    this.legend.replaceChildren(...rows);
  }

  private actions(record: AnswerRecord): HTMLElement {
    const name = `answer-${this.job.id.slice(0, 8)}`;
    const lit = h("button", { type: "button", "aria-pressed": "false", click: () => this.light() }, texts.answer.light);
    this.lightButton = lit;
    const link = async (): Promise<void> => {
      await navigator.clipboard.writeText(linkTo({ model: this.job.model, answer: this.job.id }));
      announce(texts.answer.linked);
    };
    return h(
      "div",
      { class: "row actions" },
      lit,
      h("button", { type: "button", click: this.session.guarded(link) }, texts.answer.link),
      h("button", { type: "button", click: () => download(`${name}.json`, JSON.stringify(record, null, 2), "application/json") }, "JSON"),
      h("button", { type: "button", click: () => download(`${name}.csv`, csvOf(record), "text/csv") }, "CSV"),
      h(
        "button",
        {
          type: "button",
          click: this.session.guarded(async () => download(`${name}.png`, await api.picture(this.job.model, this.job.id))),
        },
        "PNG",
      ),
    );
  }

  private evidence(record: AnswerRecord): HTMLElement {
    const reasons = [...new Set(record.parts.map((part) => part.evidence.reason).filter(Boolean))].slice(0, MOST_REASONS);
    const spent = Object.entries(record.timings_ms).map(([step, ms]) => `${step} ${ms.toFixed(1)} ms`);
    const picture = h("img", { alt: texts.answer.pictureOf(record.question), class: "picture", hidden: true });
    const details = h(
      "details",
      {
        toggle: this.session.guarded(async () => {
          if (!details.open || !picture.hidden || !record.answer) return; // drawn when somebody looks: it takes a moment
          picture.src = URL.createObjectURL(await api.picture(this.job.model, this.job.id));
          picture.hidden = false;
        }),
      },
      h("summary", {}, texts.answer.evidence),
      picture,
      h("h4", {}, texts.answer.program(record.codegen ?? "")),
      h("pre", { tabindex: 0 }, record.code ?? ""),
      reasons.length > 0 && h("h4", {}, texts.answer.reason),
      reasons.length > 0 && h("ul", {}, ...reasons.map((reason) => h("li", {}, reason))),
      h("h4", {}, texts.answer.timings),
      h("p", {}, spent.join(" · ")),
    );
    return details;
  }
}

/** The likeliest of several readings' answers. The service's text names the others after it: each has a button here. */
function firstReading({ answer, understood_as: understood }: AnswerRecord): string {
  const text = answer?.text ?? "";
  const end = text.indexOf(` (${understood})`);
  return text.startsWith("perhaps ") && end > 0 ? text.slice("perhaps ".length, end) : text;
}

/** The answer and its parts, a row each; SI units. */
function csvOf(record: AnswerRecord): string {
  const cell = (value: unknown): string => {
    const text = value === null || value === undefined ? "" : String(value);
    return /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
  };
  const measures = ["diameter", "depth", "length", "width", "height"] as const;
  const rows = [
    ["question", record.question],
    ["answer", record.answer?.text],
    ["confidence", record.confidence],
    [],
    ["id", "kind", "label", ...["x", "y", "z", ...measures].map((name) => `${name} [m]`)],
    ...record.parts.map((part) => [part.id, part.kind, part.label, ...part.center, ...measures.map((name) => part[name])]),
  ];
  return `${rows.map((row) => row.map(cell).join(",")).join("\n")}\n`;
}
