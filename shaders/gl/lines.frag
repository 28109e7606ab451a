flat in vec4 shownColour;

layout(location = 0) out vec4 colour;            // premultiplied by coverage
layout(location = 1) out vec4 impostorCoverage;  // not attached unless asked for

void main() {
  colour = vec4(shownColour.rgb * shownColour.a, shownColour.a);
  impostorCoverage = vec4(0.0, 0.0, 0.0, shownColour.a);
}
