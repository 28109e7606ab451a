#include <sys/stat.h>

#include <random>

#include "preprocess/texture/image_rows.h"
#include "tests/preprocess/texture/texture_scenes.h"
#include "tests/support/sanitized.h"

namespace farcell::test {
namespace {

using HostileImages = TextureTest;

int anything(int x, int y, int channel) { return (x * 37 + y * 11 + channel * 5) % 256; }
std::string goodPng() { return encodeImage("png", {16, 12, 3, 8}, anything); }
std::string goodJpeg() { return encodeImage("jpeg", {16, 12, 3, 8}, anything); }

std::vector<std::byte> bytesOf(const std::string& text) {
  const auto* begin = reinterpret_cast<const std::byte*>(text.data());
  return {begin, begin + text.size()};
}

std::string patched(std::string bytes, size_t at, const std::string& with) {
  return bytes.replace(at, with.size(), with);
}
std::string patchedFrame(const std::string& size, char marker = '\xc0') {
  std::string bytes = goodJpeg();
  const size_t frame = bytes.find(std::string("\xff\xc0", 2));
  bytes[frame + 1] = marker;
  return patched(bytes, frame + 5, size);
}

// Everything a decoder gets to see, without the caches and files around it.
Result<> decoded(const std::string& text) {
  FARCELL_ASSIGN(const ImageData image, imageData(bytesOf(text), "test"));
  int rows = 0;
  FARCELL_TRY(decodeRows(image, "test", [&](std::span<const uint32_t> row) -> Result<> {
    EXPECT_EQ(row.size(), static_cast<size_t>(image.width));
    EXPECT_LT(rows++, image.height);
    return {};
  }));
  EXPECT_EQ(rows, image.height);
  return {};
}

TEST_F(HostileImages, TheGoodOnesAreGood) {
  for (const std::string& bytes :
       {goodPng(), goodJpeg(), palettePng(), interlacedPng(), cmykJpeg(), progressiveJpeg()}) {
    const Result<> result = decoded(bytes);
    EXPECT_TRUE(result) << result.error().message;
  }
}

TEST_F(HostileImages, EachIsLeftOutWithItsNameAndTheOthersStay) {
  const std::string huge("\x7f\xff\xff\xff", 4), zero(4, '\0'), png = goodPng(), jpeg = goodJpeg();
  const std::vector<std::string> bad = {
      "",
      "x",
      "GIF89a and more",
      png.substr(0, 8),
      jpeg.substr(0, 3),
      jpeg.substr(0, 2) + std::string(100, '\xff'),
      png.substr(0, png.size() / 2),
      jpeg.substr(0, jpeg.size() / 2),
      png.substr(0, png.size() - 1),
      jpeg.substr(0, jpeg.size() - 1),
      patched(png, 16, zero),                                    // width 0
      patched(png, 20, zero),                                    // height 0
      patched(png, 16, huge),                                    // wider than anything
      patched(png, 16, std::string("\0\0\x80\0\0\0\x80\0", 8)),  // 32768 x 32768
      patched(png, 24, std::string("\x63", 1)),                  // 99 bits a channel
      patched(png, 29, std::string("\0\0\0\0", 4)),              // checksum
      patched(png, 8, huge),                                     // a chunk longer than the file
      patched(png, 12, "IDAT"),                                  // no header
      patched(png, png.find("IDAT") + 4, "garbage"),
      patched(interlacedPng(), 16, std::string("\0\0\x40\0\0\0\x40\0", 8)),  // 16384 x 16384 at once
      patchedFrame(std::string("\xff\xff\xff\xff", 4)),
      patchedFrame(std::string("\x40\0\x40\0", 4), '\xc2'),  // 16384 x 16384, progressive
      patchedFrame(zero),
      patchedFrame(std::string("\0\x0c\0\x10", 4), '\xc3'),  // lossless
      patchedFrame(std::string("\0\x0c\0\x10", 4), '\xc4'),  // no frame
      patched(jpeg, 4, std::string("\0\1", 2)),              // a segment of one byte
      patched(jpeg, 4, std::string("\xff\xff", 2)),          // a segment longer than the file
  };
  std::vector<TextureSource> sources;
  for (size_t i = 0; i < bad.size(); ++i) sources.push_back(source(fmt::format("bad{}.png", i), bad[i]));
  sources.push_back(source("good.png", png));
  const Textures textures = open(sources, 2);
  ASSERT_EQ(textures.leftOut().size(), bad.size());
  for (size_t i = 0; i < bad.size(); ++i) {
    const std::string& message = textures.leftOut()[i].message;
    EXPECT_NE(message.find(fmt::format("bad{}.png", i)), std::string::npos) << message;
    EXPECT_EQ(textures.sampler()->sample({static_cast<uint32_t>(i), {.5f, .5f}}), glm::vec4(1)) << "white";
  }
  EXPECT_NE(textures.sampler()->sample({static_cast<uint32_t>(bad.size()), {.5f, .5f}}), glm::vec4(1));
}

TEST_F(HostileImages, WhatIsNoFileIsLeftOut) {
  const std::filesystem::path pipe = directory_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::vector<TextureSource> sources(3);
  sources[0].file = pipe;
  sources[1].file = directory_;
  sources[2].file = directory_ / "missing.png";
  sources.push_back(source("a.png", goodPng()));
  sources.back().offsetBytes = 1 << 20;
  sources.push_back(source("a.png", goodPng()));
  sources.back().sizeBytes = ~uint64_t{0} - 3;
  sources.back().offsetBytes = 5;
  EXPECT_EQ(open(sources).leftOut().size(), sources.size());
}

TEST_F(HostileImages, EveryTruncationIsNoticed) {
  for (const std::string& bytes : {goodPng(), goodJpeg(), palettePng(), progressiveJpeg(), cmykJpeg()})
    for (size_t size = 0; size < bytes.size(); ++size) EXPECT_FALSE(decoded(bytes.substr(0, size))) << size;
}

TEST_F(HostileImages, DamagedBytesNeverDoHarm) {
  const unsigned seed = std::random_device()();
  SCOPED_TRACE(fmt::format("seed {}", seed));
  std::mt19937 random(seed);
  for (const std::string& good :
       {goodPng(), goodJpeg(), palettePng(), interlacedPng(), cmykJpeg(), progressiveJpeg()}) {
    for (int i = 0; i < (kSanitized ? 60 : 300); ++i) {
      std::string bytes = good;
      for (unsigned changes = 1 + random() % 4; changes > 0; --changes)
        bytes[random() % bytes.size()] = static_cast<char>(random());
      (void)decoded(bytes);
    }
  }
}

}  // namespace
}  // namespace farcell::test
