// What a frame shows instead of the picture itself: colours that stand for something (runtime/draw/show.h).
#ifndef FARCELL_SHADERS_SHARED_SHOW_H
#define FARCELL_SHADERS_SHARED_SHOW_H

#include "shaders/shared/portable.h"

FARCELL_SHARED_BEGIN

const float kTintFloor = 0.5f;  // brightness that a tint keeps where the picture is black

// The tint, as bright as the picture. `colour` is premultiplied by coverage.
FARCELL_SHARED vec4 tinted(vec4 colour, vec3 tint) {
  float luma = 0.299f * colour.x + 0.587f * colour.y + 0.114f * colour.z;
  vec3 shown = tint * (kTintFloor * colour.w + (1.0f - kTintFloor) * luma);
  return vec4(shown.x, shown.y, shown.z, colour.w);
}

// White at the nearest depth of the frame, black at the farthest, linear in its logarithm.
// scale.x: log2 of the nearest depth; scale.y: 1 / (log2 of the farthest - scale.x).
FARCELL_SHARED float depthGrey(float depth, vec4 scale) {
  return clamp(1.0f - (log2(depth) - scale.x) * scale.y, 0.0f, 1.0f);
}

// World axes as red, green and blue, -1..1 as 0..1. `along` points from the eye: of a surface's two normals the one
// towards the eye is shown, as a file's winding does not matter.
FARCELL_SHARED vec3 normalColour(vec3 normal, vec3 along) {
  float side = dot(normal, along) > 0.0f ? -0.5f : 0.5f;
  return normal * side + vec3(0.5f, 0.5f, 0.5f);
}

FARCELL_SHARED_END

#endif
