// An image as rows of pixels, from a library that is loaded when the first image is: OpenImageIO takes a quarter of a
// second and 120 MB to start, and most models have no textures. So what calls it is a module of its own (decoder/).
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "cache/base/result.h"
#include "preprocess/texture/image_data.h"

namespace farcell {

// 0x00BBGGRR, display values as stored: no colour is converted, alpha is left out.
using RowSink = std::function<Result<>(std::span<const uint32_t> row)>;

// Every row from the top one down; the sink's error ends it and is returned. Any thread. Once a row was given, a later
// one may still fail: corrupt. unsupported: the module cannot be loaded.
Result<> decodeRows(const ImageData& image, const std::string& name, const RowSink& sink);

// A whole image in memory.
struct TextureImage {
  int width = 0;
  int height = 0;
  std::vector<uint32_t> pixels;  // the top row first
};
Result<TextureImage> readTextureImage(const TextureSource& source);

// What the module exports under kDecodeSymbol.
inline constexpr const char* kDecodeSymbol = "farcellDecodeRows";
using DecodeFunction = void(const ImageData& image, const std::string& name, const RowSink& sink, Result<>& result);

}  // namespace farcell
