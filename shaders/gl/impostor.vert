// Kind A: the back faces of the cell's content box, so that each ray through the box gets one fragment, also when the
// eye is inside. Cells are disjoint boxes: the box's own depth orders an impostor against the triangles of all others.
#include "shaders/shared/draw.h"

layout(std140, binding = 0) uniform Frame { FrameUniforms frame; };
layout(std430, binding = 0) readonly buffer Instances { ImpostorInstance instances[]; };

out vec3 boxPoint;              // local
out vec3 texturePoint;
flat out vec3 eye;              // local
flat out vec4 eyeTexture;
flat out vec3 boxMin, boxMax;   // padded, local
flat out vec3 viewMin, viewMax;
flat out vec2 layerAndLod;

void main() {
  ImpostorInstance instance = instances[gl_InstanceID];
  vec3 pad = vec3(instance.boxMin.w * kBoxPadTexels);
  boxMin = instance.boxMin.xyz - pad;
  boxMax = instance.boxMax.xyz + pad;
  bvec3 high = bvec3((gl_VertexID & 1) != 0, (gl_VertexID & 2) != 0, (gl_VertexID & 4) != 0);
  boxPoint = mix(boxMin, boxMax, high);
  texturePoint = vec3(dot(instance.textureX.xyz, boxPoint) + instance.textureX.w,
                      dot(instance.textureY.xyz, boxPoint) + instance.textureY.w,
                      dot(instance.textureZ.xyz, boxPoint) + instance.textureZ.w);
  eye = instance.eye.xyz;
  eyeTexture = instance.eyeTexture;
  viewMin = instance.viewMin.xyz;
  viewMax = instance.viewMax.xyz;
  layerAndLod = vec2(instance.boxMax.w, instance.eye.w);

  vec3 relative = instance.centre.xyz + instance.centre.w * boxPoint;
  float w = dot(frame.clipW.xyz, relative);
  // The depth is that of the box without padding, which would lie behind the neighbour's nearest triangles.
  vec3 inner = instance.centre.xyz + instance.centre.w * mix(instance.boxMin.xyz, instance.boxMax.xyz, high);
  float innerW = dot(frame.clipW.xyz, inner);
  float z = frame.eyeFraction.w * (min(w, innerW) > frame.eyeFraction.w ? w / innerW : 1.0);
  gl_Position = vec4(dot(frame.clipX.xyz, relative), dot(frame.clipY.xyz, relative), z, w);
}
