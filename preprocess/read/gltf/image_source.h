// Where the bytes of one image lie.
#pragma once

#include "preprocess/mesh/texture_source.h"
#include "preprocess/read/gltf/looks.h"

namespace farcell {

// unsupported where they begin neither like PNG nor like JPEG, whatever their mimeType says.
Result<TextureSource> imageSource(GltfBuffers& buffers, const GltfPlace& place, const GltfImage& image);

}  // namespace farcell
