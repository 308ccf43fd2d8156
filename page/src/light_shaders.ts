// Shaders for objects in the light of a sun and a sky: the visible part of the sun, and the colours of lit surfaces.
import { colours } from "./colours";

/// The visible part of the sun's disc, as seen from a point. Objects that hide the sun are found first, because their
/// distance determines how soft the shadow is. Depth maps contain coordinates of −1 … 1, which are larger farther away
/// from the light, and 1 where there is no object.
export const shadow = `#version 300 es
precision highp float;
precision highp sampler2D;
uniform sampler2D depth;
uniform mat4 to_sun;
uniform vec3 sun;
uniform float size;
/// A spiral of points that fills the unit disc.
vec2 on_disc(int k, int count, float turn) {
  float angle = 2.39996 * float(k) + turn;
  return sqrt((float(k) + 0.5) / float(count)) * vec2(cos(angle), sin(angle));
}
/// How far a point is below the first surface that the light reaches. 0 if the light reaches nothing or this point.
float below(vec3 here, vec2 by, float slack) {
  float there = textureLod(depth, here.xy + by, 0.0).r;
  return there < 1.0 && there < here.z - slack ? here.z - there : 0.0;
}
float sun_part(vec3 place, vec3 normal, float turn) {
  if (dot(normal, sun) <= 0.0) return 0.0;
  vec3 here = 0.5 + 0.5 * (to_sun * vec4(place + 0.006 * size * normal, 1)).xyz;
  if (any(greaterThan(abs(here.xy - 0.5), vec2(0.53)))) return 1.0;
  float blockers = 0.0, away = 0.0, lit = 0.0;
  for (int k = 0; k < 16; ++k) {
    float how_far = below(here, 0.03 * on_disc(k, 16, turn), 0.002);
    if (how_far > 0.0) { blockers += 1.0; away += how_far; }
  }
  if (blockers == 0.0) return 1.0;
  float radius = clamp(0.12 * away / blockers, 0.0015, 0.03);
  for (int k = 0; k < 24; ++k) lit += below(here, radius * on_disc(k, 24, turn), 0.002 + 0.1 * radius) > 0.0 ? 0.0 : 1.0;
  return lit / 24.0;
}`;

export const shade = `${shadow}
in vec3 place, toward, seen;
in vec2 sky_parts;  // The light of the side to which the normal points, and of the other side.
in float sun_light;
uniform vec3 eye, middle;
out vec4 colour;
vec3 light_of(vec3 stored) { return mix(stored / 12.92, pow((stored + 0.055) / 1.055, vec3(2.4)), step(0.04045, stored)); }
vec3 stored_of(vec3 light) { return mix(light * 12.92, 1.055 * pow(light, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, light)); }`;

/// Draws the surface. If values change much within a pixel, the pixel has the mean of their colours.
export const surface = `${shade}
uniform float low, high;
${colours}
vec3 look() {
  if (is_colour) return light_of(clamp(seen, 0.0, 1.0));
  float change = fwidth(seen.r), covered = line_part(seen.r, change);
  vec3 sum = vec3(0);
  for (int k = 0; k < 4; ++k) sum += light_of(colour_of(seen.r + (float(k) - 1.5) / 4.0 * change));
  return mix(sum / 4.0, vec3(line_level(seen.r)), covered);
}
void main() {
  vec3 light = look();
  if (isnan(seen.r)) discard;
  vec3 to_eye = normalize(eye - place), outward = normalize(toward);
  // At the rim a triangle may face away from the viewer although the surface does not yet.
  bool is_outside = gl_FrontFacing || dot(outward, to_eye) > -0.08;
  vec3 normal = is_outside ? outward : -outward;
  float gleam = 0.06 * pow(max(0.0, dot(normal, normalize(sun + to_eye))), 40.0);
  float bright = 0.72 * max(0.0, dot(normal, sun));
  colour = vec4(stored_of(min(light * (bright * sun_light + 0.42 * (is_outside ? sky_parts.x : sky_parts.y)) + gleam * sun_light, 1.0)), 1);
}`;

/// Draws depth maps. Cells without a value are holes.
export const hidden = `#version 300 es
precision highp float;
in vec3 seen;
out vec4 colour;
void main() { if (isnan(seen.r)) discard; colour = vec4(0); }`;
