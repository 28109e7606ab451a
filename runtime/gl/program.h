// Programs from shader files.
#pragma once

#include <string>
#include <vector>

#include "cache/base/result.h"
#include "runtime/gl/objects.h"
#include "runtime/gl/shader_text.h"

namespace farcell {

struct ProgramFiles {
  std::string vertex;  // from the repository root, e.g. "shaders/gl/triangles.vert"
  std::string fragment;
  std::vector<std::string> defines;  // "NAME" or "NAME value", for both stages
};

// Compiles and links. The error is the driver's log with file names and lines. REQUIRES: a current context.
Result<GlProgram> loadProgram(const ProgramFiles& files, const ShaderSource& source = embeddedShaderSource);

}  // namespace farcell
