// Kind A: where a ray through the pixel meets the surface that a view's depth image describes, the view's colour.
//
// Points of the ray are point(s) = boxPoint + s (boxPoint - eye): s = -1 is the eye, s = 0 the back of the box. The ray
// is clipped to the padded content box and to the box of what the view holds, and marched from its near end: one loop,
// one depth look-up a turn, at most 16 steps and 5 bisections. (A fixed-point start saves look-ups, but may settle on a
// surface behind the nearest one.)
//
// A hit is on the surface, or on a jump of the depth image, where the view did not see what lies behind a silhouette.
// There, and where the ray meets nothing, the second nearest view is asked; its surface is believed, its jumps are not.
#include "shaders/shared/draw.h"

layout(std140, binding = 0) uniform Frame { FrameUniforms frame; };
layout(binding = 0) uniform sampler2DArray colours;
layout(binding = 1) uniform sampler2DArray depths;

in vec3 boxPoint;
in vec3 nearestPoint, secondPoint;
flat in vec4 eye;
flat in vec3 boxMin, boxMax;
flat in vec4 nearestEye, nearestMin, secondEye, secondMin;
flat in vec3 nearestMax, secondMax;

layout(location = 0) out vec4 colour;            // premultiplied by coverage
layout(location = 1) out vec4 impostorCoverage;  // not attached unless asked for

#ifdef SHOW
#include "shaders/gl/impostor_show.frag"
flat in int shownInstance;
#endif

const int kMarchSteps = 16;
const float kMarchTexels = 1.5;          // lateral length of a step, where 16 are enough
const int kBisections = 5;
const float kEnteredBehindTexels = 6.0;  // how far below the surface a ray may enter and still be a hit
const float kSurfaceTexels = 3.0;        // a crossing that ends farther below the depth image is a jump of it
const float kEmptyAlpha = 0.004;
const int kAttempts = 6;                 // hits looked at when the nearest ones are empty or jumps
const int kMaxLookups = 1 + kMarchSteps + kBisections;

// What the next look-up is for.
const int kMarch = 0;
const int kBisect = 1;
const int kHit = 2;
const int kMiss = 3;

// What a look along the ray found.
const int kNothing = 0;
const int kJump = 1;
const int kSurface = 2;

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
float depthValue(vec2 texel, float layer) {
  ivec2 nearest = clamp(ivec2(floor(texel)), ivec2(0), ivec2(int(frame.image.x) - 1));
  return texelFetch(depths, ivec3(nearest, int(layer)), 0).r * 255.0;
}

// Looks through one view. point: boxPoint in its texture space; from: its eye, w: edge of a texel in depth values;
// low: its box, w: its layer. Sets `found` to the colour of what it returns, `place` to its texel and its s.
int look(vec3 point, vec4 from, vec4 low, vec3 high, vec2 inBox, inout vec4 found, inout vec3 place) {
  vec3 along = point - from.xyz;
  vec2 inView = slab(point, along, low.xyz, high);
  float first = max(max(inBox.x, inView.x), -1.0);
  float last = min(inBox.y, inView.y);
  float texel = from.w;

  float steps = clamp(ceil(length(along.xy) * (last - first) / kMarchTexels), 2.0, float(kMarchSteps));
  float stepLength = (last - first) / steps;
  float s = first;
  int state = first < last && low.x < high.x ? kMarch : kMiss;
  int bisections = 0;
  float step = 0.0;          // of the march
  bool above = false;        // the march's last point was above the surface
  float before = first;      // that point; bisecting: the end above the surface
  float below = first;       // bisecting: the end below it
  float depthBelow = 0.0;    // how far below the depth image that end lies, depth values
  int result = kNothing;

  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    for (int lookup = 0; lookup < kMaxLookups && state < kHit; ++lookup) {
      vec3 here = point + s * along;
      float known = depthValue(here.xy, low.w);
      float height = known > 0.0 ? here.z - known : 1e9;
      bool under = height <= 0.0;
      bool advance = false;
      if (state == kMarch) {
        bool crossed = under && (step == 0.0 ? height > -kEnteredBehindTexels * texel : above);
        below = s;
        depthBelow = -height;
        state = crossed ? (step == 0.0 ? kHit : kBisect) : kMarch;
        bisections = 0;
        advance = !crossed;
        above = !under;
        before = crossed ? before : s;
        s = crossed && step > 0.0 ? 0.5 * (before + s) : s;
      } else {
        below = under ? s : below;
        depthBelow = under ? -height : depthBelow;
        before = under ? before : s;
        bool done = ++bisections == kBisections;
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
    bool onSurface = depthBelow < kSurfaceTexels * texel;
    if (onSurface || result == kNothing) {
      vec2 hit = point.xy + s * along.xy;
      float lod = eye.w - frame.image.w + log2((1.0 + s) / gl_FragCoord.w);  // gl_FragCoord.w is 1 / clip w
      vec4 seen = textureLod(colours, vec3(hit * frame.image.y, low.w), lod);
      if (seen.a > kEmptyAlpha) {
        found = seen;
        place = vec3(hit, s);
        result = onSurface ? kSurface : kJump;
        if (onSurface) break;
      }
    }
    above = false;
    step += 1.0;
    s = first + step * stepLength;
    state = step > steps ? kMiss : kMarch;
  }
  return result;
}

// What is shown of what was seen at a place of one of the two views.
vec4 shown(vec4 seen, bool inNearest, vec3 place, vec3 along) {
#ifdef SHOW
  return shownInstead(seen, shownInstance, inNearest, place.xy, (1.0 + place.z) / gl_FragCoord.w, along);
#else
  return seen;
#endif
}

// What the ray through a point of the box's back sees; the three points are the same one in three spaces.
vec4 seenThrough(vec3 local, vec3 inNearest, vec3 inSecond) {
  vec2 inBox = slab(local, local - eye.xyz, boxMin, boxMax);
  vec3 along = local - eye.xyz;
  vec4 seen = vec4(0.0);
  vec3 place = vec3(0.0);
  if (look(inNearest, nearestEye, nearestMin, nearestMax, inBox, seen, place) == kSurface)
    return shown(seen, true, place, along);
  vec4 other = vec4(0.0);
  vec3 otherPlace = vec3(0.0);
  if (look(inSecond, secondEye, secondMin, secondMax, inBox, other, otherPlace) == kSurface)
    return shown(other, false, otherPlace, along);
  return shown(seen, true, place, along);
}

// Where the object's outline differs from the view's, no texel knows how much of the pixel it covers: rays do.
const vec2 kRayOffsets[4] = vec2[](vec2(-0.125, -0.375), vec2(0.375, -0.125), vec2(0.125, 0.375), vec2(-0.375, 0.125));

void main() {
  vec3 localX = dFdx(boxPoint), localY = dFdy(boxPoint);
  vec3 nearestX = dFdx(nearestPoint), nearestY = dFdy(nearestPoint);
  vec3 secondX = dFdx(secondPoint), secondY = dFdy(secondPoint);
  colour = vec4(0.0);
  int rays = int(frame.image.z);
  for (int ray = 0; ray < rays; ++ray) {
    vec2 offset = rays == 1 ? vec2(0.0) : kRayOffsets[ray];
    colour += seenThrough(boxPoint + offset.x * localX + offset.y * localY,
                          nearestPoint + offset.x * nearestX + offset.y * nearestY,
                          secondPoint + offset.x * secondX + offset.y * secondY);
  }
  colour *= 1.0 / frame.image.z;
  impostorCoverage = colour.aaaa;
}
