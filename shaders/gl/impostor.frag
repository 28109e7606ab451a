// Kinds A (VIEWS 2) and B (VIEWS 3): what rays through the pixel see (shaders/shared/look.h), the mean of them.
// RELIGHTABLE: views hold albedo and normals.
#include "shaders/shared/draw.h"

layout(std140, binding = 0) uniform Frame { FrameUniforms frame; };
layout(binding = 0) uniform sampler2DArray colours;
layout(binding = 1) uniform sampler2DArray depths;
#ifdef RELIGHTABLE
#include "shaders/shared/shading.h"
layout(binding = 2) uniform sampler2DArray normals;  // mean vectors, premultiplied by coverage
#endif

sample in vec3 boxPoint;
sample in vec3 viewPoint[VIEWS];
flat in int shares;
flat in vec2 edge;
flat in vec4 eye;
flat in vec3 boxMin, boxMax;
flat in vec4 viewEye[VIEWS], viewMin[VIEWS], viewMax[VIEWS];

layout(location = 0) out vec4 colour;            // premultiplied by coverage
layout(location = 1) out vec4 impostorCoverage;  // not attached unless asked for

#ifdef SHOW
#include "shaders/gl/impostor_show.frag"
flat in int shownInstance;
#endif

// Depth value at a point of the image; 0 where nothing is known.
float depthValue(vec2 texel, float layer) {
  ivec2 nearest = clamp(ivec2(floor(texel)), ivec2(0), ivec2(int(edge.x) - 1));
  return texelFetch(depths, ivec3(nearest, int(layer)), 0).r * 255.0;
}

// Of a view at a texel that the ray reaches at s.
vec4 colourAt(vec2 texel, float layer, float s) {
  float lod = eye.w - frame.image.x + log2((1.0 + s) / gl_FragCoord.w);  // gl_FragCoord.w is 1 / clip w
  vec4 colour = textureLod(colours, vec3(texel * edge.y, layer), lod);
#ifdef RELIGHTABLE
  colour = relit(colour, textureLod(normals, vec3(texel * edge.y, layer), lod).xyz, frame.light.xyz);
#endif
  return colour;
}

#include "shaders/shared/look.h"

// What is shown of what the ray through a point of the box's back finds.
vec4 seenThrough(vec3 local, vec3 points[VIEWS]) {
  Found found = find(local, points);
  vec4 seen = seenOf(found, points);
#ifdef SHOW
  return shownInstead(seen, shownInstance, found.view, found.place.xy, (1.0 + found.place.z) / gl_FragCoord.w,
                      local - eye.xyz);
#else
  return seen;
#endif
}

// Once a sample: where the object's outline differs from the view's, no texel knows how much of a pixel it covers, and
// what covers a part of it covers the same part of all behind.
void main() {
  if ((shares >> gl_SampleID & 1) == 0) discard;
  colour = seenThrough(boxPoint, viewPoint);
  if (colour.a == 0.0) discard;
  impostorCoverage = colour.aaaa;
}
