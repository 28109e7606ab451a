// One triangle over the whole picture.
out vec2 onScreen;  // -1..1, y up

void main() {
  onScreen = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  gl_Position = vec4(onScreen, 0.5, 1.0);
}
