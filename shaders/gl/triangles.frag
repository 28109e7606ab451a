#include "shaders/shared/draw.h"
#include "shaders/shared/shading.h"

layout(std140, binding = 0) uniform Frame { FrameUniforms frame; };

in vec3 albedo;
#ifdef SMOOTH_NORMALS
in vec3 surfaceNormal;
#else
flat in float light;
#endif

layout(location = 0) out vec4 colour;            // premultiplied by coverage
layout(location = 1) out vec4 impostorCoverage;  // not attached unless asked for

void main() {
#ifdef SMOOTH_NORMALS
  colour = vec4(shade(albedo, normalize(surfaceNormal), frame.sun.xyz), 1.0);
#else
  colour = vec4(albedo * light, 1.0);
#endif
  impostorCoverage = vec4(0.0, 0.0, 0.0, 1.0);
}
