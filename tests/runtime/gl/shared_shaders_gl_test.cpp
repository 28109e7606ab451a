// The headers of shaders/shared mean the same to C++ and to the GLSL compiler.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <random>

#include "runtime/gl/context.h"
#include "runtime/gl/program.h"
#include "shaders/shared/draw.h"
#include "shaders/shared/shading.h"

namespace farcell {
namespace {

class SharedShaders : public testing::Test {
 protected:
  void SetUp() override {
    auto created = GlContext::createHeadless();
    ASSERT_TRUE(created) << created.error().message;
    context_.emplace(std::move(*created));
  }
  std::optional<GlContext> context_;
};

// Runs `body` (writes result from input, both vec4) once per input in a compute shader.
std::vector<glm::vec4> compute(const std::string& body, const std::vector<glm::vec4>& inputs) {
  const std::string text =
      "#include \"shaders/shared/shading.h\"\nlayout(local_size_x = 64) in;\n"
      "layout(std430, binding = 0) readonly buffer In { vec4 inputs[]; };\n"
      "layout(std430, binding = 1) buffer Out { vec4 results[]; };\n"
      "void main() { uint i = gl_GlobalInvocationID.x; if (i >= inputs.length()) return;\n"
      "vec4 given = inputs[i]; vec4 result = vec4(0); " +
      body + " results[i] = result; }\n";
  const auto resolved = resolveShader("test.comp", {}, [&](const std::string& path) {
    return path == "test.comp" ? Result<std::string>(text) : embeddedShaderSource(path);
  });
  EXPECT_TRUE(resolved);
  const char* source = resolved->text.c_str();
  const GlProgram program(glCreateShaderProgramv(GL_COMPUTE_SHADER, 1, &source));
  GLint linked = 0;
  glGetProgramiv(program.name(), GL_LINK_STATUS, &linked);
  EXPECT_TRUE(linked);
  std::vector<glm::vec4> results(inputs.size());
  const GlBuffer in = createBuffer(), out = createBuffer();
  const auto bytes = static_cast<GLsizeiptr>(inputs.size() * sizeof(glm::vec4));
  glNamedBufferData(in.name(), bytes, inputs.data(), GL_STATIC_DRAW);
  glNamedBufferData(out.name(), bytes, nullptr, GL_STATIC_READ);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, in.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, out.name());
  glUseProgram(program.name());
  glDispatchCompute(static_cast<GLuint>((inputs.size() + 63) / 64), 1, 1);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glGetNamedBufferSubData(out.name(), 0, bytes, results.data());
  return results;
}

std::vector<glm::vec4> directions() {
  std::vector<glm::vec4> result;
  for (int axis = 0; axis < 3; ++axis)
    for (const float sign : {-1.0f, 1.0f}) {
      glm::vec4 v(0);
      v[axis] = sign;
      result.push_back(v);
    }
  std::mt19937 random(3);
  std::normal_distribution<float> normal;
  while (result.size() < 10000)
    result.push_back(glm::vec4(glm::normalize(glm::vec3(normal(random), normal(random), normal(random))), 0.0f));
  return result;
}

TEST_F(SharedShaders, octahedralFunctionsAgreeAndInvertEachOther) {
  const auto inputs = directions();
  const auto encoded = compute("vec2 p = octahedralFromUnit(given.xyz); result = vec4(p, 0, 0);", inputs);
  const auto decoded = compute("result = vec4(unitFromOctahedral(octahedralFromUnit(given.xyz)), 0);", inputs);
  for (size_t i = 0; i < inputs.size(); ++i) {
    const glm::vec3 unit(inputs[i]);
    const glm::vec2 p = shared::octahedralFromUnit(unit);
    ASSERT_LT(glm::length(p - glm::vec2(encoded[i])), 1e-6f);
    ASSERT_LT(glm::length(shared::unitFromOctahedral(p) - glm::vec3(decoded[i])), 1e-6f);
    ASSERT_LT(glm::length(unit - glm::vec3(decoded[i])), 1e-6f);
  }
}

TEST_F(SharedShaders, shadeAgrees) {
  const auto inputs = directions();
  const auto lit = compute("result = vec4(shade(vec3(0.25, 0.5, 1.0), given.xyz, vec3(0.6, 0.0, 0.8)), 0);", inputs);
  for (size_t i = 0; i < inputs.size(); ++i) {
    const glm::vec3 expected = shared::shade({0.25f, 0.5f, 1.0f}, glm::vec3(inputs[i]), {0.6f, 0.0f, 0.8f});
    ASSERT_LT(glm::length(expected - glm::vec3(lit[i])), 1e-6f);
  }
}

GLint offsetOf(const GlProgram& program, GLenum kind, const char* name) {
  const GLuint index = glGetProgramResourceIndex(program.name(), kind, name);
  EXPECT_NE(index, GL_INVALID_INDEX) << name;
  const GLenum property = GL_OFFSET;
  GLint offset = -1;
  glGetProgramResourceiv(program.name(), kind, index, 1, &property, 1, nullptr, &offset);
  return offset;
}

TEST_F(SharedShaders, structuresLieAlikeInCppAndInTheDriver) {
  const auto program = loadProgram({"shaders/gl/impostor.vert", "shaders/gl/impostor.frag", {"VIEWS 3"}});
  ASSERT_TRUE(program) << program.error().message;
  using shared::FrameUniforms, shared::ImpostorInstance;
  EXPECT_EQ(offsetOf(*program, GL_UNIFORM, "frame.clipX"), static_cast<GLint>(offsetof(FrameUniforms, clipX)));
  EXPECT_EQ(offsetOf(*program, GL_UNIFORM, "frame.clipW"), static_cast<GLint>(offsetof(FrameUniforms, clipW)));
  EXPECT_EQ(offsetOf(*program, GL_UNIFORM, "frame.eyeSteps"), static_cast<GLint>(offsetof(FrameUniforms, eyeSteps)));
  EXPECT_EQ(offsetOf(*program, GL_UNIFORM, "frame.image"), static_cast<GLint>(offsetof(FrameUniforms, image)));
  EXPECT_EQ(offsetOf(*program, GL_UNIFORM, "frame.depthScale"),
            static_cast<GLint>(offsetof(FrameUniforms, depthScale)));
  EXPECT_EQ(offsetOf(*program, GL_BUFFER_VARIABLE, "instances[0].boxMax"),
            static_cast<GLint>(offsetof(ImpostorInstance, boxMax)));
  EXPECT_EQ(offsetOf(*program, GL_BUFFER_VARIABLE, "instances[0].tint"),
            static_cast<GLint>(offsetof(ImpostorInstance, tint)));
  EXPECT_EQ(offsetOf(*program, GL_BUFFER_VARIABLE, "instances[0].views[1].boxMax"),
            static_cast<GLint>(offsetof(ImpostorInstance, views) + sizeof(shared::ImpostorView) +
                               offsetof(shared::ImpostorView, boxMax)));
  const GLuint index = glGetProgramResourceIndex(program->name(), GL_BUFFER_VARIABLE, "instances[0].centre");
  const GLenum property = GL_TOP_LEVEL_ARRAY_STRIDE;
  GLint stride = 0;
  glGetProgramResourceiv(program->name(), GL_BUFFER_VARIABLE, index, 1, &property, 1, nullptr, &stride);
  EXPECT_EQ(stride, static_cast<GLint>(sizeof(ImpostorInstance)));
}

TEST_F(SharedShaders, compileErrorsNameTheFileAndLine) {
  const auto source = [](const std::string& path) {
    return path == "bad.vert"
               ? Result<std::string>("#include \"shaders/shared/shading.h\"\nvoid main() { nonsense; }\n")
               : embeddedShaderSource(path);
  };
  const auto program = loadProgram({"bad.vert", "shaders/gl/triangles.frag", {}}, source);
  ASSERT_FALSE(program);
  EXPECT_NE(program.error().message.find("bad.vert:2"), std::string::npos) << program.error().message;
  EXPECT_NE(program.error().message.find("nonsense"), std::string::npos);
}

TEST_F(SharedShaders, theContextIs45AndNamesItself) {
  EXPECT_FALSE(context_->renderer().empty());
  EXPECT_GE(epoxy_gl_version(), 45);
}

}  // namespace
}  // namespace farcell
