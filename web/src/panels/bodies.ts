// The bodies of a model: names and colours of the file, and which of them are shown.

import { h, swatch } from "../dom";
import type { Session } from "../session";
import { texts } from "../texts";

/** With more bodies than this there is a field to find one. */
const FEW = 8;

export class Bodies {
  private readonly section = h("section", { class: "bodies", hidden: true });

  constructor(
    holder: HTMLElement,
    private readonly session: Session,
  ) {
    holder.append(this.section);
    session.on("drawn", () => this.render());
    session.on("model", () => this.render());
  }

  private render(): void {
    const { viewer } = this.session;
    const bodies = viewer?.model?.bodies ?? [];
    this.section.hidden = bodies.length < 2;
    if (!viewer || bodies.length < 2) return;
    const told = new Map<string, number>();
    for (const { name } of bodies) told.set(name, (told.get(name) ?? 0) + 1);
    const rows = bodies.map((body) => {
      const name = (told.get(body.name) ?? 0) > 1 ? `${body.name} · ${body.id + 1}` : body.name;
      const box = h("input", { type: "checkbox", checked: viewer.isBodyShown(body.id), change: () => viewer.showBody(body.id, box.checked) });
      const only = (): void => {
        bodies.forEach((each, index) => {
          viewer.showBody(each.id, each === body);
          rows[index]!.box.checked = each === body;
        });
      };
      const row = h(
        "li",
        { mouseenter: () => this.session.point(body.faces), mouseleave: () => this.session.point(undefined) },
        h("label", {}, box, swatch(body.color), h("span", {}, name)),
        h("button", { type: "button", class: "plain", "aria-label": texts.bodies.only(name), title: texts.bodies.only(name), click: only }, texts.bodies.onlyShort),
      );
      return { box, row, name: name.toLowerCase() };
    });
    const all = (shown: boolean): void => {
      bodies.forEach((body) => viewer.showBody(body.id, shown));
      rows.forEach(({ box }) => (box.checked = shown));
    };
    const find = h("input", {
      type: "search",
      placeholder: texts.bodies.filter,
      "aria-label": texts.bodies.filter,
      input: () => rows.forEach(({ row, name }) => (row.hidden = !name.includes(find.value.toLowerCase()))),
    });
    const content = h(
      "div",
      {},
      h("h2", {}, texts.bodies.title(bodies.length)),
      h(
        "div",
        { class: "row" },
        h("button", { type: "button", click: () => all(true) }, texts.bodies.all),
        h("button", { type: "button", click: () => all(false) }, texts.bodies.none),
      ),
      bodies.length > FEW && find,
      h("ul", { class: "tree" }, ...rows.map(({ row }) => row)),
    );
    this.section.replaceChildren(content);
  }
}
