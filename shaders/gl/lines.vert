// Lines over the finished frame.
#include "shaders/shared/draw.h"

layout(std140, binding = 0) uniform Frame { FrameUniforms frame; };

layout(location = 0) in vec3 position;  // relative to the eye, grid steps
layout(location = 1) in vec4 lineColour;

flat out vec4 shownColour;

void main() {
  shownColour = lineColour;
  gl_Position = vec4(dot(frame.clipX.xyz, position), dot(frame.clipY.xyz, position), frame.eyeFraction.w,
                     dot(frame.clipW.xyz, position));
}
