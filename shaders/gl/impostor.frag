// Kind A: where the pixel's ray meets the surface that the view's depth image describes, the view's colour.
//
// Points of the ray are point(s) = boxPoint + s (boxPoint - eye): s = -1 is the eye, s = 0 the back of the box. The ray
// is clipped to the padded content box and to the box of what the view holds. Then one loop, one depth look-up a turn:
// up to 3 fixed-point steps; where they do not settle, a march of at most 8 steps and 4 bisections.
#include "shaders/shared/draw.h"

layout(std140, binding = 0) uniform Frame { FrameUniforms frame; };
layout(binding = 0) uniform sampler2DArray colours;
layout(binding = 1) uniform sampler2DArray depths;

in vec3 boxPoint;
in vec3 texturePoint;
flat in vec3 eye;
flat in vec4 eyeTexture;
flat in vec3 boxMin, boxMax;
flat in vec3 viewMin, viewMax;
flat in vec2 layerAndLod;

layout(location = 0) out vec4 colour;            // premultiplied by coverage
layout(location = 1) out vec4 impostorCoverage;  // not attached unless asked for

const int kFixedPointSteps = 3;
const float kSettledTexels = 0.5;
const int kMarchSteps = 8;
const float kMarchTexels = 1.5;          // lateral length of a step, where 8 are enough
const int kBisections = 4;
const float kEnteredBehindTexels = 6.0;  // how far below the surface a ray may enter and still be a hit
const float kEmptyAlpha = 0.004;
const int kAttempts = 3;                 // surfaces looked at when the nearest ones turn out to be empty
const int kMaxLookups = kFixedPointSteps + 1 + kMarchSteps + kBisections;

// What the next look-up is for.
const int kFixedPoint = 0;
const int kMarch = 1;
const int kBisect = 2;
const int kHit = 3;
const int kMiss = 4;

// First and last s within [low, high] along one set of axes.
vec2 slab(vec3 point, vec3 direction, vec3 low, vec3 high) {
  vec3 inverse = 1.0 / (direction + vec3(1e-30));
  vec3 a = (low - point) * inverse;
  vec3 b = (high - point) * inverse;
  vec3 first = min(a, b);
  vec3 last = max(a, b);
  return vec2(max(max(first.x, first.y), first.z), min(min(last.x, last.y), last.z));
}

// Depth value at a point of the image; 0 where nothing is known.
float depthValue(vec2 texel) {
  ivec2 nearest = clamp(ivec2(floor(texel)), ivec2(0), ivec2(int(frame.image.x) - 1));
  return texelFetch(depths, ivec3(nearest, int(layerAndLod.x)), 0).r * 255.0;
}

void main() {
  vec3 along = texturePoint - eyeTexture.xyz;
  vec2 inBox = slab(boxPoint, boxPoint - eye, boxMin, boxMax);
  vec2 inView = slab(texturePoint, along, viewMin, viewMax);
  float first = max(max(inBox.x, inView.x), -1.0);
  float last = min(inBox.y, inView.y);
  float texel = eyeTexture.w;

  float inverseAlong = 1.0 / (along.z + 1e-30);
  float steps = clamp(ceil(length(along.xy) * (last - first) / kMarchTexels), 2.0, float(kMarchSteps));
  float stepLength = (last - first) / steps;
  float s = clamp((0.5 * (viewMin.z + viewMax.z) - texturePoint.z) * inverseAlong, first, last);
  int state = first < last ? kFixedPoint : kMiss;
  int turns = 0;        // look-ups made in this state
  float step = -1.0;    // of the march
  bool above = false;   // the march's last point was above the surface
  float before = first; // that point; bisecting: the end above the surface
  float below = first;  // bisecting: the end below it

  colour = vec4(0.0);
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    for (int lookup = 0; lookup < kMaxLookups && state < kHit; ++lookup) {
      vec3 point = texturePoint + s * along;
      float known = depthValue(point.xy);
      float height = known > 0.0 ? point.z - known : 1e9;
      bool under = height <= 0.0;
      bool advance = false;
      if (state == kFixedPoint) {
        float next = (known - texturePoint.z) * inverseAlong;
        bool settled = abs(height) < kSettledTexels * texel && next >= first && next <= last;
        state = settled ? kHit : kFixedPoint;
        s = clamp(next, first, last);
        advance = !settled && (known == 0.0 || ++turns == kFixedPointSteps);
      } else if (state == kMarch) {
        bool crossed = under && (step == 0.0 ? height > -kEnteredBehindTexels * texel : above);
        below = s;
        state = crossed ? (step == 0.0 ? kHit : kBisect) : kMarch;
        turns = 0;
        advance = !crossed;
        above = !under;
        before = crossed ? before : s;
        s = crossed && step > 0.0 ? 0.5 * (before + s) : s;
      } else {
        below = under ? s : below;
        before = under ? before : s;
        bool done = ++turns == kBisections;
        s = done ? below : 0.5 * (before + below);
        state = done ? kHit : kBisect;
      }
      if (advance) {
        step += 1.0;
        s = first + step * stepLength;
        state = step > steps ? kMiss : kMarch;
      }
    }
    if (state != kHit) break;
    vec2 hit = texturePoint.xy + s * along.xy;
    float lod = layerAndLod.y + log2((1.0 + s) / gl_FragCoord.w);  // gl_FragCoord.w is 1 / clip w
    colour = textureLod(colours, vec3(hit * frame.image.y, layerAndLod.x), lod);
    if (colour.a > kEmptyAlpha) break;
    colour = vec4(0.0);
    above = false;
    step += 1.0;
    s = first + step * stepLength;
    state = step > steps ? kMiss : kMarch;
  }
  impostorCoverage = colour.aaaa;
}
