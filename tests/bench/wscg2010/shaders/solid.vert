// Triangles and lines whose colour is already lit.
uniform mat4 clipFromWorld;

layout(location = 0) in vec3 position;
layout(location = 1) in vec4 colour;

out vec3 lit;

void main() {
  gl_Position = clipFromWorld * vec4(position, 1.0);
  lit = colour.rgb;
}
