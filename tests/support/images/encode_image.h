// Image files for tests, by the library that is tested to read them; what it cannot write is kept as bytes.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace farcell::test {

struct ImageShape {
  int width = 1;
  int height = 1;
  int channels = 3;  // 1 grey, 2 grey and alpha, 3 RGB, 4 RGB and alpha (not premultiplied)
  int bits = 8;      // a channel: 8 or 16
};

// The file's bytes. `value` in 0..255 of a channel; y from the top. format: "png" or "jpeg".
std::string encodeImage(const char* format, const ImageShape& shape,
                        const std::function<int(int x, int y, int channel)>& value);

// 4 x 2 pixels with a palette: red, green, blue, white; black, (10, 20, 30), (200, 100, 50), grey 128.
std::string palettePng();
// 3 x 1 pixels with a palette: red, green of alpha 51, blue.
std::string palettePngWithAlpha();
// All pixels (200, 100, 50): 40 x 24 interlaced, 16 x 16 in CMYK, 16 x 16 progressive.
std::string interlacedPng();
std::string cmykJpeg();
std::string progressiveJpeg();

}  // namespace farcell::test
