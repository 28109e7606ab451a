#include "tools/cli/cli.h"

#include <gtest/gtest.h>

#include <functional>
#include <new>
#include <regex>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace farcell {
namespace {

TEST(ParseCount, TakesPlainNumbersAndDecimalFactors) {
  const std::vector<std::pair<std::string, uint64_t>> counts = {{"0", 0},
                                                                {"1", 1},
                                                                {"1234", 1234},
                                                                {"500k", 500'000},
                                                                {"500K", 500'000},
                                                                {"5M", 5'000'000},
                                                                {"2G", 2'000'000'000},
                                                                {"1.5k", 1500},
                                                                {"1.1M", 1'100'000},
                                                                {"0.001k", 1},
                                                                {"1e3", 1000},
                                                                {"007", 7},
                                                                {"1000000000000000000", 1'000'000'000'000'000'000}};
  for (const auto& [text, count] : counts) {
    const auto parsed = parseCount(text);
    ASSERT_TRUE(parsed) << text;
    EXPECT_EQ(*parsed, count) << text;
  }
}

TEST(ParseBytes, TakesPlainNumbersAndPowersOf1024) {
  const std::vector<std::pair<std::string, uint64_t>> sizes = {{"0", 0},
                                                               {"1234", 1234},
                                                               {"4k", 4096},
                                                               {"4K", 4096},
                                                               {"512M", 512u << 20},
                                                               {"2G", uint64_t{2} << 30},
                                                               {"1.5G", uint64_t{3} << 29},
                                                               {"3T", uint64_t{3} << 40}};
  for (const auto& [text, bytes] : sizes) EXPECT_EQ(parseBytes(text).value_or(7), bytes) << text;
  for (const std::string text : {"", "M", "-1", "5 M", "5MB", "5m", "5P", "nan", "inf", "1e19", "five", "2GG"}) {
    const auto parsed = parseBytes(text);
    ASSERT_FALSE(parsed) << text;
    EXPECT_NE(parsed.error().message.find("'" + text + "'"), std::string::npos) << parsed.error().message;
  }
}

TEST(ParseSun, TakesTwoAnglesInDegreesAndRefusesEverythingElse) {
  const auto sun = parseSun("--sun", "-120.5,30");
  ASSERT_TRUE(sun);
  EXPECT_NEAR(sun->azimuthRad, -2.1031217, 1e-6);
  EXPECT_NEAR(sun->elevationRad, 0.5235988, 1e-6);
  EXPECT_TRUE(parseSun("--sun", "360,-90"));
  for (const std::string text :
       {"", ",", "1", "1,", ",1", "1,2,3", "1;2", "1, 2", "361,0", "0,91", "nan,0", "0,inf", "1e3,0", "a,b", "1,2x"}) {
    const auto parsed = parseSun("--sun", text);
    ASSERT_FALSE(parsed) << text;
    EXPECT_EQ(parsed.error().kind, ErrorKind::invalidArgument);
    EXPECT_NE(parsed.error().message.find(
                  fmt::format("--sun: expected AZIMUTH,ELEVATION of -360 to 360 and -90 to 90, found '{}'", text)),
              std::string::npos);
  }
}

TEST(ParseCount, RefusesEverythingElseAndQuotesIt) {
  for (const std::string text :
       {"",      "k",   "M5",      "-1",  "-5M", "5 M",  " 5",    "5 ",   "5MM",         "5m", "5T",   "5kM", "0x10",
        "1,000", "1.5", "0.0001k", "nan", "inf", "infM", "1e400", "1e19", "2000000000G", "1e", "5M\n", "five"}) {
    const auto parsed = parseCount(text);
    ASSERT_FALSE(parsed) << "'" << text << "' gave " << *parsed;
    EXPECT_EQ(parsed.error().kind, ErrorKind::invalidArgument);
    EXPECT_NE(parsed.error().message.find("found '" + text + "'"), std::string::npos) << parsed.error().message;
  }
  EXPECT_FALSE(parseCount(std::string("5\0", 2)));
  EXPECT_FALSE(parseCount(std::string(100'000, '9')));
}

TEST(ParseImageSize, TakesWidthXHeightWithinTheLimits) {
  const std::vector<std::pair<std::string, std::pair<int, int>>> sizes = {
      {"1280x720", {1280, 720}}, {"1x1", {1, 1}}, {"16384x16384", {16384, 16384}}, {"0640x0480", {640, 480}}};
  for (const auto& [text, size] : sizes) {
    const auto parsed = parseImageSize(text);
    ASSERT_TRUE(parsed) << text;
    EXPECT_EQ(std::pair(parsed->width, parsed->height), size) << text;
  }
}

TEST(ParseImageSize, RefusesEverythingElseAndQuotesIt) {
  for (const std::string text :
       {"",          "x",         "1280", "1280x", "x720",    "1280X720", "1280 x 720",    "1280x720x3",    "0x5",
        "5x0",       "-5x5",      "5x-5", "+5x5",  "16385x1", "1x16385",  "99999999999x1", "1x99999999999", "1.5x2",
        "1280x720 ", " 1280x720", "axb"}) {
    const auto parsed = parseImageSize(text);
    ASSERT_FALSE(parsed) << text;
    EXPECT_EQ(parsed.error().kind, ErrorKind::invalidArgument);
    EXPECT_NE(parsed.error().message.find("found '" + text + "'"), std::string::npos) << parsed.error().message;
  }
  EXPECT_FALSE(parseImageSize(std::string("5x5\0", 4)));
}

struct Outcome {
  int code;
  std::string out;
  std::string err;
};

// Runs a program with one option, --number <int>, whose work is `work`.
Outcome run(std::vector<std::string> arguments, const std::function<Result<>()>& work) {
  CLI::App app("counts things", "farcell-count");
  int number = 0;
  app.add_option("--number", number, "how many")->required();
  arguments.insert(arguments.begin(), "farcell-count");
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const int code = runProgram(app, static_cast<int>(argv.size()), argv.data(), work);
  std::string out = testing::internal::GetCapturedStdout();
  return {code, std::move(out), testing::internal::GetCapturedStderr()};
}

Result<> succeed() { return {}; }
Result<> mustNotRun() {
  ADD_FAILURE() << "the work ran in spite of a wrong command line";
  return {};
}

TEST(RunProgram, SuccessIsExitZeroAndSilent) {
  const Outcome outcome = run({"--number", "3"}, succeed);
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.out + outcome.err, "");
}

TEST(RunProgram, AWrongCommandLineIsExitTwoWithAMessageOnStderrOnly) {
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {}, {"--number"}, {"--number", "three"}, {"--number", "3", "--unknown"}, {"--number", "3", "stray"}}) {
    const Outcome outcome = run(arguments, mustNotRun);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err, "");
  }
}

TEST(RunProgram, HelpAndVersionAreExitZeroOnStdout) {
  const Outcome help = run({"--help"}, mustNotRun);
  EXPECT_EQ(help.code, 0);
  EXPECT_NE(help.out.find("--number"), std::string::npos);
  EXPECT_EQ(help.err, "");
  const Outcome version = run({"--version"}, mustNotRun);
  EXPECT_EQ(version.code, 0);
  EXPECT_NE(version.out.find(FARCELL_VERSION), std::string::npos);
}

TEST(RunProgram, PrintsItsReferenceInsteadOfWorkingAndRefusesOtherForms) {
  for (const auto& [form, mark] : std::vector<std::pair<std::string, std::string>>{
           {"man", ".TH FARCELL\\-COUNT 1 "}, {"bash", "complete -F"}, {"zsh", "#compdef"}, {"fish", "complete -c"}}) {
    const Outcome outcome = run({"--print-reference", form}, mustNotRun);
    EXPECT_EQ(outcome.code, 0);
    EXPECT_NE(outcome.out.find(mark), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("number"), std::string::npos) << outcome.out;
    EXPECT_EQ(outcome.err, "");
  }
  const Outcome other = run({"--print-reference", "html"}, mustNotRun);
  EXPECT_EQ(other.code, 2);
  EXPECT_EQ(other.out, "");
  EXPECT_NE(other.err.find("html not in {man,bash,zsh,fish}"), std::string::npos) << other.err;
  EXPECT_EQ(run({"--print-reference"}, mustNotRun).code, 2);
}

TEST(RunProgram, TheManualPageIsOfTheDayThatSourceDateEpochNames) {
  const auto firstLine = [](const char* epoch) {
    ::setenv("SOURCE_DATE_EPOCH", epoch, 1);
    const std::string out = run({"--print-reference", "man"}, mustNotRun).out;
    ::unsetenv("SOURCE_DATE_EPOCH");
    return out.substr(0, out.find('\n'));
  };
  EXPECT_NE(firstLine("86400").find(" 1970-01-02 "), std::string::npos);
  // Nonsense is today; what no calendar holds is the first day of all.
  for (const char* epoch : {"", "soon", "99999999999999999999", "9223372036854775807", "-9223372036854775808"})
    EXPECT_TRUE(std::regex_search(firstLine(epoch), std::regex(" \\d{4}-\\d\\d-\\d\\d "))) << epoch;
}

TEST(RunProgram, AFailureIsExitOneAndAnInvalidArgumentExitTwo) {
  const Outcome failed = run({"--number", "3"}, [] { return fail(ErrorKind::corrupt, "a.far: broken"); });
  EXPECT_EQ(failed.code, 1);
  EXPECT_EQ(failed.err, "farcell-count: a.far: broken\n");
  EXPECT_EQ(failed.out, "");
  for (const ErrorKind kind :
       {ErrorKind::notFound, ErrorKind::unsupported, ErrorKind::io, ErrorKind::exhausted, ErrorKind::cancelled})
    EXPECT_EQ(run({"--number", "3"}, [&] { return fail(kind, "x"); }).code, 1);
  EXPECT_EQ(run({"--number", "3"}, [] { return fail(ErrorKind::invalidArgument, "x"); }).code, 2);
}

TEST(RunProgram, ExceptionsOfLibrariesEndAsExitOneWithAMessage) {
  const Outcome memory = run({"--number", "3"}, []() -> Result<> { throw std::bad_alloc(); });
  EXPECT_EQ(memory.code, 1);
  EXPECT_EQ(memory.err, "farcell-count: out of memory\n");
  const Outcome other = run({"--number", "3"}, []() -> Result<> { throw std::runtime_error("odd"); });
  EXPECT_EQ(other.code, 1);
  EXPECT_EQ(other.err, "farcell-count: odd\n");
}

}  // namespace
}  // namespace farcell
