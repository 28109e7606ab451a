#include "tools/evaluate/report/pictures.h"

#include <algorithm>
#include <cmath>

#include "tools/evaluate/report/magma.h"
#include "tools/image/png.h"

namespace farcell {
namespace {

Result<> writeRgb(const std::filesystem::path& path, int width, int height, std::span<const float> values) {
  Picture picture{width, height, 3, {}};
  picture.pixels.reserve(values.size());
  for (const float value : values)
    picture.pixels.push_back(static_cast<uint8_t>(std::lround(std::clamp(value, 0.0f, 255.0f))));
  return writePng(path, picture);
}

Result<> writeMap(const std::filesystem::path& path, int width, int height, std::span<const float> values) {
  Picture picture{width, height, 3, {}};
  picture.pixels.reserve(3 * values.size());
  for (const float value : values) {
    const std::array<uint8_t, 3> colour = magma(value);
    picture.pixels.insert(picture.pixels.end(), colour.begin(), colour.end());
  }
  return writePng(path, picture);
}

}  // namespace

Result<> writeReferencePicture(const std::filesystem::path& directory, const std::string& stem,
                               const ReferenceImage& reference, const Colour& background) {
  return writeRgb(directory / (stem + ".reference.png"), reference.width, reference.height,
                  composite(reference, background));
}

Result<> writeRendererPictures(const std::filesystem::path& directory, const RendererPicture& picture,
                               const ReferenceImage& reference, const Colour& background) {
  const int width = picture.image.width, height = picture.image.height;
  const std::string name = picture.stem + "." + picture.renderer;
  const std::vector<float> truth = composite(reference, background);
  std::vector<float> own = composite(picture.image, background);
  FARCELL_TRY(writeRgb(directory / (name + ".png"), width, height, own));
  for (size_t i = 0; i < own.size(); ++i) own[i] = kDifferenceGain * std::abs(own[i] - truth[i]);
  FARCELL_TRY(writeRgb(directory / (name + ".difference.png"), width, height, own));
  return writeMap(directory / (name + ".flip.png"), width, height, picture.flip);
}

Result<> writeWorstFrame(const std::filesystem::path& directory, const WorstFrame& frame) {
  const auto write = [&](const char* end, std::span<const float> values) {
    return writeRgb(directory / (frame.name + end), frame.width, frame.height, values);
  };
  FARCELL_TRY(write(".worst-before.png", frame.before));
  FARCELL_TRY(write(".worst.png", frame.now));
  FARCELL_TRY(write(".worst-reference.png", frame.reference));
  std::vector<float> bright(frame.flicker.begin(), frame.flicker.end());
  for (float& value : bright) value *= kDifferenceGain;
  return write(".worst-flicker.png", bright);
}

}  // namespace farcell
