#include "runtime/gl/program.h"

namespace farcell {
namespace {

Result<GlShader> compile(GLenum stage, const std::string& path, const std::vector<std::string>& defines,
                         const ShaderSource& source) {
  FARCELL_ASSIGN(const ShaderText text, resolveShader(path, defines, source));
  GlShader shader(glCreateShader(stage));
  const char* begin = text.text.c_str();
  glShaderSource(shader.name(), 1, &begin, nullptr);
  glCompileShader(shader.name());
  GLint good = 0;
  glGetShaderiv(shader.name(), GL_COMPILE_STATUS, &good);
  if (good) return shader;
  GLint length = 0;
  glGetShaderiv(shader.name(), GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<size_t>(length), '\0');
  glGetShaderInfoLog(shader.name(), length, &length, log.data());
  log.resize(static_cast<size_t>(length));
  return fail(ErrorKind::invalidArgument, "{} does not compile:\n{}", path, namedLog(log, text.files));
}

}  // namespace

Result<GlProgram> loadProgram(const ProgramFiles& files, const ShaderSource& source) {
  FARCELL_ASSIGN(const GlShader vertex, compile(GL_VERTEX_SHADER, files.vertex, files.defines, source));
  FARCELL_ASSIGN(const GlShader fragment, compile(GL_FRAGMENT_SHADER, files.fragment, files.defines, source));
  GlProgram program(glCreateProgram());
  program.label(files.fragment);
  glAttachShader(program.name(), vertex.name());
  glAttachShader(program.name(), fragment.name());
  glLinkProgram(program.name());
  GLint good = 0;
  glGetProgramiv(program.name(), GL_LINK_STATUS, &good);
  if (good) return program;
  GLint length = 0;
  glGetProgramiv(program.name(), GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<size_t>(length), '\0');
  glGetProgramInfoLog(program.name(), length, &length, log.data());
  log.resize(static_cast<size_t>(length));
  return fail(ErrorKind::invalidArgument, "{} and {} do not link:\n{}", files.vertex, files.fragment, log);
}

}  // namespace farcell
