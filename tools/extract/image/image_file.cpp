#include "tools/extract/image/image_file.h"

#include <OpenImageIO/imageio.h>

#include <exception>
#include <system_error>

namespace farcell {
namespace {

Result<> write(const std::filesystem::path& path, const Picture& picture) {
  const std::string format = path.extension().string().substr(1);
  auto output = OIIO::ImageOutput::create(format);
  if (!output) return fail(ErrorKind::unsupported, "{}: no writer of {}: {}", path.string(), format, OIIO::geterror());
  OIIO::ImageSpec spec(picture.width, picture.height, picture.channels, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:UnassociatedAlpha", 1);  // pictures are not premultiplied
  spec.attribute("oiio:ColorSpace", "sRGB");
  if (!output->open(path.string(), spec) || !output->write_image(OIIO::TypeDesc::UINT8, picture.pixels.data()) ||
      !output->close())
    return fail(ErrorKind::io, "{}: {}", path.string(), output->geterror());
  return {};
}

}  // namespace

Result<> writeImageFile(const std::filesystem::path& path, const Picture& picture) {
  Result<> written;
  try {
    written = write(path, picture);
  } catch (const std::exception& error) {
    written = fail(ErrorKind::io, "{}: {}", path.string(), error.what());
  }
  std::error_code ignored;
  if (!written) std::filesystem::remove(path, ignored);
  return written;
}

}  // namespace farcell
