// The paper's billboard: a flat rectangle at its own depth.
uniform mat4 clipFromWorld;
uniform vec3 origin, alongX, alongY;

out vec2 texturePoint;

void main() {
  texturePoint = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  gl_Position = clipFromWorld * vec4(origin + texturePoint.x * alongX + texturePoint.y * alongY, 1.0);
}
