// The billboard of the 2010 paper: the view's cropped rectangle on a plane through the middle of the cell's content, at
// that plane's own depth. Where the plane leaves the cell, its depth against the triangles of a neighbouring cell is
// wrong by up to the cell's size: that belongs to this kind, which is kept as the baseline.
#include "shaders/shared/draw.h"

layout(std140, binding = 0) uniform Frame { FrameUniforms frame; };
layout(std430, binding = 0) readonly buffer Instances { ImpostorInstance instances[]; };

out vec2 texel;
flat out vec2 layerAndLod;
flat out int shares;
flat out vec2 edge;  // of a view in texels; y: 1 / x
#ifdef SHOW
flat out int shownInstance;
out vec3 along;  // from the eye
#endif

void main() {
  ImpostorInstance instance = instances[gl_InstanceID];
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  ImpostorView view = instance.views[0];
  texel = mix(view.boxMin.xy, view.boxMax.xy, corner);
  float texelEdge = instance.boxMin.w;
  edge = vec2(instance.tint.w, 1.0 / instance.tint.w);
  vec3 toward = normalize(view.textureZ.xyz);
  // The inverse of textureX, textureY: their rows are the view's unit axes divided by a texel's edge.
  vec3 onPlane = texelEdge * texelEdge * (view.textureX.xyz * (texel.x - view.textureX.w) +
                                view.textureY.xyz * (texel.y - view.textureY.w));
  vec3 local = onPlane + toward * dot(toward, 0.5 * (instance.boxMin.xyz + instance.boxMax.xyz));
  vec3 relative = instance.centre.xyz + instance.centre.w * local;
  gl_Position = vec4(dot(frame.clipX.xyz, relative), dot(frame.clipY.xyz, relative), frame.eyeFraction.w,
                     dot(frame.clipW.xyz, relative));
  layerAndLod = vec2(view.boxMin.w, instance.eye.w);
  shares = int(instance.boxMax.w);
#ifdef SHOW
  shownInstance = gl_InstanceID;
  along = relative;
#endif
}
