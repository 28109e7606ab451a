#include "preprocess/texture/image_rows.h"

#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <filesystem>

namespace farcell {
namespace {

constexpr const char* kModuleName = "farcell-image-decoder.so";

struct Module {
  DecodeFunction* decode = nullptr;
  std::string failure;
};

// Stays loaded until the process ends.
Module loadModule() {
  std::error_code code;
  const std::filesystem::path programs = std::filesystem::read_symlink("/proc/self/exe", code).parent_path();
  const std::filesystem::path beside = programs / kModuleName, installed = programs / FARCELL_MODULES / kModuleName;
  const auto& path = std::filesystem::exists(beside, code) ? beside : installed;
  void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  Module module;
  if (library != nullptr) module.decode = reinterpret_cast<DecodeFunction*>(dlsym(library, kDecodeSymbol));
  if (module.decode == nullptr) module.failure = dlerror();
  return module;
}

// Alpha, 0 to 255, by what it becomes.
std::array<uint32_t, 256> alphaTable(const TextureSource& source) {
  const SurfaceKind& surface = source.surface;
  const bool holes = surface.alpha == AlphaMode::blend || (surface.alpha == AlphaMode::mask && surface.cutoff > 0);
  std::array<uint32_t, 256> table;
  for (size_t alpha = 0; alpha < table.size(); ++alpha)
    table[alpha] = holes ? static_cast<uint32_t>(static_cast<float>(alpha) * source.opacity + 0.5f) : 255;
  return table;
}

// What an image says of opacity: its alpha where it has one, else its brightness.
struct OpacityImage {
  int width = 0, height = 0;
  bool hasAlpha = false;
  std::vector<uint8_t> alpha, brightness;

  uint32_t at(int x, int y, int ofWidth, int ofHeight) const {
    const auto column = static_cast<size_t>(int64_t{x} * width / ofWidth);
    const auto row = static_cast<size_t>(int64_t{y} * height / ofHeight);
    return (hasAlpha ? alpha : brightness)[row * static_cast<size_t>(width) + column];
  }
};

uint8_t brightnessOf(uint32_t pixel) {
  constexpr uint32_t kRed = 54, kGreen = 183, kBlue = 19;  // of 256, ITU-R BT.709
  return static_cast<uint8_t>(
      (kRed * (pixel & 255) + kGreen * (pixel >> 8 & 255) + kBlue * (pixel >> 16 & 255) + 128) >> 8);
}

Result<OpacityImage> readOpacity(const std::filesystem::path& file) {
  TextureSource source;
  source.file = file;
  FARCELL_ASSIGN(const ImageData data, readImageData(source));
  const uint64_t pixels = uint64_t(data.width) * uint64_t(data.height);
  if (pixels > kMaxWholeImagePixels)
    return fail(ErrorKind::exhausted, "{}: an image of opacity of {} pixels, at most {} are allowed", file.string(),
                pixels, kMaxWholeImagePixels);
  OpacityImage image{data.width, data.height, false, {}, {}};
  image.alpha.reserve(pixels);
  image.brightness.reserve(pixels);
  FARCELL_TRY(decodeRows(data, file.string(), [&](std::span<const uint32_t> row) -> Result<> {
    for (const uint32_t pixel : row) {
      image.alpha.push_back(static_cast<uint8_t>(pixel >> 24));
      image.brightness.push_back(brightnessOf(pixel));
      image.hasAlpha |= image.alpha.back() != 255;
    }
    return {};
  }));
  return image;
}

// Rows of a source in the making, as they are meant.
class MeantRows {
 public:
  MeantRows(const TextureSource& source, const OpacityImage& opacity, int width, int height, const RowSink& sink)
      : alphas_(alphaTable(source)), opacity_(opacity), width_(width), height_(height), sink_(sink) {}

  Result<> add(std::span<const uint32_t> row) {
    meant_.assign(row.begin(), row.end());
    for (int x = 0; x < width_; ++x) {
      uint32_t& pixel = meant_[static_cast<size_t>(x)];
      const uint32_t alpha = opacity_.width > 0 ? opacity_.at(x, y_, width_, height_) : pixel >> 24;
      pixel = (pixel & 0xffffff) | alphas_[alpha] << 24;
    }
    ++y_;
    return sink_(meant_);
  }

 private:
  const std::array<uint32_t, 256> alphas_;
  const OpacityImage& opacity_;
  const int width_, height_;
  const RowSink& sink_;
  int y_ = 0;
  std::vector<uint32_t> meant_;
};

}  // namespace

Result<> decodeRows(const ImageData& image, const std::string& name, const RowSink& sink) {
  static const Module kModule = loadModule();
  if (kModule.decode == nullptr)
    return fail(ErrorKind::unsupported, "{}: images cannot be read: {}", name, kModule.failure);
  Result<> result;
  kModule.decode(image, name, sink, result);
  return result;
}

Result<> readTextureRows(const TextureSource& source, const RowSinkOf& begin) {
  OpacityImage opacity;
  if (!source.opacityFile.empty()) {
    FARCELL_ASSIGN(opacity, readOpacity(source.opacityFile));
  }
  if (!source.surface.hasImage || (source.file.empty() && !source.embedded)) {
    const int width = std::max(1, opacity.width), height = std::max(1, opacity.height);
    const RowSink sink = begin(width, height);
    const std::vector<uint32_t> white(static_cast<size_t>(width), 0xffffffffu);
    MeantRows rows(source, opacity, width, height, sink);
    for (int y = 0; y < height; ++y) FARCELL_TRY(rows.add(white));
    return {};
  }
  FARCELL_ASSIGN(const ImageData data, readImageData(source));
  const RowSink sink = begin(data.width, data.height);
  MeantRows rows(source, opacity, data.width, data.height, sink);
  return decodeRows(data, source.file.string(), [&](std::span<const uint32_t> row) { return rows.add(row); });
}

Result<TextureImage> readTextureImage(const TextureSource& source) {
  TextureImage image;
  FARCELL_TRY(readTextureRows(source, [&](int width, int height) -> RowSink {
    image.width = width;
    image.height = height;
    image.pixels.reserve(static_cast<size_t>(width) * static_cast<size_t>(height));
    return [&](std::span<const uint32_t> row) -> Result<> {
      image.pixels.insert(image.pixels.end(), row.begin(), row.end());
      return {};
    };
  }));
  return image;
}

}  // namespace farcell
