// Functions of all shaders: the palette and contour lines.

/// Computes colours like core/palette.cpp and picture/paint.cpp. The including shader declares the uniforms low and
/// high.
export const colours = `
uniform vec3 stops[64];
uniform int last;
uniform float every, at;
uniform bool is_colour, has_line;
float position_of(float value) { return high == low ? 0.5 : clamp((value - low) / (high - low), 0.0, 1.0); }
vec3 colour_of(float value) {
  float along = position_of(value) * float(last);
  int left = min(int(along), last - 1);
  return mix(stops[left], stops[left + 1], along - float(left));
}
/// The part of a pixel that a contour line covers, by the difference from the line's value and the change of the
/// value from pixel to pixel.
float line(float away, float change) { return change > 0.0 ? clamp(1.0 - away / change, 0.0, 1.0) : 0.0; }
/// The part of a pixel that all lines cover, by the change of the value from pixel to pixel.
float line_part(float value, float change) {
  float covered = 0.0;
  if (every > 0.0 && change < every) covered = line(abs(fract(value / every + 0.5) - 0.5) * every, change);
  if (has_line) covered = max(covered, line(abs(value - at), change));
  return 0.8 * covered;
}
/// On dark colours lines are white, on others black.
float line_level(float value) { return dot(colour_of(value), vec3(0.3, 0.6, 0.1)) < 0.4 ? 1.0 : 0.0; }`;
