// How much is drawn while the model moves: as much as this machine draws in time, all of it once the model rests.

/** Milliseconds between two frames above which less is drawn, and below which more may be: 30 and 50 a second. */
const SLOW_MS = 33;
const FAST_MS = 20;
const SETTLE_FRAMES = 4;
/** A pause between frames that is longer than this is no movement. */
const PAUSE_MS = 400;

/** From all to least: with edges; without; fewer triangles; at half of the resolution; still fewer triangles. */
export const LEVELS = [
  { edges: true, coarser: 0, resolution: 1 },
  { edges: false, coarser: 0, resolution: 1 },
  { edges: false, coarser: 1, resolution: 1 },
  { edges: false, coarser: 1, resolution: 1 / 2 },
  { edges: false, coarser: 2, resolution: 1 / 2 },
] as const;
const COARSE = 2;

export class Pace {
  private level = 0;
  private last = 0;
  private average = 0;
  private seen = 0;

  /** A frame of a moving model is drawn now. */
  moved(now: number): void {
    const spent = now - this.last;
    this.last = now;
    if (spent > PAUSE_MS) {
      this.seen = 0;
      return;
    }
    this.average = this.seen === 0 ? spent : 0.7 * this.average + 0.3 * spent;
    this.seen += 1;
    if (this.seen < SETTLE_FRAMES) return;
    if (this.average > SLOW_MS && this.level < LEVELS.length - 1) this.change(1);
    else if (this.average < FAST_MS && this.level > 0 && this.seen > 10 * SETTLE_FRAMES) this.change(-1);
  }

  /** Begins with fewer triangles, where it is known that all are too many. */
  begin(withFewer: boolean): void {
    [this.level, this.seen] = [withFewer ? COARSE : 0, 0];
  }

  get quality(): (typeof LEVELS)[number] {
    return LEVELS[this.level] ?? LEVELS[0];
  }

  private change(by: number): void {
    this.level += by;
    this.seen = 0;
  }
}

const SOFTWARE = /swiftshader|llvmpipe|software|basic render/i;

/** Is the model drawn without a graphics card, as far as the browser tells? Throws an Error without WebGL 2. */
export function drawsInSoftware(): boolean {
  const gl = document.createElement("canvas").getContext("webgl2");
  if (!gl) throw new Error("WebGL 2 is missing");
  const told = gl.getExtension("WEBGL_debug_renderer_info");
  const name = told ? String(gl.getParameter(told.UNMASKED_RENDERER_WEBGL)) : "";
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  return SOFTWARE.test(name);
}
