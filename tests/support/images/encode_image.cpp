#include "tests/support/images/encode_image.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cstdlib>
#include <stdexcept>
#include <vector>

namespace farcell::test {
namespace {

std::string fromHex(const std::string& digits) {
  std::string bytes;
  for (size_t i = 0; i + 1 < digits.size(); i += 2)
    bytes.push_back(static_cast<char>(std::strtol(digits.substr(i, 2).c_str(), nullptr, 16)));
  return bytes;
}

}  // namespace

std::string encodeImage(const char* format, const ImageShape& shape,
                        const std::function<int(int x, int y, int channel)>& value) {
  std::vector<uint16_t> pixels;
  for (int y = 0; y < shape.height; ++y)
    for (int x = 0; x < shape.width; ++x)
      for (int channel = 0; channel < shape.channels; ++channel)
        pixels.push_back(static_cast<uint16_t>(257 * value(x, y, channel)));
  OIIO::Filesystem::IOVecOutput file;
  auto output = OIIO::ImageOutput::create(format);
  OIIO::ImageSpec spec(shape.width, shape.height, shape.channels,
                       shape.bits == 16 ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:UnassociatedAlpha", 1);
  spec.attribute("Compression", "jpeg:100");
  spec.attribute("jpeg:subsampling", "4:4:4");
  spec.attribute("ImageDescription", "text that nobody asked for");
  if (!output || !output->set_ioproxy(&file) || !output->open("memory", spec) ||
      !output->write_image(OIIO::TypeDesc::UINT16, pixels.data()) || !output->close())
    throw std::runtime_error("cannot write the test's image");
  return std::string(file.buffer().begin(), file.buffer().end());
}

std::string palettePng() {
  return fromHex(
      "89504e470d0a1a0a0000000d494844520000000400000002080300000048768d5100000018504c5445ff000000ff000000ffffffff0000"
      "000a141ec86432808080320969ad000000124944415408d76360606462666061656307000064001defae862d0000000049454e44ae4260"
      "82");
}

std::string palettePngWithAlpha() {
  return fromHex(
      "89504e470d0a1a0a0000000d49484452000000030000000108030000002c3ee48600000009504c5445ff000000ff000000ff2d4acd8a00"
      "00000274524e53ff335a67515c0000000c49444154789c6360606402000008000436e0b0a60000000049454e44ae426082");
}

std::string interlacedPng() {
  return fromHex(
      "89504e470d0a1a0a0000000d494844520000002800000018080200000170e11801000000434944415448c7633c9162c48004981850013a"
      "9f9142f5049493264d53c3692a4dc0e514993daa191d8c86f6a8e6e1aa99a2b43d60ae1eb578d4e2518b472d1e59160300288809e63c70"
      "4a680000000049454e44ae426082");
}

std::string cmykJpeg() {
  return fromHex(
      "ffd8ffee000e41646f626500640000000002ffdb0043000201010101010201010102020202020403020202020504040304060506060605"
      "060606070908060709070606080b08090a0a0a0a0a06080b0c0b0a0c090a0a0affdb004301020202020202050303050a0706070a0a0a0a"
      "0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0affc000140800100010"
      "04011100021101031101041100ffc400160001010100000000000000000000000000000709ffc400141001000000000000000000000000"
      "00000000ffc400160101010100000000000000000000000000000809ffc40014110100000000000000000000000000000000ffda000e04"
      "0100021103110400003f0081ad4675b480000001ffd9");
}

std::string progressiveJpeg() {
  return fromHex(
      "ffd8ffe000104a46494600010100000100010000ffdb004300020101010101020101010202020202040302020202050404030406050606"
      "0605060606070908060709070606080b08090a0a0a0a0a06080b0c0b0a0c090a0a0affdb004301020202020202050303050a0706070a0a"
      "0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0affc20011080010"
      "001003011100021101031101ffc4001500010100000000000000000000000000000004ffc4001501010100000000000000000000000000"
      "000007ffda000c030100021003100000019e576c007fffc40014100100000000000000000000000000000020ffda00080101000105021f"
      "ffc40014110100000000000000000000000000000020ffda0008010301013f011fffc40014110100000000000000000000000000000020"
      "ffda0008010201013f011fffc40014100100000000000000000000000000000020ffda0008010100063f021fffc4001410010000000000"
      "0000000000000000000020ffda0008010100013f211fffda000c03010002000300000010000fffc4001411010000000000000000000000"
      "0000000020ffda0008010301013f101fffc40014110100000000000000000000000000000020ffda0008010201013f101fffc400141001"
      "00000000000000000000000000000020ffda0008010100013f101fffd9");
}

}  // namespace farcell::test
