// How each face looks: its body's colour, hidden with its body, or lit in a group's colour.

import { DataTexture, NearestFilter, RGBAFormat, UnsignedByteType } from "three";
import type { BodyNode } from "./model";
import { HIDDEN, LIT, PAINT_WIDTH, SHOWN } from "./shaders";

/** Faces that are lit in one colour, `#rrggbb`. */
export interface Light {
  readonly color: string;
  readonly faces: readonly number[];
}

export class Paint {
  readonly texture: DataTexture;
  private readonly texels: Uint8Array;
  private readonly hidden = new Set<number>();
  private lights: readonly Light[] = [];
  private over: Light | undefined;

  constructor(
    private readonly bodies: readonly BodyNode[],
    faceCount: number,
  ) {
    const rows = Math.max(1, Math.ceil(faceCount / PAINT_WIDTH));
    this.texels = new Uint8Array(rows * PAINT_WIDTH * 4);
    this.texture = new DataTexture(this.texels, PAINT_WIDTH, rows, RGBAFormat, UnsignedByteType);
    this.texture.minFilter = this.texture.magFilter = NearestFilter;
    this.redo();
  }

  /** Lights these faces and no others. */
  light(lights: readonly Light[]): void {
    this.lights = lights;
    this.redo();
  }

  /** Lights what is pointed at, over all else; undefined: nothing is. */
  point(light: Light | undefined): void {
    this.over = light;
    this.redo();
  }

  show(body: number, shown: boolean): void {
    if (shown) this.hidden.delete(body);
    else this.hidden.add(body);
    this.redo();
  }

  isShown(body: number): boolean {
    return !this.hidden.has(body);
  }

  /** Is the body of this face shown? */
  isFaceShown(face: number): boolean {
    return this.texels[face * 4 + 3] !== HIDDEN;
  }

  get anythingLit(): boolean {
    return this.lights.length > 0 || this.over !== undefined;
  }

  /** Which faces are lit, in which colour? As it is drawn. */
  lit(): Map<number, string> {
    const found = new Map<number, string>();
    for (let face = 0; face * 4 < this.texels.length; face += 1) {
      if (this.texels[face * 4 + 3] !== LIT) continue;
      const bytes = this.texels.slice(face * 4, face * 4 + 3);
      found.set(face, `#${[...bytes].map((byte) => byte.toString(16).padStart(2, "0")).join("")}`);
    }
    return found;
  }

  dispose(): void {
    this.texture.dispose();
  }

  private redo(): void {
    for (const body of this.bodies) this.fill(body.faces, body.color, this.hidden.has(body.id) ? HIDDEN : SHOWN);
    for (const light of [...this.lights, ...(this.over ? [this.over] : [])]) this.fill(light.faces, light.color, LIT, true);
    this.texture.needsUpdate = true;
  }

  private fill(faces: readonly number[], color: string, state: number, unlessHidden = false): void {
    const number = Number.parseInt(color.slice(1), 16);
    for (const face of faces) {
      const at = face * 4;
      if (at >= this.texels.length || (unlessHidden && this.texels[at + 3] === HIDDEN)) continue;
      this.texels[at] = number >> 16;
      this.texels[at + 1] = (number >> 8) & 255;
      this.texels[at + 2] = number & 255;
      this.texels[at + 3] = state;
    }
  }
}
