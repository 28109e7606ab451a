// Kinds A and B: the back faces of the cell's content box, so that each ray through the box gets one fragment, also when the
// eye is inside. Cells are disjoint boxes: the box's own depth orders an impostor against the triangles of all others.
#include "shaders/shared/draw.h"

layout(std140, binding = 0) uniform Frame { FrameUniforms frame; };
layout(std430, binding = 0) readonly buffer Instances { ImpostorInstance instances[]; };

sample out vec3 boxPoint;          // local
sample out vec3 viewPoint[VIEWS];  // in the texture spaces of the views
flat out int shares;
flat out vec2 edge;              // of a view in texels; y: 1 / x
flat out vec4 eye;              // local; w: level of detail at clip w = 1
flat out vec3 boxMin, boxMax;   // padded, local
flat out vec4 viewEye[VIEWS], viewMin[VIEWS], viewMax[VIEWS];
#ifdef SHOW
flat out int shownInstance;
#endif

vec3 texturePoint(ImpostorView view, vec3 local) {
  return vec3(dot(view.textureX.xyz, local) + view.textureX.w, dot(view.textureY.xyz, local) + view.textureY.w,
              dot(view.textureZ.xyz, local) + view.textureZ.w);
}

void main() {
  ImpostorInstance instance = instances[gl_InstanceID];
  // Not towards the eye: there the neighbour's own padding overlaps the box already.
  vec3 pad = vec3(instance.boxMin.w * kBoxPadTexels);
  boxMin = instance.boxMin.xyz - pad * vec3(greaterThanEqual(instance.eye.xyz, instance.boxMin.xyz));
  boxMax = instance.boxMax.xyz + pad * vec3(lessThanEqual(instance.eye.xyz, instance.boxMax.xyz));
  bvec3 high = bvec3((gl_VertexID & 1) != 0, (gl_VertexID & 2) != 0, (gl_VertexID & 4) != 0);
  boxPoint = mix(boxMin, boxMax, high);
  eye = instance.eye;
  shares = int(instance.boxMax.w);
  edge = vec2(instance.tint.w, 1.0 / instance.tint.w);
#ifdef SHOW
  shownInstance = gl_InstanceID;
#endif
  for (int i = 0; i < VIEWS; ++i) {
    viewPoint[i] = texturePoint(instance.views[i], boxPoint);
    viewEye[i] = instance.views[i].eye;
    viewMin[i] = instance.views[i].boxMin;
    viewMax[i] = instance.views[i].boxMax;
  }

  vec3 relative = instance.centre.xyz + instance.centre.w * boxPoint;
  float w = dot(frame.clipW.xyz, relative);
  // The depth is that of the box without padding, which would lie behind the neighbour's nearest triangles.
  vec3 inner = instance.centre.xyz + instance.centre.w * mix(instance.boxMin.xyz, instance.boxMax.xyz, high);
  float innerW = dot(frame.clipW.xyz, inner);
  float z = frame.eyeFraction.w * (min(w, innerW) > frame.eyeFraction.w ? w / innerW : 1.0);
  gl_Position = vec4(dot(frame.clipX.xyz, relative), dot(frame.clipY.xyz, relative), z, w);
}
