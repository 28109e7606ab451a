// How a surface point gets its colour: the one text that baker, triangles, relightable impostors and reference share.
//
// Colours are R, G, B in [0, 1] as files store them (display values, not linear light), and every average - samples of
// a texel, samples of a pixel, mip levels - is taken in that same space, which is also what multisampling of an
// RGBA8 target resolves in. Both faces of a surface are lit alike, so that a file's winding does not matter.
#ifndef FARCELL_SHADERS_SHARED_SHADING_H
#define FARCELL_SHADERS_SHARED_SHADING_H

#include "shaders/shared/portable.h"

FARCELL_SHARED_BEGIN

const float kAmbient = 0.25f;
const float kDiffuse = 0.75f;

// normal and light are unit vectors in world axes; light points to the sun.
FARCELL_SHARED float lightFactor(vec3 normal, vec3 light) { return kAmbient + kDiffuse * abs(dot(normal, light)); }

FARCELL_SHARED vec3 shade(vec3 albedo, vec3 normal, vec3 light) { return albedo * lightFactor(normal, light); }

// Mean of lightFactor over a texel of which only the mean vector of its normals is known. They are taken as spread
// evenly over a spherical cap: there dot(normal, light) has mean dot(mean, light) and the variance of a uniform
// distribution of half width w, with w^2 = (1 - r) (1 + 2 r - 3 dot(mean, light)^2 / r), r the length of the mean. For
// one normal it is lightFactor.
FARCELL_SHARED float meanLightFactor(vec3 mean, vec3 light) {
  float r = clamp(length(mean), 1e-3f, 1.0f);
  float along = abs(dot(mean, light));
  float square = max((1.0f - r) * (1.0f + 2.0f * r - 3.0f * along * along / r), 0.0f);
  float width = sqrt(square);
  float spread = along < width ? (along * along + square) / (2.0f * width) : along;
  return kAmbient + kDiffuse * spread;
}

// A filtered texel under a light. Both are premultiplied by its coverage: albedo, w the coverage, and the mean vector
// of its normals.
FARCELL_SHARED vec4 relit(vec4 albedo, vec3 normal, vec3 light) {
  float factor = meanLightFactor(normal / max(albedo.w, 1e-3f), light);
  return vec4(albedo.x * factor, albedo.y * factor, albedo.z * factor, albedo.w);
}

// Unit vector <-> [-1, 1]^2 (Cigolle et al., A Survey of Efficient Representations for Independent Unit Vectors, 2014).
FARCELL_SHARED vec2 octahedralFromUnit(vec3 n) {
  float scale = 1.0f / (abs(n.x) + abs(n.y) + abs(n.z));
  vec2 p = vec2(n.x * scale, n.y * scale);
  if (n.z >= 0.0f) return p;
  return vec2((1.0f - abs(p.y)) * (p.x >= 0.0f ? 1.0f : -1.0f), (1.0f - abs(p.x)) * (p.y >= 0.0f ? 1.0f : -1.0f));
}

FARCELL_SHARED vec3 unitFromOctahedral(vec2 p) {
  vec3 n = vec3(p.x, p.y, 1.0f - abs(p.x) - abs(p.y));
  if (n.z < 0.0f) {
    n = vec3((1.0f - abs(p.y)) * (p.x >= 0.0f ? 1.0f : -1.0f), (1.0f - abs(p.x)) * (p.y >= 0.0f ? 1.0f : -1.0f), n.z);
  }
  return normalize(n);
}

FARCELL_SHARED_END

#endif
