// A table of the model's parts; its rows and the model point at each other.

import * as api from "../api/client";
import type { Column, LengthUnit, Table, TableKind } from "../api/types";
import { TABLES } from "../api/types";
import { download, h } from "../dom";
import type { Session } from "../session";
import { texts } from "../texts";
import { bare, degrees, unitName } from "../units";

const ROWS = 200;
/** Columns that tell where a part is; they stand after those that tell what it is, which fit beside the view. */
const PLACE: ReadonlySet<string> = new Set(["x", "y", "z", "axis"]);
const POWERS = { length: 1, area: 2, volume: 3 } as const;

export class Tables {
  private readonly kind = h("select", { "aria-label": texts.tables.kind });
  private readonly grouped = h("input", { type: "checkbox" });
  private readonly holder = h("div", { class: "table", tabindex: 0, role: "region" });
  private shown = "";

  /** `kinds`: which tables there are to choose from, the first of them at the beginning. */
  constructor(
    private readonly panel: HTMLElement,
    private readonly session: Session,
    kinds: readonly TableKind[],
    private readonly choose: (ids: readonly string[]) => Promise<void>,
  ) {
    this.kind.append(...kinds.map((kind) => h("option", { value: kind }, texts.tables.kinds[kind])));
    this.kind.hidden = kinds.length < 2;
    this.grouped.checked = kinds[0] === "bodies";
    const csv = h("button", { type: "button", click: session.guarded(() => this.csv()) }, texts.tables.csv);
    panel.append(h("div", { class: "row" }, this.kind, h("label", {}, this.grouped, ` ${texts.tables.grouped}`), csv), this.holder);
    for (const input of [this.kind, this.grouped]) input.addEventListener("change", session.guarded(() => this.show()));
    session.on("unit", session.guarded(() => (this.panel.hidden ? undefined : this.show())));
    session.on("selection", ({ parts }) => this.mark(parts));
  }

  /** Shows the table of the model that is open, unless it is shown. */
  async show(): Promise<void> {
    const { model, unit } = this.session;
    if (model?.status !== "ready") return this.holder.replaceChildren();
    const { kind, grouped } = this.wanted;
    const wanted = [model.id, kind, grouped, unit].join();
    if (wanted === this.shown) return;
    this.holder.replaceChildren(h("p", { class: "quiet" }, texts.tables.loading));
    const table = await api.table(model.id, kind, grouped, unit);
    this.shown = wanted;
    this.render(table, unit);
    this.mark(this.session.selection.parts);
  }

  private get wanted(): { kind: TableKind; grouped: boolean } {
    return { kind: TABLES.find((kind) => kind === this.kind.value) ?? "holes", grouped: this.grouped.checked };
  }

  private async csv(): Promise<void> {
    const { model, unit } = this.session;
    if (!model) return;
    const { kind, grouped } = this.wanted;
    download(`${model.file_name}-${kind}.csv`, await api.tableCsv(model.id, kind, grouped, unit), "text/csv");
  }

  private render(table: Table, unit: LengthUnit): void {
    const name = texts.tables.kinds[this.wanted.kind];
    this.holder.setAttribute("aria-label", name);
    if (!table.rows.length) return this.holder.replaceChildren(h("p", { class: "quiet" }, texts.tables.none(name)));
    const filled = table.columns.map((_, index) => index).filter((index) => table.rows.some((row) => row[index] !== null));
    const isPlace = (index: number): boolean => PLACE.has(table.columns[index]!.name);
    const used = [...filled.filter((index) => !isPlace(index)), ...filled.filter(isPlace)];
    const body = h("tbody");
    const add = (from: number, to: number): void => {
      for (const [index, row] of table.rows.slice(from, to).entries()) body.append(this.row(table, used, row, table.ids[from + index] ?? [], unit));
    };
    add(0, ROWS);
    const rest = table.rows.length - ROWS;
    const more = h("button", { type: "button", hidden: rest <= 0 }, texts.tables.more(rest));
    more.addEventListener("click", () => {
      add(ROWS, table.rows.length);
      more.remove();
    });
    const heads = used.map((index) => h("th", { scope: "col" }, head(table.columns[index]!, unit)));
    this.holder.replaceChildren(
      h(
        "table",
        {},
        h("caption", {}, texts.tables.caption(name, table.rows.length, table.parts)),
        h("thead", {}, h("tr", {}, ...heads)),
        body,
      ),
      more,
    );
  }

  private row(table: Table, used: readonly number[], row: Table["rows"][number], ids: readonly string[], unit: LengthUnit): HTMLElement {
    const { session } = this;
    const point = session.guarded(async () => session.point((await session.parts(ids)).flatMap((part) => part.faces)));
    const cells = used.map((index, place) => {
      const column = table.columns[index]!;
      const text = cell(row[index] ?? null, column, unit);
      if (place > 0) return h("td", { class: column.quantity === "text" ? undefined : "number" }, text);
      const button = h("button", { type: "button", class: "plain", "aria-label": texts.tables.row(text), click: session.guarded(() => this.choose(ids)) }, text);
      return h("th", { scope: "row" }, button);
    });
    return h("tr", { "data-ids": ids.join(" "), mouseenter: point, mouseleave: () => session.point(undefined) }, ...cells);
  }

  /** Marks the rows of what is selected, and brings the first of them into view. */
  private mark(parts: readonly string[]): void {
    let first: Element | undefined;
    for (const row of this.holder.querySelectorAll("tr[data-ids]")) {
      const ids = row.getAttribute("data-ids")?.split(" ") ?? [];
      const meant = parts.some((part) => ids.includes(part));
      row.toggleAttribute("data-selected", meant);
      if (meant) first ??= row;
    }
    if (!this.panel.hidden) first?.scrollIntoView({ block: "nearest" });
  }
}

function head(column: Column, unit: LengthUnit): string {
  if (column.quantity === "angle") return `${column.name} [°]`;
  const power = POWERS[column.quantity as keyof typeof POWERS];
  return power ? `${column.name} [${unitName(unit, power)}]` : column.name;
}

function cell(value: string | number | null, column: Column, unit: LengthUnit): string {
  if (value === null) return "";
  if (typeof value === "string") return value;
  if (column.quantity === "angle") return degrees(value).replace("°", "");
  const power = POWERS[column.quantity as keyof typeof POWERS];
  return power ? bare(value, unit, power) : String(value);
}
