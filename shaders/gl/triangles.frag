#include "shaders/shared/draw.h"
#include "shaders/shared/shading.h"
#include "shaders/shared/show.h"

layout(std140, binding = 0) uniform Frame { FrameUniforms frame; };

in vec3 albedo;
#ifdef SMOOTH_NORMALS
in vec3 surfaceNormal;
#else
flat in float light;
flat in vec4 shown;
flat in vec3 faceNormal;
#endif
#ifdef SHOW_TINT
flat in vec3 tint;
#endif
#ifdef SHARES
flat in int shares;
#endif
#ifdef SHOW_NORMALS
in vec3 along;
#endif
#ifdef SIDES
flat in float seenFromBehind;
#endif
#ifdef TEXTURED
centroid in vec2 onAtlas;
layout(binding = 3) uniform sampler2D atlas;

// Several probes along a footprint that is longer than wide (preprocess/atlas/atlas_sampler.cpp does the same). Not the
// driver's anisotropic filter: Mesa's software renderer takes 30 times as long for it.
vec4 atlasColour() {
  vec2 size = vec2(textureSize(atlas, 0)), alongX = dFdx(onAtlas), alongY = dFdy(onAtlas);
  float across = length(alongX * size), up = length(alongY * size);
  float major = max(across, up);
  float probes = major > 1.0 ? clamp(ceil(major / max(min(across, up), 1.0) - 0.001), 1.0, kMostProbes) : 1.0;
  float level = log2(max(major, 1e-6) / probes) + kAtlasLodBias;
  if (probes == 1.0) return textureLod(atlas, onAtlas, level);
  vec2 axis = across >= up ? alongX : alongY;
  vec4 sum = vec4(0.0);
  for (float i = 0.5; i < probes; ++i)
    sum += textureLod(atlas, onAtlas + (i / probes - 0.5) * axis, level);
  return sum / probes;
}

// Of a pixel's samples as many as a surface covers of it, which ones by chance: on average layers cover each other right.
int coveredSamples(float share) {
  if (share > 0.998) return -1;
  float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  float chance = fract(noise + 0.61803399 * float(gl_PrimitiveID & 1023) + frame.image.y);
  int count = int(share * float(gl_NumSamples) + chance);
  int first = int(chance * 61.0) % gl_NumSamples;
  int bits = ((1 << count) - 1) << first;
  return bits | bits >> gl_NumSamples;
}
#endif

layout(location = 0) out vec4 colour;            // premultiplied by coverage
layout(location = 1) out vec4 impostorCoverage;  // not attached unless asked for

void main() {
#ifdef SIDES
  if (!gl_FrontFacing && seenFromBehind == 0.0) discard;
#endif
#ifdef TEXTURED
  vec4 onSurface = atlasColour();
  vec3 surface = albedo * onSurface.rgb / max(onSurface.a, 0.001);
  gl_SampleMask[0] = coveredSamples(onSurface.a);
#else
  vec3 surface = albedo;
#endif
#ifdef SMOOTH_NORMALS
  vec3 unit = normalize(surfaceNormal);
  colour = vec4(shade(surface, unit, frame.light.xyz), 1.0);
#else
  vec3 unit = faceNormal;
  colour = vec4(mix(surface * light, shown.rgb, shown.a), 1.0);
#endif
#if defined(SHOW_TINT)
  colour = tinted(colour, tint);
#elif defined(SHOW_DEPTH)
  colour = vec4(vec3(depthGrey(1.0 / gl_FragCoord.w, frame.depthScale)), 1.0);
#elif defined(SHOW_NORMALS)
  colour = vec4(normalColour(unit, along), 1.0);
#endif
  impostorCoverage = vec4(0.0, 0.0, 0.0, 1.0);
#ifdef SHARES
#ifdef TEXTURED
  gl_SampleMask[0] &= shares;
#else
  gl_SampleMask[0] = shares;
#endif
#endif
}
