// The axes as they are turned, in a corner of the view; a click on an end looks from there.

import { Vector3 } from "three";
import { h, svg } from "../dom";
import { texts } from "../texts";
import type { Side } from "./sides";
import type { Viewer } from "./viewer";

const SIZE_PX = 88;
const ARM_PX = 32;

interface End {
  readonly side: Side;
  readonly way: Vector3;
  readonly ball: SVGElement;
  readonly line: SVGElement | undefined;
}

/** Which end of which axis is which side: the front is seen from -y. */
const ENDS: readonly [axis: "x" | "y" | "z", sign: 1 | -1, side: Side][] = [
  ["x", 1, "right"],
  ["x", -1, "left"],
  ["y", 1, "back"],
  ["y", -1, "front"],
  ["z", 1, "top"],
  ["z", -1, "bottom"],
];

/** For the pointer alone: the buttons and keys of the sides do the same. */
export class Gizmo {
  private readonly picture = svg("svg", { viewBox: `${-SIZE_PX / 2} ${-SIZE_PX / 2} ${SIZE_PX} ${SIZE_PX}` });
  private readonly element = h("div", { class: "gizmo", "aria-hidden": "true" });
  private readonly ends: readonly End[];

  constructor(
    holder: HTMLElement,
    private readonly viewer: Viewer,
  ) {
    this.ends = ENDS.map(([axis, sign, side]) => this.end(axis, sign, side));
    this.element.append(this.picture);
    holder.append(this.element);
  }

  /** Turns the axes as the view is turned; hidden while there is no model. */
  draw(): void {
    this.element.hidden = !this.viewer.model;
    const seen = this.ends.map((end) => ({ end, at: this.viewer.turned(end.way) })).sort((a, b) => a.at.z - b.at.z);
    for (const { end, at } of seen) {
      const [x, y] = [at.x * ARM_PX, -at.y * ARM_PX];
      end.ball.setAttribute("transform", `translate(${x.toFixed(1)} ${y.toFixed(1)})`);
      end.line?.setAttribute("x2", x.toFixed(1));
      end.line?.setAttribute("y2", y.toFixed(1));
    }
    // the nearest last; in the same order nothing is moved, which would break off a click
    const order = seen.flatMap(({ end }) => [end.line, end.ball]).filter((each) => each !== undefined);
    if (order.some((each, index) => this.picture.children[index] !== each)) this.picture.replaceChildren(...order);
  }

  private end(axis: "x" | "y" | "z", sign: 1 | -1, side: Side): End {
    const way = new Vector3();
    way[axis] = sign;
    const ball = svg("g", { class: `end ${axis}${sign < 0 ? " far" : ""}`, "data-end": side });
    ball.append(svg("title", {}, texts.view.sides[side]), svg("circle", { r: sign > 0 ? 9 : 7 }));
    if (sign > 0) ball.append(svg("text", { "text-anchor": "middle", dy: "0.36em" }, axis));
    ball.addEventListener("click", () => void this.viewer.look(side));
    return { side, way, ball, line: sign > 0 ? svg("line", { class: axis }) : undefined };
  }
}
