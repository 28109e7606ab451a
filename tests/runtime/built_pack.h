// A pack as the build makes it, in small leaves and coarse views, opened and drawn. (renderer_fixture.h has packs that
// tests put together by hand.)
#pragma once

#include <unistd.h>

#include <filesystem>
#include <functional>
#include <string>

#include "cache/base/progress.h"
#include "preprocess/build/build.h"
#include "tests/runtime/renderer_fixture.h"

namespace farcell {

// mesh: name of the file that `write` writes, which tells its format.
inline DrawnPack buildDrawn(const std::string& mesh, const std::function<Result<>(const std::filesystem::path&)>& write,
                            uint64_t residentBytes = kPlentyBytes) {
  const auto directory =
      std::filesystem::temp_directory_path() / fmt::format("farcell_built_{}", static_cast<int>(getpid()));
  std::filesystem::create_directories(directory);
  const std::filesystem::path input = directory / mesh, path = directory / "built.far";
  const auto written = write(input);
  if (!written) throw std::runtime_error(written.error().message);
  BuildOptions options;
  options.settings.leafTriangles = 500;
  options.settings.form.views = 12;
  options.settings.form.imageSize = 16;
  options.settings.samples = 1;
  Progress silent(false);
  const auto built = buildPack({&input, 1}, path, options, silent);
  if (!built) throw std::runtime_error(built.error().message);
  DrawnPack drawn;
  auto pack = PackFile::open(path);
  std::filesystem::remove_all(directory);
  if (!pack) throw std::runtime_error(pack.error().message);
  drawn.pack = std::make_unique<PackFile>(std::move(*pack));
  auto renderer = Renderer::create(sharedContext(), *drawn.pack, residentBytes);
  if (!renderer) throw std::runtime_error(renderer.error().message);
  drawn.renderer = std::make_unique<Renderer>(std::move(*renderer));
  return drawn;
}

}  // namespace farcell
