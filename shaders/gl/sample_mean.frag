// The mean of those samples of a pass that lie in this pixel; blending mixes it with the mean of the passes before.
layout(binding = 0) uniform sampler2DMS picture;
#ifdef COVERAGE
layout(binding = 1) uniform sampler2DMS coverage;
#endif

layout(location = 0) uniform int count;
layout(location = 1) uniform ivec2 steps[16];  // from the pixel that has a sample to the pixel that it lies in

layout(location = 0) out vec4 colour;
#ifdef COVERAGE
layout(location = 1) out vec4 impostorCoverage;
#endif

void main() {
  ivec2 last = textureSize(picture) - 1;
  vec4 sum = vec4(0.0);
  float coverageSum = 0.0;
  for (int i = 0; i < count; ++i) {
    ivec2 from = clamp(ivec2(gl_FragCoord.xy) - steps[i], ivec2(0), last);
    sum += texelFetch(picture, from, i);
#ifdef COVERAGE
    coverageSum += texelFetch(coverage, from, i).r;
#endif
  }
  colour = sum / float(count);
#ifdef COVERAGE
  impostorCoverage = vec4(coverageSum / float(count));
#endif
}
