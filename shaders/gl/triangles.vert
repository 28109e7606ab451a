// Full triangles. Vertices are integers on the model's grid: the difference to the eye is exact, and the same for the
// cells on both sides of a shared corner, so that no cracks open.
//
// SHARES: for some of the samples only (hand_over.h).
// TEXTURED: the colour is multiplied with an atlas.
// SIDES: some triangles are seen from their front only.
// SHOW_TINT, SHOW_DEPTH, SHOW_NORMALS: what shaders/shared/show.h says, instead of the picture.
#include "shaders/shared/draw.h"
#include "shaders/shared/shading.h"

layout(std140, binding = 0) uniform Frame { FrameUniforms frame; };

layout(location = 0) in ivec3 position;  // grid steps
layout(location = 1) in vec4 colour;
layout(location = 2) in vec2 normal;     // octahedral; flat faces: of the provoking vertex's triangle
#if defined(SHOW_TINT) || defined(SHARES)
layout(location = 3) in vec4 perDraw;    // rgb: a colour; a: shares of a cut, a bit each
flat out vec3 tint;
flat out int shares;
#endif
#ifdef SHOW_NORMALS
out vec3 along;  // from the eye
#endif
#ifdef SIDES
flat out float seenFromBehind;
#endif
#ifdef TEXTURED
layout(location = 4) in vec2 coordinates;  // on the atlas
centroid out vec2 onAtlas;                 // not beyond the triangle, where the atlas holds something else
#endif

out vec3 albedo;
#ifdef SMOOTH_NORMALS
out vec3 surfaceNormal;
#else
flat out float light;
flat out vec4 shown;  // in full for a triangle that says what it shows
flat out vec3 faceNormal;
#endif

void main() {
  vec3 relative = vec3(position - frame.eyeSteps.xyz) - frame.eyeFraction.xyz;
  gl_Position = vec4(dot(frame.clipX.xyz, relative), dot(frame.clipY.xyz, relative), frame.eyeFraction.w,
                     dot(frame.clipW.xyz, relative));
  albedo = colour.rgb;
  vec3 unit = unitFromOctahedral(normal);
#ifdef SMOOTH_NORMALS
  surfaceNormal = unit;
#else
  light = lightFactor(unit, frame.light.xyz);
  shown = vec4(colour.rgb, colour.a == 0.0 ? 1.0 : 0.0);
  faceNormal = unit;
#endif
#if defined(SHOW_TINT) || defined(SHARES)
  tint = perDraw.rgb;
  shares = int(perDraw.a * 255.0 + 0.5);
#endif
#ifdef SHOW_NORMALS
  along = relative;
#endif
#ifdef SIDES
  seenFromBehind = colour.a == 0.0 || colour.a == 1.0 ? 1.0 : 0.0;
#endif
#ifdef TEXTURED
  onAtlas = coordinates;
#endif
}
