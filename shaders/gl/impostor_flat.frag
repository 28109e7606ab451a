// RELIGHTABLE: views hold albedo and normals.
#include "shaders/shared/draw.h"

layout(std140, binding = 0) uniform Frame { FrameUniforms frame; };
layout(binding = 0) uniform sampler2DArray colours;
flat in vec2 edge;
#ifdef RELIGHTABLE
#include "shaders/shared/shading.h"
layout(binding = 2) uniform sampler2DArray normals;  // mean vectors, premultiplied by coverage
#endif

#ifdef SHOW
layout(binding = 1) uniform sampler2DArray depths;
#include "shaders/gl/impostor_show.frag"
flat in int shownInstance;
in vec3 along;
#endif

in vec2 texel;
flat in vec2 layerAndLod;
flat in int shares;

layout(location = 0) out vec4 colour;            // premultiplied by coverage
layout(location = 1) out vec4 impostorCoverage;  // not attached unless asked for

void main() {
  float lod = layerAndLod.y - log2(gl_FragCoord.w);  // gl_FragCoord.w is 1 / clip w
  colour = textureLod(colours, vec3(texel * edge.y, layerAndLod.x), lod);
#ifdef RELIGHTABLE
  colour = relit(colour, textureLod(normals, vec3(texel * edge.y, layerAndLod.x), lod).xyz, frame.light.xyz);
#endif
#ifdef SHOW
  colour = shownInstead(colour, shownInstance, 0, texel, 1.0 / gl_FragCoord.w, along);
#endif
  impostorCoverage = colour.aaaa;
  gl_SampleMask[0] = shares;
}
