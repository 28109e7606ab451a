#include "cache/base/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdio>

namespace farcell {
namespace {
constexpr int64_t kPrintEveryMs = 250;

double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Of the terminal; 80 where there is none.
size_t columns() {
  winsize size{};
  return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1 ? size.ws_col : 80;
}

void put(const std::string& text) {
  std::fputs(text.c_str(), stderr);
  std::fflush(stderr);
}
}  // namespace

std::optional<ProgressForm> progressFormNamed(std::string_view name) {
  if (name == "none") return ProgressForm::none;
  if (name == "auto") return ProgressForm::automatic;
  if (name == "bar") return ProgressForm::bar;
  if (name == "json") return ProgressForm::json;
  return std::nullopt;
}

Progress::Progress(ProgressForm form)
    : form_(form == ProgressForm::automatic ? ProgressForm::bar : form),
      lines_(form == ProgressForm::automatic && ::isatty(STDERR_FILENO) == 0) {}

Progress::~Progress() {
  if (barStands_) put("\n");
  if (form_ == ProgressForm::json)
    put(fmt::format("{{\"event\":\"done\",\"seconds\":{:.3f}}}\n", secondsSince(created_)));
}

void Progress::budget(const std::string& name, uint64_t limit, std::function<uint64_t()> used) {
  const std::lock_guard lock(mutex_);
  std::erase_if(budgets_, [&](const Budget& budget) { return budget.name == name; });
  budgets_.push_back({name, limit, std::move(used)});
}

void Progress::begin(const std::string& stage, uint64_t total, const std::string& unit) {
  end();
  const std::lock_guard lock(mutex_);
  stage_ = stage;
  unit_ = unit;
  total_ = total;
  tenthsPrinted_ = 0;
  done_ = 0;
  nextPrintMs_ = kPrintEveryMs;
  start_ = std::chrono::steady_clock::now();
  if (form_ == ProgressForm::json) print(Event::begin);
}

void Progress::advance(uint64_t units) {
  done_.fetch_add(units);
  if (form_ == ProgressForm::none) return;
  const auto nowMs = static_cast<int64_t>(secondsSince(start_) * 1000);
  int64_t due = nextPrintMs_.load();
  if (nowMs < due || !nextPrintMs_.compare_exchange_strong(due, nowMs + kPrintEveryMs)) return;
  const std::lock_guard lock(mutex_);
  print(Event::advance);
}

void Progress::end() {
  const std::lock_guard lock(mutex_);
  if (form_ != ProgressForm::none && !stage_.empty()) print(Event::end);
  stage_.clear();
}

void Progress::print(Event event) {
  if (stage_.empty()) return;
  const StageProgress stage{stage_, unit_, done_.load(), total_, secondsSince(start_)};
  const auto tenths = static_cast<int>(stage.share() * 10);
  if (lines_ && event == Event::advance && tenths <= tenthsPrinted_) return;
  tenthsPrinted_ = tenths;
  put(textOf(event, stage));
  barStands_ = form_ == ProgressForm::bar && !lines_ && event != Event::end;
}

std::string Progress::textOf(Event event, const StageProgress& stage) const {
  std::vector<BudgetUse> budgets;
  for (const Budget& budget : budgets_) budgets.push_back({budget.name, budget.used(), budget.limit});
  const bool ended = event == Event::end;
  if (form_ == ProgressForm::json) {
    const std::string_view name = ended ? "end" : event == Event::begin ? "begin" : "advance";
    return fmt::format("{}\n", progressJson(name, stage, budgets));
  }
  if (lines_) return fmt::format("{}\n", progressLine(stage, budgets, ended));
  const size_t width = columns() - 1;
  const std::string text = ended ? progressLine(stage, {}, true) : progressBar(stage, budgets, width);
  return fmt::format("\r{:<{}}{}", text.substr(0, width), width, ended ? "\n" : "");
}

}  // namespace farcell
