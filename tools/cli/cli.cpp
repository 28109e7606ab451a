#include "tools/cli/cli.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <glm/trigonometric.hpp>
#include <memory>

#include "cache/base/interrupt.h"
#include "tools/reference/reference.h"

namespace farcell {
namespace {
constexpr int kExitFailed = 1;
constexpr int kExitMisused = 2;

int report(const CLI::App& app, const Error& error) {
  std::fprintf(stderr, "%s: %s\n", app.get_name().c_str(), error.message.c_str());
  return error.kind == ErrorKind::invalidArgument ? kExitMisused : kExitFailed;
}

class HelpFormatter : public CLI::FormatterBase {
 public:
  std::string make_help(const CLI::App* app, std::string, CLI::AppFormatMode) const override {
    return helpText(describe(*app));
  }
};

void improveHelp(CLI::App& app) {
  app.formatter(std::make_shared<HelpFormatter>());
  app.get_help_ptr()->description("print this help and exit");
  for (CLI::App* sub : app.get_subcommands([](CLI::App*) { return true; })) improveHelp(*sub);
}

// Today, or the day that SOURCE_DATE_EPOCH says, so that a package can be made again bit for bit.
std::string referenceDate() {
  std::time_t seconds = std::time(nullptr);
  if (const char* text = std::getenv("SOURCE_DATE_EPOCH")) {
    const std::string_view digits = text;
    std::from_chars(digits.data(), digits.data() + digits.size(), seconds);
  }
  std::tm day{};
  std::array<char, 16> date{};
  const bool known = ::gmtime_r(&seconds, &day) != nullptr && day.tm_year >= 0 && day.tm_year < 8000;
  return known && std::strftime(date.data(), date.size(), "%Y-%m-%d", &day) > 0 ? date.data() : "1970-01-01";
}

std::string reference(const CLI::App& app, const std::string& form) {
  const CommandDescription program = describe(app);
  if (form == "man") return manualPage(program, FARCELL_VERSION, referenceDate());
  if (form == "bash") return bashCompletion(program);
  return form == "zsh" ? zshCompletion(program) : fishCompletion(program);
}

// What they print takes the place of the work.
void addStandardOptions(CLI::App& app) {
  app.set_version_flag("--version", app.get_name() + " " + FARCELL_VERSION, "print the version and exit");
  app.add_option_function<std::string>(
         "--print-reference", [&app](const std::string& form) { throw CLI::CallForVersion(reference(app, form), 0); },
         "print the manual page or a shell's completion and exit; the build makes the installed ones with it")
      ->group("")
      ->check(CLI::IsMember({"man", "bash", "zsh", "fish"}));
}

uint64_t countFactor(std::string_view suffix) {
  if (suffix.empty()) return 1;
  if (suffix == "k" || suffix == "K") return 1'000;
  if (suffix == "M") return 1'000'000;
  if (suffix == "G") return 1'000'000'000;
  return 0;
}
}  // namespace

int runProgram(CLI::App& app, int argc, char** argv, const std::function<Result<>()>& work) {
  improveHelp(app);
  addStandardOptions(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kExitMisused;
  }
  installInterruptHandler();
  try {
    const Result<> result = work();
    return result ? 0 : report(app, result.error());
  } catch (const std::bad_alloc&) {
    return report(app, {ErrorKind::exhausted, "out of memory"});
  } catch (const std::exception& error) {
    return report(app, {ErrorKind::io, error.what()});
  }
}

void addProgressOption(CLI::App& app, ProgressForm& form) {
  app.add_option_function<std::string>(
         "--progress", [&form](const std::string& name) { form = *progressFormNamed(name); },
         "progress on stderr; auto: a bar on a terminal, else a line at each tenth; json: a line for each event")
      ->check(CLI::IsMember({"none", "auto", "bar", "json"}))
      ->default_str("auto");
  app.add_flag_callback(
      "--quiet", [&form] { form = ProgressForm::none; }, "no progress: --progress none");
}

Result<uint64_t> parseCount(const std::string& text) {
  double value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  const uint64_t factor = countFactor(std::string_view(end, text.data() + text.size()));
  const double count = value * static_cast<double>(factor);
  // A part of one thing is a slip ("1.5"); 1.1M is not, though 1.1 has no exact double.
  const bool whole = std::abs(count - std::round(count)) <= 1e-9 * count;
  if (code != std::errc{} || factor == 0 || !(count >= 0 && count <= 1e18) || !whole)
    return fail(ErrorKind::invalidArgument, "expected a count such as 1234, 500k or 5M, found '{}'", text);
  return static_cast<uint64_t>(std::round(count));
}

Result<uint64_t> parseBytes(const std::string& text) {
  double value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  const std::string_view unit(end, text.data() + text.size());
  constexpr std::string_view kUnits = "KMGT";
  const size_t power = unit.size() == 1 ? kUnits.find(unit[0] == 'k' ? 'K' : unit[0]) : std::string_view::npos;
  const double bytes = std::round(unit.empty() ? value : std::ldexp(value, 10 * (static_cast<int>(power) + 1)));
  if (code != std::errc{} || (!unit.empty() && power == std::string_view::npos) || !(bytes >= 0 && bytes <= 1e18))
    return fail(ErrorKind::invalidArgument, "expected bytes such as 1234, 512M or 2G, found '{}'", text);
  return static_cast<uint64_t>(bytes);
}

Result<ImageSize> parseImageSize(const std::string& text) {
  ImageSize size;
  const char* end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size.width);
  bool valid = width.ec == std::errc{} && width.ptr != end && *width.ptr == 'x';
  if (valid) {
    const auto height = std::from_chars(width.ptr + 1, end, size.height);
    valid = height.ec == std::errc{} && height.ptr == end && std::min(size.width, size.height) >= 1 &&
            std::max(size.width, size.height) <= 16384;
  }
  if (!valid)
    return fail(ErrorKind::invalidArgument, "expected a size such as 1280x720 (1 to 16384), found '{}'", text);
  return size;
}

Result<std::array<uint8_t, 3>> parseColour(const std::string& option, const std::string& text) {
  std::array<uint8_t, 3> colour{};
  const char* at = text.data();
  const char* const end = at + text.size();
  for (size_t i = 0; i < 3; ++i) {
    const auto [next, code] = std::from_chars(at, end, colour[i]);
    const bool separated = i < 2 ? next != end && *next == ',' : next == end;
    if (code != std::errc{} || !separated)
      return fail(ErrorKind::invalidArgument, "{}: expected R,G,B of 0 to 255, found '{}'", option, text);
    at = next + 1;
  }
  return colour;
}

Result<Sun> parseSun(const std::string& option, const std::string& text) {
  std::array<double, 2> degrees{};
  const char* const end = text.data() + text.size();
  const auto [comma, first] = std::from_chars(text.data(), end, degrees[0]);
  const bool separated = first == std::errc{} && comma != end && *comma == ',';
  const auto [last, second] = std::from_chars(separated ? comma + 1 : end, end, degrees[1]);
  const Sun sun{glm::radians(degrees[0]), glm::radians(degrees[1])};
  if (second != std::errc{} || last != end || !isSun(sun))
    return fail(ErrorKind::invalidArgument, "{}: expected AZIMUTH,ELEVATION of -360 to 360 and -90 to 90, found '{}'",
                option, text);
  return sun;
}

}  // namespace farcell
