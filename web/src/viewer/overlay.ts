// What is written over the view: labels with leader lines, and dimensions. It follows the model as it turns.

import type { Vector3 } from "three";
import { h } from "../dom";
import { placed, type Point } from "./layout";
import type { Viewer } from "./viewer";

export interface Label {
  readonly at: Vector3;
  readonly text: string;
  readonly color: string;
}

export interface Dimension {
  readonly from: Vector3;
  readonly to: Vector3;
  readonly text: string;
}

interface Line {
  from: Point;
  to: Point;
  color: string;
  /** A dimension's line has ends at both sides, a leader's a dot on the model. */
  dimension: boolean;
}

interface Written {
  text: string;
  /** Of the middle of the text's near edge; of a dimension's the middle of it. */
  at: Point;
  align: "left" | "right" | "center";
  color: string;
}

const SVG = "http://www.w3.org/2000/svg";
const INSET_PX = 8;
const DIMENSION_COLOR = "#1b5e9b";

export class Overlay {
  private readonly lines = document.createElementNS(SVG, "svg");
  private readonly texts = h("div", { class: "labels" });
  private labels: readonly Label[] = [];
  private dimensions: readonly Dimension[] = [];
  private measured: Dimension | undefined;
  private pending: Vector3 | undefined;

  constructor(
    private readonly holder: HTMLElement,
    private readonly viewer: Viewer,
  ) {
    this.lines.setAttribute("class", "leaders");
    this.lines.setAttribute("aria-hidden", "true");
    holder.append(this.lines, this.texts);
  }

  /** Labels and dimensions of an answer; none: an empty list. */
  write(labels: readonly Label[], dimensions: readonly Dimension[]): void {
    [this.labels, this.dimensions] = [labels, dimensions];
    this.draw();
  }

  /** What is being measured: a first point, then a dimension; undefined: nothing. */
  measure(pending: Vector3 | undefined, dimension?: Dimension): void {
    [this.pending, this.measured] = [pending, dimension];
    this.draw();
  }

  draw(): void {
    const { lines, texts } = this.layout();
    this.lines.replaceChildren(...lines.flatMap((line) => drawn(line)));
    this.texts.replaceChildren(
      ...texts.map(({ text, at, align, color }) => {
        const label = h("span", { class: `label ${align}` }, text);
        label.style.top = `${at.y}px`;
        if (align === "right") label.style.right = `${INSET_PX}px`;
        else label.style.left = `${at.x}px`;
        label.style.borderColor = color;
        return label;
      }),
    );
  }

  /** Draws all of it into a picture of the view; `scale`: its pixels for one of the page. */
  drawInto(context: CanvasRenderingContext2D, scale: number): void {
    const { lines, texts } = this.layout();
    context.scale(scale, scale);
    context.lineWidth = 1.5;
    for (const { from, to, color, dimension } of lines) {
      context.strokeStyle = context.fillStyle = color;
      context.beginPath();
      context.moveTo(from.x, from.y);
      context.lineTo(to.x, to.y);
      context.stroke();
      for (const end of dimension ? [from, to] : [to]) {
        context.beginPath();
        context.arc(end.x, end.y, 3, 0, 2 * Math.PI);
        context.fill();
      }
    }
    context.font = "13px system-ui, sans-serif";
    context.textBaseline = "middle";
    for (const { text, at, align, color } of texts) {
      const width = context.measureText(text).width + 10;
      const left = { left: at.x, right: at.x - width, center: at.x - width / 2 }[align];
      context.fillStyle = "#fff";
      context.strokeStyle = color;
      context.fillRect(left, at.y - 10, width, 20);
      context.strokeRect(left, at.y - 10, width, 20);
      context.fillStyle = "#14171a";
      context.fillText(text, left + 5, at.y);
    }
  }

  private layout(): { lines: Line[]; texts: Written[] } {
    const { clientWidth: width, clientHeight: height } = this.holder;
    const anchors = this.labels.map((label) => this.viewer.project(label.at));
    const lines: Line[] = [];
    const texts: Written[] = [];
    for (const { index, side, y } of placed(anchors, width, height)) {
      const { text, color } = this.labels[index]!;
      const at = { x: side === "left" ? INSET_PX : width - INSET_PX, y };
      lines.push({ from: at, to: anchors[index]!, color, dimension: false });
      texts.push({ text, at, align: side, color });
    }
    for (const { from, to, text } of [...this.dimensions, ...(this.measured ? [this.measured] : [])]) {
      const [start, end] = [this.viewer.project(from), this.viewer.project(to)];
      lines.push({ from: start, to: end, color: DIMENSION_COLOR, dimension: true });
      const at = { x: (start.x + end.x) / 2, y: (start.y + end.y) / 2 };
      texts.push({ text, at, align: "center", color: DIMENSION_COLOR });
    }
    if (this.pending) {
      const at = this.viewer.project(this.pending);
      lines.push({ from: at, to: at, color: DIMENSION_COLOR, dimension: true });
    }
    return { lines, texts };
  }
}

function drawn({ from, to, color, dimension }: Line): SVGElement[] {
  const shape = (name: string, attributes: Record<string, number | string>): SVGElement => {
    const element = document.createElementNS(SVG, name);
    Object.entries(attributes).forEach(([key, value]) => element.setAttribute(key, String(value)));
    return element;
  };
  const ends = dimension ? [from, to] : [to];
  return [
    shape("line", { x1: from.x, y1: from.y, x2: to.x, y2: to.y, stroke: color }),
    ...ends.map((end) => shape("circle", { cx: end.x, cy: end.y, r: 3, fill: color })),
  ];
}
