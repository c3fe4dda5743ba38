// Where labels stand beside the view, so that their leader lines do not cross.

export interface Point {
  readonly x: number;
  readonly y: number;
}

export interface Placed {
  /** Which of the anchors. */
  readonly index: number;
  readonly side: "left" | "right";
  /** Middle of the label, pixels from the top. */
  readonly y: number;
}

const GAP_PX = 26;

/**
 * Places a label for each anchor, in a column at the left and one at the right edge of a view.
 *
 * The anchors are halved by x, so that lines to the left and to the right cannot meet. Within a column two labels whose
 * lines cross change places, which makes the lines shorter together, so that it ends, with no crossing left.
 */
export function placed(anchors: readonly Point[], width: number, height: number): Placed[] {
  const byX = anchors.map((_, index) => index).sort((a, b) => anchors[a]!.x - anchors[b]!.x);
  const half = anchors.length === 1 ? (anchors[0]!.x < width / 2 ? 1 : 0) : Math.ceil(byX.length / 2);
  return [
    ...column(byX.slice(0, half), anchors, "left", 0, height),
    ...column(byX.slice(half), anchors, "right", width, height),
  ];
}

function column(chosen: number[], anchors: readonly Point[], side: Placed["side"], x: number, height: number): Placed[] {
  if (!chosen.length) return [];
  const order = [...chosen].sort((a, b) => anchors[a]!.y - anchors[b]!.y);
  const gap = Math.min(GAP_PX, height / order.length);
  const middle = order.reduce((sum, index) => sum + anchors[index]!.y, 0) / order.length;
  const length = gap * (order.length - 1);
  const top = Math.max(gap / 2, Math.min(middle - length / 2, height - length - gap / 2));
  const slots = order.map((_, place) => ({ x, y: top + place * gap }));
  for (let changed = true; changed; ) {
    changed = false;
    for (let a = 0; a < order.length; a += 1) {
      for (let b = a + 1; b < order.length; b += 1) {
        if (!cross(slots[a]!, anchors[order[a]!]!, slots[b]!, anchors[order[b]!]!)) continue;
        [order[a], order[b]] = [order[b]!, order[a]!];
        changed = true;
      }
    }
  }
  return order.map((index, place) => ({ index, side, y: slots[place]!.y }));
}

/** Do two line segments cross in their inner parts? */
export function cross(a: Point, b: Point, c: Point, d: Point): boolean {
  const turn = (p: Point, q: Point, r: Point): number => (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
  return turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0;
}
