#include "tools/image/png.h"

#include <OpenImageIO/imageio.h>

#include <exception>
#include <system_error>

#include "cache/base/check.h"

namespace farcell {
namespace {

constexpr int kMaxEdge = 1 << 20;

Result<> writeWithOiio(const std::filesystem::path& path, const Picture& picture) {
  auto output = OIIO::ImageOutput::create("png");
  if (!output) return fail(ErrorKind::unsupported, "{}: no PNG writer: {}", path.string(), OIIO::geterror());
  OIIO::ImageSpec spec(picture.width, picture.height, picture.channels, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:UnassociatedAlpha", 1);
  spec.attribute("oiio:ColorSpace", "sRGB");
  if (!output->open(path.string(), spec) || !output->write_image(OIIO::TypeDesc::UINT8, picture.pixels.data()) ||
      !output->close())
    return fail(ErrorKind::io, "{}: {}", path.string(), output->geterror());
  return {};
}

Result<Picture> readWithOiio(const std::filesystem::path& path, uint64_t maxPixels) {
  // The PNG plug-in only: the content decides what a file is, and no other parser sees it.
  auto input = OIIO::ImageInput::create("png");
  if (!input) return fail(ErrorKind::unsupported, "{}: no PNG reader: {}", path.string(), OIIO::geterror());
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  OIIO::ImageSpec spec;
  if (!input->open(path.string(), spec, config))
    return fail(ErrorKind::corrupt, "{}: not a PNG file: {}", path.string(), input->geterror());
  if (spec.width < 1 || spec.height < 1 || spec.width > kMaxEdge || spec.height > kMaxEdge || spec.depth != 1)
    return fail(ErrorKind::corrupt, "{}: size {} x {} is none", path.string(), spec.width, spec.height);
  const uint64_t pixels = static_cast<uint64_t>(spec.width) * static_cast<uint64_t>(spec.height);
  if (pixels > maxPixels)
    return fail(ErrorKind::exhausted, "{}: {} x {} pixels, at most {} are allowed", path.string(), spec.width,
                spec.height, maxPixels);
  if (spec.nchannels != 1 && spec.nchannels != 3 && spec.nchannels != 4)
    return fail(ErrorKind::unsupported, "{}: expected 1, 3 or 4 channels, found {}", path.string(), spec.nchannels);
  Picture picture{spec.width, spec.height, spec.nchannels, {}};
  picture.pixels.resize(pixels * static_cast<uint64_t>(spec.nchannels));
  if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, picture.pixels.data()))
    return fail(ErrorKind::corrupt, "{}: {}", path.string(), input->geterror());
  return picture;
}

}  // namespace

Result<> writePng(const std::filesystem::path& path, const Picture& picture) {
  FARCELL_CHECK(picture.width > 0 && picture.height > 0);
  FARCELL_CHECK(picture.channels == 1 || picture.channels == 3 || picture.channels == 4);
  FARCELL_CHECK_EQ(picture.pixels.size(), static_cast<size_t>(picture.width) * static_cast<size_t>(picture.height) *
                                              static_cast<size_t>(picture.channels));
  try {
    return writeWithOiio(path, picture);
  } catch (const std::exception& error) {
    return fail(ErrorKind::io, "{}: {}", path.string(), error.what());
  }
}

Result<Picture> readPng(const std::filesystem::path& path, uint64_t maxPixels) {
  std::error_code code;
  const auto status = std::filesystem::status(path, code);
  if (status.type() == std::filesystem::file_type::not_found)
    return fail(ErrorKind::notFound, "{}: no such file", path.string());
  if (status.type() != std::filesystem::file_type::regular)
    return fail(ErrorKind::io, "{}: not a regular file", path.string());
  try {
    return readWithOiio(path, maxPixels);
  } catch (const std::exception& error) {
    return fail(ErrorKind::corrupt, "{}: {}", path.string(), error.what());
  }
}

}  // namespace farcell
