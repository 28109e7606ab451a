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

// 0xAABBGGRR, display values as stored: no colour is converted nor multiplied with alpha; 255 where an image has none.
using RowSink = std::function<Result<>(std::span<const uint32_t> row)>;

// Every row from the top one down; the sink's error ends it and is returned. Any thread. Once a row was given, a later
// one may still fail: corrupt. unsupported: the module cannot be loaded.
Result<> decodeRows(const ImageData& image, const std::string& name, const RowSink& sink);

// What a source is an image of: as decodeRows, alpha 255 where it says nothing, else multiplied with the opacity.
// `begin` is told the size, and gives the sink.
using RowSinkOf = std::function<RowSink(int width, int height)>;
Result<> readTextureRows(const TextureSource& source, const RowSinkOf& begin);

// The same, whole in memory.
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
