#include "runtime/gl/shader_text.h"

#include <algorithm>
#include <charconv>

#include "shaders/embedded.h"

namespace farcell {
namespace {

constexpr size_t kMaxFiles = 64;

std::string_view trimmed(std::string_view line) {
  const size_t first = line.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return line.substr(first, line.find_last_not_of(" \t\r") - first + 1);
}

struct Include {
  bool present = false;
  bool system = false;    // <...>
  std::string_view path;  // empty: malformed
};

Include parseInclude(std::string_view line) {
  line = trimmed(line);
  if (line.empty() || line.front() != '#') return {};
  line = trimmed(line.substr(1));
  if (!line.starts_with("include")) return {};
  line = trimmed(line.substr(7));
  if (line.starts_with('<')) return {true, true, {}};
  const size_t end = line.size() < 2 || line.front() != '"' ? std::string_view::npos : line.find('"', 1);
  return {true, false, end == std::string_view::npos ? std::string_view() : line.substr(1, end - 1)};
}

Result<> append(ShaderText& result, const std::string& path, const std::string& includedFrom,
                const ShaderSource& source) {
  if (std::find(result.files.begin(), result.files.end(), path) != result.files.end()) return {};
  if (result.files.size() == kMaxFiles)
    return fail(ErrorKind::invalidArgument, "{}: more than {} shader files included", path, kMaxFiles);
  const Result<std::string> text = source(path);
  if (!text) return fail(text.error().kind, "{}{}", includedFrom, text.error().message);
  const size_t file = result.files.size();
  result.files.push_back(path);
  result.text += fmt::format("#line 1 {}\n", file);
  size_t lineNumber = 0;
  for (std::string_view rest = *text; !rest.empty();) {
    ++lineNumber;
    const size_t end = rest.find('\n');
    const std::string_view line = rest.substr(0, end);
    rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
    const Include include = parseInclude(line);
    if (!include.present) {
      result.text.append(line).append("\n");
    } else if (include.system) {
      result.text += "\n";
    } else if (include.path.empty()) {
      return fail(ErrorKind::invalidArgument, "{}:{}: expected #include \"path\", found '{}'", path, lineNumber, line);
    } else {
      FARCELL_TRY(append(result, std::string(include.path), fmt::format("{}:{}: ", path, lineNumber), source));
      result.text += fmt::format("#line {} {}\n", lineNumber + 1, file);
    }
  }
  return {};
}

}  // namespace

Result<std::string> embeddedShaderSource(const std::string& path) {
  const std::string_view text = embeddedShader(path);
  if (text.data() == nullptr) return fail(ErrorKind::notFound, "{}: no such shader file in this program", path);
  return std::string(text);
}

Result<ShaderText> resolveShader(const std::string& path, std::span<const std::string> defines,
                                 const ShaderSource& source) {
  ShaderText result;
  result.text = "#version 450 core\n";
  for (const std::string& define : defines) result.text += fmt::format("#define {}\n", define);
  FARCELL_TRY(append(result, path, "", source));
  return result;
}

std::string namedLog(const std::string& log, std::span<const std::string> files) {
  std::string result;
  for (std::string_view rest = log; !rest.empty();) {
    const size_t end = std::min(rest.find('\n'), rest.size() - 1) + 1;
    std::string_view line = rest.substr(0, end);
    rest = rest.substr(end);
    size_t file = 0;
    const auto [last, code] = std::from_chars(line.data(), line.data() + line.size(), file);
    const size_t digits = static_cast<size_t>(last - line.data());
    // Mesa writes "0:12(3): ", NVIDIA "0(12) : ".
    if (code == std::errc{} && file < files.size() && digits < line.size() &&
        (line[digits] == ':' || line[digits] == '(')) {
      result += files[file];
      line = line.substr(digits);
    }
    result += line;
  }
  return result;
}

}  // namespace farcell
