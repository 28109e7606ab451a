// What the renderer tells its shaders: one layout for C++ and GLSL (std140 and std430 agree, all members are vec4).
//
// Positions relative to the eye are in grid steps. Clip coordinates: x and y as usual, w is the distance along the
// view axis in root sides, z the near distance: reversed depth z / w, 1 at the near plane, 0 at infinity.
#ifndef FARCELL_SHADERS_SHARED_DRAW_H
#define FARCELL_SHADERS_SHARED_DRAW_H

#include "shaders/shared/portable.h"

FARCELL_SHARED_BEGIN

struct FrameUniforms {
  vec4 clipX;  // xyz: clip x = dot(xyz, position)
  vec4 clipY;
  vec4 clipW;
  ivec4 eyeSteps;    // xyz: integer part of the eye's position on the grid
  vec4 eyeFraction;  // xyz: the rest of it, in steps; w: near distance, root sides
  vec4 light;        // xyz: towards it, unit, world axes
  vec4 image;        // x: log2 of samples on a pixel's edge, for the level of detail; y: adds to chance
  vec4 depthScale;   // for depthGrey (show.h), of depths in root sides
};

// One view of an impostor. Local: from the cell's centre, world axes, in half sides of the cell. Texture space: x, y in
// texels of the view (0 is the image's lower left corner), z in values of the depth image (1..254 + 1, linear in w).
struct ImpostorView {
  vec4 textureX;  // texture x = dot(xyz, local) + w
  vec4 textureY;
  vec4 textureZ;
  vec4 eye;     // xyz: the eye, texture space; w: edge of a texel in depth values
  vec4 boxMin;  // xyz: box of the view's content, texture space (an empty view: min > max); w: layer in the arrays
  vec4 boxMax;  // w: its weight where views are blended
};

// One impostor: its views, the first to be asked first (impostor_kind.h says which).
const int kImpostorViews = 3;
struct ImpostorInstance {
  vec4 centre;  // xyz: cell centre - eye, grid steps; w: half side, grid steps
  vec4 boxMin;  // xyz: content box, local; w: edge of a texel, half sides
  vec4 boxMax;  // w: its shares, a bit for each sample that shows it (hand_over.h)
  vec4 eye;     // xyz: the eye, local; w: added to log2(clip w) to get the level of detail
  vec4 tint;    // xyz: colour for what stands for cells instead of showing them (show.h); w: edge of a view in texels
  ImpostorView views[kImpostorViews];
};

// A cell's content box is drawn larger by this share of a texel on the sides away from the eye, so that neighbours'
// filtered edges meet.
const float kBoxPadTexels = 0.75f;

const float kMostProbes = 16.0f;  // of a texture, along a pixel's footprint
const float kAtlasLodBias = 0.0f;
const float kLodBias = -0.75f;  // sharper than the pixel's footprint asks: measured best

FARCELL_SHARED_END

#endif
