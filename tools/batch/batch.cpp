#include "tools/batch/batch.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <ctime>
#include <mutex>
#include <nlohmann/json.hpp>

#include "cache/base/file.h"
#include "cache/base/interrupt.h"
#include "cache/base/parallel.h"
#include "tools/batch/child.h"
#include "tools/batch/plan/build_record.h"

namespace farcell {
namespace {

using Json = nlohmann::json;

struct Places {
  std::filesystem::path program;  // farcell-build
  std::filesystem::path list;     // directory of the list: builds run there, so its paths are theirs
  std::filesystem::path packs;
};

int64_t nowNs() {
  timespec now{};
  ::clock_gettime(CLOCK_REALTIME, &now);
  return int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

Result<Places> placesOf(const BatchOptions& options) {
  std::error_code error;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
  std::filesystem::create_directories(options.output, error);
  if (!std::filesystem::is_directory(options.output))
    return fail(ErrorKind::io, "{}: cannot make the directory: {}", options.output.string(), error.message());
  return Places{self.parent_path() / "farcell-build", std::filesystem::absolute(options.list).parent_path(),
                std::filesystem::absolute(options.output)};
}

// What decides the pack; how the build reports does not.
std::vector<std::string> argumentsOf(const DataSet& set, const Places& places) {
  std::vector<std::string> arguments = set.options;
  arguments.push_back(fmt::format("--output={}", (places.packs / set.output).string()));
  arguments.push_back("--");
  arguments.insert(arguments.end(), set.meshes.begin(), set.meshes.end());
  return arguments;
}

// What a build says on stderr: how far it is, as JSON, and why it failed.
struct Listener {
  std::string stage;
  std::string message;

  void hear(std::string_view line) {
    if (!line.starts_with("{\"event\":")) {
      message = line;
      return;
    }
    const Json event = Json::parse(line, nullptr, false);
    if (event.is_object() && event.contains("stage") && event["stage"].is_string())
      stage = event["stage"].get<std::string>();
  }
};

std::string whyFailed(const ChildOutcome& child, const Listener& heard) {
  if (child.signal != 0)
    return fmt::format("killed by signal {} ({}){}{}", child.signal, ::strsignal(child.signal),
                       heard.stage.empty() ? "" : " in stage ", heard.stage);
  return heard.message.empty() ? fmt::format("exit code {}", child.exitCode) : heard.message;
}

// Notes what the pack was built from. A file that changed since the build began may be another than was read: no
// record, and the next run builds again.
Result<> keepRecord(const std::filesystem::path& path, const std::vector<std::string>& arguments, const Json& report,
                    const std::filesystem::path& pack, const Places& places, int64_t begunNs) {
  BuildRecord record;
  record.version = FARCELL_VERSION;
  record.arguments = arguments;
  record.triangles = report.at("input").at("triangles").get<uint64_t>();
  FARCELL_ASSIGN(record.pack, identityOf(pack));
  for (const Json& file : report.at("files")) {
    FARCELL_ASSIGN(FileIdentity identity, identityOf(places.list / file.get<std::string>()));
    if (identity.modifiedNs >= begunNs) return {};
    record.files.push_back(std::move(identity));
  }
  return writeTextFile(path, recordText(record));
}

void takeReport(DataSetResult& result, const Json& report) {
  result.outcome = Outcome::ok;
  result.triangles = report.at("input").at("triangles").get<uint64_t>();
  result.packBytes = report.at("bytes").at("pack").get<uint64_t>();
}

DataSetResult build(const DataSet& set, const Places& places, const std::vector<std::string>& arguments,
                    const std::filesystem::path& recordPath) {
  DataSetResult result{set.name, Outcome::failed, 0, 0, 0, 0, ""};
  std::error_code ignored;
  std::filesystem::remove(recordPath, ignored);  // from here on it may be of another pack
  std::vector<std::string> words = {"--json", "--progress=json"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const int64_t begunNs = nowNs();
  Listener heard;
  const Result<ChildOutcome> child =
      runChild(places.program, words, places.list, [&](std::string_view line) { heard.hear(line); });
  if (!child) {
    result.message = child.error().message;
    return result;
  }
  result.seconds = child->seconds;
  result.peakRssBytes = child->peakRssBytes;
  if (child->exitCode != 0) {
    result.message = whyFailed(*child, heard);
    return result;
  }
  try {
    const Json report = Json::parse(child->out);
    takeReport(result, report);
    if (const Result<> kept = keepRecord(recordPath, arguments, report, places.packs / set.output, places, begunNs);
        !kept)
      result.message = kept.error().message;
  } catch (const Json::exception& error) {
    result.outcome = Outcome::failed;
    result.message = fmt::format("report of the build: {}", error.what());
  }
  return result;
}

DataSetResult bringUpToDate(const DataSet& set, const Places& places) {
  const std::vector<std::string> arguments = argumentsOf(set, places);
  const std::filesystem::path recordPath = places.packs / fmt::format("{}.json", set.name);
  if (const auto record = currentRecord(recordPath, arguments))
    return {set.name, Outcome::current, record->triangles, 0, 0, record->pack.bytes, ""};
  return build(set, places, arguments, recordPath);
}

}  // namespace

const char* nameOf(Outcome outcome) {
  switch (outcome) {
    case Outcome::ok:
      return "ok";
    case Outcome::failed:
      return "failed";
    case Outcome::current:
      return "skipped as current";
    case Outcome::notRun:
      return "not run";
  }
  return "";
}

Result<std::vector<DataSetResult>> runBatch(const BatchOptions& options,
                                            const std::function<void(const DataSetResult&)>& onResult) {
  FARCELL_ASSIGN(const std::vector<DataSet> sets, readDataSets(options.list));
  FARCELL_ASSIGN(const Places places, placesOf(options));
  std::vector<DataSetResult> results(sets.size());
  for (size_t i = 0; i < sets.size(); ++i) results[i].name = sets[i].name;
  std::atomic<bool> stopped{false};
  std::mutex mutex;
  Progress progress(options.progress);
  progress.begin("batch", sets.size(), "data sets");
  parallelFor(sets.size(), options.jobs, [&](size_t i, int) {
    if (stopped || interrupted()) return;
    DataSetResult result = bringUpToDate(sets[i], places);
    if (interrupted() && result.outcome == Outcome::failed) return;  // it was told to stop
    if (options.stopOnFailure && result.outcome == Outcome::failed) stopped = true;
    const std::lock_guard lock(mutex);
    progress.advance();
    onResult(results[i] = std::move(result));
  });
  progress.end();
  return results;
}

}  // namespace farcell
