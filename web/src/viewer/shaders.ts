// One vertex program for all that is drawn of the model: what a face looks like stands in a texture, a texel a face.

/** Red, green, blue of a face, and in the alpha channel what it is: hidden, shown, or lit. */
export const HIDDEN = 0;
export const SHOWN = 128;
export const LIT = 255;

/** Texels in a row of the texture of faces. */
export const PAINT_WIDTH = 1024;

const FACE = /* glsl */ `
uniform sampler2D paint;
in float face;
vec4 painted() {
  int id = int(face + 0.5);
  return texelFetch(paint, ivec2(id % ${PAINT_WIDTH}, id / ${PAINT_WIDTH}), 0);
}
const vec4 NOWHERE = vec4(0.0, 0.0, 2.0, 1.0);
`;

// What lies beyond the section plane is cut off: its points are on the far side of `section` (normal, offset).
const CUT = /* glsl */ `
#ifdef SECTION
uniform vec4 section;
in float beyond;
void cut() { if (beyond > 0.0) discard; }
#else
void cut() {}
#endif
`;
const CUT_VERTEX = /* glsl */ `
#ifdef SECTION
uniform vec4 section;
out float beyond;
void cut(vec3 place) { beyond = dot(section.xyz, place) - section.w; }
#else
void cut(vec3 place) {}
#endif
`;

/** Light is worked out at the vertices: a software renderer draws several times more pixels than there are vertices. */
export const SURFACE_VERTEX = /* glsl */ `
${FACE}
${CUT_VERTEX}
uniform int part; // 0: all that is shown, 1: what is lit, 2: what is not
out vec3 color;
void main() {
  vec4 own = painted();
  bool lit = own.a > 0.75;
  if (own.a < 0.25 || (part == 1 && !lit) || (part == 2 && lit)) { gl_Position = NOWHERE; return; }
  vec3 n = normalize(normalMatrix * normal);
  float light = 0.46 + 0.34 * max(dot(n, vec3(-0.45, 0.60, 0.66)), 0.0) + 0.26 * abs(n.z);
  color = own.rgb * light;
  cut(position);
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;

export const SURFACE_FRAGMENT = /* glsl */ `
${CUT}
uniform float opacity;
in vec3 color;
out vec4 pixel;
void main() {
  cut();
  pixel = vec4(color, opacity);
}`;

/** In one colour: edges, and the count of the bodies that a section goes through. */
export const PLAIN_VERTEX = /* glsl */ `
${FACE}
${CUT_VERTEX}
void main() {
  if (painted().a < 0.25) { gl_Position = NOWHERE; return; }
  cut(position);
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;

export const PLAIN_FRAGMENT = /* glsl */ `
${CUT}
uniform vec3 ink;
uniform float opacity;
out vec4 pixel;
void main() { cut(); pixel = vec4(ink, opacity); }`;

/** Material that a section cuts: hatched as on a drawing, one way or the other, so that neighbours are told apart. */
export const CAP_VERTEX = /* glsl */ `
void main() { gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }`;

export const CAP_FRAGMENT = /* glsl */ `
uniform vec3 ink;
uniform float lean;
out vec4 pixel;
void main() {
  float stripe = mod(gl_FragCoord.x + lean * gl_FragCoord.y, 9.0) < 1.5 ? 0.4 : 0.92;
  pixel = vec4(ink * stripe, 1.0);
}`;

/** Which face is under the pointer, and how deep: a picture of one pixel in numbers. */
export const PICK_VERTEX = /* glsl */ `
${FACE}
${CUT_VERTEX}
flat out float id;
void main() {
  if (painted().a < 0.25) { gl_Position = NOWHERE; return; }
  id = face;
  cut(position);
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;

export const PICK_FRAGMENT = /* glsl */ `
${CUT}
flat in float id;
out vec4 pixel;
void main() {
  cut();
#ifdef SECTION
  if (!gl_FrontFacing) { pixel = vec4(0.0); return; } // behind the cut
#endif
  pixel = vec4(id + 1.0, gl_FragCoord.z, 0.0, 1.0);
}`;
