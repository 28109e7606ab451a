// Three frames of an octahedral impostor, blended. Each is looked up where the ray meets its plane, moved to where the ray
// meets the depth found there: one step of parallax, as engines do it.
layout(binding = 0) uniform sampler2DArray colours;  // premultiplied by coverage
layout(binding = 1) uniform sampler2DArray depths;   // 0..1: -halfExtent..halfExtent towards the frame's viewer

uniform vec3 eye;  // from the centre
uniform vec3 rayX, rayY, rayZ;
uniform float halfExtent;
uniform vec3 right[3], up[3], toward[3];
uniform float weights[3];
uniform int layers[3];

in vec2 onScreen;

layout(location = 0) out vec4 colour;
layout(location = 1) out float coverage;

const float kGrazing = -1e-3;

vec2 texturePoint(int frame, vec3 ray, float depth) {
  float along = dot(ray, toward[frame]);
  vec3 point = eye + ray * ((depth - dot(eye, toward[frame])) / along);
  return vec2(dot(point, right[frame]), dot(point, up[frame])) / (2.0 * halfExtent) + 0.5;
}

vec4 seen(int frame, vec3 ray) {
  if (dot(ray, toward[frame]) > kGrazing || dot(eye, toward[frame]) <= 0.0) return vec4(0.0);
  vec2 flatPoint = clamp(texturePoint(frame, ray, 0.0), 0.0, 1.0);
  float depth = (textureLod(depths, vec3(flatPoint, layers[frame]), 0.0).r * 2.0 - 1.0) * halfExtent;
  vec2 point = texturePoint(frame, ray, depth);
  vec4 texel = texture(colours, vec3(point, layers[frame]));
  return point == clamp(point, 0.0, 1.0) ? texel : vec4(0.0);
}

void main() {
  vec3 ray = rayX * onScreen.x + rayY * onScreen.y + rayZ;
  colour = vec4(0.0);
  for (int frame = 0; frame < 3; ++frame) colour += weights[frame] * seen(frame, ray);
  if (colour.a <= 0.0) discard;
  coverage = colour.a;
}
