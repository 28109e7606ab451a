// The whole picture.
out vec2 onScreen;  // -1..1

void main() {
  onScreen = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0;
  gl_Position = vec4(onScreen, 0.5, 1.0);
}
