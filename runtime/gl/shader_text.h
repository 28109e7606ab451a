// Shader files made into one text a GLSL compiler takes. A path is written from the repository root.
//
//   #include "shaders/shared/shading.h"   is replaced by that file, each file once
//   #include <glm/vec3.hpp>               is for C++ and dropped
//
// #line keeps every line's number; the source string number is the index into ShaderText::files.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cache/base/result.h"

namespace farcell {

struct ShaderText {
  std::string text;
  std::vector<std::string> files;  // by source string number
};

// Text of the file at `path`, or notFound.
using ShaderSource = std::function<Result<std::string>(const std::string& path)>;

// The files that were built into the program.
Result<std::string> embeddedShaderSource(const std::string& path);

// `#version 450 core` and one `#define` for each of `defines` come first. The file has no #version of its own.
Result<ShaderText> resolveShader(const std::string& path, std::span<const std::string> defines,
                                 const ShaderSource& source);

// A compiler's log with source string numbers replaced by file names ("0:12(3): error" -> "shaders/gl/a.vert:12(3):
// error").
std::string namedLog(const std::string& log, std::span<const std::string> files);

}  // namespace farcell
