// Kind A (VIEWS 2): where a ray through the pixel meets the surface that a view's depth image describes, the view's colour.
//
// Points of the ray are point(s) = boxPoint + s (boxPoint - eye): s = -1 is the eye, s = 0 the back of the box. The ray
// is clipped to the padded content box and to the box of what the view holds, and marched from its near end: one loop,
// one depth look-up a turn, at most 16 steps and 5 bisections. (A fixed-point start saves look-ups, but may settle on a
// surface behind the nearest one.)
//
// A hit is on the surface, or on a jump of the depth image, where the view did not see what lies behind a silhouette.
// There, and where the ray meets nothing, the second nearest view is asked; its surface is believed, its jumps are not.
//
// Kind B (VIEWS 3): the same, then the third view; each of the three that sees the point found has its say there. A view
// of weight 0 changes nothing, so that the picture stays the same when the eye moves on to the next three.
#include "shaders/shared/draw.h"

layout(std140, binding = 0) uniform Frame { FrameUniforms frame; };
layout(binding = 0) uniform sampler2DArray colours;
layout(binding = 1) uniform sampler2DArray depths;

sample in vec3 boxPoint;
sample in vec3 viewPoint[VIEWS];
flat in int shares;
flat in vec4 eye;
flat in vec3 boxMin, boxMax;
flat in vec4 viewEye[VIEWS], viewMin[VIEWS], viewMax[VIEWS];

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
const float kBlurredCoverage = 0.15;
const int kAttempts = 6;                 // hits looked at when the nearest ones are empty or jumps
const float kAgreeTexels = 3.0;          // a view agrees where its depth is that near; at twice that, not at all
const float kLeastWeight = 0.02;         // of the view a point was found in
const float kFullThirdWeight = 0.1;      // from which on what the third view alone sees counts in full
const float kNowhere = 1e9;
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

// Of a view at a texel that the ray reaches at s.
vec4 colourAt(vec2 texel, float layer, float s) {
  float lod = eye.w - frame.image.w + log2((1.0 + s) / gl_FragCoord.w);  // gl_FragCoord.w is 1 / clip w
  return textureLod(colours, vec3(texel * frame.image.y, layer), lod);
}

// Texels and their filter widen an edge on both sides: coverage near 0 and near 1 is taken as that, so that its mean
// across the edge stays.
vec4 sharpened(vec4 seen) {
  float coverage = clamp((seen.a - kBlurredCoverage) / (1.0 - 2.0 * kBlurredCoverage), 0.0, 1.0);
  return seen * (coverage / max(seen.a, kEmptyAlpha));
}

// Looks through one view. point: boxPoint in its texture space; from: its eye, w: edge of a texel in depth values;
// low: its box, w: its layer. Sets `found` to the colour of what it returns, `place` to its texel and its s, and `hidden`
// to where the ray first was behind the surface, where the view knows nothing: before that, and where it is nowhere,
// there is nothing to be seen.
int look(vec3 point, vec4 from, vec4 low, vec3 high, vec2 inBox, inout vec4 found, inout vec3 place,
         inout float hidden) {
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
      hidden = under ? min(hidden, s - stepLength) : hidden;
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
      vec4 seen = sharpened(colourAt(hit, low.w, s));
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

// What the ray found, and where.
struct Found {
  vec4 seen;
  vec3 place;  // texel of the view, s
  int view;
  vec4 jump;       // what the nearest view alone shows, where no surface was found in it
  bool onSurface;  // of `view`; else a jump of the nearest, or nothing
};

// What the ray through a point of the box's back finds. points: the same one in the spaces of the views. What the
// nearest view shows to be empty is not looked for in the third.
Found find(vec3 local, vec3 points[VIEWS]) {
  vec2 inBox = slab(local, local - eye.xyz, boxMin, boxMax);
  Found found = Found(vec4(0.0), vec3(0.0), 0, vec4(0.0), false);
  float hidden = kNowhere;
  found.onSurface =
      look(points[0], viewEye[0], viewMin[0], viewMax[0].xyz, inBox, found.seen, found.place, hidden) == kSurface;
  found.jump = found.seen;
  for (int i = 1; i < VIEWS && !found.onSurface; ++i) {
    if (i == 2) inBox.x = max(inBox.x, hidden);
    if (inBox.x >= inBox.y) break;
    Found other = Found(vec4(0.0), vec3(0.0), i, found.jump, true);
    float ignored = kNowhere;
    if (look(points[i], viewEye[i], viewMin[i], viewMax[i].xyz, inBox, other.seen, other.place, ignored) == kSurface)
      found = other;
    else if (VIEWS == 2 && ignored == kNowhere)
      found.seen = found.jump = vec4(0.0);  // all of the ray lies before what this view saw
  }
  return found;
}

#if VIEWS == 3
// The mean of what was found and of what the other views see there, by weight x agreement.
vec4 blended(Found found, vec3 points[VIEWS]) {
  vec4 sum = vec4(0.0);
  float weights = 0.0;
  for (int i = 0; i < VIEWS; ++i) {
    vec3 there = points[i] + found.place.z * (points[i] - viewEye[i].xyz);
    float known = depthValue(there.xy, viewMin[i].w);
    float off = abs(there.z - known) / (kAgreeTexels * viewEye[i].w);
    float agreement = known > 0.0 ? clamp(2.0 - off, 0.0, 1.0) : 0.0;
    bool own = i == found.view;
    float weight = own ? max(viewMax[i].w, kLeastWeight) : viewMax[i].w * agreement;
    vec4 seen = own ? found.seen : colourAt(there.xy, viewMin[i].w, found.place.z);
    sum += weight * seen;
    weights += weight;
  }
  vec4 mean = sum / weights;
  // What the third view alone sees comes and goes with its weight.
  float fade = found.view == 2 ? clamp(viewMax[2].w / kFullThirdWeight, 0.0, 1.0) : 1.0;
  return found.onSurface ? mix(found.jump, mean, fade) : found.jump;
}
#endif

// What is shown of what the ray through a point of the box's back finds.
vec4 seenThrough(vec3 local, vec3 points[VIEWS]) {
  Found found = find(local, points);
#if VIEWS == 3
  vec4 seen = blended(found, points);
#else
  vec4 seen = found.seen;
#endif
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
