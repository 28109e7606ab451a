#include "preprocess/read/gltf/meshopt_view.h"

#include <meshoptimizer.h>

#include "preprocess/read/gltf/extent.h"

namespace farcell {
namespace {

constexpr uint32_t kMaxStrideBytes = 256;
// The most a byte can stand for: a quarter of one says that sixteen are as the vertex before; indices take more.
constexpr uint64_t kMaxRatio = 64;
constexpr uint64_t kMaxDecodedBytes = uint64_t{4} << 30;

bool isVertexFilter(const MeshoptCoding& coding) {
  if (coding.filter == "NONE") return true;
  if (coding.filter == "OCTAHEDRAL") return coding.stride == 4 || coding.stride == 8;
  if (coding.filter == "QUATERNION") return coding.stride == 8;
  return coding.filter == "EXPONENTIAL";
}

Result<> checkMode(const GltfPlace& place, const MeshoptCoding& coding) {
  const bool isVertices = coding.mode == "ATTRIBUTES";
  const bool isTriangles = coding.mode == "TRIANGLES";
  if (!isVertices && !isTriangles && coding.mode != "INDICES")
    return place.in("mode").bad("ATTRIBUTES, TRIANGLES or INDICES", inQuotes(coding.mode));
  if (isVertices && (coding.stride == 0 || coding.stride % 4 != 0 || coding.stride > kMaxStrideBytes))
    return place.in("byteStride").bad("a multiple of 4, at most 256", std::to_string(coding.stride));
  if (!isVertices && coding.stride != 2 && coding.stride != 4)
    return place.in("byteStride").bad("2 or 4 for indices", std::to_string(coding.stride));
  if (isTriangles && coding.count % 3 != 0)
    return place.in("count").bad("a multiple of 3", std::to_string(coding.count));
  if (isVertices ? !isVertexFilter(coding) : coding.filter != "NONE")
    return place.in("filter").bad(fmt::format("a filter for {} of {} bytes", coding.mode, coding.stride),
                                  inQuotes(coding.filter));
  return {};
}

int decodeInto(std::byte* out, const MeshoptCoding& coding, std::span<const std::byte> coded) {
  const auto* bytes = reinterpret_cast<const unsigned char*>(coded.data());
  const auto count = static_cast<size_t>(coding.count);
  if (coding.mode == "ATTRIBUTES") return meshopt_decodeVertexBuffer(out, count, coding.stride, bytes, coded.size());
  if (coding.mode == "TRIANGLES") return meshopt_decodeIndexBuffer(out, count, coding.stride, bytes, coded.size());
  return meshopt_decodeIndexSequence(out, count, coding.stride, bytes, coded.size());
}

void unfilter(std::byte* out, const MeshoptCoding& coding) {
  const auto count = static_cast<size_t>(coding.count);
  if (coding.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(out, count, coding.stride);
  if (coding.filter == "QUATERNION") meshopt_decodeFilterQuat(out, count, coding.stride);
  if (coding.filter == "EXPONENTIAL") meshopt_decodeFilterExp(out, count, coding.stride);
}

}  // namespace

Result<> checkMeshoptCoding(const GltfPlace& place, const MeshoptCoding& coding, uint64_t viewBytes) {
  FARCELL_TRY(checkMode(place, coding));
  if (productPlus(coding.count, coding.stride, 0) != viewBytes)
    return place.bad(fmt::format("count * byteStride = the view's {} bytes", viewBytes),
                     fmt::format("{} * {}", coding.count, coding.stride));
  if (viewBytes / kMaxRatio > coding.size)
    return place.in("count").bad(fmt::format("what {} coded bytes can hold", coding.size),
                                 fmt::format("{} elements of {} bytes", coding.count, coding.stride));
  if (viewBytes > kMaxDecodedBytes)
    return place.failed(ErrorKind::exhausted, fmt::format("at most {} decoded bytes", kMaxDecodedBytes),
                        std::to_string(viewBytes));
  return {};
}

Result<std::vector<std::byte>> decodeMeshopt(const GltfPlace& place, const MeshoptCoding& coding,
                                             const ByteRange& coded) {
  std::vector<std::byte> in(coded.size);
  FARCELL_TRY(coded.read(in));
  std::vector<std::byte> out(coding.count * coding.stride);
  if (const int code = decodeInto(out.data(), coding, in); code != 0)
    return place.bad(fmt::format("{} elements of {} bytes, coded as {}", coding.count, coding.stride, coding.mode),
                     fmt::format("bytes that are none (meshoptimizer: {})", code));
  unfilter(out.data(), coding);
  return out;
}

}  // namespace farcell
