#include "runtime/gl/shader_text.h"

#include <gtest/gtest.h>

#include <map>

namespace farcell {
namespace {

ShaderSource sourceOf(std::map<std::string, std::string> files) {
  return [files = std::move(files)](const std::string& path) -> Result<std::string> {
    const auto found = files.find(path);
    if (found == files.end()) return fail(ErrorKind::notFound, "{}: no such file", path);
    return found->second;
  };
}

TEST(ShaderText, includesAreReplacedOnceAndLinesKeepTheirNumbers) {
  const auto source = sourceOf({{"a.vert", "one\n#include \"b.h\"\n  # include \"b.h\"\n#include <cmath>\nfive\n"},
                                {"b.h", "#include \"c.h\"\nb two"},
                                {"c.h", "c one\n#include \"a.vert\"\n"}});
  const auto result = resolveShader("a.vert", std::vector<std::string>{"X 3"}, source);
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_EQ(result->files, (std::vector<std::string>{"a.vert", "b.h", "c.h"}));
  EXPECT_EQ(result->text,
            "#version 450 core\n#define X 3\n#line 1 0\none\n#line 1 1\n#line 1 2\nc one\n#line 3 2\n#line 2 1\nb two\n"
            "#line 3 0\n#line 4 0\n\nfive\n");
}

TEST(ShaderText, aMissingFileIsNamedWithTheLineThatAskedForIt) {
  const auto result = resolveShader("a.vert", {}, sourceOf({{"a.vert", "\n#include \"b.h\"\n"}}));
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().message, "a.vert:2: b.h: no such file");
  EXPECT_FALSE(resolveShader("a.vert", {}, sourceOf({{"a.vert", "#include b.h\n"}})));
  EXPECT_FALSE(resolveShader("a.vert", {}, sourceOf({{"a.vert", "#include \"b.h\n"}})));
  EXPECT_FALSE(resolveShader("none", {}, embeddedShaderSource));
}

TEST(ShaderText, logsNameFiles) {
  const std::vector<std::string> files = {"a.vert", "b.h"};
  EXPECT_EQ(namedLog("1:12(3): error: x\n0(7) : error y\nother 5: z\n9:1(1): w", files),
            "b.h:12(3): error: x\na.vert(7) : error y\nother 5: z\n9:1(1): w");
  EXPECT_EQ(namedLog("", files), "");
}

}  // namespace
}  // namespace farcell
