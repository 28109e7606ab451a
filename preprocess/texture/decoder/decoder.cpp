// The module that knows OpenImageIO (image_rows.h).
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <exception>

#include "preprocess/texture/image_rows.h"

namespace farcell {
namespace {

constexpr int kStripRows = 64;
constexpr int kMaxChannels = 4;

// Grey is one or two channels, colour three or four; the even ones have alpha last.
void packRow(const uint8_t* from, int channels, std::span<uint32_t> to) {
  const bool grey = channels < 3, transparent = channels % 2 == 0;
  for (uint32_t& pixel : to) {
    pixel = from[0] | uint32_t{from[grey ? 0 : 1]} << 8 | uint32_t{from[grey ? 0 : 2]} << 16 |
            uint32_t{transparent ? from[channels - 1] : uint8_t{255}} << 24;
    from += channels;
  }
}

Result<> readRows(OIIO::ImageInput& input, const OIIO::ImageSpec& spec, const std::string& name, const RowSink& sink) {
  const size_t rowBytes = static_cast<size_t>(spec.width) * static_cast<size_t>(spec.nchannels);
  std::vector<uint8_t> strip(rowBytes * kStripRows);
  std::vector<uint32_t> row(static_cast<size_t>(spec.width));
  for (int y = 0; y < spec.height; y += kStripRows) {
    const int end = std::min(y + kStripRows, spec.height);
    if (!input.read_scanlines(0, 0, y, end, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, strip.data()))
      return fail(ErrorKind::corrupt, "{}: row {}: {}", name, y, input.geterror());
    for (int i = 0; i < end - y; ++i) {
      packRow(strip.data() + static_cast<size_t>(i) * rowBytes, spec.nchannels, row);
      FARCELL_TRY(sink(row));
    }
  }
  return {};
}

Result<> decode(const ImageData& image, const std::string& name, const RowSink& sink) {
  // By name: no other parser gets to see the bytes.
  auto input = OIIO::ImageInput::create(image.format == ImageFormat::png ? "png" : "jpeg");
  if (!input) return fail(ErrorKind::unsupported, "{}: no reader: {}", name, OIIO::geterror());
  OIIO::Filesystem::IOMemReader bytes(image.bytes.data(), image.bytes.size());
  if (!input->set_ioproxy(&bytes))
    return fail(ErrorKind::unsupported, "{}: the reader does not read from memory", name);
  OIIO::ImageSpec config, spec;
  config.attribute("oiio:UnassociatedAlpha", 1);  // else colours come multiplied with it
  if (!input->open("", spec, config)) return fail(ErrorKind::corrupt, "{}: {}", name, input->geterror());
  if (spec.width != image.width || spec.height != image.height || spec.depth != 1)
    return fail(ErrorKind::corrupt, "{}: expected {} x {} pixels, found {} x {}", name, image.width, image.height,
                spec.width, spec.height);
  if (spec.nchannels < 1 || spec.nchannels > kMaxChannels)
    return fail(ErrorKind::unsupported, "{}: expected 1 to 4 channels, found {}", name, spec.nchannels);
  return readRows(*input, spec, name, sink);
}

}  // namespace
}  // namespace farcell

extern "C" void farcellDecodeRows(const farcell::ImageData& image, const std::string& name,
                                  const farcell::RowSink& sink, farcell::Result<>& result) {
  try {
    result = farcell::decode(image, name, sink);
  } catch (const std::exception& error) {
    result = farcell::fail(farcell::ErrorKind::corrupt, "{}: {}", name, error.what());
  }
}
