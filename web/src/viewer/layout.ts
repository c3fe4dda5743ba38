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

/** A text around its middle; all are one line high. */
export interface Box extends Point {
  readonly width: number;
}

const GAP_PX = 26;
/** Height of a text with the room above and below it. */
const TEXT_PX = 23;
/** Lines up and down that are tried for a text, the nearest first. */
const STEPS = [0, -1, 1, -2, 2, -3, 3] as const;

/**
 * Places a label for each anchor, in a column at the left and one at the right edge of a view.
 *
 * The anchors are halved by x, so that lines to the left and to the right cannot meet. A label is as near to the height
 * of its anchor as others leave room. Within a column two labels whose
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
  const heights = spread(order.map((index) => anchors[index]!.y), gap, height);
  const slots = heights.map((y) => ({ x, y }));
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

/** Heights as near to the wanted ones (ascending) as they can be, `gap` apart: those too close share their middle. */
function spread(wanted: readonly number[], gap: number, height: number): number[] {
  const blocks: { sum: number; count: number }[] = [];
  wanted.forEach((y, place) => {
    let block = { sum: y - place * gap, count: 1 };
    for (let last = blocks.at(-1); last && last.sum / last.count > block.sum / block.count; last = blocks.at(-1)) {
      block = { sum: block.sum + last.sum, count: block.count + last.count };
      blocks.pop();
    }
    blocks.push(block);
  });
  const highest = height - gap / 2 - (wanted.length - 1) * gap;
  const starts = blocks.flatMap(({ sum, count }) => Array<number>(count).fill(sum / count));
  return starts.map((start, place) => Math.max(gap / 2, Math.min(start, highest)) + place * gap);
}

/** Where a text of a dimension stands free of those before it: as little above or below its place as that takes. */
export function free(wanted: Point, width: number, taken: readonly Box[]): Point {
  for (const step of STEPS) {
    const at = { x: wanted.x, y: wanted.y + step * TEXT_PX };
    if (!taken.some((box) => Math.abs(box.x - at.x) < (box.width + width) / 2 && Math.abs(box.y - at.y) < TEXT_PX)) return at;
  }
  return wanted;
}

/** Do two line segments cross in their inner parts? */
export function cross(a: Point, b: Point, c: Point, d: Point): boolean {
  const turn = (p: Point, q: Point, r: Point): number => (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
  return turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0;
}
