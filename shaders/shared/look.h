// What a ray sees of an impostor of kind A or B: one text for the fragment shader and for what measures impostors on
// the CPU (preprocess/measure).
//
// Kind A (VIEWS 2): where a ray through the pixel meets the surface that a view's depth image describes, the view's
// colour.
//
// Points of the ray are point(s) = boxPoint + s (boxPoint - eye): s = -1 is the eye, s = 0 the back of the box. The ray
// is clipped to the padded content box and to the box of what the view holds, and marched from its near end: one loop,
// one depth look-up a turn, at most 16 steps and 5 bisections. (A fixed-point start saves look-ups, but may settle on a
// surface behind the nearest one.)
//
// A hit is on the surface, or on a jump of the depth image, where the view did not see what lies behind a silhouette.
// There, and where the ray meets nothing, the second nearest view is asked; its surface is believed, its jumps are not.
//
// Kind B (VIEWS 3): the same, then the third view; each of the three that sees the point found has its say there. A
// view of weight 0 changes nothing, so that the picture stays the same when the eye moves on to the next three.
//
// Included where these have a meaning, by a shader or in the body of a C++ class: VIEWS; of the impostor, eye, boxMin
// and boxMax (local), and viewEye, viewMin and viewMax as ImpostorView has them (draw.h); and what reads the images:
//   float depthValue(vec2 texel, float layer)       depth value at a point of the image, 0 where nothing is known
//   vec4 colourAt(vec2 texel, float layer, float s)  premultiplied, filtered to the pixel, at a point that the ray
//                                                   reaches at s
#ifndef FARCELL_SHADERS_SHARED_LOOK_H
#define FARCELL_SHADERS_SHARED_LOOK_H

#include "shaders/shared/portable.h"

FARCELL_CONST int kMarchSteps = 16;
FARCELL_CONST float kMarchTexels = 1.5f;  // lateral length of a step, where 16 are enough
FARCELL_CONST int kBisections = 5;
FARCELL_CONST float kEnteredBehindTexels = 6.0f;  // how far below the surface a ray may enter and still be a hit
FARCELL_CONST float kSurfaceTexels = 3.0f;        // a crossing that ends farther below the depth image is a jump of it
FARCELL_CONST float kEmptyAlpha = 0.004f;
FARCELL_CONST float kBlurredCoverage = 0.15f;
FARCELL_CONST int kAttempts = 6;              // hits looked at when the nearest ones are empty or jumps
FARCELL_CONST float kAgreeTexels = 3.0f;      // a view agrees where its depth is that near; at twice that, not at all
FARCELL_CONST float kLeastWeight = 0.02f;     // of the view a point was found in
FARCELL_CONST float kFullThirdWeight = 0.1f;  // from which on what the third view alone sees counts in full
FARCELL_CONST float kNowhere = 1e9f;
FARCELL_CONST int kMaxLookups = 1 + kMarchSteps + kBisections;

// What the next look-up is for.
FARCELL_CONST int kMarch = 0;
FARCELL_CONST int kBisect = 1;
FARCELL_CONST int kHit = 2;
FARCELL_CONST int kMiss = 3;

// What a look along the ray found.
FARCELL_CONST int kNothing = 0;
FARCELL_CONST int kJump = 1;
FARCELL_CONST int kSurface = 2;

// First and last s within [low, high] along one set of axes.
FARCELL_SHARED vec2 slab(vec3 point, vec3 direction, vec3 low, vec3 high) {
  vec3 inverse = 1.0f / (direction + vec3(1e-30f));
  vec3 a = (low - point) * inverse;
  vec3 b = (high - point) * inverse;
  vec3 first = min(a, b);
  vec3 last = max(a, b);
  return vec2(max(max(first.x, first.y), first.z), min(min(last.x, last.y), last.z));
}

// Texels and their filter widen an edge on both sides: coverage near 0 and near 1 is taken as that, so that its mean
// across the edge stays.
FARCELL_SHARED vec4 sharpened(vec4 seen) {
  float coverage = clamp((seen.w - kBlurredCoverage) / (1.0f - 2.0f * kBlurredCoverage), 0.0f, 1.0f);
  return seen * (coverage / max(seen.w, kEmptyAlpha));
}

// Looks through one view. point: boxPoint in its texture space; from: its eye, w: edge of a texel in depth values;
// low: its box, w: its layer. Sets `found` to the colour of what it returns, `place` to its texel and its s, and
// `hidden` to where the ray first was behind the surface, where the view knows nothing: before that, and where it is
// nowhere, there is nothing to be seen.
FARCELL_SHARED int look(vec3 point, vec4 from, vec4 low, vec3 high, vec2 inBox, FARCELL_INOUT(vec4) found,
                        FARCELL_INOUT(vec3) place, FARCELL_INOUT(float) hidden) {
  vec3 along = point - vec3(from);
  vec2 inView = slab(point, along, vec3(low), high);
  float first = max(max(inBox.x, inView.x), -1.0f);
  float last = min(inBox.y, inView.y);
  float texel = from.w;

  float steps = clamp(ceil(length(vec2(along)) * (last - first) / kMarchTexels), 2.0f, float(kMarchSteps));
  float stepLength = (last - first) / steps;
  float s = first;
  int state = first < last && low.x < high.x ? kMarch : kMiss;
  int bisections = 0;
  float step = 0.0f;        // of the march
  bool above = false;       // the march's last point was above the surface
  float before = first;     // that point; bisecting: the end above the surface
  float below = first;      // bisecting: the end below it
  float depthBelow = 0.0f;  // how far below the depth image that end lies, depth values
  int result = kNothing;

  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    for (int lookup = 0; lookup < kMaxLookups && state < kHit; ++lookup) {
      vec3 here = point + s * along;
      float known = depthValue(vec2(here), low.w);
      float height = known > 0.0f ? here.z - known : 1e9f;
      bool under = height <= 0.0f;
      hidden = under ? min(hidden, s - stepLength) : hidden;
      bool advance = false;
      if (state == kMarch) {
        bool crossed = under && (step == 0.0f ? height > -kEnteredBehindTexels * texel : above);
        below = s;
        depthBelow = -height;
        state = crossed ? (step == 0.0f ? kHit : kBisect) : kMarch;
        bisections = 0;
        advance = !crossed;
        above = !under;
        before = crossed ? before : s;
        s = crossed && step > 0.0f ? 0.5f * (before + s) : s;
      } else {
        below = under ? s : below;
        depthBelow = under ? -height : depthBelow;
        before = under ? before : s;
        bool done = ++bisections == kBisections;
        s = done ? below : 0.5f * (before + below);
        state = done ? kHit : kBisect;
      }
      if (advance) {
        step += 1.0f;
        s = first + step * stepLength;
        state = step > steps ? kMiss : kMarch;
      }
    }
    if (state != kHit) break;
    bool onSurface = depthBelow < kSurfaceTexels * texel;
    if (onSurface || result == kNothing) {
      vec2 hit = vec2(point) + s * vec2(along);
      vec4 seen = sharpened(colourAt(hit, low.w, s));
      if (seen.w > kEmptyAlpha) {
        found = seen;
        place = vec3(hit, s);
        result = onSurface ? kSurface : kJump;
        if (onSurface) break;
      }
    }
    above = false;
    step += 1.0f;
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

FARCELL_SHARED Found foundNothing(int view) {
  Found found;
  found.seen = vec4(0.0f);
  found.place = vec3(0.0f);
  found.view = view;
  found.jump = vec4(0.0f);
  found.onSurface = false;
  return found;
}

// What the ray through a point of the box's back finds. points: the same one in the spaces of the views. What the
// nearest view shows to be empty is not looked for in the third.
FARCELL_SHARED Found find(vec3 local, vec3 points[VIEWS]) {
  vec2 inBox = slab(local, local - vec3(eye), boxMin, boxMax);
  Found found = foundNothing(0);
  float hidden = kNowhere;
  found.onSurface =
      look(points[0], viewEye[0], viewMin[0], vec3(viewMax[0]), inBox, found.seen, found.place, hidden) == kSurface;
  found.jump = found.seen;
  for (int i = 1; i < VIEWS && !found.onSurface; ++i) {
    if (i == 2) inBox.x = max(inBox.x, hidden);
    if (inBox.x >= inBox.y) break;
    Found other = foundNothing(i);
    other.jump = found.jump;
    other.onSurface = true;
    float ignored = kNowhere;
    if (look(points[i], viewEye[i], viewMin[i], vec3(viewMax[i]), inBox, other.seen, other.place, ignored) == kSurface)
      found = other;
    else if (VIEWS == 2 && ignored == kNowhere)
      found.seen = found.jump = vec4(0.0f);  // all of the ray lies before what this view saw
  }
  return found;
}

// The mean of what was found and of what the other views see there, by weight x agreement.
FARCELL_SHARED vec4 blended(Found found, vec3 points[VIEWS]) {
  vec4 sum = vec4(0.0f);
  float weights = 0.0f;
  for (int i = 0; i < VIEWS; ++i) {
    vec3 there = points[i] + found.place.z * (points[i] - vec3(viewEye[i]));
    float known = depthValue(vec2(there), viewMin[i].w);
    float off = abs(there.z - known) / (kAgreeTexels * viewEye[i].w);
    float agreement = known > 0.0f ? clamp(2.0f - off, 0.0f, 1.0f) : 0.0f;
    bool own = i == found.view;
    float weight = own ? max(viewMax[i].w, kLeastWeight) : viewMax[i].w * agreement;
    vec4 seen = own ? found.seen : colourAt(vec2(there), viewMin[i].w, found.place.z);
    sum += weight * seen;
    weights += weight;
  }
  vec4 mean = sum / weights;
  // What the third view alone sees comes and goes with its weight.
  float fade = found.view == 2 ? clamp(viewMax[VIEWS - 1].w / kFullThirdWeight, 0.0f, 1.0f) : 1.0f;
  return found.onSurface ? mix(found.jump, mean, fade) : found.jump;
}

// What is shown of it.
FARCELL_SHARED vec4 seenOf(Found found, vec3 points[VIEWS]) {
  if (VIEWS == 3) return blended(found, points);
  return found.seen;
}

#endif
