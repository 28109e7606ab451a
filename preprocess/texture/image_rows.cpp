#include "preprocess/texture/image_rows.h"

#include <dlfcn.h>

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

}  // namespace

Result<> decodeRows(const ImageData& image, const std::string& name, const RowSink& sink) {
  static const Module kModule = loadModule();
  if (kModule.decode == nullptr)
    return fail(ErrorKind::unsupported, "{}: images cannot be read: {}", name, kModule.failure);
  Result<> result;
  kModule.decode(image, name, sink, result);
  return result;
}

Result<TextureImage> readTextureImage(const TextureSource& source) {
  FARCELL_ASSIGN(const ImageData data, readImageData(source));
  TextureImage image{data.width, data.height, {}};
  image.pixels.reserve(static_cast<size_t>(data.width) * static_cast<size_t>(data.height));
  FARCELL_TRY(decodeRows(data, source.file.string(), [&](std::span<const uint32_t> row) -> Result<> {
    image.pixels.insert(image.pixels.end(), row.begin(), row.end());
    return {};
  }));
  return image;
}

}  // namespace farcell
