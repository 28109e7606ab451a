#include "tools/evaluate/report/pictures.h"

#include <algorithm>
#include <cmath>

#include "tools/image/png.h"

namespace farcell {
namespace {

Result<> writeRgb(const std::filesystem::path& path, int width, int height, const std::vector<float>& values) {
  Picture picture{width, height, 3, {}};
  picture.pixels.reserve(values.size());
  for (const float value : values)
    picture.pixels.push_back(static_cast<uint8_t>(std::lround(std::clamp(value, 0.0f, 255.0f))));
  return writePng(path, picture);
}

}  // namespace

Result<> writeReferencePicture(const std::filesystem::path& directory, const std::string& stem,
                               const ReferenceImage& reference, const Colour& background) {
  return writeRgb(directory / (stem + ".reference.png"), reference.width, reference.height,
                  composite(reference, background));
}

Result<> writeRendererPictures(const std::filesystem::path& directory, const std::string& stem,
                               const std::string& renderer, const ReferenceImage& reference, const TestImage& test,
                               const Colour& background) {
  const std::vector<float> truth = composite(reference, background);
  std::vector<float> own = composite(test, background);
  FARCELL_TRY(writeRgb(directory / (stem + "." + renderer + ".png"), test.width, test.height, own));
  for (size_t i = 0; i < own.size(); ++i) own[i] = kDifferenceGain * std::abs(own[i] - truth[i]);
  return writeRgb(directory / (stem + "." + renderer + ".difference.png"), test.width, test.height, own);
}

}  // namespace farcell
