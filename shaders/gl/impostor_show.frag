// Included by all kinds of impostors when they show something else than the picture: SHOW_TINT, SHOW_DEPTH or
// SHOW_NORMALS as in shaders/shared/show.h. After `frame`, `edge`, `depths` and, where RELIGHTABLE, `normals`.
#include "shaders/shared/show.h"

layout(std430, binding = 0) readonly buffer Instances { ImpostorInstance instances[]; };
#ifdef RELIGHTABLE
vec3 impostorNormal(ImpostorView view, ivec2 texel) {
  vec3 mean = texelFetch(normals, ivec3(texel, int(view.boxMin.w)), 0).xyz;
  return mean / max(length(mean), 1e-3);
}
#else
float depthAt(ImpostorView view, ivec2 texel) {
  ivec2 inside = clamp(texel, ivec2(0), ivec2(int(edge.x) - 1));
  return texelFetch(depths, ivec3(inside, int(view.boxMin.w)), 0).r * 255.0;
}

// The smaller of the steps to the two neighbours that are known: the other may be a jump.
float slopeAt(ImpostorView view, ivec2 texel, ivec2 step) {
  float here = depthAt(view, texel);
  float after = depthAt(view, texel + step);
  float before = depthAt(view, texel - step);
  float forwards = after > 0.0 ? after - here : 1e9;
  float backwards = before > 0.0 ? here - before : 1e9;
  float slope = abs(forwards) < abs(backwards) ? forwards : backwards;
  return abs(slope) < 1e8 ? slope : 0.0;
}

// Of the surface that the depth image describes: where textureZ(p) = depth(textureX(p), textureY(p)).
vec3 impostorNormal(ImpostorView view, ivec2 texel) {
  return normalize(view.textureZ.xyz - slopeAt(view, texel, ivec2(1, 0)) * view.textureX.xyz -
                   slopeAt(view, texel, ivec2(0, 1)) * view.textureY.xyz);
}
#endif

// `seen`: premultiplied, at a texel of one of the views, `depth` root sides along the view axis from the
// eye; `along` points from there.
vec4 shownInstead(vec4 seen, int instance, int inView, vec2 texel, float depth, vec3 along) {
  if (seen.a <= 0.0) return seen;
#if defined(SHOW_TINT)
  return tinted(seen, instances[instance].tint.xyz);
#elif defined(SHOW_DEPTH)
  return vec4(vec3(depthGrey(depth, frame.depthScale)), 1.0) * seen.a;
#else
  return vec4(normalColour(impostorNormal(instances[instance].views[inView], ivec2(floor(texel))), along), 1.0) * seen.a;
#endif
}
