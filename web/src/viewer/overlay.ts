// What is written over the view: labels with leader lines, and dimensions. It follows the model as it turns.

import type { Vector3 } from "three";
import { h, svg } from "../dom";
import { type Box, free, placed, type Point } from "./layout";
import type { Viewer } from "./viewer";

export interface Label {
  readonly at: Vector3;
  readonly text: string;
  readonly color: string;
}

export interface Dimension {
  /** From end to end: two points, or more along an arc. */
  readonly path: readonly Vector3[];
  readonly text: string;
}

interface Line {
  points: readonly Point[];
  color: string;
  /** Where it has a dot: a dimension at both ends, a leader on the model. */
  dots: readonly Point[];
}

interface Written {
  text: string;
  /** Of the middle of the text's near edge; of a dimension's the middle of it. */
  at: Point;
  align: "left" | "right" | "center";
  color: string;
}

const INSET_PX = 8;
/** A dimension that is shorter than this has its text above it, which would hide it. */
const SHORT_PX = 90;
const ABOVE_PX = 15;
/** Width of a letter of a dimension's text, as an upper bound of most, and what stands around the text. */
const LETTER_PX = 8;
const PADDING_PX = 16;
const DIMENSION_COLOR = "#1b5e9b";

export class Overlay {
  private readonly lines = svg("svg", { class: "leaders", "aria-hidden": "true" });
  private readonly texts = h("div", { class: "labels" });
  private labels: readonly Label[] = [];
  private dimensions: readonly Dimension[] = [];
  private measured: Dimension | undefined;
  private pending: Vector3 | undefined;

  constructor(
    private readonly holder: HTMLElement,
    private readonly viewer: Viewer,
  ) {
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
    for (const { points, color, dots } of lines) {
      context.strokeStyle = context.fillStyle = color;
      context.beginPath();
      for (const { x, y } of points) context.lineTo(x, y);
      context.stroke();
      for (const { x, y } of dots) {
        context.beginPath();
        context.arc(x, y, 3, 0, 2 * Math.PI);
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
      lines.push({ points: [at, anchors[index]!], color, dots: [anchors[index]!] });
      texts.push({ text, at, align: side, color });
    }
    const taken: Box[] = [];
    for (const { path, text } of [...this.dimensions, ...(this.measured ? [this.measured] : [])]) {
      const points = path.map((point) => this.viewer.project(point));
      const [start, end] = [points[0]!, points.at(-1)!];
      lines.push({ points, color: DIMENSION_COLOR, dots: [start, end] });
      const middle = points.length > 2 ? points[points.length >> 1]! : { x: (start.x + end.x) / 2, y: (start.y + end.y) / 2 };
      const isShort = Math.hypot(end.x - start.x, end.y - start.y) < SHORT_PX && points.length === 2;
      const at = isShort ? { x: middle.x, y: Math.min(start.y, end.y) - ABOVE_PX } : middle;
      const width = text.length * LETTER_PX + PADDING_PX;
      const found = free(at, width, taken);
      taken.push({ ...found, width });
      texts.push({ text, at: found, align: "center", color: DIMENSION_COLOR });
    }
    if (this.pending) lines.push({ points: [], color: DIMENSION_COLOR, dots: [this.viewer.project(this.pending)] });
    return { lines, texts };
  }
}

function drawn({ points, color, dots }: Line): SVGElement[] {
  const row = points.map(({ x, y }) => `${x},${y}`).join(" ");
  return [
    ...(points.length ? [svg("polyline", { points: row, stroke: color, fill: "none" })] : []),
    ...dots.map(({ x, y }) => svg("circle", { cx: x, cy: y, r: 3, fill: color })),
  ];
}
