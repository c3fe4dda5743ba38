// The 3D view: a model, the camera about it, what is lit, cut and picked. Draws only when something changed.

import CameraControls from "camera-controls";
import {
  Box3,
  FloatType,
  LineSegments,
  Matrix4,
  Mesh,
  NearestFilter,
  OrthographicCamera,
  Quaternion,
  Raycaster,
  Scene,
  Sphere,
  Spherical,
  Vector2,
  Vector3,
  Vector4,
  WebGLRenderer,
  WebGLRenderTarget,
} from "three";
import { Caps } from "./caps";
import { Materials } from "./materials";
import type { Model } from "./model";
import { Pace, drawsInSoftware } from "./pace";
import { Paint, type Light } from "./paint";
import { LOOKS, type Side } from "./sides";
import { Snapping, type Snap } from "./snapping";

CameraControls.install({
  THREE: { Box3, Matrix4, Quaternion, Raycaster, Sphere, Spherical, Vector2, Vector3, Vector4 },
});

/** The camera's distance from what it looks at; orthographic, it decides only what lies before it. */
const DISTANCE = 6;
const MARGIN = 1.12;
/** Pixels that a pointer may move between down and up, and still have clicked. */
const CLICK_PX = 5;
const NARROW_PX = 520;
/** How far behind what is seen a point may be that is snapped to, of the model's half diagonal. */
const HIDDEN_BELOW = 0.01;

export type Axis = "x" | "y" | "z";

/** What is under the pointer. */
export interface Hit {
  readonly face: number;
  /** In the model's drawn units. */
  readonly point: Vector3;
}

interface Shown {
  readonly model: Model;
  readonly paint: Paint;
  readonly materials: Materials;
  /** The surface as each material draws it. */
  readonly surfaces: readonly Mesh[];
  readonly edges: LineSegments;
  readonly caps: Caps;
  readonly snapping: Snapping;
}

export class Viewer {
  readonly canvas: HTMLCanvasElement;
  /** What was clicked, and where on the page; undefined: nothing is there. */
  onClick: (hit: Hit | undefined, clientX: number, clientY: number) => void = () => {};
  /** After each frame, for what is written over the view. */
  onFrame: () => void = () => {};

  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly pickScene = new Scene();
  private readonly camera = new OrthographicCamera(-1, 1, 1, -1, 0.01, 2 * DISTANCE);
  private readonly controls: CameraControls;
  private readonly pace = new Pace();
  private readonly pixel = new WebGLRenderTarget(1, 1, { type: FloatType, minFilter: NearestFilter, magFilter: NearestFilter });
  private readonly still = matchMedia("(prefers-reduced-motion: reduce)");
  private readonly software: boolean;
  private shown: Shown | undefined;
  private plane: Vector4 | undefined;
  private wantsEdges = true;
  private isTransparent = false;
  private dirty = true;
  private moving = false;
  private last = 0;

  /** Raises an Error where the browser has no WebGL 2. */
  constructor(private readonly holder: HTMLElement) {
    this.software = drawsInSoftware();
    this.renderer = new WebGLRenderer({ antialias: !this.software, alpha: true, stencil: true, powerPreference: "high-performance" });
    this.canvas = this.renderer.domElement;
    holder.append(this.canvas);
    this.camera.up.set(0, 0, 1);
    this.controls = new CameraControls(this.camera, this.canvas);
    this.controls.minZoom = 0.2;
    this.controls.maxZoom = 400;
    this.controls.dollyToCursor = true;
    this.controls.smoothTime = 0.15;
    this.controls.draggingSmoothTime = 0.05;
    const { ACTION } = CameraControls;
    Object.assign(this.controls.mouseButtons, { left: ACTION.ROTATE, right: ACTION.TRUCK, middle: ACTION.TRUCK, wheel: ACTION.ZOOM });
    Object.assign(this.controls.touches, { one: ACTION.TOUCH_ROTATE, two: ACTION.TOUCH_ZOOM_TRUCK, three: ACTION.TOUCH_TRUCK });
    void this.controls.setLookAt(0, -DISTANCE, 0, 0, 0, 0, false);
    this.listen();
    new ResizeObserver(() => this.resize()).observe(holder);
    this.resize();
    requestAnimationFrame((now) => this.tick(now));
  }

  /** Is there no room beside the model for many labels? */
  get isNarrow(): boolean {
    return this.canvas.clientWidth < NARROW_PX;
  }

  get model(): Model | undefined {
    return this.shown?.model;
  }

  /** Shows a model from its isometric side, or none. */
  show(model: Model | undefined): void {
    this.clear();
    if (model) {
      const paint = new Paint(model.bodies, model.faceCount);
      const materials = new Materials(paint.texture);
      materials.seeThrough(this.isTransparent);
      const surface = new Mesh(model.surface, materials.surface);
      const lit = new Mesh(model.surface, materials.lit);
      const edges = new LineSegments(model.edges, materials.edges);
      const through = new Mesh(model.surface, materials.through);
      [surface, lit, edges, through].forEach((each, order) => {
        each.frustumCulled = false; // the model is one object: it is seen, or all of it is outside
        each.renderOrder = order;
        this.scene.add(each);
      });
      const picked = new Mesh(model.surface, materials.pick);
      picked.frustumCulled = false;
      this.pickScene.add(picked);
      const caps = new Caps(model, materials);
      this.scene.add(caps.group);
      const snapping = new Snapping(model.edges);
      this.shown = { model, paint, materials, surfaces: [surface, lit, through], edges, caps, snapping };
      this.pace.begin(this.software && model.coarser.length > 0);
      void this.look("isometric", false);
    }
    this.redraw();
  }

  /** Turns to a side and fits the model; the promise ends with the movement. */
  async look(side: Side, smooth = true): Promise<void> {
    const [azimuth, polar] = LOOKS[side];
    const animate = smooth && !this.still.matches;
    this.controls.normalizeRotations();
    await Promise.all([
      this.controls.rotateTo(azimuth, polar, animate),
      this.controls.moveTo(0, 0, 0, animate),
      this.controls.zoomTo(this.fitting(azimuth, polar), animate),
    ]);
  }

  /** Fits the model as it is turned. */
  async fit(): Promise<void> {
    const { azimuthAngle, polarAngle } = this.controls;
    const animate = !this.still.matches;
    await Promise.all([
      this.controls.moveTo(0, 0, 0, animate),
      this.controls.zoomTo(this.fitting(azimuthAngle, polarAngle), animate),
    ]);
  }

  /** Turns by angles in radians. */
  turn(azimuth: number, polar: number): void {
    void this.controls.rotate(azimuth, polar, !this.still.matches);
  }

  /** Moves the view by shares of what is seen. */
  pan(right: number, down: number): void {
    const seen = 2 / this.camera.zoom;
    void this.controls.truck(right * seen, down * seen, !this.still.matches);
  }

  zoomBy(factor: number): void {
    void this.controls.zoomTo(this.camera.zoom * factor, !this.still.matches);
  }

  /** The camera as a short text, for links. */
  get pose(): string {
    const target = this.controls.getTarget(new Vector3());
    const { azimuthAngle, polarAngle } = this.controls;
    return [azimuthAngle, polarAngle, this.camera.zoom, ...target.toArray()].map((value) => Number(value.toFixed(4))).join(",");
  }

  /** Takes the camera to a pose; a text that is none changes nothing. */
  set pose(text: string) {
    const [azimuth, polar, zoom, x, y, z, ...more] = text.split(",").map(Number);
    const numbers = [azimuth, polar, zoom, x, y, z];
    if (more.length || !numbers.every((value) => Number.isFinite(value))) return;
    void this.controls.rotateTo(azimuth!, polar!, false);
    void this.controls.moveTo(x!, y!, z!, false);
    void this.controls.zoomTo(zoom!, false);
    this.redraw();
  }

  light(lights: readonly Light[]): void {
    this.shown?.paint.light(lights);
    this.redraw();
  }

  point(light: Light | undefined): void {
    this.shown?.paint.point(light);
    this.redraw();
  }

  /** Which faces are lit, in which colour? */
  get lit(): Map<number, string> {
    return this.shown?.paint.lit() ?? new Map();
  }

  showBody(body: number, shown: boolean): void {
    this.shown?.paint.show(body, shown);
    this.redraw();
  }

  isBodyShown(body: number): boolean {
    return this.shown?.paint.isShown(body) ?? true;
  }

  set edges(shown: boolean) {
    this.wantsEdges = shown;
    this.redraw();
  }

  set transparent(on: boolean) {
    this.isTransparent = on;
    this.shown?.materials.seeThrough(on);
    this.redraw();
  }

  /** Cuts the model square to an axis, at a share of its size from the low end; undefined: not at all. */
  section(axis: Axis | undefined, share = 0.5, flipped = false): void {
    if (!this.shown) return;
    const { model, materials, caps } = this.shown;
    this.plane = undefined;
    if (axis !== undefined) {
      const sign = flipped ? -1 : 1;
      this.plane = new Vector4(0, 0, 0, (2 * share - 1) * model.half[axis] * sign);
      this.plane[axis] = sign;
    }
    materials.cut(this.plane);
    caps.cut(this.plane);
    this.redraw();
  }

  /** What is seen at this place of the page? */
  pick(clientX: number, clientY: number): Hit | undefined {
    if (!this.shown) return undefined;
    const { left, top, width, height } = this.canvas.getBoundingClientRect();
    const [x, y] = [Math.floor(clientX - left), Math.floor(clientY - top)];
    this.camera.setViewOffset(width, height, x, y, 1, 1);
    const color = this.renderer.getClearAlpha();
    this.renderer.setClearAlpha(0);
    this.renderer.setRenderTarget(this.pixel);
    this.renderer.render(this.pickScene, this.camera);
    const found = new Float32Array(4);
    this.renderer.readRenderTargetPixels(this.pixel, 0, 0, 1, 1, found);
    this.renderer.setRenderTarget(null);
    this.renderer.setClearAlpha(color);
    this.camera.clearViewOffset();
    const [id, depth] = [found[0] ?? 0, found[1] ?? 0];
    if (id < 1) return undefined;
    const seen = new Vector3(((x + 0.5) / width) * 2 - 1, 1 - ((y + 0.5) / height) * 2, depth * 2 - 1);
    return { face: Math.round(id) - 1, point: seen.unproject(this.camera) };
  }

  /** The corner, middle of an edge or centre of a circle at this place of the page, `hit` being what is seen there. */
  snap(clientX: number, clientY: number, hit: Hit | undefined): Snap | undefined {
    if (!this.shown) return undefined;
    const { paint, snapping } = this.shown;
    const { left, top } = this.canvas.getBoundingClientRect();
    const depthOf = (point: Vector3): number => point.clone().applyMatrix4(this.camera.matrixWorldInverse).z;
    const behind = hit ? depthOf(hit.point) - HIDDEN_BELOW : -Infinity;
    const isSeen = (point: Vector3, face: number): boolean =>
      depthOf(point) > behind && paint.isFaceShown(face) && !(this.plane && isBeyond(point, this.plane));
    return snapping.at({ x: clientX - left, y: clientY - top }, (point) => this.project(point), isSeen, depthOf);
  }

  /** A direction of the file as it is seen: x to the right, y up, z towards the viewer. */
  turned(way: Vector3): Vector3 {
    return way.clone().transformDirection(this.camera.matrixWorldInverse);
  }

  /** Where on the canvas a drawn point is seen, in CSS pixels from its top left. */
  project(point: Vector3): { x: number; y: number } {
    const seen = point.clone().project(this.camera);
    return { x: ((seen.x + 1) / 2) * this.canvas.clientWidth, y: ((1 - seen.y) / 2) * this.canvas.clientHeight };
  }

  /** What is seen, drawn anew with all there is, for a picture. */
  snapshot(): HTMLCanvasElement {
    this.draw(true);
    return this.canvas;
  }

  /** How many frames a second does this machine draw while the model turns once? */
  async spin(frames = 90): Promise<number> {
    const start = performance.now();
    for (let frame = 0; frame < frames; frame += 1) {
      void this.controls.rotate((2 * Math.PI) / frames, 0, false);
      await new Promise(requestAnimationFrame);
    }
    return (frames * 1000) / (performance.now() - start);
  }

  private clear(): void {
    this.scene.clear();
    this.pickScene.clear();
    this.shown?.caps.dispose();
    this.shown?.paint.dispose();
    this.shown?.materials.dispose();
    this.shown?.model.dispose();
    this.shown = this.plane = undefined;
  }

  /** The zoom at which the model's box fills the view as it is seen from there. */
  private fitting(azimuth: number, polar: number): number {
    const half = this.shown?.model.half ?? new Vector3(1, 1, 1);
    const back = new Vector3(Math.sin(polar) * Math.sin(azimuth), -Math.sin(polar) * Math.cos(azimuth), Math.cos(polar));
    const right = new Vector3(Math.cos(azimuth), Math.sin(azimuth), 0);
    const up = back.clone().cross(right);
    const along = (way: Vector3): number => Math.abs(way.x) * half.x + Math.abs(way.y) * half.y + Math.abs(way.z) * half.z;
    const { right: across } = this.camera;
    return Math.min(across / along(right), 1 / along(up)) / MARGIN;
  }

  private redraw(): void {
    this.dirty = true;
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.holder;
    if (!width || !height) return;
    this.camera.right = width / height;
    this.camera.left = -this.camera.right;
    this.camera.updateProjectionMatrix();
    this.draw(!this.moving);
  }

  private tick(now: number): void {
    requestAnimationFrame((next) => this.tick(next));
    const moved = this.controls.update(Math.min(0.1, (now - this.last) / 1000));
    this.last = now;
    if (moved) {
      this.pace.moved(now);
      this.draw(false);
    } else if (this.dirty || this.moving) {
      this.draw(true);
    }
    this.moving = moved;
  }

  private draw(whole: boolean): void {
    this.dirty = false;
    const quality = this.pace.quality;
    const ratio = Math.min(devicePixelRatio, 2) * (whole ? 1 : quality.resolution);
    const { clientWidth: width, clientHeight: height } = this.holder;
    const [wide, high] = [Math.floor(width * ratio), Math.floor(height * ratio)];
    if (this.canvas.width !== wide || this.canvas.height !== high) {
      this.renderer.setPixelRatio(ratio);
      this.renderer.setSize(width, height);
    }
    if (this.shown) {
      const { edges, paint, materials, surfaces, model, caps } = this.shown;
      const geometry = (!whole && model.coarser.slice(0, quality.coarser).at(-1)) || model.surface;
      for (const surface of surfaces) surface.geometry = geometry;
      caps.use(geometry);
      edges.visible = this.wantsEdges && (whole || quality.edges);
      materials.through.visible = paint.anythingLit && !this.isTransparent;
      materials.lit.visible = paint.anythingLit;
    }
    this.renderer.render(this.scene, this.camera);
    this.onFrame();
  }

  private listen(): void {
    let down: { x: number; y: number } | undefined;
    this.canvas.addEventListener("pointerdown", (event) => {
      down = { x: event.clientX, y: event.clientY };
    });
    this.canvas.addEventListener("pointerup", (event) => {
      const clicked = down && Math.hypot(event.clientX - down.x, event.clientY - down.y) <= CLICK_PX && event.button === 0;
      down = undefined;
      if (clicked) this.onClick(this.pick(event.clientX, event.clientY), event.clientX, event.clientY);
    });
    this.canvas.addEventListener("webglcontextrestored", () => this.redraw());
  }
}

const isBeyond = (point: Vector3, plane: Vector4): boolean => plane.x * point.x + plane.y * point.y + plane.z * point.z > plane.w + 1e-6;
