#include "preprocess/read/off/off_reader.h"

#include <algorithm>

#include "preprocess/mesh/triangle_batch.h"
#include "preprocess/read/off/off_rows.h"

namespace farcell {
namespace {

// What the first reading finds.
struct OffContents {
  OffHeader header;
  std::optional<Vertices> vertices;  // always, once read
  TextPlace faces;
  uint64_t triangles = 0;
  bool hasFaceColours = false;
  bool wholeAreBytes = false;  // of the faces
};

Result<OffContents> scan(const InputFile& file, const std::shared_ptr<ReadMemory>& memory) {
  TextLines lines(file, TextLines::Continuation::none);
  OffContents contents;
  FARCELL_ASSIGN(contents.header, readOffHeader(lines));
  FARCELL_ASSIGN(contents.vertices, readOffVertices(lines, contents.header, memory));
  contents.faces = lines.nextPlace();
  OffFace face;
  for (uint64_t index = 0; index < contents.header.faces; ++index) {
    FARCELL_TRY(readOffFace(lines, contents.header, index, face));
    if (face.corners.size() >= 3) contents.triangles += face.corners.size() - 2;
    contents.hasFaceColours |= face.hasColour;
    contents.wholeAreBytes |= face.hasColour && face.colour.isWhole && face.colour.exceedsOne();
  }
  std::string_view line;
  if (nextOffLine(lines, line))
    return lines.bad(fmt::format("the end of the file after {} faces", contents.header.faces), line);
  if (lines.failure()) return tl::unexpected<Error>(*lines.failure());
  return contents;
}

class OffReader final : public MeshReader {
 public:
  OffReader(InputFile file, OffContents contents) : file_(std::move(file)), contents_(std::move(contents)) {
    const OffKeyword& keyword = contents_.header.keyword;
    info_.format = "OFF";
    info_.hasColours = keyword.hasColours || contents_.hasFaceColours;
    info_.hasNormals = keyword.hasNormals;
    info_.declaredTriangles = contents_.triangles;
    info_.vertices = contents_.vertices->count();
  }

  const MeshInfo& info() const override { return info_; }
  std::vector<std::filesystem::path> files() const override { return {file_.path()}; }
  Result<MeshCounts> forEachTriangle(const Sink& sink) override;

 private:
  InputFile file_;
  OffContents contents_;
  MeshInfo info_;
};

// A fan around the first corner.
void addFace(const OffFace& face, uint32_t colour, TriangleBatch& batch) {
  const auto corner = [&](size_t i) { return static_cast<uint64_t>(face.corners[i]); };
  for (size_t i = 2; i < face.corners.size(); ++i) batch.add({corner(0), corner(i - 1), corner(i)}, {colour});
}

Result<MeshCounts> OffReader::forEachTriangle(const Sink& sink) {
  TriangleBatch batch(*contents_.vertices, sink);
  TextLines lines(file_, TextLines::Continuation::none, contents_.faces);
  const OffHeader& header = contents_.header;
  OffFace face;
  for (uint64_t index = 0; index < header.faces && !batch.failed(); ++index) {
    FARCELL_TRY(readOffFace(lines, header, index, face));
    addFace(face, face.hasColour ? face.colour.packed(contents_.wholeAreBytes) : defaultColour(), batch);
  }
  return batch.finish();
}

}  // namespace

bool startsLikeOff(const InputFile& file) {
  constexpr size_t kLongestKeyword = 9;  // STCN4nOFF
  std::array<char, kLongestKeyword + 1> bytes{};
  const size_t size = std::min<uint64_t>(bytes.size(), file.sizeBytes());
  if (!file.readAt(0, std::as_writable_bytes(std::span(bytes).first(size)))) return false;
  const std::string_view start(bytes.data(), size);
  return parseOffKeyword(start.substr(0, start.find_first_of(" \t\r\n#"))).has_value();
}

Result<std::unique_ptr<MeshReader>> openOff(InputFile file, const std::shared_ptr<ReadMemory>& memory) {
  FARCELL_ASSIGN(OffContents contents, scan(file, memory));
  return std::make_unique<OffReader>(std::move(file), std::move(contents));
}

}  // namespace farcell
