// Programs of the GPU (GLSL ES 3.0). Vertices have no attributes: their number (`gl_VertexID`) leads through
// tables of facets to nodes and from these to positions and values. Every program gets `COMMON` in front;
// names in capitals are defined by the materials in `skin`, `bars`, `arrows`, `obstacles`.

/** Reading of tables; positions of nodes as shown. */
const COMMON = /* glsl */ `
precision highp float;
precision highp int;
precision highp usampler2D;
uniform mat4 modelViewMatrix;
uniform mat4 projectionMatrix;
uniform highp sampler2D positions;
uniform highp sampler2D initials;
uniform float scale;
ivec2 at(int row) { return ivec2(row & 2047, row >> 11); }
vec3 place(int node) {
#ifdef INITIAL
  return texelFetch(initials, at(node), 0).xyz;
#endif
  vec3 x = texelFetch(positions, at(node), 0).xyz;
#ifdef SCALED
  vec3 initial = texelFetch(initials, at(node), 0).xyz;
  x = initial + scale * (x - initial);
#endif
  return x;
}
`;

/** Value of a facet or bar (`CELL`), of a node (`NODE`) or of a corner (`CORNER`); of no value the second number is 1. */
const VALUE = /* glsl */ `
uniform highp sampler2D values;
vec2 valueAt(int row) {
  float value = texelFetch(values, at(row), 0).x;
  return value > 1e38 ? vec2(0.0, 1.0) : vec2(value, 0.0);
}
`;

/** What vertices hand on of the value or the part that is shown, and what pixels get of it. */
const SHOWN = /* glsl */ `
#if defined(NODE) || defined(CORNER)
out vec2 value;
#endif
#ifdef CELL
flat out vec2 value;
#endif
#ifdef PART
flat out int part;
#endif`;
const SEEN = SHOWN.replaceAll("out ", "in ");

/** What lies beyond the plane of a section is not drawn; in the camera's coordinates. */
const CUT = /* glsl */ `
#if defined(SPACE) || defined(CLIP)
in vec3 seen;
#endif
#ifdef CLIP
uniform vec4 clip;
void cut() { if (dot(clip.xyz, seen) > clip.w) discard; }
#else
void cut() {}
#endif
`;

/** Colour of a value; nodes without a value do not take part in the mean of a facet's corners. */
const COLOUR = /* glsl */ `
precision highp float;
precision highp int;
uniform highp sampler2D colours;
uniform highp sampler2D partColours;
uniform vec2 range;
uniform float bands;
uniform vec3 noValue;
float shareOf(vec2 value) {
  return range.y > range.x ? (value.x / (1.0 - value.y) - range.x) / (range.y - range.x) : 0.0;
}
vec3 colourOf(vec2 value) {
  if (value.y > 0.5) return noValue;
  float t = clamp(shareOf(value), 0.0, 1.0);
  if (bands > 1.5) t = min(floor(t * bands), bands - 1.0) / (bands - 1.0);
  else if (bands > 0.5) t = 0.5;
  return texelFetch(colours, ivec2(int(floor(t * 255.0 + 0.5)), 0), 0).rgb;
}
`;

/**
 * Mirror planes, on which the surface continues in its image. Normals of corners (`SMOOTH`): the mean of the facets
 * around the node that have a small angle to the own one, as in pictures (`shade.rs`).
 */
const SMOOTH_VERTEX = /* glsl */ `
uniform vec3 halved;
uniform vec3 origin;
uniform float onPlane;
// On which mirror planes a node lies.
bvec3 onPlanes(vec3 x) {
  vec3 away = abs(x + origin);
  return bvec3(halved.x > 0.5 && away.x < onPlane, halved.y > 0.5 && away.y < onPlane, halved.z > 0.5 && away.z < onPlane);
}
// Whether two nodes lie on one plane, other than those in which the whole facet lies.
bool isShared(bvec3 a, bvec3 b, bvec3 whole) { return (a.x && b.x && !whole.x) || (a.y && b.y && !whole.y) || (a.z && b.z && !whole.z); }
#ifdef SMOOTH
uniform usampler2D starts;
uniform usampler2D around;
out vec3 smoothed;
vec3 normalOf(uvec4 raw) {
  uvec4 n = raw & 0x7fffffffu;
  vec3 normal = cross(place(int(n.z)) - place(int(n.x)), place(int(n.w)) - place(int(n.y)));
  float size = length(normal);
  return size > 0.0 ? normal / size : vec3(0.0);
}
vec3 normalAt(uvec4 raw, int node) {
  vec3 own = normalOf(raw);
  vec3 sum = vec3(0.0);
  int first = int(texelFetch(starts, at(node), 0).x);
  int last = min(int(texelFetch(starts, at(node + 1), 0).x), first + 32);
  for (int i = first; i < last; i++) {
    vec3 other = normalOf(texelFetch(facets, at(int(texelFetch(around, at(i), 0).x)), 0));
    if (dot(own, other) > 0.866) sum += other;
  }
  bvec3 there = onPlanes(place(node));
  for (int k = 0; k < 3; k++) if (there[k] && abs(own[k]) < 0.26) sum[k] = 0.0;
  return length(sum) > 0.0 ? sum : own;
}
#endif
`;

export const SKIN_VERTEX = /* glsl */ `${COMMON}${VALUE}
uniform usampler2D facets;
uniform usampler2D sources;
uniform usampler2D parts;
uniform int nodeRows;
uniform int firstRow;
${SMOOTH_VERTEX}
out vec2 corner;
flat out int flags;
#if defined(SPACE) || defined(CLIP)
out vec3 seen;
#endif
#ifdef PICK
flat out uint row;
#else
${SHOWN}
#endif
void main() {
  int facet = gl_VertexID >> 2;
  int own = gl_VertexID & 3;
  uvec4 raw = texelFetch(facets, at(facet), 0);
  uvec4 nodes = raw & 0x7fffffffu;
  uvec4 outline = raw >> 31;
  int node = int(own < 2 ? (own == 0 ? nodes.x : nodes.y) : (own == 2 ? nodes.z : nodes.w));
  // Where the body continues in its mirror image it has neither an outline nor a facet; a section may lie
  // there.
  bool isInside = false;
  if (dot(halved, halved) > 0.0) {
    bvec3 a = onPlanes(place(int(nodes.x))), b = onPlanes(place(int(nodes.y))), c = onPlanes(place(int(nodes.z))), d = onPlanes(place(int(nodes.w)));
    bvec3 whole = bvec3(a.x && b.x && c.x && d.x, a.y && b.y && c.y && d.y, a.z && b.z && c.z && d.z);
    if (isShared(a, b, whole)) outline.x = 0u;
    if (isShared(b, c, whole)) outline.y = 0u;
    if (isShared(c, nodes.z == nodes.w ? a : d, whole)) outline.z = 0u;
    if (isShared(d, a, whole)) outline.w = 0u;
#ifndef FAN
    isInside = any(whole);
#endif
  }
  flags = int(outline.x | outline.y << 1 | outline.z << 2 | outline.w << 3) | (nodes.z == nodes.w ? 16 : 0);
  corner = vec2(own == 1 || own == 2 ? 1.0 : 0.0, own >= 2 ? 1.0 : 0.0);
  vec4 x = modelViewMatrix * vec4(place(node), 1.0);
#if defined(SPACE) || defined(CLIP)
  seen = x.xyz;
#endif
#ifdef SMOOTH
  smoothed = mat3(modelViewMatrix) * normalAt(raw, node);
#endif
  int source = facet;
#ifdef COARSE
  source = int(texelFetch(sources, at(facet), 0).x);
#endif
#ifdef PICK
  row = uint(firstRow + source);
#else
#ifdef NODE
  value = valueAt(node);
#endif
#ifdef CORNER
#ifdef COARSE
  value = valueAt(nodeRows + node);
#else
  value = valueAt(4 * facet + own);
#endif
#endif
#ifdef CELL
  value = valueAt(source);
#endif
#ifdef PART
  part = int(texelFetch(parts, at(source), 0).x);
#endif
#endif
  gl_Position = isInside ? vec4(2.0, 2.0, 2.0, 1.0) : projectionMatrix * x;
}
`;

/** Lines of a facet by the distance to its sides in pixels: `x` how much of a mesh line, `y` how much of an outline. */
const LINES = /* glsl */ `
in vec2 corner;
flat in int flags;
uniform float pixel;
uniform float halfLine;
uniform float halfOutline;
vec2 linesOf() {
  bool triangle = (flags & 16) != 0;
  // Distances to the sides 0-1, 1-2, 2-3, 3-0; of a triangle (0,0) (1,0) (1,1) the third is the diagonal and
  // there is no fourth.
  vec4 side = triangle ? vec4(corner.y, 1.0 - corner.x, corner.x - corner.y, 1e9) : vec4(corner.y, 1.0 - corner.x, 1.0 - corner.y, corner.x);
  vec2 dx = dFdx(corner), dy = dFdy(corner);
  float u = length(vec2(dx.x, dy.x)), v = length(vec2(dx.y, dy.y));
  vec4 slope = vec4(v, u, triangle ? length(vec2(dx.x - dx.y, dy.x - dy.y)) : v, u);
  vec4 width = 1.0 / max(slope, vec4(1e-12));
  vec4 far = side * width;
  // Lines closer together than some pixels fade away: otherwise they cover the colours.
#ifdef FAN
  // The middle of a polygon of a section lies half as far away as its other sides.
  vec4 wide = 2.0 * width / pixel;
#else
  vec4 wide = width / pixel;
#endif
  vec4 fade = smoothstep(vec4(4.0), vec4(14.0), wide);
  vec4 near = clamp(halfLine + 0.5 - far, 0.0, 1.0) * fade;
#ifdef FAN
  // Of a triangle of a section only the first side is one of the polygon.
  near.yzw = vec3(0.0);
#endif
  ivec4 bits = ivec4(flags & 1, flags & 2, flags & 4, flags & 8);
  vec4 marked = vec4(notEqual(bits, ivec4(0)));
  vec4 border = clamp(halfOutline + 0.5 - far, 0.0, 1.0) * marked * smoothstep(vec4(5.0), vec4(14.0), wide);
  return vec2(max(max(near.x, near.y), max(near.z, near.w)), max(max(border.x, border.y), max(border.z, border.w)));
}
`;

/** Lines on a colour: ink, on dark colours light. */
const LINE_INK = /* glsl */ `
uniform vec3 ink;
float darkness(vec3 c) { return 1.0 - smoothstep(0.14, 0.3, dot(c, vec3(0.299, 0.587, 0.114))); }
vec3 lined(vec3 c, float isDark, float dark, float light) {
  return mix(c, mix(ink, vec3(1.0), isDark), mix(dark, light, isDark));
}
`;

/** Shading by the normal, or by the plane in which the neighbouring pixels lie; both sides are lit. Light and brightness are those of pictures (`shade.rs`). */
const SHADE = /* glsl */ `
#ifdef SMOOTH
in vec3 smoothed;
#endif
float shade() {
  vec3 normal = cross(dFdx(seen), dFdy(seen));
  float size = length(normal);
  if (!(size > 0.0)) return 1.0;
  normal *= (normal.z < 0.0 ? -1.0 : 1.0) / size;
#ifdef SMOOTH
  float reach = length(smoothed);
  if (reach > 0.0) normal = smoothed * (dot(smoothed, normal) < 0.0 ? -1.0 : 1.0) / reach;
#endif
  return 0.74 + 0.28 * max(dot(normal, vec3(-0.25, 0.5, 0.8291562)), 0.0);
}
`;

/** Lines of equal value at the borders of so many equal steps of the range. */
const ISO = /* glsl */ `
#if !defined(LINES) && !defined(OUTLINE)
uniform float pixel;
#endif
uniform float isoSteps;
float isoOf(vec2 value) {
  if (value.y > 0.5) return 0.0;
  float t = shareOf(value) * isoSteps;
  float slope = fwidth(t);
  if (!(slope > 0.0) || t < 0.5 || t > isoSteps - 0.5) return 0.0;
  float away = abs(fract(t + 0.5) - 0.5) / slope;
  // Lines closer together than some pixels fade away.
  return clamp(0.6 * pixel + 0.5 - away, 0.0, 1.0) * smoothstep(3.0, 8.0, 1.0 / (slope * pixel));
}
`;

export const SKIN_FRAGMENT = /* glsl */ `${COLOUR}
${CUT}
#if defined(LINES) || defined(OUTLINE)
${LINES}
#endif
#ifdef SPACE
${SHADE}
#endif
${SEEN}
#ifdef ISO
${ISO}
#endif
${LINE_INK}
out vec4 colour;
void main() {
#ifdef PART
  vec3 c = texelFetch(partColours, ivec2(part & 2047, part >> 11), 0).rgb;
#else
  vec3 c = colourOf(value);
#endif
#ifdef SPACE
  c *= shade();
#endif
  float isDark = darkness(c);
#ifdef ISO
  float iso = isoOf(value);
  c = lined(c, isDark, 0.8 * iso, 0.7 * iso);
#endif
#if defined(LINES) || defined(OUTLINE)
  vec2 line = linesOf();
#ifdef LINES
  c = lined(c, isDark, 0.55 * line.x, 0.22 * line.x);
#endif
  c = lined(c, isDark, 0.85 * line.y, 0.55 * line.y);
#endif
  cut();
  colour = vec4(c, 1.0);
}
`;

/** Row of a facet (or, after the facets, of a bar) as a colour: three bytes of row + 1, and which image. */
const CODE = /* glsl */ `
uniform float image;
out vec4 colour;
vec4 codeOf(uint row) {
  uint code = row + 1u;
  return vec4(float(code & 255u), float((code >> 8) & 255u), float((code >> 16) & 255u), 128.0 + image) / 255.0;
}
`;

export const PICK_FRAGMENT = /* glsl */ `
precision highp float;
precision highp int;
${CUT}
flat in uint row;
${CODE}
void main() {
  cut();
  colour = codeOf(row);
}
`;

export const BAR_VERTEX = /* glsl */ `${COMMON}${VALUE}
uniform usampler2D bars;
uniform vec2 canvas;
uniform float thickness;
uniform int firstBar;
out float across;
#ifdef CLIP
out vec3 seen;
#endif
#ifdef PICK
flat out uint row;
#else
${SHOWN}
#endif
void main() {
  int bar = gl_VertexID >> 2;
  int own = gl_VertexID & 3;
  uvec4 ends = texelFetch(bars, at(bar), 0);
  vec4 first = modelViewMatrix * vec4(place(int(ends.x)), 1.0);
  vec4 last = modelViewMatrix * vec4(place(int(ends.y)), 1.0);
  vec4 from = projectionMatrix * first;
  vec4 to = projectionMatrix * last;
  bool isEnd = own == 1 || own == 2;
  float side = own >= 2 ? 1.0 : -1.0;
  vec2 along = (to.xy - from.xy) * canvas;
  float size = length(along);
  along = size > 0.0 ? along / size : vec2(1.0, 0.0);
  gl_Position = isEnd ? to : from;
  vec2 reach = (vec2(-along.y, along.x) * side + along * (isEnd ? 0.5 : -0.5)) * thickness;
  gl_Position.xy += reach / canvas;
  across = side * thickness * 0.5;
#ifdef CLIP
  seen = (isEnd ? last : first).xyz;
#endif
#ifdef PICK
  row = uint(firstBar + bar);
#else
#ifdef NODE
  value = valueAt(int(isEnd ? ends.y : ends.x));
#endif
#ifdef CORNER
  value = valueAt(4 * firstBar + 2 * bar + (isEnd ? 1 : 0));
#endif
#ifdef CELL
  value = valueAt(firstBar + bar);
#endif
#ifdef PART
  part = int(ends.z);
#endif
#endif
}
`;

export const BAR_FRAGMENT = /* glsl */ `${COLOUR}
${CUT}
in float across;
uniform float thickness;
uniform float pixel;
uniform vec3 ink;
${SEEN}
out vec4 colour;
void main() {
#ifdef PART
  vec3 c = texelFetch(partColours, ivec2(part & 2047, part >> 11), 0).rgb;
#else
  vec3 c = colourOf(value);
#endif
  float border = clamp(abs(across) - 0.5 * thickness + pixel + 0.5, 0.0, 1.0);
  cut();
  colour = vec4(mix(c, ink, 0.8 * border), 1.0);
}
`;

/** Whether a place is beyond the plane of a section. */
const IS_CUT = /* glsl */ `
#ifdef CLIP
uniform vec4 clip;
bool isCut(vec3 x) { return dot(clip.xyz, x) > clip.w; }
#else
bool isCut(vec3 x) { return false; }
#endif
`;

/** Arrows that face the camera: nine vertices each, a shaft of two triangles and a head. */
export const ARROW_VERTEX = /* glsl */ `${COMMON}${IS_CUT}
uniform usampler2D arrowNodes;
uniform highp sampler2D arrowVectors;
uniform vec2 canvas;
uniform float longest;
uniform float largest;
uniform float halo;
uniform float pixel;
void main() {
  int arrow = gl_VertexID / 9;
  int own = gl_VertexID - 9 * arrow;
  vec3 force = texelFetch(arrowVectors, at(arrow), 0).xyz;
  int node = int(texelFetch(arrowNodes, at(arrow), 0).x);
  float size = length(force);
  vec4 tail = modelViewMatrix * vec4(place(node), 1.0);
  vec3 direction = mat3(modelViewMatrix) * (size > 0.0 ? force / size : vec3(0.0));
  vec4 tip = tail;
#ifdef LINEAR
  float reach = longest * size / max(largest, 1e-37);
#else
  float reach = longest * sqrt(size / max(largest, 1e-37));
#endif
  tip.xyz += direction * reach;
  bool isAway = isCut(tail.xyz);
#ifdef INWARD
  vec4 swapped = tip;
  tip = tail;
  tail = swapped;
#endif
  vec4 a = projectionMatrix * tail;
  vec4 b = projectionMatrix * tip;
  vec2 span = (b.xy - a.xy) * 0.5 * canvas;
  float shown = length(span);
  vec2 along = shown > 0.0 ? span / shown : vec2(0.0, 1.0);
  vec2 across = vec2(-along.y, along.x);
  float head = min(9.0 * pixel, 0.45 * shown);
  // Small arrows have a thin halo.
  float ring = min(halo, 0.06 * shown);
  float thick = min(1.1 * pixel, 0.12 * shown) + ring;
  float wide = 0.42 * head + 1.8 * ring;
  float end = shown + 2.2 * ring;
  float start = shown - head - ring;
  vec2 p;
  if (own < 6) {
    bool isFar = own == 1 || own == 2 || own == 4;
    bool left = own == 2 || own == 4 || own == 5;
    p = along * (isFar ? start + ring : -ring) + across * (left ? thick : -thick);
  } else {
    p = own == 6 ? along * end : along * start + across * (own == 7 ? wide : -wide);
  }
  if (shown < 1.5 * pixel || isAway) p = vec2(0.0);
  gl_Position = a;
  gl_Position.z = mix(a.z, b.z, 0.5) - 1e-4 + (halo > 0.0 ? 2e-5 : 0.0);
  gl_Position.xy += p * 2.0 / canvas;
}
`;

export const PLAIN_FRAGMENT = /* glsl */ `
precision highp float;
uniform vec4 paint;
out vec4 colour;
void main() { colour = paint; }
`;

/** A line of an obstacle in 2D: a band of hatching on the right of its direction, where it is solid. */
export const EDGE_VERTEX = /* glsl */ `${COMMON}
uniform usampler2D edges;
uniform vec2 canvas;
uniform float bandWidth;
uniform float lineWidth;
out float depth;
void main() {
  int edge = gl_VertexID >> 2;
  int own = gl_VertexID & 3;
  uvec4 ends = texelFetch(edges, at(edge), 0);
  vec4 a = modelViewMatrix * vec4(place(int(ends.x)), 1.0);
  vec4 b = modelViewMatrix * vec4(place(int(ends.y)), 1.0);
  vec3 way = place(int(ends.y)) - place(int(ends.x));
  vec3 right = mat3(modelViewMatrix) * vec3(way.y, -way.x, 0.0);
  float size = length(right.xy);
  vec2 side = size > 0.0 ? right.xy / size : vec2(0.0);
  vec2 along = size > 0.0 ? normalize(b.xy - a.xy) : vec2(0.0);
  bool isEnd = own == 1 || own == 2;
  bool isDeep = own >= 2;
  depth = isDeep ? bandWidth : -0.5 * lineWidth;
  gl_Position = projectionMatrix * (isEnd ? b : a);
  gl_Position.xy += (side * depth + along * (isEnd ? 0.5 : -0.5) * lineWidth) * 2.0 / canvas;
}
`;

export const EDGE_FRAGMENT = /* glsl */ `
precision highp float;
in float depth;
uniform float bandWidth;
uniform float lineWidth;
uniform float pixel;
uniform vec3 ink;
uniform vec3 solid;
out vec4 colour;
void main() {
  if (depth < 0.5 * lineWidth) { colour = vec4(ink, 1.0); return; }
  float stripe = mod((gl_FragCoord.x + gl_FragCoord.y) / pixel, 7.0);
  float line = clamp(1.6 - abs(stripe - 3.5) * 1.42, 0.0, 1.0);
  float fade = 1.0 - depth / bandWidth;
  colour = vec4(mix(solid, ink, 0.75 * line), (0.35 + 0.65 * line) * smoothstep(0.0, 0.5, fade));
}
`;

/** Facets of an obstacle in 3D: translucent, their edges drawn. */
export const WALL_FRAGMENT = /* glsl */ `
precision highp float;
precision highp int;
${LINES}
${CUT}
#ifdef SPACE
${SHADE}
#endif
uniform vec3 ink;
uniform vec3 solid;
uniform float cover;
uniform float lineCover;
out vec4 colour;
void main() {
  float line = linesOf().y;
#ifdef SPACE
  vec3 c = solid * shade();
#else
  vec3 c = solid;
#endif
  colour = vec4(mix(c, ink, line), mix(cover, lineCover, line));
}
`;
