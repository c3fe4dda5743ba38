// What the model is, as an engineer would say it; its features point at the model.

import * as api from "../api/client";
import type { Callout, Description } from "../api/types";
import { h } from "../dom";
import type { Session } from "../session";
import { texts } from "../texts";
import { bare, measure } from "../units";

export class DescriptionPanel {
  private shown = "";

  constructor(
    private readonly panel: HTMLElement,
    private readonly session: Session,
    private readonly choose: (ids: readonly string[]) => Promise<void>,
    private readonly suggest: (questions: readonly string[]) => void,
  ) {
    session.on("unit", session.guarded(() => this.load()));
  }

  /** Describes the model that is open, unless it is described. */
  async load(): Promise<void> {
    const { model, unit } = this.session;
    if (model?.status !== "ready") {
      this.shown = "";
      return this.panel.replaceChildren();
    }
    const wanted = `${model.id},${unit}`;
    if (wanted === this.shown) return;
    this.shown = wanted;
    this.panel.replaceChildren(h("p", { class: "quiet" }, texts.description.loading));
    try {
      const found = await api.describe(model.id, unit);
      if (this.shown !== wanted) return;
      this.suggest(found.questions);
      this.render(found);
    } catch (error) {
      this.shown = "";
      throw error;
    }
  }

  private render(found: Description): void {
    const { unit } = this.session;
    const names = texts.description;
    const facts: [string, string][] = [
      [names.size, `${found.size.map((length) => bare(length, unit)).join(" × ")} ${unit}`],
      [names.volume, measure(found.volume, unit, 3)],
      [names.area, measure(found.area, unit, 2)],
      [names.bodies, String(found.bodies)],
      [names.faces, String(found.faces)],
      [names.declared, found.declared_units.join(", ")],
      [names.drawn, found.drawn_in],
      [names.stands, found.stands_along],
      [names.thickness, found.material_thickness === null ? "" : measure(found.material_thickness, unit)],
      [names.standard, found.standard_parts.join("; ")],
      [names.warnings, found.warnings.join("; ")],
    ];
    const rows = facts.filter(([, value]) => value).flatMap(([name, value]) => [h("dt", {}, name), h("dd", {}, value)]);
    const content = h("div", {}, h("dl", {}, ...rows), this.callouts(names.features, found.features), this.callouts(names.patterns, found.patterns));
    this.panel.replaceChildren(content);
  }

  private callouts(title: string, callouts: readonly Callout[]): HTMLElement | null {
    if (!callouts.length) return null;
    const rows = callouts.map(({ text, ids }) =>
      h("li", {}, h("button", { type: "button", class: "plain", title: ids.slice(0, 20).join(", "), click: this.session.guarded(() => this.choose(ids)) }, text)),
    );
    return h("section", {}, h("h3", {}, title), h("ul", { class: "callouts" }, ...rows));
  }
}
