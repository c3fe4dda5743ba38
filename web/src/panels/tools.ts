// The view's tools: sides, fit, edges, transparency, section, measuring, unit; by button and, in the view, by key.

import * as api from "../api/client";
import type { LengthUnit } from "../api/types";
import { announce, download, h } from "../dom";
import type { Session } from "../session";
import { texts } from "../texts";
import { measure } from "../units";
import { SIDES, SIDE_KEYS } from "../viewer/sides";
import { measured } from "../viewer/measuring";
import type { Snap } from "../viewer/snapping";
import type { Axis, Hit, Viewer } from "../viewer/viewer";

/** What was clicked while measuring: the point that it snapped to, else what is seen there. */
type Picked = Snap | Hit;

const STEP_RAD = Math.PI / 12;
const PAN_SHARE = 0.05;
const ZOOM = 1.2;
const keyOf = (side: string): string => Object.entries(SIDE_KEYS).find(([, name]) => name === side)?.[0] ?? "";

export class Tools {
  private readonly told = h("p", { role: "status", class: "told" });
  private measuring = false;
  private first: Picked | undefined;

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
  took(hit: Hit | undefined, clientX: number, clientY: number): boolean {
    if (!this.measuring) return false;
    const picked = this.viewer.snap(clientX, clientY, hit) ?? hit;
    if (picked) this.session.guarded(() => this.point(picked))();
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

  /** Takes a point: the first is kept, the second measured from. */
  private async point(picked: Picked): Promise<void> {
    const { model, overlay, unit } = this.session;
    const drawn = this.viewer.model;
    if (!model || !drawn) return;
    if (!this.first) {
      this.first = picked;
      overlay?.measure(picked.point);
      this.told.textContent = texts.view.measureSecond(this.nameOf(picked));
      return;
    }
    const both = [this.first, picked] as const;
    this.first = undefined;
    const ids = both.flatMap((each) => ("face" in each ? [each.face] : []));
    const faces = ids.length === 2 ? await api.faces(model.id, ids) : [];
    const [from, to] = both.map((each) => ({
      place: drawn.toMetres(each.point),
      name: this.nameOf(each),
      face: "face" in each ? faces.find((face) => face.id === each.face) : undefined,
    }));
    const { distance, said } = measured(from!, to!, unit);
    overlay?.measure(undefined, { path: both.map((each) => each.point), text: distance });
    this.told.textContent = `${said.join("; ")}. ${texts.view.measureFirst}`;
  }

  /** What a point that was snapped to is; empty for any other. */
  private nameOf(picked: Picked): string {
    if ("face" in picked) return "";
    if (picked.kind !== "center") return texts.measured[picked.kind];
    const drawn = this.viewer.model;
    return texts.measured.center(measure(2 * (drawn?.lengthInMetres(picked.radius ?? 0) ?? 0), this.session.unit));
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
