layout(binding = 0) uniform sampler2D image;  // premultiplied by coverage
uniform bool blended;

in vec2 texturePoint;

layout(location = 0) out vec4 colour;

const float kAlphaTest = 0.5;
const float kNothing = 1.0 / 255.0;

void main() {
  vec4 texel = texture(image, texturePoint);
  if (texel.a < (blended ? kNothing : kAlphaTest)) discard;
  colour = blended ? texel : vec4(texel.rgb / texel.a, 1.0);
}
