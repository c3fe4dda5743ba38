// Questions and answers: what is asked now, with what is selected and what was asked before; and earlier questions.

import * as api from "../api/client";
import type { Job } from "../api/types";
import { announce, byId, h } from "../dom";
import type { Session } from "../session";
import { texts } from "../texts";
import { AnswerCard } from "./answer";

/** Questions of a conversation that go along with the next one: the service takes 20 at most. */
const MOST_CONTEXT = 10;
const MOST_SUGGESTED = 6;

export class Conversation {
  readonly top = h("div");
  private readonly list = h("ol", { class: "cards", "aria-label": texts.tabs.ask });
  private readonly suggestions = h("details", { class: "suggestions", open: true });
  private readonly follows = h("div", { class: "row quiet" });
  private readonly question = h("input", { id: "question", maxlength: 2000, placeholder: texts.ask.placeholder, autocomplete: "off", required: true });
  private readonly form: HTMLFormElement;
  private readonly more = h("button", { type: "button", hidden: true }, texts.ask.more);
  private cards: AnswerCard[] = [];
  private context: string[] = [];
  /** How many of the model's questions are in the list. */
  private known = 0;
  /** Asked before there was a model: the one that is opened next is meant. */
  private waiting = "";

  constructor(
    panel: HTMLElement,
    private readonly session: Session,
    private readonly litAnswer: (job: string) => void,
  ) {
    this.form = h(
      "form",
      { class: "ask" },
      h("label", { for: "question" }, texts.ask.label),
      h("div", { class: "row" }, this.question, h("button", { class: "primary" }, texts.ask.button)),
    );
    panel.append(this.top, this.form, this.follows, this.suggestions, this.list, this.more);
    this.form.addEventListener("submit", (event) => {
      event.preventDefault();
      session.guarded(() => this.ask(this.question.value.trim()))();
    });
    this.more.addEventListener("click", session.guarded(() => this.load()));
    session.on("question", ({ text, send }) => {
      this.question.value = text;
      if (send) session.guarded(() => this.ask(text))();
      else this.question.focus();
    });
  }

  /** Shows what was asked about the model that is open; `answer`: the one to light. */
  async show(answer?: string): Promise<void> {
    const { model } = this.session;
    this.cards.forEach((card) => card.close());
    [this.cards, this.known] = [[], 0];
    this.list.replaceChildren();
    this.suggestions.hidden = true;
    this.suggestions.open = true;
    this.more.hidden = true;
    this.context = model ? (JSON.parse(sessionStorage.getItem(`context-${model.id}`) ?? "[]") as string[]) : [];
    this.tellContext();
    const open = model !== undefined && model.status !== "failed";
    for (const input of this.form.querySelectorAll<HTMLInputElement>("input, button")) input.disabled = !open;
    if (!model) return;
    const waiting = open ? this.waiting : "";
    this.waiting = "";
    await Promise.all([this.load(answer), waiting ? this.ask(waiting) : undefined]);
  }

  suggest(questions: readonly string[]): void {
    if (!questions.length) return;
    const chips = questions
      .slice(0, MOST_SUGGESTED)
      .map((text) => h("li", {}, h("button", { type: "button", click: () => this.session.emit("question", { text, send: true }) }, text)));
    this.suggestions.replaceChildren(h("summary", { class: "quiet" }, texts.ask.suggested), h("ul", { class: "chips" }, ...chips));
    this.suggestions.hidden = false;
  }

  private async load(answer?: string): Promise<void> {
    const { model } = this.session;
    if (!model) return;
    const page = await api.answers(model.id, this.known);
    if (this.session.model?.id !== model.id) return;
    const known = new Set(this.cards.map((card) => card.job.id));
    const added = page.items.filter((job) => !known.has(job.id)).map((job) => this.card(job));
    this.known += page.items.length;
    this.cards.push(...added);
    this.list.append(...added.map((card) => card.element));
    this.more.hidden = this.known >= page.total;
    const newest = page.items[0]?.id;
    await Promise.all(
      added.map((card) =>
        card.run(card.job.id === answer || (!card.job.record && card.job.id === newest)).catch((error: unknown) => this.lost(error)),
      ),
    );
    const wanted = this.cards.find((card) => card.job.id === answer);
    if (wanted) {
      wanted.light();
      wanted.focus();
    }
  }

  private async ask(question: string): Promise<void> {
    const { model, selection, unit } = this.session;
    if (!question) return;
    if (!model) {
      this.waiting = question;
      this.tell(texts.ask.waits);
      return;
    }
    const selected = selection.parts.length || selection.faces.length;
    const asked = {
      question,
      unit,
      context: this.context.slice(-MOST_CONTEXT),
      ...(selected ? { selection: selection.parts.length ? { parts: selection.parts, faces: [] } : selection } : {}),
    };
    const job = await api.ask(model.id, asked);
    this.session.emit("trouble", "");
    this.question.value = "";
    if (this.session.model?.id !== model.id) return; // it stands with its model's other questions
    this.context.push(question);
    sessionStorage.setItem(`context-${model.id}`, JSON.stringify(this.context));
    this.tellContext();
    const listed = this.cards.find((card) => card.job.id === job.id); // the list was asked for at the same time
    const card = listed ?? this.card(job);
    if (!listed) {
      this.cards.unshift(card);
      this.known += 1;
      this.list.prepend(card.element);
    }
    this.suggestions.open = false; // the answer stands where they stood
    byId("tabs").querySelector<HTMLElement>("[data-tab=ask]")?.click();
    if (!listed) await card.run(true).catch((error: unknown) => this.lost(error));
  }

  /** Says something where it is told which questions the next one follows. */
  private tell(text: string): void {
    this.follows.hidden = false;
    this.follows.replaceChildren(h("span", {}, text));
    announce(text);
  }

  private card(job: Job): AnswerCard {
    return new AnswerCard(this.session, job, (card) => this.litAnswer(card.job.id));
  }

  private lost(error: unknown): void {
    if (error instanceof DOMException && error.name === "AbortError") return;
    this.session.emit("trouble", error instanceof Error ? error.message : String(error));
  }

  private tellContext(): void {
    const { model } = this.session;
    const fresh = (): void => {
      this.context = [];
      if (model) sessionStorage.removeItem(`context-${model.id}`);
      this.tellContext();
    };
    this.follows.hidden = !this.context.length;
    this.follows.replaceChildren(
      h("span", {}, texts.ask.follows(this.context.length)),
      h("button", { type: "button", class: "plain", click: fresh }, texts.ask.fresh),
    );
  }
}
