// The view's tools: sides, fit, edges, transparency, section, measuring, unit; by button and, in the view, by key.

import * as api from "../api/client";
import type { LengthUnit } from "../api/types";
import { announce, download, h } from "../dom";
import type { Session } from "../session";
import { texts } from "../texts";
import { SIDES, SIDE_KEYS } from "../viewer/sides";
import { measured } from "../viewer/measuring";
import type { Axis, Hit, Viewer } from "../viewer/viewer";

const STEP_RAD = Math.PI / 12;
const PAN_SHARE = 0.05;
const ZOOM = 1.2;
const keyOf = (side: string): string => Object.entries(SIDE_KEYS).find(([, name]) => name === side)?.[0] ?? "";

export class Tools {
  private readonly told = h("p", { role: "status", class: "told" });
  private measuring = false;
  private first: Hit | undefined;

  constructor(
    bar: HTMLElement,
    foot: HTMLElement,
    private readonly session: Session,
    private readonly viewer: Viewer,
    private readonly link: () => string,
  ) {
    foot.append(this.sectionRow(), this.told);
    bar.append(...this.buttons());
    this.listen();
    session.on("model", () => this.stop());
  }

  /** Takes a click for measuring; false: nobody is measuring. */
  took(hit: Hit | undefined): boolean {
    if (!this.measuring) return false;
    if (hit) this.session.guarded(() => this.point(hit))();
    return true;
  }

  /** Keeps a picture of the view, as it is seen, with what is written over it. */
  picture(name: string): void {
    const view = this.viewer.snapshot();
    const page = h("canvas", { width: view.width, height: view.height });
    const context = page.getContext("2d");
    if (!context) return;
    context.fillStyle = "#fff";
    context.fillRect(0, 0, page.width, page.height);
    context.drawImage(view, 0, 0);
    this.session.overlay?.drawInto(context, view.width / view.clientWidth);
    page.toBlob((blob) => blob && download(`${name}.png`, blob), "image/png");
  }

  private buttons(): HTMLElement[] {
    const { viewer } = this;
    const sides = SIDES.map((side) =>
      h(
        "button",
        { type: "button", "data-side": side, title: texts.view.key(texts.view.sides[side], keyOf(side)), click: () => void viewer.look(side) },
        texts.view.sides[side],
      ),
    );
    const unit = h(
      "select",
      { "aria-label": texts.view.unit, change: () => this.session.setUnit(unit.value as LengthUnit) },
      ...["mm", "cm", "m", "in"].map((name) => h("option", { value: name }, name)),
    );
    return [
      h("div", { role: "group", "aria-label": texts.view.sideGroup, class: "row" }, ...sides),
      h(
        "div",
        { class: "row" },
        h("button", { type: "button", title: texts.view.key(texts.view.fit, "F"), click: () => void viewer.fit() }, texts.view.fit),
        this.toggle(texts.view.edges, "E", true, (on) => (viewer.edges = on)),
        this.toggle(texts.view.transparent, "X", false, (on) => (viewer.transparent = on)),
        this.toggle(texts.view.measure, "M", false, (on) => (on ? this.begin() : this.stop())),
        h("button", { type: "button", click: () => this.picture(this.session.model?.file_name ?? "view") }, texts.view.picture),
        h("button", { type: "button", click: this.session.guarded(() => this.copyLink()) }, texts.view.link),
        unit,
      ),
    ];
  }

  private async copyLink(): Promise<void> {
    await navigator.clipboard.writeText(this.link());
    announce((this.told.textContent = texts.view.linkCopied));
  }

  private toggle(text: string, key: string, on: boolean, change: (on: boolean) => void): HTMLButtonElement {
    const set = (): void => {
      const next = button.getAttribute("aria-pressed") !== "true";
      button.setAttribute("aria-pressed", String(next));
      change(next);
    };
    const button = h("button", { type: "button", "aria-pressed": String(on), "data-key": key, title: texts.view.key(text, key), click: set }, text);
    return button;
  }

  private sectionRow(): HTMLElement {
    const axis = h("select", { "aria-label": texts.view.section, "data-key": "C" }, h("option", { value: "" }, texts.view.sectionNone));
    axis.append(...["x", "y", "z"].map((name) => h("option", { value: name }, name)));
    const share = h("input", { type: "range", min: 0, max: 1, step: 0.005, value: 0.5, "aria-label": texts.view.sectionAt, disabled: true });
    const flip = h("input", { type: "checkbox", disabled: true });
    const cut = (): void => {
      share.disabled = flip.disabled = !axis.value;
      this.viewer.section((axis.value || undefined) as Axis | undefined, share.valueAsNumber, flip.checked);
    };
    [axis, share, flip].forEach((input) => input.addEventListener("input", cut));
    this.session.on("drawn", cut);
    return h("div", { class: "row section" }, h("label", {}, `${texts.view.section} `, axis), share, h("label", {}, flip, ` ${texts.view.sectionFlip}`));
  }

  private begin(): void {
    this.measuring = true;
    this.first = undefined;
    this.session.overlay?.measure(undefined);
    this.told.textContent = texts.view.measureFirst;
  }

  private stop(): void {
    this.measuring = false;
    this.first = undefined;
    this.session.overlay?.measure(undefined);
    this.told.textContent = "";
    document.querySelector("[data-key=M]")?.setAttribute("aria-pressed", "false");
  }

  private async point(hit: Hit): Promise<void> {
    const { model, overlay, unit } = this.session;
    const drawn = this.viewer.model;
    if (!model || !drawn) return;
    if (!this.first) {
      this.first = hit;
      overlay?.measure(hit.point);
      this.told.textContent = texts.view.measureSecond;
      return;
    }
    const first = this.first;
    this.first = undefined;
    const faces = await api.faces(model.id, [first.face, hit.face]);
    const of = (id: number): (typeof faces)[number] => faces.find((face) => face.id === id)!;
    const { distance, said } = measured(drawn.toMetres(first.point), drawn.toMetres(hit.point), of(first.face), of(hit.face), unit);
    overlay?.measure(undefined, { from: first.point, to: hit.point, text: distance });
    this.told.textContent = `${said.join("; ")}. ${texts.view.measureFirst}`;
  }

  private listen(): void {
    const { viewer } = this;
    const { canvas } = viewer;
    const press = (key: string): void => document.querySelector<HTMLElement>(`[data-key=${key}]`)?.click();
    const arrows: Record<string, readonly [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    canvas.tabIndex = 0;
    canvas.addEventListener("keydown", (event) => {
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      const side = SIDE_KEYS[event.key];
      const arrow = arrows[event.key];
      const key = event.key.toUpperCase();
      if (side) void viewer.look(side);
      else if (arrow && event.shiftKey) viewer.pan(arrow[0] * PAN_SHARE, arrow[1] * PAN_SHARE);
      else if (arrow) viewer.turn(arrow[0] * STEP_RAD, arrow[1] * STEP_RAD);
      else if (key === "+" || key === "=") viewer.zoomBy(ZOOM);
      else if (key === "-") viewer.zoomBy(1 / ZOOM);
      else if (key === "F") void viewer.fit();
      else if (key === "C") document.querySelector<HTMLElement>("[data-key=C]")?.focus();
      else if (["E", "X", "M"].includes(key)) press(key);
      else if (key === "ESCAPE") {
        this.stop();
        this.session.select({ parts: [], faces: [] });
      } else return;
      event.preventDefault();
    });
  }
}
