// What a section cuts is filled: material is seen as material, and not as the inside of a shell.

import { BufferGeometry, Group, Mesh, PlaneGeometry, Vector3, type ShaderMaterial, type Vector4 } from "three";
import type { Materials } from "./materials";
import type { Model } from "./model";

/** With more bodies than this, all are filled at once, in one colour. */
const MOST_OWN = 64;
const ONE_COLOR = "#c0946a";
/** Half the side of the square that is filled: a model reaches no farther than 1 from its middle. */
const REACH = 1.1;
/** Before everything else that is drawn. */
const FIRST = -1000;

interface Cap {
  /** A body's triangles, or all. */
  readonly body: BufferGeometry;
  readonly fill: Mesh<PlaneGeometry, ShaderMaterial>;
}

/**
 * A square in the section plane for each body, drawn where the plane is inside of the body (the stencil test of
 * constructive solid geometry: along a line of sight, behind the plane, a closed body has one back more than fronts).
 */
export class Caps {
  readonly group = new Group();
  private readonly caps: Cap[] = [];
  private drawn: BufferGeometry | undefined;

  constructor(model: Model, materials: Materials) {
    const colors = model.bodies.length > MOST_OWN ? [ONE_COLOR] : model.bodies.map((body) => body.color);
    const square = new PlaneGeometry(2 * REACH, 2 * REACH);
    colors.forEach((color, index) => {
      const body = new BufferGeometry();
      const fill = new Mesh(square, materials.cap(color, index % 2 ? -1 : 1));
      const passes = [...materials.counts.map((material) => new Mesh(body, material)), fill];
      passes.forEach((mesh, pass) => {
        mesh.frustumCulled = false;
        mesh.renderOrder = FIRST + index * passes.length + pass;
        this.group.add(mesh);
      });
      this.caps.push({ body, fill });
    });
    // whatever was counted where no square is
    this.caps.at(-1)!.fill.onAfterRender = (renderer) => renderer.clearStencil();
    this.use(model.surface);
    this.cut(undefined);
  }

  /** Fills what this plane cuts: normal and offset; undefined: nothing is cut. */
  cut(plane: Vector4 | undefined): void {
    this.group.visible = plane !== undefined;
    if (!plane) return;
    const normal = new Vector3(plane.x, plane.y, plane.z);
    for (const { fill } of this.caps) {
      fill.position.copy(normal).multiplyScalar(plane.w);
      fill.quaternion.setFromUnitVectors(new Vector3(0, 0, 1), normal);
    }
  }

  /** Counts by this surface, whose groups are the bodies. */
  use(surface: BufferGeometry): void {
    if (surface === this.drawn) return;
    this.drawn = surface;
    const all = { start: 0, count: surface.getIndex()!.count };
    this.caps.forEach(({ body }, index) => {
      const { start, count } = this.caps.length === surface.groups.length ? surface.groups[index]! : all;
      for (const name of ["position", "face"]) body.setAttribute(name, surface.getAttribute(name));
      body.setIndex(surface.getIndex());
      body.setDrawRange(start, count);
    });
  }

  dispose(): void {
    this.caps.forEach(({ body, fill }) => {
      body.dispose();
      fill.geometry.dispose();
      fill.material.dispose();
    });
  }
}
