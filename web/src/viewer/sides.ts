// Where a model is looked at from, by the names that the product uses: the front is seen from -y, the top from +z.

export const SIDES = ["isometric", "front", "back", "left", "right", "top", "bottom"] as const;
export type Side = (typeof SIDES)[number];

const RIGHT_ANGLE = Math.PI / 2;

/** Azimuth about z from the front, and polar angle from z, of the camera; radians. */
export const LOOKS: Record<Side, readonly [azimuth: number, polar: number]> = {
  isometric: [Math.PI / 4, Math.acos(1 / Math.sqrt(3))],
  front: [0, RIGHT_ANGLE],
  back: [Math.PI, RIGHT_ANGLE],
  left: [-RIGHT_ANGLE, RIGHT_ANGLE],
  right: [RIGHT_ANGLE, RIGHT_ANGLE],
  top: [0, 0],
  bottom: [0, Math.PI],
};

/** The keys of the sides, while the view has the focus. */
export const SIDE_KEYS: Readonly<Record<string, Side>> = {
  0: "isometric",
  1: "front",
  2: "back",
  3: "left",
  4: "right",
  5: "top",
  6: "bottom",
};
