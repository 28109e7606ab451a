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
  const std::array<uint32_t, 256> alphas = alphaTable(source);
  const auto meant = [&](uint32_t pixel) { return (pixel & 0xffffff) | alphas[pixel >> 24] << 24; };
  if (!source.surface.hasImage) return begin(1, 1)(std::array{meant(0xffffffff)});
  FARCELL_ASSIGN(const ImageData data, readImageData(source));
  const RowSink sink = begin(data.width, data.height);
  std::vector<uint32_t> changed(static_cast<size_t>(data.width));
  return decodeRows(data, source.file.string(), [&](std::span<const uint32_t> row) {
    std::transform(row.begin(), row.end(), changed.begin(), meant);
    return sink(changed);
  });
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
