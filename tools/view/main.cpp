// farcell-view: a window on a pack.
#include "tools/cli/cli.h"
#include "tools/view/viewer.h"

namespace farcell {
namespace {

Result<> run(const ViewOptions& options) {
  FARCELL_ASSIGN(const DrawPlan plan, planOf(options));
  if (options.frames == 0 && !options.statsFile.empty())
    return fail(ErrorKind::invalidArgument, "--json needs --frames");
  FARCELL_ASSIGN(Viewer viewer, Viewer::open(options, plan));
  if (!options.screenshot.empty()) {
    FARCELL_TRY(viewer.captureTo(options.screenshot));
  }
  if (options.frames > 0) return viewer.measure();
  return options.screenshot.empty() ? viewer.run() : Result<>{};
}

}  // namespace
}  // namespace farcell

int main(int argc, char** argv) {
  CLI::App app("Shows a pack in a window: fly through it or turn it around.", "farcell-view");
  app.footer("Keys:\n" + farcell::keyHelp());
  farcell::ViewOptions options;
  farcell::addViewOptions(app, options);
  return farcell::runProgram(app, argc, argv, [&] { return farcell::run(options); });
}
