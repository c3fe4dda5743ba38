// What was clicked: which face and which part it is, and questions that suit it.

import * as api from "../api/client";
import type { Face, Part } from "../api/types";
import { h } from "../dom";
import type { Session } from "../session";
import { texts } from "../texts";
import { told } from "../told";
import { measure } from "../units";
import type { Hit } from "../viewer/viewer";

export class SelectionBox {
  private readonly box = h("div", { class: "selection", hidden: true });

  constructor(
    holder: HTMLElement,
    private readonly session: Session,
  ) {
    holder.append(this.box);
    session.on("selection", ({ parts, faces }) => {
      if (!parts.length && !faces.length) this.box.hidden = true;
    });
  }

  /** Selects the part that a face belongs to, and tells what it is; undefined: nothing. */
  async click(hit: Hit | undefined): Promise<void> {
    const { session } = this;
    if (!hit || !session.model) return session.select({ parts: [], faces: [] });
    session.select({ parts: [], faces: [hit.face] }); // at once, whatever it turns out to be
    const [face] = await api.faces(session.model.id, [hit.face]);
    if (!face || session.selection.faces[0] !== hit.face) return;
    const [part] = await session.parts([face.part]);
    const isFeature = part !== undefined && part.kind !== "body" && part.kind !== "model";
    session.select({ parts: isFeature ? [part.id] : [], faces: [face.id] }, isFeature ? part.faces : [face.id]);
    this.show(face, part, isFeature);
  }

  /** Selects parts by their ids: the rows of a table. */
  async choose(ids: readonly string[]): Promise<void> {
    const parts = await this.session.parts(ids);
    this.session.select(
      { parts: parts.map((part) => part.id), faces: [] },
      parts.flatMap((part) => part.faces),
    );
    const [part] = parts;
    if (!part) return;
    const name = parts.length > 1 ? `${parts.length}× ${told(part)}` : `${part.id}, ${told(part)}`;
    this.render(name, [], parts.length > 1 ? [] : suited(part, undefined));
  }

  private show(face: Face, part: Part | undefined, isFeature: boolean): void {
    const { unit, viewer } = this.session;
    const body = viewer?.model?.bodies.find((each) => each.id === face.body)?.name;
    const facts = [
      isFeature && texts.selection.face(face.id, face.kind),
      face.radius !== null && texts.selection.radius(measure(face.radius, unit)),
      texts.selection.area(measure(face.area, unit, 2)),
      body && texts.selection.body(body),
    ].filter((fact) => typeof fact === "string" && fact !== "") as string[];
    const name = isFeature ? `${part!.id}, ${told(part!)}` : texts.selection.face(face.id, face.kind);
    this.render(name, facts, suited(isFeature ? part : undefined, face));
  }

  private render(name: string, facts: readonly string[], questions: readonly string[]): void {
    const { session } = this;
    this.box.hidden = false;
    this.box.replaceChildren(
      h(
        "div",
        { class: "row" },
        h("strong", {}, name),
        h(
          "button",
          { type: "button", class: "plain", "aria-label": texts.ask.clear, title: texts.ask.clear, click: () => session.select({ parts: [], faces: [] }) },
          "×",
        ),
      ),
      h("p", { class: "quiet" }, facts.join(" · ")),
      h(
        "ul",
        { class: "chips" },
        ...questions.map((text) => h("li", {}, h("button", { type: "button", click: () => session.emit("question", { text, send: true }) }, text))),
      ),
    );
  }
}

/** Questions that the selection has an answer to. */
function suited(part: Part | undefined, face: Face | undefined): string[] {
  const { questions } = texts.selection;
  if (!part) return [face?.radius ? questions.radius : "", questions.area].filter(Boolean);
  return [
    part.diameter !== null ? questions.diameter : part.radius !== null ? questions.radius : "",
    part.depth !== null ? questions.depth : "",
    part.kind === "body" ? questions.volume : "",
    part.diameter === null && part.depth === null ? questions.size : "",
    questions.what(part.id.replace("-", " ")),
  ].filter(Boolean);
}
