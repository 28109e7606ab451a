#include <algorithm>
#include <cmath>

#include "preprocess/build/build.h"
#include "preprocess/choose/forms_by_height.h"

namespace farcell {

Result<> checkSettings(const BuildSettings& settings) {
  FARCELL_TRY(Viewpoints::create(settings.form.views));
  const auto range = [](const char* name, int value, int min, int max) -> Result<> {
    if (value >= min && value <= max) return {};
    return fail(ErrorKind::invalidArgument, "{}: expected {} to {}, found {}", name, min, max, value);
  };
  FARCELL_TRY(range("image-size", settings.form.imageSize, 16, 1024));
  if ((settings.form.imageSize & (settings.form.imageSize - 1)) != 0)
    return fail(ErrorKind::invalidArgument, "image-size: expected a power of two, found {}", settings.form.imageSize);
  if (settings.samples != 1 && settings.samples != 4 && settings.samples != 16 && settings.samples != 64)
    return fail(ErrorKind::invalidArgument, "samples: expected 1, 4, 16 or 64, found {}", settings.samples);
  FARCELL_TRY(range("leaf-triangles", settings.leafTriangles, 64, 1 << 24));
  FARCELL_TRY(range("max-level", settings.maxLevel, 0, kMaxLevel));
  FARCELL_TRY(range("fixed-level", settings.fixedLevel, -1, settings.maxLevel));
  const auto of = [&](const auto& some, int value) { return std::find(some.begin(), some.end(), value) != some.end(); };
  if (settings.forms == Forms::chosen &&
      !(of(kCandidateViews, settings.form.views) && of(kCandidateSizes, settings.form.imageSize)))
    return fail(ErrorKind::invalidArgument,
                "forms: chosen against {} views of {} texels: expected 12, 42, 162 or 642 of 64, 128 or 256",
                settings.form.views, settings.form.imageSize);
  if (settings.forms == Forms::byHeight && !isBaseOfHeights(settings.form))
    return fail(ErrorKind::invalidArgument,
                "forms: by height from {} views of {} texels: expected 42 or 162 of 16 to 512", settings.form.views,
                settings.form.imageSize);
  FARCELL_TRY(range("view-error", settings.viewError, 0, kMaxViewError));
  if (!(settings.metresPerUnit > 0 && std::isfinite(settings.metresPerUnit)))
    return fail(ErrorKind::invalidArgument, "unit: expected a positive length, found {} m", settings.metresPerUnit);
  return {};
}

}  // namespace farcell
