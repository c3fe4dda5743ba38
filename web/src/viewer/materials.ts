// The ways in which a model's faces and edges are drawn, all from one texture of faces.

import {
  AlwaysStencilFunc,
  BackSide,
  Color,
  DecrementWrapStencilOp,
  DoubleSide,
  FrontSide,
  GLSL3,
  GreaterDepth,
  IncrementWrapStencilOp,
  LessEqualDepth,
  NotEqualStencilFunc,
  ReplaceStencilOp,
  ShaderMaterial,
  Vector4,
  ZeroStencilOp,
  type Side,
  type StencilOp,
  type Texture,
} from "three";
import { CAP_FRAGMENT, CAP_VERTEX, PICK_FRAGMENT, PICK_VERTEX, PLAIN_FRAGMENT, PLAIN_VERTEX, SURFACE_FRAGMENT, SURFACE_VERTEX } from "./shaders";

const PALE = 0.18;
const THROUGH = 0.32;
const INK = new Color(0x262a30);

/** Which faces a material draws: the shader's `part`. */
const ALL = 0;
const ONLY_LIT = 1;
const NOT_LIT = 2;

export class Materials {
  /** Normal and offset of the section plane, in the model's drawn units. */
  private readonly section = { value: new Vector4() };
  private readonly paint: { value: Texture };
  readonly surface: ShaderMaterial;
  /** What is lit, once more: where it is seen, nothing shines through it. */
  readonly lit: ShaderMaterial;
  /** What is lit, where something else hides it. */
  readonly through: ShaderMaterial;
  readonly edges: ShaderMaterial;
  readonly pick: ShaderMaterial;
  /** Counts, pixel by pixel, how many surfaces of a body are left behind the section plane: back ones less front ones. */
  readonly counts: readonly ShaderMaterial[];

  constructor(paint: Texture) {
    this.paint = { value: paint };
    this.surface = this.surfaceOf(ALL, 1);
    this.lit = this.surfaceOf(ONLY_LIT, 1);
    this.through = this.surfaceOf(ONLY_LIT, THROUGH);
    this.through.depthFunc = GreaterDepth;
    this.through.depthWrite = false;
    this.through.transparent = true;
    // it shines once through what hides it, and not through others that are lit
    for (const material of [this.lit, this.through]) {
      material.stencilWrite = true;
      material.stencilRef = 1;
      material.stencilZPass = ReplaceStencilOp;
    }
    this.through.stencilFunc = NotEqualStencilFunc;
    this.edges = this.made(PLAIN_VERTEX, PLAIN_FRAGMENT, { ink: { value: INK }, opacity: { value: 0.75 } });
    this.edges.transparent = true;
    this.pick = this.made(PICK_VERTEX, PICK_FRAGMENT, {});
    this.counts = [this.counting(BackSide, IncrementWrapStencilOp), this.counting(FrontSide, DecrementWrapStencilOp)];
  }

  /** Fills what a section cuts of a body: where the count is not 0 the plane is inside of it. The count is 0 after it. */
  cap(color: string, lean: 1 | -1): ShaderMaterial {
    const material = this.made(CAP_VERTEX, CAP_FRAGMENT, { ink: { value: new Color(color).convertLinearToSRGB() }, lean: { value: lean } });
    material.stencilWrite = true;
    material.stencilFunc = NotEqualStencilFunc;
    material.stencilZPass = material.stencilZFail = ZeroStencilOp;
    return material;
  }

  /** Makes all but what is lit transparent, or solid again. */
  seeThrough(on: boolean): void {
    const { uniforms } = this.surface;
    uniforms["part"]!.value = on ? NOT_LIT : ALL;
    uniforms["opacity"]!.value = on ? PALE : 1;
    this.surface.transparent = on;
    this.surface.depthWrite = !on;
    this.edges.uniforms["opacity"]!.value = on ? 0.35 : 0.75;
  }

  /** Cuts off what lies beyond the plane; undefined: nothing. */
  cut(plane: Vector4 | undefined): void {
    if (plane) this.section.value.copy(plane);
    for (const material of this.all) {
      if (("SECTION" in material.defines) === (plane !== undefined)) continue;
      if (plane) material.defines["SECTION"] = "";
      else delete material.defines["SECTION"];
      material.needsUpdate = true;
    }
  }

  dispose(): void {
    this.all.forEach((material) => material.dispose());
  }

  private get all(): ShaderMaterial[] {
    return [this.surface, this.through, this.lit, this.edges, this.pick, ...this.counts];
  }

  private counting(side: Side, operation: StencilOp): ShaderMaterial {
    const material = this.made(PLAIN_VERTEX, PLAIN_FRAGMENT, { ink: { value: INK }, opacity: { value: 1 } });
    material.side = side;
    material.depthTest = material.depthWrite = material.colorWrite = false;
    material.stencilWrite = true;
    material.stencilFunc = AlwaysStencilFunc;
    material.stencilZPass = operation;
    return material;
  }

  private surfaceOf(part: number, opacity: number): ShaderMaterial {
    const material = this.made(SURFACE_VERTEX, SURFACE_FRAGMENT, { part: { value: part }, opacity: { value: opacity } });
    material.polygonOffset = true;
    material.polygonOffsetFactor = material.polygonOffsetUnits = 1;
    material.depthFunc = LessEqualDepth;
    return material;
  }

  private made(vertexShader: string, fragmentShader: string, uniforms: ShaderMaterial["uniforms"]): ShaderMaterial {
    return new ShaderMaterial({
      glslVersion: GLSL3,
      vertexShader,
      fragmentShader,
      uniforms: { paint: this.paint, section: this.section, ...uniforms },
      defines: {},
      side: DoubleSide,
    });
  }
}
