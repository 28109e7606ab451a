// Lays a finished frame over what lies behind the model.
layout(binding = 0) uniform sampler2D picture;  // premultiplied by coverage

layout(location = 0) uniform vec4 zenith;
layout(location = 1) uniform vec4 horizon;
layout(location = 2) uniform vec4 nadir;
layout(location = 3) uniform vec3 up;        // of the model, in the axes of the view
layout(location = 4) uniform vec2 tangents;  // of half the field of view, horizontal and vertical

in vec2 onScreen;

layout(location = 0) out vec4 colour;

// Less than half a step of 8 bits up or down, by the pixel: a slow gradient shows no bands, a plain colour stays itself
// (Jimenez, Next Generation Post Processing in Call of Duty: Advanced Warfare, 2014).
float dither(vec2 pixel) {
  float noise = fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715))));
  return (noise - 0.5) * (0.98 / 255.0);
}

void main() {
  float height = dot(up, normalize(vec3(onScreen * tangents, -1.0)));
  // Haze gathers at the horizon: colours change fastest there.
  vec3 behind = mix(horizon.rgb, height > 0.0 ? zenith.rgb : nadir.rgb, sqrt(abs(height))) +
                dither(gl_FragCoord.xy);
  vec4 front = texelFetch(picture, ivec2(gl_FragCoord.xy), 0);
  colour = vec4(front.rgb + (1.0 - front.a) * behind, 1.0);
}
