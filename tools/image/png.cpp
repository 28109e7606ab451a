#include "tools/image/png.h"

#include <png.h>

#include <system_error>

#include "cache/base/check.h"
#include "cache/base/file.h"

namespace farcell {
namespace {

constexpr uint32_t kMaxEdge = 1 << 20;

// libpng's simplified interface: its errors are values, nothing jumps.
struct PngImage {
  png_image image{};
  PngImage() { image.version = PNG_IMAGE_VERSION; }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;
  ~PngImage() { png_image_free(&image); }
};

uint32_t formatOf(int channels) {
  return channels == 1 ? PNG_FORMAT_GRAY : channels == 3 ? PNG_FORMAT_RGB : PNG_FORMAT_RGBA;
}

int channelsFor(uint32_t format) {
  if ((format & PNG_FORMAT_FLAG_ALPHA) != 0) return 4;
  return (format & PNG_FORMAT_FLAG_COLOR) != 0 ? 3 : 1;
}

}  // namespace

Result<> writePng(const std::filesystem::path& path, const Picture& picture) {
  FARCELL_CHECK(picture.width > 0 && picture.height > 0);
  FARCELL_CHECK(picture.channels == 1 || picture.channels == 3 || picture.channels == 4);
  FARCELL_CHECK_EQ(picture.pixels.size(), static_cast<size_t>(picture.width) * static_cast<size_t>(picture.height) *
                                              static_cast<size_t>(picture.channels));
  FARCELL_ASSIGN(OutputFile file, OutputFile::create(path));
  PngImage png;
  png.image.width = static_cast<uint32_t>(picture.width);
  png.image.height = static_cast<uint32_t>(picture.height);
  png.image.format = formatOf(picture.channels);
  std::vector<std::byte> bytes(PNG_IMAGE_PNG_SIZE_MAX(png.image));
  png_alloc_size_t size = bytes.size();
  if (!png_image_write_to_memory(&png.image, bytes.data(), &size, 0, picture.pixels.data(), 0, nullptr))
    return fail(ErrorKind::io, "{}: {}", path.string(), png.image.message);
  FARCELL_TRY(file.append(std::span(bytes).first(size)));
  return file.commit();
}

Result<Picture> readPng(const std::filesystem::path& path, uint64_t maxPixels) {
  std::error_code code;
  const auto status = std::filesystem::status(path, code);
  if (status.type() == std::filesystem::file_type::not_found)
    return fail(ErrorKind::notFound, "{}: no such file", path.string());
  if (status.type() != std::filesystem::file_type::regular)
    return fail(ErrorKind::io, "{}: not a regular file", path.string());
  PngImage png;
  if (!png_image_begin_read_from_file(&png.image, path.c_str()))
    return fail(ErrorKind::corrupt, "{}: not a PNG file: {}", path.string(), png.image.message);
  const uint32_t width = png.image.width, height = png.image.height;
  if (width > kMaxEdge || height > kMaxEdge || uint64_t{width} * height > maxPixels)
    return fail(ErrorKind::exhausted, "{}: {} x {} pixels, at most {} are allowed", path.string(), width, height,
                maxPixels);
  Picture picture{static_cast<int>(width), static_cast<int>(height), channelsFor(png.image.format), {}};
  png.image.format = formatOf(picture.channels);
  picture.pixels.resize(PNG_IMAGE_SIZE(png.image));
  if (!png_image_finish_read(&png.image, nullptr, picture.pixels.data(), 0, nullptr))
    return fail(ErrorKind::corrupt, "{}: {}", path.string(), png.image.message);
  return picture;
}

}  // namespace farcell
